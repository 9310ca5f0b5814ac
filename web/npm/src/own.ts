// Rules of a game that are written in JavaScript: the functions that the module imports for them,
// and what they throw.
import { layout, names, values } from "./generated/layout.js";
import type * as C from "./generated/structs.js";
import { KEYS, refuseUnknown } from "./keys.js";
import type { Memory, Pointer } from "./memory.js";
import {
  members,
  readBalls,
  readFacts,
  readState,
  readStruct,
  readTable,
  setOf,
  setStruct,
  value,
  whole,
  writeBalls,
} from "./structs.js";
import type { GameRules, OwnTurn } from "./types.js";

const RULES = layout.carom_plan_rules;
const STATE = layout.carom_rules_state.offset;
const TURN = layout.carom_turn.offset;
const HAND = names.carom_leave.indexOf("hand");
/** The words of a state that are the rules'; the one behind them is the number of the rules. */
const WORDS = 7;
/** The methods that rules may leave to the library, as own.c numbers them. */
const OPTIONAL = ["value", "pockets", "points", "settle"] as const;
/** What is returned of a method that threw. */
const NOTHING = 0;

/** The rules that a library's calls were given. */
export class OwnRules {
  readonly #memory: Memory;
  readonly #numbers = new WeakMap<GameRules, number>();
  readonly #all: WeakRef<GameRules>[] = [];
  #failure: { error: unknown } | undefined;

