"""The game of match.cpp in Python: match.py FILE keeps its recording."""

import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import carom
from carom.record import Recorder, replay

table = carom.tables.pool_9ft()
players = [carom.player(fargo=fargo) for fargo in (500, 600)]
game = Recorder(table, carom.racks.nineball(table, gap=1e-4, seed=2))
state = {"opening": 1}  # before the break
player, winner, number, loudest = 0, None, 0, 0.0  # N s
shot = None
with ThreadPoolExecutor() as pool:
    while winner is None:
        # how the game stands is kept, also for another program, which goes on from there
        game.stand("nineball", state, player)
        if number == 3:
            game = Recorder.load(game.lines)
            _, state, player = game.standing

        # the player thinks, while the shot of the other is drawn
        mind = pool.submit(carom.plan, table, game.balls, rules="nineball", player=players[player], shots=300, best=1, in_hand=game.in_hand, state=state)
        frame = 0
        while shot is not None and not mind.done():
            shot.states(min(frame / 60, shot.time), drawn=True)
            frame += 1
        best = mind.result()[0]

        # the stroke, and how it sounds
        if game.in_hand:
            game.place(0, *best["place"])
        cue, balls = carom.with_errors(best["cue"], players[player], 1, number), game.balls
        game.shoot(cue)
        call = (int(best["ball"]), int(best["pocket"]))
        ruling = carom.referee(table, balls, cue, rules="nineball", call=call, state=state)
        shot = ruling.shot
        loudest = max(loudest, shot.events["impulse"].max())

        # the ruling, and the layout that it leaves
        print(f"{player + 1}: {ruling.text}")
        state = ruling.state
        game.settle(ruling)
        if ruling.turn == "pass":
            player = 1 - player
        elif ruling.turn != "keep":
            winner = player if ruling.turn == "win" else 1 - player
        number += 1
Path(sys.argv[1]).write_text(game.end())
print(f"player {winner + 1} wins; the hardest blow {loudest:.4f} N s")

# a reader plays every shot again, and compares its bits
assert all(shot.same for shot in replay(sys.argv[1]))
