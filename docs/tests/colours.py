"""colours.py SOURCE: the palette of pictures, data/palette.csv. Its sources in C, Python and JavaScript
are as tools/palette.py writes them; each path and each number can be seen; no two paths look alike,
with and without full colour vision; and the table has one look in the figures that the command, Python
and JavaScript draw.
"""

import itertools
import math
import re
import subprocess
import sys
import xml.etree.ElementTree as tree
from pathlib import Path

SVG = "{http://www.w3.org/2000/svg}"
# Least contrasts by WCAG 2.2: 3 for graphics (1.4.11), 4.5 for text (1.4.3).
GRAPHICS, TEXT = 3.0, 4.5
# The least distance of two paths in OKLab, of which 0.02 is just noticed where colours touch.
APART = 0.09
# Parts of the width of a cloth in which places are compared, about 1 mm, as JavaScript draws them.
SCALE = 2500
# What linear red, green and blue become without one kind of cones: Machado, Oliveira and Fernandes,
# IEEE Transactions on Visualization and Computer Graphics 15 (2009), severity 1.
VISION = {
    "normal": ((1, 0, 0), (0, 1, 0), (0, 0, 1)),
    "protanopia": (
        (0.152286, 1.052583, -0.204868),
        (0.114503, 0.786281, 0.099216),
        (-0.003882, -0.048116, 1.051998),
    ),
    "deuteranopia": (
        (0.367322, 0.860646, -0.227968),
        (0.280085, 0.672501, 0.047413),
        (-0.011820, 0.042940, 0.968881),
    ),
}
# OKLab (B. Ottosson, 2020): from linear colours to cones, and from their cube roots to L, a and b.
CONES = (
    (0.4122214708, 0.5363325363, 0.0514459929),
    (0.2119034982, 0.6806995451, 0.1073969566),
    (0.0883024619, 0.2817188376, 0.6299787005),
)
LAB = (
    (0.2104542553, 0.7936177850, -0.0040720468),
    (1.9779984951, -2.4285922050, 0.4505937099),
    (0.0259040371, 0.7827717662, -0.8086757660),
)


def times(matrix, vector):
    return [sum(a * b for a, b in zip(row, vector)) for row in matrix]


def linear(colour):
    """Red, green and blue of "#rrggbb", 0 to 1, as light adds."""
    shares = [int(colour[k : k + 2], 16) / 255 for k in (1, 3, 5)]
    return [s / 12.92 if s <= 0.04045 else ((s + 0.055) / 1.055) ** 2.4 for s in shares]


def contrast(one, other):
    """Of two colours, by WCAG: 1 to 21."""
    low, high = sorted(
        sum(times([(0.2126, 0.7152, 0.0722)], linear(colour))) for colour in (one, other)
    )
    return (high + 0.05) / (low + 0.05)


def seen(colour, vision):
    """A colour in OKLab, as it is seen."""
    light = [min(max(share, 0.0), 1.0) for share in times(vision, linear(colour))]
    return times(LAB, [share ** (1 / 3) for share in times(CONES, light)])


def distances(paths):
    """How far every two paths are apart, for each vision: (distance, vision, one, other)."""
    for name, vision in VISION.items():
        for (one, a), (other, b) in itertools.combinations(paths.items(), 2):
            yield math.dist(seen(a, vision), seen(b, vision)), name, one, other


