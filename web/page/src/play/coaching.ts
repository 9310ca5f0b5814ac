// The coach at the table: hints, the chances of the aimed stroke, and the cost of a stroke after it
// was played.
import type {
  AimOf,
  Call,
  Carom,
  Cue,
  PlanOptions,
  PlanStroke,
  Review,
  ShotBall,
  Table,
} from "carom";
import { drop, far } from "../far.js";
import { onTable } from "../table/filmed.js";
import { GAMES } from "../table/games.js";
import { isSafe, namesBall, percent, wordsOfChances, wordsOfPlan } from "../table/words.js";
import { wrong } from "../ui.js";
import { type Aimer, isComputer, OPTIONS, type Play } from "./game.js";
import { isRated } from "./ladder.js";
import { costOf, keepRow, type Row } from "./log.js";
import type { Coach, Question, Session } from "./parts.js";
import { countReview } from "./reviews.js";
import {
  aimAt,
  cueOf,
  free,
  isHinted,
  levelOf,
  look,
  playerOf,
  SAFETY,
  says,
  seatPlayer,
  wantedOf,
  why,
  wordsOfLevel,
  wordsOfOutcome,
} from "./session.js";
import { runOutSketches, safetySketches } from "./sketches.js";
import { texts } from "../texts/texts.js";

/** Shots of a plan, and of the chances of one stroke. */
const PLAN = 1000;
const TRY = 200;
/** How many strokes of a plan are compared, and how many safeties are drawn. */
const LISTED = 6;
const SAFETIES = 3;
/** Shots of the plans of a run-out, and how often it is played. */
const RUN_OUT = { shots: 300, plays: 40 };
/** Breaks of each break that is compared. */
const BREAKS = 128;
/** The largest distance of a leave from its target, m. */
export const NEAR = 0.2;
/** How long the aim rests before its chances are computed, ms. */
const PAUSE = 120;
/** Beyond this off the aim, degrees, another ball or pocket was meant. */
const FARTHEST = 10;

/** A layout, and the player for whom it is planned. */
interface Request {
  game: string;
  table: Table;
  balls: readonly ShotBall[];
  names: readonly string[];
  strikable: readonly number[];
  options: PlanOptions;
}

/** The request for a plan: the person here plays with the errors of their rating. */
function requestOf(play: Play, level: number): Request {
  const { against, game, seed } = play.setup;
  const rating = String(level);
  return {
    game,
    table: play.table,
    balls: play.balls,
    names: play.names,
    strikable: play.strikable,
    options: {
      ...wantedOf(play),
      player: { ...seatPlayer(play, rating), onlyPots: 0 },
      opponent: seatPlayer(play, isComputer(against) ? against : rating),
      seed: seed + play.strokes,
    },
  };
}

/** The best strokes, so many at most. */
const plan = (
  { table, balls, options }: Request,
  more: PlanOptions,
  best: number,
): Promise<PlanStroke[]> => far("plan", table, balls, { ...options, ...more, best, shots: PLAN });
/** The best stroke. Among strokes of equal worth, within their errors, it is one that scores. */
async function best(request: Request, more: PlanOptions = {}): Promise<PlanStroke> {
  const [first, ...others] = await plan(request, more, more.goal === undefined ? LISTED : 1);
  const scores = (choice: PlanStroke): boolean => namesBall(request.table, choice);
  if (scores(first!) || first!.kind !== "safety") return first!;
  const isAsGood = ({ value, error }: PlanStroke): boolean =>
    first!.value - value <= Math.hypot(first!.error, error);
  return others.find((choice) => scores(choice) && isAsGood(choice)) ?? first!;
}
async function chancesOf({ table, balls, options }: Request, cue: Cue): Promise<PlanStroke> {
  const struck = { ...options, cue: { ball: cue.ball }, shots: TRY };
  const [choice] = await far("chances", table, balls, [cue], struck);
  return choice!;
}
const isPot = (call: Call | undefined): call is { ball: number; pocket: number } =>
  typeof call === "object" && call.ball > 0 && call.pocket >= 0;

/** How far a stroke is off the aim at a ball and a pocket. */
export function errors(
  carom: Carom,
  table: Table,
  balls: readonly ShotBall[],
  cue: Cue,
  target: AimOf,
): Pick<Row, "phi" | "speed"> {
  const aim = carom.aim(table, balls, cue, target, OPTIONS);
  if (aim.outcome === "no_way") return {};
  const phi = ((cue.phi - aim.cue.phi + 540) % 360) - 180;
  if (Math.abs(phi) > FARTHEST) return {};
  const [low, high] = aim.speed;
  if (aim.outcome !== "falls") return { phi };
  const nearest = Math.min(Math.max(cue.speed, low), high);
  return { phi, speed: cue.speed - nearest };
}

