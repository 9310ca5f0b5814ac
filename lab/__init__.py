"""The study's Python part, run from the root of the tree: `tools/python -m lab.report`."""
