// As game.c, in JavaScript: the recording is read here, by its page (docs/reference/files.md), and
// played by the npm package.
import { readFileSync } from "node:fs";
import { load } from "../../web/npm/dist/index.js";

const carom = await load();
const kindKeys = Object.keys(carom.kind("pool"));
const LABELS = ["stationary", "spinning", "sliding", "rolling", "pocketed", "airborne", "off"];
const word = (x) => BigInt.asUintN(64, x);

/** One step of the hash of a shot, or of a game. */
function stir(hash, bits) {
  const mixed = hash ^ bits;
  return word(word((mixed << 27n) | (mixed >> 37n)) * 0x9e3779b97f4a7c15n);
}

/** The bits of a double. */
function bitsOf(number) {
  const bytes = new DataView(new ArrayBuffer(8));
  bytes.setFloat64(0, number);
  return bytes.getBigUint64(0);
}

/**
 * The numbers of each kind of line in order, and those of the objects in its lists. Whole numbers
 * end with "#", lists of n numbers with "*n".
 */
const NUMBERS = {
  recording: ["format#", "revision#"],
  table: [
    "width",
    "length",
    "ball_radius",
    "rail_width",
    "pocket_back",
    "rails",
    "jaws",
    "pockets",
    "slope_x",
    "slope_y",
  ],
  rails: ["p*2", "q*2", "height", "line*3", "side#", "mu_cushion", "restitution"],
  jaws: ["centre*2", "radius", "height", "mu_cushion", "restitution"],
  pockets: ["centre*2", "radius", "depth"],
  options: [
    "world#",
    "ball_model#",
    "cushion_model#",
    "friction#",
    "steps#",
    "space#",
    "simultaneous#",
    "cluster_steps#",
  ],
  balls: ["list"],
  list: [
    ...kindKeys.map((key) => key.replace(/[A-Z]/g, (letter) => `_${letter.toLowerCase()}`)),
    "r*3",
    "v*3",
    "w*3",
    "label#",
  ],
  shot: [
    "speed",
    "phi",
    "theta",
    "a",
    "b",
    "mass",
    "end_mass",
    "tip_restitution",
    "tip_radius",
    "ball#",
    "miscue",
    "tip_time",
    "follow",
    "time_most",
    "stop_at#",
    "first_of#",
    "events_most#",
    "status#",
    "events#",
    "time",
    "hash",
  ],
};
const LINES = { recording: 1n, table: 2n, options: 3n, balls: 4n, shot: 6n };

/** The bits of a number of a line by its name in NUMBERS; those of 0 where it is missing. */
function bitsOfField(name, value) {
  if (value === undefined) return 0n;
  if (name === "hash") return BigInt(`0x${value}`);
  return name.endsWith("#") ? word(BigInt(value)) : bitsOf(number(value));
}

/** The stroke of a line of a shot, without what was recorded of its end. */
function strokeOf(line) {
  const stroke = { ...line };
  for (const result of ["status", "events", "time", "hash"]) delete stroke[result];
  return stroke;
}

/** The hash with the numbers of an object of a line. */
function stirObject(hash, kind, object) {
  let place = 0n;
  for (const name of NUMBERS[kind]) {
    const [, key, many] = /^(\w+)(?:\*(\d))?#?$/.exec(name);
    if (NUMBERS[key] !== undefined) {
      place++;
      const list = object[key] ?? [];
      if (list.length > 0) hash = stir(stir(hash, place), BigInt(list.length));
      for (const k of list.keys())
        hash = stirObject(hash, key, Object.assign({}, ...list.slice(0, k + 1)));
      continue;
    }
    for (let k = 0; k < (Number(many) || 1); k++) {
      const value = many ? object[key]?.[k] : object[key];
      const bits = bitsOfField(name, value);
      place++;
      if (bits !== 0n) hash = stir(stir(hash, place), bits);
    }
  }
  return stir(hash, 0n);
}

/** The fingerprint of words, and of those before: four chains, which are joined at the end. */
function fingerprint(before, words) {
  const chains = [before, 1n, 2n, 3n];
  const whole = words.length - (words.length % 4);
  words.forEach((bits, k) => {
    const chain = k < whole ? k % 4 : 0;
    chains[chain] = stir(chains[chain], bits);
  });
  return chains.reduce(stir);
}

/** FNV-1a of the bits of numbers, the lowest byte first. */
function add(hash, numbers) {
  for (const number of numbers)
    for (let k = 0n; k < 64n; k += 8n)
      hash = word((hash ^ ((bitsOf(number) >> k) & 255n)) * 0x100000001b3n);
  return hash;
}

