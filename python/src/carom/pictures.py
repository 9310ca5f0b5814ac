"""Pictures of a table and a shot: as SVG, still, with the balls' paths, or moving; and as pixels.

They are drawn for `carom.Table` and `carom.Shot`, which import this module; so these have no types
here.
"""

from __future__ import annotations

import html
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom import _palette
from carom._rows import listing, needed, number
from carom.dtypes import Doubles

__all__ = ["Animation", "Picture"]
__dir__ = listing(__name__)

_SCALE = 300.0  # pixels a metre
_RIM = 1.2  # pixels: the line around a ball
_HALF_BAND = 0.66  # half the width of the band around a striped ball, in radii
_LONGEST_POOL = 3.0  # m: longer tables with pockets are those of snooker and pyramid
_PYRAMID = 0.0335  # m: balls of this radius and larger are those of pyramid
_SOLIDS = 8
_PATH_POINTS = 400
_DOT = 0.008  # m: radius of a place seen
_FRAMES_A_SECOND = 25
_FRAMES_MOST = 1500


@dataclass(frozen=True, repr=False)
class Picture:
    """A picture: `svg` is its text."""

    svg: str

    def _repr_html_(self) -> str:
        return self.svg

    def __repr__(self) -> str:
        return f"<carom.{type(self).__name__}: an SVG of {len(self.svg)} characters, in .svg>"


class Animation(Picture):
    """A moving picture: `svg` is its text, which moves in any browser."""


def _number(x: float) -> str:
    """A length in pixels, to a hundredth."""
    return f"{x:.2f}".rstrip("0").rstrip(".")


class _Canvas:
    """Metres of the table to pixels of the picture."""

    def __init__(self, table: Any) -> None:
        ends = (
            np.concatenate([table.rails["p"], table.rails["q"]])
            if len(table.rails)
            else np.zeros((1, 2))
        )
        corners = np.array([[0.0, 0.0], [table.width, table.length]])
        everything = np.concatenate([ends, corners])
        self.low, self.high = everything.min(axis=0), everything.max(axis=0)
        self.margin = _palette.SIZE["margin"] * float((self.high - self.low).max())
        self.low, self.high = self.low - self.margin, self.high + self.margin
        self.letters = _palette.SIZE["letters"] * float((self.high - self.low).max()) * _SCALE
        self.discipline = _discipline(table)
        size = (self.high - self.low) * _SCALE
        self.turned = bool(
            size[1] > size[0]
        )  # a long table lies on its side: y to the right, x downwards
        self.size = size[::-1] if self.turned else size

    def place(self, r: ArrayLike) -> tuple[float, float]:
        """A point of the table on the picture, in pixels."""
        x, y = (float(value) for value in np.asarray(r)[:2])
        right, down = (
            (y - self.low[1], x - self.low[0])
            if self.turned
            else (x - self.low[0], self.high[1] - y)
        )
        return float(right) * _SCALE, float(down) * _SCALE

    def point(self, r: ArrayLike) -> str:
        return ",".join(map(_number, self.place(r)))

    def circle(self, centre: ArrayLike, radius: float, rest: str) -> str:
        x, y = map(_number, self.place(centre))
        return f'<circle cx="{x}" cy="{y}" r="{_number(radius * _SCALE)}" {rest}/>'

    def start(self, shot: Any, number: int) -> str:
        """Where a ball of a shot begins: a dashed circle in the colour of its path."""
        (place,) = (self.point(r) for r in shot.balls["state"]["r"][number][np.newaxis])
        radius = _number(float(shot.balls["kind"]["radius"][number]) * _SCALE)
        style = f'fill="none" stroke="{looks_of(shot)[number].path}" stroke-dasharray="3 2"'
        return f'<g transform="translate({place})"><circle r="{radius}" {style}/></g>'

    def ball(self, shot: Any, number: int, places: Doubles, duration: str = "") -> str:
        """A ball of a shot, with its number unless it is the first: at a place, or moving over
        several, shape (n, 3).
        """
        points = [self.point(r) for r in places]
        radius = float(shot.balls["kind"]["radius"][number]) * _SCALE
        look = looks_of(shot)[number]
        fill = _palette.PART["text"] if look.striped else look.colour
        style = f'fill="{fill}" stroke="{look.path}" stroke-width="{_RIM}"'
        parts = [f'<g transform="translate({points[0]})"><circle r="{_number(radius)}" {style}/>']
        if look.striped:
            parts.append(_stripe(radius - 0.5 * _RIM, look.colour))
        if number > 0:
            size = min(self.letters, (1.9 if number < 10 else 1.5) * radius)
            text = f'y="{_number(0.36 * size)}" font-size="{_number(size)}" text-anchor="middle" font-family="sans-serif"'
            parts.append(f'<text {text} fill="{look.ink}">{number}</text>')
        if len(set(points)) > 1:
            values = ";".join(points)
            parts.append(
                f'<animateTransform attributeName="transform" type="translate" values="{values}" {duration}/>'
            )
        return "".join([*parts, "</g>"])

    def document(self, parts: list[str]) -> str:
        width, height = _number(float(self.size[0])), _number(float(self.size[1]))
        head = f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" width="{width}" height="{height}">'
        return "\n".join(
            [
                head,
                f'<rect width="{width}" height="{height}" rx="{_pixels("corner")}" fill="{_palette.WOOD[self.discipline]}"/>',
                *parts,
                "</svg>",
                "",
            ]
        )


