"""The curves of a picture that gnuplot drew as SVG, to be compared with the numbers that they show."""

import xml.etree.ElementTree as tree

SVG = "{http://www.w3.org/2000/svg}"


def curves(file):
    """Name and points, in pixels, of each curve in the order in which they were drawn; without the
    sample of the key.
    """
    found = []
    for group in tree.parse(file).getroot().iter(SVG + "g"):
        title = group.find(SVG + "title")
        if title is None:
            continue
        pieces = [
            piece.replace("L", " ").split()
            for path in group.iter(SVG + "path")
            for piece in path.get("d").split("M")
        ]
        longest = max(pieces, key=len, default=[])
        if len(longest) > 2:
            found.append((title.text, [tuple(map(float, point.split(","))) for point in longest]))
    return found


def shows(points, x, y):
    """Whether the curve is those numbers on straight scales, to a tenth of a pixel."""
    if len(points) != len(x):
        return False
    for pixels, numbers in ((list(zip(*points))[0], x), (list(zip(*points))[1], y)):
        low, high = (
            min(range(len(x)), key=numbers.__getitem__),
            max(range(len(x)), key=numbers.__getitem__),
        )
        a = (pixels[high] - pixels[low]) / ((numbers[high] - numbers[low]) or 1.0)
        if any(
            abs(pixels[low] + a * (n - numbers[low]) - p) > 0.1 for p, n in zip(pixels, numbers)
        ):
            return False
    return True
