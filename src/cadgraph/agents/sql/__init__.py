"""A finished graph as tables of SQLite, and a guarded way to ask them with SQL from anybody."""
