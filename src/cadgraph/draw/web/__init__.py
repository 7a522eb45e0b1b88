"""What the page of the viewer is fed with: the plant as triangles, and what the graph says of it."""
