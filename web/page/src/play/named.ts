// The words of a game's choices, fouls and targets, in one table by the game and its state. The
// plates, the turn line, the buttons and the voice of a screen reader all read them here. The state
// is the referee's: nothing is guessed from the balls on the table.
import { type Choice, words } from "carom";
import { spoken } from "../table/words.js";
import type { Play } from "./game.js";
import { texts, translate } from "../texts/texts.js";

/** The choices that a player takes instead of a stroke, each by a button. */
export const BUTTONS = ["pass", "place", "stay", "spot", "rack", "other_rack"] as const;
type ButtonOf = (typeof BUTTONS)[number];
/** A choice as the text of its button, and as what a player of a name did. */
interface ChoiceWords {
  text: string;
  deed: (name: string) => string;
}
const PASS: ChoiceWords = { text: texts.pass, deed: texts.passed };
const PLAY_AGAIN: ChoiceWords = { text: texts.playsAgain, deed: texts.askedToPlayAgain };
const GIVE_BACK: ChoiceWords = { text: texts.giveBack, deed: texts.gaveBack };
const BREAK_AGAIN: ChoiceWords = { text: texts.breakAgain, deed: texts.askedToBreakAgain };
const RACK: ChoiceWords = { text: texts.rackAndBreak, deed: texts.hadTheBallsRacked };
const SPOT: ChoiceWords = { text: texts.spotTheNearestBall, deed: texts.spottedTheNearest };
const SPOT_TOUCHING: ChoiceWords = {
  text: texts.spotTheTouchingBalls,
  deed: texts.spottedTheTouching,
};
/** The words of each choice: in most games, and in those that call it something else. */
const CHOICES: Record<ButtonOf, { usual: ChoiceWords; games?: Record<string, ChoiceWords> }> = {
  pass: {
    usual: PASS,
    games: {
      snooker: PLAY_AGAIN,
      nineball: GIVE_BACK,
      tenball: GIVE_BACK,
      straight: BREAK_AGAIN,
      bank: BREAK_AGAIN,
    },
  },
  place: { usual: { text: texts.placeInTheD, deed: texts.placesTheCueBall } },
  stay: { usual: { text: texts.leaveTheCueBall, deed: texts.leftTheCueBall } },
  spot: {
    usual: SPOT,
    games: {
      threecushion: SPOT_TOUCHING,
      straightrail: SPOT_TOUCHING,
      fourball: SPOT_TOUCHING,
    },
  },
  rack: {
    usual: RACK,
    games: { billiards: { text: texts.spotAndPlay, deed: texts.spottedTheBalls } },
  },
  other_rack: { usual: { text: texts.rackTheOtherBreaks, deed: texts.letTheOtherBreak } },
};
/** The words of a choice. Throws for one that has no button, such as "push". */
export function wordsOfChoice({ setup }: Play, choice: Choice): ChoiceWords {
  const { usual, games } = CHOICES[choice as ButtonOf];
  return games?.[setup.game] ?? usual;
}

/** The library's text of a foul against a rule that only one game has. */
const GAME_RULE = new Map<string, string>(words.foul).get("other");
/** These fouls, by the game that has the rule. */
const GAME_FOULS: Record<string, string> = {
  snooker: texts.snookerBehindFreeBall,
  billiards: texts.tooManyInARow,
  cowboy: texts.pastTheTarget,
  fourball: texts.hitTheOtherCueBall,
};
/** Why a stroke was a foul, in plain words, by the text that the library gives. */
export function wordsOfReason({ setup }: Play, why: string): string {
  const foul = why === GAME_RULE ? GAME_FOULS[setup.game] : undefined;
  return foul ?? translate(why);
}

/** Whether a player of snooker may name any ball as the ball on. */
export const isFreeBall = ({ acts }: Play): boolean => acts.includes("free_ball");
/** The ball on in snooker, a free ball aside: "a red", "a colour", "the yellow". */
function ballOn({ carom, state, balls, names }: Play): string {
  if (state.on) return texts.aColour;
  const [target] = carom.ballsOn({ ...state, may: [] }, balls);
  if (target === undefined) return texts.none;
  const name = names[target]!;
  return name.startsWith("red") ? texts.aRed : texts.theBallNamed(spoken(name));
}
/** The ball on in snooker, as a plate shows it, and as it follows the name in the turn line. */
export function wordsOn(play: Play): { plate: string; turn: string } {
  const target = ballOn(play);
  return isFreeBall(play)
    ? { plate: texts.freeBallMeans(target), turn: texts.withFreeBall(target) }
    : { plate: texts.ballOn(target), turn: texts.onBall(target) };
}

/** So many fouls in a row are the last ones without a penalty. */
const LAST_FOULS = 2;
/** What hangs over whoever is at the table: ", on two fouls", ", last life"; else "". */
export function wordsOfDanger({ state, turn, points, setup }: Play): string {
  if (setup.game === "killer" && points[turn] === 1) return texts.onTheLastLife;
  const [fouls = 0] = state.fouls ?? [];
  return fouls === LAST_FOULS ? texts.onTwoFouls : "";
}
/** What English billiards allows while no ball is out of baulk; else "". */
export const wordsOfBaulk = ({ state, setup }: Play): string =>
  setup.game === "billiards" && state.on ? texts.doubleBaulk : "";
/** A free shot of blackball, in which any ball may be hit and potted; else "". */
export const wordsOfFreeShot = ({ state, setup }: Play): string =>
  setup.game === "blackball" && state.freeBall ? texts.withFreeShot : "";
