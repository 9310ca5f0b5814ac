// Recordings: a game recorded, replayed and verified by the command, and what is refused.
import { expect, test } from "vitest";
import {
  type Carom,
  CaromError,
  type Cue,
  type GameState,
  type Match,
  type ShotBall,
} from "../dist/index.js";
import { builds, carom, refuses, root, run, thereIsACommand } from "./support.js";

const STRONGE = { cushionModel: "stronge" } as const;
function aGame(carom: Carom): Match {
  const table = carom.table("9ft");
  const game = carom.match("nineball", table, {
    balls: carom.rack("nineball", table),
    shot: STRONGE,
  });
  expect(game.stroke({ speed: 8, phi: 90.2 }, { timeMost: 0.5 })).toBe(false);
  expect(game.continue()).toBe(true);
  if (game.phase === "place") game.place(0.6, 0.5);
  expect(game.stroke({ speed: 2.5, phi: 70 })).toBe(true);
  return game;
}

test.each(builds)("a game is replayed with the same bits, by $name", ({ carom }) => {
  const game = aGame(carom);
  const { final } = game.shot!;
  const text = game.end();
  const shots = [...carom.replay(text)];
  expect(shots.map(({ shot, same, continues }) => [shot, same, continues])).toEqual([
    [1, true, false],
    [2, true, true],
    [3, true, false],
  ]);
  expect(shots[2]!.final).toEqual(final);
  // The film of each shot; that of the one that continues has the whole shot.
  const whole = carom.simulate(shots[0]!.table, shots[0]!.balls, shots[0]!.cue, STRONGE);
  expect(shots.map(({ film }) => film.time)).toEqual([0.5, whole.time, shots[2]!.played.time]);
  expect(shots[1]!.film.events).toEqual(whole.events);
  expect(shots[0]!.film.events).toEqual(whole.events.filter(({ time }) => time <= 0.5));
  expect(shots[1]!.film.positions(0.7)).toEqual(whole.positions(0.7));
  // As simulate() plays them.
  const third = shots[2]!;
  const replay = carom.simulate(third.table, third.balls, third.cue, STRONGE);
  expect([replay.time, replay.count, replay.final]).toEqual([
    third.played.time,
    third.played.events,
    third.final,
  ]);
  if (thereIsACommand) expect(run(["verify", "-"], text)).toContain("3 shots, every bit agrees");
});

test.runIf(thereIsACommand)("what the command records is replayed here", () => {
  const text = run(["record", `${root}data/shots-pooltool.jsonl`]);
  for (const { carom } of builds)
    expect([...carom.replay(text)].filter(({ same }) => same).length).toBe(30);
});

test("a forged stroke, damage and other revisions are told", () => {
  const text = aGame(carom).end();
  expect(
    [...carom.replay(text.replace('"speed":2.5', '"speed":2.6'))].map(({ same }) => same),
  ).toEqual([true, true, false]);
  const refused = (damaged: string, message: RegExp) => {
    refuses(
      [() => [...carom.replay(damaged)], CaromError],
      [() => [...carom.replay(damaged)], message],
    );
  };
  refused(text.replace('"phi"', '"phy"'), /line 6: shot.phy is not a key of the format/);
  refused(text.replace('"revision":', '"revision":9'), /line 1: the recording is of revision 9/);
  refused(text.split("\n").slice(0, -2).join("\n"), /cut off/);
});

