"""Families of tanks, exchangers, boilers, filters and separators."""
