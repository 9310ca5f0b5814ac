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

// A note, and some that are refused.
const talk = game.copy();
const note = { seat: 1, comment: 'He said "nice"', offer: "draw", seconds: 12.5, x_club: "A \\ B" };
talk.note(note);
const said = talk.lines.at(-1);
assert.deepEqual(talk.notes, [note]);
for (const wrong of [{ comment: "two\nlines" }, { offer: "money" }, { chat: "hello" }, {}]) {
  assert.throws(() => talk.note({ seat: 0, ...wrong }), CaromError);
  assert.deepEqual(talk.lines, [...game.lines, said]);
}
assert.throws(() => talk.note({ seat: 2, comment: "hello" }), /seat 2 is not one of the match/);
assert(talk.receive(act[0], 0));
assert.deepEqual(talk.lines, [...game.lines, said, ...act]);
const loaded = carom.match();
for (const line of talk.lines) loaded.read(line);
assert.deepEqual(loaded.notes, [note]);
assert.deepEqual(loaded.lines, talk.lines);
process.stdout.write(said);

// A ruling of a file that is read only in part: no line is lost, whatever comes next.
const lines = readFileSync(process.argv[3], "utf8").match(/.*\n/g);
const whole = [...game.lines, ...act];
const following = lines[whole.length];
assert(act.length > 1);
assert.deepEqual(lines.slice(0, whole.length), whole);
const partial = game.copy();
partial.read(act[0]);
assert.deepEqual(partial.lines, whole);
const noted = partial.copy();
noted.read(said);
assert.deepEqual(noted.lines, [...game.lines, act[0], said, ...act.slice(1)]);
assert.throws(() => partial.place(9, 9), CaromError);
assert.deepEqual(partial.lines, whole);
for (const judged of [partial.copy(), noted]) {
  const before = judged.lines;
  assert(!judged.receive(act[1], 0));
  assert(judged.receive(following, null));
  assert.deepEqual(judged.lines.slice(0, before.length + 1), [...before, following]);
}
const spoken = partial.copy();
spoken.note({ seat: 1, comment: "between" });
assert.deepEqual(spoken.lines.slice(0, -1), whole);
for (const line of act.slice(1)) partial.read(line);
assert.deepEqual(partial.lines, whole);

// The whole match, to its end.
for (const line of lines.slice(game.lines.length)) game.receive(line, null);
assert.deepEqual(game.lines, lines);
console.log(`${sent} rows`);
