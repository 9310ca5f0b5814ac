// The verbs that the command and Python have too: ways, reasons, breaks, practice, aims by cut,
// recordings of shots and matches, racks, first events and potted balls. The command's numbers are
// compared.
import { mkdtempSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { expect, test } from "vitest";
import type { CaromError, Match, PlanStroke, Shot, ShotBall } from "../dist/index.js";
import { builds, carom, refusal, refuses, run, thereIsACommand } from "./support.js";

const table = carom.table("9ft");
const layout = [carom.ball(0.6, 0.8), carom.ball(0.9, 1.5), carom.ball(0.3, 1.9)];

/** The rows of a CSV text. */
function rowsOf(text: string): Record<string, string>[] {
  const [head, ...lines] = text.trim().split("\n");
  const names = head!.split(",");
  return lines.map((line) =>
    Object.fromEntries(line.split(",").map((cell, k) => [names[k]!, cell])),
  );
}
/** Degrees, above 0 to the left, by the first contact of two balls. */
function cutOf(shot: Shot): number {
  const { before, a } = shot.events.find(({ type }) => type === "ball_ball")!;
  const [cue, ball] = a === 0 ? [before[0]!, before[1]!] : [before[1]!, before[0]!];
  const [vx, vy] = cue.v;
  const x = ball.r[0] - cue.r[0];
  const y = ball.r[1] - cue.r[1];
  return (180 / Math.PI) * Math.atan2(vx * y - vy * x, vx * x + vy * y);
}

// ---- Aims

test("a cut is exact, also with side spin and on a table without pockets", () => {
  const two = [carom.ball(0.6, 0.5), carom.ball(0.6, 1.7)];
  const square = carom.polygon([
    { x: 0, y: 0 },
    { x: 10, y: 0 },
    { x: 10, y: 10 },
    { x: 0, y: 10 },
  ]);
  for (const on of [table, square])
    for (const a of [-0.3, 0, 0.15, 0.3]) {
      const hit = carom.aim(on, two, { speed: 3, a }, { ball: 1, cut: 30 });
      expect(Math.abs(cutOf(carom.simulate(on, two, hit.cue)) - 30)).toBeLessThan(1e-6);
      expect([hit.cue.speed, hit.cue.a, hit.cut]).toEqual([3, a, 30]);
    }
  const cuts = [-80, -40, 0, 40, 80];
  const hits = carom.aim(table, two, { speed: 2, a: 0.2 }, { ball: 1, cut: cuts });
  hits.forEach(({ cue }, k) =>
    expect(cutOf(carom.simulate(table, two, cue))).toBeCloseTo(cuts[k]!, 6),
  );
  expect(carom.aim(table, two, {}, { ball: 1 }).cut).toBe(0);
  expect(carom.aim(table, two, {}, { ball: 1, cut: [] })).toEqual([]);
});

test("an aim by cut that is none has a reason", () => {
  const three = [carom.ball(0.6, 0.5), carom.ball(0.6, 1.7), carom.ball(0.6, 2)];
  const aim =
    (at: object, cue = {}) =>
    () =>
      carom.aim(table, three, cue, { ball: 1, ...at } as { ball: number });
  refuses(
    [aim({ cut: 90 }), "cut: it must be above -90 and below 90 degrees, not 90"],
    [aim({ cut: NaN }), "not NaN"],
    [aim({ ball: 0 }), "ball: 0 is the cue ball"],
    [aim({ ball: 3 }), "ball: it must be a whole number, 0 to 2, not 3"],
    [aim({ ball: 2 }), "no aim at ball 2 with a cut of 0 degrees: ball 1 is in the way"],
    [aim({ cut: [0, 5] }, { speed: 0.1 }), "cut[0]: no aim at ball 1"],
    [aim({}, { speed: 0.1 }), "comes to rest before it; raise"],
    [aim({ via: ["head"] }), "via: it needs a pocket"],
    [aim({ pocket: 0, cut: 3 }), "pocket, cut: "],
    [aim({ ct: 3 }), 'did you mean "cut"?'],
  );
});

// ---- Ways

/** A player as the command has it: without bounds of speed and tip. */
const unbounded = { ...carom.player(), speedLeast: 0.01, speedMost: 1000, tipMost: 1 };

test.runIf(thereIsACommand)("ways are those of the command, to the bit", () => {
  const places = ["--cue", "0.6,0.8", "--balls", "0.9,1.5:0.3,1.9"];
  const of = ["--speed", "3", "--ball", "1", "--scan", "4000", "--csv"];
  // the names of pockets, such as rt, and of rails have commas between them
  const rows = run(["ways", ...places, ...of])
    .trim()
    .split("\n")
    .slice(1)
    .map((row) => /^\d+,(\w+),1,(\w+),"(.*)",(.*)$/.exec(row)!.slice(1));
  const options = { ball: 1, scan: 4000, player: unbounded };
  const { ways, parts, scanned } = carom.ways(table, layout, { speed: 3 }, options);
  expect(ways.length).toBe(rows.length);
  rows.forEach(([kind, , way, numbers], k) => {
    const { cue, phi, chance, error, found } = ways[k]!;
    const told = numbers!.split(",").map(Number);
    expect([kind, told[1]]).toEqual([ways[k]!.kind, cue.phi]);
    const rails = parts[k]!.filter((part) => typeof part === "string");
    expect(way!.split(", ").filter((part) => /^[a-z]+$/.test(part))).toEqual(rails);
    [phi[0], phi[1]].forEach((bound, side) => expect(told[6 + side]).toBeCloseTo(bound, 6));
    expect(told.slice(10, 12)).toEqual([chance, Number(error.toFixed(6))]);
    expect(told.slice(12)).toEqual([found, scanned]);
  });
});

test("ways to pot, to score and to a place", () => {
  const options = { ball: 1, scan: 4000, rails: 1 };
  const found = carom.ways(table, layout, { speed: 3, b: 0 }, options);
  for (const { carom } of builds)
    expect(carom.ways(table, layout, { speed: 3, b: 0 }, options)).toEqual(found);
  expect(found.ways.length).toBe(found.parts.length);
  expect(found.ways.length).toBeGreaterThan(3);
  expect(new Set(found.ways.map(({ kind }) => kind))).toEqual(new Set(["pot", "bank", "kick"]));
  const chances = found.ways.map(({ chance }) => chance);
  expect(chances).toEqual([...chances].sort((a, b) => b - a));
  expect([found.good > 0, found.leftOut]).toEqual([true, 0]);
  found.ways.forEach(({ cue, ball }, k) => {
    const shot = carom.simulate(table, layout, cue);
    expect([ball, shot.potted(1), shot.potted(0)]).toEqual([1, true, false]);
    for (const part of found.parts[k]!)
      if (typeof part === "string") expect(carom.railNames(table)).toContain(part);
  });
  const corner = carom.ways(table, layout, {}, { pocket: "top-left", scan: 4000 });
  const name = carom.pocketNames(table).indexOf("foot-left");
  expect(new Set(corner.ways.map(({ pocket }) => pocket))).toEqual(new Set([name]));

  const billiard = carom.table("threecushion");
  const three = carom.rack("threecushion", billiard);
  const scored = carom.ways(billiard, three, { speed: 5 }, { scan: 4000, most: 20 });
  expect([scored.scanned, scored.ways[0]!.kind]).toEqual([4000, undefined]);
  const alone = layout.slice(0, 1);
  const [there] = carom.ways(table, alone, {}, { place: [0.6, 1.5], scan: 4000 }).ways;
  const [x, y] = carom.simulate(table, alone, there!.cue).final[0]!.r;
  expect(Math.hypot(x - 0.6, y - 1.5)).toBeLessThan(0.15);
  const ways =
    (options: object, cues = {}) =>
    () =>
      carom.ways(table, layout, cues, options);
  refuses(
    [ways({ goal: "win" }), 'goal: unknown name "win"; use one of pot, score, place'],
    [ways({ goal: "place" }), "place: the goal"],
    [ways({ ball: 3 }), "ball: it must be a whole number, 0 to 2, not 3"],
    [ways({ pocket: "middle" }), 'pocket: unknown name "middle"'],
    [ways({}, []), "cues: at least one"],
    [ways({ most: 0 }), "most: "],
    [ways({ player: 1 }), "player"],
    [() => carom.ways(table, [layout[0]!, layout[0]!], {}), /balls\[\d\].*overlap/],
  );
});

// ---- Reasons

test("why a choice is good", () => {
  const options = { rules: "nineball", shots: 200, seed: 3 } as const;
  const choice = carom.plan(table, layout, options)[0]!;
  const why = carom.why(table, layout, choice, options);
  for (const { carom } of builds) expect(carom.why(table, layout, choice, options)).toEqual(why);
  expect(why.first).toBe(1);
  expect(why.words).not.toBe("");
  const { aim, speed, tip, eye } = why.cost;
  expect(aim + speed + tip + eye).toBeCloseTo(why.flawlessValue - why.value, 9);
  const pass: PlanStroke = { ...choice, kind: "pass" };
  refuses(
    [() => carom.why(table, layout, pass, options), "choice: it is to pass"],
    [() => carom.why(table, layout, choice, { rules: "nineballl" } as object), "did you mean"],
  );
});

test.runIf(thereIsACommand)("reasons are those of the command", () => {
  const places = ["--cue", "0.6,0.8", "--balls", "0.9,1.5:0.3,1.9"];
  const text = run(["plan", "--rules", "nineball", ...places, "--shots", "200", "--why"]);
  const [block] = text.split(/^2\. /m);
  const options = { rules: "nineball", shots: 200, player: unbounded } as const;
  const direction = / direction (\S+) /.exec(block!)![1];
  const choice = carom
    .plan(table, layout, options)
    .find(({ cue }) => cue.phi.toFixed(3) === direction)!;
  const why = carom.why(table, layout, choice, options);
  const told = /cost (\S+) %: those of aim (\S+) %.*speed (\S+) %.*tip (\S+) %.*eye (\S+) %/;
  const { aim, speed, tip, eye } = why.cost;
  expect(told.exec(block!)!.slice(1)).toEqual(
    [why.flawlessValue - why.value, aim, speed, tip, eye].map((one) => (100 * one).toFixed(1)),
  );
  expect(/misses +(\d+) %/.exec(block!)![1]).toBe((100 * why.misses).toFixed(0));
  expect(Number(/wins (\S+) %/.exec(block!)![1])).toBeCloseTo(100 * why.value, 1);
});

// ---- Breaks

test.runIf(thereIsACommand)("breaks are those of the command", () => {
  const row = ["break", "--rules", "nineball", "--racks", "64", "--speed", "9", "--csv"];
  const [told] = rowsOf(run(row));
  const cue = { speed: 9, a: -Number(told!.right), b: Number(told!.above) };
  const found = carom.breaks("nineball", table, carom.rack("nineball", table), {
    cue,
    player: unbounded,
    racks: 64,
  });
  const same = {
    makes: found.makes,
    balls: found.balls,
    plays_on: found.playsOn,
    scratch: found.scratches,
    wing: found.wing,
    spread: found.spread,
    wins: found.wins,
    wins_error: found.error,
    x: found.place[0],
  };
  for (const [name, value] of Object.entries(same))
    expect(Number(told![name]), name).toBeCloseTo(value, 6);
});

test("breaks of racks, also of a game without a break", () => {
  const rack = carom.rack("nineball", table);
  const found = carom.breaks("9-ball" as "nineball", table, rack, { racks: 32 });
  for (const { carom } of builds)
    expect(carom.breaks("nineball", table, rack, { racks: 32 })).toEqual(found);
  expect([found.breaks, found.fell.length, found.fell[0]!.length]).toEqual([32, 10, 6]);
  const fallen = found.fell.slice(1).flat();
  expect(fallen.reduce((all, one) => all + one, 0)).toBeCloseTo(found.balls, 9);
  const snooker = carom.table("snooker");
  const other = carom.breaks("snooker", snooker, carom.rack("snooker", snooker), { racks: 2 });
  expect(other.fell.length).toBe(22);
  const breaks = (options: object) => () => carom.breaks("nineball", table, rack, options);
  refuses(
    [breaks({ aim: "x" }), 'aim: unknown name "x"; use one of full, direction, cut'],
    [breaks({ racks: 0 }), "racks: "],
    [breaks({ gap: 1 }), "rack"],
  );
});

// ---- Practice, and recordings of matches

/** A match of four strokes. */
function played(): Match {
  const match = carom.match("nineball", table, { seed: 16, seats: ["Ann", "Bo"] });
  const player = carom.player({ errors: 3 });
  for (let number = 0; number < 4; number++) {
    const best = match.plan({ shots: 100, player })[0]!;
    match.take(best, carom.withErrors(best.cue, player, 1, number));
  }
  return match;
}

test("practice, and a match that is saved and loaded", () => {
  const match = played();
  const text = match.save();
  const loaded = carom.load(text) as Match;
  expect(loaded.lines).toEqual(match.lines);
  expect(loaded.options).toEqual({});
  const found = carom.practice(text);
  const costs = found.map(({ missCost, placeCost }) => missCost + placeCost);
  expect(costs).toEqual([...costs].sort((a, b) => b - a));
  expect(found.reduce((all, { strokes }) => all + strokes, 0)).toBe(4);
  const lines = text.split("\n");
  for (const { group, strokes, reviewed } of found) {
    expect(reviewed.length).toBe(strokes);
    for (const one of reviewed) {
      expect(one.review.group).toBe(group);
      expect(lines[one.line - 1]).toMatch(/^\{"shot"/);
    }
  }
  const strokesOf = (seat: string | number): number =>
    carom.practice(text, seat).reduce((all, { strokes }) => all + strokes, 0);
  expect(strokesOf("Ann")).toBe(strokesOf(0));
  expect(strokesOf("Ann") + strokesOf("Bo")).toBe(4);
  refuses([
    () => carom.practice(text, "Cy"),
    'seat: unknown name "Cy"; the names of the recording are: Ann, Bo',
  ]);
});

test.runIf(thereIsACommand)("the costliest stroke is that of the command", () => {
  const path = `${mkdtempSync(`${tmpdir()}/carom-`)}/match.carom`;
  const text = played().save();
  writeFileSync(path, text);
  const drill = run(["practice", path, "--csv"]).split("\n")[1]!;
  const costly = carom.practice(text, 0, { player: unbounded })[0]!;
  const { review, balls } = costly.reviewed[0]!;
  expect(drill).toContain(`"${costly.group} 1","Pot the ${review.ball} into the `);
  expect(drill).toContain(`"0:${balls[0]!.state.r.slice(0, 2).map((x) => x.toFixed(4))} `);
  expect(drill).toMatch(new RegExp(`,${review.drill!.rating.toFixed(0)}$`));
});

// ---- Recordings of shots

test("a shot is saved and loaded with its bits, also one that was stopped", () => {
  const rack = carom.rack("nineball", table);
  const shot = carom.simulate(table, rack, { speed: 8 }, { cushionModel: "han" });
  const again = carom.load(shot.save()) as Shot;
  expect(again.bytes).toEqual(shot.bytes);
  expect([again.options, again.cue, again.final]).toEqual([shot.options, shot.cue, shot.final]);
  expect(again.save()).toBe(shot.save());
  const stopped = carom.simulate(table, rack, { speed: 8 }, { timeMost: 0.5 });
  const half = carom.load(stopped.save()) as Shot;
  expect([half.status, half.time, half.options]).toEqual([
    "stopped_at_time",
    0.5,
    { timeMost: 0.5 },
  ]);
  const whole = carom.continue(half, { stopAt: ["ball_pocket", "slate"] });
  const parts = carom.load(whole.save()) as Shot;
  expect([parts.bytes, parts.status]).toEqual([whole.bytes, whole.status]);
  expect(carom.continue(parts).bytes).toEqual(carom.simulate(table, rack, { speed: 8 }).bytes);
  const moved = carom.simulate(table, rack, { speed: 8 });
  (moved.final[0] as { r: readonly number[] }).r = [0, 0, 0];
  refuses(
    [() => moved.save(), "shot: playing it again has other bits"],
    [() => carom.load(""), "cut off"],
    [() => carom.load(shot.save().replace(/"hash":"(.)/g, '"hash":"0$1')), /line \d/],
  );
});

test.runIf(thereIsACommand)("the command verifies recordings of shots", () => {
  const batch = carom.shots(table, carom.rack("nineball", table), 3);
  for (let k = 0; k < 3; k++) batch.setCue(k, carom.cue({ speed: 4 + k }));
  carom.simulateBatch(batch);
  const text = batch.save();
  const path = `${mkdtempSync(`${tmpdir()}/carom-`)}/three.carom`;
  writeFileSync(path, text);
  expect(run(["verify", path])).toContain("3");
  const loaded = carom.load(text.split("\n")) as Shot[];
  expect(loaded.map(({ time }) => time)).toEqual([0, 1, 2].map((k) => batch.time(k)));
});

test("a batch without a shot, or with one that was refused, is not saved", () => {
  const batch = carom.shots(table, [carom.ball(0.6, 0.5), carom.ball(0.6, 0.5)], 1);
  carom.simulateBatch(batch);
  refuses(
    [() => batch.save(), "shots[0]: it was not played, so it cannot be saved"],
    [() => carom.shots(table, layout, 0).save(), "the batch is empty"],
  );
});

// ---- Racks

test("racks with a cue ball and with lists of gaps and seeds", () => {
  const one = carom.rack("nineball", table, { cueBall: [0.5, 0.4], seed: 7 });
  expect(one[0]!.state.r.slice(0, 2)).toEqual([0.5, 0.4]);
  expect(one.slice(1)).toEqual(carom.rack("nineball", table, { seed: 7 }).slice(1));
  const gaps = [1e-5, 1e-4];
  const racks = carom.rack("nineball", table, { gap: gaps, seed: [3, 4] }) as ShotBall[][];
  expect(racks).toEqual(gaps.map((gap, k) => carom.rack("nineball", table, { gap, seed: 3 + k })));
  const places = carom.rack("nineball", table, {
    cueBall: [
      [0.5, 0.4],
      [0.6, 0.4],
    ],
  });
  expect((places as ShotBall[][]).map((rack) => rack[0]!.state.r[0])).toEqual([0.5, 0.6]);
  const shots = carom.shots(table, racks, 2);
  carom.simulateBatch(shots);
  expect(shots.status[0]).toBe(0);
  refuses(
    [() => carom.rack("nineball", table, { gap: gaps, seed: [1, 2, 3] }), "seed: its list has 3"],
    [() => carom.rack("nineball", table, { cueBall: [0.635, 1.905] }), /balls\[\d\]: in the way/],
    [() => carom.rack("nineball", table, { gap: [1e-4, 1] }), "gap 1"],
  );
});

// ---- Events and potted balls

test("first events and potted balls of a shot and of a batch", () => {
  const [hit] = carom.ways(table, layout, { speed: 3 }, { ball: 1, scan: 4000 }).ways;
  const shot = carom.simulate(table, layout, hit!.cue);
  expect(shot.potted()).toEqual([false, true, false]);
  expect([shot.potted(1), shot.potted([1, 0])]).toEqual([true, [true, false]]);
  const first = shot.first("ball_ball", { ball: 1 })!;
  expect(first).toMatchObject({ index: shot.events.indexOf(first.event), other: 0 });
  expect(first.time).toBe(shot.firstContact!.time);
  expect(first.before.v).toEqual([0, 0, 0]);
  expect(shot.first("ball_ball", { ball: 0 })!.before.v).not.toEqual([0, 0, 0]);
  expect(shot.first("ball_pocket", { after: shot.time })).toBeUndefined();
  expect(shot.first("Ball-Ball" as "ball_ball")!.index).toBe(first.index);

  const batch = carom.shots(table, layout, 2, { room: 40 });
  batch.setCue(0, hit!.cue);
  batch.setCue(1, carom.cue({ speed: 0.1, phi: 270 }));
  carom.simulateBatch(batch);
  expect(batch.potted(1)).toEqual([true, false]);
  expect(batch.potted()).toEqual([shot.potted(), [false, false, false]]);
  expect(batch.first("ball_ball", { ball: 1 })).toEqual([first, undefined]);
  const little = carom.shots(table, layout, 1, { room: 2 });
  little.setCue(0, hit!.cue);
  carom.simulateBatch(little);
  expect(little.first("stick_ball")[0]!.index).toBe(0);
  refuses(
    [() => little.first("ball_pocket"), "first() needs all"],
    [() => shot.first("bal_ball" as "ball_ball"), 'did you mean "ball_ball"?'],
    [() => shot.first("ball_pocket", { ball: 3 }), "ball: "],
    [() => shot.potted(3), "ball: "],
  );
});

// ---- Names

test("a misspelt name is quoted and corrected, and synonyms count", () => {
  expect(carom.rack("9-ball" as "nineball", table)).toEqual(carom.rack("nineball", table));
  expect(carom.table("9-foot" as "9ft")).toEqual(table);
  expect(carom.match("9ball" as "nineball", table).game.rules).toBe("nineball");
  const two = [carom.ball(0.6, 0.8), carom.ball(0.75, 1.6)];
  const [top, foot] = ["top-right", "foot-right"].map((pocket) =>
    carom.aim(table, two, {}, { ball: 1, pocket }),
  );
  expect(top).toEqual(foot);
  const snooker = carom.table("snooker");
  expect(carom.rack("BILLIARDS" as "billiards", snooker)).toEqual(carom.rack("billiards", snooker));
  const wrong = (call: () => unknown): string => refusal<CaromError>(call).message;
  expect(wrong(() => carom.rack("nineblal" as "nineball", table))).toMatch(
    /^rack: unknown name "nineblal"; did you mean "nineball"\? Use one of nineball, /,
  );
  expect(wrong(() => carom.player({ fargo: 500, rules: "snoker" as "snooker" }))).toContain(
    'did you mean "snooker"?',
  );
});
