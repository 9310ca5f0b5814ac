// The types of arguments and results. Units are SI: metres, kilograms, seconds, rad/s for spins.
// Directions of a cue are in degrees. The table is the plane x, y; z points up; vectors are
// right-handed. Field names are as in carom.h and carom_shot.h, in camel case.

import type * as C from "./generated/structs.js";

/** A type some of whose keys may be missing. */
type Optional<T, K extends keyof T> = Omit<T, K> & Partial<Pick<T, K>>;

/** x, y, z. */
export type Vec3 = readonly [number, number, number];
/** x, y. */
export type Vec2 = readonly [number, number];

/**
 * One ball just before a collision. Defaults: at rest at the origin, radius 0.028575 m, mass 0.17
 * kg, muSlide 0.2.
 */
export type Ball = Partial<C.Ball>;

/** Two touching balls. */
export interface Impact {
  /** The first ball. */
  a: Ball;
  /** The second ball. */
  b: Ball;
  /**
   * Sliding friction between the balls, 0 to 1. Default: Alciatore's law for the speed of slip.
   */
  muBall?: number;
  /** Coefficient of restitution, 0 to 1. Default 0.95. */
  restitution?: number;
}

export type Motion = C.Motion;

export type CollideOptions = C.Options;

/** Two balls after a collision. */
export interface Collided {
  /** "ok", or "separating" if the balls did not approach each other and nothing changed. */
  status: string;
  /** The first ball. */
  a: Motion;
  /** The second ball. */
  b: Motion;
}

/** More about a collision. Impulses in N s, vectors along the axes of the table. */
export interface Detail extends Omit<C.Detail, "stick"> {
  /** When the balls stopped slipping on each other. */
  stick: "never" | "in compression" | "in restitution";
}

/**
 * One point of a collision. Frame: y from the first ball's centre to the second's, z up, x = y
 * cross z.
 */
export interface TracePoint
  extends Omit<C.TracePoint, "phase" | "sticks" | "dX" | "dY" | "bX" | "bY"> {
  /** 0 compression, 1 restitution. */
  phase: number;
  /** Whether the balls no longer slip on each other. */
  sticks: boolean;
  /** Slip of the first ball over the cloth, m/s, along x and y. */
  d: Vec2;
  /** Slip of the second ball over the cloth. */
  b: Vec2;
}

/**
 * A ball that touches a cushion. Defaults: no spin, the ball and the cushion of pool for the model,
 * jawRadius 0.
 */
export type CushionImpact = Optional<
  C.CushionImpact,
  Exclude<keyof C.CushionImpact, "v" | "normal">
>;

export type CushionModel = C.CushionModel;

export type CushionOptions = C.CushionOptions;

/** A named condition of a pool table's cloth or cushions. */
export type Condition = C.Condition;
/** A bank for the calibration of a table, and the result of three of them. */
export type Bank = C.Bank;
export type Calibration = C.Calibration;

/**
 * A game, for its balls, cloth and cue. docs/reference/constants.md has the source of each
 * constant.
 */
export type Game = C.Game;

export type BallKind = C.BallKind;

/** How a ball moves. */
export type Label = C.Label;

/**
 * A frame of a shot, in which pocketed balls fall: views into the module's memory, valid until the
 * next frame, or until that memory grows.
 */
export interface Frame {
  /**
   * Position, velocity and spin of each ball, SI: 10 elements, of which the last is not a number,
   * but the label.
   */
  readonly states: Float64Array;
  /**
   * How each ball has turned since the start of the shot, as unit quaternions w, x, y, z: 4
   * numbers.
   */
  readonly turned: Float64Array;
  label(ball: number): Label;
}

/** Where a ball is and how it moves. */
export interface BallState extends Omit<C.BallState, "label"> {
  label: Label;
}

/** A ball of a shot. */
export interface ShotBall {
  kind: BallKind;
  state: BallState;
  /**
   * Its name in a line: the number of a ball of eight-ball or nine-ball, which plans and rulings
   * compare with its index in the list.
   */
  id?: string;
}

/**
 * A straight piece of cushion. A missing line is derived; without muCushion or restitution the
 * values of the ball are used.
 */
export type Rail = Optional<C.Rail, "line" | "muCushion" | "restitution">;

/** A rounded end of a cushion, as a rail. */
export type Jaw = Optional<C.Jaw, "muCushion" | "restitution">;

