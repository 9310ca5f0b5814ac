"""Pictures that carom draws itself, beside the numbers that they show, computed here from the
definitions of motion on the cloth.

Each check gives a list of what differs, which is empty for a picture that is right to the tenth of
a pixel in which it is written.
"""

import json
import math
import re
import xml.etree.ElementTree as tree

SVG = "{http://www.w3.org/2000/svg}"
GRAVITY, NEAR = 9.81, 0.0501


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
        if rect.get("fill") == "#1d4a3c"
        for y in range(int(float(rect.get("height"))))
    ]

    def crossed(box, a, b):
        return any(
            box[0] < a[0] + t * (b[0] - a[0]) < box[2]
            and box[1] < a[1] + t * (b[1] - a[1]) < box[3]
            for t in (k / 500 for k in range(501))
        )

    return [text for text, box in label_boxes(page) if any(crossed(box, *nose) for nose in noses)]


class Report:
    """What differs."""

    def __init__(self):
        self.found = []

    def near(self, what, seen, expected, allowed=NEAR):
        seen, expected = list(seen), list(expected)
        far = [
            (k, a, b) for k, (a, b) in enumerate(zip(seen, expected)) if not abs(a - b) <= allowed
        ]
        if len(seen) != len(expected):
            self.found.append(f"{what}: {len(seen)} numbers, not {len(expected)}")
        elif far:
            self.found.append("{}: number {} is {}, not {}".format(what, *far[0]))

    def path(self, what, seen, expected, allowed=NEAR):
        self.near(
            what, *([x for point in points for x in point] for points in (seen, expected)), allowed
        )

    def same(self, what, seen, expected):
        if seen != expected:
            self.found.append(f"{what}: {seen!r}, not {expected!r}")


# ---- Shots
# -------------------------------------------------------------------------------------------------------------


def slid(state, params, time):
    """Where a ball is that has been sliding for a time: its slip, of constant direction, slows it
    down by mu g.
    """
    _, x, y, _, vx, vy, _, wx, wy, _ = state
    u = (vx - params.get("R", 0.028575) * wy, vy + params.get("R", 0.028575) * wx)
    a = 0.5 * params.get("u_s", 0.2) * params.get("g", GRAVITY) * time * time / math.hypot(*u)
    return x + vx * time - a * u[0], y + vy * time - a * u[1]


def way(shot, ball):
    """Points on the way of a ball, m: its start, each event that it is in, and seven between two of
    them where it slides.
    """
    state, since = ball["state"], 0.0
    points = [tuple(state[1:3])]
    for time, kind, names, before, after in shot["events"]:
        names = names[1:] if kind == "stick_ball" else names[: len(before)]
        if ball["id"] not in names:
            continue
        side = names.index(ball["id"])
        if time > 0 and before[side][0] == 2:
            points += [
                slid(state, ball.get("params", {}), (time - since) * k / 8) for k in range(1, 8)
            ]
        if time > 0:
            points.append(tuple(before[side][1:3]))
        state, since = after[side], time
    return points


def cushions(shot, table):
    """What stands at the cushions that the ball of the cue meets: not at cuts of pockets, nor where
    it hops on at the same one.
    """
    length = {rail["id"]: math.dist(rail["p1"], rail["p2"]) for rail in table["linear"]}
    found, last = [], {}
    for time, kind, names, *_ in shot["events"]:
        if (
            kind == "ball_linear_cushion"
            and names[0] == shot["cue"].get("ball")
            and length[names[1]] > 0.2 * max(length.values())
        ):
            if time - last.get(names[1], -1) >= 0.1:
                found.append(f"rail {len(found) + 1}, {time:.2f} s")
            last[names[1]] = time
    return found[:9]


