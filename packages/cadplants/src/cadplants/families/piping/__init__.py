"""Families of pipe fittings, flanges, joints and strainers."""
