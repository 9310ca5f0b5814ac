// What users hand in and get back. Units are SI: metres, kilograms, seconds, rad/s for spins. Directions of a cue are in degrees. The
// table is the plane x, y; z points up; vectors are right-handed. Field names are those of carom.h and carom_shot.h in camel case.

/** x, y, z. */
export type Vec3 = readonly [number, number, number];
/** x, y. */
export type Vec2 = readonly [number, number];

/** One ball just before a collision. */
export interface Ball {
  /** Centre, m. Both balls of a pair are at the same height. Default (0, 0, 0). */
  r?: Vec3;
  /** Velocity, m/s; its z must be 0. Default 0. */
  v?: Vec3;
  /** Angular velocity, rad/s. Default 0. */
  w?: Vec3;
  /** m. Default 0.028575, a pool ball. */
  radius?: number;
  /** kg. Default 0.17. */
  mass?: number;
  /** Sliding friction of ball and cloth, 0 to 1. Default 0.2. */
  muCloth?: number;
}

/** Two touching balls. */
export interface Impact {
  /** The first ball. */
  a: Ball;
  /** The second ball. */
  b: Ball;
  /** Sliding friction between the balls, 0 to 1. Default: by Alciatore's law from the speed of slip. */
  muBall?: number;
  /** Coefficient of restitution, 0 to 1. Default 0.95. */
  restitution?: number;
}

/** The motion of a ball. */
export interface Motion {
  /** Velocity, m/s. */
  v: Vec3;
  /** Angular velocity, rad/s. */
  w: Vec3;
}

/** Options of collisions. */
export interface CollideOptions {
  /** "exact" (default): the limit of infinitely many steps. "euler": Mathavan's steps of impulse. */
  solver?: "exact" | "euler";
  /** The sign of spin in the slip on the cloth: the 2014 paper's (default), or pooltool's. */
  slip?: "paper" | "pooltool";
  /** Steps of Euler's method; default 1000. */
  steps?: number;
}

/** Two balls after a collision. */
export interface Collided {
  /** "ok", or "separating" where the balls did not approach each other and nothing changed. */
  status: string;
  /** The first ball. */
  a: Motion;
  /** The second ball. */
  b: Motion;
}

/** More about a collision. Impulses in N s, vectors along the axes of the table. */
export interface Detail {
  /** Impulse along the line of centres. */
  normal: number;
  /** Impulse of the second ball's friction on the first. */
  friction: Vec3;
  /** Impulse of the cloth's friction on the first ball. */
  clothA: Vec3;
  /** Impulse of the cloth's friction on the second ball. */
  clothB: Vec3;
  /** Work of the normal force until the balls no longer approach, J. */
  workCompression: number;
  /** Work of the normal force over the whole collision, J. */
  work: number;
  /** When the balls stopped slipping on each other. */
  stick: "never" | "in compression" | "in restitution";
  /** The normal impulse at which they stuck, N s; NaN if never. */
  stickNormal: number;
}

/** One point of a collision. Frame: y from the first ball's centre to the second's, z up, x = y cross z. */
export interface TracePoint {
  /** Normal impulse so far, N s. */
  normal: number;
  /** Work of the normal force so far, J. */
  work: number;
  /** 0 compression, 1 restitution. */
  phase: number;
  /** Whether the balls no longer slip on each other. */
  sticks: boolean;
  /** Speed at which the balls part, m/s; negative while they approach. */
  vN: number;
  /** Slip of the first ball on the second, m/s, along x. */
  uX: number;
  /** Slip of the first ball on the second, m/s, along z. */
  uZ: number;
  /** Slip of the first ball over the cloth, m/s. */
  d: Vec2;
  /** Slip of the second ball over the cloth, m/s. */
  b: Vec2;
  /** Both balls, along the axes of the table. */
  state: { a: Motion; b: Motion };
}

/** A ball that touches a cushion. */
export interface CushionImpact {
  /** Velocity, m/s; its z must be 0. */
  v: Vec3;
  /** Angular velocity, rad/s. Default 0. */
  w?: Vec3;
  /** Horizontal direction from the ball into the cushion, of any length but 0. */
  normal: Vec2;
  /** Height of the cushion's nose above the cloth, m. Default 0.0365. */
  height?: number;
  /** m. Default 0.028575. */
  radius?: number;
  /** kg. Default 0.17. */
  mass?: number;
  /** Friction of ball and cloth, 0 to 1. Default 0.2. */
  muCloth?: number;
  /** Friction of ball and cushion, 0 to 1. Default 0.2. */
  muCushion?: number;
  /** Coefficient of restitution, 0 to 1. Default 0.85. */
  restitution?: number;
  /** Radius of a jaw, m; default 0, a straight rail. Read by Stronge's model with pooltool's convention only. */
  jawRadius?: number;
}

