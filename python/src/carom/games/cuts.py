"""Aims at a ball by its cut, without a pocket: the part of `carom.aim` that needs no pocket."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from carom import dtypes
from carom._carom import ffi, lib
from carom._faults import argument_error, shot_arguments
from carom._rows import Array, Arrays, as_array, broadcast, copied, in_chunks, listing, pointer
from carom._rows import whole
from carom._shot_options import Options, shot_options
from carom.dtypes import Doubles, Records
from carom.layouts import Table, check_table, of_record
from carom.status import CaromError

__all__ = ["Hit"]
__dir__ = listing(__name__)


@dataclass(frozen=True, repr=False)
class Hit(Arrays):
    """Strokes with which the cue ball meets a ball at a cut."""

    cue: Records
    """An array of `carom.dtypes.cue`, of the shape to which the cues and the cuts broadcast."""
    cut: Doubles
    """Degrees, of the same shape: above 0, the ball leaves to the left of the cue ball's path."""
    elevation: Doubles
    """Degrees, of the same shape: the least elevation with which the stick clears the cushions and
    the balls behind the cue ball. A stroke with a lower `cue["theta"]` cannot be played.
    """


_WHY_NOT = {
    lib.CAROM_POT_NO_WAY: "no direction of the cue makes the cue ball meet it first at this cut",
    lib.CAROM_POT_BARRED: "{obstacle} is in the way",
    lib.CAROM_POT_SHORT: "the cue ball comes to rest before it; raise the cue's speed",
    lib.CAROM_POT_STICK: (
        "the stick would have to be raised by {elevation:.1f} degrees to clear what is behind the "
        "cue ball; nobody plays above 60"
    ),
}


def _reason(pot: Any, cue_ball: int) -> str:
    """Why there is no such aim, in words."""
    obstacle = "a cushion, a jaw or a pocket"
    if pot.met.type == lib.CAROM_EVENT_BALL_BALL:
        obstacle = f"ball {pot.met.b if pot.met.a == cue_ball else pot.met.a}"
    return _WHY_NOT[pot.outcome].format(obstacle=obstacle, elevation=pot.elevation)


def aim_by_cut(
    table: Table, balls: Records, cue: Records, ball: int, cut: ArrayLike, options: Options
) -> Hit:
    """Aim at a ball without a pocket, as `carom.aim` describes it."""
    check_table(table)
    layout = copied(of_record(balls, dtypes.shot_ball, "balls", "balls()"))
    if layout.ndim != 1:
        raise ValueError(f"balls: the shape must be (balls,), not {layout.shape}")
    index = whole(ball, "ball", least=0, most=len(layout) - 1)
    cues = of_record(cue, dtypes.cue, "cue", "cue()")
    angles = as_array(cut, "cut", np.float64)
    shape = broadcast({"cue": cues.shape, "cut": angles.shape})
    aimed = copied(np.broadcast_to(cues, shape))
    cuts: Doubles = np.array(np.broadcast_to(angles, shape), np.float64)
    wrong = cuts[~(np.abs(cuts) < 90.0)]
    if wrong.size:
        raise ValueError(f"cut: it must be above -90 and below 90 degrees, not {wrong.flat[0]:g}")
    if (aimed["ball"] == index).any():
        raise ValueError(f"ball: {index} is the cue ball; it must be another one")
    if layout["state"]["label"][index] == lib.CAROM_BALL_POCKETED:
        raise ValueError(f"ball: {index} is pocketed; it must be on the table")

    # Each aim is a call of C, which lets other threads run and Ctrl-C end the loop between chunks.
    flat_cues, flat_cuts = aimed.reshape(-1), cuts.reshape(-1)
    elevations: Doubles = np.zeros(flat_cuts.shape)
    shot, of_table = shot_options(options), pointer("carom_table[]", table.record)
    of_balls, of_cues = pointer("carom_shot_ball[]", layout), pointer("carom_cue[]", flat_cues)
    pot = ffi.new("carom_pot *")

    def aim_one(row: int) -> None:
        pot.ball, pot.pocket, pot.cut = index, lib.CAROM_POT_NO_POCKET, flat_cuts[row]
        code = lib.carom_aim(of_table, of_balls, len(layout), shot, pot, of_cues + row)
        stroke: Array = flat_cues[row].reshape(())
        if code < 0:
            arguments = shot_arguments(table, layout, stroke, shot)
            raise argument_error(arguments, layout, stroke) or CaromError(code, "balls")
        if pot.outcome != lib.CAROM_POT_FALLS:
            place = f"[{', '.join(map(str, np.unravel_index(row, shape)))}]" if shape else ""
            raise ValueError(
                f"cut{place}: no aim at ball {index} with a cut of {flat_cuts[row]:g} degrees: "
                f"{_reason(pot, int(stroke['ball']))}"
            )
        elevations[row] = pot.elevation

    def chunk(begin: int, many: int) -> int:
        for row in range(begin, begin + many):
            aim_one(row)
        return 0

    in_chunks(math.prod(shape), 1e-3, 0, chunk)
    return Hit(aimed, cuts, elevations.reshape(shape))
