"""Which shot to play: the shots that win most often from a layout, for a player whose strokes err."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal

import numpy as np

from carom import dtypes
from carom._carom import ffi, lib
from carom._faults import argument_error, shot_arguments
from carom._rows import Array, choice, copied, pointer, whole
from carom._shot_options import Options, shot_options
from carom.layouts import Table, check_table, of_record, one_cue
from carom.layouts import cue as usual_cue
from carom.status import CaromError

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from carom._shot_options import Changes

Rules = Literal["eightball", "nineball", "potting"]
Group = Literal["open", "solids", "stripes"]
_RULES = {"eightball": 0, "nineball": 1, "potting": 2}
_GROUPS = {"open": 0, "solids": 1, "stripes": 2}
_USUAL = Options()


def plan(
    table: Table,
    balls: dtypes.Records,
    cue: dtypes.Records | None = None,
    *,
    rules: Rules = "eightball",
    group: Group = "open",
    errors: float = 1.0,
    shots: int = 2000,
    in_hand: bool = False,
    best: int = 5,
    seed: int = 0,
    threads: int = 0,
    options: Options = _USUAL,
    **changes: Unpack[Changes],
) -> dtypes.Records:
    """Find the best shots of a layout.

    Parameters
    ----------
    table : Table
        With pockets.
    balls : ndarray of `carom.dtypes.shot_ball`, shape (balls,)
        2 to 32 of them at rest, with the cue ball first. For eight-ball and nine-ball a ball's index is its number.
    cue : ndarray of `carom.dtypes.cue`, shape (), optional
        Its masses and its miscue count; the stroke does not. Default: that of `carom.cue()`.
    rules : {"eightball", "nineball", "potting"}
        The game, by the rules of the WPA; or a drill, whose value is the share of the balls that one visit pots.
    group : {"open", "solids", "stripes"}
        Of eight-ball: the balls of the player.
    errors : float
        Scale of the player's errors, at least 0: 0.1 m/s, 0.1 degrees and 0.003 radii at 1.
    shots : int
        That the plan plays, about: 100 to 1,000,000.
    in_hand : bool
        Whether the cue ball is in hand: `place` of the choices then says where to put it.
    best : int
        How many choices at most.
    seed : int
        Of the errors of strokes.
    threads : int
        Most threads to use; 0 is the calling one alone, -1 all processors. No bit depends on it.
    options, **changes
        As for `simulate`; t_final, stop_at and first_of are not read.

    Returns
    -------
    ndarray of `carom.dtypes.choice`, shape (up to best,)
        The best first: `cue` is the stroke, `value` the chance to win.

    Raises
    ------
    CaromError
        The layout, the cue or an option is in error.
    """
    check_table(table)
    layout = copied(of_record(balls, dtypes.shot_ball, "balls", "balls()"))
    if layout.ndim != 1:
        raise ValueError(f"balls: the shape must be (balls,), not {layout.shape}")
    if not 0.0 <= errors < np.inf:
        raise ValueError(f"errors: it must be finite and at least 0, not {errors}")
    strike = copied(one_cue(usual_cue() if cue is None else cue))
    shot = shot_options(options.changed(changes))
    wanted = ffi.new("carom_plan_options *", {"shots": whole(shots, "shots", least=100, most=1_000_000), "seed": whole(seed, "seed")})
    wanted.threads = whole(threads, "threads", least=-1)

    # The game, the player, and room for the plan.
    game = ffi.new("carom_plan_rules *", lib.carom_plan_rules_of(choice(_RULES, rules, "rules")))
    game.user[0] = choice(_GROUPS, group, "group")
    player = ffi.new("carom_player *", lib.carom_player_of(errors))
    memory: Array = np.empty(lib.carom_plan_memory(wanted) // 8 + 1, np.float64)
    record = table.record
    job = ffi.new("carom_plan_job *", {
        "table": pointer("carom_table[]", record), "balls": pointer("carom_shot_ball[]", layout), "count": len(layout),
        "cue": pointer("carom_cue[]", strike), "player": player, "rules": game, "shot": shot, "options": wanted,
        "memory": pointer("double[]", memory), "memory_size": memory.nbytes,
    })  # fmt: skip

    choices: Array = np.zeros(whole(best, "best", least=1, most=1000), dtypes.choice)
    found = ffi.new("int *")
    rows = pointer("carom_choice[]", choices)
    if in_hand:
        code = lib.carom_plan_hand(job, ffi.NULL, ffi.NULL, rows, len(choices), found)
    else:
        code = lib.carom_plan(job, rows, len(choices), found)
    if code < 0:
        raise argument_error(shot_arguments(table, layout, strike, shot), layout, strike) or CaromError(code, "balls")
    return choices[: found[0]]
