/*
 * A computer opponent for nine-ball: it plans its stroke, errs as a player of its rating does, and
 * a referee rules what it made.  `plan` looks for the stroke that wins most often for a player who
 * errs; `withErrors` is the stroke that this player makes of it; `referee` plays it and tells the
 * turn, the balls and the state of the game for the next stroke. A page runs this in a worker.
 * node match_point.mjs
 */
import { load } from "carom";

const carom = await load();
const table = carom.table("9ft");
const player = carom.player({ fargo: 600 });

// Three balls are left.
const down = { r: [0, 0, 0], v: [0, 0, 0], w: [0, 0, 0], label: "pocketed" };
let balls = carom.rack("nineball", table).map(({ kind }) => ({ kind, state: down }));
for (const [k, x, y] of [
  [0, 0.5, 0.7],
  [7, 0.9, 1.9],
  [8, 0.3, 1.3],
  [9, 0.7, 2.2],
])
  balls[k] = carom.ball(x, y, balls[k].kind);
let game = { rules: "nineball", group: "open" };

let ruling;
for (let stroke = 1; stroke <= 8; stroke++) {
  const [target] = carom.ballsOn(game, balls);
  const [best] = carom.plan(table, balls, { ...game, player, shots: 400, best: 1 });
  ruling = carom.referee(table, balls, carom.withErrors(best.cue, player, stroke), game);
  console.log(
    `stroke ${stroke}: ball ${target}, hopes to win by ${(100 * best.value).toFixed(0)} %: ${ruling.turn}`,
  );
  if (ruling.turn !== "keep") break;
  ({ balls, game } = ruling);
}
if (!["pass", "win", "lose"].includes(ruling.turn))
  throw new Error(`a visit cannot end by ${ruling.turn}`);
