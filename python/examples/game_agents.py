"""Agents play the games of carom.gymnasium: at random, greedy for the next stroke, and the
library's planner with some numbers of shots.

The greedy agent aims as players do: for each ball that it may meet first and each pocket at the
ghost ball, the place where the cue ball must be when it touches the ball to drive it straight to
the pocket. Friction throws the ball off that line, and other balls are in the way; so it tries each
aim at some speeds and a little to both sides, all in one `carom.simulate_batch`, and takes the
stroke that is worth most, and of those the one whose neighbours do best. In three-cushion it tries
directions all around. It does not think of the stroke after. The planner does, and knows how
strokes err.

All begin each game with the same layout. What is printed is a table: the mean of the returns with
its 95 % interval, and in how many games the agent did all that can be done: it potted all balls
without a foul, scored with every stroke, or won. `--game all` plays the suite.

    python game_agents.py --game carom/RunOutSix-v1 --games 400 --plans 300,2000
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any, cast

import gymnasium
import numpy as np
from numpy.typing import NDArray

import carom
from carom.games.drills import Break, ThreeCushion
from carom.games.gymnasium import GAMES, GameEnv, Rules
from carom.games.matches import Match
from carom.games.pool import Hand
from carom.games.potting import Potting
from carom.games.table_games import TableGame

Doubles = NDArray[np.float64]
Agent = Callable[[Rules, Doubles], Doubles]

SPEEDS = np.array([1.5, 2.5, 4.0])  # m/s, of the cue
SIDES = np.linspace(-1.5, 1.5, 13)  # degrees, to both sides of an aim
MOST_CUT = 80.0  # degrees
BEHIND = np.array(
    [[x, 1.0] for x in (-0.8, -0.4, 0.0, 0.4, 0.8)]
)  # places of a cue ball in hand, as actions have them
ANYWHERE = np.array(
    [[x, y] for x in (-0.75, -0.25, 0.25, 0.75) for y in (-0.8, -0.4, 0.0, 0.4, 0.8)]
)


# These agents do not know the observations of games of two sides on any table.
KNOWN = [name for name, arguments in GAMES.items() if arguments.get("game") != "match"]


def known(rules: Rules) -> Potting | Match:
    """The rules, if these agents know the game."""
    if isinstance(rules, TableGame):
        raise TypeError(f"these agents play {', '.join(KNOWN)}")
    return rules


def random_agent(seed: int) -> Agent:
    """Any direction, speed and place of the tip, and of the cue ball."""
    generator = np.random.default_rng(seed)
    return lambda rules, observation: np.asarray(generator.uniform(-1.0, 1.0, rules.acts))


def ghosts(table: carom.Table, radius: float, cue_ball: Doubles, balls: Doubles) -> Doubles:
    """The directions, degrees, from the cue ball to the ghost balls of balls and all pockets, shape
    (aims,).
    """
    way = table.pockets["centre"][np.newaxis] - balls[:, np.newaxis]
    way /= np.linalg.norm(way, axis=-1, keepdims=True)
    line = balls[:, np.newaxis] - 2.0 * radius * way - cue_ball
    line /= np.linalg.norm(line, axis=-1, keepdims=True)
    possible = (line * way).sum(axis=-1) > np.cos(np.radians(MOST_CUT))
    # Where no ball can be cut into a pocket, the balls themselves are aimed at.
    chosen = line[possible] if possible.any() else balls - cue_ball
    return np.asarray(np.degrees(np.arctan2(chosen[:, 1], chosen[:, 0])))


def candidates(rules: Rules, observation: Doubles) -> Doubles:
    """Actions to try, of shape (aims, speeds, sides, acts)."""
    rules = known(rules)
    base = rules.pool.base if isinstance(rules, Match) else rules
    seen = observation[: 3 * base.balls + 3].reshape(-1, 3)
    targets = np.flatnonzero(seen[1:, 2]) + 1
    speeds, sides, hand = SPEEDS, SIDES, Hand.NOWHERE
    if isinstance(rules, Match):
        position = rules.seen(observation)
        targets, hand = np.array(rules.pool.on(position)), position.hand
    elif isinstance(rules, Break):
        hand = Hand.BEHIND
    if isinstance(rules, ThreeCushion):
        phi = np.linspace(-180.0, 180.0, 180, endpoint=False)[:, np.newaxis, np.newaxis]
        return rules.actions(
            *np.broadcast_arrays(
                phi, np.array([3.0, 4.5, 6.0])[:, np.newaxis], np.array([-0.3, 0.0, 0.3]), 0.1
            )
        )
    # A cue ball in hand is tried at some places; a break goes straight at the nearest ball.
    places = {Hand.NOWHERE: np.zeros((1, 2)), Hand.BEHIND: BEHIND, Hand.ANYWHERE: ANYWHERE}[hand]
    candidate_rows = []
    for place in places:
        cue_ball = seen[0, :2]
        if hand:
            area = (
                rules.pool.area(hand) if isinstance(rules, Match) else cast(Break, rules).corners()
            )
            cue_ball = area[0] + (area[1] - area[0]) * (place + 1.0) / 2.0
        balls = seen[targets, :2]
        if hand is Hand.BEHIND:
            nearest = balls[np.hypot(*(balls - cue_ball).T).argmin()] - cue_ball
            aims, speeds = (
                np.degrees(np.arctan2(nearest[1:], nearest[:1])),
                np.array([6.0, 8.0, 10.0]),
            )
        else:
            aims = ghosts(base.table, base.radius, cue_ball, balls)
        strokes = base.actions(
            *np.broadcast_arrays(aims[:, np.newaxis, np.newaxis] + sides, speeds[:, np.newaxis])
        )
        candidate_rows.append(
            np.concatenate([strokes, np.broadcast_to(place, (*strokes.shape[:-1], 2))], axis=-1)[
                ..., : rules.acts
            ]
        )
    return np.concatenate(candidate_rows)


def greedy_agent(rules: Rules, observation: Doubles) -> Doubles:
    """The best of the strokes that are tried."""
    rules = known(rules)
    actions = candidates(rules, observation)
    worth = rules.tried(observation, actions.reshape(-1, rules.acts)).reshape(actions.shape[:-1])
    # A small part of the mean of a stroke and its neighbours to both sides decides between equals.
    padded = np.pad(worth, ((0, 0), (0, 0), (1, 1)), mode="edge")
    valued = worth + 0.01 * (padded[..., :-2] + worth + padded[..., 2:]) / 3.0
    chosen: Doubles = actions[np.unravel_index(valued.argmax(), valued.shape)]
    return chosen


def planner(shots: int) -> Agent:
    """The library's, with so many shots a stroke."""
    return lambda rules, observation: known(rules).best_seen(observation, shots=shots)


