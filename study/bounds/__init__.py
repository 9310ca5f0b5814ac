"""Operation counts of the ladder's kernels and lower bounds on their cycles; __main__.py says how they are made."""
