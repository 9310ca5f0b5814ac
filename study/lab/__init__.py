"""What measures the product, in Python, run from the root of the tree: `tools/python -m study.lab.published`."""
