// A game in its shortest form for a link: the acts of its players. All other lines of its recording
// follow from them, because a stroke has the same bits on every machine. A stroke carries the first
// digits of the hash of its line; that hash covers all earlier lines, so every number of the game
// is checked.
import { type Choice, choices, type Cue, type Match } from "carom";
import { texts } from "../texts/texts.js";

/** An act by the name of a call of Match, and what that call takes. */
export type Act =
  | ["stroke", hash: string, ball: number, aim: number[], stick?: Partial<Cue>]
  | ["place", x: number, y: number]
  | ["choose", Choice]
  | ["call", ball: number, pocket: number]
  | ["concede", seat: number]
  | ["clock"];
/** A line of a recording, or an act in its place. */
export type Line = string | Act;

const AIM = ["speed", "phi", "theta", "a", "b"] as const;
/** How many digits of a hash an act carries. */
const DIGITS = 8;

type Value = number | string;
type Fields = Record<string, Value>;
interface Parsed {
  shot?: Fields;
  place?: { at?: [Value, Value]; hand?: number };
  act?: { act: number; player?: number; choice?: number; call?: [number, number] };
}

/** A number of a line: those that decimals would make long are hexadecimal. */
function numberOf(value: Value = 0): number {
  if (typeof value === "number") return value;
  const [, sign, digits = "", power] = /^(-?)0x1\.?([0-9a-f]*)p([+-]\d+)$/.exec(value)!;
  return Number(`${sign}1`) * parseInt(`1${digits}`, 16) * 2 ** (Number(power) - 4 * digits.length);
}
/** The stroke of a line, of which the stick is named as far as it is another than the usual one. */
function strokeOf(fields: Fields, usual: Cue): Act {
  const stick: Partial<Cue> = {};
  for (const [key, value] of Object.entries(fields)) {
    const field = key.replace(/_(.)/g, (_, letter: string) => letter.toUpperCase()) as keyof Cue;
    const isOfStick = field in usual && field !== "ball" && !AIM.includes(field as "a");
    if (isOfStick && numberOf(value) !== usual[field]) stick[field] = numberOf(value);
  }
  const aim = AIM.map((field) => numberOf(fields[field]));
  const hash = String(fields.hash).slice(0, DIGITS);
  const ball = numberOf(fields.ball);
  const isUsual = Object.keys(stick).length === 0;
  return isUsual ? ["stroke", hash, ball, aim] : ["stroke", hash, ball, aim, stick];
}
/** The act of a line, or undefined for a line that follows from others. Throws for other lines. */
function actOf(line: string, usual: Cue): Act | undefined {
  const { shot, place, act } = JSON.parse(line) as Parsed;
  if (shot) return strokeOf(shot, usual);
  if (place?.at && !place.hand) return ["place", numberOf(place.at[0]), numberOf(place.at[1])];
  if (act?.act === 1) return ["choose", choices[Math.log2(act.choice!)]!];
  if (act?.act === 2) return ["call", ...act.call!];
  if (act?.act === 3) return ["concede", act.player ?? 0];
  if (act?.act === 4) return ["clock"];
  if (/^\{"(game|place)"/.test(line)) return undefined;
  throw new TypeError(line);
}

/**
 * The lines of a game as acts. `beginning`: the lines with which its setup begins; a game that began
 * otherwise keeps its own. A line that is no act of these keeps all lines as they are.
 */
export function actsOf(lines: string[], beginning: readonly string[], usual: Cue): Line[] {
  const first = lines.findIndex((line) => line.startsWith('{"game"')) + 1;
  const begins = lines.slice(0, first);
  const isUsual = begins.every((line, k) => line === beginning[k]);
  try {
    const acts = lines.slice(first).flatMap((line) => {
      const act = actOf(line, usual);
      return act ? [act] : [];
    });
    return isUsual ? acts : [...begins, ...acts];
  } catch {
    return lines;
  }
}

/** Does an act in a match. Throws where the rules forbid it, or a stroke has another hash. */
export function perform(match: Match, act: Act, usual: Cue): void {
  switch (act[0]) {
    case "stroke": {
      const [, hash, ball, aim, stick] = act;
      const known = match.lines.length;
      const aimed = Object.fromEntries(AIM.map((field, k) => [field, aim[k]]));
      match.stroke({ ...usual, ...stick, ...aimed, ball });
      const played = JSON.parse(match.lines[known]!) as { shot: { hash: string } };
      if (!played.shot.hash.startsWith(hash))
        throw new TypeError(texts.itsHashIsHere(played.shot.hash, hash));
      return;
    }
    case "place":
      return match.place(act[1], act[2]);
    case "choose":
      return match.choose(act[1]);
    case "call":
      return match.call(act[1], act[2]);
    case "concede":
      return match.concede(act[1]);
    case "clock":
      return match.clock();
    default:
      throw new TypeError(JSON.stringify(act));
  }
}