export type CushionModel = "mathavan" | "stronge" | "han" | "mirror" | "euler" | "smooth";

/** Options of impacts on cushions. */
export interface CushionOptions {
  /** Default "mathavan", the exact limit of the 2010 model. */
  model?: CushionModel;
  /** The papers' conventions (default), or pooltool's. */
  convention?: "paper" | "pooltool";
  /** Restitution and friction of the fields (default), or by Han's fits. */
  law?: "constant" | "han";
  /** Steps of Euler's method; default 1000. */
  steps?: number;
}

/** A game: whose balls, cloth and cue. docs/understanding/constants.md has the source of each number. */
export type Game = "pool" | "snooker" | "billiard" | "pooltool_pool" | "pooltool_snooker" | "pooltool_billiard";

/** The constants of a ball and of its cloth. */
export interface BallKind {
  /** kg. */
  mass: number;
  /** m; the same for all balls of a shot. */
  radius: number;
  /** Sliding friction of ball and cloth, above 0, at most 1. */
  muSlide: number;
  /** Rolling resistance, above 0, at most 1. */
  muRoll: number;
  /** Friction of a ball that turns on the spot, above 0, at most 1. */
  muSpin: number;
  /** Friction of two balls, 0 to 1; read with the option friction: "constant" only. */
  muBall: number;
  /** Restitution of two balls, 0 to 1; a pair has the mean. */
  restitution: number;
  /** Friction of ball and cushion, 0 to 1. */
  muCushion: number;
  /** Restitution of ball and cushion, 0 to 1. */
  restitutionCushion: number;
  /** m/s^2. */
  gravity: number;
  /** 1/m, 0 to 1: a rolling ball slows by muRoll gravity + drag v^2. */
  drag: number;
  /** 0 to 1: the part of its speed along a cushion that an impact takes from the ball's roll along it. */
  rollLoss: number;
  /** Friction of two balls at a slip of u m/s: lawA + lawB exp(-lawC u). All 0: Alciatore's law. */
  lawA: number;
  lawB: number;
  /** s/m. */
  lawC: number;
  /** Height of every cushion's nose for this ball, m; 0: the table's. */
  noseHeight: number;
  /** Of Stronge's cushions, 1 to 2; 0: 1.8. */
  omegaRatio: number;
  /** Restitution of ball and slate, at most 0.98; 0: 0.5, which is a convention; -1: none. */
  restitutionTable: number;
  /** Stiffness of the material, E/(1 - nu^2), Pa; 0: 6.6e9. It counts where several balls touch at one instant. */
  modulus: number;
  /** Restitution and friction of cushions change by these for each unit of ln(v), v in m/s the speed across the cushion, -1 to 1. */
  restitutionLog: number;
  muLog: number;
  /** Of smooth cushions: width of the passage from sticking to sliding, up to 0.5. 0: the five are those measured on one table. */
  smoothQ: number;
  /** The parts of the slip along and across the cushion that friction takes if it can, above 0, at most 2. */
  smoothX: number;
  smoothT: number;
  /** Friction across the cushion reaches 1 + smoothA times as far, 0 to 1. */
  smoothA: number;
  /** Rebound gains this part of the impulse where friction is used up, 0 to 1. */
  smoothK: number;
}

/** How a ball moves. */
export type Label = "stationary" | "spinning" | "sliding" | "rolling" | "pocketed" | "airborne" | "off";

/** Where a ball is and how it moves. */
export interface BallState {
  /** Centre, m; z is the radius on the table. */
  r: Vec3;
  /** Velocity, m/s. */
  v: Vec3;
  /** Angular velocity, rad/s. */
  w: Vec3;
  label: Label;
}

/** A ball of a shot. */
export interface ShotBall {
  kind: BallKind;
  state: BallState;
}

