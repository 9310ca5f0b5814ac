"""Agents play the same games of potting: at random, greedy for the next stroke, and the library's planner with some numbers of shots.

The greedy agent aims as players do: for each ball and pocket at the ghost ball, the place where the cue ball must be when it touches
the ball to drive it straight to the pocket. Friction throws the ball off that line, and other balls are in the way; so it tries each
aim at some speeds and a little to both sides, all in one `carom.simulate_batch`, and takes the stroke with the highest reward, and of
those the one whose neighbours do best. It does not think of the stroke after. The planner does, and knows how strokes err.

All begin each game with the same layout. What is printed is the mean of balls potted (less fouls) with its 95 % interval, and in how many games
all balls were potted without a foul.

    python potting_agents.py --game carom/RunOutSix-v0 --games 400 --plans 300,2000
"""

from __future__ import annotations

import argparse
from collections.abc import Callable
from pathlib import Path
from typing import Any

import gymnasium
import numpy as np
import numpy.typing as npt

import carom
import carom.gymnasium
from carom.potting import Potting

Doubles = npt.NDArray[np.float64]
Agent = Callable[[Potting, Doubles], Doubles]

SPEEDS = np.array([1.5, 2.5, 4.0])  # m/s, of the cue
SIDES = np.linspace(-1.5, 1.5, 13)  # degrees, to both sides of an aim
MOST_CUT = 80.0  # degrees


def random_agent(seed: int) -> Agent:
    """Any direction, speed and place of the tip."""
    generator = np.random.default_rng(seed)
    return lambda rules, observation: np.asarray(generator.uniform(-1.0, 1.0, 4))


def aims(rules: Potting, observation: Doubles) -> Doubles:
    """The directions, degrees, from the cue ball to the ghost balls of all balls in play and all pockets, shape (aims,)."""
    seen = observation[:-1].reshape(-1, 3)
    cue_ball, balls = seen[0, :2], seen[1:][seen[1:, 2] != 0.0][:, :2]
    way = rules.table.pockets["centre"][np.newaxis] - balls[:, np.newaxis]
    way /= np.linalg.norm(way, axis=-1, keepdims=True)
    line = balls[:, np.newaxis] - 2.0 * rules.radius * way - cue_ball
    line /= np.linalg.norm(line, axis=-1, keepdims=True)
    possible = (line * way).sum(axis=-1) > np.cos(np.radians(MOST_CUT))
    # Where no ball can be cut into a pocket, the balls themselves are aimed at.
    chosen = line[possible] if possible.any() else balls - cue_ball
    return np.asarray(np.degrees(np.arctan2(chosen[:, 1], chosen[:, 0])))


def greedy_agent(rules: Potting, observation: Doubles) -> Doubles:
    """The best of the strokes that are tried."""
    phi = aims(rules, observation)[:, np.newaxis, np.newaxis] + SIDES
    actions = rules.actions(*np.broadcast_arrays(phi, SPEEDS[:, np.newaxis]))
    rewards = rules.play(rules.layouts(observation), actions).rewards
    # A small part of the mean of a stroke and its neighbours to both sides decides between equals.
    padded = np.pad(rewards, ((0, 0), (0, 0), (1, 1)), mode="edge")
    valued = rewards + 0.01 * (padded[..., :-2] + rewards + padded[..., 2:]) / 3.0
    chosen: Doubles = actions[np.unravel_index(valued.argmax(), valued.shape)]
    return chosen


def planner(shots: int) -> Agent:
    """The library's, with so many shots a stroke."""
    return lambda rules, observation: rules.best(rules.layouts(observation), shots=shots)


def play(agent: Agent, game: str, games: int, seed: int, **rules: Any) -> tuple[Doubles, str]:
    """The return of each of many games, the layout of game k drawn from seed + k; and the picture of the best stroke."""
    envs: Any = gymnasium.make_vec(game, num_envs=games, render_mode="svg", **rules)
    observations, _ = envs.reset(seed=seed)
    returns, running, most, best = np.zeros(games), np.ones(games, np.bool_), -np.inf, ""
    while running.any():
        actions = np.zeros((games, 4))
        for k in np.flatnonzero(running):
            actions[k] = agent(envs.rules, observations[k])
        observations, rewards, terminated, _, _ = envs.step(actions)
        rewards = np.where(running, rewards, 0.0)
        returns += rewards
        if rewards.max() > most:
            most, best = rewards.max(), envs.render()[int(rewards.argmax())]
        running &= ~terminated
    envs.close()
    return returns, best


def main(arguments: list[str] | None = None) -> dict[str, Doubles]:
    """Plays, prints, writes the picture; gives the returns of each agent, of shape (games,)."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--game", default="carom/RunOutSix-v0", choices=list(carom.gymnasium.GAMES))
    parser.add_argument("--games", type=int, default=100)
    parser.add_argument("--balls", type=int, help="instead of the game's own")
    parser.add_argument("--strokes", type=int, help="instead of the game's own")
    parser.add_argument("--plans", default="300", help="shots a stroke of planners, with commas between")
    parser.add_argument("--cushion", default="han", help="model of the cushions, as for carom.simulate")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--out", default="potting.svg", help="the picture of the greedy agent's best stroke")
    given = parser.parse_args(arguments)
    rules = {name: getattr(given, name) for name in ("balls", "strokes") if getattr(given, name) is not None}
    rules |= {"cushion_model": given.cushion, "threads": carom.ALL_THREADS}
    agents = {"random": random_agent(given.seed), "greedy": greedy_agent}
    agents |= {f"plan of {shots} shots": planner(int(shots)) for shots in filter(None, given.plans.split(","))}
    balls = carom.gymnasium.PottingEnv(**(carom.gymnasium.GAMES[given.game] | rules)).rules.balls
    print(f"{given.games} games of {given.game}, {balls} balls, seed {given.seed}")
    found: dict[str, Doubles] = {}
    for name, agent in agents.items():
        found[name], picture = play(agent, given.game, given.games, given.seed, **rules)
        within = 1.96 * found[name].std(ddof=1) / np.sqrt(given.games) if given.games > 1 else np.nan
        print(f"{name}: {found[name].mean():.2f} +- {within:.2f} a game, all balls in {(found[name] == balls).sum()}")
        if name == "greedy":
            Path(given.out).write_text(picture, encoding="utf-8")
    print(f"wrote {given.out}")
    return found


if __name__ == "__main__":
    main()
