/* The game of match.cpp in JavaScript: node match.mjs FILE keeps its recording. */
import { writeFileSync } from "node:fs";
import { load } from "carom";

const carom = await load();
const table = carom.table("9ft");
const players = [500, 600].map((fargo) => carom.player({ fargo }));
let state = { rules: "nineball", group: "open", opening: true };
let game = carom.record(table, carom.rack("nineball", table, { seed: 2 }));
let [player, winner, frames, loudest] = [0, undefined, 0, 0]; // N s
for (let number = 0; winner === undefined; number++) {
  // how the game stands is kept, also for another program, which goes on from there
  game.stand(state, player);
  if (number === 3) {
    const { lines } = game;
    game = carom.record();
    for (const line of lines) game.read(line);
    ({ game: state, player } = game.standing);
  }

  // the player thinks, while the shot of the other is drawn: a page awaits a frame here
  const mind = carom.think(table, game.balls, { ...state, player: players[player], shots: 300, best: 1, inHand: game.inHand }, 500);
  let slice;
  for (let frame = 0; !slice?.done; frame++, frames++) {
    slice = mind.next();
    game.last?.frame(frame / 60);
  }
  const [best] = slice.value;

  // the stroke, and how it sounds
  if (game.inHand) game.place(0, ...best.place);
  game.shoot(carom.withErrors(best.cue, players[player], 1, number));
  for (const { impulse } of game.last.events) loudest = Math.max(loudest, impulse);

  // the ruling, and the layout that it leaves
  const ruling = carom.rule(game.last, state, best);
  console.log(`${player + 1}: ${ruling.text}`);
  state = ruling.game;
  game.settle(ruling);
  if (ruling.turn === "pass") player = 1 - player;
  else if (ruling.turn !== "keep") winner = ruling.turn === "win" ? player : 1 - player;
}
const lines = game.end();
writeFileSync(process.argv[2], lines);
console.log(`player ${winner + 1} wins; ${frames} frames, the hardest blow ${loudest.toFixed(4)} N s`);

// a reader plays every shot again, and compares its bits
for (const { same } of carom.replay(lines)) if (!same) throw new Error("a shot has other bits than were recorded");
