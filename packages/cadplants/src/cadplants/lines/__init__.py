"""Runs of pipe: their routes, what sits in them and on them, and their truth."""
