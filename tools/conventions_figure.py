"""conventions_figure.py OUT.svg: draws the figure of docs/reference/conventions.md: the axes of the
table, the aim, the tip, the elevation, a cut and the impulses of a collision, with their signs.

Each panel has its own frame with y up, which `Panel` turns into the picture's, where y points down.
Directions are computed from the conventions (counterclockwise angles, x = y cross z), so a sign that
changes there changes here.
"""

import math
import sys
from pathlib import Path

SIZE = 760, 470
INK, GREY, RED, BLUE, GREEN = "#222", "#555", "#b03020", "#1f5fa8", "#3a7a4a"
BALL, OBJECT_BALL = "#f4f4ee", "#f6e3c0"
MARKERS = "".join(
    f'<marker id="{name}" viewBox="0 0 10 10" refX="9" refY="5" markerWidth="7" markerHeight="7"'
    f' orient="auto"><path d="M0 0 10 5 0 10z" fill="{colour}"/></marker>\n'
    for name, colour in (("ink", INK), ("red", RED), ("blue", BLUE))
)


class Panel:
    """A part of the picture with its own origin, scale and y axis that points up."""

    def __init__(self, x, y, scale=1.0):
        self.x, self.y, self.scale = x, y, scale
        self.parts = []

    def at(self, x, y):
        return f"{self.x + self.scale * x:.1f} {self.y - self.scale * y:.1f}"

    def line(self, *points, colour=INK, width=1.5, more=""):
        path = " ".join(self.at(*point) for point in points)
        self.parts.append(
            f'<path d="M{path}" fill="none" stroke="{colour}" stroke-width="{width}"{more}/>'
        )

    def dashed(self, *points):
        self.line(*points, colour="#888", width=1, more=' stroke-dasharray="4 4"')

    def arrow(self, start, end, name="ink"):
        colour = {"ink": INK, "red": RED, "blue": BLUE}[name]
        self.line(start, end, colour=colour, width=2, more=f' marker-end="url(#{name})"')

    def arc(self, centre, radius, first, last, name="red"):
        """An arrow from the angle `first` to `last`, degrees counterclockwise from +x."""
        steps = [first + (last - first) * k / 12 for k in range(13)]
        points = [
            (
                centre[0] + radius * math.cos(math.radians(angle)),
                centre[1] + radius * math.sin(math.radians(angle)),
            )
            for angle in steps
        ]
        colour = {"red": RED, "blue": BLUE}[name]
        self.line(*points, colour=colour, more=f' marker-end="url(#{name})"')

    def circle(self, x, y, radius, fill, colour=INK):
        centre = self.at(x, y).split()
        self.parts.append(
            f'<circle cx="{centre[0]}" cy="{centre[1]}" r="{self.scale * radius:.1f}" fill="{fill}"'
            f' stroke="{colour}" stroke-width="1.5"/>'
        )

    def text(self, x, y, words, colour=INK, size=14, anchor="start"):
        left, top = self.at(x, y).split()
        self.parts.append(
            f'<text x="{left}" y="{top}" fill="{colour}" font-size="{size}"'
            f' text-anchor="{anchor}">{words}</text>'
        )

    def towards_reader(self, x, y, colour):
        """A vector that points out of the picture."""
        self.circle(x, y, 6 / self.scale, "#fff", colour)
        self.circle(x, y, 1.5 / self.scale, colour, colour)

    def away_from_reader(self, x, y, colour):
        self.circle(x, y, 6 / self.scale, "#fff", colour)
        d = 4 / self.scale
        self.line((x - d, y - d), (x + d, y + d), colour=colour)
        self.line((x - d, y + d), (x + d, y - d), colour=colour)


def turned(angle, length):
    """The vector of a length and a direction, degrees counterclockwise from +x."""
    return length * math.cos(math.radians(angle)), length * math.sin(math.radians(angle))


def table():
    """The table from above, its axes, and the direction phi of a cue."""
    width, length = 1.27, 2.54
    panel = Panel(62, 415, 140)
    corners = [(0, 0), (width, 0), (width, length), (0, length), (0, 0)]
    panel.line(*corners, colour=GREEN, width=4)
    for x in (0, width):
        for y in (0, length / 2, length):
            panel.circle(x, y, 0.045, "#fff")
    panel.arrow((0, 0), (0.6, 0))
    panel.arrow((0, 0), (0, 0.6))
    panel.text(0.54, -0.13, "x")
    panel.text(-0.14, 0.54, "y")
    panel.towards_reader(0, 0, INK)
    panel.text(-0.14, -0.17, "z", INK)
    panel.text(width - 0.06, 0.08, "head rail, y = 0", GREY, 13, "end")
    panel.text(width / 2, length + 0.09, "foot rail", GREY, 13, "middle")
    panel.text(0.07, length * 0.62, "left rail,", GREY, 13)
    panel.text(0.07, length * 0.62 - 0.12, "x = 0", GREY, 13)
    panel.text(width - 0.06, length * 0.62, "right rail", GREY, 13, "end")
    cue_ball, phi = (0.5, 0.62), 62.0
    end = turned(phi, 0.75)
    panel.dashed(cue_ball, (cue_ball[0] + 0.6, cue_ball[1]))
    panel.arrow(cue_ball, (cue_ball[0] + end[0], cue_ball[1] + end[1]), "red")
    panel.arc(cue_ball, 0.42, 0, phi)
    panel.circle(*cue_ball, 0.05, BALL)
    panel.text(cue_ball[0] + 0.45, cue_ball[1] + 0.2, "phi", RED)
    for row in range(3):
        for k in range(row + 1):
            panel.circle(width / 2 + (k - row / 2) * 0.09, 0.75 * length + 0.078 * row, 0.045, BALL)
    return panel


