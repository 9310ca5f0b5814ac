/* A match of nine-ball, as match.cpp: joins a host on this machine as his opponent, or watches.
 *
 *     node match.mjs join|watch PORT
 *
 * Lines of a recording come and go. Every shot is played here too, its bits are compared, and the same rules judge it. The opponent thinks in
 * slices: the page of a game stays alive, and draws a frame after each. */
import { createConnection } from "node:net";
import { createInterface } from "node:readline";
import { load } from "carom";

const [role, port] = process.argv.slice(2);
const carom = await load();
const ratings = [500, 600].map((fargo) => carom.player({ fargo }));
const game = carom.record();
let state = { rules: "nineball", group: "open", opening: true };
let [player, shots, frames, end] = [0, 0, 0, undefined]; // who is at the table; at the end, who has won
let put = new Map(); // balls that may be put elsewhere: the cue ball in hand, those that come back, with their places
let shown; // the last shot, for the film

/** What a shot amounts to. Returns whether it ends the game. */
function judge(table, balls, cue) {
  const ruling = carom.referee(table, balls, cue, state);
  const lie = game.balls;
  put = new Map(ruling.balls.flatMap(({ state: { label, r } }, k) => (label !== lie[k].state.label ? [[k, r]] : [])));
  if (ruling.hand !== "no") put.set(0, undefined);
  state = { ...ruling.game, may: "nothing" }; // without push-outs
  if (ruling.turn === "pass" || ruling.turn === "lose") player = 1 - player;
  shots++;
  return ruling.turn === "win" || ruling.turn === "lose";
}

/** A line of the other: his shot is played, and he puts balls where the rules allow it. */
function read(line) {
  const shot = game.read(line);
  const { place } = JSON.parse(line);
  if (place && !put.delete(place.ball)) throw new Error(`ball ${place.ball} is not in hand`);
  if (game.ended) end = JSON.parse(line).end;
  if (!shot) return;
  if (!shot.same) throw new Error(`shot ${shot.shot} has other bits than were recorded`);
  shown = shot.film;
  judge(shot.table, shot.balls, shot.cue);
}

/** The stroke of the player at the table. */
async function stroke() {
  const { table, balls } = game;
  const me = ratings[player];
  const thinking = carom.think(table, balls, { ...state, player: me, shots: 300, best: 1, inHand: put.has(0) }, 500);
  let slice;
  for (; !(slice = thinking.next()).done; frames++) {
    shown?.frame(frames / 60);
    await new Promise(setImmediate);
  }
  const [best] = slice.value;
  if (put.has(0)) game.place(0, ...best.place);
  const before = game.balls;
  const cue = carom.withErrors(best.cue, me, 1, shots);
  game.shoot(cue);
  shown = carom.simulate(table, before, cue);
  const last = judge(table, before, cue);
  for (const [k, r] of put) if (k > 0 && put.delete(k)) game.place(k, r[0], r[1]);
  if (last) {
    game.end();
    ({ end } = JSON.parse(game.lines.at(-1)));
  }
}

const socket = createConnection(Number(port), "127.0.0.1");
socket.write(`${role}\n`);
const isMyTurn = () => role === "join" && !end && player === 1 && [...put.keys()].every((k) => k === 0);
let current = false;
for await (const line of createInterface({ input: socket })) {
  if (line === "") current = true; // that was all so far
  else read(line);
  while (current && isMyTurn()) {
    const sent = game.lines.length;
    await stroke();
    socket.write(game.lines.slice(sent).join(""));
  }
  if (end) break;
}
socket.end();
console.log(`${frames} frames\n${!end ? "not at its end" : player === 0 ? "the host wins" : "the guest wins"} after ${shots} shots, ${end?.hash ?? game.hash}`);
