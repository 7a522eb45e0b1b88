"""Reading in a process of its own, so that a library that crashes on a damaged file takes nobody down."""
