// Whole shots: against the command `carom shoot`, batches, times, lines, and what is refused.
import { readFileSync } from "node:fs";
import { describe, expect, test } from "vitest";
import {
  type BallState,
  type Build,
  type Carom,
  CaromError,
  type EventType,
  fromLine,
  load,
  type Shot,
  toLine,
} from "../dist/index.js";
import { names } from "../dist/generated/layout.js";
import {
  builds,
  carom,
  nineball,
  refusal,
  refuses,
  root,
  run,
  thereIsACommand,
} from "./support.js";

const EVENT_TYPES = names.carom_event_type.slice(1) as unknown as EventType[];
const LABELS = ["stationary", "spinning", "sliding", "rolling", "pocketed", "airborne", "off"];
const flat = (s: BallState) => [LABELS.indexOf(s.label), ...s.r, ...s.v, ...s.w];
const break9 = readFileSync(`${root}data/break-nineball.jsonl`, "utf8").trim();
const layouts = readFileSync(`${root}data/shots-layouts.jsonl`, "utf8").trim().split("\n");
const named = layouts.filter(
  (line) =>
    /"kind": "shot"/.test(line) &&
    /"table": "(pooltool|7ft|8ft|9ft|snooker|threecushion)"/.test(line),
);

function played(carom: Carom, line: string): Shot {
  const { table, balls, cue } = fromLine(carom, line);
  return carom.simulate(table, balls, cue);
}

interface Recorded {
  kind: string;
  status: string;
  final: { t: number; balls: Record<string, number[]> };
  events: [number, string, string[], number[][], number[][]][];
}

function expectFinal(shot: Shot, names: string[], recorded: Recorded): void {
  const { t: time, balls: states } = recorded.final;
  expect(shot.time).toBe(time);
  expect(Object.fromEntries(shot.final.map((state, k) => [names[k], flat(state)]))).toEqual(states);
}

