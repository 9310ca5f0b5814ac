"""The report: CSV files measured by the programs of the build, a figure of each by gnuplot, and one
page.
"""
