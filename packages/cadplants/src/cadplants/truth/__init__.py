"""What is true of a plant, as a file, and whether such a file can be."""
