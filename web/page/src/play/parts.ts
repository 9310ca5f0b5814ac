// The types of a session, which its files share: the parts that play a game, and the state of the
// game.
import type { Call, Carom, Choice, Cue, PlanOptions, PlanStroke, Vec2 } from "carom";
import type { player as filmPlayer } from "../../../player/player.js";
import type { FlatView } from "../../../player/words.js";
import type { Sketch } from "../table/drawing.js";
import type { filmOf, Quaternion } from "../table/filmed.js";
import type { Stroke as StrokeValues } from "../table/stroke.js";
import type { Drill } from "./drills.js";
import type { Aimer, Play, Stroke } from "./game.js";
import type { OwnRating } from "./ladder.js";
import type { Look } from "./look.js";
import type { Side, Sound } from "./sound.js";

/**
 * What was chosen to be called, -1: nothing, pocket -2: a safety, and the ball that the aim met
 * then: the choice does not hold where the aim meets another one. That of a hint,
 * which has a direction, holds near it only.
 */
export interface Chosen {
  ball: number;
  pocket: number;
  hitBall: number;
  phi?: number;
}

export type Lines = "none" | "short" | "full";
export interface Settings {
  lines: "level" | Lines;
  sound: boolean;
  coach: boolean;
  /** Whether a pull of the cue plays when it is let go, or only sets the power. */
  pull: boolean;
  /** Whether balls without numbers have letters, and balls in three dimensions their labels. */
  numbers: boolean;
  /** How the table is shown: drawn, as a scene, or as a scene where the device is fast enough. */
  view: "device" | "scene" | "drawn";
}

/** What a stroke is set by (controls.ts): its elements, and its values. */
export interface Controls {
  readonly side: HTMLElement;
  readonly tip: HTMLElement;
  readonly shoot: HTMLButtonElement;
  readonly row: HTMLElement[];
  readonly numbers: HTMLElement;
  set(values: Partial<StrokeValues>): void;
  value(): StrokeValues;
  /**
   * Shows which part of a ball is met, as whoever aims sees both: its share of the diameter, and
   * the side of it, 1 the right one; or none.
   */
  showContact(contact: { share: number; side: number } | undefined, name?: string): void;
}

/** A game by link (link.ts). */
export interface Link {
  save(): void;
  send(): Promise<void>;
  /** Requests the game from other pages on this machine. */
  ask(): void;
  /** Whether strokes of the other player were heard that are not shown yet. */
  waiting(): boolean;
  /** Shows the next one of them. */
  onward(): void;
  close(): void;
}

/** A game that is watched (watch.ts): its bar, and what begins and ends it. */
export interface Watching {
  readonly root: HTMLElement;
  enter(): void;
  leave(): void;
}

/** Drills, a table from a photo, and one's own rating (practice.ts). */
export interface Training {
  readonly parts: HTMLElement[];
  wordsOfStart(name: string): string;
  drill(name: string): Drill;
  /** Judges a try of a drill, and counts it if the player aimed without a hint. */
  played(name: string, stroke: Stroke, isOwn: boolean): { text: string; repeats: boolean };
  /** One's own rating on the scale of a game. */
  rating(game: string): OwnRating;
  /** What to practise next. */
  plan(): string;
}

/** The table as a scene (space.ts): below the flat view, or from behind the cue. */
export interface SpaceView {
  /** Whether one looks from behind the cue. */
  readonly isOn: boolean;
  /** Whether there is a scene. */
  readonly isLive: boolean;
  /** Whether a cue is on its way to its ball. */
  readonly isStriking: boolean;
  /** Draws the table below the flat view, and returns whether it has. */
  backdrop(view: FlatView): boolean;
  /** Moves a cue to its ball, and then calls `next`. */
  strike(cue: Cue, place: readonly number[], next: () => void): void;
  /** Puts away the cue that strikes. */
  putAway(): void;
  /** Makes the scene or ends it, as the settings and the device have it. */
  prepare(): Promise<void>;
  /** Looks from behind the cue, or from above again. */
  toggle(): Promise<void>;
  draw(): void;
  /** Where a point is seen: from -1, the left edge, to 1, the right one. */
  readonly sideOf: Side;
  close(): void;
}

