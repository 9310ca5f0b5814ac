"""What `Shot` and `Shots` offer beyond their numbers: files, pictures in a browser, first events,
potted balls, and tables of states.
"""

from __future__ import annotations

import importlib
import os
from collections.abc import Iterable
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom import animations, dtypes
from carom._described import Label
from carom._events import FirstEvents, first_events
from carom._events import potted as potted_balls
from carom._rows import needed, number
from carom.dtypes import Doubles

_ROWS_MOST = 100_000_000


class ShotVerbs:
    """The part of `Shot`."""

    def save(self: Any, path: str | os.PathLike[str]) -> None:
        """Write the shot to a file, which `carom.load` reads.

        The file is a recording (docs/reference/files.md): the table, the balls, the cue, the options
        and a hash of the result, by which `load` and `carom verify` check that they play the same
        shot. It contains no events, because they are computed again.

        Raises
        ------
        ValueError
            Playing the shot again results in other bits, because an array was changed.
        """
        importlib.import_module("carom.saved").save_shot(self, path)

    def show(self: Any, speed: float = 1.0) -> None:
        """Show the moving picture in the notebook's cell, or in a browser.

        Parameters
        ----------
        speed : float
            How many times as fast as the balls.
        """
        animations.show([(animations.animated(self, speed).svg, repr(self))], "A shot")

    def first(self: Any, kind: str, *, ball: int | None = None, after: float = -1.0) -> FirstEvents:
        """The first event of a kind, as `Shots.first` describes it; arrays of shape ()."""
        count = np.array(self.count)
        return first_events(self.events, count, kind, ball, after, len(self.balls))

    def potted(self: Any, ball: ArrayLike | None = None) -> NDArray[np.bool_]:
        """Whether balls were potted, as `Shots.potted` describes it; shape () for one ball."""
        return potted_balls(self.balls, self.final, ball)


class ShotsVerbs:
    """The part of `Shots`."""

    def save(self: Any, path: str | os.PathLike[str]) -> None:
        """Write the shots to a file, which `carom.load` reads.

        The file is a recording, as for `Shot.save`. It does not contain the shape of the batch:
        `carom.load(path, shape=...)` restores it. Each shot is played again for its hash.

        Raises
        ------
        ValueError
            A shot has an invalid argument and was not played: save `shots[~shots.refused]`. Or an
            array was changed since.
        """
        importlib.import_module("carom.saved").save_shots(self, path)

    def show(self: Any, speed: float = 1.0) -> None:
        """Show the moving pictures of up to 100 shots in the notebook's cell, or in a browser, where
        the arrow keys leaf through them.

        Parameters
        ----------
        speed : float
            How many times as fast as the balls.
        """
        animations.show_shots(self, speed)

    def first(
        self: Any, kind: str, *, ball: int | None = None, after: ArrayLike = -1.0
    ) -> FirstEvents:
        """The first event of a kind in each shot.

        Parameters
        ----------
        kind : str
            The name of a `carom.EventType` in lower case, such as "ball_ball" or
            "sliding_rolling".
        ball : int, optional
            Only events of this ball. `before` and `after` of the result are then its states;
            otherwise they are those of the event's ball a.
        after : array_like, shape (...)
            Only events later than these times, s.

        Returns
        -------
        FirstEvents
            Arrays of the shape of the batch: `index`, `time`, `other`, `before`, `after`, `event`.
            Where there is no such event, the index is -1, and numbers are NaN.

        Raises
        ------
        ValueError
            Not all events of a shot were kept, and none of those kept is of this kind.

        Examples
        --------
        >>> hits = shots.first("ball_ball", ball=0)
        >>> speeds = np.linalg.norm(hits.before["v"], axis=-1)
        """
        balls = self.final.shape[-1]
        return first_events(self.events, self.count, kind, ball, after, balls)

    def potted(self: Any, ball: ArrayLike | None = None) -> NDArray[np.bool_]:
        """Whether balls were potted in each shot: on the table at the start, in a pocket at the end.

        Parameters
        ----------
        ball : int or array_like of int, optional
            Indices of balls. Default: all balls.

        Returns
        -------
        ndarray of bool, shape (..., balls), or (...) for one ball

        Examples
        --------
        >>> shots.potted(1).mean()                     # the share of shots that pot ball 1
        >>> shots.potted()[..., 1:].sum(axis=-1)       # how many balls each shot pots
        """
        return potted_balls(self.layouts, self.final, ball)


def sampled_times(duration: float, dt: float, rows_per_time: int) -> Doubles:
    """Times from 0 on, `dt` apart, and the end."""
    step = number(dt, "dt", "a time in s")
    if not 0.0 < step < np.inf:
        raise ValueError(f"dt: it must be positive and finite, in s, not {step:g}")
    if duration / step * rows_per_time > _ROWS_MOST:
        raise ValueError(f"dt: {step:g} s results in more than {_ROWS_MOST} rows; raise dt")
    times = np.arange(0.0, duration, step)
    return np.append(times, duration)


def states_frame(shots: Any, dt: float, index: Iterable[str] = ()) -> Any:
    """A pandas DataFrame with a row for each time and ball, and for each shot of a batch."""
    pandas = needed("pandas", "to_dataframe()")
    shape = getattr(shots, "shape", ())
    balls = shots.final.shape[-1]
    duration = float(np.max(shots.time, initial=0.0))
    times = sampled_times(duration, dt, balls * int(np.prod(shape)))
    states = shots.states(times)
    codes = np.indices(states.shape).reshape(states.ndim, -1)
    columns: dict[str, Any] = {name: codes[k] for k, name in enumerate(index)}
    columns |= {"time": times[codes[-2]], "ball": codes[-1]}
    columns |= dtypes.columns(states.reshape(-1))
    names = {label.value: label.name.lower() for label in Label}
    words = [names.get(label) for label in columns["label"].tolist()]
    columns["label"] = pandas.Categorical(words, list(names.values()))
    return pandas.DataFrame(columns)
