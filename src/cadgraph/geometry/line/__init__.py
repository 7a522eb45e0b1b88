"""The lines along the middle of tubes, found by cross-sections."""