  constructor(memory: Memory) {
    this.#memory = memory;
    Object.assign(memory.own, {
      on: (state: Pointer, inPlay: number) =>
        this.#guarded(state, "on", (rules, user) => setOf(rules.on(user, members(inPlay)), "on")),
      judge: (
        to: Pointer,
        state: Pointer,
        inPlay: number,
        cueBall: number,
        facts: Pointer,
        call: Pointer,
      ) => {
        memory.u8.fill(0, to, to + layout.carom_turn.size);
        const seen = readFacts(memory, facts);
        const called = readStruct<C.Call>(memory, call, "carom_call");
        const foul = (on: readonly number[]): C.Foul =>
          memory.paused(() => {
            const found = memory.exports.carom_foul_of(facts, setOf(on, "on"), cueBall);
            return names.carom_foul[found]!;
          }, false);
        return this.#guarded(
          state,
          "judge",
          (rules, user) => rules.judge(user, members(inPlay), cueBall, seen, called, foul),
          (turn) => this.#writeTurn(to, turn, "judge"),
        );
      },
      left: (state: Pointer, inPlay: number, to: Pointer) => {
        memory.i32.fill(1, to / 4, to / 4 + 2);
        return this.#guarded(
          state,
          "left",
          (rules, user) => {
            const left: unknown = rules.left(user, members(inPlay));
            if (!Array.isArray(left) || left.length !== 2)
              throw new TypeError(`left: two numbers are needed, not ${JSON.stringify(left)}`);
            return left.map((one: number) => whole(one, "left"));
          },
          (left) => void memory.i32.set(left, to / 4),
        );
      },
      value: (state: Pointer, layoutAt: Pointer, count: number, inHand: number) => {
        const states = Array.from({ length: count }, (_, k) =>
          readState(memory, layoutAt + k * layout.carom_ball_state.size),
        );
        return this.#guarded(state, "value", (rules, user) => {
          const made = numberOf(rules.value!(user, states, inHand !== 0), "value");
          const most = rules.race === "alone" ? count : 1;
          if (made < 0 || made > most)
            throw new RangeError(`value: it must be 0 to ${most}, not ${made}`);
          return made;
        });
      },
      pockets: (state: Pointer) =>
        this.#guarded(state, "pockets", (rules, user) =>
          setOf(rules.pockets!(user), "pockets", values.CAROM_POCKETS_MOST),
        ),
      points: (state: Pointer, inPlay: number, ball: number) =>
        this.#guarded(state, "points", (rules, user) =>
          numberOf(rules.points!(user, members(inPlay), ball), "points"),
        ),
      settle: (state: Pointer, table: Pointer, balls: Pointer, count: number, turnAt: Pointer) => {
        const on = readTable(memory, table);
        const there = readBalls(memory, balls, count);
        const turn = this.#readTurn(turnAt);
        /** The library puts a ball back, where the rules have laid the others. */
        const spot = (ball: number): void =>
          memory.paused(() => {
            writeBalls(memory, balls, there);
            const code = memory.exports.carom_spot_ball(
              table,
              balls,
              count,
              whole(ball, "spot", count - 1),
            );
            if (code < 0) throw new RangeError(`spot: there is no room for ball ${ball}`);
            there[ball] = readBalls(memory, balls, count)[ball]!;
          }, false);
        return this.#guarded(
          state,
          "settle",
          (rules, user) => rules.settle!(user, on, there, turn, spot),
          (changed) => {
            writeBalls(memory, balls, there);
            this.#writeTurn(turnAt, changed, "settle");
            this.#checkSettled(table, balls, count, turnAt);
          },
        );
      },
    });
  }

  /** Writes rules with a state that is 0 but for its words. */
  write(at: Pointer, rules: GameRules, user: readonly number[]): void {
    const memory = this.#memory;
    for (const method of ["on", "judge", "left"] as const)
      if (typeof rules[method] !== "function") throw new TypeError(`own: ${method}() is missing`);
    const has = OPTIONAL.reduce((set, name, k) => set | (Number(name in rules) << k), 0);
    memory.exports.carom_own_rules(at, has);
    const { race = "own", calls = false, firstDecides = false } = rules;
    setStruct(
      memory,
      at,
      "carom_plan_rules",
      {
        race: value("carom_race", race, "race"),
        calls: Number(calls),
        firstDecides: Number(firstDecides),
      },
      false,
    );
    let number = this.#numbers.get(rules);
    if (number === undefined) {
      number = this.#all.push(new WeakRef(rules)) - 1;
      this.#numbers.set(rules, number);
    }
    this.#writeUser(at + RULES.offset.state, user, "user");
    memory.i64[(at + RULES.offset.state + STATE.user) / 8 + WORDS] = BigInt(number);
  }

  /** The words of a state in the module's memory. */
  user(state: Pointer): number[] {
    const at = (state + STATE.user) / 8;
    return Array.from(this.#memory.i64.slice(at, at + WORDS), Number);
  }

  /** Throws what rules threw in the call that has ended. */
  check(): void {
    const failure = this.#failure;
    this.#failure = undefined;
    if (failure) throw failure.error;
  }

  /** No exception passes through the module: the call that uses the rules throws it at its end. */
  #guarded<T>(
    state: Pointer,
    method: keyof GameRules,
    call: (rules: GameRules, user: number[]) => T,
    keep?: (made: T) => void,
  ): T | typeof NOTHING {
    if (this.#failure) return NOTHING;
    const memory = this.#memory;
    const number = Number(memory.i64[(state + STATE.user) / 8 + WORDS]);
    const user = this.user(state);
    try {
      const made = memory.paused(() => call(this.#all[number]!.deref()!, user));
      if (method === "judge" || method === "settle") this.#writeUser(state, user, method);
      keep?.(made);
      return made;
    } catch (error) {
      this.#failure = { error };
      return NOTHING;
    }
  }

  #writeUser(state: Pointer, user: readonly number[], name: string): void {
    if (user.length > WORDS)
      throw new RangeError(`${name}: a state has ${WORDS} words, not ${user.length}`);
    for (let k = 0; k < WORDS; k++)
      this.#memory.i64[(state + STATE.user) / 8 + k] = BigInt(
        whole(user[k], `${name}: user[${k}]`, Number.MAX_SAFE_INTEGER),
      );
  }

  /** Refuses balls that lie where none can; a cue ball in hand may lie anywhere. */
  #checkSettled(table: Pointer, balls: Pointer, count: number, turn: Pointer): void {
    const memory = this.#memory;
    const { size, offset } = layout.carom_fault;
    const fault = memory.allocate(size + 8);
    const code = memory.exports.carom_shot_fault(table, balls, count, 0, 0, fault, fault + size, 8);
    const ball = memory.i32[(fault + offset.part + layout.carom_part.offset.index) / 4]!;
    memory.free(fault);
    const inHand = memory.i32[(turn + TURN.leave) / 4]! >= HAND && ball === 0;
    if (code < 0 && !inHand)
      throw new RangeError(
        `settle: balls[${ball}]: ${memory.text(memory.exports.carom_status_string(code))}`,
      );
  }

  #readTurn(at: Pointer): Required<OwnTurn> {
    const { i32, u32, f64 } = this.#memory;
    return {
      turn: names.carom_turn_outcome[i32[(at + TURN.outcome) / 4]!]!,
      leave: names.carom_leave[i32[(at + TURN.leave) / 4]!]!,
      reason: names.carom_foul[i32[(at + TURN.foul) / 4]!]!,
      spot: members(u32[(at + TURN.spot) / 4]!),
      points: f64[(at + TURN.points) / 8]!,
    };
  }

  #writeTurn(at: Pointer, made: OwnTurn, method: string): void {
    refuseUnknown(made, KEYS.turn, method);
    const { turn, leave = "after", reason = "none", spot = [], points = 0 } = made;
    setStruct(this.#memory, at, "carom_turn", {
      outcome: value("carom_turn_outcome", turn, `${method}: turn`),
      leave: value("carom_leave", leave, `${method}: leave`),
      foul: value("carom_foul", reason, `${method}: reason`),
      points: numberOf(points, `${method}: points`),
    });
    this.#memory.u32[(at + TURN.spot) / 4] = setOf(spot, `${method}: spot`);
  }
}

function numberOf(given: unknown, name: string): number {
  if (!Number.isFinite(given)) throw new TypeError(`${name}: a number is needed, not ${given}`);
  return given as number;
}
