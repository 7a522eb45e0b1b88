"""A plant in the browser: one folder, one session, served on this machine (``cadgraph view``)."""
