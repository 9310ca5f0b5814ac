// How a game stands, in words: whose turn it is, on which balls, and the score.
import { onTable } from "../table/filmed.js";
import type { Play, Stroke } from "./game.js";

/** The name of who is at the table: 0 breaks, 1 is the other one. */
export function nameOf(play: Play, who: 0 | 1, seat: 0 | 1): string {
  const { against } = play.setup;
  if (against === "person") return `Player ${who + 1}`;
  if (who === seat) return "You";
  return against === "link" ? "The other player" : `The ${against}`;
}
const groupOf = (play: Play, who: 0 | 1): string => {
  const { group } = play.state;
  if (group === "open" || who === play.turn) return group;
  return group === "solids" ? "stripes" : "solids";
};
const left = (play: Play, from: number, to: number): number =>
  play.balls.filter(({ state }, k) => k >= from && k <= to && onTable(state)).length;

/** carom_foul_string() of each, as far as a reader can do with it. */
const WHY: Partial<Record<string, string>> = {
  cue_ball: "the cue ball fell or left the table",
  no_ball: "the cue ball hit no ball",
  first: "the cue ball hit a wrong ball first",
  off: "a ball left the table",
  cushion: "no ball fell or reached a cushion",
  break: "the break drove fewer than four balls to cushions",
  double_hit: "the tip was still on the cue ball, or touched it again, as it met a ball",
};

/** What has just happened, as far as it is not a plain change of turns. */
function told(play: Play, { who, ruling }: Stroke, seat: 0 | 1): string {
  if (!ruling?.foul) return "";
  const name = nameOf(play, who, seat);
  return `${name} ${name === "You" ? "foul" : "fouls"}${WHY[ruling.reason] ? `: ${WHY[ruling.reason]}` : ""}. `;
}

/** Where balls count for whoever plays. */
function pocketOf(play: Play): string {
  const [pocket = 5] = play.state.pocket ?? [];
  return `the ${play.carom.pocketNames(play.table)[pocket] ?? "own"} pocket`;
}
/** Of snooker: what is to be met. */
function onOf(play: Play): string {
  const on = play.carom.ballsOn(play.state, play.balls);
  if (on.length === 0) return "nothing";
  if (on.every((ball) => ball < 16)) return "a red";
  return on.length === 1 ? play.names[on[0]!]! : "a colour";
}

export function wordsOfTurn(play: Play, seat: 0 | 1, thinks: boolean, short = false): string {
  if (play.practice) return play.setup.drill ?? "Practice";
  const before = play.last && !short ? told(play, play.last, seat) : "";
  if (play.winner !== undefined) {
    const name = nameOf(play, play.winner, seat);
    return `${before}${name} ${name === "You" ? "have" : "has"} won.`;
  }
  const name = nameOf(play, play.turn, seat);
  const you = name === "You";
  const group =
    play.setup.game === "eightball" && !play.breaks
      ? play.state.group === "open"
        ? ", open table"
        : `, ${play.state.group}`
      : "";
  const on =
    play.setup.game === "snooker" && play.winner === undefined
      ? `, on ${onOf(play)}`
      : play.played?.pockets
        ? `, into ${pocketOf(play)}`
        : group;
  if (thinks) return `${before}${name} thinks${on} …`;
  // Whoever has played has something to send; who has not waits for a link.
  if (!you && play.setup.against === "link")
    return `${before}${name} plays${on}: ${play.last?.who === seat ? "send the link." : "wait for the link that comes after this turn."}`;
  const turn =
    play.hasPockets && play.breaks
      ? `${name} ${you ? "break" : "breaks"}`
      : you
        ? "Your turn"
        : `${name}'s turn`;
  const hand =
    play.hand === "no"
      ? ""
      : ` Cue ball in hand${play.hand === "kitchen" ? " behind the line" : play.hand === "anywhere" ? "" : " in the D"}: drag it.`;
  return `${before}${turn}${on}.${hand}`;
}

/** What fell in a stroke. */
export function wordsOfStroke(play: Play, { who, shot }: Stroke, seat: 0 | 1): string {
  const fell = (shot?.events ?? []).flatMap(({ type, a }) =>
    type === "ball_pocket" && a > 0 ? `the ${play.names[a]}` : [],
  );
  return `${nameOf(play, who, seat)} ${shot ? "pocketed" : "passed"}${!shot ? "" : fell.length > 0 ? ` ${fell.join(" and ")}` : " no ball"}.`;
}

/** The score: what is left of each, or points. */
export function wordsOfScore(play: Play, seat: 0 | 1, racks: readonly [number, number]): string {
  if (play.practice) {
    const count = left(play, 1, play.balls.length);
    return `${count} ${count === 1 ? "ball" : "balls"}`;
  }
  const names = ([0, 1] as const).map((who) => nameOf(play, who, seat));
  const of = (parts: readonly (string | number)[]): string =>
    parts.map((part, k) => `${names[k]}: ${part}`.replace(": -", ": −")).join(" · ");
  if (play.played?.points) return of(play.points);
  const won = racks[0] + racks[1] > 0 ? `racks won ${racks[0]} : ${racks[1]}` : "";
  if (play.setup.game === "eightball") {
    if (play.state.group === "open") return won;
    const balls = ([0, 1] as const).map((who) =>
      groupOf(play, who) === "solids" ? left(play, 1, 7) : left(play, 9, 15),
    );
    return `${of(balls.map((count) => (count === 0 ? "on the 8" : `${count} left`)))}${won && ` · ${won}`}`;
  }
  if (play.setup.game === "nineball") {
    const next = play.balls.findIndex(({ state }, k) => k > 0 && onTable(state));
    return [next > 0 ? `lowest ball ${next}` : "", won].filter((part) => part !== "").join(" · ");
  }
  return won;
}
