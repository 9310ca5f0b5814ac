// The 204 reference collisions, cushions, and what is refused.
import { readFileSync } from "node:fs";
import { describe, expect, test } from "vitest";
import {
  CaromError,
  type CushionImpact,
  type Impact,
  load,
  toLine,
  type Vec3,
} from "../dist/index.js";
import {
  builds,
  carom,
  cases,
  csv,
  references,
  refusal,
  refuses,
  root,
  run,
  thereIsACommand,
} from "./support.js";

const { ids, rows } = cases();
const R = (k: number) => rows[26 * k + 9]!;

/** The largest deviation over the fastest of the twelve numbers, spins times the radius. */
function deviation(out: Float64Array, reference: Float64Array, k: number): number {
  let fastest = 0;
  let apart = 0;
  for (let c = 0; c < 12; c++) {
    const unit = c % 6 < 3 ? 1 : R(k);
    fastest = Math.max(fastest, Math.abs(reference[12 * k + c]!) * unit);
    apart = Math.max(apart, Math.abs(out[12 * k + c]! - reference[12 * k + c]!) * unit);
  }
  return apart / fastest;
}

function impactOf(row: Float64Array): Impact {
  const vector = (k: number): Vec3 => [row[k]!, row[k + 1]!, row[k + 2]!];
  const ball = (k: number) => ({
    r: vector(k),
    v: vector(k + 3),
    w: vector(k + 6),
    radius: row[k + 9]!,
    mass: row[k + 10]!,
    muSlide: row[k + 11]!,
  });
  return { a: ball(0), b: ball(12), muBall: row[24]!, restitution: row[25]! };
}

describe.each(builds)("collisions by $name", ({ carom }) => {
  test.each([
    ["paper", "reference-exact-paper.csv"],
    ["pooltool", "reference-exact-pooltool.csv"],
  ] as const)("the exact limit of 204 cases, slip %s", (slip, file) => {
    const reference = references(file);
    const batch = carom.collisions(ids.length);
    batch.in.set(rows);
    expect(carom.collideBatch(batch, { slip })).toBe("ok");
    const out = batch.out.slice();
    const errors = ids.map((_, k) => deviation(out, reference, k)).sort((a, b) => a - b);
    expect(errors.at(-1)).toBeLessThan(1e-6);
    expect(errors[102]).toBeLessThan(5e-9);
    // A row of a batch has the bits of a single call.
    ids.forEach((_, k) => {
      const single = carom.collide(impactOf(rows.subarray(26 * k, 26 * k + 26)), { slip });
      expect([...single.a.v, ...single.a.w, ...single.b.v, ...single.b.w]).toEqual([
        ...out.subarray(12 * k, 12 * k + 12),
      ]);
    });
    batch.free();
  });

  test("pooltool's bits by 1000 Euler steps, and those of the JavaScript port of base", () => {
    const reference = references("reference-pooltool-n1000.csv");
    const batch = carom.collisions(ids.length);
    batch.in.set(rows);
    expect(carom.collideBatch(batch, { solver: "euler", slip: "pooltool" })).toBe("ok");
    expect([...batch.out]).toEqual([...reference]);
    batch.free();
  });

  test("details and traces agree with the result", () => {
    const impact = impactOf(rows.subarray(0, 26));
    const { detail, a } = carom.collideDetail(impact);
    expect(detail.work).toBeCloseTo((1 + 0.95 ** 2) * detail.workCompression, 9);
    const points = carom.trace(impact, 21);
    expect(points).toHaveLength(21);
    expect(points[0]!.normal).toBe(0);
    expect(points[20]!.normal).toBeCloseTo(detail.normal, 6);
    expect(points[20]!.state.a.v[0]).toBeCloseTo(a.v[0], 5);
    expect(points[0]!.vN).toBeLessThan(0);
    expect(points[20]!.vN).toBeGreaterThan(0);
    expect(points.map((point) => point.phase)).toEqual(points.map((point) => point.phase).sort());
  });

  test("defaults: Alciatore's friction, a pool ball", () => {
    const rolls: Impact = {
      a: { v: [1.5, 0, 0], w: [0, 1.5 / 0.028575, 0] },
      b: { r: [0.866 * 0.05715, 0.5 * 0.05715, 0] },
    };
    const mu = carom.muBall(rolls);
    const slip = Math.hypot(1.5 * 0.5, 1.5 * Math.hypot(0.866, 0.5) * 0.866);
    expect(mu).toBeCloseTo(0.009951 + 0.108 * Math.exp(-1.088 * slip), 3);
    expect(carom.collide(rolls)).toEqual(carom.collide({ ...rolls, muBall: mu }));
    const rolling = carom.rollingVelocity(carom.collide(rolls).a, 0.028575);
    expect((Math.atan2(-rolling[1], rolling[0]) * 180) / Math.PI).toBeCloseTo(33.49, 1);
  });

  test("balls that part keep their motion", () => {
    const out = carom.collide({ a: { v: [-1, 0, 0] }, b: { r: [0.05715, 0, 0] } });
    expect(out.status).toBe("separating");
    expect(out.a.v).toEqual([-1, 0, 0]);
  });

  test.runIf(thereIsACommand)("cushions: the command's doubles, by four models", () => {
    const table = csv("cushion-stronge.csv");
    const number = (row: Record<string, string>, key: string) => Number(row[key]);
    for (const model of ["mathavan", "stronge", "han", "mirror"] as const) {
      const [head, ...lines] = run([
        "resolve",
        "--cushion",
        "--model",
        model,
        `${new URL("../../../data/cushion-stronge.csv", import.meta.url).pathname}`,
      ])
        .trim()
        .split("\n");
      const columns = head!.split(",");
      expect(lines).toHaveLength(table.length);
      lines.forEach((line, k) => {
        const row = table[k]!;
        const impact: CushionImpact = {
          v: [number(row, "vx"), number(row, "vy"), number(row, "vz")],
          w: [number(row, "wx"), number(row, "wy"), number(row, "wz")],
          normal: [number(row, "nx"), number(row, "ny")],
          height: number(row, "h"),
          radius: number(row, "R"),
          mass: number(row, "M"),
          muSlide: number(row, "mu_s"),
          muCushion: number(row, "mu_w"),
          restitution: number(row, "e"),
          jawRadius: number(row, "rho"),
        };
        const out = carom.cushion(impact, { model });
        const cells = line.split(",");
        const expected = ["vx", "vy", "vz", "wx", "wy", "wz"].map((column) =>
          Number(cells[columns.indexOf(column)]),
        );
        expect([...out.v, ...out.w]).toEqual(expected);
      });
    }
  });
});