test.each(builds)("a match refuses, rules and is judged again, by $name", ({ carom }) => {
  const match = carom.match("eightball", carom.table("9ft"), { seed: 7, side: 1 });
  const begun = match.lines;
  const { bounds } = match;
  expect([match.phase, match.side, bounds?.high[1]]).toEqual(["place", 1, match.table.length / 4]);
  for (const [act, message] of [
    [() => match.place(0.6, 1), /place: .*0\.635/],
    [
      () => match.stroke({ speed: 9 }),
      "stroke: the cue ball is in hand: place it within match.bounds first",
    ],
    [() => match.call(16), /call: ball 16 .* may: 1, 2/],
    [() => match.choose("pass"), /choose: the choices are: none/],
    [() => match.continue(), "continue: no ball moves: play a stroke"],
  ] as const)
    expect(act).toThrow(message);
  expect(match.lines).toEqual(begun);

  // A stroke while balls move is refused; one that goes on is ruled.
  match.place(0.6, 0.6);
  expect(match.stroke({ speed: 1.5, phi: 90 }, { timeMost: 0.3 })).toBe(false);
  expect([match.phase, match.ruling, match.shot?.time]).toEqual(["moving", undefined, 0.3]);
  expect(() => match.stroke({ speed: 9 })).toThrow("balls move: continue the shot");

  // A match that was read while balls move has its shot, and goes on with all events.
  const half = carom.match();
  for (const line of match.lines) half.read(line);
  const moving = half.shot!;
  expect(moving.events).toEqual(match.shot!.events);
  expect(match.continue() && half.continue()).toBe(true);
  for (const { events } of [half.shot!, carom.continue(moving)])
    expect(events).toEqual(match.shot!.events);
  expect([match.side, match.may]).toEqual([0, expect.arrayContaining(["rack", "other_rack"])]);
  expect(match.ruling?.facts.first[0]).toBe(match.shot?.firstContact?.ball);
  const { length } = match.lines;
  match.choose("other_rack");
  expect([match.side, match.game.opening]).toEqual([1, true]);

  // Another program reads it, cut off behind the shot, and the rest of it; then it takes an act.
  const { lines } = match;
  const copy = carom.match();
  const shot = lines.findIndex((line) => line.startsWith('{"continue"'));
  for (const line of lines.slice(0, shot + 1)) copy.read(line);
  expect(copy.lines).toEqual(lines.slice(0, length));
  for (const line of lines.slice(shot + 1)) copy.read(line);
  copy.concede(0);
  for (const line of copy.lines.slice(lines.length)) match.read(line);
  expect([match.winner, match.lines]).toEqual([1, copy.lines]);
  const forged = carom.match();
  expect(() =>
    lines.forEach((line) => forged.read(line.replace('"player":1', '"player":0'))),
  ).toThrow(CaromError);
  if (thereIsACommand) expect(run(["verify", "-"], match.end())).toContain("player 2 has won");
});

test.each(builds)("a match with equal innings is drawn, by $name", ({ carom }) => {
  const table = carom.table("threecushion");
  const game: GameState = {
    rules: "straightrail",
    group: "open",
    opening: false,
    target: 1,
    innings: 1,
  };
  const match = carom.match(game, table, { seed: 1 });
  const player = carom.player({ errors: 0 });
  const play = () => match.take(match.plan({ shots: 100, player })[0]!);
  play();
  expect([match.phase, match.side, match.game.innings]).toEqual(["stroke", 1, 3]);
  expect([match.drawn, match.winner]).toEqual([false, undefined]);
  play();
  expect([match.phase, match.drawn, match.winner]).toEqual(["over", true, undefined]);
  expect(match.ruling?.turn).toBe("draw");
  if (thereIsACommand) expect(run(["verify", "-"], match.end())).toContain("the match is drawn");
});

test.each(builds)("partners, a set, limits and time, by $name", ({ carom }) => {
  const match = carom.match("straight", carom.table("9ft"), {
    seats: ["Ann", { name: "Bo", handicap: 15, rating: 600 }, "Cy", "Di"],
    alternate: true,
    limits: { speed: 12, ownCue: 1, tip: 0 },
    set: { race: 2, order: "winner", clock: 30, extensions: 1 },
  });
  expect(match.seats.map(({ name, side }) => name + side)).toEqual(["Ann0", "Bo1", "Cy0", "Di1"]);
  expect([match.seats[1]!.rating, match.limits.tip]).toEqual([600, 0]);
  expect(match.standing).toEqual({
    sides: [0, 1, 0, 1],
    points: [0, 15],
    won: [0, 0],
    setWinner: undefined,
  });
  expect(match.words).toBe("Ann (seat 0): a position of the cue ball in hand, or a choice");
  match.place(0.6, 0.6);
  match.extend();
  refuses(
    [() => match.stroke({ speed: 12.5 }), "stroke: cue.speed must be at most 12 m/s in this match"],
    [() => match.stroke({ mass: 0.5 }), "stroke: stick and tip must be the same as for seat 0"],
    [() => match.extend(), "extend: none is left"],
    [() => match.timeout(), "timeout: none is left"],
    [() => match.next(), "next: no match has been won"],
    [() => match.clock(2), "clock: seat 0 is at the table"],
  );
  match.stroke({ phi: 200, speed: 1 });
  expect([match.seat, match.side]).toEqual([1, 1]);
  match.concede(3);
  expect([match.winner, match.words]).toEqual([0, "Ann (seat 0) and Cy (seat 2) have won"]);
  match.next();
  expect([match.set?.number, match.set?.won, match.set?.order]).toEqual([2, [1, 0], "winner"]);
  match.concede();
  match.next();
  match.concede(0);
  expect([match.standing.setWinner, match.standing.won]).toEqual([1, [1, 2]]);
  const replay = carom.match();
  for (const line of match.lines) replay.read(line);
  expect(replay.lines).toEqual(match.lines);
});