/** A straight piece of cushion from p to q. */
export interface Rail {
  p: Vec2;
  q: Vec2;
  /** Of the nose above the cloth, m. */
  height: number;
  /** lx, ly, l0 of the line lx x + ly y + l0 = 0; all 0 (the default) to have it derived. */
  line?: Vec3;
  /** On which side balls are: with a derived line, 1 is on the left of p -> q, 0 on its right. */
  side: number;
  /** Its own friction and restitution, 0 to 1; 0 (the default): those of the ball. */
  muCushion?: number;
  restitution?: number;
}

/** A rounded end of a cushion. */
export interface Jaw {
  centre: Vec2;
  /** m. */
  radius: number;
  /** Of the nose above the cloth, m. */
  height: number;
  muCushion?: number;
  restitution?: number;
}

/** A pocket takes a ball when the ball's centre crosses the circle inward. */
export interface Pocket {
  centre: Vec2;
  /** m. */
  radius: number;
  /** m; a pocketed ball is at z = -depth. */
  depth: number;
}

/** A table of any geometry. The playing surface of the built-in ones is 0 <= x <= width, 0 <= y <= length, in m. */
export interface Table {
  width: number;
  length: number;
  /** For shots in space, m: the radius of the balls that the table is meant for; 0 (the default): that of the last ball. */
  ballRadius?: number;
  /** For shots in space, m: of the tops of the rails, behind the noses; 0 (the default): 0.12, a convention. */
  railWidth?: number;
  /** For shots in space, m: how high a ball may fly into the back of a pocket; 0 (the default): the greatest height of a nose. */
  pocketBack?: number;
  rails: Rail[];
  jaws: Jaw[];
  pockets: Pocket[];
}

/** A cue and its strike. */
export interface Cue {
  /** Speed of the cue before the strike, m/s. 0: no strike. */
  speed: number;
  /** Direction in the plane, degrees from +x towards +y. */
  phi: number;
  /** Elevation of the butt, degrees, 0 to 90. The tip presses the ball on the slate. */
  theta: number;
  /** Where the tip touches, in radii: a > 0 left; a^2 + b^2 < miscue^2. */
  a: number;
  /** Where the tip touches, in radii: b > 0 above the centre. */
  b: number;
  /** kg. */
  mass: number;
  /** Effective mass of the tip's end, which makes squirt, kg. */
  endMass: number;
  /** m; kept with the cue, not used by the strike. */
  tipRadius: number;
  /** Index of the ball that is struck. */
  ball: number;
  /** 0 to 1: the offset at which the tip slips off the ball; 0: 1, at its edge. */
  miscue: number;
  /** s, to 0.01: how long the tip of a raised cue presses the ball on the slate; 0: 0.002, a leather tip; hard resin 0.0006. -1: no time. */
  tipTime: number;
}

/** What happened, in the words of files of `carom shoot`. */
export type EventType =
  | "stick_ball"
  | "ball_ball"
  | "ball_linear_cushion"
  | "ball_circular_cushion"
  | "ball_pocket"
  | "sliding_rolling"
  | "rolling_spinning"
  | "rolling_stationary"
  | "spinning_stationary"
  | "slate"
  | "rail_top"
  | "left_table";

/** When a shot is stopped. */
export interface StopOptions {
  /** At this time, s, counted from the start of the shot, with the status "stopped_at_time". 0 (default): it is not. */
  timeMost?: number;
  /**
   * Right after an event of this type, or of one of these, with the status "stopped_at_event". "contact" is the contact of the cue ball with
   * another ball. Default: after none.
   */
  stopAt?: "contact" | EventType | readonly ("contact" | EventType)[];
  /** Bound of events; default 10000. A shot with more fails with "too_many_events". */
  eventsMost?: number;
}

/** Options of shots. */
export interface ShotOptions extends StopOptions {
  /** The rules of contact: carom's (default), or pooltool's. */
  world?: "carom" | "pooltool";
  /** The collision of two balls; default exact in the world carom. */
  ballModel?: "default" | "exact" | "euler" | "inelastic" | "mirror";
  /** The impact on a cushion; default han in the world carom. "mathavan", the exact limit, takes more than ten times as long. */
  cushionModel?: "default" | CushionModel;
  /** "3d" (default): balls hop, jump and leave the table. "flat": they stay on the cloth. */
  space?: "3d" | "flat";
  /** Contacts of several balls at one instant: they last and overlap in time (default), or they are resolved one after the other. */
  simultaneous?: "cluster" | "pairs";
  /** Of the integrator of clusters, for the duration of a contact; default 25. */
  clusterSteps?: number;
  /** Between balls: by their speed of slip (default), or muBall. */
  friction?: "alciatore" | "constant";
  /** Of Euler's models; default 1000. */
  steps?: number;
}

