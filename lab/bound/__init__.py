"""Operation counts of the ladder's rungs and lower bounds on their cycles; README.md says how to run it."""