test("beginnings that are refused", () => {
  const begin = (options: object) => () => carom.match("eightball", carom.table("9ft"), options);
  refuses(
    [begin({ seats: 1 }), "seats: 1 seats cannot play this game"],
    [begin({ seats: [{ nam: "Ann" }, "Bo"] }), "seats[0].nam: there is no such key"],
    [begin({ seats: [{ side: 1 }, { side: 3 }] }), "begin: seats: side must be 0, 1 and so on"],
    [begin({ seats: [{ side: "a" }, "Bo"] }), 'seats[0].side: a number is needed, not "a"'],
    [begin({ limits: { speeds: 1 } }), "limits.speeds: there is no such key"],
    [begin({ set: { race: 1001 } }), "begin: set.race must be 1 to 1000"],
    [
      begin({ set: { race: 1, order: "loosers" } }),
      'set.order: unknown name "loosers"; did you mean "loser"? Use one of alternate',
    ],
  );
});

test.each(builds)("a peer sends its own acts alone, by $name", ({ carom }) => {
  const ann = carom.match("eightball", carom.table("9ft"), { seed: 7 });
  const bob = carom.match();
  for (const line of ann.lines) bob.read(line);
  for (const act of [() => ann.place(0.6, 0.6), () => ann.stroke({ speed: 9, phi: 90.2 })]) {
    const known = ann.lines.length;
    act();
    const sent = ann.lines.slice(known);
    const { lines } = bob;
    refuses(
      [() => bob.receive(sent[0]!, 1), "seat 1 has sent an act of seat 0"],
      [() => bob.receive(sent[0]!.replace("0.6", "0.7").replace("90.2", "90.3"), 0), CaromError],
    );
    expect(bob.lines).toEqual(lines);
    expect(["", ...sent].map((line) => bob.receive(line, 0))).toEqual([
      false,
      true,
      ...sent.slice(1).map(() => false),
    ]);
    expect(bob.lines).toEqual(ann.lines);
  }
  expect(bob.shot!.events).toEqual(ann.shot!.events);

  // Acts are undone and done again.
  const { lines } = ann;
  const twin = ann.copy();
  expect([ann.undo(), ann.phase, ann.undo(), ann.phase, ann.undo()]).toEqual([
    true,
    "stroke",
    true,
    "place",
    false,
  ]);
  expect([ann.redo(), ann.redo(), ann.redo(), ann.lines]).toEqual([true, true, false, lines]);
  expect([twin.undo(), twin.undo()]).toEqual([true, true]);
  twin.place(0.5, 0.5);
  expect([twin.redo(), twin.balls[0]!.state.r[0], ann.lines]).toEqual([false, 0.5, lines]);
});

test("a game is planned with its own cue", () => {
  for (const [game, name] of [
    ["nineball", "9ft"],
    ["snooker", "snooker"],
    ["threecushion", "threecushion"],
    ["fourball", "fourball"],
  ] as const) {
    const table = carom.table(name);
    const match = carom.match(game, table, { seed: 1, side: 1, seats: ["", { rating: 500 }] });
    const [best] = match.plan({ shots: 100, best: 1 });
    const stick = ({ mass, endMass, tipRadius }: Cue) => [mass, endMass, tipRadius];
    expect(stick(best!.cue), game).toEqual(stick(match.seats[1]!.cue));
    match.prepare(best!);
    expect(match.phase, game).toBe("stroke");
    expect(match.take(best!, undefined, { timeMost: 1e-3 }), game).toBe(false);
    expect([match.phase, match.shot!.time, match.shot!.cue], game).toEqual([
      "moving",
      1e-3,
      best!.cue,
    ]);
    match.free();
  }
  expect(carom.match("snooker", carom.table("snooker")).cue.mass).toBe(0.478);
});

test.each(builds)("in pyramid a plan strikes the ball that wins most, by $name", ({ carom }) => {
  const table = carom.table("pyramid");
  const rack = carom.rack("pyramid", table);
  const begun = carom.match("pyramid", table, { seed: 1 });
  expect(begun.strikable).toEqual([0]);
  // The 2 lies before a corner, and the 1 behind it in line; the yellow is far from both.
  const balls = rack.map(({ kind, state }, k) => {
    const places = [
      [0.9, 3.3],
      [0.4, 0.4],
      [0.12, 0.12],
    ];
    const [x = 0, y = 0] = places[k] ?? [];
    if (k > 2) return { kind, state: { ...state, label: "pocketed" as const } };
    return { kind, state: { ...state, r: [x, y, kind.radius] as const } };
  });
  const match = carom.match({ rules: "pyramid", group: "open", opening: false }, table, { balls });
  expect(match.strikable).toEqual([0, 1, 2]);
  const [best] = match.plan({ shots: 1000, best: 1 });
  expect([best!.cue.ball, best!.ball]).toEqual([1, 2]);
  const [advice] = carom.plan(table, balls, {
    ...match.game,
    cue: { ball: 0 },
    shots: 100,
    best: 1,
  });
  expect(advice!.cue.ball).toBe(0);
  match.take(best!);
  expect([match.side, match.strikable]).toEqual([0, [0, 1]]);
});

