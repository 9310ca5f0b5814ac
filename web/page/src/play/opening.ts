// Which game is on the table: a new one, a saved one, or one from a link.
import { drop } from "../far.js";
import { parameters, wrong } from "../ui.js";
import { firstStroke } from "./first.js";
import { Play, read, type Setup } from "./game.js";
import { damaged, unpack } from "./keep.js";
import type { Session } from "./parts.js";
import {
  deleteGame,
  holdGame,
  idOfLink,
  idOfTab,
  newId,
  listedGames,
  savedGame,
  takeOver,
} from "./saved.js";
import { aimAt, cueOf, mine, NONE, says } from "./session.js";
import { isWorthKeeping, next, save, SPEED_AFTER_BREAK } from "./turns.js";
import { texts } from "../texts/texts.js";

export const FIRST: Setup = { game: "eightball", against: "300", own: "800", seed: 1 };

/** Puts a game on the table. */
export function start(s: Session, play: Play, id: string, seat: 0 | 1 = 0): void {
  drop("plan");
  s.end.hide();
  s.end.rated = undefined;
  // What is still drawn belongs to the previous game.
  s.space.putAway();
  s.film.stop();
  s.film.look(1);
  const turned = play.balls.map(() => [1, 0, 0, 0] as const);
  Object.assign(s, {
    searchGeneration: s.searchGeneration + 1,
    continuation: undefined,
    theirs: undefined,
    thinks: false,
    play,
    watched: undefined,
    id,
    seat,
    turned,
    turnedBefore: turned,
    chosen: NONE,
    special: undefined,
    verdict: "",
    hint: undefined,
    asksPlace: false,
  });
}
/** The message at the start of a game. */
function wordsOfStart({ setup, practice }: Play, training: Session["training"]): string {
  if (setup.drill !== undefined) return training.wordsOfStart(setup.drill);
  if (practice) return texts.dragBallsToLay;
  return texts.dragOnTheTable;
}

/** Sets a legal first stroke, one try at a time, unless somebody aims, plays or leaves first. */
async function aimLegally(s: Session): Promise<void> {
  const { play } = s;
  const isUntouched = (initial: string): boolean =>
    s.play === play && play.strokes === 0 && JSON.stringify(s.stroke.value()) === initial;
  const usual = cueOf(s);
  const initial = JSON.stringify(s.stroke.value());
  const search = firstStroke(play, usual);
  let tried = search.next();
  while (!tried.done) {
    await new Promise((later) => window.setTimeout(later));
    if (!isUntouched(initial)) return;
    tried = search.next();
  }
  if (tried.value === usual) return;
  aimAt(s, tried.value);
  s.showing.rest();
}

/** Begins a game with a new id; the previous one is saved if a stroke was played in it. */
export function begin(s: Session, setup: Setup): void {
  const left = { id: s.id, play: s.watched ?? s.play };
  const isKept = left.id !== "" && isWorthKeeping(left.play);
  if (left.id !== "" && !isKept) void deleteGame(left.id);
  const play = new Play(s.carom, structuredClone(setup));
  start(s, play, setup.against === "link" ? idOfLink(setup, 0) : newId());
  void holdGame(s.id);
  aimAt(s, {
    ...cueOf(s),
    theta: 0,
    ...(play.played?.begin ?? { speed: 4, phi: 62, a: 0, b: 0 }),
    ...(setup.at === undefined ? {} : { speed: 2, phi: 90 }),
  });
  if (setup.at === undefined && !play.practice) void aimLegally(s);
  const isUnfinished = isKept && !left.play.isOver;
  const note = isUnfinished ? texts.theGameBeforeIs : "";
  says(s, wordsOfStart(play, s.training) + note);
  save(s);
  s.showing.rest();
}

/** Resumes a game that was read, for one of both seats. */
function goOn(s: Session, play: Play, id: string, seat: 0 | 1, isLink: boolean): void {
  start(s, play, id, seat);
  const begins = play.breaks || play.practice;
  aimAt(s, {
    ...cueOf(s),
    theta: 0,
    ...(begins ? play.played?.begin : { speed: SPEED_AFTER_BREAK }),
  });
  save(s);
  s.link.ask();
  const { strokes } = play;
  says(s, isLink && strokes > 0 ? texts.strokesRepeated(strokes) : "");
  if (isLink && play.last?.shot && mine(s)) s.showing.perform(play.last, () => next(s));
  else next(s);
}

/** Resumes a game that was read from a file, with a new id. */
export function goOnWith(s: Session, play: Play): void {
  const id = newId();
  void holdGame(id);
  goOn(s, play, id, 0, false);
}
/** Opens a game that is kept. Throws where it is damaged or open in another tab. */
export async function openGame(s: Session, id: string): Promise<void> {
  const saved = await savedGame(id);
  if (!saved) throw new TypeError(texts.thatGameIsNo);
  const play = read(s.carom, saved.text);
  // Two pages of one machine may play both sides of a game by link: they hear of each stroke.
  if (saved.setup.against !== "link" && !(await holdGame(id)))
    throw new TypeError(texts.thatGameIsOpen);
  goOn(s, play, id, id === idOfLink(saved.setup, 1) ? 1 : 0, false);
}
/** Opens the game of a link to be watched, as one of two players at this page. */
async function watchLink(s: Session, packed: string): Promise<void> {
  const { setup, lines } = read(s.carom, await unpack(packed));
  const text = JSON.stringify({ ...setup, against: "person", lines });
  goOnWith(s, read(s.carom, text));
  s.watching.enter();
}
/** Opens the game of a link, under the id of the link or a new one. */
async function openLink(s: Session, packed: string, seat: 0 | 1): Promise<void> {
  const play = read(s.carom, await unpack(packed));
  const id = play.setup.against === "link" ? idOfLink(play.setup, seat) : newId();
  await holdGame(id);
  goOn(s, play, id, seat, true);
}

/** Which saved data other than games was damaged. */
function wordsOfDamage(): string {
  if (damaged.size === 0) return "";
  const keys = [...damaged].map((key) => key.replace("carom-", ""));
  return texts.whatThisBrowserHad(keys.join(", "));
}
/** The game of the address, the one that this tab had open or that was saved last, or a new one. */
export async function resume(s: Session): Promise<void> {
  const query = parameters();
  const packed = query.get("g");
  const ways = [
    takeOver,
    async () => packed && query.has("watch") && watchLink(s, packed),
    async () => packed && openLink(s, packed, query.get("seat") === "1" ? 1 : 0),
    async () => {
      const id = idOfTab() ?? (await listedGames())[0]?.id;
      if (id !== undefined) await openGame(s, id);
    },
  ];
  let failure = "";
  for (const way of ways)
    try {
      if (s.id === "") await way();
    } catch (error) {
      failure += texts.theGameWasNotOpened(wrong(error));
    }
  if (s.id === "") begin(s, { ...FIRST, seed: Math.floor(Math.random() * 2 ** 31) });
  const message = failure || s.words.message.textContent!;
  if (failure || damaged.size > 0) says(s, message.trim() + wordsOfDamage());
}
