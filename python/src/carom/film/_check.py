"""An annotated frame for checking by eye: the projected noses and pockets, the balls with their
names, and the paths of the first shot.
"""

from __future__ import annotations

from pathlib import Path

import cv2
import numpy as np

from carom.dtypes import Doubles
from carom.film import Film
from carom.film._cloth import Picture

_NOSE, _WAY, _BALL, _TEXT = (0, 220, 255), (255, 200, 60), (255, 60, 255), (255, 255, 255)
_FINE = 3  # bits of a pixel's fraction that are drawn


def picture_of(film: Film) -> Picture:
    """The frame before the first shot, with the results."""
    image, camera, bed = film.picture.copy(), film.camera, film.bed

    def draw(points: Doubles, ink: tuple[int, int, int], thick: int) -> None:
        fine = np.round(camera.project(points) * 2**_FINE).astype(np.int32)
        cv2.polylines(image, [fine], False, ink, thick, cv2.LINE_AA, _FINE)

    def centre(places: Doubles) -> Doubles:
        return np.column_stack([places, np.full(len(places), bed.radius)])

    shares = np.linspace(0.0, 1.0, 30)
    for side in range(4):
        draw(bed.side(side, 0.0, shares), _NOSE, 1)
    turn = np.linspace(0.0, 2.0 * np.pi, 40)
    for x, y, radius in bed.pockets:
        ring = [x + radius * np.cos(turn), y + radius * np.sin(turn), np.full(40, bed.nose)]
        draw(np.column_stack(ring), _NOSE, 1)
    corner = camera.project(bed.side(1, 0.0, np.zeros(1)))[0]
    _write(image, "0,0", corner, _NOSE)
    for shot in film.recordings[:1]:
        for ball, rows in zip(shot.balls, shot.tracks):
            draw(centre(rows[:, 1:]), _WAY, 1)
            place = rows[:1, 1:]
            radius = float(camera.radii(place, bed.radius)[0])
            pixel = camera.project(centre(place))[0]
            fine = np.round(pixel * 2**_FINE).astype(int).tolist()
            cv2.circle(image, fine, round(radius * 2**_FINE), _BALL, 1, cv2.LINE_AA, _FINE)
            _write(image, str(ball), pixel + radius, _TEXT)
    return image


def _write(image: Picture, text: str, pixel: Doubles, ink: tuple[int, int, int]) -> None:
    """A text with a dark outline."""
    for shade, thick in (((0, 0, 0), 3), (ink, 1)):
        place = np.round(pixel).astype(int).tolist()
        cv2.putText(image, text, place, cv2.FONT_HERSHEY_SIMPLEX, 0.42, shade, thick, cv2.LINE_AA)


def save(film: Film, path: Path) -> None:
    """Write the image in the format of its file name's ending."""
    path.open("ab").close()  # open() raises the error with its reason
    try:
        done = cv2.imwrite(str(path), picture_of(film))
    except cv2.error:
        done = False
    if not done:
        raise ValueError(f"{path}: unknown image format; use the ending .png or .jpg")