/** A number of a recording, which may be hexadecimal text. */
function number(value) {
  const hexadecimal = /^(-?)0x([0-9a-f])\.?([0-9a-f]*)p([+-]?\d+)$/.exec(value);
  if (!hexadecimal) return value;
  const [, sign, first, more, power] = hexadecimal;
  return (sign ? -1 : 1) * (parseInt(first + more, 16) / 16 ** more.length) * 2 ** Number(power);
}

/**
 * A value of a recording as the package has it: keys in camel case, hexadecimal numbers as numbers.
 */
function read(value) {
  if (Array.isArray(value)) {
    // In a list a key that is missing has the value of the object before.
    const list = value.map(read);
    return typeof list[0] === "object"
      ? list.map((_, k) => Object.assign({}, ...list.slice(0, k + 1)))
      : list;
  }
  if (typeof value === "object")
    return Object.fromEntries(
      Object.entries(value).map(([key, one]) => [
        key.replace(/_(.)/g, (_, c) => c.toUpperCase()),
        read(one),
      ]),
    );
  return number(value);
}
const hex = (hash) => hash.toString(16).padStart(16, "0");

let shots = 0;
let game = 0n; // the hash of the lines so far
let table, balls;
for (const line of readFileSync(process.argv[2], "utf8").trim().split("\n")) {
  // A negative zero is -0 for JSON.parse() too.
  const [[kind, value]] = Object.entries(JSON.parse(line));
  const before = game;
  if (kind !== "end") game = stirObject(stir(game, LINES[kind]), kind, value);
  const given = read(value);
  if (kind === "recording" && given.revision !== carom.physicsRevision)
    throw new Error(`the recording is of revision ${given.revision}`);
  else if (kind === "options" && Object.keys(given).length > 0)
    throw new Error("only the usual models are known here");
  else if (kind === "table") {
    const PART = {
      p: [0, 0],
      q: [0, 0],
      height: 0,
      line: [0, 0, 0],
      muCushion: 0,
      restitution: 0,
      side: 0,
    };
    table = {
      ...given,
      rails: given.rails.map((one) => ({ ...PART, ...one })),
      jaws: given.jaws ?? [],
      pockets: given.pockets ?? [],
    };
  } else if (kind === "balls") {
    const zero = [0, 0, 0];
    balls = given.list.map((one) => ({
      kind: Object.fromEntries(kindKeys.map((key) => [key, one[key] ?? 0])),
      state: {
        r: one.r ?? zero,
        v: one.v ?? zero,
        w: one.w ?? zero,
        label: LABELS[one.label ?? 0],
      },
    }));
  } else if (kind === "shot") {
    const { status, hash } = given;
    const shot = carom.simulate(table, balls, {
      miscue: 0,
      tipTime: 0,
      ball: 0,
      phi: 0,
      theta: 0,
      a: 0,
      b: 0,
      ...strokeOf(given),
    });
    const words = shot.final.flatMap(({ r, v, w, label }) => [
      ...[...r, ...v, ...w].map(bitsOf),
      BigInt(LABELS.indexOf(label)),
    ]);
    const begun = stirObject(stir(before, LINES.shot), "shot", strokeOf(value));
    const played = fingerprint(
      fingerprint(begun, [BigInt(status), BigInt(shot.events.length), bitsOf(shot.time)]),
      words,
    );
    if (shot.status !== "ok" || status !== 0 || hex(played) !== hash)
      throw new Error(`shot ${shots + 1} has other bits than were recorded`);
    shots++;
    game = played;
    balls = balls.map(({ kind: of }, k) => ({ kind: of, state: shot.final[k] }));
  } else if (kind === "end" && (given.shots !== shots || given.hash !== hex(game)))
    throw new Error("the hash of the game is another one");
}
console.log(`recording: ${shots} shots, ${hex(game)}`);

table = carom.table("9ft");
const shot = carom.simulate(table, carom.rack("nineball", table), { speed: 8 });
let hash = 0xcbf29ce484222325n;
for (const event of shot.events) hash = add(hash, [event.time]);
for (const { r, v, w } of shot.final) hash = add(hash, [...r, ...v, ...w]);
console.log(`break: ${shot.events.length} events, ${hex(hash)}`);

// The film of the shot in parts.
let parts = carom.simulate(table, shot.balls, { speed: 8 }, { timeMost: 0.2 });
let frames = 0;
for (; frames / 60 < shot.time; frames++) {
  if (frames / 60 > parts.time) parts = carom.continue(parts, { timeMost: frames / 60 + 0.2 });
  const { states, turned } = parts.frame(frames / 60);
  for (let k = 0; k < shot.balls.length; k++)
    hash = add(add(hash, states.subarray(10 * k, 10 * k + 3)), turned.subarray(4 * k, 4 * k + 4));
}
for (const { slip } of shot.events) hash = add(hash, [slip]);
console.log(`film: ${frames} frames, ${hex(hash)}`);
