"""Families of structures."""
