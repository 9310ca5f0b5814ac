"""Recordings of games that verify themselves: `Recorder` plays and writes one, `replay` plays it
again and compares every bit.

A recording is text, a line of JSON after the other; docs/using/games.md has the format. Shots are
played with the instruction set plain, whose bits all machines share.
"""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, get_args

import numpy as np

from carom import dtypes
from carom._carom import ffi, lib
from carom._described import Rules as RulesWord
from carom._rows import choice, listing
from carom._shot_options import Options, StopAt, chosen, shot_options
from carom.layouts import Table, check_table, of_record, one_cue
from carom.status import CaromError, Status

__dir__ = listing(__name__)

_GAMES = {word: k for k, word in enumerate(get_args(RulesWord))}

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from carom._shot_options import Changes


@dataclass(frozen=True)
class End:
    """How a shot ended."""

    status: Status
    events: int  # their number
    time: float  # s
    hash: int  # of the lines so far, the stroke, these and all final states


@dataclass(frozen=True)
class Replayed:
    """A shot that was played again."""

    shot: int  # from 1
    line: int  # of the recording, from 1
    recorded: End
    played: End
    final: dtypes.Records  # carom.dtypes.ball_state, shape (balls,)

    @property
    def same(self) -> bool:
        """Whether every bit of its end agrees."""
        return self.recorded == self.played


def _end(of: Any) -> End:
    return End(Status(of.status), of.events, of.time, of.hash)


def _final(game: Any) -> dtypes.Records:
    size = game.count * dtypes.ball_state.itemsize
    return np.frombuffer(ffi.buffer(game.final, size), dtypes.ball_state).copy()


def _refuse(game: Any, code: int) -> None:
    """Raises an error of a recording, with its line."""
    if code == lib.CAROM_ERROR_REVISION:
        revisions = f"{game.revision}, not {lib.carom_physics_revision()}"
        raise CaromError(
            code,
            f"line {game.line}",
            text=f"the recording is of revision {revisions}: its shots have other bits here",
        )
    if code == lib.CAROM_ERROR_RECORD:
        raise CaromError(code, f"line {game.line}", text=ffi.string(game.fault).decode())


