"""Moving pictures: of a shot, in a notebook or a browser, and as files."""

from __future__ import annotations

import html
import os
import sys
import tempfile
import warnings
import webbrowser
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom import pictures
from carom._rows import listing, needed, number

__all__ = ["Animation"]
__dir__ = listing(__name__)

_GIF_FPS_MOST = 50.0  # browsers show frames of less than 20 ms for 100 ms
_GIF_COLOURS = 128
_FRAMES_MOST = 20_000
_SHOWN_MOST = 100

Frame = NDArray[np.uint8]


@dataclass(frozen=True, repr=False)
class Animation(pictures.Animation):
    """A moving picture of a shot.

    Attributes
    ----------
    svg : str
        The picture as text, which moves in any browser.
    shot : Shot
    speed : float
        How many times as fast as the balls the picture moves.
    """

    shot: Any
    speed: float

    def frames(self, fps: float = 30.0) -> Iterator[Frame]:
        """The pictures one by one: uint8 of shape (height, width, 3), both sizes even.

        Parameters
        ----------
        fps : float
            Frames per second.
        """
        fps = number(fps, "fps")
        if not 0.0 < fps < np.inf:
            raise ValueError(f"fps: it must be positive and finite, not {fps}")
        shot = self.shot
        many = int(np.ceil(shot.time / self.speed * fps)) + 1
        if many > _FRAMES_MOST:
            raise ValueError(
                f"fps: {fps:g} results in {many} frames; at most {_FRAMES_MOST} are allowed: "
                "lower fps= or raise speed= of animate()"
            )
        times = np.minimum(np.arange(many) * (self.speed / fps), shot.time)
        centres = shot.positions(times)
        drawn = pictures._Pixels(pictures._Canvas(shot.table))
        cloth = pictures.pixels(shot.table).astype(np.float64)
        for row in centres:
            drawn.image = cloth.copy()
            for ball, centre in enumerate(row):
                drawn.ball(shot, ball, centre, 1.0)
            yield np.rint(drawn.image).astype(np.uint8)

    def save(self, path: str | os.PathLike[str], *, fps: float = 30.0) -> None:
        """Write the moving picture to a file, whose ending determines the format.

        Parameters
        ----------
        path : path
            `.svg` needs no other package, `.gif` needs Pillow, and `.mp4` needs imageio-ffmpeg.
        fps : float
            Frames per second, at most 50 in a GIF. An SVG has no frames: the browser draws as many
            as it can.

        Raises
        ------
        ImportError
            The package for this ending is not installed.
        ValueError
            The ending is unknown, or fps is out of range.
        """
        writers = {".gif": _save_gif, ".mp4": _save_mp4}
        ending = Path(path).suffix.lower()
        if ending == ".svg":
            Path(path).write_text(self.svg, encoding="utf-8", newline="\n")
        elif ending in writers:
            writers[ending](self, Path(path), fps)
        else:
            raise ValueError(f"path: unknown ending {ending!r}; use .svg, .gif or .mp4")


def _save_gif(animation: Animation, path: Path, fps: float) -> None:
    image = needed("PIL.Image", "save() of a .gif", "pillow")
    if number(fps, "fps") > _GIF_FPS_MOST:
        raise ValueError(
            f"fps: a GIF has at most {_GIF_FPS_MOST:g}, not {fps:g}; .mp4 may have more"
        )
    frames = [image.fromarray(frame) for frame in animation.frames(fps)]
    # One palette for all frames, so that colours do not flicker.
    palette = frames[0].quantize(_GIF_COLOURS)
    plain = image.Dither.NONE
    first, *others = [frame.quantize(palette=palette, dither=plain) for frame in frames]
    # A GIF counts hundredths of a second: rounding each end keeps the whole as long as the shot.
    ends = np.rint(np.arange(len(frames) + 1) * (100.0 / fps)).astype(int)
    durations = (10 * np.diff(ends)).tolist()
    first.save(path, format="GIF", save_all=True, append_images=others, duration=durations, loop=0)


