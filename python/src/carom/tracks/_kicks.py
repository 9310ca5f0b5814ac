"""Kicks: the errors of the models at each contact of recorded shots.

A kick is a small change of the motion just after a contact: five numbers relative to the speed V
before it, as in loops.h. The cost of a shot with kicks y is the cost of `_strikes` plus PRICE
(y/s)^2 for each kick, with the deviations s of CUSHION and BALLS. From known strikes, Levenberg and
Marquardt's method descends over the strike and the kicks of the first 16 contacts, with more and
more of the samples. There is no chaos, because the track fixes the balls at every contact.

There the cost is c + 2 g d + d^T H d for a change d of strike and kicks, with g = J^T W d and H =
J^T W J. The noise of the samples therefore moves the kicks by (H + D)^-1 J^T noise, where D is
diag(PRICE/s^2), and 0 for the strike. The noise of the initial positions, which are fixed, moves
them as in `_covariance`.
"""

from __future__ import annotations

import copy
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom import dtypes
from carom._carom import lib
from carom._rows import Array, Arrays
from carom.dtypes import Doubles, Records
from carom.status import CaromError
from carom.tracks import _strikes
from carom.tracks._strikes import KICKS, Plays

CONTACTS = 16  # of a shot, at most, that have kicks
PRICE = 1e-4  # m^2
CUSHION, BALLS = (
    np.array([0.01, 0.01, 0.03, 0.03, 0.03]),
    np.array([0.01, 0.01, 0.01, 0.02, 0.02]),
)
_HORIZONS, _STEPS = (2.0, 4.0, 8.0, np.inf), 8  # samples up to a time, s, and iterations with them
CONTACT_TYPES = (lib.CAROM_EVENT_BALL_BALL, lib.CAROM_EVENT_RAIL, lib.CAROM_EVENT_JAW)
_FEWEST = 8  # contacts of a row of a table
_WORST = 0.02  # m: a shot that is so far off, with kicks, does not count
_REST = 1e-5  # m: step of the differences by the places of rest


def contacts(plays: Plays, row: int, numbers: Doubles) -> Records:
    """The first contacts of a play, as events."""
    try:
        events, _ = plays.played(row, numbers)
    except CaromError:
        events = np.zeros(0, dtypes.event)
    met_contacts: Records = events[np.isin(events["type"], CONTACT_TYPES)]
    return met_contacts[:CONTACTS]


def deviations(met_contacts: Records) -> Doubles:
    """s of the kicks of contacts, (CONTACTS, KICKS); after the last contact the cushion's."""
    found = np.tile(CUSHION, (CONTACTS, 1))
    found[: len(met_contacts)][met_contacts["type"] == lib.CAROM_EVENT_BALL_BALL] = BALLS
    return found


def _held(met_contacts: Sequence[Records]) -> Doubles:
    """The cost of the square of each parameter, (shots, numbers)."""
    price = np.zeros((len(met_contacts), 6 + KICKS * CONTACTS))
    for k, events in enumerate(met_contacts):
        price[k, 6:] = PRICE / deviations(events).ravel() ** 2
    return price


def find(plays: Plays, strikes: Doubles) -> Doubles:
    """Strikes and kicks, (shots, 6 + 5 CONTACTS), from strikes on the plays' clocks."""
    numbers = np.zeros((len(strikes), 6 + KICKS * CONTACTS))
    numbers[:, :6] = strikes
    rows = np.arange(len(strikes), dtype=np.int32)
    ends = plays.ends
    for horizon in _HORIZONS:
        held = _held([contacts(plays, int(k), numbers[k]) for k in rows])
        numbers, _ = _strikes.descend(
            plays, rows, numbers, np.minimum(horizon, ends), _STEPS, held=held
        )
    return numbers


# ---- The quadratic


