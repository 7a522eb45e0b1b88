"""What makes and changes results: a run from file to folder, relabelling, corrections, catalogues."""
