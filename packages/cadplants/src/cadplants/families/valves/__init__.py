"""Families of valves and their operators."""