export type Pocket = C.Pocket;

/**
 * A table of any geometry. The playing surface of the built-in tables is 0 <= x <= width, 0 <= y <=
 * length, in m.
 */
export interface Table
  extends Optional<Omit<C.Table, Counted>, Exclude<keyof C.Table, Counted | "width" | "length">> {
  rails: Rail[];
  jaws: Jaw[];
  pockets: Pocket[];
}
type Counted = "rails" | "jaws" | "pockets" | "rail" | "jaw" | "pocket";

export type Cue = C.Cue;

/** What happened, by the names in files of `carom shoot`. */
export type EventType = C.EventType;

export type StopOptions = C.StopOptions;

export type ShotOptions = C.ShotOptions;

/** One event of a shot. */
export interface ShotEvent {
  /** s. */
  time: number;
  type: EventType;
  /** Index of the ball. */
  a: number;
  /** Index of the other ball, rail, jaw or pocket; -1 if there is none. */
  b: number;
  /** States before, of ball a and, for two balls, of ball b. */
  before: BallState[];
  /** States after. */
  after: BallState[];
  /**
   * For a contact of two balls: the number of contacts in its cluster, whose events are
   * consecutive; 0: a single contact.
   */
  cluster: number;
  /**
   * N s, for sounds: the magnitude of the impulse on ball a from the cue, ball, cushion or slate;
   * in a cluster only from ball b. 0 for every other event.
   */
  impulse: number;
  /**
   * m/s, for sounds: the slip between the surfaces as they meet; 0 for the strike, for pockets and
   * for events without a contact.
   */
  slip: number;
}

/** What the cue ball touches first. */
export interface Contact {
  /** s. */
  time: number;
  /** Index of the other ball. */
  ball: number;
  /** Both balls before and after. */
  event: ShotEvent;
}

export type TableName = C.TableKind;
export type Measures = C.Measures;
export type RackName = C.RackKind;

/** How the strokes of a player differ from the intended ones. Missing members are 0. */
export type Player = Optional<
  C.Player,
  "speedShare" | "speedLeast" | "speedMost" | "tipMost" | "growth" | "onlyPots" | "shots" | "eye"
>;

/** Games won and lost against a player of a Fargo rating, 0 to 1000. */
export type Score = C.Score;
/** Errors, or a Fargo rating in a game, for `carom.player()`. */
export interface Skill extends Pick<Partial<GameState>, "rules"> {
  errors?: number;
  fargo?: number;
}
/** A rating estimated from games: the mean, and the 95 % interval. */
export type Rating = Omit<C.Rating, "row">;

