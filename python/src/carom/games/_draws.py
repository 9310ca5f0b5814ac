"""Random numbers of many games at once, each game with its own: the same whatever games are beside
it.

Draw i of a game is SplitMix64 at key + i steps (Steele, Lea, Flood, OOPSLA 2014): all games are
drawn in a few array operations.
"""

from __future__ import annotations

import functools
import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom import dtypes

Games = NDArray[np.int64]
_MIX = (
    (np.uint64(30), np.uint64(0xBF58476D1CE4E5B9)),
    (np.uint64(27), np.uint64(0x94D049BB133111EB)),
)
_11, _31 = np.uint64(11), np.uint64(31)


@functools.cache
def _steps(many: int) -> NDArray[np.uint64]:
    return np.uint64(0x9E3779B97F4A7C15) * np.arange(1, many + 1, dtype=np.uint64)


class Draws:
    """The random numbers of `games` games, each begun with a key from 0 to 2**64 - 1."""

    def __init__(self, keys: ArrayLike) -> None:
        self.keys = np.array(keys, np.uint64)

    def begin(self, games: Games, keys: ArrayLike) -> None:
        """Begins some games anew."""
        self.keys[games] = np.asarray(keys, np.uint64)

    def single(self, game: int) -> Draws:
        """The numbers of one game, as those of a game alone."""
        return Draws(self.keys[game : game + 1])

    def keep(self, game: int, drawn: Draws) -> None:
        """Go on in one game where `drawn`, of a game alone, stands."""
        self.keys[game] = drawn.keys[0]

    def key(self, game: int) -> int:
        """A seed for what draws its own numbers, from 0 to 2**53 - 1."""
        return int(self.uniform(np.array([game]), 1)[0, 0] * 2.0**53)

    def copy(self) -> Draws:
        """The same numbers once more."""
        return Draws(self.keys)

    def uniform(self, games: Games, *shape: int) -> dtypes.Doubles:
        """Numbers from 0 to 1, without 1, of shape (len(games), *shape)."""
        z = self.keys[games][:, np.newaxis] + _steps(math.prod(shape))
        self.keys[games] = z[:, -1]
        for shift, factor in _MIX:
            z ^= z >> shift
            z *= factor
        z ^= z >> _31
        z >>= _11
        numbers: dtypes.Doubles = np.multiply(z, 2.0**-53, dtype=np.float64)
        return numbers.reshape(len(games), *shape)

    def seeds(self, games: Games) -> NDArray[np.uint64]:
        """A seed of each game, for what draws its own numbers."""
        seeds: NDArray[np.uint64] = self.keys[games]
        self.keys[games] = seeds + _steps(1)
        return seeds
