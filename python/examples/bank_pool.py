"""A bot for a game of your own: bank pool. A ball counts if it meets a cushion before it falls; who has five of the nine first wins.

The rules are three methods; the library plans by them and judges by them. Other balls that fall come back.

    python bank_pool.py
"""

from collections.abc import Collection

import numpy as np

import carom

TO_WIN = 5


class BankPool(carom.Rules):
    """The state: which player is at the table, his balls, those of the other."""

    def on(self, state: list[int], in_play: frozenset[int]) -> Collection[int]:
        return in_play - {0}

    def left(self, state: list[int], in_play: frozenset[int]) -> tuple[int, int]:
        return TO_WIN - state[1], TO_WIN - state[2]

    def judge(self, state: list[int], in_play: frozenset[int], facts: carom.Facts, call: tuple[int, int]) -> carom.Turn:
        foul = facts.foul(self.on(state, in_play))
        banked = {ball for ball in facts.potted if ball and facts.cushions[ball] and not foul}
        back = {*facts.potted, *facts.off} - banked - {0}
        state[1] += len(banked)
        if banked:
            return carom.Turn("win" if state[1] >= TO_WIN else "keep", spot=back)
        state[:3] = [1 - state[0], state[2], state[1]]
        return carom.Turn("pass", "anywhere" if foul else "after", foul, back)


table = carom.tables.pool_9ft()
layout, state, hand = carom.racks.nineball(table, seed=3), np.zeros(8, np.uint64), "no"
players = carom.player(fargo=750), carom.player(fargo=450)
for stroke in range(300):
    player = int(state[0])
    best = carom.plan(
        table, layout, rules=BankPool(), state=state, player=players[player], opponent=players[1 - player], shots=300, seed=stroke,
        in_hand=hand,
    )[0]  # fmt: skip
    if hand != "no":
        layout = carom.place_ball(table, layout, 0, *best["place"])
    cue = carom.with_errors(best["cue"], players[player], seed=1, number=stroke)
    ruling = carom.referee(table, layout, cue, rules=BankPool(), state=state)
    layout, state, hand = ruling.balls, ruling.state, ruling.hand
    if ruling.turn == "win":
        break
    print(f"{stroke + 1:2}. player {player}: {ruling.turn}, potted {ruling.potted}{', foul: ' + ruling.foul.text if ruling.foul else ''}")
print(f"after {stroke + 1} strokes: player {player} has won")
assert ruling.turn == "win", "the game has not ended"
