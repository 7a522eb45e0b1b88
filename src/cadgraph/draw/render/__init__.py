"""Views and pictures of a scene: ray cast on the processor, no window system, no graphics driver.

``views`` chooses where to look from, ``camera`` frames it. A picture goes through three modules: ``surface`` finds what
the rays meet, ``light`` what each point sees of sky and lamp, ``shading`` makes colours of both. ``picture`` draws
pictures for people that way, ``pair`` those for a vision-language model; ``annotation`` draws lines, tags and legends
over them. Nothing here knows of graphs.
"""
