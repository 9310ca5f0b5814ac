"""The balls in a frame: blobs that differ from the cloth's colour and have the size of a ball.

A centre is the position at which the visible part of a ball's disc, outside cushions and pockets,
has the same middle as the blob. Blobs of several balls are split into discs if discs explain them.
The rest is a hand or a cue, and balls that touch it have no position.
"""

from __future__ import annotations

import cv2
import numpy as np

from carom.dtypes import Doubles
from carom.film._cloth import Cloth, Picture

blob = np.dtype(
    [
        ("pixel", np.float64, 2),
        ("place", np.float64, 2),  # m
        ("share", np.float64),  # fraction of the area of a complete ball there
        (
            "colour",
            np.float64,
            3,
        ),  # blue, green, red of its middle, excluding white if there is another colour
        ("white", np.float64),  # fraction of its middle
        ("whole", np.bool_),  # fully visible, and a single ball
    ]
)
"""A ball that is seen."""

_LEAST = 0.6  # of a ball's area: less is a mark
_MOST = 1.6  # and more, unless it is long, is more than a ball
_LONG = 4.0  # of a ball's area: a moving ball is no longer than that in one exposure
_SOLID = 0.93  # of its hull: a blurred ball, where two balls have a waist
_BRIGHT, _GREY = 75.0, 0.38  # levels of white at least, and its colours' greatest difference
_HOLE = 0.3  # of a ball's area: the largest hole in its blob
_PARTS = 16  # balls that touch
_LEFT = 0.16  # of a blob that discs do not explain: a hand or a cue
_CORE = 0.6  # of a ball's radius: of the disc that a stick is too thin to contain
_ROUND = 0.6, 1.4  # least and greatest area of what such discs cover, over a ball's


