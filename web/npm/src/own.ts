// Rules of a game that are written in JavaScript: the functions that the module imports for them,
// and the exceptions that they throw.
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
import type { GameRules, OwnTurn, Words } from "./types.js";

const RULES = layout.carom_plan_rules;
const STATE = layout.carom_rules_state.offset;
const TURN = layout.carom_turn.offset;
const HAND = names.carom_leave.indexOf("anywhere");
/** The integers of a state that belong to the rules; its context is the number of the rules. */
const WORDS = 8;
/** The optional methods of rules, as own.c numbers them. */
const OPTIONAL = ["value", "pockets", "points", "settle"] as const;
/** The return value of a method that threw. */
const NOTHING = 0;

/** The rules that were passed to calls of the library. */
export class OwnRules {
  readonly #memory: Memory;
  readonly #numbers = new WeakMap<GameRules, number>();
  readonly #known: WeakRef<GameRules>[] = [];
  #failure: { error: unknown } | undefined;
  /** Of the last stroke that was judged. */
  #cueBall = 0;

  constructor(memory: Memory) {
    this.#memory = memory;
    Object.assign(memory.callbacks, {
      on: (state: Pointer, inPlay: number) =>
        this.#guarded(state, "on", (rules, user) => setOf(rules.on(user, members(inPlay)), "on")),
      judge: (
        target: Pointer,
        state: Pointer,
        inPlay: number,
        cueBall: number,
        facts: Pointer,
        call: Pointer,
      ) => {
        memory.u8.fill(0, target, target + layout.carom_turn.size);
        this.#cueBall = cueBall;
        const seen = readFacts(memory, facts);
        const called = readStruct<C.Call>(memory, call, "carom_call");
        const foul = (targets: readonly number[]): C.Foul =>
          memory.paused(() => {
            const found = memory.exports.carom_foul_of(facts, setOf(targets, "on"), cueBall);
            return names.carom_foul[found]!;
          }, false);
        return this.#guarded(
          state,
          "judge",
          (rules, user) => rules.judge(user, members(inPlay), cueBall, seen, called, foul),
          (turn) => this.#writeTurn(target, turn, "judge"),
        );
      },
      left: (state: Pointer, inPlay: number, target: Pointer) => {
        memory.i32.fill(1, target / 4, target / 4 + 2);
        return this.#guarded(
          state,
          "left",
          (rules, user) => {
            const left: unknown = rules.left(user, members(inPlay));
            if (!Array.isArray(left) || left.length !== 2)
              throw new TypeError(`left: two numbers are needed, not ${JSON.stringify(left)}`);
            return left.map((count: number) => whole(count, "left"));
          },
          (left) => void memory.i32.set(left, target / 4),
        );
      },
      value: (state: Pointer, layoutAt: Pointer, count: number, inHand: number) => {
        const states = Array.from({ length: count }, (_, k) =>
          readState(memory, layoutAt + k * layout.carom_ball_state.size),
        );
        return this.#guarded(state, "value", (rules, user) => {
          const worth = numberOf(rules.value!(user, states, inHand !== 0), "value");
          const most = rules.race === "alone" ? count : 1;
          if (worth < 0 || worth > most)
            throw new RangeError(`value: it must be 0 to ${most}, not ${worth}`);
          return worth;
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
        const tableRead = readTable(memory, table);
        const layoutBalls = readBalls(memory, balls, count);
        const turn = this.#readTurn(turnAt);
        /** The library spots a ball in the layout that the rules have made. */
        const spot = (ball: number): void =>
          memory.paused(() => {
            writeBalls(memory, balls, layoutBalls);
            const code = memory.exports.carom_spot_ball(
              table,
              balls,
              count,
              whole(ball, "spot", count - 1),
            );
            if (code < 0) throw new RangeError(`spot: there is no room for ball ${ball}`);
            layoutBalls[ball] = readBalls(memory, balls, count)[ball]!;
          }, false);
        return this.#guarded(
          state,
          "settle",
          (rules, user) => rules.settle!(user, tableRead, layoutBalls, turn, spot),
          (changed) => {
            writeBalls(memory, balls, layoutBalls);
            this.#writeTurn(turnAt, changed, "settle");
            this.#checkSettled(table, balls, count, turnAt);
          },
        );
      },
    });
  }

  /** Writes rules with a state that is 0 except for its integers. */
  write(pointer: Pointer, rules: GameRules, user: readonly number[], seat = 0): void {
    const memory = this.#memory;
    for (const method of ["on", "judge", "left"] as const)
      if (typeof rules[method] !== "function") throw new TypeError(`own: ${method}() is missing`);
    const has = OPTIONAL.reduce((set, name, k) => set | (Number(name in rules) << k), 0);
    memory.exports.carom_own_rules(pointer, has);
    const { race = "own", calls = false, firstDecides = false, anyCueBall = false } = rules;
    setStruct(
      memory,
      pointer,
      "carom_plan_rules",
      {
        race: value("carom_race", race, "race"),
        calls: Number(calls),
        firstDecides: Number(firstDecides),
        anyCueBall: Number(anyCueBall),
      },
      false,
    );
    let number = this.#numbers.get(rules);
    if (number === undefined) {
      number = this.#known.push(new WeakRef(rules)) - 1;
      this.#numbers.set(rules, number);
    }
    const state = pointer + RULES.offset.state;
    this.writeUser(state, Object.assign([...user], { seat }), "user");
    memory.i64[(state + STATE.context) / 8] = BigInt(number);
  }

  /** The integers of a state in the module's memory. */
  user(state: Pointer): Words {
    const pointer = (state + STATE.user) / 8;
    const words = Array.from(this.#memory.i64.slice(pointer, pointer + WORDS), Number);
    return Object.assign(words, { seat: this.#memory.i32[(state + STATE.seat) / 4]! });
  }

  /** Throws the exception that rules threw in the call that has ended. */
  check(): void {
    const failure = this.#failure;
    this.#failure = undefined;
    if (failure) throw failure.error;
  }

  /** No exception passes through the module: the call that uses the rules throws it at its end. */
  #guarded<T>(
    state: Pointer,
    method: keyof GameRules,
    call: (rules: GameRules, user: Words) => T,
    keep?: (result: T) => void,
  ): T | typeof NOTHING {
    if (this.#failure) return NOTHING;
    const memory = this.#memory;
    const number = Number(memory.i64[(state + STATE.context) / 8]);
    const user = this.user(state);
    try {
      const result = memory.paused(() => call(this.#known[number]!.deref()!, user));
      if (method === "judge" || method === "settle") this.writeUser(state, user, method);
      keep?.(result);
      return result;
    } catch (error) {
      this.#failure = { error };
      return NOTHING;
    }
  }

  /** Writes the integers of a state, and its seat. */
  writeUser(state: Pointer, user: Words, name: string): void {
    if (user.length > WORDS)
      throw new RangeError(`${name}: a state has ${WORDS} words, not ${user.length}`);
    for (let k = 0; k < WORDS; k++)
      this.#memory.i64[(state + STATE.user) / 8 + k] = BigInt(
        whole(user[k], `${name}: user[${k}]`, Number.MAX_SAFE_INTEGER),
      );
    const seat = whole(user.seat, `${name}: user.seat`, values.CAROM_SEATS_MOST - 1);
    this.#memory.i32[(state + STATE.seat) / 4] = seat;
  }

  /** Rejects balls in impossible positions; a cue ball in hand may be anywhere. */
  #checkSettled(table: Pointer, balls: Pointer, count: number, turn: Pointer): void {
    const memory = this.#memory;
    const { size, offset } = layout.carom_fault;
    const fault = memory.allocate(size + 8);
    const code = memory.exports.carom_shot_fault(table, balls, count, 0, 0, fault, fault + size, 8);
    const ball = memory.i32[(fault + offset.part + layout.carom_part.offset.index) / 4]!;
    memory.free(fault);
    const inHand = memory.i32[(turn + TURN.leave) / 4]! >= HAND && ball === this.#cueBall;
    if (code < 0 && !inHand)
      throw new RangeError(
        `settle: balls[${ball}]: ${memory.text(memory.exports.carom_status_string(code))}`,
      );
  }

  #readTurn(pointer: Pointer): Required<OwnTurn> {
    const { i32, u32, f64 } = this.#memory;
    return {
      turn: names.carom_turn_outcome[i32[(pointer + TURN.outcome) / 4]!]!,
      leave: names.carom_leave[i32[(pointer + TURN.leave) / 4]!]!,
      reason: names.carom_foul[i32[(pointer + TURN.foul) / 4]!]!,
      spot: members(u32[(pointer + TURN.spot) / 4]!),
      points: f64[(pointer + TURN.points) / 8]!,
    };
  }

  #writeTurn(pointer: Pointer, supplied: OwnTurn, method: string): void {
    refuseUnknown(supplied, KEYS.turn, method);
    const { turn, leave = "after", reason = "none", spot = [], points = 0 } = supplied;
    setStruct(this.#memory, pointer, "carom_turn", {
      outcome: value("carom_turn_outcome", turn, `${method}: turn`),
      leave: value("carom_leave", leave, `${method}: leave`),
      foul: value("carom_foul", reason, `${method}: reason`),
      points: numberOf(points, `${method}: points`),
    });
    this.#memory.u32[(pointer + TURN.spot) / 4] = setOf(spot, `${method}: spot`);
  }
}

function numberOf(number: unknown, name: string): number {
  if (!Number.isFinite(number)) throw new TypeError(`${name}: a number is needed, not ${number}`);
  return number as number;
}
