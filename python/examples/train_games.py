"""PPO of stable_baselines3 learns the games of carom.gymnasium, a policy for each from nothing, in
so many minutes of one core each.

A policy sees the pot that is easiest by geometry, and the ball after it. It corrects the aim at the
ghost ball, by up to 10 degrees of the object ball's direction, and sets speed and tip: it learns
throw, speed, position, and not to scratch. In a break and in three-cushion it aims at the nearest
ball, and chooses where it meets it. Matches are learned without the opponent, for whose plans it
would wait: a visit ends where he would play.

A curve is the mean return of games that are not trained on, played without exploring, of matches
against the planner. The lines are those of random play and of the planner. Beside the picture: the
curves, .csv, and the table of all agents, .md. Needs stable_baselines3 2.5.

    python train_games.py games.svg --minutes 5
"""

from __future__ import annotations

import argparse
import dataclasses
import functools
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import game_agents
import matplotlib.pyplot as plt
import numpy as np
from numpy.typing import NDArray
from gymnasium.spaces import Box

from carom.games.gymnasium import GAMES, RULES, GameEnv, GameVectorEnv, Rules
from carom.games.matches import Match
from carom.games.pool import Hand, Position

Doubles = NDArray[np.float64]
Policy = Callable[[Doubles], Doubles]
PLAN = "`best(shots=300)`"


class Visit(Match):
    """A match that is lost where the opponent would play.

    With a discount it is best to keep the turn.
    """

    def _visit(self, position: Position) -> Position:
        return position if position.player == 0 else dataclasses.replace(position, winner=1)


RULES |= {
    "visit nineball": functools.partial(Visit, "nineball"),
    "visit eightball": functools.partial(Visit, "eightball"),
}


def direction(way: Doubles) -> Doubles:
    return np.asarray(np.arctan2(way[..., 1], way[..., 0]))