@dataclass(frozen=True)
class Quadratic:
    """The cost of a shot near the strike and the kicks that were found, without the parameters of
    contacts that did not occur.
    """

    row: int
    contacts: Records  # (contacts,), as `contacts` gives
    start: float  # the time of the strike on the plays' clock, s
    kicks: Doubles  # (5 contacts,)
    cost: float
    count: float  # samples
    g: Doubles  # (numbers,)
    H: Doubles  # (numbers, numbers)
    rest: Doubles  # (numbers, 2 balls): J^T W J_r, with the derivatives by the places of rest
    price: Doubles  # (numbers,): D

    @property
    def good(self) -> bool:
        return self.cost < self.count * _WORST**2

    def inverse(self, price: Doubles) -> Doubles:
        """The inverse of H with the price of each parameter; parameters without samples stay fixed."""
        M = self.H + np.diag(price)
        scale = np.sqrt(M.diagonal()) + 1e-30
        return np.asarray(
            np.linalg.inv(M / np.outer(scale, scale) + 1e-11 * np.eye(len(M)))
            / np.outer(scale, scale)
        )


def with_positions(plays: Plays) -> tuple[Plays, Doubles]:
    """The plays with the initial positions as the constants that `misfit` differentiates by, and the
    signs, (shots, 2 balls), that make its derivatives those by the positions.

    A position is moved towards the middle of the table, and never into a cushion.
    """
    varied = copy.copy(plays)
    steps = np.where(plays.centres < 0.5 * np.array(plays.table_size), _REST, -_REST)
    base = plays.layouts[0].copy()
    base["state"]["r"][..., :2] = plays.centres
    moved = [base]
    for ball in range(plays.centres.shape[1]):
        for axis in range(2):
            layouts = base.copy()
            layouts["state"]["r"][:, ball, axis] += steps[:, ball, axis]
            moved.append(layouts)
    varied.layouts, varied.steps = np.array(moved), np.full(len(moved) - 1, _REST)
    varied.tables = np.repeat(plays.tables[:1], len(moved))
    return varied, np.sign(steps).reshape(len(steps), -1)


def quadratics(plays: Plays, numbers: Doubles) -> list[Quadratic]:
    """The quadratics of the shots that are played to their ends and have contacts."""
    variations, sign = with_positions(plays)
    rows = np.arange(len(numbers), dtype=np.int32)
    sums = variations.misfit(rows, numbers, plays.ends, np.inf)
    square, gradient = _strikes.normal(sums)
    found = []
    for k in rows:
        met_contacts = contacts(plays, int(k), numbers[k])
        m = 6 + KICKS * len(met_contacts)
        if len(met_contacts) == 0 or not np.isfinite(sums[k, 0]) or not square[k].any():
            continue
        found.append(
            Quadratic(
                int(k),
                met_contacts,
                float(numbers[k, 5]),
                numbers[k, 6:m],
                float(sums[k, 0]),
                float(sums[k, 2]),
                gradient[k, :m],
                square[k, :m, :m],
                square[k, :m, numbers.shape[1] :] * sign[k],
                _held([met_contacts])[0, :m],
            )
        )
    return found


# ---- The report

contact = np.dtype(
    [
        ("shot", "i8"),
        ("contact", "i8"),
        ("time", "f8"),
        ("r", "f8", 2),
        ("a", "i8"),
        ("b", "i8"),
        ("rail", "i8"),
        ("struck", "?"),
        ("v", "f8"),
        ("v_n", "f8"),
        ("angle", "f8"),
        ("side", "f8"),
        ("kick", "f8", KICKS),
        ("error", "f8", KICKS),
        ("share", "f8", KICKS),
        ("effect", "f8"),
    ]
)
"""A contact: index of the recording and the number of the contact, both from 0; when, on the
recording's clock (s); where ball a was (m); indices of ball a, and of ball b or -1; whether one of
them is the struck ball; the rail, 0 to 3 for y = 0, x = W, y = L, x = 0, 4 for a pocket's facing,
5 for its jaw, or -1. Before it: the speed V that kicks are over, that of ball a at a cushion, that of closing of
two balls (m/s); the speed into the cushion, or V; the angle to the normal (degrees), and R w_z
(m/s) of ball a. The kicks, over V: at a cushion velocity along and away from it, roll along and
away from it, R w_z, where `along` is the direction in which the ball moves along the cushion, and
w_z is positive where the ball rolls that way on the cushion; of balls those of loops.h, with t the
direction in which the surface of a slips along b. Their errors, by the noise of the recording
alone; which share of a kick the track tells, 0 to 1; and what the RMSE of the shot owes to the
kicks of this contact alone, m.
"""

