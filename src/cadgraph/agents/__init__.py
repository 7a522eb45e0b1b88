"""Questions to a finished graph, as tools: pure functions whose answers are short enough for a language model."""
