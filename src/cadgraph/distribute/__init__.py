"""The costly steps of the method as tasks for many processes, put together to the same result to the byte."""