/** A match of two rated sides, for `odds`. One number of games or sets is for both sides. */
export interface Series {
  /** Fargo ratings, 0 to 1000: 100 points more are odds of 2 to 1. */
  ratings: readonly [number, number];
  /** How many win a set, 1 to 100. Default 1. */
  games?: number | readonly [number, number];
  /** How many win the match. Default 1. */
  sets?: number | readonly [number, number];
  /** Who breaks within a set; the sides begin the sets alternately. Default "alternate". */
  order?: C.BreakOrder;
  /** Which side breaks first. Default: drawn by lot. */
  side?: 0 | 1;
  /** How many rating points stronger a side is in a game that it breaks. Default 0. */
  breakPoints?: number;
}
/** The chances of the first side, and of all final scores. */
export interface Odds extends Omit<C.Odds, "score"> {
  /**
   * `score[s][k]`: the chance that side s wins while the other has k sets; if one set decides, k
   * games.
   */
  score: [number[], number[]];
  /** The games of both sides with which the match is fairest. */
  fair: readonly number[];
}
/** What ways are for: that a ball falls, that three-cushion scores, or that the cue ball rests. */
export type WayGoal = C.WayGoal;
/** Options of `ways`. */
export interface WaysOptions {
  /**
   * Default: "pot" on a table with pockets and more than one ball, "place" with one ball, else
   * "score".
   */
  goal?: WayGoal;
  /** For pots: the ball. Default: any. */
  ball?: number;
  /** For pots: the pocket by its index or name. Default: any. */
  pocket?: number | string;
  /** For pots and places: the largest number of rails. Default 2. */
  rails?: number;
  /** Where the cue ball must come to rest, m, for all goals. */
  place?: Vec2;
  /** The largest distance to that place, m. Default 0.15. */
  radius?: number;
  /** Whether a pot has a way for each stroke that makes it, instead of the best. Default false. */
  each?: boolean;
  /** Whose errors the chances have. Default: `player()`. */
  player?: Player;
  /** How many directions of all strokes are tried. Default: 20,000, and for points 100,000. */
  scan?: number;
  /** How many ways are returned at most. Default 100. */
  most?: number;
  shot?: ShotOptions;
}
/** A way to a goal. */
export interface Way extends Omit<C.ShotWay, "kind" | "part" | "parts"> {
  /** Of a pot. */
  kind?: C.PlanKind;
}
/** The ways to a goal. */
export interface Ways {
  /** The best first. */
  ways: Way[];
  /** What each way meets, in this order: indices of balls and names of rails. */
  parts: (number | string)[][];
  /** How many strokes were played in all directions. */
  scanned: number;
  /** How many of them succeeded. */
  good: number;
  /** How many succeeded, but had no room, because there were more ways than `most`. */
  leftOut: number;
}
/** Why a choice of a plan is good. Values are chances to win, or those of the goal. */
export interface Why
  extends Pick<
    C.Why,
    "cut" | "part" | "speed" | "leave" | "value" | "misses" | "loses" | "opponent" | "flawlessValue"
  > {
  /** The cushions that the cue ball meets before any ball. */
  rails: string[];
  /** The ball that the cue ball meets first. */
  first: number | undefined;
  /** What the stroke leaves without errors, as the referee says it. */
  words: string;
  /** The best stroke of the player who plays next. */
  next: PlanStroke | undefined;
  /** What the errors of aim, speed, tip and eye cost; they add up to flawlessValue - value. */
  cost: Record<"aim" | "speed" | "tip" | "eye", number>;
}
/** Options of `breaks`. */
export interface BreaksOptions extends Omit<BreakOptions, "breaks" | "best" | "cue"> {
  /** The stroke. Default: 9 m/s. */
  cue?: Partial<Cue>;
  /**
   * How each break is aimed: at the middle of the ball in front (default), in the direction of the
   * cue, or as far beside the middle as the cue is in the layout.
   */
  aim?: C.BreakAim;
  /** How many breaks are played. Default 500. */
  racks?: number;
}
/** The results of many breaks. Shares are of all breaks. */
export interface Breaks {
  breaks: number;
  /** Share that pots a ball. */
  makes: number;
  /** Balls that fall, the mean of a break. */
  balls: number;
  /** Share that plays on by the rules; NaN for a rack of no game with a break. */
  playsOn: number;
  /** Share of fouls, likewise. */
  fouls: number;
  /** The chance to win by the value of what each break leaves, likewise. */
  wins: number;
  /** The standard error of `wins`. */
  error: number;
  /** Share in which the cue ball falls. */
  scratches: number;
  /** Share in which a ball leaves the table. */
  off: number;
  /** Share in which a ball at a wing of the rack falls. */
  wing: number;
  /** `fell[ball][pocket]`: how often a ball falls into a pocket, as a share. */
  fell: number[][];
  /** The mean place of the cue balls that stay, m. */
  place: Vec2;
  /** The standard deviation of these places, m. */
  spread: number;
}
/** Options of `practice`, as of `review`. */
export interface PracticeOptions {
  player?: Player;
  opponent?: Player;
  seed?: number;
}
/** A stroke of a match, and its review. */
export interface Reviewed {
  /** Of the recording, from 1. */
  line: number;
  /** Who played it. */
  seat: number;
  /** The layout before it. */
  balls: ShotBall[];
  cue: Cue;
  review: Review;
}
/**
 * What strokes of a kind cost. Costs are games: chances to win that strokes lost, minus those that
 * they won.
 */
