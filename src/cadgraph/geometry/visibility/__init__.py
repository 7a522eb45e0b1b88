"""Which meshes can be seen from outside, and which lie inside others."""