class Sight:
    """What a policy sees of a game, and the strokes of its answers."""

    def __init__(self, rules: Rules) -> None:
        rules = game_agents.known(rules)
        self.rules, self.match = rules, isinstance(rules, Match)
        self.base = rules.pool.base if isinstance(rules, Match) else rules
        holes = self.base.table.pockets["centre"]
        self.pots = self.match or (len(holes) > 0 and rules.acts == 4)
        self.pockets, self.most = (
            holes if self.pots else np.zeros((1, 2)),
            np.radians(10.0 if len(holes) else 85.0),
        )
        size = np.array([self.base.table.width, self.base.table.length])
        self.low, self.high = np.full(2, self.base.radius + 1e-3), size - self.base.radius - 1e-3
        self.head = np.array([self.high[0], size[1] / 4.0])

    def ghost(self, ball: Doubles, target: Doubles) -> Doubles:
        return np.asarray(
            ball - 2.0 * self.base.radius * np.stack([np.cos(target), np.sin(target)], axis=-1)
        )

    def legal_targets(self, observed: Doubles, present: Any) -> tuple[Any, Any]:
        """Which balls may be met first, and which after that, (games, balls)."""
        if not isinstance(self.rules, Match):
            return present, present
        if self.rules.pool.game == "nineball":
            order = np.cumsum(present, axis=1)
            return present & (order == 1), present & (order == 2)
        number, group = np.arange(15), observed[:, -2:-1]
        group_balls = present & np.where(
            group == 0, number != 7, np.where(group == 1, number < 7, number > 7)
        )
        group_balls = np.where(
            group_balls.any(axis=1, keepdims=True), group_balls, present & (number == 7)
        )
        return group_balls, group_balls

    def blocked(self, begin: Doubles, end: Doubles, balls: Doubles) -> Any:
        """Whether a ball that is not struck lies in the way, (games, balls, places, pockets)."""
        long, width = (
            np.linalg.norm(end - begin, axis=-1)[..., np.newaxis],
            balls[:, np.newaxis, np.newaxis, np.newaxis],
        )
        inside, off = (
            (end - begin)[..., np.newaxis, :] / long[..., np.newaxis],
            width[..., :2] - begin[..., np.newaxis, :],
        )
        along, aside = (
            (off * inside).sum(axis=-1),
            np.abs(off[..., 0] * inside[..., 1] - off[..., 1] * inside[..., 0]),
        )
        others = (width[..., 2] > 0.0) & ~np.eye(balls.shape[1], dtype=bool)[
            :, np.newaxis, np.newaxis
        ]
        return ((along > 0.0) & (along < long) & (aside < 2.0 * self.base.radius) & others).any(
            axis=-1
        )

    def __call__(self, observed: Doubles) -> Doubles:
        """(games, 13) of observations: cut, both distances, the ball's direction, whether to a side
        pocket, the places of the cue ball and of the ball, whether the aim is straight, strokes
        left, and the place of the ball after.
        """
        games = np.arange(len(observed))
        balls = observed[:, 3 : 3 * self.base.balls + 3].reshape(len(games), -1, 3)
        cues, straight = observed[:, np.newaxis, :2], np.full(len(games), not self.pots)
        if self.match:
            hand = observed[:, -4]
            straight = hand == Hand.BEHIND
            if (hand == Hand.ANYWHERE).any():
                anywhere = self.low + (self.high - self.low) * (game_agents.ANYWHERE + 1.0) / 2.0
                cues = np.where((hand == Hand.ANYWHERE)[:, np.newaxis, np.newaxis], anywhere, cues)
        # Of shape (games, balls, places of the cue ball, pockets). An error of the cue grows by
        # near/cos(cut) and by far; a side pocket is narrow from aside.
        cue, ball, pocket = (
            cues[:, np.newaxis, :, np.newaxis],
            balls[:, :, np.newaxis, np.newaxis, :2],
            self.pockets,
        )
        direct = straight[:, np.newaxis, np.newaxis, np.newaxis]
        pot_line, far = (
            np.where(direct, direction(ball - cue), direction(pocket - ball)),
            np.linalg.norm(pocket - ball, axis=-1),
        )
        line = self.ghost(ball, pot_line) - cue
        close, cut = (
            np.linalg.norm(line, axis=-1),
            (direction(line) - pot_line + np.pi) % (2.0 * np.pi) - np.pi,
        )
        side = 1.0 * np.broadcast_to(
            np.abs(pocket[:, 1] - self.base.table.length / 2.0) < 0.1, cut.shape
        )
        hard = (
            close
            * far
            / np.maximum(
                np.maximum(np.cos(cut), 1e-3) * np.where(side > 0.0, np.cos(pot_line) ** 2, 1.0),
                1e-9,
            )
        )
        if self.pots and self.base.balls > 1:
            hard += 100.0 * (
                self.blocked(cue, cue + line, balls) | self.blocked(ball, pocket, balls)
            )
        hard = np.where(direct, close, hard).reshape(*balls.shape[:2], -1)

        # The easiest of all is the stroke; of the other balls, where the next lies.
        first, second = self.legal_targets(observed, balls[..., 2] > 0.0)
        easiest = hard.min(axis=-1)
        k = np.where(first, easiest, np.inf).argmin(axis=1)
        second = second & (np.arange(balls.shape[1]) != k[:, np.newaxis])
        following = balls[games, np.where(second, easiest, np.inf).argmin(axis=1), :2] * second.any(
            axis=1, keepdims=True
        )
        place, hole = np.divmod(hard[games, k].argmin(axis=-1), len(pocket))
        parts = [
            np.broadcast_to(part, cut.shape)[games, k, place, hole]
            for part in (cut, close, far, pot_line, side)
        ]
        return np.column_stack(
            [*parts, cues[games, place], balls[games, k, :2], straight, observed[:, -1], following]
        )

    def strokes(self, sight: Doubles, actions: Doubles) -> Doubles:
        """The actions of the game for answers, (games, 6): of the direction, speed, tip, and the
        place of the cue ball in a break.
        """
        straight, cue, ball = sight[:, 9] > 0.0, sight[:, 5:7], sight[:, 7:9]
        if self.rules.acts == 6:
            cue = np.where(
                straight[:, np.newaxis],
                self.low + (self.head - self.low) * (actions[:, 4:6] + 1.0) / 2.0,
                cue,
            )
        direction_line = np.where(straight, direction(ball - cue), sight[:, 3])
        phi = np.degrees(
            direction(self.ghost(ball, direction_line + self.most * actions[:, 0]) - cue)
        )
        speed = (
            0.5 + np.where(straight, self.base.speeds[1] - 0.5, 6.5) * (actions[:, 1] + 1.0) / 2.0
        )
        place = np.where(
            straight[:, np.newaxis],
            actions[:, 4:6],
            np.clip(2.0 * (cue - self.low) / (self.high - self.low) - 1.0, -1.0, 1.0),
        )
        return np.column_stack([self.base.actions(phi, speed, *(0.35 * actions[:, 2:4].T)), place])[
            :, : self.rules.acts
        ]


def agent(policy: Policy) -> game_agents.Agent:
    """A policy as an agent of game_agents.py."""
    sight = functools.cache(Sight)

    def act(rules: Rules, observed: Doubles) -> Doubles:
        seen = sight(rules)(observed[np.newaxis])
        return np.asarray(sight(rules).strokes(seen, policy(seen))[0])

    return act


