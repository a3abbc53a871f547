"""Things that belong together: beds, seats around a television, tables, wash rows, kitchens."""
