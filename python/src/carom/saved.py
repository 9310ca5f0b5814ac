"""Files of shots: `shot.save(path)`, `shots.save(path)` and `carom.load(path)`.

A file is a recording, text in lines of JSON, which `carom verify` and `carom.record.replay` read
too; docs/reference/files.md describes it. It contains the table, the balls, the options, each
stroke, and a hash of each shot's end, but no events: `load` plays the shots again and checks that
every bit agrees.
"""

from __future__ import annotations

import importlib
import math
import os
from collections.abc import Iterator
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from carom import dtypes
from carom._carom import ffi, lib
from carom._faults import argument_error, shot_arguments
from carom._rows import Array, listing, whole
from carom._shot_options import Options, options_of, shot_options
from carom.dtypes import Records
from carom.layouts import Table
from carom.record import _refuse, lines_of
from carom.results import Shot, Shots
from carom.shots import resume, simulate, simulate_batch
from carom.status import CaromError, Status

__all__ = ["load"]
__dir__ = listing(__name__)

_FORMAT_OF_MATCHES = 3
_ENDLESS = 1000  # parts of one shot


def _copied_to(address: Any, records: Array) -> None:
    """Writes the bytes of records to a member of a struct of C."""
    ffi.buffer(address, records.nbytes)[:] = records.tobytes()


class _Writer:
    """Writes a recording, line by line."""

    def __init__(self, table: Table, options: Options, count: int) -> None:
        self._record = ffi.new("carom_record *")
        self._text = ffi.new("char[]", lib.CAROM_RECORD_TEXT)
        self._record.count = count
        self._record.options = shot_options(options)[0]
        _copied_to(ffi.addressof(self._record, "table"), table.record)

    def head(self) -> str:
        """The lines before the first balls."""
        kinds = (lib.CAROM_RECORD_HEAD, lib.CAROM_RECORD_TABLE, lib.CAROM_RECORD_OPTIONS)
        return "".join(map(self._line, kinds))

    def end(self) -> str:
        """The last line."""
        return self._line(lib.CAROM_RECORD_END)

    def _line(self, kind: int) -> str:
        size = lib.carom_record_write(self._record, kind, self._text, lib.CAROM_RECORD_TEXT)
        if size == 0:
            raise RuntimeError(f"a line of kind {kind} of a recording cannot be written")
        return bytes(ffi.buffer(self._text, size)).decode()

    def shot(self, shot: Shot, name: str) -> str:
        """The lines of a shot, which is played again for its hash.

        A resumed shot is played in parts up to its end, because each resumption may have had its
        own condition to stop.
        """
        record = self._record
        _copied_to(record.balls, shot.balls)
        record.moved = 0
        lines = [self._line(lib.CAROM_RECORD_BALLS)]
        cue = np.zeros((), dtypes.cue) if shot.cue is None else shot.cue
        _copied_to(ffi.addressof(record, "cue"), cue)
        for part in range(_ENDLESS):
            record.options = shot_options(shot.options)[0]
            kind = lib.CAROM_RECORD_CONTINUE if part else lib.CAROM_RECORD_SHOT
            code = lib.carom_record_play(record, kind, ffi.NULL)
            if record.pending != lib.CAROM_PENDING_LINE:
                raise _not_played(shot, name, code)
            lines.append(self._line(kind))
            if record.played.status <= 0 or record.played.events >= shot.count:
                break
        final = bytes(ffi.buffer(record.final, shot.final.nbytes))
        if record.played.events != shot.count or final != shot.final.tobytes():
            raise ValueError(
                f"{name}: playing it again results in other bits, so it cannot be saved; its table, "
                "balls or cue have been changed since it was played"
            )
        return "".join(lines)


def _not_played(shot: Shot, name: str, code: int) -> Exception:
    """The error for a shot whose arguments are invalid."""
    arguments = shot_arguments(shot.table, shot.balls, shot.cue, shot_options(shot.options))
    fault = argument_error(arguments, shot.balls, shot.cue) or CaromError(code)
    return ValueError(
        f"{name}: it was not played, so it cannot be saved: {fault}; "
        "save those that were played: shots[~shots.refused].save(path)"
    )


def _write(path: str | os.PathLike[str], lines: Iterator[str]) -> None:
    """Writes a file as a whole: an error leaves an older file as it was."""
    whole_text = "".join(lines)
    Path(path).write_text(whole_text, encoding="utf-8", newline="\n")


def save_shot(shot: Shot, path: str | os.PathLike[str]) -> None:
    """Writes a shot, as `Shot.save` describes it."""
    writer = _Writer(shot.table, shot.options, len(shot.balls))
    _write(path, iter([writer.head(), writer.shot(shot, "shot"), writer.end()]))


def save_shots(shots: Shots, path: str | os.PathLike[str]) -> None:
    """Writes the shots of a batch, as `Shots.save` describes it."""
    if shots.size == 0:
        raise ValueError("shots: the batch is empty; a file needs at least one shot")
    writer = _Writer(shots.table, shots.options, shots.final.shape[-1])

    def lines() -> Iterator[str]:
        yield writer.head()
        for index, shot in zip(np.ndindex(shots.shape), shots.flat):
            yield writer.shot(shot, f"shots[{', '.join(map(str, index))}]")
        yield writer.end()

    _write(path, lines())


class _Read(NamedTuple):
    """A shot of a file: its table, balls, cue and options, and the options of its continuations."""

    table: bytes
    balls: Records
    cue: Records
    options: Options
    later: list[Options]
    line: int


