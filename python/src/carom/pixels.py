"""A picture of a table as pixels, for agents and films: the balls where they lie, and the paths of the last shot."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from carom import dtypes
from carom._rows import listing
from carom.layouts import Table
from carom.pictures import CLOTH, CUSHION, MARGIN, POCKET, WOOD, colour, lies
from carom.results import Label, Shot

__dir__ = listing(__name__)

Pixels = npt.NDArray[np.uint8]
_PATH_POINTS = 4000


class _Canvas:
    """Metres of the table to pixels, as in `carom.pictures`; edges are softened over one pixel."""

    def __init__(self, table: Table, scale: float) -> None:
        self.scale = scale
        self.high = table.length + MARGIN
        size = np.array([table.width, table.length]) + 2.0 * MARGIN
        self.turned = lies(size)
        size = size if self.turned else size[::-1]
        self.image: dtypes.Doubles = np.zeros((*np.round(size * scale).astype(int), 3))
        self.image[:] = _rgb(WOOD)

    def pixel(self, points: npt.ArrayLike) -> dtypes.Doubles:
        """Columns and rows, of shape (..., 2), of points in m."""
        given = np.asarray(points, dtype=np.float64)[..., :2]
        place = given[..., ::-1] + MARGIN if self.turned else given * [1.0, -1.0] + [MARGIN, self.high]
        return place * self.scale - 0.5

    def box(self, low: npt.ArrayLike, high: npt.ArrayLike, fill: str) -> None:
        left, top, right, bottom = np.round(np.sort([self.pixel(low), self.pixel(high)], axis=0)).astype(int).ravel()
        self.image[top:bottom, left:right] = _rgb(fill)

    def stroke(self, start: npt.ArrayLike, end: npt.ArrayLike, radius: float, fill: str) -> None:
        """What a disc of the radius (m) covers on its way from start to end, which may be the same."""
        p, q, reach = self.pixel(start), self.pixel(end), radius * self.scale
        low = np.maximum(np.floor(np.minimum(p, q) - reach - 1.0), 0.0).astype(int)
        high = np.ceil(np.maximum(p, q) + reach + 2.0).astype(int)
        part = self.image[low[1] : high[1], low[0] : high[0]]
        rows, columns = np.indices(part.shape[:2])
        # The distance of each pixel to the segment.
        x, y = columns + low[0] - p[0], rows + low[1] - p[1]
        way = q - p
        along = np.clip((x * way[0] + y * way[1]) / max(float(way @ way), 1e-12), 0.0, 1.0)
        distance = np.hypot(x - along * way[0], y - along * way[1])
        cover = np.clip(reach + 0.5 - distance, 0.0, 1.0)[..., np.newaxis]
        part += cover * (_rgb(fill) - part)

    def dots(self, points: npt.ArrayLike, fill: str) -> None:
        """One pixel for each point."""
        columns, rows = np.round(self.pixel(points)).astype(int).T
        inside = (columns >= 0) & (rows >= 0) & (columns < self.image.shape[1]) & (rows < self.image.shape[0])
        self.image[rows[inside], columns[inside]] = _rgb(fill)


def _rgb(text: str) -> dtypes.Doubles:
    """Red, green and blue of "#rrggbb", 0 to 255."""
    return np.array([int(text[k : k + 2], 16) for k in (1, 3, 5)], dtype=np.float64)


def pixels(table: Table, balls: dtypes.Records, shot: Shot | None = None, scale: float = 200.0) -> Pixels:
    """A picture as an array.

    Parameters
    ----------
    table : Table
        With its surface at 0 <= x <= width, 0 <= y <= length.
    balls : ndarray of `carom.dtypes.shot_ball`, shape (balls,)
        Drawn where they are; those in a pocket are not.
    shot : Shot, optional
        Whose paths are drawn.
    scale : float
        Pixels a metre.

    Returns
    -------
    ndarray of uint8, shape (rows, columns, 3)
        Red, green, blue; y of the table upwards, or to the right where the table is longer than wide.
    """
    canvas = _Canvas(table, scale)
    canvas.box((0.0, 0.0), (table.width, table.length), CLOTH)
    for pocket in table.pockets:
        canvas.stroke(pocket["centre"], pocket["centre"], float(pocket["radius"]), POCKET)
    for rail in table.rails:
        canvas.stroke(rail["p"], rail["q"], 0.006, CUSHION)
    for jaw in table.jaws:
        canvas.stroke(jaw["centre"], jaw["centre"], float(jaw["radius"]), CUSHION)
    if shot is not None:
        paths = shot.positions(np.linspace(0.0, shot.time, _PATH_POINTS))
        for ball in range(len(shot.balls)):
            if np.ptp(paths[:, ball, :2], axis=0).any():
                canvas.dots(paths[:, ball], colour(ball))
    for ball, (state, kind) in enumerate(zip(balls["state"], balls["kind"], strict=True)):
        if state["label"] not in (Label.POCKETED, Label.OFF):
            canvas.stroke(state["r"], state["r"], float(kind["radius"]), colour(ball))
    return np.round(canvas.image).astype(np.uint8)
