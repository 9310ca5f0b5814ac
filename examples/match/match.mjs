// The game of match.c in JavaScript: node match.mjs FILE STROKES.
import { existsSync, readFileSync, writeFileSync } from "node:fs";
import { load } from "carom";

const [file, strokes] = process.argv.slice(2);
const carom = await load();
const saved = existsSync(file) ? readFileSync(file, "utf8").split("\n").slice(0, -1) : [];
const game = saved[0] ? carom.match() : carom.match("eightball", carom.table("9ft"), { seed: 5 });
for (const line of saved) game.read(line);
const players = [550, 650].map((fargo) => carom.player({ fargo, rules: "eightball" }));
let ended;
for (let k = 0; k < strokes && !ended && game.phase !== "over"; k++) {
  const me = game.seat;
  const player = players[me];
  const opponent = players[1 - me];
  const [best] = game.plan({ player, opponent, shots: 300, best: 1 });
  game.take(best, carom.withErrors(best.cue, player, 9, game.shots));
  console.log(`${me + 1}: ${game.ruling.words}`);
  if (game.phase === "over") ended = game.end();
}
writeFileSync(file, ended ?? game.lines.join(""));
