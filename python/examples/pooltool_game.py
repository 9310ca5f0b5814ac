"""A game of eight-ball or nine-ball in pooltool: `carom.pooltool.Agent` against a player who takes
pooltool's easiest pot.

    python pooltool_game.py [--game eightball] [--seed 1] [--errors 1.0] [--shots 1000]

pooltool plays the shots, keeps the rules and says who has won; the loop is that of its game. The
opponent aims by `pooltool.pot` at the nearest ball that it can pot, at one speed. The strokes of
both err alike. Needs pooltool 0.6.
"""

from __future__ import annotations

import argparse
from typing import Any

import numpy as np
import pooltool as pt

import carom
import carom.pooltool


class Easiest:
    """The opponent: the easiest pot of the nearest ball that has one, or a stroke at the middle of
    the nearest ball.
    """

    def __init__(self, player: carom.dtypes.Records, seed: int) -> None:
        self.player, self.seed, self.strokes = player, seed, 0

    def decide(self, system: Any, game: Any, callback: Any = None) -> Any:
        """The stroke, with errors. Ball in hand stays where pooltool has put it."""
        cue, table, constraints = system.balls["cue"], system.table, game.shot_constraints
        targets = [
            system.balls[name]
            for name in constraints.hittable
            if name in system.balls and system.balls[name].state.s != pt.constants.pocketed
        ]
        targets.sort(key=lambda ball: np.linalg.norm(ball.xyz - cue.xyz))
        ball, pocket, speed = targets[0], None, 8.0
        if game.shot_number > 0:
            speed = 2.5
            ball, pocket = next(
                (
                    (target, hole)
                    for target in targets
                    if (hole := pt.pot.pick_easiest_pot(system, target)) is not None
                ),
                (ball, None),
            )
        phi = (
            pt.aim.at_ball(cue, ball)
            if pocket is None
            else pt.pot.calc_potting_angle(cue, ball, table, pocket)
        )
        if constraints.call_shot:
            constraints.ball_call, constraints.pocket_call = (
                ball.id,
                pocket.id if pocket else next(iter(table.pockets)),
            )
        stroke = carom.with_errors(
            carom.cue(speed=speed, phi=phi, game="pooltool_pool"),
            self.player,
            self.seed,
            self.strokes,
        )
        self.strokes += 1
        return pt.ai.action.Action(
            *(float(stroke[name]) for name in ("speed", "phi", "theta", "a", "b"))
        )

    def apply(self, system: Any, action: Any) -> None:
        """Give the stroke to the cue."""
        action.apply(system.cue)


def play(name: str, agents: list[Any], seed: int, most: int = 200) -> tuple[Any, list[str]]:
    """A game, the first agent breaks: the game at its end, and a line for each stroke."""
    kind = pt.GameType.EIGHTBALL if name == "eightball" else pt.GameType.NINEBALL
    np.random.seed(seed)
    table = pt.Table.from_game_type(kind)
    system = pt.System(
        cue=pt.Cue(cue_ball_id="cue"),
        table=table,
        balls=pt.get_rack(kind, table, spacing_factor=1e-3),
    )
    game = pt.get_ruleset(kind)()
    game.players = [pt.Player(type(agent).__name__, agent) for agent in agents]
    lines = []
    while game.shot_number < most:
        player = game.active_player
        action = player.ai.decide(system, game)
        player.ai.apply(system, action)
        pt.simulate(system, inplace=True)
        game.process_and_advance(system)
        down = [
            event.ids[0] for event in system.events if event.event_type == pt.EventType.BALL_POCKET
        ]
        lines.append(
            f"{player.name:8} {action.V0:4.1f} m/s {action.phi % 360:6.1f} degrees  {' '.join(down) or '-':12} {game.shot_info.reason}".rstrip()
        )
        if game.shot_info.game_over:
            break
        system.reset_history()
    return game, lines


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--game", choices=("eightball", "nineball"), default="eightball")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument(
        "--errors", type=float, default=1.0, help="of both players, as for carom.player"
    )
    parser.add_argument("--shots", type=int, default=1000, help="of a plan")
    options = parser.parse_args()
    player = carom.player(options.errors)
    agents = [
        carom.pooltool.Agent(player, shots=options.shots, seed=options.seed),
        Easiest(player, options.seed + 1),
    ]
    game, lines = play(options.game, agents, options.seed)
    print("\n".join(lines))
    winner = game.shot_info.winner
    print("no winner" if winner is None else f"{winner.name} has won after {len(lines)} strokes")


if __name__ == "__main__":
    main()
