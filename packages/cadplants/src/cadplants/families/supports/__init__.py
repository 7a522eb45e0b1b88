"""Families of pipe supports, brackets and fasteners."""
