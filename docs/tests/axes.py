"""axes.py SOURCE: the axes and quaternions that games.md gives for engines turn balls as carom does.

For a ball that turns by R, the engine's matrix of the converted quaternion must be M R M^T, where M
has the converted places; the determinant of M is the hand of the engine's axes.
"""

import math
import random
import re
import sys
from pathlib import Path


def matrix(w, x, y, z):
    """The matrix of a quaternion, by the formula that all engines share."""
    return [
        [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
    ]


def product(a, b):
    return [[sum(a[i][k] * b[k][j] for k in range(3)) for j in range(3)] for i in range(3)]


def determinant(m):
    (a, b, c), (d, e, f), (g, h, i) = m
    return a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g)


def converted(formula, **values):
    return [
        -values[term[1:]] if term[0] == "-" else values[term]
        for term in formula.strip("()").split(", ")
    ]


text = (Path(sys.argv[1]) / "docs/using/games.md").read_text(encoding="utf-8")
rows = re.findall(r"^\| (\S+) \| (right|left) \| `(.*?)` \| `(.*?)` \|$", text, flags=re.M)
if [row[0] for row in rows] != ["three.js", "Godot", "Unity"]:
    sys.exit(f"games.md: the table of axes has other engines: {rows}")
source = random.Random(1)
for engine, hand, place, turn in rows:
    columns = [converted(place, x=k == 0, y=k == 1, z=k == 2) for k in range(3)]
    axes = [list(map(float, row)) for row in zip(*columns)]
    if determinant(axes) != {"right": 1.0, "left": -1.0}[hand]:
        sys.exit(f"{engine}: the axes are not {hand}-handed: {place}")
    for _ in range(100):
        q = [source.gauss(0.0, 1.0) for _ in range(4)]
        w, x, y, z = (part / math.hypot(*q) for part in q)
        expected = product(product(axes, matrix(w, x, y, z)), list(zip(*axes)))
        x, y, z, w = converted(turn, w=w, x=x, y=y, z=z)
        seen = matrix(w, x, y, z)
        if any(abs(seen[i][j] - expected[i][j]) > 1e-14 for i in range(3) for j in range(3)):
            sys.exit(f"{engine}: the quaternion {turn} does not turn as {place} asks")
print(f"{len(rows)} engines turn as carom does")
