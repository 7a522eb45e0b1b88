"""What is measured of each mesh by itself: area, volume, boxes, distinct corners, duplicates."""