def _save_mp4(animation: Animation, path: Path, fps: float) -> None:
    ffmpeg = needed("imageio_ffmpeg", "save() of a .mp4", "imageio-ffmpeg")
    frames = animation.frames(fps)
    first = next(frames)
    height, width = first.shape[:2]
    writer = ffmpeg.write_frames(str(path), (width, height), fps=fps, macro_block_size=2)
    writer.send(None)
    try:
        writer.send(np.ascontiguousarray(first))
        for frame in frames:
            writer.send(np.ascontiguousarray(frame))
    finally:
        writer.close()


def animated(shot: Any, speed: float) -> Animation:
    """The moving picture of a shot."""
    return Animation(pictures.animation(shot, speed).svg, shot, number(speed, "speed"))


# ---- In a notebook or a browser

_PAGE = """<!doctype html>
<html lang="en">
<meta charset="utf-8">
<title>{title}</title>
<style>
body {{ margin: 1em; font-family: sans-serif; background: #222; color: #eee }}
figure {{ margin: 0 0 2em }}
svg {{ max-width: 100%; height: auto }}
</style>
{figures}
{script}
</html>
"""
# Arrow keys leaf through several pictures; without scripts, all of them are below each other.
_LEAFING = """<script>
const figures = [...document.querySelectorAll("figure")];
let shown = 0;
const show = (k) => {
  shown = (k + figures.length) % figures.length;
  figures.forEach((figure, j) => (figure.hidden = j !== shown));
};
document.addEventListener("keydown", (event) => {
  if (event.key === "ArrowRight" || event.key === "ArrowDown") show(shown + 1);
  if (event.key === "ArrowLeft" || event.key === "ArrowUp") show(shown - 1);
});
show(0);
</script>"""


def page(pictures_of: Sequence[tuple[str, str]], title: str) -> str:
    """A page of pictures, each with a caption; several are leafed through by arrow keys."""
    figures = "\n".join(
        f"<figure>\n{svg}<figcaption>{html.escape(caption)}</figcaption>\n</figure>"
        for svg, caption in pictures_of
    )
    script = _LEAFING if len(pictures_of) > 1 else ""
    return _PAGE.format(title=html.escape(title), figures=figures, script=script)


def _notebook() -> Any:
    """IPython's display module in a notebook, else None."""
    if "IPython" not in sys.modules:
        return None
    shell = sys.modules["IPython"].get_ipython()
    if shell is None or not hasattr(shell, "kernel"):
        return None
    return needed("IPython.display", "show()")


def show(pictures_of: Sequence[tuple[str, str]], title: str) -> None:
    """Shows pictures with captions: in the output of a notebook's cell, or on a page that the
    browser opens.
    """
    display = _notebook()
    if display is not None:
        for svg, caption in pictures_of:
            display.display(display.HTML(f"<figure>{svg}{html.escape(caption)}</figure>"))
        return
    with tempfile.NamedTemporaryFile(
        "w", suffix=".html", prefix="carom-", delete=False, encoding="utf-8"
    ) as file:
        file.write(page(pictures_of, title))
    if not webbrowser.open(Path(file.name).as_uri()):
        warnings.warn(
            f"show(): no browser could be opened; the page is {file.name}", RuntimeWarning, 3
        )


def show_shots(shots: Any, speed: float) -> None:
    """Shows the shots of a batch, one after another."""
    if not 1 <= shots.size <= _SHOWN_MOST:
        raise ValueError(
            f"shots: 1 to {_SHOWN_MOST} can be shown, not {shots.size}; select some: "
            f"shots[:{_SHOWN_MOST}].show()"
        )
    pairs = []
    for index, shot in zip(np.ndindex(shots.shape), shots.flat):
        name = f"shots[{', '.join(map(str, index))}]"
        pairs.append((animated(shot, speed).svg, f"{name}: {shot!r}"))
    show(pairs, f"{shots.size} shots")
