"""What pictures that carom draws itself show: letters that are too small, labels that lie over
rails, and how wide bands are. The tests keep whole pictures as expected outputs.
"""

import re
import xml.etree.ElementTree as tree

SVG = "{http://www.w3.org/2000/svg}"


def elements(page, name):
    return list(page.iter(SVG + name))


def numbers(element, *names):
    return [float(element.get(name)) for name in names]


def vertices(path):
    """The points of a path of straight pieces, "M0 1L2 3 ..."."""
    return [tuple(map(float, pair.split())) for pair in path.get("d")[1:].split("L")]


def small_letters(picture):
    """Sizes of letters that have less than 9 pixels where the picture is 500 wide."""
    page = tree.parse(picture).getroot()
    sizes = {float(one.get("font-size")) for one in page.iter() if one.get("font-size")}
    return sorted(size for size in sizes if size * 500 / float(page.get("viewBox").split()[2]) < 9)


def label_boxes(page):
    """Left, top, right and bottom of each label; that of an axis as it is turned."""
    for text in elements(page, "text"):
        if not text.get("stroke") and text.get("class") != "axis":
            continue
        (x, y, size), width = (
            numbers(text, "x", "y", "font-size"),
            0.5 * len(text.text) * float(text.get("font-size")),
        )
        left = x - width if text.get("text-anchor") == "end" else x
        box = (left, y - 0.73 * size, left + width, y + 0.24 * size)
        turn, about_x, about_y = map(
            float, re.findall(r"[-.\d]+", text.get("transform", "rotate(0 0 0)"))
        )
        if turn == -90:
            box = (
                about_x + box[1] - about_y,
                about_y - box[2] + about_x,
                about_x + box[3] - about_y,
                about_y - box[0] + about_x,
            )
        yield text.text, box


def labels_on_rails(picture):
    """The labels that lie over the line of a nose, or over the cushion of `carom rail`."""
    page = tree.parse(picture).getroot()
    noses = [vertices(path) for path in elements(page, "path") if path.get("stroke-linecap")]
    noses += [
        [(0, y), (1e4, y)]
        for rect in elements(page, "rect")
        if rect.get("fill") == "#073d4b"  # the cushion of data/palette.csv
        for y in range(int(float(rect.get("height"))))
    ]

    def crossed(box, a, b):
        return any(
            box[0] < a[0] + t * (b[0] - a[0]) < box[2]
            and box[1] < a[1] + t * (b[1] - a[1]) < box[3]
            for t in (k / 500 for k in range(501))
        )

    return [text for text, box in label_boxes(page) if any(crossed(box, *nose) for nose in noses)]


def band_widths(picture, shot, ball, place, normal):
    """How far the band of a ball goes from a place on its path, m, along the normal and against it;
    of a table that is longer than wide.
    """
    page = tree.parse(picture).getroot()
    index = [one["id"] for one in shot["balls"]].index(ball)
    starts = [circle for circle in elements(page, "circle") if circle.get("stroke-dasharray")]
    colour, start = starts[index].get("stroke"), shot["balls"][index]["state"][1:3]
    x, y = (
        (a + 400 * (b - c))
        for a, b, c in zip(
            numbers(starts[index], "cx", "cy"), reversed(list(place)), reversed(start)
        )
    )
    crossed = []
    for path in elements(page, "path"):
        if path.get("class") != "band" or path.get("fill") != colour:
            continue
        for part in path.get("d").split("Z")[:-1]:
            points = [tuple(map(float, pair.split())) for pair in part[1:].split("L")]
            for (ax, ay), (bx, by) in zip(points, points[1:] + points[:1]):
                # the edge a + t (b - a) meets (x, y) + s n, n turned with the table
                nx, ny, dx, dy = normal[1], normal[0], bx - ax, by - ay
                cross = dx * ny - dy * nx
                if cross and 0 <= ((x - ax) * ny - (y - ay) * nx) / cross < 1:
                    crossed.append(((x - ax) * dy - (y - ay) * dx) / cross / 400)
    sides = [[s for s in crossed if s > 0], [-s for s in crossed if s < 0]]
    return [min(side) for side in sides if side]