def train(game: str, minutes: float, look: Callable[[int, Policy], None], looks: int) -> None:
    """Gives strokes until now and the policy to `look`, so often before the minutes of training are
    over, and then. Looking takes none of them.
    """
    from stable_baselines3 import PPO
    from stable_baselines3.common.vec_env import VecEnv

    arguments, count = GAMES[game], 256
    if game in ("carom/NineBall-v1", "carom/EightBall-v1"):
        arguments, count = {**arguments, "game": f"visit {arguments['game']}"}, 64

    class Games(VecEnv):
        """Many games as stable_baselines3 has them.

        One that has ended begins with a stroke that is not played, which ends too.
        """

        def __init__(self) -> None:
            self.games = GameVectorEnv(count, **arguments)
            self.seen = Sight(self.games.rules)
            super().__init__(
                count, Box(-np.inf, np.inf, (13,), np.float64), Box(-1.0, 1.0, (6,), np.float32)
            )
            self.games.reset(seed=10**6)

        def reset(self) -> Doubles:
            self.over, self.sight = np.zeros(count, bool), self.seen(self.games.reset()[0])
            return self.sight

        def step_async(self, actions: Doubles) -> None:
            self.stepped = self.games.step(self.seen.strokes(self.sight, actions))

        def step_wait(self) -> tuple[Any, ...]:
            observed, rewards, ended = self.stepped[:3]
            done, self.over = ended | self.over, ended
            self.sight = self.reset() if ended.all() else self.seen(observed)
            return self.sight, rewards, done, [{} for _ in range(count)]

        def get_attr(self, *arguments: Any) -> list[None]:
            return [None] * count

        close = set_attr = env_method = env_is_wrapped = get_attr

    whole, left = 60.0 * minutes, 60.0 * minutes
    how: dict[str, Any] = {
        "n_steps": 16,
        "batch_size": 1024,
        "n_epochs": 4,
        "gamma": 0.9,
        "learning_rate": lambda _: 1e-3 * left / whole,
    }
    model: Any = PPO("MlpPolicy", Games(), seed=1, policy_kwargs={"log_std_init": -1.0}, **how)
    pending = whole
    while left > 0.0:
        if left <= pending:
            look(
                model.num_timesteps,
                lambda sight: np.asarray(model.predict(sight, deterministic=True)[0]),
            )
            pending -= whole / looks
        begun = time.perf_counter()
        model.learn(16 * count, reset_num_timesteps=False)
        left = max(left - (time.perf_counter() - begun), 0.0)
    look(model.num_timesteps, lambda sight: np.asarray(model.predict(sight, deterministic=True)[0]))


def learn(
    game: str, minutes: float, games: int
) -> tuple[list[tuple[int, float]], dict[str, Doubles]]:
    """The curve, of strokes and mean return, and the returns of all agents, the last of them the
    policy.
    """

    def returns(player: game_agents.Agent) -> Doubles:
        return game_agents.play(player, game, games, 1)[0]

    def look(strokes: int, policy: Policy) -> None:
        found["PPO"] = returns(agent(policy))
        found.setdefault("untrained", found["PPO"])
        curve.append((strokes, float(found["PPO"].mean())))
        print(f"{game}: {strokes} strokes: {curve[-1][1]:.3f}", flush=True)

    curve: list[tuple[int, float]] = []
    found = {
        "random": returns(game_agents.random_agent(1)),
        "greedy": returns(game_agents.greedy_agent),
        PLAN: returns(game_agents.planner(300)),
    }
    train(game, minutes, look, 2 if "Ball-" in game else 10)
    return curve, found


def main(arguments: list[str] | None = None) -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("out", type=Path, help="the picture of the curves")
    parser.add_argument(
        "--only",
        nargs="+",
        choices=game_agents.KNOWN,
        default=game_agents.KNOWN,
        help="these games",
    )
    parser.add_argument("--minutes", type=float, default=5.0, help="of training, for each game")
    parser.add_argument(
        "--games", type=int, default=400, help="that all agents play; an eighth of them of matches"
    )
    options = parser.parse_args(arguments)
    figure, axes = plt.subplots(2, 4, figsize=(12.0, 6.0), layout="constrained")
    figure.supxlabel("thousand strokes of training")
    figure.supylabel("mean return")
    axes[1, 3].set_axis_off()
    rows: dict[str, list[str]] = {
        name: []
        for name in (
            "agent",
            "---",
            "random",
            "greedy",
            "untrained",
            "PPO",
            PLAN,
            "thousand strokes of PPO",
        )
    }
    lines = ["game,strokes,return"]
    for game, axis in zip(options.only, axes.flat, strict=False):
        curve, found = learn(
            game, options.minutes, max(options.games // 8, 2) if "Ball-" in game else options.games
        )
        most, name = game_agents.most_of(GameEnv(**GAMES[game]).rules), game[6:-3]
        cells = {
            player: game_agents.score(cells, most).replace(" ± ", "±").removesuffix(" (0%)")
            for player, cells in found.items()
        }
        for player, cell in [
            *cells.items(),
            ("agent", name),
            ("---", "--:"),
            ("thousand strokes of PPO", f"{curve[-1][0] / 1000:.0f}"),
        ]:
            rows[player].append(cell)
        lines += [f"{name},{strokes},{mean:.6g}" for strokes, mean in curve]
        axis.plot(*(np.array(curve) / (1000.0, 1.0)).T)
        for player, side in (("random", "bottom"), (PLAN, "top")):
            axis.axhline(float(found[player].mean()), linestyle="--", color="gray")
            axis.text(0.0, float(found[player].mean()), player.strip("`"), verticalalignment=side)
        axis.set_title(name)
        # Written after each game: what is done is not lost where the program is stopped.
        options.out.with_suffix(".csv").write_text("\n".join(lines) + "\n", encoding="utf-8")
        options.out.with_suffix(".md").write_text(
            "".join(f"|{'|'.join([player, *cells])}|\n" for player, cells in rows.items()),
            encoding="utf-8",
        )
        figure.savefig(options.out)


if __name__ == "__main__":
    main()