def _shots_of(recording: Any) -> Iterator[_Read]:
    """The shots of a recording, each of which is played again and compared."""
    game = ffi.new("carom_record *")
    read: _Read | None = None
    for text in recording:
        line = text.encode()
        _refuse(game, lib.carom_record_read(game, line, len(line)))
        if game.pending != lib.CAROM_PENDING_SHOT:
            continue
        options, goes_on = options_of(game.options), game.kind == lib.CAROM_RECORD_CONTINUE
        code = lib.carom_record_play(game, game.kind, ffi.NULL)
        if game.pending == lib.CAROM_PENDING_SHOT:
            raise CaromError(code, f"line {game.line}")
        if bytes(ffi.buffer(ffi.addressof(game, "recorded"))) != bytes(
            ffi.buffer(ffi.addressof(game, "played"))
        ):
            raise CaromError(
                Status.ERROR_RECORD,
                f"line {game.line}",
                text=f"shot {game.shots} has other bits here than when it was recorded",
            )
        if goes_on and read is not None:
            read.later.append(options)
            continue
        if read is not None:
            yield read
        size = game.count * dtypes.shot_ball.itemsize
        balls: Records = np.frombuffer(ffi.buffer(game.balls, size), dtypes.shot_ball).copy()
        of_cue = ffi.buffer(ffi.addressof(game, "cue"))
        cue: Records = np.frombuffer(of_cue, dtypes.cue).copy().reshape(())
        of_table = bytes(ffi.buffer(ffi.addressof(game, "table")))
        read = _Read(of_table, balls, cue, options, [], game.line)
    if game.kind != lib.CAROM_RECORD_END:
        text = 'cut off: there is no line {"end": ...}'
        raise CaromError(Status.ERROR_RECORD, f"line {game.line}", text=text)
    if read is not None:
        yield read


def _played(read: _Read) -> Shot:
    """A shot of a file, with its events."""
    table = Table.from_record(np.frombuffer(read.table, dtypes.table).reshape(()))
    cue = read.cue if read.cue["speed"] > 0.0 else None
    try:
        shot = simulate(table, read.balls, cue, options=read.options)
        for options in read.later:
            shot = resume(shot, t_final=options.t_final, stop_at=options.stop_at)
    except CaromError as failed:
        if failed.shot is None:
            raise
        shot = failed.shot
    return shot


def _is_match(lines: list[str]) -> bool:
    game = ffi.new("carom_record *")
    for text in lines:
        line = text.encode()
        _refuse(game, lib.carom_record_read(game, line, len(line)))
        if game.kind == lib.CAROM_RECORD_HEAD:
            return int(game.format) == _FORMAT_OF_MATCHES
    return False


def load(
    path: str | os.PathLike[str],
    *,
    shape: int | tuple[int, ...] | None = None,
    room: int = 0,
    features: bool = False,
    rules: Any = None,
) -> Any:
    """Read what `shot.save`, `shots.save` or `match.save` wrote, or another recording.

    Every shot is played again, and its bits are compared with the recorded hash.

    Parameters
    ----------
    path : path
        A recording: lines of JSON.
    shape : int or tuple of int, optional
        The shape of a batch, whose product is the number of shots. A file does not contain it. Not
        given: one shot is a `Shot`, and n shots are `Shots` of shape (n,).
    room, features
        Of a batch, as for `carom.simulate_batch`.
    rules : Rules, optional
        Of a match by rules of your own, as for `Match.load`.

    Returns
    -------
    Shot, Shots or Match

    Raises
    ------
    CaromError
        A line is invalid; a shot has other bits; the recording is of another revision of the
        physics, or is cut off.
    ValueError
        The shots do not form a batch: they differ in tables, options or numbers of balls.

    Examples
    --------
    >>> shot.save("break.carom")
    >>> carom.load("break.carom").time == shot.time
    True
    """
    lines = list(lines_of(Path(path)))
    if _is_match(lines):
        if shape is not None:
            raise ValueError(f"shape: {os.fspath(path)} contains a match, which has no shape")
        of_games = importlib.import_module("carom.games.match")
        return of_games.Match.load(lines, rules=rules)
    found = list(_shots_of(lines))
    if not found:
        raise ValueError(f"path: {os.fspath(path)} contains no shot")
    if shape is None and len(found) == 1:
        return _played(found[0])
    sizes = (shape,) if isinstance(shape, int) else shape
    batch_shape = (len(found),) if sizes is None else tuple(whole(size, "shape") for size in sizes)
    if math.prod(batch_shape) != len(found):
        raise ValueError(
            f"shape: {batch_shape} is not the shape of the {len(found)} shots of the file"
        )
    first = found[0]
    for read in found:
        alike = (read.table, read.options, len(read.balls)) == (
            first.table,
            first.options,
            len(first.balls),
        )
        if not alike or read.later:
            what = "is continued" if read.later else "has another table, options or number of balls"
            raise ValueError(
                f"path: line {read.line}: its shot {what}, so the shots form no batch; "
                "carom.record.replay() plays them one after another"
            )
    table = Table.from_record(np.frombuffer(first.table, dtypes.table).reshape(()))
    balls: Records = np.stack([read.balls for read in found]).reshape((*batch_shape, -1))
    cues: Records | None = np.array([read.cue for read in found], dtypes.cue).reshape(batch_shape)
    if cues is not None and not (cues["speed"] > 0.0).any():
        cues = None
    return simulate_batch(table, balls, cues, room=room, features=features, options=first.options)
