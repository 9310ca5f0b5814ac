"""A pinhole camera over a table: square pixels, the principal point in the middle of the frame, and
one lens coefficient.

With q = rotation r + translation, a point r of the table (m; z up from the slate) appears at middle
+ f (1 + k1 |p|^2) p, p = (q_x, q_y) / q_z. A pixel and a height determine a position, which
separates noses from the lower centres of balls.

All evidence about a camera has the same form: a pixel, the height of the object there, and the
expected value of one coordinate. The edge of the cloth is outside the noses by the depth of a
cushion. This depth is fitted for each side together with the camera, from turns of balls at
cushions and from balls on their spots.
"""

from __future__ import annotations

import functools
from dataclasses import dataclass, replace

import cv2
import numpy as np
from scipy.optimize import least_squares

from carom.dtypes import Doubles

_FOCAL = 1.3, 0.7  # in frame widths, and its logarithmic deviation: 25 to 110 degrees
_LENS = 0.12  # deviation of k1
_DEPTH = 0.008, 0.006  # m: deviations of a cushion's depth, and of one side from the others
_HEIGHT = (
    0.008  # m: deviation of the cloth's edge from the noses, which a low camera sees displaced
)
_ROUNDS = 30
_FREE = 2.0  # deviations beyond which a row counts less


@dataclass(frozen=True)
class Camera:
    """The position and the projection of a camera; methods use arrays (n, 2) and (n, 3)."""

    numbers: Doubles  # log f (pixels), rotation vector, translation (m), k1
    size: tuple[int, int]  # width and height of the frame, pixels

    @property
    def focal(self) -> float:
        """Focal length, pixels."""
        return float(np.exp(self.numbers[0]))

    @functools.cached_property
    def rotation(self) -> Doubles:
        return np.asarray(cv2.Rodrigues(self.numbers[1:4])[0], np.float64)

    @functools.cached_property
    def eye(self) -> Doubles:
        """The camera's position, m."""
        return -self.rotation.T @ self.numbers[4:7]

    def depths(self, points: Doubles) -> Doubles:
        """How far points are in front of the camera, m, (n,)."""
        return np.asarray(points @ self.rotation[2] + self.numbers[6])

    def project(self, points: Doubles) -> Doubles:
        """The pixels of points, m."""
        q = points @ self.rotation.T + self.numbers[4:7]
        p = q[:, :2] / q[:, 2:]
        lens = 1.0 + self.numbers[7] * (p * p).sum(axis=1, keepdims=True)
        return np.asarray(self.focal * lens * p + 0.5 * np.array(self.size))

    def places(self, pixels: Doubles, heights: Doubles | float) -> Doubles:
        """The positions of rays through pixels at heights above the slate, m, (n, 2)."""
        bent = (pixels - 0.5 * np.array(self.size)) / self.focal
        p = bent
        for _ in range(6):  # the lens is weak, so the iteration contracts fast
            p = bent / (1.0 + self.numbers[7] * (p * p).sum(axis=1, keepdims=True))
        rays = np.column_stack([p, np.ones(len(p))]) @ self.rotation
        share = (heights - self.eye[2]) / rays[:, 2]
        return np.asarray(self.eye[:2] + rays[:, :2] * share[:, None])

    def radii(self, places: Doubles, radius: float) -> Doubles:
        """The radii, in pixels, of balls at positions, (n,)."""
        centres = np.column_stack([places, np.full(len(places), radius)])
        return self.focal * radius / self.depths(centres)


@dataclass(frozen=True)
class Evidence:
    """Rows of evidence: at `pixels`, at a height, normal . position should equal the target."""

    pixels: Doubles  # (n, 2)
    heights: Doubles  # m, (n,)
    normals: Doubles  # (n, 2)
    targets: Doubles  # m, (n,)
    deviations: Doubles  # pixels and m, (n, 2)
    sides: Doubles  # (n,): the side whose cushion depth is added to the position, or -1

    @classmethod
    def uniform(
        cls,
        pixels: Doubles,
        height: float,
        normals: Doubles,
        targets: Doubles,
        deviation: tuple[float, float],
        side: int = -1,
    ) -> Evidence:
        """Rows of one height, deviation and side."""
        n = len(pixels)
        full = functools.partial(np.full, n)
        deviations = np.broadcast_to(np.array(deviation), (n, 2))
        return cls(pixels, full(height), normals, targets, deviations, full(float(side)))

    @classmethod
    def join(cls, parts: list[Evidence]) -> Evidence:
        return cls(
            *(np.concatenate([vars(part)[name] for part in parts]) for name in vars(parts[0]))
        )

    def residuals(self, camera: Camera, depths: Doubles) -> Doubles:
        """Position minus target, m, (n,)."""
        along = (camera.places(self.pixels, self.heights) * self.normals).sum(axis=1)
        depth = np.where(self.sides >= 0.0, depths[self.sides.astype(int)], 0.0)
        return np.asarray(along - depth - self.targets)

    def spreads(self, camera: Camera) -> Doubles:
        """The standard deviation of each row, m, from the size of a pixel there."""
        steps = [
            camera.places(self.pixels + step, self.heights)
            - camera.places(self.pixels - step, self.heights)
            for step in 0.5 * np.eye(2)
        ]
        pixel = np.hypot(*((step * self.normals).sum(axis=1) for step in steps))
        return np.asarray(np.hypot(self.deviations[:, 0] * pixel, self.deviations[:, 1]))


