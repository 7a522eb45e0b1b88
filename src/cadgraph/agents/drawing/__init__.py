"""Pictures of a scene, drawn in this process or in one of their own; the only place here that knows the renderer."""
