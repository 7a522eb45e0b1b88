"""Which surfaces come near each other, how near, and where."""
