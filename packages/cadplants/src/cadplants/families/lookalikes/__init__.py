"""Families whose parts are easily taken for those of other families."""