describe.each(builds)("shots by $name", ({ carom, name }) => {
  test.runIf(thereIsACommand)(
    "a shot has one meaning: what is typed to the command is the same stroke",
    () => {
      const typed = (...words: string[]) =>
        fromLine(carom, run(["shoot", "--cue", "0.6,0.8", ...words, "--json"])).cue;
      expect(carom.cue()).toMatchObject({ speed: 2, phi: 90, theta: 0, a: 0, b: 0.25 });
      for (const [words, fields] of [
        [[], {}],
        [
          ["--speed", "3", "--aim", "95", "--tip", "0.2,-0.3"],
          { speed: 3, phi: 95, tip: [0.2, -0.3] },
        ],
        [["--ball-speed", "3", "--tip", "-0.1,0.1"], { ballSpeed: 3, tip: [-0.1, 0.1] }],
      ] as const) {
        const { speed, phi, theta, a, b } = carom.cue(fields);
        expect(typed(...words)).toMatchObject({ speed, phi, theta, a, b });
      }
      refuses(
        [() => carom.cue({ speed: 1, ballSpeed: 1 }), "cue.ballSpeed"],
        [() => carom.cue({ theta: 5, ballSpeed: 1 }), "level cue"],
        [() => carom.cue({ tip: [0, 0], b: 0 }), "cue.tip"],
      );
    },
  );

  test.runIf(thereIsACommand)("the break of data/, event by event: the command's doubles", () => {
    const recorded = run(["shoot", "-"], break9)
      .trim()
      .split("\n")
      .map((line) => JSON.parse(line) as Recorded)
      .find((line) => line.kind === "shot")!;
    const shot = played(carom, break9);
    expect(shot.status).toBe(recorded.status);
    // The file has events of no type before and after the others, as pooltool's have.
    const events = recorded.events.filter(([, type]) => type !== "none");
    expect(shot.count).toBe(events.length);
    shot.events.forEach((event, k) => {
      const [time, type, , incoming, outgoing] = events[k]!;
      expect([event.time, event.type]).toEqual([time, type]);
      expect(event.before.map(flat).slice(0, incoming.length)).toEqual(
        incoming.slice(0, event.before.length),
      );
      expect(event.after.map(flat).slice(0, outgoing.length)).toEqual(
        outgoing.slice(0, event.after.length),
      );
    });
    expectFinal(shot, fromLine(carom, break9).names, recorded);
  });

  test.runIf(thereIsACommand)(
    "lines that are written are read by the command, with the same final states",
    () => {
      const table = carom.table("snooker");
      const balls = carom.rack("snooker", table, { seed: 5 });
      const cue = carom.cue({ speed: 6.5, phi: 88.5, a: 0.3, b: -0.2, theta: 4 }, "snooker");
      const line = toLine({ tableName: "snooker", balls, cue });
      const shot = carom.simulate(table, balls, cue);
      const recorded = JSON.parse(
        run(["shoot", "--events", "none", "-"], line).trim().split("\n").at(-1)!,
      ) as Recorded;
      expect(recorded.status).toBe("ok");
      const read = fromLine(carom, line);
      expectFinal(shot, read.names, recorded);
      expect(read.balls).toEqual(
        balls.map((ball, k) => ({ ...ball, id: k === 0 ? "cue" : String(k) })),
      );
      expect(read.cue).toEqual(cue);
      expect(read.table).toEqual(table);
      expect(toLine(read)).toBe(line);
    },
  );

  test.runIf(thereIsACommand)("a jump over a ball, with the command's doubles", () => {
    const table = carom.table("9ft");
    const balls = [carom.ball(0.635, 0.635), carom.ball(0.635, 0.94)];
    // A light cue: one of 0.567 kg at this elevation would hold the ball down.
    const cue = carom.cue({
      speed: 3.5,
      theta: 45,
      phi: 90,
      b: 0,
      mass: 0.25,
      tipRestitution: 0.85,
      tipTime: 8e-4,
    });
    const shot = carom.simulate(table, balls, cue);
    expect(shot.events.map((event) => event.type)).toContain("slate");
    expect(
      Math.max(...[...Array(50).keys()].map((k) => shot.positions(k / 50)[2]!)),
    ).toBeGreaterThan(0.08);
    // It flies over the ball, and meets it on its way back from the cushion only.
    expect(shot.firstContact!.time).toBeGreaterThan(
      shot.events.find((event) => event.type === "ball_linear_cushion")!.time,
    );
    const recorded = JSON.parse(
      run(["shoot", "--events", "none", "-"], toLine({ tableName: "9ft", balls, cue })),
    ) as Recorded;
    expectFinal(shot, ["cue", "1"], recorded);
    const flat = carom.simulate(table, balls, cue, { space: "flat" });
    expect(flat.firstContact?.ball).toBe(1);
  });

  test("a batch has the bits of single shots", () => {
    const { table, balls } = nineball(carom);
    const batch = carom.shots(table, balls, 7, { room: 300 });
    const cues = [...Array(7).keys()].map((k) =>
      carom.cue({ speed: 2 + k, phi: 88 + k / 2, a: 0.05 * k }),
    );
    cues.forEach((cue, k) => batch.setCue(k, cue));
    expect(carom.simulateBatch(batch, { cushionModel: "han" })).toBe("ok");
    cues.forEach((cue, k) => {
      const single = carom.simulate(table, balls, cue, { cushionModel: "han" });
      const shot = batch.shot(k);
      expect(shot.bytes).toEqual(single.bytes);
      expect(shot.final).toEqual(single.final);
      expect([batch.time(k), batch.events(k), batch.status[k]]).toEqual([
        single.time,
        single.count,
        0,
      ]);
      expect(batch.state(k, 3)).toEqual(single.final[3]);
      expect(shot.states(1.25)).toEqual(single.states(1.25));
    });
    batch.free();
  });

  test("a batch with a layout for each shot; one in error costs itself", () => {
    const table = carom.table("9ft");
    const layout = (x: number) => [carom.ball(0.6, 0.6), carom.ball(x, 1.5)];
    const batch = carom.shots(table, [layout(0.6), layout(-3), layout(0.7)], 3, { room: 64 });
    expect(carom.simulateBatch(batch)).toBe("off_table");
    expect([...batch.status].map((code) => Math.sign(code))).toEqual([0, -1, 0]);
    expect(batch.shot(2).final).toEqual(carom.simulate(table, layout(0.7), {}).final);
  });

  test("positions, states and turns at any time", () => {
    const shot = played(carom, break9);
    const namedShot = played(carom, named[0]!);
    expect([...shot.positions(0)]).toEqual(shot.balls.flatMap((ball) => [...ball.state.r]));
    expect([...shot.positions(1e6)]).toEqual(shot.final.flatMap((state) => [...state.r]));
    expect(namedShot.positions(0.3)).toHaveLength(3 * namedShot.balls.length);
    const event = shot.events.find((event) => event.time > 0 && event.cluster === 0)!;
    const early = shot.states(event.time - 1e-9);
    expect(early[event.a]!.r[0]).toBeCloseTo(event.before[0]!.r[0], 6);
    const times = [0, 0.3, 1.5];
    expect([...shot.positionsAt(times)]).toEqual(
      times.flatMap((time) => [...shot.positions(time)]),
    );
    const turned = shot.orientations(2);
    for (let k = 0; k < shot.balls.length; k++)
      expect(Math.hypot(...turned.subarray(4 * k, 4 * k + 4))).toBeCloseTo(1, 12);
    expect([...shot.orientations(0).subarray(0, 4)]).toEqual([1, 0, 0, 0]);
    // Frames, onward and back, are those of single calls, in the same memory.
    const first = shot.frame(0);
    for (const time of [0.3, 1.5, 0.7, shot.time]) {
      const turned = namedShot.orientations(0.1) && shot.orientations(time);
      const frame = shot.frame(time);
      expect(
        frame.states.buffer === first.states.buffer &&
          frame.states.byteOffset === first.states.byteOffset,
      ).toBe(true);
      expect([...frame.turned]).toEqual([...turned]);
      shot.states(time, true).forEach((state, k) => {
        expect([...frame.states.subarray(10 * k, 10 * k + 9)]).toEqual([
          ...state.r,
          ...state.v,
          ...state.w,
        ]);
        expect(frame.label(k)).toBe(state.label);
      });
    }
    expect(namedShot.frame(0.1).turned).toHaveLength(4 * namedShot.balls.length);
    expect(() => shot.frame(NaN)).toThrow("time NaN");
  });

  test("the first contact, without the rest of the shot", () => {
    const { table, balls } = nineball(carom);
    const contact = carom.firstContact(table, balls, { speed: 8 })!;
    const whole = carom.simulate(table, balls, { speed: 8 }).firstContact!;
    expect(contact).toEqual(whole);
    expect(contact.ball).toBe(1);
    expect(carom.firstContact(table, balls, { speed: 0.1, phi: 180 })).toBeUndefined();
    expect(carom.simulate(table, balls, { speed: 8 }, { stopAt: "contact" }).status).toBe(
      "stopped_at_event",
    );
    const stopped = carom.simulate(table, balls, { speed: 8 }, { timeMost: 1 });
    expect([stopped.status, stopped.time]).toEqual(["stopped_at_time", 1]);
    expect(() => stopped.positions(1.5)).toThrow("time 1.5");
  });

  test("stopped after events of a set: the first of them in the unbroken shot", () => {
    const { table, balls } = nineball(carom);
    const whole = carom.simulate(table, balls, { speed: 8 });
    for (const stopAt of [
      ...EVENT_TYPES,
      [],
      ["ball_pocket", "ball_linear_cushion"],
      ["contact", "ball_linear_cushion"],
    ] as const) {
      const set: readonly string[] = typeof stopAt === "string" ? [stopAt] : stopAt;
      const stopped = carom.simulate(table, balls, { speed: 8 }, { stopAt });
      const first = whole.events.findIndex(
        ({ type, a, b }) =>
          set.includes(type) ||
          (set.includes("contact") && type === "ball_ball" && (a === 0 || b === 0)),
      );
      // The events of a cluster are not parted.
      let end = first + 1;
      while (
        whole.events[first]?.cluster &&
        whole.events[end]!.cluster > 0 &&
        whole.events[end]!.time === whole.events[first]!.time
      )
        end++;
      expect([stopped.status, stopped.count]).toEqual(
        first < 0 ? ["ok", whole.count] : ["stopped_at_event", end],
      );
    }
    expect(() => carom.simulate(table, balls, {}, { stopAt: ["pocket"] as never })).toThrow(
      /^stopAt: unknown name "pocket"; did you mean "ball_pocket"\? Use one of contact, stick_ball, /,
    );
  });

  test("a stopped shot goes on with the bits of the unbroken one", async () => {
    // Without pockets and with little loss there are more events than a new library has room for:
    // it grows while the shot goes on.
    const carom = await load({ build: name as Build });
    const table = carom.table("threecushion");
    const kind = { ...carom.kind("pool"), restitution: 1, restitutionCushion: 1, muSlide: 0.05 };
    const balls = [...Array(24).keys()].map((k) =>
      carom.ball(0.2 + 0.25 * (k % 4), 0.3 + 0.3 * Math.floor(k / 4), kind),
    );
    const options = { space: "flat", friction: "constant", cushionModel: "mirror" } as const;
    const whole = carom.simulate(table, balls, { speed: 20, phi: 77 }, options);
    expect(whole.count).toBeGreaterThan(256);
    let parts = carom.simulate(
      table,
      balls,
      { speed: 20, phi: 77 },
      { ...options, timeMost: 1 / 15 },
    );
    const first = parts;
    for (let frame = 2; parts.status === "stopped_at_time"; frame++) {
      parts = carom.continue(parts, { timeMost: frame / 15 });
      // Another call between two frames, which uses the same memory.
      if (frame % 25 === 0)
        carom.simulate(carom.table("snooker"), [carom.ball(1, 1)], { speed: 1 });
      if (frame < 5) expect(parts.final).toEqual(whole.states(frame / 15));
    }
    expect([parts.status, parts.time, parts.final]).toEqual([
      whole.status,
      whole.time,
      whole.final,
    ]);
    expect(parts.bytes).toEqual(whole.bytes);
    expect(parts.states(1.25)).toEqual(whole.states(1.25));
    expect([first.time, first.status, first.final]).toEqual([
      1 / 15,
      "stopped_at_time",
      whole.states(1 / 15),
    ]);
    // Any of them once more, until the end; by events; and past a bound.
    expect(carom.continue(first).bytes).toEqual(whole.bytes);
    expect(carom.continue(whole)).toBe(whole);
    const rail = carom.continue(first, { stopAt: ["ball_pocket", "ball_linear_cushion"] });
    expect([rail.status, rail.events.at(-1)!.type]).toEqual([
      "stopped_at_event",
      "ball_linear_cushion",
    ]);
    expect(carom.continue(rail).final).toEqual(whole.final);
    const error = refusal<CaromError>(() => carom.continue(first, { eventsMost: 50 }));
    expect([error.status, error.shot!.count]).toEqual(["too_many_events", 50]);
    expect(carom.continue(error.shot!).bytes).toEqual(whole.bytes);
    expect(() => carom.continue(rail, { timeMost: rail.time / 2 })).toThrow(
      /^timeMost: it must be .* not before the time of the shot to continue$/,
    );
    const changed = carom.simulate(table, balls, { speed: 20 }, { timeMost: 0.01 });
    (changed.balls[1]!.kind as { mass: number }).mass *= 1.1;
    refuses(
      [
        () => carom.continue(changed),
        expect.objectContaining({ status: "other_balls", shot: undefined }),
      ],
      [
        () => carom.continue(first, { cushionModel: "han" } as never),
        "cushionModel: there is no such key; there are timeMost, stopAt, firstOf, eventsMost",
      ],
    );
    const batch = carom.shots(table, balls, 1, { room: 64 });
    carom.simulateBatch(batch, { timeMost: 0.01 });
    expect(() => carom.continue(batch.shot(0))).toThrow(
      /^shot: a shot with the status "stopped_at_time", or of a batch, cannot be continued/,
    );
    batch.free();
  });

  test("ball in hand: a free place is taken, and what is in the way of another is named", () => {
    const { table, balls } = nineball(carom);
    balls[0] = { ...balls[0]!, state: { ...balls[0]!.state, label: "pocketed" } };
    const backup = structuredClone(balls);
    const placed = carom.placeBall(table, balls, 0, 0.6, 0.5);
    expect(placed[0]).toEqual(carom.ball(0.6, 0.5));
    expect([placed.slice(1), balls]).toEqual([backup.slice(1), backup]);
    const { r } = balls[4]!.state;
    const [x, y] = table.pockets[0]!.centre;
    for (const [place, status, field] of [
      [[r[0], r[1]], "overlap", /^balls\[4\]$/],
      [[0.01, 1], "off_table", /^table\.rails\[\d+\]$/],
      [[x, y], "off_table", /^table\.(pockets|rails|jaws)\[\d+\]$/],
      [[5, 5], "off_table", /^table$/],
    ] as const) {
      const error = refusal<CaromError>(() => carom.placeBall(table, balls, 0, place[0], place[1]));
      expect(error).toBeInstanceOf(CaromError);
      expect(error.status).toBe(status);
      expect(error.field).toMatch(field);
      expect(error.message).toContain(`at ${place[0]}, ${place[1]} m; a free place is needed`);
    }
    refuses(
      [() => carom.placeBall(table, balls, 10, 0.6, 0.5), "ball: it must be 0 to 9, not 10"],
      [() => carom.placeBall(table, balls, 0, NaN, 0.5), /^ball 0 at NaN, 0.5: /],
    );
  });

  test("a table of one's own: rails, jaws and pockets are kept and checked", () => {
    const table = carom.table("9ft");
    const mine = structuredClone(table);
    mine.rails[0]!.restitution = 0.5;
    carom.checkTable(mine);
    const balls = carom.rack("nineball", mine);
    expect(carom.simulate(mine, balls, { speed: 8 }).count).toBeGreaterThan(20);
    mine.rails.splice(2, 1);
    expect(() => carom.checkTable(mine)).toThrow(CaromError);
    const hexagon = carom.polygon(
      [1, 2, 2, 1, 0, 0].map((x, k) => ({ x, y: [0, 0.5, 1.5, 2, 1.5, 0.5][k]!, mouth: 0.12 })),
    );
    expect([
      hexagon.rails.length,
      hexagon.jaws.length,
      hexagon.pockets.length,
      hexagon.width,
      hexagon.length,
    ]).toEqual([6, 12, 6, 2, 2]);
    expect(carom.simulate(hexagon, [carom.ball(1, 1)], { speed: 3, phi: 20 }).status).toBe("ok");
    expect(carom.table("9ft", { cornerMouth: 0.108 }).jaws[0]!.centre[0]).toBeLessThan(
      carom.table("9ft").jaws[0]!.centre[0],
    );
    refuses(
      [() => carom.table("9ft", { sideMouth: 2 }), /^measures.sideMouth: /],
      [() => carom.table("9ft", { corner: 0.1 } as never), /corner.*cornerMouth/],
      [
        () =>
          carom.polygon([
            { x: 0, y: 0 },
            { x: 1, y: 0, mouth: 3 },
            { x: 0, y: 1 },
          ]),
        /^table\.corners\[0\]: /,
      ],
      [() => carom.polygon([{ x: 0, y: 0, moth: 1 } as never]), /moth.*mouth/],
    );
  });

  test("what is refused", () => {
    const { table, balls } = nineball(carom);
    const faulty = structuredClone(balls) as unknown as {
      kind: { radius: number };
      state: { r: number[] };
    }[];
    faulty[3]!.state.r[0] = NaN;
    refuses(
      [
        () => carom.simulate(table, faulty as never, {}),
        "balls[3].state.r: it must be -1e6 to 1e6, in m, not NaN",
      ],
      [
        () => carom.simulate(table, balls, { a: 0.9, b: 0.9 }),
        /^cue\.a, cue\.b: the tip misses the ball: /,
      ],
    );
    const out = structuredClone(balls) as unknown as { state: { label: string } }[];
    out[3]!.state.label = "pocketed";
    for (const [key, wrong] of [
      ["speed", -1],
      ["phi", Infinity],
      ["theta", 91],
      ["mass", 0],
      ["endMass", NaN],
      ["miscue", 1.1],
      ["tipRestitution", 1.1],
      ["tipTime", 0.02],
      ["ball", 12],
      ["ball", 3],
    ] as const) {
      const calls = [() => carom.simulate(table, out as never, { [key]: wrong })];
      // A strike alone has no layout.
      if (key !== "ball") calls.push(() => carom.strike({ [key]: wrong }, balls[0]!.kind) as never);
      const status = expect.stringContaining(
        `cue_${key.replace(/[A-Z]/, (letter) => `_${letter.toLowerCase()}`)}`,
      );
      for (const call of calls)
        expect(call).toThrow(
          expect.objectContaining({
            field: `cue.${key}`,
            status,
            message: expect.stringMatching(/: it must be /),
          }),
        );
    }
    refuses(
      [() => carom.simulate(table, balls, {}, { timeMost: -1 }), /^timeMost: it must be 0 or more/],
      [
        () => carom.simulate(table, balls, {}, { eventsMost: -1 }),
        /^eventsMost: it must be a whole number, 0 or more, not -1/,
      ],
      [() => carom.simulate(table, balls, { ball: 0.5 }), /^cue.ball: /],
      [() => carom.simulate(table, [], {}), "1 to 32"],
      [
        () => carom.simulate(table, balls, {}, { cushionModel: "wood" as never }),
        'cushionModel: unknown name "wood"; use one of ',
      ],
      [
        () => carom.simulate({ ...table, rails: Array(33).fill(table.rails[0]) }, balls, {}),
        "at most 32",
      ],
    );
    const error = refusal<CaromError>(() =>
      carom.simulate(table, balls, { speed: 8 }, { eventsMost: 10, simultaneous: "pairs" }),
    );
    expect(error).toBeInstanceOf(CaromError);
    expect(error.status).toBe("too_many_events");
    expect(error.shot!.count).toBe(10);
    const none = carom.shots(table, balls, 1);
    carom.simulateBatch(none);
    expect(() => none.shot(0)).toThrow("room");
  });

  test.each([
    ["", "line"],
    ['{"kind": "table"}', "kind"],
    ['{"kind": "shot"}', "table"],
    ['{"kind": "shot", "table": "9ft"}', "balls"],
    [
      '{"kind": "shot", "table": "9ft", "balls": [{"id": "cue", "state": [0, 1]}]}',
      "balls[0].state",
    ],
    [
      '{"kind": "shot", "table": "9ft", "balls": [{"id": "cue", "state": [0, 0.5, 0.5, 0.028575, 0, 0, 0, 0, 0, 0]}], "cue": {"ball": "9"}}',
      "cue.ball",
    ],
    [
      '{"kind": "shot", "table": "9ft", "balls": [{"id": "cue", "state": [0, 0.5, 0.5, 0.028575, 0, 0, 0, 0, 0, 0]}], "cue": {"V0": "x"}}',
      "cue.V0",
    ],
    [
      '{"kind": "shot", "table": "9ft", "balls": [{"id": "cue", "state": [0, 0.5, 0.5, 0.028575, 0, 0, 0, 0, 0, 0]}], "cue": {"V0": 1, "b": 0, "fi": 90}}',
      "cue.fi",
    ],
    [
      '{"kind": "shot", "table": "9ft", "balls": [{"id": "cue", "state": [0, 0.5, 0.5, 0.028575, 0, 0, 0, 0, 0, 0]}], "cue": {"V0": 1}}',
      "cue.b",
    ],
    [
      '{"kind": "shot", "table": "9ft", "balls": [{"id": "cue", "state": [0, 0.5, 0.5, 0.028575, 0, 0, 0, 0, 0, 0], "params": {"u_ss": 0.2}}]}',
      "balls[0].params.u_ss",
    ],
  ])("a line that is wrong: %#", (line, key) => {
    expect(() => fromLine(carom, line)).toThrow(`${key}: `);
  });
});

