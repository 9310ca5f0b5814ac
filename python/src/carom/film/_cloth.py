"""The cloth in a frame: its colour, its four edges, and the objects on it.

Colours are compared by log r/g and log b/g, which shadows hardly change. The cloth's values are
quadratic functions of the pixel, fitted with weights that exclude balls and marks.
"""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from carom.dtypes import Doubles
from carom.film._camera import Camera, Evidence, begin, fit
from carom.tracks import TrackError

_DARK = 8.0  # levels added to colours, so that noise in the dark does not count
# changes of the logarithm of the brightness up to which cloth is cloth: darker and brighter
_SHADOW, _LIGHT = 0.6, 0.15
_VIVID = 0.25  # share of the middle of the frame with a colour, at least, or the cloth is grey
_GREY = 0.12  # of the ratios of a cloth without a colour, at most
_LEAST = 0.06  # smallest fraction of the frame that a table covers
# outward normals of the sides x = 0, y = 0, x = W, y = L
NORMALS = np.array([[-1.0, 0.0], [0.0, -1.0], [1.0, 0.0], [0.0, 1.0]])
_STRAIGHT = 0.2  # rad: edges that bend less are one side
_POINTS = 60  # along each edge
_REACH = 12  # pixels to each side of the expected edge
_SEEN = 0.3  # fraction of the points of an edge that must be found, or the side is not in the frame
_MOUTH = 0.04  # m around a pocket within which a ball is about to fall
_NEAR = 1.5  # pixels: displacement above which an edge has moved

# of the strips along a side, inwards of its nose, that its shadow may darken: width (m), parts of
# the side, and pixels that tell what they have in common
_NOSE_REACH, _NOSE_PARTS, _NOSE_LEAST = 0.05, 6, 24

Picture = np.ndarray[tuple[int, ...], np.dtype[np.uint8]]


class FilmError(TrackError):
    """A film cannot be tracked; the message states the reason and a remedy."""


def ratios(picture: Picture) -> Doubles:
    """log b/g, log r/g and log of the brightness of each pixel, (height, width, 3)."""
    logs = np.log(np.arange(256, dtype=np.float32) + _DARK)
    blue, green, red = cv2.split(cv2.LUT(picture, logs))
    return np.asarray(cv2.merge([blue - green, red - green, (blue + green + red) / 3.0]))