OUTPUTS = {
    True: ("along", "away", "roll along", "roll away", "side spin"),
    False: ("apart", "throw", "roll by friction", "side spin of a", "side spin of b"),
}
"""The five kicks of a contact with a cushion, and of one with a ball."""


@dataclass(frozen=True, eq=False, repr=False)
class Kicks(Arrays):
    """The errors of the models at each contact; see `carom.fit.Fit.kicks`."""

    contacts: Records  # (n,) of `contact`
    rmse: Doubles  # (shots,): with kicks, m; NaN of shots without a play
    numbers: (
        Doubles  # (shots, 86): strike, on the clock of the plays, and kicks as loops.h has them
    )
    # Of cushions and of balls, by rail, ball, speed and angle, the names of the columns first: how
    # many contacts, the median effect, and what all kicks of the row have in common, in % of V,
    # with its error
    tables: tuple[list[list[str]], list[list[str]]]

    def to_list(self) -> list[dict[str, Any]]:
        """Return the contacts, for JSON."""
        return [
            {name: play[name].tolist() for name in contact.names or ()} for play in self.contacts
        ]

    def markdown(self) -> str:
        """Return the tables as Markdown."""
        lines = []
        for table in self.tables:
            lines += [f"| {' | '.join(cells)} |" for cells in table]
            lines[1 - len(table) : 1 - len(table)] = (
                ["|---|" + "--:|" * (len(table[0]) - 1)] if len(table) > 1 else []
            )
            lines.append("")
        return "\n".join(lines)

    def marks(self, shot: int) -> list[tuple[Doubles, float, str, str]]:
        """Return marks for the contacts of a shot: position, size (m), and the dominant kick as a
        long and a short text.
        """
        marks = []
        for play in self.contacts[self.contacts["shot"] == shot]:
            cushion = play["rail"] >= 0
            largest = int(np.argmax(np.abs(play["kick"]) / (CUSHION if cushion else BALLS)))
            short = f"{OUTPUTS[bool(cushion)][largest]} {100.0 * play['kick'][largest]:+.1f} %"
            long = ", ".join(
                f"{name} {100.0 * kick:+.2f} ± {100.0 * error:.2f} %"
                for name, kick, error in zip(OUTPUTS[bool(cushion)], play["kick"], play["error"])
            )
            marks.append(
                (
                    play["r"],
                    float(play["effect"]),
                    f"contact {play['contact'] + 1} at {play['time']:.2f} s, {1e3 * play['effect']:.1f} mm: {long}",
                    short,
                )
            )
        return marks


def report(plays: Plays, strikes: Doubles, shots: Sequence[int], count: int) -> Kicks:
    """The kicks for strikes on the plays' clocks; shots[k] of `count` recordings is the plays' shot
    k.
    """
    found = find(plays, strikes)
    numbers, rmse = np.full((count, found.shape[1]), np.nan), np.full(count, np.nan)
    numbers[shots], rmse[shots] = found, plays.rmse(found)
    fits_near = quadratics(plays, found)
    records, turns = (
        (
            list(part)
            for part in zip(*(_contacts(play, plays, shots[play.row]) for play in fits_near))
        )
        if fits_near
        else ([], [])
    )
    # shots that kicks do not explain have no information on their contacts
    good = [k for k, play in enumerate(fits_near) if play.good]
    tables = [
        _table(
            [fits_near[k] for k in good],
            [records[k] for k in good],
            [turns[k] for k in good],
            cushion,
        )
        for cushion in (True, False)
    ]
    return Kicks(
        np.concatenate([np.zeros(0, contact), *records]), rmse, numbers, (tables[0], tables[1])
    )