test("memory stays flat over a hundred thousand calls", () => {
  const { table, balls } = nineball(carom);
  const impact = {
    a: { v: [1.5, 0, 0] as const },
    b: { r: [0.05, 0.02767, 0] as const },
    muBall: 0.06,
  };
  const cycle = (calls: number) => {
    for (let k = 0; k < calls; k++) {
      carom.collide(impact);
      if (k % 5000 === 0) {
        carom.simulate(table, balls, { speed: 8 }, { cushionModel: "han" });
        carom.trace(impact, 50);
        const batch = carom.collisions(1000);
        carom.collideBatch(batch);
        batch.free();
        const shots = carom.shots(table, balls, 10, { room: 100 });
        carom.simulateBatch(shots, { cushionModel: "mirror", timeMost: 0.2 });
        shots.free();
      }
    }
  };
  cycle(10_000);
  const bytes = carom.memoryBytes;
  // A byte a call would be another page of memory.
  cycle(100_000);
  expect(carom.memoryBytes).toBe(bytes);
});

test.each(builds)("pocketed balls fall where they are drawn, by $name", ({ carom }) => {
  const table = carom.table("7ft");
  const shots = Array.from({ length: 20 }, (_, seed) =>
    carom.simulate(table, carom.rack("nineball", table, { seed }), { speed: 9 }),
  );
  const shot = shots.find(({ events }) => events.some(({ type }) => type === "ball_pocket"))!;
  const {
    time,
    a,
    before: incoming,
    after: outgoing,
  } = shot.events.find(({ type }) => type === "ball_pocket")!;
  const heights = [0, 0.02, 0.04, 0.06].map((later) => shot.states(time + later, true)[a]!.r[2]);
  heights.forEach((height, k) =>
    expect(height).toBeCloseTo(incoming[0]!.r[2] - 0.5 * 9.81 * (0.02 * k) ** 2, 3),
  );
  // it lies where its fall ends, at the depth of its pocket
  const lies = shot.states(time + 1, true)[a]!;
  expect(lies.r[2]).toBeCloseTo(outgoing[0]!.r[2], 12);
  expect({ ...lies, r: outgoing[0]!.r }).toEqual(outgoing[0]);
  expect(shot.states(time + 2, true)[a]).toEqual(lies);
  expect(shot.positionsAt([time + 0.04], true)[3 * a + 2]).toBe(heights[2]);
  expect(shot.states(time + 0.04)[a]).toEqual(outgoing[0]);
});
