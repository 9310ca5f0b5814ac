// The state of a game as sentences: whose turn it is, the balls on, and the score.
import type { Ruling } from "carom";
import { onTable } from "../table/filmed.js";
import { ballOf, spoken } from "../table/words.js";
import type { Play, Stroke } from "./game.js";
import {
  wordsOfBaulk,
  wordsOfChoice,
  wordsOfDanger,
  wordsOfFreeShot,
  wordsOfReason,
  wordsOn,
} from "./named.js";
import { texts, translate } from "../texts/texts.js";

/** The name of who is at the table: 0 breaks, 1 is the other one. */
export function nameOf(play: Play, player: number, seat: number): string {
  const { against } = play.setup;
  if (against === "person") return texts.player(player + 1);
  if (player === seat) return texts.you;
  if (against === "link") return texts.theOtherPlayer;
  return play.points.length > 2 ? texts.player(player + 1) : texts.theRated(against);
}
export const groupOf = (play: Play, player: number): string => {
  const { group } = play.state;
  if (group === "open" || player === play.turn) return group;
  return group === "solids" ? "stripes" : "solids";
};
const ballsLeft = (play: Play, first: number, last: number): number =>
  play.balls.filter(({ state }, k) => k >= first && k <= last && onTable(state)).length;

/** The foul that was just played, if any. */
function wordsOfFoul(play: Play, { player, ruling, isLate }: Stroke, seat: number): string {
  const name = nameOf(play, player, seat);
  if (isLate) return texts.fouls(name, name === texts.you, texts.theTimeIsOver);
  if (!ruling?.foul) return "";
  return texts.fouls(name, name === texts.you, wordsOfReason(play, ruling.why));
}

const fell = ({ shot }: Stroke, ball: number): boolean =>
  shot?.events.some(({ type, a }) => type === "ball_pocket" && a === ball) === true;
/** The games with two groups, in which the eight is last. */
export const isEight = ({ setup }: Play): boolean =>
  ["eightball", "blackball", "heyball"].includes(setup.game);

/** Why the eight lost the game. */
function wordsOfEight(play: Play, { state, ruling, balls, shot, call }: Stroke): string {
  if (shot?.final[8]?.label === "off") return texts.the8LeftThe;
  const [first, last] = state.group === "solids" ? [1, 7] : [9, 15];
  const hasOwn = balls.some((ball, k) => k >= first && k <= last && onTable(ball.state));
  if (state.group === "open" || hasOwn) return texts.the8FellBefore;
  if (ruling?.foul) return texts.the8FellWith(wordsOfReason(play, ruling.why));
  const isCalled = typeof call === "object" && call.ball === 8;
  return isCalled ? texts.the8FellInto : texts.the8WasNot;
}
/** The score that ended a game of points; whoever wins with less of it wins by fouls of the other. */
function wordsOfFinalScore(play: Play, { foul, why }: Ruling): string {
  const { points, winner } = play;
  const isBehind = winner !== undefined && points[winner]! < Math.max(...points);
  if (isBehind && foul) return texts.theThirdFoulIn(wordsOfReason(play, why));
  return texts.theScoreIs(points.join(" : ").replaceAll("-", "−"));
}
/** Why the game ended, if the stroke explains more than the score does. */
export function wordsOfEnd(play: Play): string {
  const { last, setup, played, winner } = play;
  if (winner !== undefined && last && !last.shot)
    return last.isLate ? texts.theTimeIsOver : texts.theOtherGaveUp;
  if (!last?.ruling) return "";
  const hasLost = winner !== last.player;
  const deciding = isEight(play) ? 8 : { nineball: 9, tenball: 10 }[setup.game];
  if (deciding === undefined) {
    if (play.isOwn) return texts.nobodyElseHas(setup.game === "killer");
    return played?.points ? wordsOfFinalScore(play, last.ruling) : "";
  }
  if (!hasLost) return fell(last, deciding) ? texts.theFell(deciding) : "";
  const isEightGone = fell(last, 8) || last.shot?.final[8]?.label === "off";
  if (deciding === 8 && isEightGone) return wordsOfEight(play, last);
  return last.ruling.foul ? texts.theThirdFoulIn(wordsOfReason(play, last.ruling.why)) : "";
}

/** Where balls count for whoever plays. */
function pocketOf(play: Play): string {
  const [pocket = 5] = play.state.pocket ?? [];
  return texts.thePocket(translate(play.carom.pocketNames(play.table)[pocket] ?? "own"));
}
/** What is to be met first, where the rules let meet nothing else. */
export function wordsOfTarget(play: Play): string {
  if (play.setup.game === "snooker") return wordsOn(play).plate;
  const [target, ...others] = play.hasPockets ? play.carom.ballsOn(play.state, play.balls) : [];
  return target !== undefined && others.length === 0
    ? texts.firstBall(spoken(play.names[target]!))
    : "";
}

/** Whether whoever is at the table has the equalizing inning. */
const isLastInning = ({ state }: Play): boolean => state.innings === 3;

/** The name of a group; in blackball a group is a colour. */
function wordsOfGroup({ setup }: Play, group: string): string {
  const colours: Record<string, string> = { solids: "reds", stripes: "yellows" };
  return translate(setup.game === "blackball" ? colours[group]! : group);
}