describe("what is refused", () => {
  const good: Impact = { a: { v: [1, 0, 0] }, b: { r: [0.05715, 0, 0] } };
  test.each([
    [{ ...good, a: { v: [NaN, 0, 0] } }, "bad_velocity", "a.v[0]"],
    [{ ...good, a: { v: [1, 0, 0], radius: 0 } }, "bad_radius", "a.radius"],
    [{ ...good, b: { ...good.b, mass: -1 } }, "bad_mass", "b.mass"],
    [{ ...good, restitution: 1.5 }, "bad_restitution", "restitution"],
    [{ ...good, muBall: 2 }, "bad_mu_ball", "mu_ball"],
  ] as [Impact, string, string][])("a collision: %#", (impact, status, field) => {
    const error = refusal<CaromError>(() => carom.collide(impact));
    expect(error).toBeInstanceOf(CaromError);
    expect([error.status, error.field]).toEqual([status, field]);
    expect(error.message).toMatch(new RegExp(`^${field.replace(/[[\].]/g, "\\$&")}: .{10,}`));
  });

  test("a bad row of a batch costs itself", () => {
    const batch = carom.collisions(100);
    for (let k = 0; k < 100; k++) batch.set(k, good);
    batch.in[26 * 50 + 9] = -1;
    expect(carom.collideBatch(batch)).toBe("bad_radius");
    expect([...batch.status].filter((status) => status !== 0)).toEqual([-8]);
    expect(batch.get(50).a.v).toEqual([NaN, NaN, NaN]);
    expect(batch.get(51)).toEqual(carom.collide(good));
    batch.free();
    refuses([() => batch.in, "freed"], [() => carom.collideBatch(batch), "freed"]);
  });

  test("words, shapes, fields and sizes that are not there", () => {
    refuses(
      [
        () => carom.collide(good, { solver: "magic" as never }),
        'solver: unknown name "magic"; use one of exact, euler',
      ],
      [() => carom.collide(good, { steps: -1 }), "steps: it must be a whole number"],
      [
        () => carom.collide({ ...good, a: { v: [1, 0] as never } }),
        "a.v: it must be 3 numbers, not [1,0]",
      ],
      [() => carom.cushion({ v: [1, 0, 0], normal: [0, 0] }), "normal"],
      [
        () => carom.cushion({ v: [1, 0, 0], normal: [1, 0] }, { model: "wood" as never }),
        'model: unknown name "wood"; use one of mathavan, stronge, han, mirror, euler, smooth',
      ],
      [() => carom.trace(good, 1), "at least 2"],
      [() => carom.collisions(-1), "0 or more"],
      [() => carom.collisions(2).set(2, good), "k: it must be 0 to 1"],
      [() => carom.table("13ft" as never), "7ft, 8ft, 9ft"],
      [() => carom.rack("golf" as never, carom.table("9ft")), "nineball"],
      [() => carom.kind("golf" as never), 'game: unknown name "golf"; use one of'],
      [() => carom.rack("nineball", carom.table("9ft"), { gap: -1 }), CaromError],
      [() => carom.rack("nineball", carom.table("9ft"), { seed: 0.5 }), "seed"],
    );
  });

  // Every object that a call takes, with one key that it does not have: unknown_keys.txt.
  const table = carom.table("9ft");
  const ball = carom.ball(0.6, 0.6);
  const cue = carom.cue();
  const v = [1, 0, 0] as const;
  const motion = { v, w: [0, 0, 0] } as const;
  const wall = { v, normal: [1, 0] } as const;
  /** Arguments that are right, of the methods of the library and of what it makes. */
  const right: Record<string, readonly unknown[]> = {
    collide: [good, {}],
    collideDetail: [good, {}],
    trace: [good, 3, {}],
    collideBatch: [carom.collisions(1), {}],
    set: [good],
    muBall: [good],
    rollingVelocity: [motion, 0.03],
    cushion: [wall, {}],
    rack: ["nineball", table, {}],
    checkTable: [table],
    ball: [0.5, 0.5, ball.kind],
    cue: [{}],
    strike: [{}, ball.kind],
    simulate: [table, [ball, ball], {}, {}],
    firstContact: [table, [ball], {}, {}],
    continue: [carom.simulate(table, [ball]), {}],
    aim: [table, [ball, carom.ball(0.6, 1.2)], {}, { ball: 1 }],
    ways: [table, [ball], {}, {}],
    why: [table, [ball], { kind: "pot" }, {}],
    breaks: ["nineball", table, [ball], {}],
    practice: ["", undefined, {}],
    placeBall: [table, [ball], 0, 0.5, 0.5],
    shots: [table, [ball], 1, {}],
    setCue: [cue],
    simulateBatch: [carom.shots(table, [ball], 1), {}],
    toLine: [{ table: "9ft", balls: [ball], cue }],
  };
  const calls: Record<string, (...args: never[]) => unknown> = {
    set: (impact: Impact) => carom.collisions(1).set(0, impact),
    setCue: (struck: typeof cue) => carom.shots(table, [ball], 1).setCue(0, struck),
    toLine,
  };
  /** A copy that has one more key at the end of a path. */
  function spoilt(value: unknown, [step, ...path]: string[], key: string): unknown {
    if (step === undefined) return { ...(value as object), [key]: 1 };
    const copy = (Array.isArray(value) ? [...value] : { ...(value as object) }) as Record<
      string,
      unknown
    >;
    copy[step] = spoilt(copy[step], path, key);
    return copy;
  }
  const keys = readFileSync(`${root}web/npm/test/unknown_keys.txt`, "utf8");
  test.each(keys.split("\n").flatMap((line) => (/^\w/.test(line) ? [line.split(/ +/)] : [])))(
    "an unknown key of %s %s: %s",
    (method, path, told, better) => {
      const wrong = spoilt(right[method!], path!.split("."), told!.split(".").at(-1)!);
      const library = (method! in calls ? calls : carom) as typeof calls;
      const { message } = refusal(() => library[method!]!(...(wrong as never[])));
      const end = better === undefined ? "; there are " : `; did you mean "${better}"?`;
      expect(message.startsWith(`${told}: there is no such key${end}`), message).toBe(true);
    },
  );

  test("an unknown key of load(), and keys that are missing", async () => {
    await expect(load({ bild: "plain" } as never)).rejects.toThrow(
      'bild: there is no such key; did you mean "build"?',
    );
    // What is missing is neither that of the call before, nor undefined.
    expect(carom.cue({ speed: undefined })).toEqual(cue);
    const kind: Partial<typeof ball.kind> = { ...ball.kind };
    delete kind.mass;
    refuses(
      [
        () => carom.simulate(table, [{ ...ball, kind }] as never),
        "balls[0].kind.mass: it must be a number, not undefined",
      ],
      [
        () => carom.cushion({ normal: [1, 0] } as never),
        "impact.v: it must be 3 numbers, not undefined",
      ],
      [
        () => carom.collide({ a: { v: [1, 0, 0] } } as never),
        "b: an object is needed, not undefined",
      ],
    );
  });
});