export interface Practice {
  /** Such as "long thin cut". */
  group: string;
  strokes: number;
  /** How many kept the turn. */
  kept: number;
  /** How many would keep it with the errors of the player. */
  due: number;
  /** What the misses cost. */
  missCost: number;
  /** What the places of the balls cost. */
  placeCost: number;
  /** The mean error of the aim to the left, degrees; NaN where no aim is known. */
  off: number;
  /** Its standard deviation, degrees. */
  spread: number;
  /** Its strokes, those that cost most first; each has a drill. */
  reviewed: Reviewed[];
}
/** Options of the comparison of breaks, for `bestBreaks`. */
export interface BreakOptions {
  /** How many times each proposed break is played, at least 16. Default 500. */
  breaks?: number;
  /** Number of proposed breaks, 1 to 8. Default 3. */
  best?: number;
  /** The gap between the balls of the racks, m. Default 1e-4. */
  gap?: number;
  seed?: number;
  /** The stroke to compare with; no break is faster. Default: 9 m/s. */
  cue?: Partial<Cue>;
  player?: Player;
  /** Default: an opponent with the errors of the player. */
  opponent?: Player;
  shot?: ShotOptions;
}
/** A break. The costs of errors are NaN for all breaks except the first. */
export interface BreakChoice extends Omit<C.BreakChoice, "aim"> {
  aim: C.BreakAim;
}
/** A drill: a stroke to practise in the layout of the review. */
export type Drill = C.Drill;
/**
 * The intention of a stroke and the value that it lost. For a stroke that aims at no pocket the
 * numbers are NaN, and there is no drill.
 */
export interface Review extends Omit<C.Review, "group" | "kept"> {
  /** Such as "long thin cut". */
  group: string;
  kept: boolean;
  drill?: Drill;
}

/**
 * A game between two strokes, as the player at the table sees it. Ball k is ball k of the game,
 * ball 0 the cue ball. Missing members are as in a new game.
 */
export interface GameState
  extends Partial<
    Pick<
      C.RulesState,
      "fouls" | "score" | "lost" | "pocket" | "on" | "freeBall" | "target" | "innings"
    >
  > {
  /** A game of `words.rules`, which describes its rules. Default "eightball". */
  rules: C.RulesKind;
  /** The group of the player. Default "open". */
  group: C.Group;
  /** Whether the next stroke is the break. Default false. */
  opening: boolean;
  /** What the player may do in addition to a stroke. Default: nothing. */
  may?: readonly C.Choice[];
  /** Custom rules; only `user` and `seat` are read in addition. */
  own?: GameRules;
  /**
   * Up to eight integers of the state, at least 0: for custom rules, or in killer the lives of each
   * seat, in cut-throat its balls as a set.
   */
  user?: readonly number[];
  /** The seat at the table in a race of seats. Default 0. */
  seat?: number;
}

/** A custom game: `carom.plan(table, balls, { own: rules, user })`. */
export interface OwnGame
  extends Required<Pick<GameState, "own">>,
    Pick<GameState, "user" | "seat"> {}

/** The integers of the state of custom rules, and the seat at the table. */
export interface Words extends Array<number> {
  seat: number;
}

/** The outcome of a stroke by custom rules. */
export interface OwnTurn {
  /**
   * Who plays next, or how the game ends; in a race of seats, `user.seat` plays next or has won.
   */
  turn: C.TurnOutcome;
  /** The layout of the next stroke. Default "after": the balls stay where they are. */
  leave?: C.Leave;
  /** Why the stroke is a foul. Default "none". */
  reason?: C.Foul;
  /** Balls to put on the foot spot: any that are down or off the table. */
  spot?: readonly number[];
  /** Default 0. Plans read them if there is no opponent. */
  points?: number;
}

/**
 * Custom rules of a game. Lists of balls contain indices. The results must depend only on the
 * arguments; `user` has eight integers for the rules, from the view of the player at the table. In
 * a race of "seats", `user[k]` is what seat k has left, such as its lives; 0: it is out. The seat
 * at the table is `user.seat`, and `judge` sets it to the seat that plays next. An exception of a
 * method ends the call that needed it. The methods cannot call the library, which waits for them.
 */
export interface GameRules {
  /** Whose balls must be potted. Default "own"; "points": `left` returns how many each needs. */
  race?: C.Race;
  /** Whether ball and pocket are called. */
  calls?: boolean;
  /** Whether a player may strike any ball. */
  anyCueBall?: boolean;
  /** Whether a shot that first meets a ball that is not on is a foul, whatever else happens. */
  firstDecides?: boolean;
  /** The balls that may be met first, and potted. */
  on(user: Words, inPlay: number[]): readonly number[];
  /**
   * The outcome of a shot; `inPlay` were the balls before it. `user` may be changed, and must be
   * left from the view of the next player. `foul` returns the foul by the rules that all games
   * share, with these balls on.
   */
  judge(
    user: Words,
    inPlay: number[],
    cueBall: number,
    facts: ShotFacts,
    call: C.Call,
    foul: (targets: readonly number[]) => C.Foul,
  ): OwnTurn;
  /** How many balls, or points, the player at the table and the other need to win. */
  left(user: Words, inPlay: number[]): readonly [number, number];

