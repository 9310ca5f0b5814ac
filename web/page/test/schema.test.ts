// A game as text, with each of its settings damaged: refused in words that name the setting and say
// what it may be. What the page itself writes is accepted.
import { expect, test } from "vitest";
import { Play, read, type Setup } from "../src/play/game.js";
import { PLAYED, SEATS } from "../src/table/games.js";
import { carom } from "../../test/builds.js";

const setup: Setup = { game: "nineball", against: "link", own: "500", seed: 3 };
const text = (): Record<string, unknown> => {
  const play = new Play(carom, setup);
  play.stroke(carom.cue({ speed: 4, phi: 90 }));
  return JSON.parse(play.text()) as Record<string, unknown>;
};
const opened = (members: unknown) => () => read(carom, JSON.stringify(members));

test.each([
  ["game", [0, null, "chess", ["pool"]]],
  ["against", ["nobody", "999999", "0", 300, null, "-5"]],
  ["own", ["-5", "x", 500, "1e3", null]],
  ["seed", ["x", -1, 1.5, null, 1e300]],
  ["table", ["moon", 9, null]],
  ["cloth", ["ice", "", null, "lively_cushion"]],
  ["cushion", ["5,5", "a,b", "ice", "0.8", "0.8,0.1,0.2", ",", "-0.5,0.2", null, 1]],
  ["race", [-3, 0, 1.5, "3", 1e9, null]],
  ["racks", [[9, "x"], [1], [1, 2, 3], [-1, 0], "1,2", null]],
  ["equalInnings", [1, "yes", null]],
  ["seats", [900, 1, "3", 2.5, null]],
  ["clock", [-1, 1e-3, 0, "30", 1e9, null]],
  ["lines", [null, "x", {}, [{ a: 1 }], [1]]],
  ["aims", [null, 1, ["p"]]],
  ["entries", [null, 1]],
  ["at", [null, 1, "NaN,1 in in", "1,1"]],
  ["drill", [null, 1]],
] as const)("%s", (name, values) => {
  for (const value of values)
    expect(opened({ ...text(), [name]: value }), JSON.stringify(value)).toThrow(
      new RegExp(`${name}|${JSON.stringify(value).replace(/[^\w]+/g, ".*")}`),
    );
});

test("members that are missing, unknown, or of no object", () => {
  for (const name of ["game", "against", "own", "seed"]) {
    const rest = Object.fromEntries(Object.entries(text()).filter(([other]) => other !== name));
    expect(opened(rest), name).toThrow(`${name} is missing`);
  }
  expect(opened({ ...text(), colour: "red" })).toThrow("colour: there is no such setting");
  expect(opened({ ...text(), toString: 1 })).toThrow("toString: there is no such setting");
  for (const value of [null, [1, 2], "text", 3]) expect(opened(value)).toThrow("incomplete");
  expect(() => read(carom, '{"game":')).toThrow("incomplete");
});

test("an error shows no more than a line of a long value", () => {
  expect(opened({ ...text(), race: "9".repeat(10000) })).toThrow(/^race: "9{39}… is not allowed/);
});

test("what the page writes is accepted", () => {
  for (const game of Object.keys(PLAYED)) {
    const seats = SEATS[game]?.[0];
    const more = { race: 5, racks: [1, 2] as const, clock: 30, ...(seats && { seats }) };
    const play = new Play(carom, { ...setup, ...more, game, against: "person" });
    expect(read(carom, play.text()).setup, game).toEqual(play.setup);
    expect(read(carom, play.shortText()).setup, game).toEqual(play.setup);
  }
});