def play(agent: Agent, game: str, games: int, seed: int, **rules: Any) -> tuple[Doubles, str]:
    """The return of each of many games, the layout of game k drawn from seed + k; and the picture
    of the best stroke.
    """
    env: Any = gymnasium.make(game, render_mode="svg", **rules).unwrapped
    returns, most, best = np.zeros(games), -np.inf, ""
    for k in range(games):
        observation, terminated = env.reset(seed=seed + k)[0], False
        while not terminated:
            observation, reward, terminated, _, _ = env.step(agent(env.rules, observation))
            returns[k] += reward
            if reward > most:
                most, best = reward, env.render()
    return returns, best


def most_of(rules: Rules) -> int:
    """The return of a game in which the agent did all that can be done."""
    return (
        1
        if isinstance(rules, Match)
        else rules.strokes
        if isinstance(rules, ThreeCushion)
        else rules.balls
    )


def score(returns: Doubles, most: int) -> str:
    """The mean of the returns, its 95 % interval, and the share of those that are the most."""
    within = 1.96 * returns.std(ddof=1) / np.sqrt(len(returns)) if len(returns) > 1 else np.nan
    return f"{returns.mean():.2f} ± {within:.2f} ({(returns == most).mean():.0%})"


def main(arguments: list[str] | None = None) -> dict[str, Doubles]:
    """Plays, prints, writes the picture; gives the returns of each agent in the last game, of shape
    (games,).
    """
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--game", default="carom/RunOutSix-v1", choices=["all", *KNOWN])
    parser.add_argument("--games", type=int, default=100)
    parser.add_argument("--balls", type=int, help="instead of the game's own")
    parser.add_argument("--strokes", type=int, help="instead of the game's own")
    parser.add_argument(
        "--plans", default="300", help="shots a stroke of planners, with commas between"
    )
    parser.add_argument(
        "--cushion", default="han", help="model of the cushions, as for carom.simulate"
    )
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument(
        "--out",
        default="potting.svg",
        help="the picture of the greedy agent's best stroke in the last game",
    )
    options = parser.parse_args(arguments)
    settings = {
        name: getattr(options, name)
        for name in ("balls", "strokes")
        if getattr(options, name) is not None
    }
    agents = {"random": random_agent(options.seed), "greedy": greedy_agent}
    agents |= {
        f"plan of {shots} shots": planner(int(shots))
        for shots in filter(None, options.plans.split(","))
    }
    every = [name for name in KNOWN if name != "carom/Potting-v1"]
    games = every if options.game == "all" else [options.game]
    found: dict[str, Doubles] = {}
    cells: dict[str, list[str]] = {name: [name] for name in agents}
    for game in games:
        rules = settings | {"cushion_model": options.cushion}
        most = most_of(GameEnv(**(GAMES[game] | rules)).rules)
        for name, agent in agents.items():
            found[name], picture = play(agent, game, options.games, options.seed, **rules)
            cells[name].append(score(found[name], most))
            print(f"{game}, {name}: {cells[name][-1]}", file=sys.stderr)
            if name == "greedy":
                Path(options.out).write_text(picture, encoding="utf-8")
    print(
        f"Means of {options.games} games, seed {options.seed}; in brackets how many were perfect. {options.out} has a stroke of the greedy agent.\n"
    )
    print(
        "\n".join(
            f"| {' | '.join(row)} |"
            for row in [
                ["agent", *(game[6:-3] for game in games)],
                ["---"] * (len(games) + 1),
                *cells.values(),
            ]
        )
    )
    return found


if __name__ == "__main__":
    main()