class Finder:
    """Finds the balls in frames of one table."""

    def __init__(self, cloth: Cloth) -> None:
        self.cloth = cloth
        height, width = cloth.shape
        self.y, self.x = np.mgrid[:height, :width].astype(np.float64)
        # lines of the cloth and cues are thinner than balls
        smallest = cloth.camera.radii(cloth.bed.corners, cloth.bed.radius).min()
        self.smallest = np.pi * smallest**2
        thick = 2 * max(int(0.4 * smallest), 1) + 1
        self.kernel = cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (thick, thick))

    def radius(self, pixel: Doubles) -> float:
        """The radius, in pixels, of a ball at a pixel of the cropped frame."""
        camera, radius = self.cloth.camera, self.cloth.bed.radius
        place = camera.places(pixel[None] + self.cloth.low, radius)
        return float(camera.radii(place, radius)[0])

    def find(self, picture: Picture, distance: Doubles) -> tuple[np.ndarray, np.ndarray, float]:
        """The balls; round parts of other objects, such as a ball that a cue seems to touch; and the
        area of these objects in units of a ball's area.
        """
        mask = ((distance > self.cloth.threshold) & (self.cloth.mask > 0)).astype(np.uint8)
        # a number or a highlight with the cloth's colour is a part of its ball
        outlines, parents = cv2.findContours(mask, cv2.RETR_CCOMP, cv2.CHAIN_APPROX_NONE)
        for k, outline in enumerate(outlines):
            if parents[0, k, 3] >= 0 and cv2.contourArea(outline) < _HOLE * self.smallest:
                cv2.drawContours(mask, outlines, k, 1, cv2.FILLED)
        mask = cv2.morphologyEx(mask, cv2.MORPH_OPEN, self.kernel)
        count, labels, boxes, centres = cv2.connectedComponentsWithStats(mask, connectivity=4)
        part = picture[self.cloth.part]
        found: list[tuple[object, ...]] = []
        parts: list[tuple[object, ...]] = []
        foreign = 0.0
        for label in range(1, count):
            x, y, width, height, size = boxes[label]
            if size < 6:
                continue
            radius = self.radius(centres[label])
            ball = np.pi * radius**2
            if size < 0.2 * ball:
                continue
            box = slice(max(y - 2, 0), y + height + 2), slice(max(x - 2, 0), x + width + 2)
            blob_itself = (labels[box] == label).astype(np.uint8)
            own = cv2.dilate(blob_itself, np.ones((5, 5), np.uint8)) > 0
            own &= (labels[box] == label) | (labels[box] == 0)
            cover = self._cover(distance[box], labels[box] == label) * own * self.cloth.mask[box]
            share = float(cover.sum()) / ball
            if share < _MOST and max(width, height) < 2.9 * radius + 2.0:
                centre, seen = self._centre(cover, box, centres[label], radius)
                share = float(cover.sum() / max(seen, 0.3 * ball))
                if share > _LEAST:
                    found.append(self._described(part, centre, radius, share, seen > 0.4 * ball))
            elif share < _LONG and self._is_long(labels[box] == label, radius):
                middle = self._middle(cover, box)
                # motion blur lengthens a ball, so its area is meaningless
                found.append(self._described(part, middle, radius, 1.0, True))
            else:
                discs = self._discs(cover, box, radius, share)
                foreign += 0.0 if discs else share
                if not discs:
                    middles = self._round_parts(labels[box] == label, box, radius)
                    parts += [self._described(part, c, radius, 1.0, True) for c in middles]
                found += [self._described(part, c, radius, 1.0, whole) for c, whole in discs]
        return self._inside(found), self._inside(parts), foreign

    def _inside(self, found: list[tuple[object, ...]]) -> np.ndarray:
        """The rows of balls on the bed."""
        rows = np.array(found, blob)
        bed, least = self.cloth.bed, 0.3 * self.cloth.bed.radius
        inside = (rows["place"] > least) & (rows["place"] < [bed.width - least, bed.length - least])
        return np.asarray(rows[inside.all(axis=1)])

    def _round_parts(
        self, own: np.ndarray, box: tuple[slice, slice], radius: float
    ) -> list[Doubles]:
        """The middles of the parts of a blob that are as large and as wide as a ball."""
        size = 2 * max(round(_CORE * radius), 1) + 1
        disc = cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (size, size))
        cores = cv2.morphologyEx(own.astype(np.uint8), cv2.MORPH_OPEN, disc)
        count, labels, _, _ = cv2.connectedComponentsWithStats(cores)
        found = []
        for label in range(1, count):
            core = (labels == label).astype(np.float64)
            if _ROUND[0] < core.sum() / (np.pi * radius**2) < _ROUND[1]:
                found.append(self._middle(core, box))
        return found

    def _cover(self, distance: Doubles, own: np.ndarray) -> Doubles:
        """The fraction of each pixel that a ball covers, from its colour relative to the ball's
        middle.

        A highlight or a number differs from both cloth and ball, so every pixel that differs as
        much from the cloth counts as covered.
        """
        middle = max(float(np.quantile(distance[own], 0.6)), self.cloth.threshold)
        return np.asarray(np.clip((distance / middle - 0.15) / 0.35, 0.0, 1.0))

    def _middle(self, cover: Doubles, box: tuple[slice, slice]) -> Doubles:
        weights = cover / cover.sum()
        return np.array([(weights * self.x[box]).sum(), (weights * self.y[box]).sum()])

    def _disc(self, centre: Doubles, radius: float, box: tuple[slice, slice]) -> Doubles:
        """The fraction of each pixel of a box that the disc of a ball covers."""
        away = np.hypot(self.x[box] - centre[0], self.y[box] - centre[1])
        return np.asarray(np.clip(radius + 0.5 - away, 0.0, 1.0))

    def _centre(
        self, cover: Doubles, box: tuple[slice, slice], start: Doubles, radius: float
    ) -> tuple[Doubles, float]:
        """The disc whose visible part has the blob's middle, and the area of this part."""
        middle, centre, seen = self._middle(cover, box), np.array(start), 0.0
        wide = (
            slice(max(box[0].start - 8, 0), box[0].stop + 8),
            slice(max(box[1].start - 8, 0), box[1].stop + 8),
        )
        mask = self.cloth.mask[wide]
        for _ in range(4):
            disc = self._disc(centre, radius, wide) * mask
            seen = float(disc.sum())
            if seen < 1.0:
                break
            centre = centre + middle - self._middle(disc, wide)
        return centre, seen

    def _is_long(self, own: np.ndarray, radius: float) -> bool:
        """Whether a blob is one ball that moved while the shutter was open."""
        outlines, _ = cv2.findContours(
            own.astype(np.uint8), cv2.RETR_EXTERNAL, cv2.CHAIN_APPROX_NONE
        )
        outline = max(outlines, key=cv2.contourArea)
        narrow = min(cv2.minAreaRect(outline)[1]) + 1.0
        hull = cv2.contourArea(cv2.convexHull(outline))
        return bool(narrow < 2.5 * radius and cv2.contourArea(outline) > _SOLID * hull)

    def _discs(
        self, cover: Doubles, box: tuple[slice, slice], radius: float, share: float
    ) -> list[tuple[Doubles, bool]]:
        """Discs that explain a blob, and whether each is complete; none if discs do not explain it."""
        if share > 1.3 * _PARTS:
            return []
        reach = int(np.ceil(radius))
        y, x = np.mgrid[-reach : reach + 1, -reach : reach + 1]
        kernel = np.clip(radius + 0.5 - np.hypot(x, y), 0.0, 1.0)
        image = cover.astype(np.float32)
        score = cv2.filter2D(
            image, -1, (kernel / kernel.sum()).astype(np.float32), borderType=cv2.BORDER_CONSTANT
        )
        # the best positions, at least a ball's width apart
        centres: list[Doubles] = []
        free = score.copy()
        corner = np.array([box[1].start, box[0].start], np.float64)
        while len(centres) < _PARTS and free.size and free.max() > 0.72:
            j, i = np.unravel_index(int(free.argmax()), free.shape)
            centres.append(np.array([i, j], np.float64) + corner)
            away = np.hypot(self.x[box] - centres[-1][0], self.y[box] - centres[-1][1])
            free[away < 1.6 * radius] = 0.0
        if not centres:
            return []
        # each pixel belongs to the nearest disc, and each disc moves to the middle of its pixels
        places = np.array(centres)
        for _ in range(12):
            away = np.hypot(
                self.x[box] - places[:, 0, None, None], self.y[box] - places[:, 1, None, None]
            )
            mine = (away == away.min(axis=0)) & (away < 1.12 * radius + 0.5)
            weights = mine * cover
            total = np.maximum(weights.sum(axis=(1, 2)), 1e-9)
            places = (
                np.column_stack(
                    [
                        (weights * self.x[box]).sum(axis=(1, 2)),
                        (weights * self.y[box]).sum(axis=(1, 2)),
                    ]
                )
                / total[:, None]
            )
        discs = np.array([self._disc(place, radius + 0.7, box) for place in places])
        left = float((cover * (1.0 - discs.max(axis=0))).sum() / cover.sum())
        filled = total / (np.pi * radius**2)
        if left > _LEFT or filled.min() < 0.6:
            return []
        apart = np.hypot(*(places[:, None] - places).transpose(2, 0, 1))
        np.fill_diagonal(apart, np.inf)
        whole = (apart.min(axis=1) > 1.9 * radius) & (filled > 0.88)
        return [(place, bool(good)) for place, good in zip(places, whole)]

    def _described(
        self, part: Picture, centre: Doubles, radius: float, share: float, whole: bool
    ) -> tuple[object, ...]:
        """A row of `blob`."""
        x, y = (int(round(value)) for value in centre)
        reach = max(int(0.8 * radius), 1)
        near = part[max(y - reach, 0) : y + reach + 1, max(x - reach, 0) : x + reach + 1]
        pixels = near.reshape(-1, 3).astype(np.float64)
        if not len(pixels):
            pixels = np.zeros((1, 3))
        high, low = pixels.max(axis=1), pixels.min(axis=1)
        white = (high > _BRIGHT) & (high - low < _GREY * high)
        # a highlight is white too, so a coloured ball is described by what is not
        coloured = pixels[~white] if white.mean() < 0.9 else pixels
        place = self.cloth.camera.places(centre[None] + self.cloth.low, self.cloth.bed.radius)[0]
        colour = np.median(coloured, axis=0)
        return centre + self.cloth.low, place, share, colour, float(white.mean()), whole
