"""Names of balls from their colours.

The colours in a film are first scaled so that the cue ball, the brightest ball without a colour, is
white, and then compared with the colours of a game's balls. Each name is assigned once, to the
nearest colour first.
"""

from __future__ import annotations

import cv2
import numpy as np

from carom.dtypes import Doubles

_SNOOKER = {
    "yellow": "#e6c828",
    "green": "#006e46",
    "brown": "#78411e",
    "blue": "#1e46b4",
    "pink": "#f08ca0",
    "black": "#191919",
}
_WHITE, _RED = "#f5ebd7", "#b4141e"
# of the balls of each kind of table: the colour, and how many balls have it
_KINDS: dict[str, dict[str, tuple[str, int]]] = {
    "snooker": {"cue": (_WHITE, 1), "red": (_RED, 15)} | {k: (v, 1) for k, v in _SNOOKER.items()},
    "blackball": {
        "cue": (_WHITE, 1),
        "red": (_RED, 7),
        "yellow": ("#e6c828", 7),
        "black": ("#191919", 1),
    },
    "threecushion": {"white": (_WHITE, 1), "yellow": ("#e6c828", 1), "red": (_RED, 1)},
    "fourball": {"white": (_WHITE, 1), "yellow": ("#e6c828", 1), "red": (_RED, 2)},
    "pyramid": {"cue": ("#e6c828", 1), "white": (_WHITE, 15)},
}
# 1 to 8 of pool, as cameras see them
_NUMBERED = ["#f2c200", "#1f4fd8", "#d32f2f", "#6a1b9a", "#ef6c00", "#2e9b3a", "#7b1c1c", "#222222"]
_POOL = {"cue": (_WHITE, 1)} | {str(k): (seen, 1) for k, seen in enumerate(_NUMBERED, start=1)}
_STRIPED = 0.2, 0.9  # share of white of a ball of pool between which it is striped
_MOSTLY = 0.5  # share of white of a white ball, at least
_STRANGE = 75.0  # a colour that is farther from all is named "ball"


def _lab(colours: Doubles) -> Doubles:
    """L, a and b of blue, green and red, (n, 3)."""
    image = np.clip(colours, 0.0, 255.0).astype(np.float32)[None] / 255.0
    return np.asarray(cv2.cvtColor(image, cv2.COLOR_BGR2LAB)[0], np.float64)


def _ink(text: str) -> Doubles:
    return np.array([int(text[k : k + 2], 16) for k in (5, 3, 1)], np.float64)


def kinds_of(table: str) -> dict[str, tuple[str, int]]:
    """The names of the balls of a table, with their colours and how many balls have each."""
    return _KINDS.get(table, _POOL)


def names_of(
    table: str, colours: Doubles, whites: Doubles, lengths: Doubles, struck: int | None = None
) -> list[str]:
    """Name the balls that are visible at one time.

    Uses their colours (n, 3), fractions of white, and for how long each was seen: of two similar
    balls, the one seen longer receives the name. The struck ball, if it is known and more white
    than not, is the cue ball: a camera may see a striped ball as white as it.
    """
    if not len(colours):
        return []
    kinds = kinds_of(table)
    brightness = colours.mean(axis=1)
    # the cue ball shows the light
    plain = (np.ptp(colours, axis=1) < 0.45 * colours.max(axis=1)) & (whites > _MOSTLY)
    light = np.array([255.0, 255.0, 255.0])
    if plain.any():
        light = colours[np.flatnonzero(plain)[brightness[plain].argmax()]] / 0.93
    seen = _lab(colours / light * 255.0)
    wanted = _lab(np.array([_ink(ink) for ink, _ in kinds.values()]))
    costs = np.sqrt(((seen[:, None] - wanted) ** 2 * [0.35, 1.0, 1.0]).sum(axis=2))
    if struck is not None and "cue" in kinds and whites[struck] > _MOSTLY:
        cue = list(kinds).index("cue")
        costs[:, cue], costs[struck, cue] = np.inf, -np.inf
    short = 40.0 * (1.0 - lengths / max(lengths.max(initial=0.0), 1.0))
    keys = list(kinds)
    if kinds is _POOL:
        return _pool(costs, keys, whites, short)
    names = [""] * len(colours)
    left = {name: count for name, (_, count) in kinds.items()}
    for flat in np.argsort(costs + short[:, None], axis=None):
        ball, kind = divmod(int(flat), len(keys))
        name, count = keys[kind], kinds[keys[kind]][1]
        if names[ball] or not left[name] or costs[ball, kind] > _STRANGE:
            continue
        left[name] -= 1
        names[ball] = name if count == 1 else f"{name}{count - left[name]}"
    return _filled(names)


def _pool(costs: Doubles, keys: list[str], whites: Doubles, short: Doubles) -> list[str]:
    """Numbers of pool balls: a stripe contains white and has the colour of the number minus 8."""
    names = [""] * len(costs)
    striped = (whites > _STRIPED[0]) & (whites < _STRIPED[1]) & (costs[:, 0] > -np.inf)
    for flat in np.argsort(costs + short[:, None], axis=None):
        ball, kind = divmod(int(flat), len(keys))
        name = keys[kind]
        if striped[ball]:
            name = str(kind + 8) if 1 <= kind <= 7 else ""
        if name and not names[ball] and name not in names and costs[ball, kind] <= _STRANGE:
            names[ball] = name
    return _filled(names)


def _filled(names: list[str]) -> list[str]:
    strangers = [k for k, name in enumerate(names) if not name]
    for number, k in enumerate(strangers, 1):
        names[k] = f"ball{number}"
    return names
