// Rules of the caller's: every method is called, and what one throws ends the call, never more.
import { expect, test } from "vitest";
import type { GameRules } from "../dist/index.js";
import { builds, carom, nineball, refuses } from "./support.js";

/** Rules with all methods, which write down that they were asked, and throw where they are told to. */
function every(called: Set<string>, throws: { in: string }, withValue: boolean): GameRules {
  const ask = <Told>(method: string, answer: Told) => {
    called.add(method);
    if (method === throws.in) throw new RangeError(`in ${method}`);
    return answer;
  };
  const rules: GameRules = {
    race: "points",
    on: (_user, inPlay) =>
      ask(
        "on",
        inPlay.filter((ball) => ball > 0),
      ),
    judge(_user, _inPlay, cueBall, facts, _call, foul) {
      ask("judge", null);
      const down = facts.potted.map(({ ball }) => ball).filter((ball) => ball !== cueBall);
      return { turn: "pass", spot: down, reason: foul([1, 2, 3]) };
    },
    left: () => ask("left", [2, 2]),
    pockets: () => ask("pockets", [0, 1, 2, 3, 4, 5]),
    points: () => ask("points", 1),
    settle(user, table, balls, turn, spot) {
      ask("settle", null);
      user[0] = 7;
      turn.spot.forEach(spot);
      for (const ball of turn.spot) expect(balls[ball]!.state.label).toBe("stationary");
      return { ...turn, points: table.length };
    },
  };
  if (withValue) rules.value = (_user, layout) => ask("value", layout.length / 16);
  return rules;
}

for (const { carom, name } of builds)
  test(`${name}: all methods of rules, and what they throw`, () => {
    const table = carom.table("9ft");
    let balls = carom.rack("nineball", table).slice(0, 4);
    for (const [k, [x, y]] of [
      [0.4, 0.4],
      [0.15, 0.15],
      [0.9, 1.7],
      [0.7, 2.2],
    ].entries())
      balls = carom.placeBall(table, balls, k, x!, y!);
    const shot = carom.simulate(
      table,
      balls,
      carom.aim(table, balls, { speed: 1, b: -0.3 }, { ball: 1, pocket: 0 }).cue,
    );
    expect(shot.facts).toBeDefined();
    const called = new Set<string>();
    const throws = { in: "" };
    const asking = every(called, throws, false);
    const valued = every(called, throws, true);

    // a ruling: the ball that fell comes back, the state and the points are those of settle()
    const ruling = carom.rule(shot, { own: asking, user: [3] });
    expect([ruling.put, ruling.turn, ruling.points]).toEqual([[1], "pass", table.length]);
    expect(ruling.game.user).toEqual([7, 0, 0, 0, 0, 0, 0, 0]);
    expect(ruling.reason).toBe("none");
    const settled = every(new Set(), throws, false);
    delete settled.settle; // the library puts it back in the same place
    expect(carom.rule(shot, { own: settled }).balls).toEqual(ruling.balls);
    expect(carom.ballsOn({ own: asking }, balls)).toEqual([1, 2, 3]);

    const plan = (rules: GameRules) => carom.plan(table, balls, { own: rules, shots: 100 });
    plan(asking);
    expect(called).toEqual(new Set(["on", "judge", "left", "pockets", "points", "settle"]));
    const first = plan(valued);
    expect(called).toContain("value");

    const match = carom.match({ own: valued }, table, { balls });
    const played = [...match.lines];
    for (const method of called) {
      throws.in = method;
      let thrown = 0;
      for (const call of [
        () => plan(asking),
        () => plan(valued),
        () => carom.rule(shot, { own: asking }),
        () => match.stroke({ speed: 1, phi: 90 }),
        () => carom.match({ own: valued }, table, { balls }),
      ])
        try {
          call();
        } catch (error) {
          expect(error).toEqual(new RangeError(`in ${method}`));
          thrown++;
        }
      expect(thrown, method).toBeGreaterThan(0);
      if (match.lines.length > played.length) played.push(...match.lines.slice(played.length));
    }
    throws.in = "";
    expect(plan(valued)).toEqual(first); // what was thrown once is over
    match.stroke({ speed: 1, phi: 90 });
    const replay = carom.match({ own: valued });
    match.lines.forEach((line) => replay.read(line));
    expect(replay.balls).toEqual(match.balls);
    expect(replay.game).toEqual(match.game);
  });