  // The library replaces missing methods by its own.

  /** The pockets in which balls count, by index. */
  pockets?(user: Words): readonly number[];
  /**
   * The chance that the player at the table wins, 0 to 1; without an opponent, the expected number
   * of balls that this player still pots. A plan in a race of seats needs it.
   */
  value?(user: Words, layout: BallState[], inHand: boolean): number;
  /**
   * In a race for points, the points of a ball that falls in the next stroke; for ball -1, the mean
   * of a later pot.
   */
  points?(user: Words, inPlay: number[], ball: number): number;
  /**
   * Applies the rules that depend on the positions of the balls after a stroke was judged, and
   * returns the turn, changed or not. `balls` and `user` may be changed. `spot` puts a ball on the
   * foot spot, or behind it; the balls of `turn.spot` only return by calling it.
   */
  settle?(
    user: Words,
    table: Table,
    balls: ShotBall[],
    turn: Required<OwnTurn>,
    spot: (ball: number) => void,
  ): OwnTurn;
}

/** The request for an aim: a ball, and its pocket by index or name, such as "foot-left". */
export interface AimOf {
  ball: number;
  pocket: number | string;
  /**
   * The way there, up to four contacts: indices of balls and names of rails, "head", "foot",
   * "left", "right", that the ball before them meets. ["left"] is a bank, [2] a combination,
   * ["head", ball] a kick: if `ball` is not named, it follows the last other ball.
   */
  via?: readonly (number | string)[];
}

/** The request for an aim at a ball by its cut, without a pocket. */
export interface CutOf {
  ball: number;
  /**
   * Degrees, above -90 and below 90, from the direction of the cue ball when it meets `ball` to the
   * line of centres. 0, the default, is a full hit; above 0, `ball` leaves to the left. It is exact
   * to 1e-6 degrees, with squirt and swerve. A list results in a list of strokes.
   */
  cut?: number | readonly number[];
}

/** A stroke with which the cue ball meets a ball at a cut. */
export interface Hit {
  cue: Cue;
  /** Degrees. */
  cut: number;
  /** Degrees: the least elevation with which the stick clears what is behind the cue ball. */
  elevation: number;
}

/** Options of a rack. With lists, there is a rack for each of their elements. */
export interface RackOptions {
  /** The distance between neighbours, m. Default 1e-4; 0 is a frozen rack. */
  gap?: number | readonly number[];
  /** Draws the displacements of the balls within the gap. Default 1. */
  seed?: number | bigint | readonly (number | bigint)[];
  /** Where the cue ball is, m. Default: on the head spot, or where the game has it. */
  cueBall?: Vec2 | readonly Vec2[];
}

/** Which events `first` looks for. */
export interface FirstOptions {
  /** Only events of this ball. */
  ball?: number;
  /** Only events later than this time, s. */
  after?: number;
}
/** The first event of a kind in a shot. */
export interface FirstEvent {
  /** Among the events of the shot. */
  index: number;
  /** s. */
  time: number;
  /** What the ball met: a ball, or a part of the table; -1: nothing. */
  other: number;
  /** The ball just before: the given one, else ball a of the event. */
  before: BallState;
  /** The ball just after. */
  after: BallState;
  event: ShotEvent;
}

/** A stroke that pots a ball, or the reason why there is none. */
export interface Aim {
  /**
   * "no_way": no direction sends the ball there; "barred": something is met first; "short": a ball
   * stops before; "rejected": by the jaws; "stick": to clear what is behind the cue ball, the stick
   * must be raised by more than 60 degrees. */
  outcome: "falls" | "no_way" | "barred" | "short" | "rejected" | "stick";
  cue: Cue;
  /**
   * Degrees: the least elevation with which the stick clears the cushions and balls behind the cue
   * ball; a stroke with less cannot be played.
   */
  elevation: number;
  /**
   * Degrees: the cut of the cue ball on the first ball. Above 0, the first ball goes to the left of
   * the cue ball's path.
   */
  cut: number;
  /** Degrees by which the path of the ball into the pocket may deviate towards either jaw. */
  margin: number;
  /** Directions of the cue, degrees, and speeds, m/s, between which the ball falls. */
  phi: Vec2;
  speed: Vec2;
  /** For "barred" and "short": what ends the path of ball a. */
  met?: { type: EventType; a: number; b: number };
}

