"""How the embedded labeler's network is trained, and how its figures are made; users need none of it."""
