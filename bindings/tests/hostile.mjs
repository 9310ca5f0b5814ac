// hostile.mjs ROWS MATCH: the lines that hostile.c wrote, received by a match of the npm package.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { CaromError, load } from "../../web/npm/dist/index.js";

const carom = await load();
const game = carom.match();
const act = [];
let sent = 0;

/** What a refused line may not change. */
const stateOf = ({ lines, phase, seat, actor, shots }) => ({ lines, phase, seat, actor, shots });

for (const line of readFileSync(process.argv[2], "utf8").split("\n").slice(0, -1)) {
  const [, word, rest] = /^(\w+) (.*)$/.exec(line);
  if (word === "begin") game.receive(rest, null);
  else if (word === "place") {
    assert.equal(game.actor, undefined);
    game.receive(rest, 0);
  } else if (word === "act") act.push(`${rest}\n`);
  else {
    const [, name, seat, text] = /^([^|]*)\|(\d+)\|(.*)$/.exec(rest);
    const state = stateOf(game);
    try {
      assert(!game.receive(text, Number(seat)), `${name} is accepted`);
      assert(text.trim() === "" || text.startsWith('{"event"'), `${name} is not refused`);
    } catch (error) {
      if (!(error instanceof CaromError)) throw error;
      assert.notEqual(error.message, "", `${name} has no reason`);
    }
    assert.deepEqual(stateOf(game), state, `${name} changed the match`);

    // The honest act: its line, then those of its ruling, then all again.
    const twin = game.copy();
    assert(twin.receive(act[0], 0), `${name}: the honest line is not accepted behind it`);
    const lines = [...game.lines, ...act];
    assert.deepEqual(twin.lines, lines, `${name}: the honest act has other lines behind it`);
    for (const known of [...act, ...act]) assert(!twin.receive(known, 0), `${name}: a line is new`);
    assert.deepEqual([twin.lines, twin.actor], [lines, 0]);
    twin.free();
    sent++;
  }
}

// The whole match, to its end.
const lines = readFileSync(process.argv[3], "utf8").match(/.*\n/g);
for (const line of lines.slice(game.lines.length)) game.receive(line, null);
assert.deepEqual(game.lines, lines);
console.log(`${sent} rows`);
