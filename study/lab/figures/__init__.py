"""The figures of the docs beyond the study."""
