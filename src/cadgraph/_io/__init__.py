"""Files in and out: whole or not at all, in a folder of results, with messages that name what is wrong."""