/** The side of the tip that an offset means: one name above 0.1 radii, another below -0.1. */
function sideOf(offset: number, above: string, below: string): string {
  if (offset > 0.1) return above;
  return offset < -0.1 ? below : "";
}
/** How a stroke is played: ", at 2.5 m/s with follow and left side". */
function wordsOfCue({ a, b, speed }: Cue): string {
  const height = sideOf(b, texts.follow, texts.drawSpin);
  const side = sideOf(a, texts.leftSide, texts.rightSide);
  const tip = [height, side].filter(Boolean).join(texts.andWord);
  return texts.atMS(speed.toFixed(1), tip && texts.withTip(tip));
}
function wordsOfHint(s: Session, choice: PlanStroke, goal: string | undefined): string {
  const { play, first } = s;
  const stroke = wordsOfPlan(play, choice, first?.ball === -1);
  const cue = choice.kind === "pass" ? "" : wordsOfCue(choice.cue);
  const chances =
    goal === undefined
      ? wordsOfChances(choice, !play.hasPockets)
      : texts.chancesOfGoal(goal, percent(choice.value), percent(choice.foul));
  const counts = isRated(play) ? texts.hintEndsCounting : "";
  const errors = play.practice ? "" : texts.thisStrokeErrsLike + counts;
  return texts.hintOf(stroke, cue, wordsOfLevel(s), chances, errors);
}

/** Puts the cue ball in hand where the coach wants it, and aims the stroke. */
function setAim(s: Session, { cue, place }: { cue: Cue; place: readonly number[] }): void {
  const { play } = s;
  if (play.bounds) play.put(play.cueBall, place[0]!, place[1]!);
  play.strike(cue.ball);
  aimAt(s, cue);
  look(s);
  s.sketches = [];
  s.place = undefined;
  s.hint = cue; // the turn line makes room for the hint
}
/** Puts the stroke of a hint on the table, with its call. */
function setHint(s: Session, choice: PlanStroke): void {
  setAim(s, choice);
  const isPotted = choice.pocket >= 0 && namesBall(s.play.table, choice);
  const otherwise = isSafe(s.play.table, choice) ? SAFETY : -1;
  s.chosen = {
    ball: isPotted ? choice.ball : -1,
    pocket: isPotted ? choice.pocket : otherwise,
    hitBall: s.first?.ball ?? -1,
    phi: choice.cue.phi,
  };
  s.special = choice.kind === "push" ? "push" : undefined;
  s.showing.rest();
}

/** Draws safeties and aims one; the message describes it and how often the others win. */
function showSafeties(s: Session, choices: readonly PlanStroke[], aimed: PlanStroke): void {
  setHint(s, aimed);
  s.sketches = safetySketches(s.play, choices);
  s.showing.rest();
  const others = choices.flatMap((choice, k) =>
    choice === aimed ? [] : texts.numberWins(k + 1, percent(choice.value)),
  );
  const more = others.length > 0 ? ` ${texts.alsoDrawn(others.join(", "))}` : "";
  says(s, wordsOfHint(s, aimed, undefined) + more);
}

/** The best stroke of the drill that is practised. */
async function adviseDrill(s: Session, name: string, isWanted: () => boolean): Promise<void> {
  const { play, training } = s;
  const player = playerOf(play.carom, String(levelOf(s)));
  const drill = training.drill(name);
  drop("drill"); // a search for another stroke
  const found = await far("drill", play.table, play.balls, drill, player, OPTIONS);
  if (!isWanted()) return;
  if (!found) return says(s, texts.theSearchFoundNo);
  aimAt(s, found.cue);
  s.hint = found.cue;
  s.showing.rest();
  const share = texts.makesItInOf(percent(found.chance), found.plays);
  says(s, texts.hintTheStrokeThat(wordsOfCue(found.cue), wordsOfLevel(s), share));
}