/** The balls that count for whoever plays, or the pocket, behind the name: ", on a red". */
function aimOf(play: Play): string {
  const { game } = play.setup;
  if (isLastInning(play)) return texts.equalizingInning;
  if (game === "snooker") return wordsOn(play).turn;
  if (play.played?.pockets) return texts.intoPocket(pocketOf(play)) + wordsOfDanger(play);
  if (!isEight(play) || play.breaks) return wordsOfBaulk(play) + wordsOfDanger(play);
  const group =
    play.state.group === "open" ? texts.openTable : `, ${wordsOfGroup(play, play.state.group!)}`;
  return group + wordsOfFreeShot(play) + wordsOfDanger(play);
}
const PLACES: Record<string, string> = {
  kitchen: texts.behindTheLine,
  baulk: texts.behindTheLine,
  anywhere: "",
};
function wordsOfHand({ hand }: Play): string {
  return hand === "no" ? "" : texts.cueBallInHand(PLACES[hand] ?? texts.inTheD);
}
/** Which ball is struck, and how another one is chosen. */
function wordsOfStruck({ cueBall, names, strikable }: Play): string {
  return strikable.length > 1 ? texts.youStrike(ballOf(names, cueBall)) : "";
}
function wordsOfTable(play: Play, name: string): string {
  if (play.hasPockets && play.breaks) return texts.breaks(name, name === texts.you);
  return name === texts.you ? texts.yourTurn : texts.sTurn(name);
}

export function wordsOfTurn(play: Play, seat: number, thinks: boolean, short = false): string {
  const struck = short ? "" : wordsOfStruck(play);
  if (play.practice)
    return translate(play.setup.drill ?? texts.practice) + (struck && `.${struck}`);
  const prefix = play.last && !short ? wordsOfFoul(play, play.last, seat) : "";
  const end = play.isOver ? wordsOfEnd(play) : "";
  const why = end && `: ${end}`;
  if (play.isDrawn) return texts.isDrawn(why);
  if (play.winner !== undefined) {
    const winner = nameOf(play, play.winner, seat);
    return texts.hasWon(winner, winner === texts.you, why);
  }
  const name = nameOf(play, play.turn, seat);
  const aim = aimOf(play);
  if (thinks) return texts.thinks(prefix, name, aim);
  // Whoever has played has something to send; who has not waits for a link.
  if (name !== texts.you && play.setup.against === "link") {
    const sends = play.last?.player === seat;
    return texts.playsByLink(prefix, name, aim, sends ? texts.sendTheLink : texts.waitForTheLink);
  }
  return `${prefix}${wordsOfTable(play, name)}${aim}.${wordsOfHand(play)}${struck}`;
}

/** The result of a stroke: the potted balls, and the points where they are not equal to these. */
export function wordsOfStroke(play: Play, stroke: Stroke, seat: number): string {
  const { player, shot, cue, ruling, isLate } = stroke;
  const name = nameOf(play, player, seat);
  if (isLate) return wordsOfFoul(play, stroke, seat).trim();
  if (!shot)
    return stroke.choice ? wordsOfChoice(play, stroke.choice).deed(name) : texts.concedes(name);
  const pots = shot.events.flatMap(({ type, a }) =>
    type === "ball_pocket" && (a !== cue.ball || !ruling?.foul) ? spoken(play.names[a]!) : [],
  );
  const fallen = [...new Set(pots)].map((word) => {
    const count = pots.filter((pot) => pot === word).length;
    return count > 1 ? texts.manyOf(count, word) : texts.theBallNamed(word);
  });
  const { foul = true, points = 0 } = ruling ?? {};
  const hasScored = play.played?.points && points !== pots.length;
  const scored = !foul && (hasScored || !play.hasPockets) ? texts.whoScored(name, points) : "";
  if (!play.hasPockets && foul) return wordsOfFoul(play, stroke, seat).trim();
  if (!play.hasPockets || (scored && fallen.length === 0)) return scored;
  const pocketed = fallen.length > 0 ? fallen.join(texts.andWord) : texts.noBall;
  return `${texts.whoPocketed(name, pocketed)} ${scored}`.trim();
}

/** The score: what is left of each, or points. */
export function wordsOfScore(play: Play, seat: number, racks: readonly [number, number]): string {
  if (play.practice) {
    const count = ballsLeft(play, 1, play.balls.length);
    return texts.ballsCounted(count);
  }
  const names = play.points.map((_, player) => nameOf(play, player, seat));
  const wordsOfPoints = (parts: readonly (string | number)[]): string =>
    parts.map((part, k) => `${names[k]}: ${part}`.replace(": -", ": −")).join(" · ");
  const { race } = play.setup;
  const wonAll = racks[0] + racks[1] > 0 ? texts.racksWon(racks[0], racks[1]) : "";
  const won = race === undefined ? wonAll : texts.raceStands(race, racks[0], racks[1]);
  if (play.isOwn) return wordsOfPoints(play.points.map((left) => texts.countLeft(left)));
  if (play.played?.points)
    return wordsOfPoints(play.points) + (race === undefined ? "" : ` · ${won}`);
  if (isEight(play)) {
    if (play.state.group === "open") return won;
    const balls = ([0, 1] as const).map((player) =>
      groupOf(play, player) === "solids" ? ballsLeft(play, 1, 7) : ballsLeft(play, 9, 15),
    );
    return `${wordsOfPoints(balls.map((count) => (count === 0 ? texts.onThe8 : texts.countLeft(count))))}${won && ` · ${won}`}`;
  }
  if (["nineball", "tenball"].includes(play.setup.game)) {
    const next = play.isOver ? -1 : play.balls.findIndex(({ state }, k) => k > 0 && onTable(state));
    return [next > 0 ? texts.lowestBall(next) : "", won].filter((part) => part !== "").join(" · ");
  }
  return won;
}
