// What practice offers in addition to a table: drills with counts, and a table from a photo. Both
// are sections of the dialog of a new game.
import type { AimOf, Carom, Table } from "carom";
import { button, choice, el } from "../ui.js";
import { atOf, drillsOf, judge } from "./drills.js";
import { errors } from "./coaching.js";
import type { Setup } from "./game.js";
import { count, countsOf } from "./keep.js";
import { DRILLS_MADE as KEY, ownRating, starsOf } from "./ladder.js";
import { keepRow, type Row } from "./log.js";
import type { Training } from "./parts.js";
import { texts, translate } from "../texts/texts.js";

declare const DRILLS: string;

const BALLS = 16;
/** The balls of a photo. */
const NAMES = Array.from({ length: BALLS }, (_, k) => (k === 0 ? "cue" : String(k)));
const SIZE = [1.27, 2.54] as const;
/**
 * Practice with the balls of eight-ball. Strokes of a drill, which count for the rating, err as
 * those of a game do.
 */
const setupOf = (places: string, drill?: string): Setup => ({
  game: "eightball",
  against: "practice",
  own: "0",
  seed: 1,
  at: places,
  ...(drill === undefined ? {} : { drill, own: "800", seed: Math.floor(Math.random() * 2 ** 31) }),
});

/** The pockets that a ball of a drill may fall into: the one of its goal, or else every pocket. */
function pocketsFor(ball: string | undefined, goal: string | undefined, table: Table) {
  if (!ball) return [];
  return goal ? [goal] : [...table.pockets.keys()];
}
/** What would have made the pot: a turn of the aim, and another speed. */
function wordsOfChange({ phi = 0, speed = 0 }: Pick<Row, "phi" | "speed">): string {
  const side = phi > 0 ? texts.toTheRight : texts.toTheLeft;
  const turn = Math.abs(phi) >= 0.05 ? texts.turnTheAimTo(Math.abs(phi).toFixed(2), side) : "";
  const force = speed > 0 ? texts.softer : texts.faster;
  return speed === 0 ? turn : texts.strikeMS(turn, Math.abs(speed).toFixed(1), force);
}

export function practice(carom: Carom, begin: (setup: Setup) => void): Training {
  const drills = drillsOf(DRILLS);
  const drillOf = (name: string): (typeof drills)[number] => {
    const drill = drills.find((drill) => drill.name === name);
    if (!drill) throw new TypeError(texts.drillThereIsNo(name));
    return drill;
  };
  const note = el("p#drill-note.note");
  const drillChoice = choice(
    "drill",
    texts.drill,
    drills.map(({ name }) => [name, translate(name)] as const),
    describe,
  );
  /** Stars of each drill; one that nobody has tried has a dash. */
  function listStars(): void {
    for (const option of drillChoice.select.options) {
      const [good, tries] = countsOf(KEY, option.value);
      const stars = starsOf(good, tries);
      const shown = tries === 0 ? "–" : "★".repeat(stars) + "☆".repeat(3 - stars);
      option.textContent = `${translate(option.value)} ${shown}`;
    }
  }
  function wordsOfTries(name: string): string {
    const [good, tries] = countsOf(KEY, name);
    return tries === 0 ? "" : texts.madeOf(good, tries);
  }
  function describe(): void {
    listStars();
    note.textContent = `${translate(drillOf(drillChoice.select.value).text)}${wordsOfTries(drillChoice.select.value)}`;
  }
  const close = (): void => start.closest("dialog")!.close();
  const start: HTMLButtonElement = button(
    texts.startDrill,
    () => {
      close();
      begin(setupOf(atOf(drillOf(drillChoice.select.value), BALLS), drillChoice.select.value));
    },
    "#start-drill",
  );
  let photo: { open(): void } | undefined;
  async function openPhoto(): Promise<void> {
    const { photoPage } = await import("./photo_page.js");
    if (!photo) {
      const page = photoPage({ names: NAMES, size: SIZE, use: layPhoto });
      start.closest("dialog")!.after(page.root);
      photo = page;
    }
    close();
    photo.open();
  }
  function layPhoto(balls: ReadonlyMap<number, readonly number[]>): void {
    const places = NAMES.map((_, k) => {
      const unseen = k === 0 ? "0.635,0.635" : "in";
      return (
        balls
          .get(k)
          ?.map((x) => x.toFixed(4))
          .join(",") ?? unseen
      );
    });
    begin(setupOf(places.join(" ")));
  }
  describe();
  return {
    parts: [
      el("h3", texts.practice),
      el("div.fields", drillChoice.root),
      note,
      el(
        "div.row",
        start,
        button(texts.aTableFromA, () => void openPhoto(), "#open-photo"),
      ),
    ],
    rating: (game) => ownRating(carom, drills, game),
    drill: drillOf,
    wordsOfStart: (name) =>
      texts.itCountsForYour(translate(drillOf(name).text), wordsOfTries(name)),
    /** What to practise next: what was made least, beside how often one's rating makes it. */
    plan() {
      const { rating } = ownRating(carom, drills);
      const rows = drills.map((drill) => {
        const [good, tries] = countsOf(KEY, drill.name);
        return {
          text: `${translate(drill.name)} (${tries ? texts.ofTries(good, tries) : texts.notTried})`,
          surplus: (good + 1) / (tries + 2) - 1 / (1 + 2 ** ((drill.rating - rating) / 100)),
        };
      });
      return texts.practiseNext(
        rows
          .sort((a, b) => a.surplus - b.surplus)
          .slice(0, 3)
          .map(({ text }) => text)
          .join(", "),
      );
    },
    played(name, { shot, cue, balls }, isOwn) {
      const { goal, text } = drillOf(name);
      const { outcome, failed, why } = judge(drillOf(name), shot!);
      // The aim at the ball that was to fall, in the pocket that it was nearest to.
      const value = (word: string): string | undefined =>
        goal.find((part) => part[0] === word)?.[1];
      const [ball, into] = (value("pot") ?? "").split("@");
      const way = {
        ball: Number(ball),
        ...(value("first") && value("first") !== ball ? { via: [Number(value("first"))] } : {}),
      };
      const [off = {}] = pocketsFor(ball, into, shot!.table)
        .map((pocket) => errors(carom, shot!.table, balls, cue, { ...way, pocket } as AimOf))
        .filter(({ phi }) => phi !== undefined)
        .sort((a, b) => Math.abs(a.phi!) - Math.abs(b.phi!));
      const change = failed.includes("pot") ? wordsOfChange(off) : "";
      const review = outcome === "missed" ? ` ${why.join(" ")}${change}` : "";
      if (isOwn)
        keepRow({
          when: new Date().toISOString().slice(0, 16),
          game: name,
          meant: text,
          ...off,
          side: -cue.a || 0,
          best: outcome === "missed" ? review.trim() : texts.made,
        });
      if (outcome === "on") return { text: texts.goOnWithThe, repeats: false };
      const word = outcome === "made" ? texts.madeWord : texts.missed;
      if (!isOwn) return { text: texts.hintedTry(word), repeats: true };
      const [good, tries] = count(KEY, name, [Number(outcome === "made"), 1]);
      describe();
      return { text: texts.outcomeOf(word, good, tries, review), repeats: true };
    },
  };
}
