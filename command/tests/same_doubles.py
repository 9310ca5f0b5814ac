"""same_doubles ONE.csv OTHER.csv: exit 0 if both have the same rows, of which numbers count as
doubles, to the last bit.
"""

import csv
import struct
import sys


def cell(text):
    try:
        return struct.pack("<d", float(text))
    except ValueError:
        return text


one, other = (
    [[cell(text) for text in row] for row in csv.reader(open(path, newline=""))]
    for path in sys.argv[1:3]
)
differ = [number for number, rows in enumerate(zip(one, other), 1) if rows[0] != rows[1]]
if differ or len(one) != len(other):
    sys.exit(f"{len(one)} and {len(other)} rows; {len(differ)} differ, the first is {differ[:1]}")