/** Options of plans. */
export interface PlanOptions extends Partial<GameState>, C.PlanOptions {
  /** Default: `player()`. */
  player?: Player;
  /** Default: as the player; in `Match.plan` its `opponent()`. */
  opponent?: Player;
  /**
   * Where a cue ball in hand may be put, as in a ruling: behind the head string ("kitchen"), in the
   * D ("d"), ...; or between two corners, m. Choices then have its position in `place`. Default
   * "no".
   */
  inHand?: Ruling["hand"] | readonly [Vec2, Vec2];
  /** Plan to run out: a turn that ends before the game is won is worth nothing. */
  runOut?: boolean;
  /** What the stroke must leave; `value` is then the chance that it does so without a foul. */
  goal?: Goal;
  /** How many choices at most; default 5. */
  best?: number;
  /**
   * Masses and other constants of the cue; the stroke is not read. If the rules let a player strike
   * any ball, a plan chooses `ball` unless it is given.
   */
  cue?: Partial<Cue>;
  /** Models; the stopping options are not read. */
  shot?: ShotOptions;
}

/** What a stroke must leave; `carom_goal_kind` of the C header explains the kinds. */
export interface Goal {
  kind: C.GoalKind;
  /** For "snooker": the ball. */
  ball?: number;
  /** For "apart": the balls. */
  balls?: readonly number[];
  /** For "near": the position, m. */
  place?: Vec2;
  /** For "near" the largest distance, for "apart" the smallest gap, m. */
  distance?: number;
}

/** Options of run-outs: the options of plans, and two more. */
export interface SequenceOptions extends Omit<PlanOptions, "goal" | "safeties" | "best"> {
  /** How much of the chance to run out may be lost within a landing zone; default 0.03. */
  within?: number;
  /** How many run-outs to play to estimate the chance; default 100. */
  plays?: number;
}

/** A stroke of a run-out, with its landing zone and its tolerance. */
export interface SequenceStroke extends Omit<C.SequenceStroke, "choice" | "ruling" | "zone"> {
  choice: PlanStroke;
  /** What the stroke leaves without errors. */
  ruling: Ruling;
  /** The corners of the landing zone of the cue ball, m. */
  zone: Vec2[];
}

/** A complete run-out. */
export interface Sequence {
  strokes: SequenceStroke[];
  /** The fraction of the played run-outs that succeeded. */
  chance: number;
  plays: number;
}

/** A stroke and its estimated chances. */
export interface PlanStroke extends Omit<C.PlanStroke, "kind"> {
  /**
   * What happens: "pot" is a direct pot; "scan": a pot in several ways; "foul": nothing better was
   * found; "given": a stroke of the caller; "push", "pass": as in a call.
   */
  kind: C.PlanKind;
}

/**
 * The ball and the pocket that are called; or a push-out; or that the player does not play, so that
 * the stroke is not read.
 */
export type Call = C.Call | "push" | "pass";

/** What happened in a shot, by indices of balls; -1 if there is none. */
export interface ShotFacts {
  /** The first two different balls that the cue ball met. */
  first: readonly [number, number];
  /** Impacts of the cue ball on cushions before it met each of them. */
  cushionsBefore: readonly [number, number];
  /** Impacts of all balls on cushions after the first contact. */
  cushionsAfter: number;
  /** Impacts of each ball on cushions. */
  cushions: readonly number[];
  /** The balls that fell, in order, with their pockets and times, s. */
  potted: readonly { ball: number; pocket: number; time: number }[];
  /** The balls that left the table. */
  off: readonly number[];
  /** The balls that touched the cue ball when it was struck. */
  frozen: readonly number[];
  /** The balls that it met before the tip left it. */
  pushed: readonly number[];
  /** The balls that it flew over before it met one. */
  jumped: readonly number[];
  /** Touches of the tip: 1, or 2 and more for a double hit within the push; 0 without a strike. */
  touches: number;
}

