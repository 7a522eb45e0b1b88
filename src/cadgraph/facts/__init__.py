"""What a source file says of its parts, read as claims: which words, classes and codes mean which label."""