def quadrilateral(picture: Picture) -> Doubles:
    """The corners of the cloth, counterclockwise in the frame from the lower left one, (4, 2)."""
    lab = cv2.cvtColor(cv2.GaussianBlur(picture, (5, 5), 0), cv2.COLOR_BGR2LAB)
    height, width = lab.shape[:2]
    # the cloth is the commonest colour of the middle that is no grey, or else the commonest grey,
    # which its brightness tells from other greys
    middle = lab[height // 5 : -height // 5, width // 5 : -width // 5].reshape(-1, 3)
    vivid = middle[np.hypot(*(middle[:, 1:].astype(np.float64) - 128.0).T) > 12.0]
    is_grey = len(vivid) < _VIVID * len(middle)
    channels = [0, 1, 2] if is_grey else [1, 2]
    colours = (middle if is_grey else vivid)[:, channels].astype(np.float64)
    bins = [np.arange(0.0, 257.0, 4.0)] * len(channels)
    counts, _ = np.histogramdd(colours, bins=bins)
    peak = 4.0 * np.array(np.unravel_index(counts.argmax(), counts.shape)) + 2.0
    reach = np.array([45.0, 14.0, 14.0])[channels]
    close = colours[(np.abs(colours - peak) < reach).all(axis=1)]
    distance = np.abs(lab[..., channels] - np.median(close, axis=0)) / reach
    away = 14.0 * distance.max(axis=2)
    mask = cv2.morphologyEx((away < 14).astype(np.uint8), cv2.MORPH_OPEN, np.ones((5, 5), np.uint8))
    # a dark line under a nose does not part its cushion from the bed
    wide = np.ones((height // 60, height // 60), np.uint8)
    mask = cv2.morphologyEx(mask, cv2.MORPH_CLOSE, wide)
    _, labels, sizes, _ = cv2.connectedComponentsWithStats(mask)
    largest = 1 + int(sizes[1:, cv2.CC_STAT_AREA].argmax()) if len(sizes) > 1 else 0
    if not largest or sizes[largest, cv2.CC_STAT_AREA] < _LEAST * height * width:
        raise FilmError(
            f"no cloth found: no area of one colour covers {100 * _LEAST:.0f} % of the frame; "
            "pass --corners"
        )
    outlines, _ = cv2.findContours(
        (labels == largest).astype(np.uint8), cv2.RETR_EXTERNAL, cv2.CHAIN_APPROX_NONE
    )
    outline = max(outlines, key=cv2.contourArea)
    hull = cv2.convexHull(outline)
    # the outline itself, without what goes inwards, such as an arm and the shadow of a cushion
    ring = np.zeros((height, width), np.uint8)
    cv2.polylines(ring, [hull], True, 1, 9)
    outline = outline[ring[outline[:, 0, 1], outline[:, 0, 0]] > 0]
    polygon = cv2.approxPolyDP(hull, 0.01 * cv2.arcLength(hull, True), True)[:, 0]
    # a side that a lens bends, or a pocket interrupts, is one; the four longest edges are the
    # sides, between which pockets cut off the corners
    ways = np.roll(polygon, -1, axis=0) - polygon
    while len(polygon) > 4:
        angles = np.arctan2(*ways.T.astype(np.float64))
        bends = np.abs((angles - np.roll(angles, 1) + np.pi) % (2.0 * np.pi) - np.pi)
        if bends.min() > _STRAIGHT:
            break
        polygon = np.delete(polygon, int(bends.argmin()), axis=0)
        ways = np.roll(polygon, -1, axis=0) - polygon
    sides = np.sort(np.argsort(-np.hypot(*ways.T.astype(np.float64)))[:4])
    corners = polygon[:0].astype(np.float64)
    if len(sides) == 4:
        ends = np.stack([polygon[sides], polygon[sides] + ways[sides]], axis=1)
        corners = _crossings(ends.astype(np.float64), outline[:, 0].astype(np.float64))
    quad = np.abs(area(corners)) if len(corners) else np.inf
    if not 0.95 * cv2.contourArea(hull) < quad < 1.2 * cv2.contourArea(hull):
        raise FilmError(
            "the cloth does not have four straight sides; the complete table must be in the frame, or pass --corners"
        )
    middles = ends.mean(axis=1)
    border = np.array([width, height]) - 1.0
    if (np.minimum(middles, border - middles) < 3.0).any():
        raise FilmError(
            "the cloth reaches the border of the frame; the complete table must be in it, or pass --corners"
        )
    corners = corners if area(corners) > 0.0 else corners[::-1]
    lower_left = int(np.argmin(corners[:, 0] - corners[:, 1]))
    return np.roll(corners, -lower_left, axis=0)


def _crossings(sides: Doubles, outline: Doubles) -> Doubles:
    """The intersections of lines through the outline near each side with those of the side before.

    Of shape (4, 2, 2).
    """
    lines = []
    for a, b in sides:
        length = float(np.linalg.norm(b - a))
        along = (outline - a) @ (b - a) / length**2
        middle = (along > 0.1) & (along < 0.9)
        place, normal = a, np.array([a[1] - b[1], b[0] - a[0]]) / length
        # the corners of the polygon are rough, so the first line looks farther
        for reach in (0.05 * length, 0.02 * length, 3.0):
            close = outline[middle & (np.abs((outline - place) @ normal) < reach)]
            if len(close) < 10:
                return np.zeros((0, 2))
            line = cv2.fitLine(close.astype(np.float32), cv2.DIST_HUBER, 0, 0.01, 0.01).ravel()
            place, normal = line[2:].astype(np.float64), np.array([-line[1], line[0]], np.float64)
        lines.append((normal, normal @ place))
    pairs = [(lines[k - 1], lines[k]) for k in range(4)]
    return np.array([np.linalg.solve([a[0], b[0]], [a[1], b[1]]) for a, b in pairs])


def area(corners: Doubles) -> float:
    """The signed area: positive if the corners are counterclockwise in the frame, whose y axis
    points down.
    """
    x, y = corners.T
    return 0.5 * float(y @ np.roll(x, -1) - x @ np.roll(y, -1))


@dataclass(frozen=True)
class Bed:
    """A table for the camera: the noses extend from (0, 0) to (width, length)."""

    width: float  # m
    length: float
    nose: float  # m above the slate
    depth: float  # m: depth of the cushions, from the noses to the edge of the cloth
    radius: float  # m: of the balls
    pockets: Doubles  # (n, 3): positions and radii, m

    @property
    def corners(self) -> Doubles:
        return np.array(
            [[0.0, 0.0], [self.width, 0.0], [self.width, self.length], [0.0, self.length]]
        )

    def nose_of(self, side: int) -> float:
        """The position of the noses of a side along its outward normal, m."""
        return float(self.corners[side] @ NORMALS[side])

    def edge(self, side: int, pixels: Doubles, deviation: tuple[float, float]) -> Evidence:
        """Pixels of the edge of the cloth along a side, as evidence."""
        targets = np.full(len(pixels), self.nose_of(side))
        normals = np.tile(NORMALS[side], (len(pixels), 1))
        return Evidence.uniform(pixels, self.nose, normals, targets, deviation, side)

    def near_pocket(self, places: Doubles, mouth: float = _MOUTH) -> NDArray[np.bool_]:
        """Whether balls at positions (n, 2) are in a pocket or about to fall; with a wider mouth,
        m, also whether they hit its jaws.
        """
        away = np.hypot(*(places[:, None] - self.pockets[:, :2]).transpose(2, 0, 1))
        return np.asarray((away < self.pockets[:, 2] + mouth).any(axis=1))

    def side(self, number: int, offset: float, shares: Doubles) -> Doubles:
        """Points at fractions of a side's length, moved outwards, at the height of the noses."""
        a, b = self.corners[[number - 1, number]]
        line = a + shares[:, None] * (b - a) + offset * NORMALS[number]
        return np.column_stack([line, np.full(len(shares), self.nose)])

    def project(self, camera: Camera, number: int, offset: float, shares: Doubles) -> Doubles:
        """The pixels of `side`."""
        return camera.project(self.side(number, offset, shares))


class Cloth:
    """A table in the view of a camera, prepared for many frames."""

    def __init__(self, picture: Picture, camera: Camera, bed: Bed, depths: Doubles) -> None:
        self.camera, self.bed = camera, bed
        shares = np.linspace(0.0, 1.0, 30)
        outline = np.concatenate(
            [bed.project(camera, side, depths[side], shares) for side in range(4)]
        )
        # the cropped frame
        low = np.maximum(np.floor(outline.min(axis=0)).astype(int) - _REACH - 2, 0)
        high = np.minimum(np.ceil(outline.max(axis=0)).astype(int) + _REACH + 3, camera.size)
        if (high - low < 50).any():
            raise FilmError("the table is not in the frame; --corners must be pixels of the frame")
        self.low = low.astype(np.float64)
        self.part = slice(low[1], high[1]), slice(low[0], high[0])
        self.shape = int(high[1] - low[1]), int(high[0] - low[0])
        # where balls are seen: cushions on the camera's side hide what is behind their noses
        inner = []
        for side in range(4):
            hides = camera.eye[:2] @ NORMALS[side] > bed.nose_of(side)
            inner.append(bed.project(camera, side, 0.0 if hides else depths[side] - 0.006, shares))
        self.mask = self._filled(np.concatenate(inner))
        turn = np.linspace(0.0, 2.0 * np.pi, 40)
        for x, y, radius in bed.pockets:
            ring = np.column_stack([x + radius * np.cos(turn), y + radius * np.sin(turn)])
            for height in (0.0, bed.nose):
                hole = camera.project(np.column_stack([ring, np.full(40, height)]))
                self.mask[self._filled(hole) > 0] = 0
        self._learn(picture)
        self._find_edges(picture, depths)
        self._learn_noses(picture)
        self.usual_edges = self.edge_offsets(picture, self.distance(picture))

    def _filled(self, polygon: Doubles) -> Picture:
        mask = np.zeros(self.shape, np.uint8)
        cv2.fillPoly(mask, [np.round(polygon - self.low).astype(np.int32)], 1)
        return mask

    def _learn(self, picture: Picture) -> None:
        """The cloth's colour ratios at each pixel, and their scatter."""
        found = ratios(picture[self.part])
        y, x = np.mgrid[: self.shape[0], : self.shape[1]].astype(np.float32)
        y, x = 2.0 * y / self.shape[0] - 1.0, 2.0 * x / self.shape[1] - 1.0
        terms = np.stack([np.ones_like(x), x, y, x * x, x * y, y * y], axis=2)
        chosen = np.flatnonzero(self.mask)[::7]
        A, b = terms.reshape(-1, 6)[chosen], found.reshape(-1, 3)[chosen]
        # from the median on, pixels that are far from the quadratic lose their weight
        model = np.zeros((6, 3), np.float32)
        model[0] = np.median(b, axis=0)
        limits = np.array([0.3, 0.3, 0.5], np.float32)
        for _ in range(8):
            good = (np.abs(b - A @ model) < limits).all(axis=1)
            if good.sum() < 0.3 * len(b):
                raise FilmError(
                    "most of the table does not have one colour; --corners must be the corners of the noses, "
                    "in the order that --help shows"
                )
            model = np.linalg.lstsq(A[good], b[good], rcond=None)[0].astype(np.float32)
            limits = np.maximum(4.0 * 1.4826 * np.median(np.abs(b - A @ model), axis=0), 0.02)
        self.own = terms @ model
        self.noise = float(np.hypot(*(limits[:2] / 4.0)))
        self.threshold = max(5.0 * self.noise, 0.15)
        # white balls differ from grey cloth by their brightness alone
        is_grey = np.hypot(*np.median(b[:, :2], axis=0)) < _GREY
        self.light = min(_LIGHT, float(limits[2])) if is_grey else _LIGHT

    def _learn_noses(self, picture: Picture) -> None:
        """Add to the cloth's values what most pixels at the same distance from a side have in
        common: the shadow of its nose, and the light on its cushion.
        """
        rows, columns = np.nonzero(self.mask)
        pixels = np.column_stack([columns, rows]) + self.low
        places = self.camera.places(pixels, self.bed.nose)
        noses = np.array([self.bed.nose_of(side) for side in range(4)])
        depth = places @ NORMALS.T - noses
        side = depth.argmax(axis=1)
        depth = depth.max(axis=1)
        # parts of a side, so that a ball at the nose is not what most of a part's pixels show
        along = np.where(side % 2 == 0, places[:, 1], places[:, 0])
        extent = np.where(side % 2 == 0, self.bed.length, self.bed.width)
        part = np.clip(along / extent * _NOSE_PARTS, 0, _NOSE_PARTS - 1).astype(int)
        # a bin has the width of a pixel
        step = float(np.sqrt(self.bed.width * self.bed.length / max(len(rows), 1)))
        bins = np.floor((depth + _NOSE_REACH) / step).astype(int)
        strip = np.flatnonzero(depth > -_NOSE_REACH)
        keys = (side[strip] * _NOSE_PARTS + part[strip]) * (bins.max() + 1) + bins[strip]
        order = np.argsort(keys, kind="stable")
        strip, keys = strip[order], keys[order]
        residue = (ratios(picture[self.part]) - self.own)[rows[strip], columns[strip]]
        cuts = np.flatnonzero(np.diff(keys)) + 1
        for group, values in zip(np.split(strip, cuts), np.split(residue, cuts)):
            if len(group) >= _NOSE_LEAST:
                self.own[rows[group], columns[group]] += np.median(values, axis=0)

    def distance(self, picture: Picture) -> Doubles:
        """The distance of each pixel's colour from the cloth's, in the cropped frame."""
        blue, red, bright = cv2.split(ratios(picture[self.part]) - self.own)
        dark = np.maximum(np.maximum(-bright - _SHADOW, bright - self.light), 0.0)
        return np.asarray(np.sqrt(blue * blue + red * red + dark * dark))

    def _find_edges(self, picture: Picture, depths: Doubles) -> None:
        """The edge of the cloth along each side in this frame."""
        # away from the pockets, where cushions are cut or curved
        shares = np.concatenate([np.linspace(0.1, 0.44, _POINTS // 2)] * 2)
        shares[_POINTS // 2 :] = 1.0 - shares[_POINTS // 2 :]
        steps = np.arange(-_REACH, _REACH + 1.0)
        points, grids = [], []
        for side in range(4):
            middle = self.bed.project(self.camera, side, depths[side], shares)
            outer = self.bed.project(self.camera, side, depths[side] + 0.01, shares)
            outward = (outer - middle) / np.linalg.norm(outer - middle, axis=1, keepdims=True)
            points.append((middle, outward))
            grids.append(middle[:, None] + steps[:, None] * outward[:, None] - self.low)
        self.points, self.grid = points, np.concatenate(grids).astype(np.float32)
        self.edges = self.edge_offsets(picture, self.distance(picture))
        # a lens bends an edge like a parabola; pockets and blocks of the compression do not
        terms = np.vander(shares, 4)
        for edge in self.edges:
            for limit in (3.0, 1.5, 0.8):
                good = np.isfinite(edge)
                if good.sum() < 12:
                    break
                # the least sum of distances, by weights
                weights = np.ones(int(good.sum()))
                for _ in range(8):
                    root = np.sqrt(weights)
                    model = np.linalg.lstsq(
                        terms[good] * root[:, None], edge[good] * root, rcond=None
                    )[0]
                    weights = 1.0 / np.maximum(np.abs(edge[good] - terms[good] @ model), 0.05)
                edge[np.abs(edge - terms @ model) > limit] = np.nan

    def edge_offsets(self, picture: Picture, distance: Doubles) -> Doubles:
        """The outward distance of the cloth's edge from its expected position, pixels, (4, points).

        nan where no edge is found.
        """
        x, y = np.ascontiguousarray(self.grid[..., 0]), np.ascontiguousarray(self.grid[..., 1])
        profile = cv2.remap(distance.astype(np.float32), x, y, cv2.INTER_LINEAR)
        inside = profile[:, :-3] < self.threshold
        outside = np.minimum.reduce([profile[:, k : profile.shape[1] - 3 + k] for k in (1, 2, 3)])
        ends = inside & (outside >= self.threshold)
        rows, last = np.arange(len(profile)), profile.shape[1] - 1
        k = ends.shape[1] - 1 - np.argmax(ends[:, ::-1], axis=1)

        # the edge is where the colour is half way between both sides, by a line through two pixels
        colours = cv2.remap(picture[self.part], x, y, cv2.INTER_LINEAR).astype(np.float64)
        inner = colours[rows, np.maximum(k - 4, 0)]
        way = colours[rows, np.minimum(k + 5, last)] - inner
        share = ((colours - inner[:, None]) * way[:, None]).sum(axis=2)
        share /= np.maximum((way**2).sum(axis=1), 1.0)[:, None]
        close = np.abs(np.arange(last) - k[:, None]) < 4
        half = (share[:, :-1] < 0.5) & (share[:, 1:] >= 0.5) & close
        j = np.argmax(half, axis=1)
        a, b = share[rows, j], share[rows, j + 1]
        place = j + (0.5 - a) / np.maximum(b - a, 1e-6) - _REACH
        found = np.where(ends.any(axis=1) & half.any(axis=1), place, np.nan)
        return found.reshape(4, -1)

    def is_seen(self, picture: Picture, distance: Doubles) -> bool:
        """Whether at least three edges have not moved."""
        moved = np.abs(self.edge_offsets(picture, distance) - self.usual_edges)
        close = (moved < _NEAR).sum(axis=1)
        return int((close >= _SEEN * np.isfinite(self.usual_edges).sum(axis=1)).sum()) >= 3

    def evidence(self) -> list[Evidence]:
        """The edges as evidence about the camera."""
        parts = []
        for side, (middle, outward) in enumerate(self.points):
            good = np.isfinite(self.edges[side])
            if good.sum() < _POINTS // 4:
                continue
            pixels = (middle + self.edges[side][:, None] * outward)[good]
            # neighbouring points have common errors, so 60 points are worth less than 60 independent ones
            parts.append(self.bed.edge(side, pixels, (1.0, 0.001)))
        return parts


def calibrated(
    picture: Picture,
    bed: Bed,
    corners: Doubles | None,
    focal: float | None,
    lens: float | None,
    half_turn: bool = False,
) -> tuple[Camera, Doubles, list[Evidence]]:
    """Calibrate a camera from the edges of the cloth, and from the corners of the noses if given.

    Returns the camera, the depths of the cushions, and the evidence. A table that was detected may
    have either orientation.
    """
    size = picture.shape[1], picture.shape[0]
    known: list[Evidence] = []
    best: tuple[float, Camera, Doubles, list[Evidence]] | None = None
    if corners is None:
        outer = np.roll(quadrilateral(picture), 2 * half_turn, axis=0)
        away = bed.depth * np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]])
    else:
        outer, away = corners, np.zeros((4, 2))
        for axis in np.eye(2):
            normals, target = np.tile(axis, (4, 1)), bed.corners @ axis
            known.append(Evidence.uniform(corners, bed.nose, normals, target, (1.5, 0.0)))
    # the orientation of the table in the frame that fits better
    for start in range(2 if corners is None else 1):
        camera = begin(np.roll(outer, -start, axis=0), bed.corners + away, bed.nose, size)
        evidence = list(known)
        if corners is None:
            shares = np.linspace(0.1, 0.9, 9)[:, None]
            for side in range(4):
                ends = np.roll(outer, -start, axis=0)[[side - 1, side]]
                pixels = ends[0] + shares * (ends[1] - ends[0])
                evidence.append(bed.edge(side, pixels, (3.0, 0.0)))
        camera, depths, cost = fit(camera, Evidence.join(evidence), bed.depth, focal, lens)
        if best is None or cost < best[0]:
            best = cost, camera, depths, evidence[len(known) :]
    assert best is not None
    _, camera, depths, rough = best
    # the edges are located again where the better camera expects them; otherwise the rough line is
    # kept
    evidence = known
    for _ in range(4):
        fine = Cloth(picture, camera, bed, depths).evidence()
        sides = {float(rows.sides[0]) for rows in fine}
        evidence = [*known, *fine, *(rows for rows in rough if rows.sides[0] not in sides)]
        camera, depths, _ = fit(camera, Evidence.join(evidence), bed.depth, focal, lens)
    return camera, depths, evidence
