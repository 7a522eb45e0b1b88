"""What others do to plants: gaps, overlaps, missing parts, other triangles."""
