"""What a step of each environment of `carom.gymnasium` costs with random actions.

    python games_speed.py [ROUNDS]

Each round plays some steps of every environment, by one thread and by two where strokes of many
games are one batch, so that other work on the machine slows all of them alike. Printed are medians
over the rounds (default 15): processor time of a step of one game, and steps a second by the clock
with the first and the third quartile.
"""

from __future__ import annotations

import sys
import time
from typing import Any

import gymnasium
import numpy as np

import carom.gymnasium

# Games against an opponent, which are played one after another, and how many of them at once. The
# opponent of "match" plans each stroke.
MATCHES = {"nineball": 64, "eightball": 64, "match": 4}
OTHERS = {"carom/Potting-v1": {"balls": 5, "strokes": 5}}


def make_game(name: str, threads: int) -> Any:
    """The games of an environment; None for threads and matches, which take none."""
    word = carom.gymnasium.GAMES[name].get("game", "potting")
    is_match = word in MATCHES
    if is_match and threads:
        return None
    chosen: dict[str, Any] = {} if is_match else {"threads": threads}
    games = gymnasium.make_vec(name, MATCHES.get(word, 256), **chosen, **OTHERS.get(name, {}))
    games.reset(seed=1)
    games.action_space.seed(1)
    return games


def spent(games: Any, steps: int) -> tuple[float, float]:
    """Processor time and time by the clock of a step of one game, s."""
    actions = [games.action_space.sample() for _ in range(steps)]
    processor, clock = time.process_time(), time.perf_counter()
    for action in actions:
        games.step(action)
    played = steps * games.num_envs
    return (time.process_time() - processor) / played, (time.perf_counter() - clock) / played


def main() -> None:
    rounds = int(sys.argv[1]) if len(sys.argv) > 1 else 15
    rows = [
        (name, max(threads, 1), games)
        for name in carom.gymnasium.GAMES
        for threads in (0, 2)
        if (games := make_game(name, threads))
    ]
    times = np.array(
        [
            [spent(games, 8 if games.num_envs == 256 else 2) for *_, games in rows]
            for _ in range(rounds)
        ]
    )
    for (name, threads, games), processor, clock in zip(rows, *times.transpose(2, 1, 0)):
        low, middle, high = 1.0 / np.quantile(clock, [0.75, 0.5, 0.25])
        print(
            f"{name:23} {games.num_envs:3} games, threads {threads}:"
            f" {1e6 * np.median(processor):7.1f} us, {middle:7.0f} steps/s ({low:.0f} to {high:.0f})"
        )


if __name__ == "__main__":
    main()