/** One event of a shot. */
export interface ShotEvent {
  /** s. */
  time: number;
  type: EventType;
  /** Index of the ball. */
  a: number;
  /** Index of the other ball, rail, jaw or pocket; -1 where there is none. */
  b: number;
  /** States before, of ball a and, for two balls, of ball b. */
  before: BallState[];
  /** States after. */
  after: BallState[];
  /** Of the contact of two balls: how many contacts its cluster has, whose events follow each other; 0: it is alone. */
  cluster: number;
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

export type TableName = "7ft" | "8ft" | "9ft" | "snooker" | "threecushion" | "pooltool";
export type RackName = "nineball" | "eightball" | "tenball" | "snooker" | "threecushion";

/** How the strokes of a player differ from those that are meant: standard deviations of independent normal errors, and bounds. */
export interface Player {
  /** m/s. */
  speed: number;
  /** As a share of the speed; both are added in squares. Default 0. */
  speedShare?: number;
  /** Degrees. */
  phi: number;
  /** Degrees. */
  theta: number;
  /** Radii of the ball. */
  a: number;
  /** Radii of the ball. */
  b: number;
  /** Bounds of the cue's speed, m/s. Default 0.5. */
  speedLeast?: number;
  /** Default 8. */
  speedMost?: number;
  /** Bound of |a| and |b|, radii. Default 0.5. */
  tipMost?: number;
}

/** A game between two strokes, as the player at the table sees it. Ball k is ball k of the game, ball 0 the cue ball. */
export interface GameState {
  /** Eight-ball and nine-ball by the rules of the WPA; or a drill for one. Default "eightball". */
  rules: "eightball" | "nineball" | "potting";
  /** Of eight-ball: whose balls the player has. Default "open". */
  group: "open" | "solids" | "stripes";
  /** Whether the next stroke is the break. Default false. */
  opening: boolean;
}

/** Options of plans. */
export interface PlanOptions extends Partial<GameState> {
  /** Default: `player()`. */
  player?: Player;
  /** Default: as the player. */
  opponent?: Player;
  /** That a plan plays, about: 100 to 1,000,000. Default 2000. */
  shots?: number;
  /** Of the errors of strokes. Default 0. */
  seed?: number;
  /** Whether the cue ball is in hand: `place` says where to put it. Two corners of a rectangle, m: there alone. */
  inHand?: boolean | readonly [Vec2, Vec2];
  /** How many choices at most; default 5. */
  best?: number;
  /** Masses and the like of the cue; the stroke is not read. */
  cue?: Partial<Cue>;
  /** Models; when to stop is not read. */
  shot?: ShotOptions;
}

/** A stroke, and what is known of it. */
export interface Choice {
  cue: Cue;
  /** Where the cue ball lies or is put, m. */
  place: Vec2;
  /** "pot" is a direct pot; "scan" was found by shots in all directions; "foul": nothing better was found; "given" was asked for. */
  kind: "pot" | "scan" | "foul" | "given";
  /** The ball that falls without errors and keeps the turn, and its pocket; -1: none. */
  ball: number;
  pocket: number;
  /** Its impacts on cushions. */
  cushions: number;
  /** Chance to win; of potting the share of the balls that are potted. */
  value: number;
  /** Its standard error. */
  error: number;
  /** Chance that the player plays on, or wins. */
  keep: number;
  foul: number;
  lose: number;
  /** How often it was played with errors. */
  seen: number;
}

/** The ball and the pocket that are called. */
export interface Call {
  ball: number;
  pocket: number;
}

/** What a shot amounts to. */
export interface Ruling {
  /** Whether the player plays on, the other one plays, or the player has won or lost. */
  turn: "keep" | "pass" | "win" | "lose";
  foul: boolean;
  /** Where whoever plays next may put the cue ball. */
  hand: "no" | "anywhere" | "kitchen";
  /** The layout of the next stroke. */
  balls: ShotBall[];
  /** The game as whoever plays next sees it. */
  game: GameState;
}