def _diamonds(canvas: _Canvas, table: Any) -> list[NDArray[np.float64]]:
    """Places of the diamonds: the long cushions in eight parts, the short ones in four. None is
    where a pocket is.
    """
    lengths = np.hypot(*(table.rails["q"] - table.rails["p"]).T)
    cushions = table.rails[lengths > 0.2 * lengths.max()] if len(lengths) else table.rails
    if len(cushions) == 0:
        return []
    ends = np.concatenate([cushions["p"], cushions["q"]])
    low, high = ends.min(axis=0), ends.max(axis=0)
    along = int(high[1] - low[1] > high[0] - low[0])
    edges = canvas.low + 0.25 * canvas.margin, canvas.high - 0.25 * canvas.margin
    places = []
    for axis, parts in ((along, 8), (1 - along, 4)):
        for k in range(1, parts):
            if axis == along and k == 4 and len(table.pockets) > 0:
                continue
            for edge in edges:
                place = edge.copy()
                place[axis] = low[axis] + (high[axis] - low[axis]) * k / parts
                places.append(place)
    return places


def _table(canvas: _Canvas, table: Any) -> list[str]:
    inset, (width, height) = 0.5 * canvas.margin * _SCALE, canvas.size
    size = f'width="{_number(width - 2.0 * inset)}" height="{_number(height - 2.0 * inset)}"'
    corner = f'x="{_number(inset)}" y="{_number(inset)}" rx="{_pixels("bed_corner")}"'
    parts = [f'<rect {corner} {size} fill="{_palette.CLOTH[canvas.discipline]}"/>']
    parts += [
        canvas.circle(
            pocket["centre"], float(pocket["radius"]), f'fill="{_palette.PART["pocket"]}"'
        )
        for pocket in table.pockets
    ]
    parts += [
        canvas.circle(
            jaw["centre"], float(jaw["radius"]), f'fill="{_palette.CUSHION[canvas.discipline]}"'
        )
        for jaw in table.jaws
    ]
    line = f'stroke="{_palette.PART["nose"]}" stroke-width="{_pixels("nose")}" stroke-linecap="round" fill="none"'
    parts += [
        f'<polyline points="{canvas.point(rail["p"])} {canvas.point(rail["q"])}" {line}/>'
        for rail in table.rails
    ]
    tall, wide = (_palette.SIZE[name] * _SCALE for name in ("diamond", "diamond_width"))
    for x, y in map(canvas.place, _diamonds(canvas, table)):
        corners = ((x, y - tall), (x + wide, y), (x, y + tall), (x - wide, y))
        points = " ".join(f"{_number(right)},{_number(down)}" for right, down in corners)
        parts.append(f'<polygon points="{points}" fill="{_palette.PART["mark"]}"/>')
    return parts


