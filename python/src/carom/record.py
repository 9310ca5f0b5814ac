"""Recordings of games that verify themselves: `replay` plays one again and compares every bit.

A recording is text, one line of JSON per record; docs/reference/files.md describes the format.
`carom.Match` and the command write recordings. Shots are played with the instruction set plain,
whose results have the same bits on all machines.
"""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from carom import dtypes
from carom._carom import ffi, lib
from carom._rows import listing
from carom.status import CaromError, Status

__dir__ = listing(__name__)


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
        """Whether every bit of the final states agrees."""
        return self.recorded == self.played


def _end(end: Any) -> End:
    return End(Status(end.status), end.events, end.time, end.hash)


def _final(game: Any) -> dtypes.Records:
    size = game.count * dtypes.ball_state.itemsize
    return np.frombuffer(ffi.buffer(game.final, size), dtypes.ball_state).copy()


def _refuse(game: Any, code: int) -> None:
    """Raise the error of a recording, with its line."""
    if code == lib.CAROM_ERROR_REVISION:
        revisions = f"{game.revision}, not {lib.carom_physics_revision()}"
        raise CaromError(
            code,
            f"line {game.line}",
            text=f"the recording was made with physics revision {revisions}; its shots have other bits here",
        )
    if code == lib.CAROM_ERROR_RECORD:
        raise CaromError(code, f"line {game.line}", text=ffi.string(game.fault).decode())


def replay(recording: str | os.PathLike[str] | Iterable[str]) -> Iterator[Replayed]:
    """Play a recording again, and compare the end of each shot with the recorded one.

    Parameters
    ----------
    recording : path, str, or iterable of str
        A file, a text of several lines, or an iterator of lines.

    Yields
    ------
    Replayed
        Each shot, as recorded and as played.

    Raises
    ------
    CaromError
        A line is invalid, the recording is truncated, or it was made with another revision of the
        physics.
    """
    game = ffi.new("carom_record *")
    for text in lines_of(recording):
        line = text.encode()
        _refuse(game, lib.carom_record_read(game, line, len(line)))
        if game.pending != lib.CAROM_PENDING_SHOT:
            continue
        code = lib.carom_record_play(game, game.kind, ffi.NULL)
        if game.pending == lib.CAROM_PENDING_SHOT:
            raise CaromError(code, f"line {game.line}")
        yield Replayed(game.shots, game.line, _end(game.recorded), _end(game.played), _final(game))
    if game.kind != lib.CAROM_RECORD_END:
        raise CaromError(
            lib.CAROM_ERROR_RECORD,
            f"line {game.line}",
            text='the recording is truncated: there is no line {"end": ...}',
        )


def lines_of(recording: str | os.PathLike[str] | Iterable[str]) -> Iterator[str]:
    """The lines of a recording; an empty string is not a path."""
    if isinstance(recording, str) and (recording == "" or "\n" in recording):
        yield from recording.splitlines()
    elif isinstance(recording, (str, os.PathLike)):
        with Path(recording).open(encoding="utf-8") as lines:
            yield from lines
    else:
        yield from recording
