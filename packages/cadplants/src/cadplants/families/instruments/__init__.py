"""Families of gauges, meters and transmitters."""
