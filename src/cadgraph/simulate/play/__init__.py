"""A timetable played to a plant: what it does, as an animation for USD viewers and as pictures."""