/** Draws the run-out after a hint on the table, and describes it. */
async function tellRunOut(
  s: Session,
  { ball }: PlanStroke,
  hint: string,
  isWanted: () => boolean,
): Promise<void> {
  const { table, balls, options } = requestOf(s.play, levelOf(s));
  const generation = s.chancesGeneration;
  drop("sequence"); // a search for another stroke
  const more = { ...options, ...RUN_OUT, inHand: "no" as const };
  const { strokes, chance } = await far("sequence", table, balls, more);
  // One that begins with another ball than the hint would contradict it.
  if (!isWanted() || !isHinted(s) || strokes.length < 2 || strokes[0]!.choice.ball !== ball) return;
  s.sketches = runOutSketches(s.play, strokes);
  s.showing.rest();
  if (generation !== s.chancesGeneration) return;
  const list = strokes.map(({ choice }) => wordsOfPlan(s.play, choice)).join(", ");
  says(s, `${hint} ${texts.toRunOut(list, percent(chance))}`);
}

/** Begins a search of the coach; a later one, or a stroke, ends it. */
async function search(
  s: Session,
  begins: string,
  answer: (isWanted: () => boolean) => Promise<void>,
): Promise<void> {
  if (!free(s)) return says(s, why(s));
  const generation = ++s.searchGeneration;
  s.chancesGeneration++; // chances that are computed later do not hide the hint
  s.asksPlace = false;
  const isWanted = (): boolean => generation === s.searchGeneration && free(s);
  says(s, begins);
  try {
    await answer(isWanted);
  } catch (error) {
    if (isWanted()) says(s, wrong(error));
  }
}
const advise = (s: Session, question?: Question): Promise<void> =>
  search(s, texts.lookingForTheBest, async (isWanted) => {
    const { drill } = s.play.setup;
    if (drill !== undefined && !question) return await adviseDrill(s, drill, isWanted);
    drop("plan"); // a search for another stroke
    const request = requestOf(s.play, levelOf(s));
    if (question?.options.safeties) {
      const choices = await plan(request, question.options, SAFETIES);
      if (isWanted()) showSafeties(s, choices, choices[0]!);
      return;
    }
    const choice = await best(request, question?.options);
    if (!isWanted()) return;
    setHint(s, choice);
    s.place = question?.options.goal?.place;
    s.showing.rest();
    const hint = wordsOfHint(s, choice, question?.words);
    says(s, hint);
    const runsOut = !question && s.play.hasPockets && !s.play.breaks;
    if (runsOut) await tellRunOut(s, choice, hint, isWanted);
  });
/** Aims the break that wins most, and reports what errors cost. */
const adviseBreak = (s: Session): Promise<void> =>
  search(s, texts.lookingForTheBreak, async (isWanted) => {
    const { play } = s;
    const { table, balls, options } = requestOf(play, levelOf(s));
    const { player, opponent, seed } = options as Required<PlanOptions>;
    const { rack } = GAMES[play.played!.base]!;
    drop("bestBreaks"); // a search for another rack
    const more = { player, opponent, seed, breaks: BREAKS, best: 1, shot: OPTIONS };
    const [found] = await far("bestBreaks", rack, table, balls, more);
    if (!isWanted()) return;
    const { cue, counts, aimCost, speedCost, tipCost } = found!;
    setAim(s, found!);
    s.showing.rest();
    const mean = counts.wins / counts.breaks;
    const error = Math.sqrt((counts.winSquares / counts.breaks - mean ** 2) / counts.breaks);
    const share = (x: number): string => `${(100 * x).toFixed(1).replace(/^-0.0$/, "0.0")} %`;
    const words = texts.breakWins(
      wordsOfCue(cue),
      wordsOfLevel(s),
      share(mean),
      share(error),
      percent(counts.makes / BREAKS),
      percent(counts.fouls / BREAKS),
      share(aimCost),
      share(speedCost),
      share(tipCost),
    );
    says(s, words);
  });
const leaveNear = (s: Session, place: readonly [number, number]): Promise<void> =>
  advise(s, {
    options: { goal: { kind: "near", place, distance: NEAR } },
    words: texts.leavesItNear(100 * NEAR),
  });

/** The chances of the stroke that is aimed, a moment after it was. */
async function chances(s: Session): Promise<void> {
  const generation = ++s.chancesGeneration;
  const { play } = s;
  const isGame = play.played && play.setup.drill === undefined;
  if (!free(s) || !isGame || !onTable(play.balls[play.cueBall]!.state)) return;
  await new Promise((later) => window.setTimeout(later, PAUSE));
  if (generation !== s.chancesGeneration || !free(s)) return;
  try {
    const choice = await chancesOf(requestOf(s.play, levelOf(s)), cueOf(s));
    if (generation !== s.chancesGeneration || !free(s)) return;
    const words = wordsOfChances(choice, !play.hasPockets);
    says(s, texts.thisStroke(wordsOfLevel(s), words));
  } catch (error) {
    if (generation === s.chancesGeneration) says(s, wrong(error));
  }
}