def check_shot(picture, shot, table):
    """A picture of `carom shoot --plot` beside the line of the shot, with its events in full, and
    the table's.
    """
    report, page = Report(), tree.parse(picture).getroot()
    ends = [rail[end][:2] for rail in table["linear"] for end in ("p1", "p2")]
    low, high = [min(p) for p in zip(*ends)], [max(p) for p in zip(*ends)]
    # 400 pixels a metre and a margin of a twentieth; a table that is longer than wide is turned to
    # lie along the picture.
    turned = high[1] - low[1] > high[0] - low[0]
    margin = 0.05 * max(high[k] - low[k] for k in (0, 1))
    size = [400 * (high[k] - low[k] + 2 * margin) for k in ((1, 0) if turned else (0, 1))]

    def at(r):
        across, down = (r[1] - low[1], r[0] - low[0]) if turned else (r[0] - low[0], high[1] - r[1])
        return 400 * (across + margin), 400 * (down + margin)

    report.near("size", map(float, page.get("viewBox").split()), [0, 0, *size], 0.5)
    report.near(
        "cloth",
        numbers(elements(page, "rect")[1], "x", "y", "width", "height"),
        [200 * margin, 200 * margin, size[0] - 400 * margin, size[1] - 400 * margin],
    )
    circles, paths, texts = (
        [
            one
            for one in elements(page, name)
            if one.get("class") not in ("axis", "pocket", "legend")
        ]
        for name in ("circle", "path", "text")
    )
    marks, texts = (
        [text.text for text in texts if text.get("stroke")],
        [text for text in texts if not text.get("stroke")],
    )
    # Holes, jaws, balls at first; paths between; balls at the end, striped ones with a ring.
    expected = [
        (f"{kind} {part['id']}", part["center"], part["radius"], None)
        for kind in ("pockets", "circular")
        for part in table[kind]
    ]
    radius = [ball.get("params", {}).get("R", 0.028575) for ball in shot["balls"]]
    expected += [
        (f"start of {ball['id']}", ball["state"][1:3], r, "none")
        for ball, r in zip(shot["balls"], radius)
    ]
    fallen = {name: pocket for pocket, names in shot["final"]["pockets"].items() for name in names}
    final = {}
    for ball, r in zip(shot["balls"], radius):
        name = ball["id"]
        place = shot["final"]["balls"][name][1:3]
        beside = sum(fallen.get(other) == fallen[name] for other in final) if name in fallen else 0
        final[name] = at((place[0] + 1.6 * r * beside, place[1]))
        expected.append((f"end of {name}", (place[0] + 1.6 * r * beside, place[1]), r, None))
        if name.isdigit() and 9 <= int(name) <= 15:
            expected.append(
                (f"ring of {name}", (place[0] + 1.6 * r * beside, place[1]), r - 1.8 / 400, "none")
            )
    report.same("circles", len(circles), len(expected))
    for circle, (what, place, r, fill) in zip(circles, expected):
        report.near(what, numbers(circle, "cx", "cy", "r"), [*at(place), 400 * r])
        report.same(f"{what} is filled", circle.get("fill") != "none", fill != "none")
    # Short names stand on the balls, others beside them, but those of colours nowhere.
    short = {name: place for name, place in final.items() if len(name) < 3}
    coloured = {"cue", "white", "yellow", "green", "brown", "blue", "pink", "black"}
    report.same("texts", [text.text for text in texts], list(short))
    for text, (name, (x, y)) in zip(texts, short.items()):
        report.near(
            f"text of {name}", numbers(text, "x", "y"), [x, y + 0.36 * 9.2 / 500 * size[0]], 0.1
        )
    named = [
        name
        for name in final
        if len(name) > 2 and name not in coloured and not name.startswith("red")
    ]
    report.same("names and cushions of the cue ball", marks, named + cushions(shot, table))
    report.same("letters", (small_letters(picture), labels_on_rails(picture)), ([], []))
    # Diamonds: three on each short side, seven on each long one, six where a pocket is.
    diamonds = [path for path in paths if path.get("fill") == "#e8dcc0"]
    report.same("diamonds", len(diamonds), 2 * (3 + (6 if table["pockets"] else 7)))
    rails = [path for path in paths if path.get("stroke-linecap")]
    report.same("rails", len(rails), len(table["linear"]))
    for path, rail in zip(rails, table["linear"]):
        report.near(rail["id"], sum(vertices(path), ()), [*at(rail["p1"]), *at(rail["p2"])])
    # The last ball is drawn first, so that the cue ball's path is on top.
    ways = {
        ball["id"]: [at(point) for point in way(shot, ball)] for ball in reversed(shot["balls"])
    }
    moved = {name: points for name, points in ways.items() if len(points) > 1}
    drawn = [path for path in paths if path.get("fill") == "none"]
    report.same("ways", len(drawn), len(moved))
    for path, (name, points) in zip(drawn, moved.items()):
        report.path(f"way of {name}", vertices(path), points)
    return report.found


