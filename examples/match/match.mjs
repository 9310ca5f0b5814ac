/*
 * The game of match.cpp in JavaScript: node match.mjs FILE keeps its recording, and goes on with
 * one that was saved.
 */
import { existsSync, readFileSync, writeFileSync } from "node:fs";
import { load } from "carom";

const carom = await load();
const table = carom.table("9ft");
const players = [500, 600].map((fargo) => carom.player({ fargo }));
const file = process.argv[2];
const saved = existsSync(file) ? readFileSync(file, "utf8").trimEnd().split("\n") : [];
const game =
  saved.length > 0
    ? carom.record()
    : carom.record(table, carom.rack("nineball", table, { seed: 2 }));
for (const line of saved)
  if (game.read(line)?.same === false) throw new Error("a shot has other bits than were recorded");
if (saved.length === 0) game.stand({ rules: "nineball", group: "open", opening: true }, 0);
let winner = undefined;
let frames = 0;
let loudest = 0; // N s
while (winner === undefined) {
  // the game is kept; the player thinks, while the shot of the other is drawn: a page awaits a
  // frame here
  writeFileSync(file, game.lines.join(""));
  const { game: state, player } = game.standing;
  const mind = carom.think(
    table,
    game.balls,
    { ...state, player: players[player], shots: 300, best: 1, inHand: game.inHand },
    500,
  );
  let slice;
  for (let frame = 0; !slice?.done; frame++, frames++) {
    slice = mind.next();
    game.last?.frame(frame / 60);
  }
  const [best] = slice.value;

  // the stroke, and how it sounds
  if (game.inHand) game.place(0, ...best.place);
  const number = game.lines.filter((line) => line.startsWith('{"shot"')).length;
  game.shoot(carom.withErrors(best.cue, players[player], 1, number));
  for (const { impulse } of game.last.events) loudest = Math.max(loudest, impulse);

  // the ruling, and the layout that it leaves
  const ruling = carom.rule(game.last, state, best);
  console.log(`${player + 1}: ${ruling.text}`);
  game.settle(ruling);
  if (ruling.turn === "win" || ruling.turn === "lose")
    winner = ruling.turn === "win" ? player : 1 - player;
  else game.stand(ruling.game, ruling.turn === "pass" ? 1 - player : player);
}
const lines = game.end();
writeFileSync(file, lines);
console.log(
  `player ${winner + 1} wins; ${frames} frames, the hardest blow ${loudest.toFixed(4)} N s`,
);

// a reader plays every shot again, and compares its bits
for (const { same } of carom.replay(lines))
  if (!same) throw new Error("a shot has other bits than were recorded");
