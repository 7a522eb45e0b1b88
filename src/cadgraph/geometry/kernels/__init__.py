"""Compiled kernels and what they share: threads, box trees, triangle distances, sorting."""