/** The ruling of a shot. */
export interface Ruling {
  /** The facts of the shot; if it was not played, or ended in an error, no ball was met. */
  facts: ShotFacts;
  /** Whether the player plays on, the opponent plays, or the player has won or lost. */
  turn: C.TurnOutcome;
  foul: boolean;
  /** Why it is a foul: "none" for a legal shot. */
  reason: C.Foul;
  /** A description of the foul: "the cue ball met no ball"; "" for a legal shot. */
  why: string;
  /** Where the next player may put the cue ball. */
  hand: "no" | "anywhere" | "kitchen" | "d" | "baulk";
  /** The points of the shot, in games of points, in three-cushion and in the drill. */
  points: number;
  /**
   * Points, or balls, of the next player and of the opponent, minus those that they lost or owe.
   */
  score: [number, number];
  /**
   * The layout of the next stroke, with all spotted balls. A cue ball in hand is where the shot
   * left it, or down.
   */
  balls: ShotBall[];
  /** The balls that are no longer where the shot left them. */
  put: number[];
  /** The text of the ruling. */
  words: string;
  /** The game as the next player sees it. */
  game: GameState;
}

/** A shot of a line. */
export interface Line {
  id: string;
  /** The name of a built-in table, as in the line. */
  tableName: TableName;
  table: Table;
  /** Names of the balls, which the line's cue and events use. */
  names: string[];
  balls: ShotBall[];
  cue: Cue;
}

/** A seat: the player and the cue. A rating of 0 is unknown. */
export interface Seat extends Omit<C.Seat, "name"> {
  name: string;
}
/** The score of a match, by sides, independent of who is at the table. */
export interface Standing {
  /** The side of each seat. */
  sides: number[];
  /** With the handicap; or what each seat has left, such as lives. */
  points: number[];
  /** Matches of the set won, including this one. */
  won: number[];
  /** The side that has won the set. */
  setWinner: number | undefined;
}
/** A set: matches that are played until a side has won `race` of them. */
export interface MatchSet extends Omit<C.Set, "order"> {
  /** Who breaks next: the sides alternately, or the winner or the loser. */
  order: C.BreakOrder;
}

/**
 * Words in a recording, which carom keeps and does not seal. Texts are UTF-8 without control
 * characters.
 */
export interface Note {
  /** Who says it; without it, nobody in particular, such as a judge. */
  seat?: number;
  /** Such as "2026-11-30" or "2026-11-30T20:15:00Z": at most 31 bytes. */
  date?: string;
  /** The tournament or the league: at most 127 bytes. */
  event?: string;
  /** Where it is played: at most 127 bytes. */
  site?: string;
  /** The round of the event: at most 31 bytes. */
  round?: string;
  /** Of the seat, or of the author of a note that no seat says: at most 63 bytes. */
  name?: string;
  /** At most 1023 bytes. */
  comment?: string;
  /** What the seat offers or asks for. */
  offer?: "draw" | "take_back";
  /** To the last offer of another seat. */
  answer?: "yes" | "no";
  /** The time that the last stroke took the player, s. */
  seconds?: number;
  /** Keys of your own program, at most 8: texts of at most 255 bytes, or numbers. */
  [key: `x_${string}`]: string | number;
}

/** How a match begins. */
export interface MatchOptions {
  /** For the displacements of the balls in the rack, whose gaps are 0.1 mm. */
  seed?: number;
  /** The side that plays first. */
  side?: number;
  /**
   * The seats: their number, or their names, or what differs from the defaults. Two sides
   * alternate: of four seats, 0 and 2 are partners. Only the stick and the tip of a cue are read.
   * Default: two seats.
   */
  seats?: number | readonly (string | (Partial<Omit<Seat, "cue">> & { cue?: Partial<Cue> }))[];
  /**
   * Whether partners alternate after each stroke, as in Scotch doubles, instead of after each
   * visit.
   */
  alternate?: boolean;
  /** Limits of strokes; 0: no limit; `ownCue` 1 requires the stick of the seat. */
  limits?: Partial<C.StrokeLimits>;
  /** The set to which the match belongs. You measure its times. */
  set?: Pick<MatchSet, "race"> &
    Partial<Pick<MatchSet, "order" | "clock" | "extension" | "extensions" | "timeouts">>;
  /** A layout other than the rack of the game. `hand` is only read with a layout. */
  balls?: readonly ShotBall[];
  /** Whether the cue ball is in hand. */
  hand?: Ruling["hand"];
  /** Models of all shots. */
  shot?: ShotOptions;
}
