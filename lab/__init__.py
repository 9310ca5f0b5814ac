"""The study's Python parts, run from the root of the tree: `python3 -m lab.bound`, `tools/python -m lab.report`."""
