"""Pictures of a table and a shot as SVG: still, with the balls' paths, and moving."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from carom import dtypes

if TYPE_CHECKING:
    from carom.layouts import Table
    from carom.results import Shot

_SCALE = 300.0  # pixels a metre
MARGIN = 0.12  # m around the cushions, for pockets and the frame
CLOTH, CUSHION, WOOD, POCKET = "#2e7d5b", "#1b5e42", "#6d4c33", "#111111"
# The balls in the order of the layout: the cue ball, then 1 to 15 in the colours of pool, and again.
_COLOURS = (
    "#ffffff #f2c200 #1f4fd8 #d32f2f #6a1b9a #ef6c00 #2e9b3a #7b1c1c #222222 #f7dc6f #7fa3f5 #ef8a8a #b58ad4 #f7b27a #8fd19a #c58a8a"
).split()
_PATH_POINTS = 400
_DOT = 0.005  # m: radius of a place seen
_FRAMES_A_SECOND = 25
_FRAMES_MOST = 1500


@dataclass(frozen=True)
class Animation:
    """A moving picture: `svg` is its text, which moves in any browser."""

    svg: str

    def _repr_html_(self) -> str:
        return self.svg


def _number(x: float) -> str:
    """A length in pixels, to a hundredth."""
    return f"{x:.2f}".rstrip("0").rstrip(".")


@dataclass(frozen=True)
class Picture:
    """A picture: `svg` is its text."""

    svg: str

    def _repr_svg_(self) -> str:
        return self.svg


class _Canvas:
    """Metres of the table to pixels of the picture, with y upwards."""

    def __init__(self, table: Table) -> None:
        ends = np.concatenate([table.rails["p"], table.rails["q"]]) if len(table.rails) else np.zeros((1, 2))
        corners = np.array([[0.0, 0.0], [table.width, table.length]])
        everything = np.concatenate([ends, corners])
        self.low = everything.min(axis=0) - MARGIN
        self.high = everything.max(axis=0) + MARGIN
        self.size = (self.high - self.low) * _SCALE

    def x(self, x: float) -> str:
        return _number((x - float(self.low[0])) * _SCALE)

    def y(self, y: float) -> str:
        return _number((float(self.high[1]) - y) * _SCALE)

    def point(self, r: dtypes.Doubles) -> str:
        return f"{self.x(float(r[0]))},{self.y(float(r[1]))}"

    def circle(self, centre: dtypes.Doubles, radius: float, rest: str, inside: str = "") -> str:
        place = f'cx="{self.x(float(centre[0]))}" cy="{self.y(float(centre[1]))}" r="{_number(radius * _SCALE)}"'
        return f"<circle {place} {rest}>{inside}</circle>" if inside else f"<circle {place} {rest}/>"

    def document(self, parts: list[str]) -> str:
        width, height = _number(float(self.size[0])), _number(float(self.size[1]))
        head = f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" width="{width}" height="{height}">'
        return "\n".join([head, f'<rect width="{width}" height="{height}" rx="12" fill="{WOOD}"/>', *parts, "</svg>", ""])


def _table(canvas: _Canvas, table: Table) -> list[str]:
    corner = f'x="{canvas.x(0.0)}" y="{canvas.y(table.length)}"'
    size = f'width="{_number(table.width * _SCALE)}" height="{_number(table.length * _SCALE)}"'
    parts = [f'<rect {corner} {size} fill="{CLOTH}"/>']
    parts += [canvas.circle(pocket["centre"], float(pocket["radius"]), f'fill="{POCKET}"') for pocket in table.pockets]
    parts += [
        f'<polyline points="{canvas.point(rail["p"])} {canvas.point(rail["q"])}" stroke="{CUSHION}" stroke-width="4" fill="none"/>'
        for rail in table.rails
    ]
    parts += [canvas.circle(jaw["centre"], float(jaw["radius"]), f'fill="{CUSHION}"') for jaw in table.jaws]
    return parts


def colour(ball: int) -> str:
    return _COLOURS[ball] if ball < len(_COLOURS) else _COLOURS[1 + (ball - 1) % (len(_COLOURS) - 1)]


def picture(table: Table, shot: Shot | None = None, seen: Sequence[dtypes.Doubles] = ()) -> str:
    """A table, and a shot's paths with the balls where they begin (faint) and end, as the text of an SVG.

    `seen` are places of each ball, shapes (..., 2), that are drawn as dots.
    """
    canvas = _Canvas(table)
    parts = _table(canvas, table)
    if shot is not None:
        # Paths are parabolas between events, so the events' times are among those looked at.
        times = np.union1d(np.linspace(0.0, shot.time, _PATH_POINTS), shot.events["time"])
        paths = shot.positions(times) if shot.count <= len(shot.events) else np.zeros((0, len(shot.balls), 3))
        for ball in range(len(shot.balls)):
            points = list(dict.fromkeys(canvas.point(r) for r in paths[:, ball]))
            if len(points) > 1:
                line = f'points="{" ".join(points)}" stroke="{colour(ball)}" stroke-width="1.5" stroke-opacity="0.8" fill="none"'
                parts.append(f"<polyline {line}/>")
        for states, opacity in ((shot.balls["state"], 0.35), (shot.final, 1.0)):
            for ball, state in enumerate(states):
                style = f'fill="{colour(ball)}" fill-opacity="{opacity}" stroke="#000" stroke-width="0.5"'
                parts.append(canvas.circle(state["r"], float(shot.balls["kind"]["radius"][ball]), style))
    for ball, places in enumerate(seen):
        parts += [canvas.circle(r, _DOT, f'fill="{colour(ball)}" stroke="#000" stroke-width="0.3"') for r in places]
    return canvas.document(parts)


def animation(shot: Shot, speed: float) -> Animation:
    """The shot as an SVG that moves and repeats, `speed` times as fast as the balls."""
    if not speed > 0.0:
        raise ValueError(f"speed: must be positive, not {speed}")
    frames = int(min(max(shot.time / speed * _FRAMES_A_SECOND, 2.0), _FRAMES_MOST))
    paths = shot.positions(np.linspace(0.0, shot.time, frames))
    canvas = _Canvas(shot.table)
    parts = _table(canvas, shot.table)
    duration = f'dur="{max(shot.time / speed, 0.01):.4g}s" repeatCount="indefinite"'
    for ball in range(len(shot.balls)):
        xs = [canvas.x(float(x)) for x in paths[:, ball, 0]]
        ys = [canvas.y(float(y)) for y in paths[:, ball, 1]]
        moves = "".join(
            f'<animate attributeName="{name}" values="{";".join(values)}" {duration}/>'
            for name, values in (("cx", xs), ("cy", ys))
            if len(set(values)) > 1
        )
        style = f'fill="{colour(ball)}" stroke="#000" stroke-width="0.5"'
        parts.append(canvas.circle(paths[0, ball], float(shot.balls["kind"]["radius"][ball]), style, moves))
    return Animation(canvas.document(parts))
