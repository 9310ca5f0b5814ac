"""The command `python -m carom.film`."""

from __future__ import annotations

import argparse
import math
import sys
from collections.abc import Callable, Sequence
from pathlib import Path

from carom._rows import worded
from carom.film import track
from carom.film._check import save

_CANNOT = """
What it cannot do: the camera must stand still and see at least three edges of the cloth. On grey
cloth a white ball must be much brighter than the cloth. A ball that another, a hand or a cue hides has no row then. Which of several
balls of one colour is which is told by their ways alone, so in a pack that opens, names may be
swapped. A number of pool is told by the colour. The edges of the cloth lie outside the noses by a
depth that turns at cushions and balls on spots measure; a low camera sees this depth wrongly, and
--corners are then better. Look at the picture of --check before you trust the tracks: the yellow
outline must lie on the noses, which are not the edges of the cloth.
"""


def _pair(what: str, example: str) -> Callable[[str], tuple[float, float]]:
    """The reader of two numbers with a comma, for an option."""

    def read(text: str) -> tuple[float, float]:
        x, _, y = text.partition(",")
        try:
            return float(x), float(y)
        except ValueError:
            raise argparse.ArgumentTypeError(f"{text!r} is not {what}, such as {example}") from None

    return read


def _show(what: str, share: float) -> None:
    bar = "#" * round(30 * share)
    line = f"\r{what} [{bar:<30}] {100 * share:3.0f} %"
    print(line, end="\n" if share >= 1.0 else "", file=sys.stderr, flush=True)


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command.

    The exit status is 0; 2 for wrong usage or a film that cannot be tracked; or 130 if interrupted.
    """
    parser = argparse.ArgumentParser(
        prog="python -m carom.film",
        description="Tracks the balls of a film of a fixed camera: shot,ball,t,x,y in s and m.",
        epilog=_CANNOT,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("clip", type=Path, help="a film, such as an .mp4")
    parser.add_argument(
        "--table", required=True, choices=list(worded("TABLE")), help="the kind of table"
    )
    parser.add_argument(
        "--size",
        type=_pair("a size; use W,L in m", "1.17,2.34"),
        metavar="W,L",
        help="extents between the noses, m, of a table of this kind with another size",
    )
    parser.add_argument("-o", "--output", type=Path, metavar="TRACKS.csv", help="default: stdout")
    parser.add_argument(
        "--corners",
        nargs=4,
        type=_pair("a pixel; use x,y", "212,640"),
        metavar="X,Y",
        help="pixels of the corners of the noses at (0,0), (W,0), (W,L), (0,L), counterclockwise",
    )
    parser.add_argument("--focal", type=float, metavar="F", help="focal length, pixels")
    parser.add_argument("--lens", type=float, metavar="K1", help="distortion: below 0 is barrel")
    parser.add_argument(
        "--turned",
        action=argparse.BooleanOptionalAction,
        help="y begins at the upper or right end; colours on the spots of snooker tell it",
    )
    parser.add_argument("--start", type=float, default=0.0, metavar="S", help="begin here, s")
    parser.add_argument("--end", type=float, default=math.inf, metavar="S", help="end here, s")
    parser.add_argument("--check", type=Path, metavar="OUT.png", help="a picture to check by eye")
    options = parser.parse_args(arguments)
    try:
        film = track(
            options.clip,
            options.table,
            size=options.size,
            corners=options.corners,
            focal=options.focal,
            lens=options.lens,
            turned=options.turned,
            start=options.start,
            end=options.end,
            progress=_show if sys.stderr.isatty() else None,
        )
        film.write(options.output or sys.stdout)
        if options.check:
            save(film, options.check)
    except (OSError, ValueError) as error:
        print(f"carom.film: {error}", file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        print("\ncarom.film: interrupted", file=sys.stderr)
        return 130
    for shot, begin in zip(film.recordings, film.begins):
        moved = sum(len(rows) > 1 for rows in shot.tracks)
        print(
            f"{shot.id}: from {begin:.2f} s of the film for {shot.end:.2f} s, {moved} of "
            f"{len(shot.balls)} balls move",
            file=sys.stderr,
        )
    print("\n".join(film.notes), file=sys.stderr)
    if film.recordings and options.output:
        print(
            f"to fit: python -m carom.fit {options.output} --table {options.table} -o fit.json",
            file=sys.stderr,
        )
    return 0


if __name__ == "__main__":
    sys.exit(main())
