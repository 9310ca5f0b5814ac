"""The seed paper's study in Python, run from the root of the tree: `tools/python -m study.report`."""
