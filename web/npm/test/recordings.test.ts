// Recordings: a game recorded, replayed and verified by the command, and what is refused.
import { expect, test } from "vitest";
import { type Carom, CaromError, type Recording } from "../dist/index.js";
import { builds, root, run, thereIsACommand } from "./support.js";

function aGame(carom: Carom): Recording {
  const table = carom.table("9ft");
  const game = carom.record(table, carom.rack("nineball", table), { cushionModel: "stronge" });
  expect(game.shoot({ speed: 8, phi: 90.2 }, { timeMost: 0.5 }).status).toBe("stopped_at_time");
  expect(game.continue().status).toBe("ok");
  game.place(0, 0.6, 0.5);
  expect(game.shoot({ speed: 2.5, phi: 70 }).status).toBe("ok");
  return game;
}

test.each(builds)("a game is replayed with the same bits, by $name", ({ carom }) => {
  const game = aGame(carom);
  const { balls } = game;
  const text = game.end();
  const shots = [...carom.replay(text)];
  expect(shots.map(({ shot, same, continues }) => [shot, same, continues])).toEqual([
    [1, true, false],
    [2, true, true],
    [3, true, false],
  ]);
  expect(shots[2]!.final).toEqual(balls.map(({ state }) => state));
  // The film of each shot; that of the one that continues has the whole shot.
  const whole = carom.simulate(shots[0]!.table, shots[0]!.balls, shots[0]!.cue, {
    cushionModel: "stronge",
  });
  expect(shots.map(({ film }) => film.time)).toEqual([0.5, whole.time, shots[2]!.played.time]);
  expect(shots[1]!.film.events).toEqual(whole.events);
  expect(shots[0]!.film.events).toEqual(whole.events.filter(({ time }) => time <= 0.5));
  expect(shots[1]!.film.positions(0.7)).toEqual(whole.positions(0.7));
  // As simulate() plays them.
  const third = shots[2]!;
  const again = carom.simulate(third.table, third.balls, third.cue, { cushionModel: "stronge" });
  expect([again.time, again.count, again.final]).toEqual([
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

test("two programs read each other's lines", () => {
  const { carom: first } = builds[0]!;
  const { carom: second } = builds[1]!;
  const table = first.table("9ft");
  const here = first.record(table, first.rack("nineball", table));
  const there = second.record();
  for (const line of here.lines) expect(there.read(line)).toBeUndefined();
  here.shoot({ speed: 8, phi: 90 });
  expect(there.read(here.lines.at(-1)!)).toMatchObject({ shot: 1, same: true });
  expect([there.balls, there.table]).toEqual([here.balls, table]);
  there.place(0, 0.9, 0.4);
  expect(here.read(there.lines.at(-1)!)).toBeUndefined();
  there.shoot({ speed: 2, phi: 70 });
  expect(here.read(there.lines.at(-1)!)).toMatchObject({ shot: 2, same: true });
  expect([here.hash, here.ended]).toEqual([there.hash, false]);
  expect([...first.replay(here.end())].length).toBe(2);
  expect(() => there.read('{"shot":{}}')).toThrow(/shot.status is missing/);
});

test("a forged stroke, damage and other revisions are told", () => {
  const { carom } = builds[0]!;
  const text = aGame(carom).end();
  expect(
    [...carom.replay(text.replace('"speed":2.5', '"speed":2.6'))].map(({ same }) => same),
  ).toEqual([true, true, false]);
  const refused = (damaged: string, said: RegExp): void => {
    expect(() => [...carom.replay(damaged)]).toThrow(CaromError);
    expect(() => [...carom.replay(damaged)]).toThrow(said);
  };
  refused(text.replace('"phi"', '"phy"'), /line 5: shot.phy is no key of the format/);
  refused(text.replace('"revision":', '"revision":9'), /line 1: the recording is of revision 9/);
  refused(text.split("\n").slice(0, -2).join("\n"), /cut off/);
});
