"""What a shape is: repeats in any pose, likeness, simple solids, symmetry."""
