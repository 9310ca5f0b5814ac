"""What `Match` offers beyond its rules: its words, its pictures and its file."""

from __future__ import annotations

import dataclasses
import html
import os
from pathlib import Path
from typing import Any

import numpy as np

from carom import animations, pictures
from carom.dtypes import event
from carom.results import Shot
from carom.status import Status


class MatchVerbs:
    """The part of `Match`."""

    def save(self: Any, path: str | os.PathLike[str]) -> None:
        """Write the recording so far to a file, which `carom.load` and `Match.load` read.

        `carom verify` also demands the last line, which `end()` adds to a match that is over.
        """
        Path(path).write_text("".join(self.lines), encoding="utf-8", newline="\n")

    def __repr__(self: Any) -> str:
        rules = self.rules if isinstance(self.rules, str) else type(self.rules).__name__
        names = [seat.name or f"seat {k}" for k, seat in enumerate(self.seats)]
        strokes = int(self._c.record.shots)
        count = f"{strokes} stroke{'' if strokes == 1 else 's'}"
        return f"<carom.Match: {rules}, {' - '.join(names)}, {count}, {self.words}>"

    def _seen(self: Any) -> Shot:
        """The last shot, with the balls where they are now; without one, the layout."""
        last: Shot | None = self.shot
        balls = self.balls
        if last is not None and last.status >= 0:
            moving = self.phase == "moving"
            return last if moving else dataclasses.replace(last, final=balls["state"])
        none = np.zeros(0, event)
        options = self.options
        return Shot(self.table, balls, Status.OK, 0.0, 1, none, balls["state"], None, options)

    def _repr_html_(self: Any) -> str:
        svg = pictures.picture(self.table, self._seen())
        return f"<figure>{svg}<figcaption>{html.escape(self.words)}</figcaption></figure>"

    def show(self: Any, speed: float = 1.0) -> None:
        """Show the last shot as a moving picture, or the layout before the first one, with what the
        match waits for: in the notebook's cell, or in a browser.

        Parameters
        ----------
        speed : float
            How many times as fast as the balls.
        """
        seen = self._seen()
        has_moved = seen.time > 0.0
        moving = animations.animated(seen, speed).svg if has_moved else None
        svg = moving or pictures.picture(self.table, seen)
        animations.show([(svg, repr(self))], "A match")
