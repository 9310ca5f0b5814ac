"""Operation counts of the ladder's kernels and lower bounds on their cycles; README.md says how to run it."""