def check_colours(kinds):
    """Returns the least contrast of a path and the least distance of two."""
    balls = kinds["ball"]
    against = [
        (contrast(path, cloth), name, discipline)
        for discipline, cloth in [*kinds["cloth"].items(), *kinds["cushion"].items()]
        for name, (_, path, _) in balls.items()
    ]
    assert min(against)[0] >= GRAPHICS, f"a path is too dark: {min(against)}"
    numbers = [(contrast(colour, ink), name) for name, (colour, _, ink) in balls.items()]
    assert min(numbers)[0] >= TEXT, f"a number is not read: {min(numbers)}"
    letters = [
        (contrast(kinds["part"][name], frame), name, discipline)
        for name in ("text", "mark")
        for discipline, frame in [*kinds["wood"].items(), *kinds["cloth"].items()]
    ]
    assert min(letters)[0] >= TEXT, f"letters are not read: {min(letters)}"
    # The balls of pool by number, and those of snooker by name; of both each path once.
    paths = {name: path for name, (_, path, _) in balls.items() if name not in ("brown", "pink")}
    snooker = ["white", "red", "yellow", "green", "brown", "blue", "pink", "black"]
    least = min(distances(paths))
    for chosen in (paths, {name: balls[name][1] for name in snooker}):
        closest = min(distances(chosen))
        assert closest[0] >= APART, f"two paths look alike: {closest}"
    return min(against)[0], least[0]


def table_of(path, left_out):
    """What a figure draws of its table, by fill or stroke: places over the width of the cloth, from
    its corner, in parts of SCALE.
    """
    page = tree.parse(path).getroot()
    frames = [one for one in page.iter(SVG + "rect") if one.get("fill") in left_out["cloth"]]
    x_0, y_0, wide = (float(frames[0].get(name)) for name in ("x", "y", "width"))

    def at(x, y):
        return round(SCALE * (float(x) - x_0) / wide), round(SCALE * (float(y) - y_0) / wide)

    found = set()
    for circle in page.iter(SVG + "circle"):
        if circle.get("fill") in left_out["round"] and not circle.get("stroke"):
            size = round(SCALE * float(circle.get("r")) / wide)
            found.add((circle.get("fill"), at(circle.get("cx"), circle.get("cy")), size))
    for line in [*page.iter(SVG + "path"), *page.iter(SVG + "polyline")]:
        if line.get("stroke") != left_out["nose"] or not line.get("stroke-linecap"):
            continue
        numbers = re.findall(r"-?[\d.]+", line.get("d") or line.get("points"))
        ends = sorted((at(*numbers[:2]), at(*numbers[2:])))
        width = round(SCALE * float(line.get("stroke-width")) / wide)
        found.add((left_out["nose"], *ends, width))
    return found


def near(one, other):
    """Whether two parts are the same, with colours exactly and places to 2 parts of SCALE."""
    flat = [re.findall(r"-?\d+|#\w+", str(part)) for part in (one, other)]
    return len(flat[0]) == len(flat[1]) and all(
        a == b if "#" in a + b else abs(int(a) - int(b)) <= 2 for a, b in zip(*flat)
    )


def check_tables(source, kinds):
    """That the command, Python and JavaScript draw the same table of pool; returns its parts."""
    parts = {
        "cloth": kinds["cloth"].values(),
        "round": [kinds["part"]["pocket"], kinds["cushion"]["pool"]],
        "nose": kinds["part"]["nose"],
    }
    figures = source / "docs/figures"
    drawn = {
        name: table_of(figures / name, parts)
        for name in ("break.svg", "notebook-first_look-1.svg", "example-break-paths.svg")
    }
    first, *others = drawn.items()
    for name, table in others:
        for one, more in ((first, (name, table)), ((name, table), first)):
            alone = [part for part in one[1] if not any(near(part, other) for other in more[1])]
            assert not alone, f"{one[0]} draws what {more[0]} does not: {alone[:3]}"
    return len(first[1])


def main(source):
    sys.path.insert(0, str(source / "tools"))
    import palette

    writer = [sys.executable, source / "tools/palette.py", source, "--check"]
    assert subprocess.run(writer).returncode == 0
    kinds = palette.read(source)
    against, apart = check_colours(kinds)
    count = check_tables(source, kinds)
    print(
        f"contrast {against:.2f} or more, paths {apart:.3f} or more apart in OKLab, "
        f"{count} parts of one table in three figures"
    )


if __name__ == "__main__":
    main(Path(sys.argv[1]).resolve())