@dataclass(frozen=True)
class _Look:
    """The colours of a ball, of its path and of its number, and whether it is striped."""

    colour: str
    path: str
    ink: str
    striped: bool = False


_NAMED = {name: _Look(*colours) for name, colours in _palette.BALLS.items()}
_OF_POOL = list(_NAMED.values())[: _SOLIDS + 1]
_OF_CAROM = [_NAMED[name] for name in ("white", "yellow", "red", "red")]
_OF_SNOOKER = [
    _NAMED[name]
    for name in ["white", *15 * ["red"], "yellow", "green", "brown", "blue", "pink", "black"]
]


def _discipline(table: Any) -> str:
    """What is played on a table, by which it is coloured."""
    if len(table.pockets) == 0:
        return "carom"
    return "snooker" if table.length > _LONGEST_POOL else "pool"


def _of_pool(ball: int) -> _Look:
    if ball <= _SOLIDS:
        return _OF_POOL[ball]
    solid = _OF_POOL[1 + (ball - 1) % _SOLIDS]
    return _Look(solid.colour, solid.path, solid.ink, striped=(ball - 1) // _SOLIDS % 2 == 1)


def _looks(table: Any, count: int, radius: float) -> list[_Look]:
    """How the balls look, by their order on the table: the racks of carom and of snooker, and else
    the balls of pool by number.
    """
    if radius >= _PYRAMID:
        return [_NAMED["yellow"], *(count - 1) * [_NAMED["white"]]]
    for discipline, looks in (("carom", _OF_CAROM), ("snooker", _OF_SNOOKER)):
        if _discipline(table) == discipline and count in (3, len(looks)):
            return looks[:count]
    return [_of_pool(ball) for ball in range(count)]


def looks_of(shot: Any) -> list[_Look]:
    """How the balls of a shot look."""
    radii = shot.balls["kind"]["radius"]
    return _looks(shot.table, len(radii), float(radii[0]) if len(radii) else 0.0)


def _pixels(size: str) -> str:
    return _number(_palette.SIZE[size] * _SCALE)


def _stripe(radius: float, ink: str) -> str:
    """The band around a striped ball, as it is seen from the side of its number."""
    high = _HALF_BAND * radius
    wide = float(np.sqrt(radius * radius - high * high))
    r, x, y = map(_number, (radius, wide, high))
    return f'<path d="M-{x} -{y}H{x}A{r} {r} 0 0 1 {x} {y}H-{x}A{r} {r} 0 0 1 -{x} -{y}Z" fill="{ink}"/>'


def _paths(shot: Any) -> Doubles:
    """Places of the balls of a shot, (n, balls, 3).

    Paths are parabolas between events, so the events' times are among those looked at.
    """
    times = np.union1d(np.linspace(0.0, shot.time, _PATH_POINTS), shot.events["time"])
    paths: Doubles = (
        shot.positions(times)
        if shot.count <= len(shot.events)
        else np.zeros((0, len(shot.balls), 3))
    )
    return paths


def picture(
    table: Any,
    shot: Any = None,
    seen: Sequence[Doubles] = (),
    marks: Sequence[tuple[ArrayLike, float, str, str]] = (),
) -> str:
    """A table, and a shot's paths with the balls where they begin (dashed circles) and end, as the
    text of an SVG. Paths of striped balls are dashed.

    `seen` are places of each ball, shapes (..., 2), that are drawn as dots. `marks` are circles:
    place, radius (m), a text for a pointer that rests on it, and a text beside it.
    """
    canvas = _Canvas(table)
    parts = _table(canvas, table)
    if shot is not None:
        paths = _paths(shot)
        parts += [canvas.start(shot, ball) for ball in range(len(shot.balls))]
        for ball, look in enumerate(looks_of(shot)):
            points = list(dict.fromkeys(canvas.point(r) for r in paths[:, ball]))
            if len(points) > 1:
                dashes = ' stroke-dasharray="12 2.5"' if look.striped else ""
                line = f'points="{" ".join(points)}" stroke="{look.path}" stroke-width="{_pixels("path")}" fill="none"{dashes}'
                parts.append(f"<polyline {line}/>")
        parts += [
            canvas.ball(shot, ball, state["r"][np.newaxis]) for ball, state in enumerate(shot.final)
        ]
    for look, places in zip(_looks(table, len(seen), 0.0), seen):
        style = f'fill="{look.path}" stroke="{_palette.PART["nose"]}" stroke-width="0.5"'
        parts += [canvas.circle(r, _DOT, style) for r in places]
    texts: list[tuple[float, float]] = []
    for place, size, label, side in marks:
        x, y = canvas.place(place)
        circle = canvas.circle(
            place,
            size,
            f'fill="none" stroke="{_palette.PART["aim"]}" stroke-width="1.5" pointer-events="all"',
        )
        # the text lies towards the middle of the picture, below others
        anchor, x = (
            ("start", x + size * _SCALE) if x < 0.5 * canvas.size[0] else ("end", x - size * _SCALE)
        )
        while side and any(
            abs(x - x_of_text) < 9.0 * canvas.letters and abs(y - below) < canvas.letters
            for x_of_text, below in texts
        ):
            y += canvas.letters
        texts += [(x, y)] if side else []
        text = f'<text x="{_number(x)}" y="{_number(y)}" text-anchor="{anchor}" font-size="{_number(canvas.letters)}" font-family="sans-serif" fill="{_palette.PART["text"]}">'
        parts.append(
            f"<g><title>{html.escape(label)}</title>{circle}{text}{html.escape(side)}</text></g>"
        )
    return canvas.document(parts)


def animation(shot: Any, speed: float) -> Animation:
    """The shot as an SVG that moves and repeats, `speed` times as fast as the balls."""
    if not (speed := number(speed, "speed")) > 0.0:
        raise ValueError(f"speed: must be positive, not {speed}")
    frames = int(min(max(shot.time / speed * _FRAMES_A_SECOND, 2.0), _FRAMES_MOST))
    paths = shot.positions(np.linspace(0.0, shot.time, frames))
    canvas = _Canvas(shot.table)
    parts = _table(canvas, shot.table)
    duration = f'dur="{max(shot.time / speed, 0.01):.4g}s" repeatCount="indefinite"'
    parts += [
        canvas.ball(shot, ball, paths[:, ball], duration=duration)
        for ball in range(len(shot.balls))
    ]
    return Animation(canvas.document(parts))


def plot(table: Any, shot: Any, ax: Any) -> Any:
    """What `picture` draws, on axes of matplotlib, whose numbers are metres."""
    matplotlib = needed("matplotlib.pyplot", "plot()")
    patches = needed("matplotlib.patches", "plot()")
    ax = matplotlib.gca() if ax is None else ax
    cloth, cushion = (kind[_discipline(table)] for kind in (_palette.CLOTH, _palette.CUSHION))
    ax.add_patch(patches.Rectangle((0.0, 0.0), table.width, table.length, color=cloth, zorder=0))
    for part, ink in ((table.pockets, _palette.PART["pocket"]), (table.jaws, cushion)):
        for piece in part:
            ax.add_patch(patches.Circle(piece["centre"], piece["radius"], color=ink, zorder=1))
    for rail in table.rails:
        ax.plot(*zip(rail["p"], rail["q"]), color=_palette.PART["nose"], linewidth=3, zorder=1)
    if shot is not None:
        paths = _paths(shot)
        radii = shot.balls["kind"]["radius"]
        for ball, look in enumerate(looks_of(shot)):
            dashes = (0, (8, 2)) if look.striped else "-"
            ax.plot(
                paths[:, ball, 0],
                paths[:, ball, 1],
                color=look.path,
                linestyle=dashes,
                linewidth=1.0,
                zorder=2,
            )
            for states, opacity in ((shot.balls["state"], 0.35), (shot.final, 1.0)):
                place = states["r"][ball, :2]
                ax.add_patch(
                    patches.Circle(
                        place,
                        radii[ball],
                        facecolor=look.colour,
                        edgecolor=look.path,
                        alpha=opacity,
                        zorder=3,
                    )
                )
    ax.set_aspect("equal")
    ax.set_xlabel("x, m")
    ax.set_ylabel("y, m")
    return ax


# ---- Pixels
# ---------------------------------------------------------------------------------------------------------------

# The digits of the balls, 3 pixels wide and 5 high: a row of each is a number of three bits.
_DIGITS = [
    [int(row) for row in digit]
    for digit in [
        "75557",
        "26227",
        "71747",
        "71717",
        "55711",
        "74717",
        "74757",
        "71111",
        "75757",
        "75717",
    ]
]


class _Pixels:
    """An image of red, green and blue, to which shapes are added with smooth edges."""

    def __init__(self, canvas: _Canvas) -> None:
        self.canvas = canvas
        # even numbers, as films have them
        width, height = (2 * int(np.ceil(size / 2.0)) for size in canvas.size)
        self.image: NDArray[np.float64] = np.empty((height, width, 3))
        self.image[:] = _colour(_palette.WOOD[canvas.discipline])

    def _cover(self, low: Doubles, high: Doubles, distance: Any, ink: str, opacity: float) -> None:
        """Paints the pixels of a box, pixels, by how far they are outside a shape: distance(x, y)."""
        height, width = self.image.shape[:2]
        x_0, y_0 = (int(max(np.floor(value) - 1.0, 0.0)) for value in low)
        x_1, y_1 = (
            int(min(np.ceil(value) + 2.0, size)) for value, size in zip(high, (width, height))
        )
        if x_0 >= x_1 or y_0 >= y_1:
            return
        x, y = np.arange(x_0, x_1) + 0.5, (np.arange(y_0, y_1) + 0.5)[:, np.newaxis]
        cover = opacity * np.clip(0.5 - distance(x, y), 0.0, 1.0)[..., np.newaxis]
        part = self.image[y_0:y_1, x_0:x_1]
        part += cover * (_colour(ink) - part)

    def disc(self, centre: ArrayLike, radius: float, ink: str, opacity: float = 1.0) -> None:
        """A disc of a radius in pixels at a place of the table."""
        point = np.array(self.canvas.place(centre))
        self._cover(
            point - radius,
            point + radius,
            lambda x, y: np.hypot(x - point[0], y - point[1]) - radius,
            ink,
            opacity,
        )

    def line(
        self, p: ArrayLike, q: ArrayLike, width: float, ink: str, opacity: float = 1.0
    ) -> None:
        """A line of a width in pixels between two places of the table."""
        a, b = np.array(self.canvas.place(p)), np.array(self.canvas.place(q))
        along = b - a
        square = max(float(along @ along), 1e-12)

        def distance(x: Any, y: Any) -> Any:
            share = np.clip(((x - a[0]) * along[0] + (y - a[1]) * along[1]) / square, 0.0, 1.0)
            return np.hypot(x - a[0] - share * along[0], y - a[1] - share * along[1]) - 0.5 * width

        self._cover(np.minimum(a, b) - width, np.maximum(a, b) + width, distance, ink, opacity)

    def ball(self, shot: Any, number: int, centre: Doubles, opacity: float) -> None:
        """A ball, with its number unless it is the first."""
        radius = float(shot.balls["kind"]["radius"][number]) * _SCALE
        look = looks_of(shot)[number]
        self.disc(centre, radius, look.path, opacity)
        self.disc(centre, radius - _RIM, look.colour, opacity)
        if number == 0 or opacity < 1.0:
            return
        digits = [_DIGITS[int(digit)] for digit in str(number)]
        x_0, y_0 = (
            int(round(value))
            for value in np.array(self.canvas.place(centre)) - [2.0 * len(digits) - 0.5, 2.5]
        )
        for k, digit in enumerate(digits):
            for row, bits in enumerate(digit):
                for column in (column for column in range(3) if bits >> (2 - column) & 1):
                    x, y = x_0 + 4 * k + column, y_0 + row
                    if 0 <= y < self.image.shape[0] and 0 <= x < self.image.shape[1]:
                        self.image[y, x] = _colour(look.ink)


def _colour(ink: str) -> Doubles:
    return np.array([int(ink[k : k + 2], 16) for k in (1, 3, 5)], np.float64)


RENDER_MODES = ("svg", "rgb_array")
"""How environments are drawn: as the text of an SVG, or as an image."""


def check_render_mode(mode: object) -> None:
    """Refuses what is no way to draw an environment."""
    if mode is not None and mode not in RENDER_MODES:
        raise ValueError(f"render_mode: must be None, 'svg' or 'rgb_array', not {mode!r}")


def rendered(shot: Any, mode: str) -> Any:
    """A shot, as a render mode says."""
    return picture(shot.table, shot) if mode == "svg" else pixels(shot.table, shot)


def pixels(table: Any, shot: Any = None) -> NDArray[np.uint8]:
    """What `picture` draws as an image, of shape (height, width, 3): red, green and blue, both
    sizes even.
    """
    canvas = _Canvas(table)
    drawn = _Pixels(canvas)
    inset = 0.5 * canvas.margin * _SCALE
    low, high = np.full(2, inset), np.asarray(canvas.size) - inset
    drawn._cover(
        low,
        high,
        lambda x, y: np.maximum(
            np.maximum(low[0] - x, x - high[0]), np.maximum(low[1] - y, y - high[1])
        ),
        _palette.CLOTH[canvas.discipline],
        1.0,
    )
    for pocket in table.pockets:
        drawn.disc(pocket["centre"], float(pocket["radius"]) * _SCALE, _palette.PART["pocket"])
    for jaw in table.jaws:
        drawn.disc(
            jaw["centre"], float(jaw["radius"]) * _SCALE, _palette.CUSHION[canvas.discipline]
        )
    nose = _palette.SIZE["nose"] * _SCALE
    for rail in table.rails:
        drawn.line(rail["p"], rail["q"], nose, _palette.PART["nose"])
    tall = _palette.SIZE["diamond"] * _SCALE
    for place in _diamonds(canvas, table):
        drawn.disc(place, 0.8 * tall, _palette.PART["mark"])
    if shot is not None:
        paths = _paths(shot)
        for ball, look in enumerate(looks_of(shot)):
            last = paths[:1, ball].reshape(-1)
            for k, place in enumerate(paths[:, ball]):
                gap = np.abs(place[:2] - last[:2]).max() * _SCALE
                if gap > 3.0 or (k == len(paths) - 1 and gap > 0.0):  # pixels
                    drawn.line(last, place, _palette.SIZE["path"] * _SCALE, look.path)
                    last = place
        for states, opacity in ((shot.balls["state"], 0.35), (shot.final, 1.0)):
            for ball, state in enumerate(states):
                drawn.ball(shot, ball, state["r"], opacity)
    return np.rint(drawn.image).astype(np.uint8)
