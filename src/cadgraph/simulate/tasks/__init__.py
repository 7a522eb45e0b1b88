"""Tasks for robots and agents in a plant, each with where to stand and how a hand gets there, and who checks them."""