/** Both seats, their points and balls (plates.ts). */
export interface Plates {
  readonly root: HTMLElement;
  update(): void;
}

/** What is seen of a game (filming.ts). */
export interface Showing {
  /** Shows the balls as they lie, with the stroke that is aimed. */
  rest(): void;
  /** Shows the film of a stroke, and then calls `after`. */
  perform(stroke: Stroke, next: () => void): void;
  /** Ends the film that is shown. */
  skip(): void;
  replay(): void;
}

/** The last view of a game (end.ts). */
export interface EndView {
  readonly root: HTMLElement;
  /** The rating before the game counted, of a game that counts. */
  rated: OwnRating | undefined;
  show(): void;
  hide(): void;
}

/** A question to the coach other than the stroke that wins most, and its result as text. */
export interface Question {
  options: Pick<PlanOptions, "goal" | "safeties">;
  words?: string;
}
/** The coach at the table (coaching.ts). */
export interface Coach {
  /** Sets the best stroke that a search finds. */
  advise(question?: Question): Promise<void>;
  /** Sets the break that wins most. */
  adviseBreak(): Promise<void>;
  /** Aims the stroke that leaves the cue ball near a point. */
  leaveNear(place: readonly [number, number]): Promise<void>;
  /** Aims a stroke that a hint has drawn. */
  take(choice: PlanStroke): void;
  /** Shows the chances of the aimed stroke. */
  chances(): Promise<void>;
  /** Begins the review of a stroke of this layout; what it returns takes the stroke, and whether its
   * verdict is told.
   */
  review(): (cue: Cue, call: Call | undefined, aimer: Aimer, isTold: boolean) => Promise<void>;
}

/** What a game is played by, which is there as long as the view. */
interface Parts {
  readonly carom: Carom;
  readonly coarse: boolean;
  readonly settings: Settings;
  readonly sound: Sound;
  readonly words: Record<"turn" | "score" | "message", HTMLElement>;
  readonly buttons: Record<
    | "menu"
    | "hint"
    | "coach"
    | "replay"
    | "undo"
    | "rack"
    | "push"
    | "skip"
    | "link"
    | "space"
    | "sound",
    HTMLButtonElement
  >;
  /** The choices that the rules offer instead of a stroke. */
  readonly choices: readonly (readonly [Choice, HTMLButtonElement])[];
  readonly stroke: Controls;
  readonly film: ReturnType<typeof filmPlayer>;
  readonly space: SpaceView;
  readonly plates: Plates;
  readonly link: Link;
  readonly watching: Watching;
  readonly training: Training;
  readonly showing: Showing;
  readonly coach: Coach;
  readonly end: EndView;
  /** The aim, the layout or a setting has changed. */
  changed(): void;
}

/** The state of the game, and what is shown of it now. */
export interface Progress {
  play: Play;
  /** The complete game, of which `play` is the watched part. */
  watched: Play | undefined;
  /** Under which the game is kept; "" before one is opened. */
  id: string;
  /** Which of both sits here; of two at this page, whoever is at the table. */
  seat: 0 | 1;
  chosen: Chosen;
  special: "push" | "pass" | undefined;
  /** The result and the cost of the person's last stroke; "" for no message. */
  verdict: string;
  /** The stroke of the last hint requested for this stroke. */
  hint: Cue | undefined;
  /** What is drawn behind the hint: the run-out, or other safeties. */
  sketches: readonly Sketch[];
  /** Whether the next tap chooses the target of a leave; and the target of the hinted leave. */
  asksPlace: boolean;
  place: Vec2 | undefined;
  /** What the aim meets first. */
  first: Look | undefined;
  turned: Quaternion[];
  turnedBefore: Quaternion[];
  thinks: boolean;
  /** The stroke of the page's player that is shown before it plays. */
  theirs: Cue | undefined;
  /** The action after the current film. */
  continuation: (() => void) | undefined;
  shown: Stroke | undefined;
  /** What the film player shows. */
  filmed: ReturnType<typeof filmOf> | undefined;
  sounded: number;
  /** Raised by what ends a search: another game, a stroke. */
  searchGeneration: number;
  /** Raised by what ends the search of the coach for chances. */
  chancesGeneration: number;
}
export interface Session extends Parts, Progress {}
