"""A bot for a game of your own: ten-ball.

The lowest ball is met first, ball and pocket are called, and the ten wins as the last ball.

The rules are three methods; the library plans by them and judges by them. A ten that falls before
comes back.

    python ten_ball.py
"""

from collections.abc import Collection

import numpy as np

import carom


class TenBall(carom.Rules):
    """The state: which player is at the table."""

    race = "shared"
    calls = True
    first_decides = True

    def on(self, state: list[int], in_play: frozenset[int]) -> Collection[int]:
        return {min(in_play - {0})}

    def left(self, state: list[int], in_play: frozenset[int]) -> tuple[int, int]:
        return len(in_play) - 1, len(in_play) - 1

    def judge(
        self, state: list[int], in_play: frozenset[int], facts: carom.Facts, call: tuple[int, int]
    ) -> carom.Turn:
        foul = facts.foul(self.on(state, in_play))
        potted = not foul and facts.potted.get(call[0]) == call[1]
        if potted and in_play == {0, 10}:
            return carom.Turn("win")
        back = {10} & {*facts.potted, *facts.off}
        if potted:
            return carom.Turn("keep", spot=back)
        state[0] = 1 - state[0]
        return carom.Turn("pass", "anywhere" if foul else "after", foul, back)


table = carom.tables.pool_9ft()
layout, state, hand = carom.racks.tenball(table, seed=3), np.zeros(8, np.uint64), "no"
players, stroke, player, ruling = (carom.player(fargo=750), carom.player(fargo=450)), 0, 0, None
for stroke in range(300):
    player = int(state[0])
    best = carom.plan(
        table,
        layout,
        rules=TenBall(),
        state=state,
        player=players[player],
        opponent=players[1 - player],
        shots=300,
        seed=stroke,
        in_hand=hand,
    )[0]
    if hand != "no":
        layout = carom.place_ball(table, layout, 0, *best["place"])
    cue = carom.with_errors(best["cue"], players[player], seed=1, number=stroke)
    ruling = carom.referee(
        table, layout, cue, rules=TenBall(), state=state, call=(best["ball"], best["pocket"])
    )
    layout, state, hand = ruling.balls, ruling.state, ruling.hand
    if ruling.turn == "win":
        break
    print(
        f"{stroke + 1:2}. player {player}: {ruling.turn}, potted {ruling.potted}{', foul: ' + ruling.foul.text if ruling.foul else ''}"
    )
print(f"after {stroke + 1} strokes: player {player} has won")
assert ruling and ruling.turn == "win", "the game has not ended"