test.each(builds)("plans of a match are by its rules, by $name", ({ carom }) => {
  // The 1 hangs in a corner behind the head string, where the cue ball is placed too.
  const table = carom.table("9ft");
  const rack = carom.rack("eightball", table);
  const balls = rack.map(({ kind, state }, k) => {
    const places = [
      [0.6, 0.3],
      [0.06, 0.06],
      [0.9, 2.0],
    ];
    const [x, y] = places[k] ?? [0, 0];
    const label = k < places.length ? "stationary" : "pocketed";
    return { kind, state: { ...state, label, r: [x!, y!, state.r[2]] } } as ShotBall;
  });
  const match = carom.match("straight", table, { balls, hand: "kitchen" });
  match.place(0.6, 0.3);
  const options = { shots: 300, best: 1 };
  const [free] = carom.plan(table, match.balls, { ...match.game, ...options });
  const [best] = match.plan(options);
  expect([free!.ball, free!.kind]).toEqual([1, "pot"]);
  expect([best!.ball, best!.kind]).not.toEqual([1, "pot"]);
  match.take(best!);
  expect([match.ruling!.foul, match.ruling!.turn]).toEqual([false, "keep"]);

  // A player passes without placing the cue ball, and plans end with the match.
  const snooker = carom.table("snooker");
  const frame = carom.match(
    { rules: "snooker", group: "open", opening: false, may: ["pass", "place"], score: [4, 0] },
    snooker,
    { balls: carom.rack("snooker", snooker), hand: "d" },
  );
  const { length } = frame.lines;
  frame.take({ ...best!, kind: "pass", place: [NaN, NaN] });
  expect([frame.side, frame.phase, frame.hand]).toEqual([1, "place", "d"]);
  expect(frame.lines[length]).toMatch(/^{"act"/);
  refuses(
    [() => frame.call("2" as unknown as number), 'ball: it must be a whole number, not "2"'],
    [() => frame.concede(2), "concede: the seat must be one that plays"],
  );
  frame.concede(0);
  expect(() => frame.plan()).toThrow("the match is over");
});

test("a match that is read again has the bounds of a scratch, and nothing behind its end", () => {
  const table = carom.table("9ft");
  let match: Match;
  let phi = 84;
  do {
    match = carom.match("straight", table, { balls: carom.rack("eightball", table, { seed: 5 }) });
    match.stroke({ speed: 9, phi: (phi += 0.1) });
  } while (match.hand !== "kitchen" && phi < 96);
  const replay = carom.match();
  for (const line of match.lines) replay.read(line);
  expect([replay.hand, replay.phase, replay.side]).toEqual(["kitchen", "place", match.side]);
  expect(replay.bounds).toEqual(match.bounds);
  const beyond = table.length / 4 + 1e-3;
  expect(() => replay.place(0.6, beyond)).toThrow(/place: .*0\.635/);
  expect(replay.plan({ shots: 100, best: 1 })[0]!.place[1]).toBeLessThan(beyond);

  const { lines } = match;
  const text = match.end();
  expect(() => match.stroke({ speed: 1 })).toThrow("freed");
  replay.read(text.trimEnd().split("\n").at(-1)!);
  refuses(
    [() => replay.stroke({ speed: 1 }), /is over/],
    [() => replay.read(lines.at(-1)!), CaromError],
  );
});

test("a plan is told where the cue ball in hand may be put", () => {
  const table = carom.table("9ft");
  const balls = carom.rack("eightball", table);
  const place = (inHand: "kitchen" | "anywhere") =>
    carom.plan(table, balls, { rules: "straight", inHand, shots: 100, best: 1 })[0]!.place[1]!;
  expect(place("kitchen")).toBeLessThanOrEqual(table.length / 4);
  expect(() => place(true as never)).toThrow(/inHand: .*"anywhere", "kitchen", "d", "baulk"/);
});

test("a match of another layout and state", () => {
  const table = carom.table("snooker");
  const game = { rules: "snooker", group: "open", opening: false, score: [30, 10] } as const;
  const balls = carom.rack("snooker", table);
  const match = carom.match(game, table, { balls, hand: "d", shot: { cushionModel: "han" } });
  expect(match.bounds?.radius).toBeCloseTo(0.292, 3);
  const { place } = match.plan({ shots: 100, best: 1 })[0]!;
  match.place(place[0]!, place[1]!);
  expect([match.game.score, match.on.length, match.phase]).toEqual([[30, 10], 15, "stroke"]);
  expect(() => carom.match("eightball", table, { seeds: 1 } as object)).toThrow(/seeds/);
});