def _contacts(play: Quadratic, plays: Plays, number: int) -> tuple[Records, Doubles]:
    """The contacts of a shot, of that number, and the signs, (n, 5), that turn their kicks into
    those of loops.h.
    """
    shot, n = plays.recordings[play.row], len(play.contacts)
    records: Array = np.zeros(n, contact)
    records["shot"], records["contact"], records["time"] = (
        number,
        np.arange(n),
        play.contacts["time"] + play.start + plays.origins[play.row],
    )
    cushion = play.contacts["type"] != lib.CAROM_EVENT_BALL_BALL
    jaw = play.contacts["type"] == lib.CAROM_EVENT_JAW
    a, b = play.contacts["before"][:, 0], play.contacts["before"][:, 1]
    records["r"], records["a"], records["b"] = (
        a["r"][:, :2],
        play.contacts["a"],
        np.where(cushion, -1, play.contacts["b"]),
    )
    records["struck"] = (records["a"] == shot.cue) | (records["b"] == shot.cue)
    into_rails = -_strikes.inward(plays.table)
    of_rail = into_rails[np.where(cushion & ~jaw, play.contacts["b"], 0)]
    records["rail"] = np.where(cushion, np.where(jaw, _JAW, _side_of(of_rail)), -1)
    if jaw.any():
        into = plays.table.jaws["centre"][play.contacts["b"][jaw]] - a["r"][jaw, :2]
        of_rail[jaw] = into / np.hypot(*into.T)[:, None]
    records["side"] = plays.radius * a["w"][:, 2]
    # the normal, and the direction along it
    line = b["r"][:, :2] - a["r"][:, :2]
    normal = np.where(
        cushion[:, None],
        of_rail,
        line / np.maximum(np.hypot(*line.T), 1e-9)[:, None],
    )
    v = a["v"][:, :2] - np.where(cushion[:, None], 0.0, b["v"][:, :2])
    into, along = (v * normal).sum(axis=1), v[:, 0] * normal[:, 1] - v[:, 1] * normal[:, 0]
    slip = along - np.where(cushion, 0.0, plays.radius * (a["w"][:, 2] + b["w"][:, 2]))
    records["v_n"], records["v"] = into, np.where(cushion, np.hypot(*v.T), into)
    records["angle"] = np.degrees(np.arctan2(np.abs(along), into))
    # how the noise moves the kicks, and the fraction of them that the track determines
    inverse = play.inverse(play.price)
    still = np.repeat(shot.still, 2) * (shot.noise / shot.deviations(shot.rest).ravel()) ** 2
    spread = inverse @ (play.H + (play.rest / still) @ play.rest.T) @ inverse
    seen = play.H[6:, 6:] - play.H[6:, :6] @ np.linalg.pinv(play.H[:6, :6]) @ play.H[:6, 6:]
    y = play.kicks.reshape(n, KICKS)
    parts = [slice(KICKS * j, KICKS * (j + 1)) for j in range(n)]
    records["effect"] = [
        np.sqrt(max(float(k @ seen[part, part] @ k), 0.0) / play.count) for k, part in zip(y, parts)
    ]
    records["error"] = shot.noise * np.sqrt(spread.diagonal().clip(0.0)).reshape(-1)[6:].reshape(
        n, KICKS
    )
    records["share"] = np.clip((inverse @ play.H).diagonal()[6:].reshape(n, KICKS), 0.0, 1.0)
    # the mirror image of a contact has the same numbers
    turned = np.where(np.where(cushion, along, slip) < 0.0, -1.0, 1.0)[:, None]
    odd = np.where(cushion[:, None], np.array([1, 0, 1, 0, 1]), np.array([0, 1, 0, 1, 1])).astype(
        bool
    )
    records["side"] *= turned[:, 0]
    turn = np.where(odd, turned, 1.0)
    records["kick"] = turn * y
    return records, turn