test.each(builds)("killer of five seats, by $name", ({ carom }) => {
  const table = carom.table("9ft");
  const own: GameRules = {
    race: "seats",
    anyCueBall: true,
    on: (_user, inPlay) => inPlay.filter((ball) => ball > 0),
    left: () => [1, 1],
    value: (user) => user[user.seat]! / user.reduce((sum, lives) => sum + lives),
    judge(user, _inPlay, cueBall, { potted }) {
      if (!potted.some(({ ball }) => ball !== cueBall)) user[user.seat]!--;
      const alive = [...user.keys()].filter((k) => user[k]! > 0);
      user.seat = alive.find((k) => k > user.seat) ?? alive[0]!;
      return { turn: alive.length === 1 ? "win" : "pass" };
    },
  };
  const balls = carom.rack("nineball", table);
  const game = { own, user: [2, 2, 2, 2, 2] };
  const match = carom.match(game, table, { balls, seats: ["Ann", "Bo", "Cy", "Di", "Eve"] });
  const [best] = match.plan({ shots: 100, best: 1 });
  expect(best!.value).toBeGreaterThan(0);
  const turns: number[] = [];
  while (match.phase !== "over") {
    turns.push(match.seat);
    match.stroke({ speed: 0.1, phi: 270, ball: turns.length % 2 ? match.cueBall : 1 });
  }
  expect(turns).toEqual([0, 1, 2, 3, 4, 0, 1, 2, 3]);
  expect([match.winner, match.words]).toEqual([4, "Eve (seat 4) has won"]);
  expect(match.standing.points).toEqual([0, 0, 0, 0, 1]);
  expect(match.game.user).toEqual([0, 0, 0, 0, 1, 0, 0, 0]);
  const again = carom.match({ own });
  for (const line of match.lines) again.read(line);
  expect([again.winner, again.undo(), again.seat, again.redo(), again.winner]).toEqual([
    4,
    true,
    3,
    true,
    4,
  ]);
  refuses([
    () => carom.plan(table, balls, { own: { ...own, value: undefined! }, shots: 100 }),
    "a plan in a race of seats needs value()",
  ]);
});

test("what rules cannot say, and that they cannot call the library", () => {
  const { table, balls } = nineball(carom);
  const shot = carom.simulate(table, balls, { speed: 8 });
  const good = every(new Set(), { in: "" }, true);
  const rule = (changes: object) => carom.rule(shot, { own: { ...good, ...changes } });
  refuses(
    [() => rule({ judge: () => undefined }), "judge: an object is needed"],
    [
      () => rule({ judge: () => ({ turn: "stop" }) }),
      'judge: turn: unknown name "stop"; use one of',
    ],
    [() => rule({ judge: () => ({ turn: "pass", spot: [40] }) }), "judge: spot"],
    [() => rule({ on: () => [-1] }), "on: it must be a whole number"],
    [
      () => rule({ judge: () => carom.simulate(table, balls) }),
      "rules cannot call the library that calls them",
    ],
    [() => rule({ left: undefined }), "own: left() is missing"],
  );
  const plan = (changes: object) =>
    carom.plan(table, balls, { own: { ...good, ...changes }, shots: 100 });
  refuses(
    [() => plan({ left: () => 3 }), "left: two numbers are needed, not 3"],
    [() => plan({ left: () => [1, 2, 3] }), "left: two numbers are needed"],
    [() => plan({ value: () => NaN }), "value: a number is needed, not NaN"],
    [() => plan({ value: () => 1.5 }), "value: it must be 0 to 1, not 1.5"],
  );
  const settle =
    (x: number, y: number): GameRules["settle"] =>
    (_user, _table, laid, turn) => {
      laid[1]!.state.r = [x, y, laid[1]!.state.r[2]];
      laid[2]!.state.r = [0.6, 1.6, laid[2]!.state.r[2]];
      return turn;
    };
  refuses(
    [() => rule({ settle: settle(NaN, 1) }), "settle: balls[1]: a position must be"],
    [() => rule({ settle: settle(9, 1) }), "settle: balls[1]: a ball is not on"],
    [() => rule({ settle: settle(0.6, 1.6) }), /settle: balls.*: two balls overlap/],
    [() => carom.match({ own: good }, table), "custom rules have no rack"],
  );
  expect(carom.rule(shot, { own: good }).turn).toBe("pass");
});
