"""Families of electrical and safety equipment."""
