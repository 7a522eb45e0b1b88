"""Whole plants: the presets, random assortments, single devices."""
