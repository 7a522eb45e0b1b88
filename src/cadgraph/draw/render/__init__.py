"""Views and pictures of a scene: drawn on the processor, no window system, no graphics driver.

``views`` chooses where to look from, ``camera`` frames it. A picture goes through three modules: ``surface`` finds what
the rays meet, ``light`` what each point sees of sky and lamp, ``shading`` makes colours of both. ``picture`` draws
pictures for people that way, where there are millions of triangles of those that ``coarse`` leaves, as few as
``fineness`` says can be told apart; ``annotation`` draws lines, tags and legends over them. Those of single parts for a
vision-language model are drawn by ``pair`` of what ``surroundings`` cuts out of a scene, from where ``target`` and
``detail`` look at it, in the colour that ``mark`` chooses, of samples that ``raster`` finds instead of rays. Nothing
here knows of graphs.
"""
