"""Views and pictures of a scene: ray cast on the processor, no window system, no graphics driver.

``views`` chooses where to look from, ``camera`` frames it, ``picture`` draws the surfaces, ``annotation`` draws
lines, tags and legends over them. Nothing here knows of graphs.
"""