def check_shots(lines, picture, shot_id):
    """The same, with shots and tables from a file of `carom shoot`."""
    lines = [json.loads(line) for line in open(lines, encoding="utf-8")]
    shot = next(line for line in lines if line["kind"] == "shot" and line["id"] == shot_id)
    table = next(line for line in lines if line["kind"] == "table" and line["id"] == shot["table"])
    return check_shot(picture, shot, table)


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


# ---- One collision
# -----------------------------------------------------------------------------------------------------


def check_hit(picture, row, after, words):
    """A picture of `carom hit --plot` beside the row of `--csv`, that of `carom resolve --derived`,
    and the words of the report.
    """
    report, page = Report(), tree.parse(picture).getroot()
    row, after = (
        {name: float(x) for name, x in one.items() if name not in ("id", "status")}
        for one in (row, after)
    )
    R = row["R1"]
    places = [(row[f"r{ball}x"], row[f"r{ball}y"]) for ball in (1, 2)]

    def motion(ball):
        """Velocities at once and when the ball rolls, when that is, and its place at any time."""
        v, rolling = ([after[f"{name}{ball}{axis}"] for axis in "xy"] for name in ("v", "roll"))
        # A pool ball, but for what the row says of it; the cloth is never quite smooth.
        params, place = {"R": R, "u_s": max(row[f"u_s{ball}"], 1e-6)}, places[ball - 1]
        slip = math.hypot(v[0] - R * after[f"w{ball}y"], v[1] + R * after[f"w{ball}x"])
        sliding = 2 * slip / (7 * params["u_s"] * GRAVITY)
        state = [2, *place, R, *v, 0, *(after[f"w{ball}{axis}"] for axis in "xyz")]

        def at(time):
            x, y = slid(state, params, min(time, sliding)) if slip else place
            speed = math.hypot(*rolling)
            rolls = min(max(time - sliding, 0.0), speed / (0.01 * GRAVITY))
            far = rolls - 0.5 * 0.01 * GRAVITY * rolls * rolls / speed if speed else 0.0
            return x + far * rolling[0], y + far * rolling[1]

        return v, rolling, sliding, at

    motions = [motion(ball) for ball in (1, 2)]
    # To where both balls roll, and some way more.
    end = max(
        [14 * R / max(math.hypot(*v) for m in motions for v in m[:2])]
        + [
            1.25 * m[2]
            for ball, m in enumerate(motions, 1)
            if row[f"u_s{ball}"] > 1e-6 and m[2] > 0
        ]
    )
    n = [(b - a) / (2 * R) for a, b in zip(*places)]

    def along(far, e):
        return [p + far * R * c for p, c in zip(places[0], e)]

    # The way there and on, the line of centres, and the tangent line through the centre of the cue
    # ball.
    lines = [
        (along(-6, (1, 0)), along(0, n)),
        (along(0, n), along(5, (1, 0))),
        (along(-2.5, n), along(6, n)),
        (along(5, (-n[1], n[0])), along(-5, (-n[1], n[0]))),
    ]
    ways = [[m[3](end * k / 64) for k in range(65)] for m in motions]
    seen = (
        [(p, 1.5) for p in places]
        + [(p, 0.5) for line in lines for p in line]
        + [(p, 1.5) for way in ways for p in way[1:]]
    )
    low, high = (
        [f(p[k] + sign * R * room for p, room in seen) for k in (0, 1)]
        for f, sign in ((min, -1), (max, 1))
    )
    scale = min(848 / (high[0] - low[0]), 620 / (high[1] - low[1]))
    left = 450 - scale * (low[0] + high[0]) / 2

    def px(r):
        return (left + scale * r[0], 26 + scale * (high[1] - r[1]))

    for circle, place in zip(elements(page, "circle"), places):
        report.near("ball", numbers(circle, "cx", "cy", "r"), [*px(place), max(scale * R, 3)])
    dots = [
        (px(m[3](m[2])), 4)
        for m in motions
        if 0 < m[2] < end and math.dist(px(m[3](end)), px(m[3](0))) >= 4
    ]
    for circle, (place, size) in zip(elements(page, "circle")[2:], dots, strict=True):
        report.near("dot", numbers(circle, "cx", "cy", "r"), [*place, size])
    paths = elements(page, "path")
    dashed = [path for path in paths if path.get("stroke-dasharray")]
    for path, points in zip(dashed, lines, strict=True):
        report.path("line", vertices(path), [px(p) for p in points])
    # The paths of both balls, the cue ball's first.
    drawn = [path for path in paths if path.get("stroke-width") == "2.2"]
    for path, way in zip(drawn, ways, strict=True):
        report.path("path", vertices(path), [px(p) for p in way])
    # An arrow's head, 13 pixels long and 10 wide, on each path that is no point.
    heads = [path for path in paths if path.get("d").endswith("Z")]
    arrows = [
        (px(way[-2]), px(way[-1])) for way in ways if sum(map(math.dist, way[1:], way)) * scale >= 4
    ]
    for path, (before, tail) in zip(heads, arrows, strict=True):
        x, y = ((b - a) / math.dist(before, tail) for a, b in zip(before, tail))
        corners = [
            (tail[0] + far * x + side * y, tail[1] + far * y - side * x)
            for far, side in ((13, 0), (0, -5), (0, 5))
        ]
        report.path(
            "head",
            [tuple(map(float, pair.split())) for pair in path.get("d")[1:-1].split("L")],
            corners,
        )
    # A bar of 1, 2 or 5 times a power of ten, at most a sixth of the width, and its length in
    # words.
    [bar] = [path for path in paths if "v6h" in path.get("d")]
    length = max(
        n * 10.0**power
        for n in (1, 2, 5)
        for power in range(-6, 6)
        if n * 10.0**power <= 150 / scale
    )
    bottom = scale * (high[1] - low[1]) + 52 - 16
    report.near(
        "bar",
        map(float, re.findall(r"[\d.]+", bar.get("d"))),
        [874 - scale * length, bottom, 6, scale * length, 6],
    )
    [text] = [text for text in elements(page, "text") if text.get("class") == "bar"]
    report.near("words of the bar", numbers(text, "x", "y"), [874 - scale * length / 2, bottom])
    report.same(
        "length of the bar", text.text, f"{length:g} m" if length >= 1 else f"{100 * length:g} cm"
    )
    # All is on the picture, and no label covers another.
    width, height = map(float, page.get("viewBox").split()[2:])
    texts = elements(page, "text")
    boxes = [
        (x, y - s, x + 7.6 / 13 * s * len(text.text), y + 0.2 * s)
        for text in texts
        if text.get("stroke")
        for x, y, s in [numbers(text, "x", "y", "font-size")]
    ]
    inside = all(a >= 0 and c <= width and b >= 0 and d <= height for a, b, c, d in boxes)
    apart = all(
        a[2] < b[0] or b[2] < a[0] or a[3] < b[1] or b[3] < a[1]
        for k, a in enumerate(boxes)
        for b in boxes[:k]
    )
    report.same("labels inside and apart", (inside, apart), (True, True))
    report.same(
        "words",
        " ".join(text.text for text in texts).split()[-len(" ".join(words).split()) :],
        " ".join(words).split(),
    )
    report.same("letters", small_letters(picture), [])
    return report.found
