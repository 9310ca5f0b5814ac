"""The game of match.cpp in Python: match.py FILE keeps its recording, and goes on with one that was
saved.
"""

import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import carom
from carom.record import Recorder, replay

table = carom.tables.pool_9ft()
players = [carom.player(fargo=fargo) for fargo in (500, 600)]
file = Path(sys.argv[1])
if file.exists() and file.stat().st_size > 0:
    game = Recorder.load(file)
else:
    game = Recorder(table, carom.racks.nineball(table, gap=1e-4, seed=2))
    game.stand("nineball", {"opening": 1})  # before the break
winner, loudest = None, 0.0  # N s
shot = None
with ThreadPoolExecutor() as pool:
    while winner is None:
        # the game is kept; the player thinks, while the shot of the other is drawn
        file.write_text("".join(game.lines))
        _, state, player = game.standing
        mind = pool.submit(
            carom.plan,
            table,
            game.balls,
            rules="nineball",
            player=players[player],
            shots=300,
            best=1,
            in_hand=game.in_hand,
            state=state,
        )
        frame = 0
        while shot is not None and not mind.done():
            shot.states(min(frame / 60, shot.time), drawn=True)
            frame += 1
        best = mind.result()[0]

        # the stroke, and how it sounds
        if game.in_hand:
            game.place(0, *best["place"])
        number = sum(line.startswith('{"shot"') for line in game.lines)
        cue, balls = carom.with_errors(best["cue"], players[player], 1, number), game.balls
        game.shoot(cue)
        call = (int(best["ball"]), int(best["pocket"]))
        ruling = carom.referee(table, balls, cue, rules="nineball", call=call, state=state)
        shot = ruling.shot
        loudest = max(loudest, shot.events["impulse"].max(initial=0.0))

        # the ruling, and the layout that it leaves
        print(f"{player + 1}: {ruling.text}")
        game.settle(ruling)
        if ruling.turn in ("win", "lose"):
            winner = player if ruling.turn == "win" else 1 - player
        else:
            game.stand("nineball", ruling.state, 1 - player if ruling.turn == "pass" else player)
file.write_text(game.end())
print(f"player {winner + 1} wins; the hardest blow {loudest:.4f} N s")

# a reader plays every shot again, and compares its bits
assert all(shot.same for shot in replay(file))