def tip():
    """The cue ball from behind the cue: the tip, and the spin that it makes."""
    radius = 74
    panel = Panel(365, 124)
    panel.circle(0, 0, radius, BALL)
    panel.dashed((-radius, 0), (radius, 0))
    panel.dashed((0, -radius), (0, radius))
    right, above = 0.35 * radius, 0.38 * radius
    panel.line((0, above), (right, above), colour=RED)
    panel.line((right, 0), (right, above), colour=RED)
    panel.circle(right, above, 5, BLUE, BLUE)
    panel.text(right + 9, above + 9, "tip", BLUE)
    panel.text(right / 2, above + 6, "right", RED, 13, "middle")
    panel.text(right + 4, above / 2 - 5, "above", RED, 13)
    panel.text(0, radius + 14, "from behind the cue", GREY, 13, "middle")
    # The near side of a ball with w_z above 0 moves to the right.
    panel.arrow((-50, -24), (50, -24), "blue")
    panel.text(0, -44, "w_z &gt; 0", BLUE, 14, "middle")
    panel.text(0, -radius - 20, "a = -right, b = above", INK, 14, "middle")
    return panel


def elevation():
    """The cue ball from the side, with a raised cue."""
    panel = Panel(566, 150)
    theta, radius = 25.0, 38
    panel.line((-60, -radius), (175, -radius), colour=GREEN, width=3)
    panel.circle(0, 0, radius, BALL)
    start, end = turned(theta, radius + 2), turned(theta, 172)
    panel.line(start, end, colour="#a07030", width=5)
    panel.dashed((0, 0), (170, 0))
    panel.arc((0, 0), 125, 0, theta)
    panel.text(134, 20, "theta", RED)
    panel.arrow((-44, 0), (-76, 0), "red")
    panel.text(-78, 10, "aim", RED, 13)
    panel.text(60, 100, "from the side", GREY, 13, "middle")
    return panel


def cut():
    """A cut above 0: the object ball goes to the left of the cue ball's path."""
    panel = Panel(375, 402)
    radius, angle = 28, 35.0
    line = turned(90 + angle, 2 * radius)
    panel.dashed((0, 0), (0, 112))
    panel.arrow((0, -66), (0, -radius - 2), "red")
    panel.circle(0, 0, radius, BALL)
    panel.circle(*line, radius, OBJECT_BALL)
    far = turned(90 + angle, 138)
    panel.arrow(line, far, "red")
    panel.arc((0, 0), 96, 90, 90 + angle)
    panel.text(-40, 98, "cut", RED)
    panel.text(0, 128, "cut &gt; 0, from above", GREY, 13, "middle")
    return panel


def collision():
    """The axes of a collision, and the impulses on both balls."""
    panel = Panel(600, 330)
    radius = 52
    y_axis = (1.0, 0.0)
    x_axis = (y_axis[1], -y_axis[0])  # y cross z, with z towards the reader
    panel.text(0, 84, "impulses, from above", GREY, 13, "middle")
    panel.circle(-radius, 0, radius, BALL)
    panel.circle(radius, 0, radius, OBJECT_BALL)
    panel.text(-radius - 22, 24, "i")
    panel.text(radius + 20, 24, "j")
    panel.arrow((0, 0), (-64 * y_axis[0], -64 * y_axis[1]), "red")
    panel.arrow((0, 0), (64 * y_axis[0], 64 * y_axis[1]), "red")
    panel.text(-78, -18, "-ΔP", RED)
    panel.text(46, -18, "ΔP", RED)
    panel.arrow((-6, 0), (-6 + 50 * x_axis[0], 50 * x_axis[1]), "blue")
    panel.arrow((6, 0), (6 - 50 * x_axis[0], -50 * x_axis[1]), "blue")
    panel.text(-14, -67, "ΔP₁", BLUE, 14, "end")
    panel.text(14, 58, "-ΔP₁", BLUE)
    panel.towards_reader(-20, 14, BLUE)
    panel.away_from_reader(20, -14, BLUE)
    panel.text(-32, 26, "ΔP₂", BLUE, 14, "end")
    panel.text(16, -38, "-ΔP₂", BLUE)
    corner = (-116, -66)
    panel.arrow(corner, (corner[0] + 40 * y_axis[0], corner[1] + 40 * y_axis[1]))
    panel.arrow(corner, (corner[0] + 40 * x_axis[0], corner[1] + 40 * x_axis[1]))
    panel.text(corner[0] + 44, corner[1] - 5, "y")
    panel.text(corner[0] - 4, corner[1] - 55, "x")
    panel.towards_reader(*corner, INK)
    panel.text(corner[0] - 18, corner[1] + 5, "z")
    return panel


def drawing():
    width, height = SIZE
    parts = [part for make in (table, tip, elevation, cut, collision) for part in make().parts]
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" width="{width}"'
        f' height="{height}" font-family="sans-serif">\n'
        "<title>Axes, aim, tip, elevation, cut and impulses, with their signs</title>\n"
        f"<defs>\n{MARKERS}</defs>\n"
        f'<rect width="{width}" height="{height}" fill="#fff"/>\n' + "\n".join(parts) + "\n</svg>\n"
    )


if __name__ == "__main__":
    Path(sys.argv[1]).write_text(drawing(), encoding="utf-8")
