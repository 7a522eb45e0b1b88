"""Families of pumps, blowers, compressors and burners."""
