"""The steps of the method: each a function from frozen values to frozen values."""
