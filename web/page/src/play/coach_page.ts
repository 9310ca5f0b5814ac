// The dialog of the coach: questions about this stroke, what the player misses, and match odds.
import { onTable } from "../table/filmed.js";
import { ballOf, percent, RATINGS } from "../table/words.js";
import { button, choice, dialog, el } from "../ui.js";
import { begin } from "./opening.js";
import type { Question, Session } from "./parts.js";
import { type Reviewed, reviewed } from "./reviews.js";
import { free, says } from "./session.js";
import { texts, translate } from "../texts/texts.js";

const GAMES_OF_SETS = ["1", "3", "5", "7", "9", "11"];
const SETS = ["1", "2", "3"];

/** The odds of a match against a rating, by one's own. */
function oddsPart(s: Session): { parts: HTMLElement[]; tell(): void } {
  const verdict = el("p#odds-said", { role: "status" });
  const pick = (
    id: string,
    text: string,
    values: readonly string[],
    words: (value: string) => string = String,
  ) =>
    choice(
      id,
      text,
      values.map((value) => [value, words(value)] as const),
      tell,
    );
  const against = pick("odds-against", texts.against, RATINGS);
  const games = pick("odds-games", texts.race, GAMES_OF_SETS, texts.to);
  const sets = pick("odds-sets", texts.setsOfMatch, SETS, texts.to);
  against.select.value = "500";
  games.select.value = "7";
  function tell(): void {
    const { rating, words } = s.training.rating(s.play.setup.game);
    const [rival, toGames, toSets] = [against, games, sets].map(({ select }) =>
      Number(select.value),
    ) as [number, number, number];
    const odds = s.carom.odds({ ratings: [rating, rival], games: toGames, sets: toSets });
    const [mine, theirs] = odds.fair as [number, number];
    const [game, match] = [odds.game, odds.match].map(percent) as [string, string];
    verdict.textContent = texts.oddsAgainst(words, rival, game, match, mine, theirs);
  }
  const fields = el("div.fields", against.root, games.root, sets.root);
  return { parts: [el("h3", texts.oddsOfMatch), fields, verdict], tell };
}

/** What one misses, by kinds of strokes. */
function reviewPart(practise: (row: Reviewed) => void): { parts: HTMLElement[]; fill(): void } {
  const note = el("p#review-note.note");
  const body = el("tbody");
  const head = [
    texts.kindOfStroke,
    texts.strokes,
    texts.keptOf,
    texts.expected,
    texts.missesCost,
    texts.placesCost,
    texts.practice,
  ];
  const table = el(
    "table#reviews.numbers.log",
    el("thead", el("tr", ...head.map((text) => el("th", { scope: "col" }, text)))),
    body,
  );
  function fill(): void {
    const rows = reviewed();
    table.hidden = rows.length === 0;
    note.textContent = table.hidden ? texts.noStrokeReviewed : texts.theMeansOf;
    body.replaceChildren(
      ...rows.map(([group, row]) => {
        const mean = (sum: number): string => percent(sum / row.strokes);
        const name = translate(group);
        const cells = [
          name,
          String(row.strokes),
          mean(row.successes),
          row.expected > 0 ? mean(row.expected) : "–",
          mean(row.missCost),
          mean(row.placeCost),
          button(texts.practiseIt, () => practise(row), "", {
            "aria-label": `${texts.practiseIt}: ${name}`,
          }),
        ];
        return el("tr", ...cells.map((cell, k) => el("td", { "data-head": head[k]! }, cell)));
      }),
    );
  }
  const region = { tabindex: "0", role: "region", "aria-label": texts.whatYouMiss };
  return { parts: [el("h3", texts.whatYouMiss), note, el("div.scrolls", region, table)], fill };
}

export function coachPage(s: Session): { root: HTMLDialogElement; open(): void } {
  /** A button that closes the dialog and asks the coach. */
  const asks = (text: string, id: string, ask: () => unknown): HTMLButtonElement =>
    button(
      text,
      () => {
        root.close();
        void ask();
      },
      `#${id}`,
    );
  const question = (options: Question["options"], words?: string): Promise<void> =>
    s.coach.advise({ options, ...(words !== undefined && { words }) });
  const safety = asks(texts.askSafety, "ask-safety", () => question({ safeties: true }));
  const hidden = asks(texts.askHidden, "ask-hidden", () =>
    question({ goal: { kind: "hidden" } }, texts.leavesItHidden),
  );
  const snookered = choice("snooker-on", texts.snookerOn, [], () => undefined);
  const snooker = asks(texts.askSnooker, "ask-snooker", () => {
    const ball = Number(snookered.select.value);
    return question(
      { goal: { kind: "snooker", ball } },
      texts.leavesSnooker(ballOf(s.play.names, ball)),
    );
  });
  const closeness = asks(texts.askNear, "ask-near", () => {
    s.asksPlace = true;
    says(s, texts.tapThePlace);
    s.film.canvas.focus();
  });
  const best = asks(texts.askBreak, "ask-break", () => s.coach.adviseBreak());
  const review = reviewPart(({ worst }) => {
    root.close();
    begin(s, worst.setup);
  });
  const odds = oddsPart(s);
  const root: HTMLDialogElement = dialog(
    "coach-page",
    texts.coach,
    el("h3", texts.askTheCoach),
    el("div.row", safety, hidden, closeness, best),
    el("div.row", snooker, snookered.root),
    ...review.parts,
    ...odds.parts,
  );
  /** Shows the questions that the game and the layout have an answer to. */
  function listQuestions(): void {
    const { balls, bounds, breaks, hasPockets, practice, strikable, names } = s.play;
    const isAtRest = free(s) && hasPockets && !breaks && s.play.setup.drill === undefined;
    closeness.hidden = !isAtRest;
    safety.hidden = !isAtRest || practice;
    for (const control of [hidden, snooker, snookered.root])
      control.hidden = safety.hidden || strikable.length > 1;
    best.hidden = !free(s) || !breaks || practice || s.play.state.opening !== true || !bounds;
    const targets = [...balls.keys()].filter((k) => k > 0 && onTable(balls[k]!.state));
    snookered.select.replaceChildren(
      ...targets.map((ball) => el("option", { value: String(ball) }, ballOf(names, ball))),
    );
  }
  return {
    root,
    open() {
      s.asksPlace = false;
      listQuestions();
      review.fill();
      odds.tell();
      root.showModal();
    },
  };
}
