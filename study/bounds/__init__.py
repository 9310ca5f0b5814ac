"""Operation counts of the ladder's kernels and lower bounds on their cycles; __main__.py reports
how they are made."""
