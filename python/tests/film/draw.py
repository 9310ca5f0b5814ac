"""Films of shots, drawn by rays: a pinhole camera with a lens, balls as shaded spheres with
highlights and soft shadows, cushions that hide what is behind them, blur, noise, compression,
repeated pictures, and an arm with a cue over the table.

The tracker draws nothing, so nothing here is its own: each pixel has four rays, which meet the
slate, the noses' plane and the balls.
"""

import cv2
import numpy as np

CLOTHS = {
    "green": (60, 120, 30),
    "blue": (175, 130, 40),
    "grey": (110, 115, 113),
}  # blue, green, red
INKS = {
    "cue": (225, 235, 240),
    "red": (38, 28, 205),
    "yellow": (40, 190, 225),
    "green": (85, 75, 5),
    "brown": (30, 60, 105),
    "blue": (170, 75, 20),
    "pink": (165, 135, 230),
    "black": (28, 26, 25),
}
for number, ink in enumerate(
    ["yellow", "blue", "red", "purple", "orange", "green", "maroon", "black"], 1
):
    other = {"purple": (120, 30, 80), "orange": (30, 105, 230), "maroon": (25, 20, 95)}
    INKS[str(number)] = other.get(ink) or INKS[ink]
    if number < 8:
        INKS[str(number + 8)] = INKS[str(number)]
INKS["6"] = INKS["14"] = (60, 105, 15)
_WIDE = 0.0508  # m: of the cushions


