"""The embedded labeler: a trained network over shapes and contacts, offline and without a GPU."""