def begin(corners: Doubles, rectangle: Doubles, height: float, size: tuple[int, int]) -> Camera:
    """A camera that projects the corners of a rectangle, m, to these pixels, (4, 2) each.

    Returns the best of several focal lengths.
    """
    middle = 0.5 * np.array(size)
    best: tuple[float, Camera] | None = None
    for share in np.geomspace(0.5, 5.0, 9):
        focal = share * size[0]
        seen = ((corners - middle) / focal).astype(np.float32)
        H = np.asarray(cv2.getPerspectiveTransform(rectangle.astype(np.float32), seen))
        # the columns of H are two axes of the table and its origin, all times one number
        H *= np.sign(H[2, 2]) / np.sqrt(np.linalg.norm(H[:, 0]) * np.linalg.norm(H[:, 1]))
        u, _, v = np.linalg.svd(np.column_stack([H[:, :2], np.cross(H[:, 0], H[:, 1])]))
        rotation = u @ np.diag([1.0, 1.0, np.linalg.det(u @ v)]) @ v
        move = H[:, 2] - rotation[:, 2] * height
        vector = np.asarray(cv2.Rodrigues(rotation)[0]).ravel()
        camera = Camera(np.concatenate([[np.log(focal)], vector, move, [0.0]]), size)
        points = np.column_stack([rectangle, np.full(4, height)])
        misfit = float(np.linalg.norm(camera.project(points) - corners))
        if best is None or misfit < best[0]:
            best = misfit, camera
    assert best is not None
    return best[1]


def fit(
    camera: Camera, evidence: Evidence, depth: float, focal: float | None, lens: float | None
) -> tuple[Camera, Doubles, float]:
    """Fit the camera and the depths of the four cushions, m; also returns the sum of squares.

    The weight of a row decreases beyond 2 deviations. A given focal length (pixels) or k1 is kept.
    """
    wanted = np.log(focal or _FOCAL[0] * camera.size[0])
    x = np.concatenate([camera.numbers, np.full(4, depth)])
    spreads = evidence.spreads(camera)
    # how flat the camera looks along x and y
    flat = np.abs(camera.rotation[2, :2]) / max(-camera.rotation[2, 2], 0.1)
    sides = np.hypot(_DEPTH[1], _HEIGHT * np.tile(flat, 2))

    def residuals(x: Doubles) -> Doubles:
        mean = x[8:].mean()
        bend = x[7] / _LENS if lens is None else (x[7] - lens) / 1e-6
        length = (x[0] - wanted) / (_FOCAL[1] if focal is None else 1e-6)
        prior = [[length, bend, (mean - depth) / _DEPTH[0]]]
        found = evidence.residuals(Camera(x[:8], camera.size), x[8:]) / spreads
        return np.concatenate([found, *prior, (x[8:] - mean) / sides])

    def loss(squares: Doubles) -> Doubles:
        """Huber's loss and its weights, of the rows but not of what is known before them.

        The second derivative is taken as 0, so that a step is one of weighted least squares: with
        it the search stops far from the minimum if the first camera is far off.
        """
        size = np.maximum(np.sqrt(squares), _FREE)
        size[-7:] = _FREE
        value = np.where(size > _FREE, _FREE * (2.0 * size - _FREE), squares)
        return np.stack([value, _FREE / size, np.zeros_like(size)])

    found = least_squares(
        residuals, x, jac="3-point", x_scale="jac", loss=loss, ftol=1e-8, max_nfev=_ROUNDS
    )
    return replace(camera, numbers=found.x[:8]), found.x[8:], 2.0 * float(found.cost)