def averaged(image):
    """The pixels of sub-pixels."""
    height, width = image.shape[:2]
    return image.reshape(height // 2, 2, width // 2, 2, 3).mean(axis=(1, 3))


class Film:
    """A table before a camera at `eye`, m, that looks at `target`; focal in pixels. The noses' shadow
    takes a share `shade` of the light.
    """

    def __init__(
        self, table, eye, target, focal, k1=0.0, size=(1280, 720), cloth="green", shade=0.0, seed=1
    ):
        self.table, self.cloth, self.shade = table, np.array(CLOTHS[cloth], float), shade
        self.random = np.random.default_rng(seed)
        self.place(eye, target, focal, k1, size)
        self.nose = float(table.rails["height"][0])
        self.grain = None
        self._background()

    def place(self, eye, target, focal, k1, size=(1280, 720)):
        """Puts the camera there."""
        self.size, self.focal, self.k1, self.eye = size, focal, k1, np.array(eye, float)
        forward = np.array(target, float) - self.eye
        forward /= np.linalg.norm(forward)
        # right of the picture is along x, if the camera looks straight down
        right = np.cross(forward, [0.0, 1e-3, 1.0])
        right /= np.linalg.norm(right)
        self.axes = np.array([right, np.cross(forward, right), forward])

    def pixels(self, points):
        """Where points are seen, (n, 2); a pixel's middle has whole coordinates."""
        q = (np.asarray(points) - self.eye) @ self.axes.T
        p = q[:, :2] / q[:, 2:]
        lens = 1.0 + self.k1 * (p**2).sum(axis=1, keepdims=True)
        return self.focal * p * lens + 0.5 * np.array(self.size)

    def _rays(self, x, y):
        bent = (np.stack([x, y], axis=-1) - 0.5 * np.array(self.size)) / self.focal
        p = bent
        for _ in range(5):
            p = bent / (1.0 + self.k1 * (p**2).sum(axis=-1, keepdims=True))
        return np.concatenate([p, np.ones_like(p[..., :1])], axis=-1) @ self.axes

    def _background(self):
        """Colour, and how far along its ray, of every sub-pixel of the empty table."""
        width, height = self.size
        sub = np.arange(2 * max(self.size)) / 2.0 - 0.25
        x, y = np.meshgrid(sub[: 2 * width], sub[: 2 * height])
        self.rays = self._rays(x, y)
        wide, long = self.table.width, self.table.length
        top = (self.nose - self.eye[2]) / self.rays[..., 2]
        bed = -self.eye[2] / self.rays[..., 2]
        at_top, at_bed = (
            self.eye[:2] + self.rays[..., :2] * part[..., None] for part in (top, bed)
        )

        def outside(place):
            return np.maximum(
                np.abs(place[..., 0] - wide / 2) - wide / 2,
                np.abs(place[..., 1] - long / 2) - long / 2,
            )

        far, low = outside(at_top), outside(at_bed)
        light = (
            1.0
            - 0.12
            * ((at_bed - [wide / 2, long / 2]) ** 2).sum(axis=-1, keepdims=True)
            / long**2
            * 4
        )
        colour = self.cloth * light
        self.depth = bed.copy()
        self.is_bed = (far < 0.0) & (low < 0.0)
        # the shadow of the noses darkens the cloth by a share `shade`
        colour[self.is_bed & (low > -0.022)] *= 1.0 - self.shade
        face = (far < 0.0) & (low >= 0.0)
        colour[face] *= 0.7
        self.depth[face | (far >= 0.0)] = top[face | (far >= 0.0)]
        cushion = (far >= 0.0) & (far < _WIDE)
        colour[cushion] *= 1.06
        colour[(far >= _WIDE) & (far < 0.16)] = (25, 45, 80)
        colour[far >= 0.16] = (48, 46, 50)
        for pocket in self.table.pockets:
            reach = pocket["radius"] + 0.015
            hole = np.hypot(*(at_top - pocket["centre"]).transpose(2, 0, 1)) < reach
            colour[hole] = (12, 12, 12)
        self.colour, self.at_bed = colour.astype(np.float32), at_bed.astype(np.float32)
        self.rays, self.canvas = self.rays.astype(np.float32), self.colour.copy()
        self.depth = self.depth.astype(np.float32)
        self.layers = self.depth.copy()
        self.empty = averaged(self.colour)

    def picture(self, balls):
        """The table with balls: (name, places of one exposure (n, 3), radius, axis of a stripe)."""
        image, depth, boxes = self.canvas, self.layers, []
        for _, places, radius, _ in balls:
            seen = self.pixels(places)
            reach = 1.3 * self.focal * radius / np.linalg.norm(places[0] - self.eye) + 3
            low = np.clip(np.floor(seen.min(axis=0) - reach), 0, self.size).astype(int)
            high = np.clip(np.ceil(seen.max(axis=0) + reach), 0, self.size).astype(int)
            boxes.append((slice(2 * low[1], 2 * high[1]), slice(2 * low[0], 2 * high[0])))
            # a soft shadow below, twice as wide as the ball
            away = self.at_bed[boxes[-1]] - places.mean(axis=0)[:2]
            shade = 1.0 - 0.45 * np.exp(-(away**2).sum(axis=-1) / (0.9 * radius) ** 2)
            shade[~self.is_bed[boxes[-1]]] = 1.0
            image[boxes[-1]] *= shade[..., None]
        for (name, places, radius, axis), box in zip(balls, boxes):
            parts = [
                self._ball(image[box], depth[box], self.rays[box], name, r, radius, axis)
                for r in places
            ]
            image[box] = np.mean([part[0] for part in parts], axis=0)
            depth[box] = parts[0][1]
        # only what has changed is averaged, and undone for the next picture
        drawn = self.empty.copy()
        for y, x in boxes:
            drawn[y.start // 2 : y.stop // 2, x.start // 2 : x.stop // 2] = averaged(image[y, x])
        for box in boxes:
            image[box], depth[box] = self.colour[box], self.depth[box]
        return drawn

    def _ball(self, image, depth, rays, name, centre, radius, axis):
        away = self.eye - centre
        a, b = (rays**2).sum(axis=-1), rays @ away
        root = b * b - a * (away @ away - radius**2)
        along = np.where(root > 0.0, (-b - np.sqrt(np.maximum(root, 0.0))) / a, np.inf)
        front = along < depth
        image, depth = image.copy(), np.where(front, along, depth)
        normal = (self.eye + rays[front] * along[front][:, None] - centre) / radius
        colour = np.tile(np.array(INKS[name.rstrip("0123456789") or name], float), (len(normal), 1))
        if name.isdigit():
            tilt = np.abs(normal @ axis)
            white = tilt > 0.55 if int(name) > 8 else tilt > 0.93
            colour[white] = INKS["cue"]
        lamp = np.array([0.25, -0.1, 1.0]) / np.linalg.norm([0.25, -0.1, 1.0])
        view = -rays[front] / np.linalg.norm(rays[front], axis=1, keepdims=True)
        half = (lamp + view) / np.linalg.norm(lamp + view, axis=1, keepdims=True)
        diffuse = 0.35 + 0.7 * np.clip(normal @ lamp, 0.0, 1.0)
        shine = 190.0 * np.clip((normal * half).sum(axis=1), 0.0, 1.0) ** 60
        image[front] = colour * diffuse[:, None] + shine[:, None]
        return image, depth

    def finished(self, image, arm=None, noise=2.5):
        """The picture of a camera: an arm with a cue from one place of the
        table to another above it, noise.
        """
        image = np.clip(image, 0, 255).astype(np.uint8)
        if arm is not None:
            (a, b, tip), pixels = (
                self.pixels(arm),
                lambda p: tuple(np.round(p).astype(int).tolist()),
            )
            cv2.line(image, pixels(b), pixels(tip), (110, 160, 200), 4, cv2.LINE_AA)
            cv2.line(image, pixels(a), pixels(b), (50, 40, 45), 46, cv2.LINE_AA)
            cv2.circle(image, pixels(b), 26, (120, 150, 205), -1, cv2.LINE_AA)
        if self.grain is None:
            self.grain = self.random.normal(0.0, noise, image.shape).astype(np.float32)
        # one field of noise, moved at random
        moved = np.roll(self.grain, self.random.integers(0, 999, 2), axis=(0, 1))
        return np.clip(image + moved, 0, 255).astype(np.uint8)


def positions(shot, times):
    """Places of the balls at times after the strike, (times, balls, 3): at rest before it."""
    return shot.positions(np.clip(times, 0.0, shot.time))


def write(path, scene, names, shot, radius, rate, file_rate, seconds, arm=None):
    """A film of the first seconds of a shot, and 0.6 s before it: `rate` new pictures a second in a
    file of another rate; `arm(t)` gives the places of an arm, or None. Returns the times and the
    places of the new pictures.
    """
    code = cv2.VideoWriter_fourcc(*("MJPG" if path.suffix == ".avi" else "mp4v"))
    writer = cv2.VideoWriter(str(path), code, file_rate, scene.size)
    times = np.arange(int((0.6 + seconds) * rate)) / rate - 0.6
    exposure = np.array([-2e-3, 0.0, 2e-3])
    axes = scene.random.normal(size=(len(names), 3))
    axes /= np.linalg.norm(axes, axis=1, keepdims=True)
    picture, file, middle = None, 0, []
    for k, t in enumerate(times):
        places = positions(shot, t + exposure)
        middle.append(places[1])
        balls = [
            (name, places[:, i] if np.ptp(places[:, i]) > 1e-6 else places[1:2, i], radius, axes[i])
            for i, name in enumerate(names)
            if places[1, i, 2] > -0.01
        ]
        image = scene.picture(balls)
        picture = scene.finished(image, arm(t) if arm else None)
        while file * rate / file_rate < k + 1 - 1e-9:
            writer.write(picture)
            file += 1
    writer.release()
    return times, np.array(middle)