class Recorder:
    """A game on its way, and the text of it so far, `lines`."""

    def __init__(
        self,
        table: Table,
        balls: dtypes.Records,
        *,
        options: Options = Options(),
        **changes: Unpack[Changes],
    ) -> None:
        """Begin with a table, a layout as for `carom.simulate`, and the models of all shots."""
        check_table(table)
        self.lines: list[str] = []
        self._game: Any = ffi.new("carom_record *")
        self._text = ffi.new("char[]", lib.CAROM_RECORD_TEXT)
        ffi.buffer(ffi.addressof(self._game, "table"))[:] = table.record.tobytes()
        self._game.options = shot_options(chosen(options, changes))[0]
        self._until(None, ())
        self._write(lib.CAROM_RECORD_HEAD)
        self._write(lib.CAROM_RECORD_TABLE)
        self._write(lib.CAROM_RECORD_OPTIONS)
        self.balls = balls

    def __getstate__(self) -> tuple[list[str], bytes]:
        return [*self.lines], bytes(ffi.buffer(self._game))

    def __setstate__(self, state: tuple[list[str], bytes]) -> None:
        self.lines, self._game = state[0], ffi.new("carom_record *")
        self._text = ffi.new("char[]", lib.CAROM_RECORD_TEXT)
        ffi.buffer(self._game)[:] = state[1]

    @property
    def balls(self) -> dtypes.Records:
        """The layout after the last shot. One that is assigned is recorded."""
        lib.carom_record_settle(self._game)
        size = self._game.count * dtypes.shot_ball.itemsize
        return np.frombuffer(ffi.buffer(self._game.balls, size), dtypes.shot_ball).copy()

    @balls.setter
    def balls(self, balls: dtypes.Records) -> None:
        layout = of_record(balls, dtypes.shot_ball, "balls", "balls()")
        if layout.ndim != 1 or not 1 <= len(layout) <= lib.CAROM_BALLS_MOST:
            raise ValueError(
                f"balls: the shape must be (balls,) with 1 to {lib.CAROM_BALLS_MOST} balls, not {layout.shape}"
            )
        lib.carom_record_settle(self._game)
        self._game.count = len(layout)
        ffi.buffer(self._game.balls, layout.nbytes)[:] = layout.tobytes()
        self._write(lib.CAROM_RECORD_BALLS)

    def place(self, ball: int, x: float, y: float) -> None:
        """Ball in hand, as `carom.place_ball`.

        A place that is not free is refused, and nothing is recorded.
        """
        self._put(ball, lib.carom_record_place(self._game, ball, x, y, ffi.NULL))

    def hand(self, ball: int = 0) -> None:
        """A ball comes in hand, and is out of play until it is placed."""
        self._put(ball, lib.carom_record_hand(self._game, ball))

    def _put(self, ball: int, code: int) -> None:
        if code < 0:
            raise CaromError(code, f"ball {ball}")
        self._write(lib.CAROM_RECORD_PLACE)

    def stand(self, rules: str, state: Any, player: int = 0) -> None:
        """How the game stands: its name, the state of a ruling of `carom.referee` or what differs
        from a new game, and who is at the table, 0 or 1.
        """
        game = self._game
        if player not in (0, 1):
            raise ValueError(f"player: must be 0 or 1, not {player!r}")
        game.rules, game.player = choice(_GAMES, rules, "rules"), player
        fresh = lib.carom_plan_rules_of(game.rules)
        made = fresh.state
        if isinstance(state, Mapping):
            for name, value in state.items():
                setattr(made, name, value)
        else:
            ffi.buffer(ffi.addressof(made))[:] = of_record(
                state, dtypes.rules_state, "state", "referee().state"
            ).tobytes()
        wrong = lib.carom_rules_fault(game.rules, ffi.addressof(made), limits := ffi.new("char **"))
        if wrong:
            raise ValueError(
                f"{ffi.string(wrong).decode()}: by the rules {rules} it must be {ffi.string(limits[0]).decode()}"
            )
        game.standing = made
        self._write(lib.CAROM_RECORD_GAME)

    @property
    def standing(self) -> tuple[str, dtypes.Records, int]:
        """What `stand` recorded last: the name of the game, its state, and who is at the table."""
        state = np.frombuffer(
            bytearray(ffi.buffer(ffi.addressof(self._game, "standing"))), dtypes.rules_state
        ).reshape(())
        return list(_GAMES)[self._game.rules], state, self._game.player

    @classmethod
    def load(cls, recording: str | os.PathLike[str] | Iterable[str]) -> Recorder:
        """Go on with a game that was saved without its end, from a file or its lines: its shots are
        played again, as `replay` does.
        """
        game = cls.__new__(cls)
        game.__setstate__(([], bytes(ffi.sizeof("carom_record"))))
        for shot in _replay(game._game, lines_of(recording, game.lines)):
            if not shot.same:
                raise CaromError(
                    lib.CAROM_ERROR_RECORD, f"line {shot.line}", text="the shot has other bits here"
                )
        return game

    @property
    def in_hand(self) -> bool:
        """Whether a ball is in hand, and not placed yet."""
        return bool(self._game.hand)

    def settle(self, ruling: Any) -> None:
        """The layout of the next stroke as `carom.referee` rules it, and the cue ball in hand."""
        if ruling.put:
            self.balls = ruling.balls
        if ruling.hand != "no":
            self.hand()

    def shoot(
        self,
        cue: dtypes.Records,
        *,
        t_final: float | None = None,
        stop_at: StopAt | Iterable[StopAt] = (),
    ) -> End:
        """Play a stroke, up to when `carom.simulate` would stop it, and record it."""
        ffi.buffer(ffi.addressof(self._game, "cue"))[:] = one_cue(cue).tobytes()
        self._until(t_final, stop_at)
        return self._play(lib.CAROM_RECORD_SHOT)

    def resume(
        self, *, t_final: float | None = None, stop_at: StopAt | Iterable[StopAt] = ()
    ) -> End:
        """Go on with the shot that was stopped, and record it."""
        self._until(t_final, stop_at)
        return self._play(lib.CAROM_RECORD_CONTINUE)

    def end(self) -> str:
        """The whole text, with its last line: nothing follows."""
        self._write(lib.CAROM_RECORD_END)
        return "".join(self.lines)

    def _until(self, t_final: float | None, stop_at: StopAt | Iterable[StopAt]) -> None:
        until, options = (
            shot_options(Options().changed({"t_final": t_final, "stop_at": stop_at})),
            self._game.options,
        )
        options.time_most, options.stop_at, options.first_of = until.time_most, until.stop_at, 0

    def _play(self, kind: int) -> End:
        self._game.pending = 0
        code = lib.carom_record_play(self._game, kind, ffi.NULL)
        _refuse(self._game, code)
        if self._game.pending == 0:  # Nothing was played.
            raise CaromError(code)
        self._write(kind)
        return _end(self._game.played)

    def _write(self, kind: int) -> None:
        size = lib.carom_record_write(self._game, kind, self._text, len(self._text))
        if size == 0:
            raise ValueError("the recording has ended, or a number in it is not finite")
        self.lines.append(ffi.string(self._text, size).decode())


def replay(recording: str | os.PathLike[str] | Iterable[str]) -> Iterator[Replayed]:
    """Play a recording again: each of its shots, with how it ended and how that was recorded.

    Parameters
    ----------
    recording : path, or lines
        A file, or its lines, as they come.

    Raises
    ------
    CaromError
        A line is wrong, by a key or a value; the recording is of another revision of the physics;
        it is cut off.
    """
    game = ffi.new("carom_record *")
    yield from _replay(game, lines_of(recording, []))
    if game.kind != lib.CAROM_RECORD_END:
        raise CaromError(
            lib.CAROM_ERROR_RECORD,
            f"line {game.line}",
            text='cut off: there is no line {"end": ...}',
        )


def lines_of(recording: str | os.PathLike[str] | Iterable[str], kept: list[str]) -> Iterator[str]:
    if isinstance(recording, (str, os.PathLike)):
        with Path(recording).open(encoding="utf-8") as lines:
            yield from lines_of(lines, kept)
        return
    for text in recording:
        kept.append(text.rstrip() + "\n")
        yield text


def _replay(game: Any, lines: Iterable[str]) -> Iterator[Replayed]:
    for text in lines:
        line = text.encode()
        _refuse(game, lib.carom_record_read(game, line, len(line)))
        if game.pending != 1:
            continue
        code = lib.carom_record_play(game, game.kind, ffi.NULL)
        if game.pending == 1:
            raise CaromError(code, f"line {game.line}")
        yield Replayed(game.shots, game.line, _end(game.recorded), _end(game.played), _final(game))