def _means(
    found: Sequence[Quadratic], chosen: Sequence[Array], turns: Sequence[Doubles]
) -> tuple[Doubles, Doubles]:
    """The mean kicks of all chosen contacts, five numbers, and their errors from the scatter of the
    shots.

    They are fitted in addition to the separate kick of each contact. A kick that a track determines
    only partly is too small, and so is the mean of such kicks; this estimate is not.
    """
    middle = 2.0 * float(np.median([play.cost / play.count for play in found]))
    whole, slopes = np.zeros((KICKS, KICKS)), []
    for play, picked, turn in zip(found, chosen, turns):
        J = np.concatenate(
            [np.zeros((6, KICKS)), *(picked[j] * np.diag(turn[j]) for j in range(len(picked)))]
        )
        inverse = play.inverse(play.price)
        Q = np.diag(play.price) - play.price[:, None] * inverse * play.price
        linear = play.price * (inverse @ play.g)
        y = np.concatenate([np.zeros(6), play.kicks])
        weight = 1.0 / (play.count * middle + play.cost)
        whole += weight * J.T @ Q @ J
        slopes.append((weight * J.T @ Q @ J, weight * J.T @ (Q @ y - linear)))
    inverted = np.linalg.pinv(whole)
    mean = inverted @ sum(slope for _, slope in slopes)
    left = np.array([slope - part @ mean for part, slope in slopes])
    return mean, np.sqrt((inverted @ left.T @ left @ inverted).diagonal())


_RAILS = ("y = 0", "x = W", "y = L", "x = 0", "of a pocket's facing", "of a pocket's jaw")
_JAW = len(_RAILS) - 1
_NORMALS = np.array([[0.0, -1.0], [1.0, 0.0], [0.0, 1.0], [-1.0, 0.0]])  # into the first four


def _side_of(normals: Doubles) -> NDArray[np.intp]:
    """The index in _RAILS of each normal of (n, 2)."""
    along = normals @ _NORMALS.T
    return np.where(along.max(axis=1) > 1.0 - 1e-9, along.argmax(axis=1), len(_NORMALS))


_SPEEDS, _ANGLES = (0.0, 0.5, 1.0, 2.0, np.inf), (0.0, 30.0, 60.0, 90.0)


def _table(
    found: Sequence[Quadratic], tables: Sequence[Records], turns: Sequence[Doubles], cushion: bool
) -> list[list[str]]:
    """The mean kicks of cushions or balls as a table, the names of the columns first."""
    kicks: Records = np.concatenate([np.zeros(0, contact), *tables])
    of_kind = (kicks["rail"] >= 0) == cushion
    groups = [("all", of_kind)]
    if cushion:
        groups += [(f"rail {name}", kicks["rail"] == k) for k, name in enumerate(_RAILS)]
    groups += [
        ("struck ball", kicks["struck"]),
        ("other balls" if cushion else "two others", ~kicks["struck"]),
    ]
    for name, unit, field, edges in (
        ("speed", "m/s", "v_n", _SPEEDS),
        ("angle", "degrees", "angle", _ANGLES),
    ):
        for low, high in zip(edges[:-1], edges[1:]):
            part = (kicks[field] >= low) & (kicks[field] < high)
            groups.append(
                (
                    f"{name} above {low:g} {unit}"
                    if high == np.inf
                    else f"{name} {low:g} to {high:g} {unit}",
                    part,
                )
            )
    lines = [
        [
            "cushions" if cushion else "balls",
            "contacts",
            "effect, mm",
            *(f"{name}, %" for name in OUTPUTS[cushion]),
        ]
    ]
    cuts = np.cumsum([0, *map(len, tables)])
    for name, part in groups:
        part = part & of_kind
        if part.sum() >= _FEWEST:
            means = _means(found, [part[a:b] for a, b in zip(cuts[:-1], cuts[1:])], turns)
            cells = [f"{100.0 * value:+.2f} ± {100.0 * error:.2f}" for value, error in zip(*means)]
            lines.append(
                [name, str(part.sum()), f"{1e3 * np.median(kicks['effect'][part]):.1f}", *cells]
            )
    return lines
