"""Random numbers for many games at once.

Each game has a separate stream, which does not depend on the other games. Draw i of a game is
SplitMix64 at key + i steps (Steele, Lea, Flood, OOPSLA 2014), so a few array operations draw for
all games.
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
    """The random numbers of several games, each started from a key from 0 to 2**64 - 1."""

    def __init__(self, keys: ArrayLike) -> None:
        self.keys = np.array(keys, np.uint64)

    def begin(self, games: Games, keys: ArrayLike) -> None:
        """Restart some games."""
        self.keys[games] = np.asarray(keys, np.uint64)

    def single(self, game: int) -> Draws:
        """The stream of one game."""
        return Draws(self.keys[game : game + 1])

    def keep(self, game: int, drawn: Draws) -> None:
        """Set the stream of one game to the position of `drawn`, a stream from `single`."""
        self.keys[game] = drawn.keys[0]

    def key(self, game: int) -> int:
        """A seed for another generator, from 0 to 2**53 - 1."""
        return int(self.uniform(np.array([game]), 1)[0, 0] * 2.0**53)

    def copy(self) -> Draws:
        """A copy, which draws the same numbers."""
        return Draws(self.keys)

    def uniform(self, games: Games, *shape: int) -> dtypes.Doubles:
        """Uniform numbers in [0, 1), of shape (len(games), *shape)."""
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
        """One seed per game, for other generators."""
        seeds: NDArray[np.uint64] = self.keys[games]
        self.keys[games] = seeds + _steps(1)
        return seeds
