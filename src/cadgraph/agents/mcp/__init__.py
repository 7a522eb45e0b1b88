"""The server for agents: the tools over the Model Context Protocol; the only place that knows its library."""
