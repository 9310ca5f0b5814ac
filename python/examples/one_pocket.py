"""A bot for a game of your own: one pocket. Each player has one of the pockets at the foot of the table, and wins with eight balls in it.

The rules are four methods; the library plans by them and judges by them. A foul costs a ball, which comes back; so do balls in other pockets.

    python one_pocket.py
"""

from collections.abc import Collection

import numpy as np

import carom

POCKETS = (2, 5)  # of player 0 and of player 1: the two corners at the foot of carom.tables.pool_9ft()


class OnePocket(carom.Rules):
    """The state: which pocket is that of the player at the table, his balls, those of the other."""

    def on(self, state: list[int], in_play: frozenset[int]) -> Collection[int]:
        return in_play - {0}

    def pockets(self, state: list[int]) -> Collection[int]:
        return {POCKETS[state[0]]}

    def left(self, state: list[int], in_play: frozenset[int]) -> tuple[int, int]:
        return 8 - state[1], 8 - state[2]

    def judge(self, state: list[int], in_play: frozenset[int], facts: carom.Facts, call: tuple[int, int]) -> carom.Turn:
        foul = facts.foul(self.on(state, in_play))
        balls = {side: [k for k, pocket in facts.potted.items() if k and pocket == POCKETS[side]] for side in (0, 1)}
        own, other = balls[state[0]], balls[1 - state[0]]
        spot = {k for k in (*facts.potted, *facts.off) if k and k not in other and (foul or k not in own)}
        if foul and state[1]:
            spot.add(min(set(range(1, 16)) - in_play))  # one of those that were down
        scores = [max(state[1] - 1, 0) if foul else state[1] + len(own), state[2] + len(other)]
        if max(scores) >= 8:
            return carom.Turn("win" if scores[0] >= 8 else "lose", foul=foul)
        if own and not foul:
            state[1:3] = scores
            return carom.Turn("keep", spot=spot)
        state[:3] = [1 - state[0], *scores[::-1]]
        return carom.Turn("pass", "kitchen" if foul == carom.Foul.CUE_BALL else "after", foul, spot)


table = carom.tables.pool_9ft()
layout, state, hand = carom.racks.eightball(table, seed=3), np.zeros(8, np.uint64), "no"
players = carom.player(fargo=750), carom.player(fargo=450)
for stroke in range(300):
    player = int(state[0])
    best = carom.plan(
        table, layout, rules=OnePocket(), state=state, player=players[player], opponent=players[1 - player], shots=300, seed=stroke,
        in_hand=hand,
    )[0]  # fmt: skip
    if hand == "kitchen":
        layout = carom.place_ball(table, layout, 0, *best["place"])
    cue = carom.with_errors(best["cue"], players[player], seed=1, number=stroke)
    ruling = carom.referee(table, layout, cue, rules=OnePocket(), state=state)
    layout, state, hand = ruling.balls, ruling.state, ruling.hand
    if ruling.turn in ("win", "lose"):
        break
    print(f"{stroke + 1:2}. player {player}: {ruling.turn}, potted {ruling.potted}{', foul: ' + ruling.foul.text if ruling.foul else ''}")
winner = player if ruling.turn == "win" else 1 - player
print(f"after {stroke + 1} strokes: player {winner} has won")
assert ruling.turn in ("win", "lose"), "the game has not ended"