/** What a stroke was meant as: the pot that was called, or what it does most often. */
function intentionOf(request: Request, choice: PlanStroke, call: Call | undefined): string {
  const kind = choice.ball < 0 ? "safety" : choice.kind;
  const meant = isPot(call) ? { ...choice, ...call } : { ...choice, kind };
  return wordsOfPlan(request, meant);
}
/**
 * Looks back at a stroke: its chances beside those of the best one, in words, and for the log where
 * the player aimed it.
 */
async function lookBack(
  carom: Carom,
  request: Request,
  cue: Cue,
  call: Call | undefined,
  aimer: Aimer,
): Promise<string> {
  try {
    // Both plans play as the same player, with the cue ball where it was put.
    const advice = best(request, { inHand: "no" });
    const [chances, found] = await Promise.all([chancesOf(request, cue), advice]);
    const { game, table, balls } = request;
    const row: Row = {
      when: new Date().toISOString().slice(0, 16),
      game,
      meant: intentionOf(request, chances, call),
      ...(isPot(call) ? errors(carom, table, balls, cue, call) : {}),
      keep: chances.keep,
      value: chances.value,
      best: wordsOfPlan(request, found),
      bestValue: found.value,
    };
    if (aimer === "player") keepRow(row);
    const cost = costOf(row)!;
    const verdict = cost < 0.02 ? texts.youChoseWell : texts.itCost(percent(cost));
    return texts.thatStrokeWinsIn(percent(chances.value), row.best, percent(found.value), verdict);
  } catch (error) {
    return texts.theReviewOfThat(wrong(error));
  }
}

/** The value of a stroke before and after it, in games that have reviews. */
async function reviewOf(
  { table, balls, options }: Request,
  cue: Cue,
  call: Call | undefined,
): Promise<Review | undefined> {
  // A push-out or a pass is meant as no pot.
  if (table.pockets.length === 0 || typeof call === "string") return undefined;
  try {
    return await far("review", table, balls, cue, options, call);
  } catch (error) {
    console.info("A stroke of this game has no review:", error);
    return undefined;
  }
}
/** The value of a stroke for a player with these errors, its result, and its cost. */
async function wordsOfCost(request: Request, cue: Cue, review: Review): Promise<string> {
  // A review knows only the value of strokes at pockets.
  const { value } = review.ball >= 0 ? review : await chancesOf(request, cue);
  const cost = value - review.came;
  const words = cost < 0 ? texts.itWon(percent(-cost)) : texts.itCost(percent(cost));
  const change = Math.abs(cost) < 0.005 ? "" : words;
  const told = texts.whatCame(percent(value), percent(review.came), change);
  return told.trim();
}

export const coaching = (s: Session): Coach => ({
  advise: (question) => advise(s, question),
  adviseBreak: () => adviseBreak(s),
  leaveNear: (place) => leaveNear(s, place),
  take(choice) {
    const choices = s.sketches.flatMap((sketch) => sketch.choice ?? []);
    showSafeties(s, choices, choice);
  },
  chances: () => chances(s),
  review() {
    const request = requestOf(s.play, levelOf(s));
    return async (cue, call, aimer, isTold) => {
      s.chancesGeneration++; // chances of this stroke that are computed later do not hide its review
      const { play } = s;
      const ownStrokes = (): number => play.aims.filter((aimer) => aimer !== "opponent").length;
      const strokes = ownStrokes();
      const review = await reviewOf(request, cue, call);
      // The coach's page sums up what the player aimed.
      if (review && aimer === "player") countReview(review, play.setup, request.balls);
      // The look back knows the cost in games that have no reviews.
      const isCompared = isTold || !review;
      const advice = isCompared ? await lookBack(s.carom, request, cue, call, aimer) : "";
      const cost = review ? await wordsOfCost(request, cue, review) : "";
      if (play !== s.play || strokes !== ownStrokes()) return; // another stroke was played
      // A newer message stays: a hint, or what the page's player does.
      const isSaid = s.words.message.textContent === wordsOfOutcome(s);
      s.verdict = [s.verdict, advice.trim(), cost].filter(Boolean).join(" ");
      if (isSaid) says(s, wordsOfOutcome(s));
    };
  },
});
