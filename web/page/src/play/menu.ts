// The dialog of a new game: which one, against whom, and how the page plays it.
import { words } from "carom";
import { GAMES, hasMember, PLAYED, POOL_TABLE_NAMES } from "../table/games.js";
import { percent, RATINGS } from "../table/words.js";
import { button, check, choice, dialog, el } from "../ui.js";
import { CLOCKS } from "./clock.js";
import { calibrationPage, ownCushion, wordsOfCushion } from "./calibration.js";
import { type Against, isComputer, tableOf } from "./game.js";
import { keepText, keptValue } from "./keep.js";
import type { Session, Settings } from "./parts.js";
import { gamesList } from "./games_list.js";
import { levels, wordsOfRung } from "./ladder.js";
import { begin } from "./opening.js";
import { chooseLanguage, language, LANGUAGE_NAMES, texts, translate } from "../texts/texts.js";

const KEY = "carom-settings";
/** Games of the race whose odds are told. */
const RACE = 7;
const LINES: readonly (readonly [Settings["lines"], string])[] = [
  ["level", texts.byYourRating],
  ["none", texts.none],
  ["short", texts.shortTheWayOf],
  ["full", texts.fullBothBalls],
];
/** Conditions of a pool table, each with what it does; the usual one, which a game does not keep. */
const USUAL = "";
const conditionsOf = (part: string): (readonly [string, string])[] =>
  words.condition.filter(([word]) => word.endsWith(part) && word !== "medium_cloth");
const nameOfCondition = (word: string): string => translate(word.split("_")[0]!);
const choicesOf = (conditions: readonly (readonly [string, string])[]) => [
  [USUAL, texts.usual] as const,
  ...conditions.map(([word]) => [word, nameOfCondition(word)] as const),
];
const CONDITIONS = [...conditionsOf("_cloth"), ...conditionsOf("_cushion")];
const CLOTHS = choicesOf(conditionsOf("_cloth"));
const CUSHIONS = choicesOf(conditionsOf("_cushion"));
function areSettings(value: unknown): boolean {
  if (typeof value !== "object" || value === null) return false;
  const {
    lines = "level",
    sound = true,
    coach = true,
    numbers = true,
  } = value as Partial<Settings>;
  const isKnown = LINES.some(([name]) => name === lines);
  return isKnown && [sound, coach, numbers].every((flag) => typeof flag === "boolean");
}
/** The settings that the browser has kept. Sound is on after the first touch, unless it was muted. */
export const settingsOf = (): Settings => ({
  lines: "level",
  sound: true,
  coach: false,
  numbers: false,
  ...keptValue<Partial<Settings>>(KEY, {}, areSettings),
});

export const keepSettings = ({ settings }: Pick<Session, "settings">): void =>
  keepText(JSON.stringify(settings), KEY);

/** How many racks a race may go to; the first is no race. */
const RACES = ["1", "2", "3", "5", "7"];

/** The levels of the ladder, each of which chooses its opponent. */
function ladderOf(choose: (rating: string) => void): {
  root: HTMLElement;
  mark(chosen: string, game: string): void;
} {
  const root = el("ol#ladder", { "aria-label": texts.ladder });
  /** Shows how far one has climbed, and which opponent is chosen. */
  function mark(chosen: string, game: string): void {
    const rungs = levels(game).map((level) => {
      const { rating, won, lost, needed } = level;
      const games = won + lost > 0 ? `${won} : ${lost}` : "–";
      const stands = needed === 0 ? "★" : games;
      const rung = button(rating, () => choose(rating), "", {
        "aria-pressed": String(rating === chosen),
        title: wordsOfRung(level),
      });
      rung.append(el("small", stands));
      return el("li", rung);
    });
    root.replaceChildren(...rungs);
  }
  return { root, mark };
}

/** How an opponent of a rating plays, and how likely one wins by one's own rating. */
function wordsOfOpponent(s: Session, against: string, kind: string): string {
  const { rating, words } = s.training.rating(kind);
  const { game, match } = s.carom.odds({ ratings: [rating, Number(against)], games: RACE });
  return `${texts.theComputerPlaysLike(against, words)} ${texts.youWinOf(percent(game), percent(match), RACE)}`;
}

export function menu(
  s: Session,
  ...more: HTMLElement[]
): { root: HTMLDialogElement; calibration: HTMLDialogElement; open(): void } {
  // Practice has every table.
  const others = Object.entries(GAMES).filter(([key]) => !(key in PLAYED));
  const game = choice(
    "new-which",
    texts.game,
    [...Object.entries(PLAYED), ...others].map(
      ([key, { text }]) => [key, key in PLAYED ? text : texts.practiceOf(text)] as const,
    ),
    describe,
  );
  const against = choice(
    "new-against",
    texts.against,
    [
      ["practice", texts.nobodyPractice],
      ["person", texts.aPersonAtThis],
      ["link", texts.aPersonByLink],
      ...RATINGS.map((r) => [r, texts.theComputerA(r)] as const),
    ],
    chooseErrors,
  );
  const race = choice(
    "new-race",
    texts.race,
    RACES.map((racks) => [racks, racks === "1" ? texts.oneRack : texts.raceTo(racks)] as const),
    () => undefined,
  );
  const equal = check("new-equal", texts.equalInnings, () => undefined);
  const clock = choice(
    "new-clock",
    texts.shotClock,
    CLOCKS.map((time) => [time, time === "0" ? texts.none : texts.seconds(time)] as const),
    () => undefined,
  );
  const ladder = ladderOf((rating) => {
    against.select.value = rating;
    chooseErrors();
  });
  const errors = choice(
    "new-own",
    texts.yourStrokes,
    [
      ["0", texts.goWhereYouAim],
      ...RATINGS.map((r) => [r, r === "800" ? texts.errALittleLike : texts.errLikeA(r)] as const),
    ],
    () => undefined,
  );
  const table = choice("new-table", texts.table, POOL_TABLE_NAMES, () => undefined);
  const cloth = choice("new-cloth", texts.cloth, CLOTHS, describe);
  const cushion = choice("new-cushion", texts.cushions, [], describe);
  const effect = el("p#new-effect.note");
  /** The cushions to choose from: those of the player's own table are calibrated. */
  function listCushions(chosen: string): void {
    const pair = ownCushion();
    const options = [
      ...CUSHIONS,
      ...(pair === undefined ? [] : [[pair, texts.mine(wordsOfCushion(pair))] as const]),
    ];
    const isListed = options.some(([value]) => value === chosen);
    if (!isListed) options.push([chosen, wordsOfCushion(chosen)]);
    cushion.select.replaceChildren(
      ...options.map(([value, text]) => el("option", { value }, text)),
    );
    cushion.select.value = chosen;
  }
  const calibration = calibrationPage(s.carom, (pair) => {
    listCushions(pair);
    root.showModal();
  });
  const calibrate = button(
    texts.calibrateByBanks,
    () => {
      root.close();
      calibration.open(table.select.value);
    },
    "#open-calibration",
  );
  const ofPool = [table.root, cloth.root, cushion.root, effect, calibrate];
  const lines = choice("lines", texts.lines, LINES, changeSettings);
  const note = el("p#new-note.note");
  const rules = el("p#new-rules");
  const rulesOf = el("details", el("summary", texts.theRules), rules);
  /** Strokes against the page's player err a little, if nothing else is chosen. */
  function chooseErrors(): void {
    errors.select.value = isComputer(against.select.value as Against) ? "800" : "0";
    describe();
  }
  function changeSettings(): void {
    Object.assign(s.settings, {
      lines: lines.select.value,
      coach: coach.input.checked,
      numbers: numbers.input.checked,
    });
    keepSettings(s);
    s.changed();
  }
  const coach = check("coach", texts.coachShowsTheChances, changeSettings);
  const numbers = check("numbers", texts.lettersOnTheBalls, changeSettings);
  const speech = choice("language", texts.language, LANGUAGE_NAMES, () =>
    chooseLanguage(speech.select.value),
  );
  speech.select.value = language;
  lines.select.value = s.settings.lines;
  coach.input.checked = s.settings.coach;
  numbers.input.checked = s.settings.numbers;

  const knowsInnings = (): boolean => {
    const rules = PLAYED[game.select.value]?.rules;
    return rules !== undefined && hasMember(rules, "innings");
  };
  const isPool = (): boolean =>
    GAMES[PLAYED[game.select.value]?.base ?? game.select.value]!.table === "9ft";
  function describe(): void {
    if (!(game.select.value in PLAYED)) against.select.value = "practice";
    errors.root.hidden = against.select.value === "practice";
    const isHere = !["practice", "link"].includes(against.select.value);
    for (const control of [race, clock]) control.root.hidden = !isHere;
    equal.root.hidden = against.select.value === "practice" || !knowsInnings();
    ladder.mark(against.select.value, game.select.value);
    rules.textContent = texts.rules[game.select.value] ?? "";
    rulesOf.hidden = rules.textContent === "";
    for (const control of ofPool) control.hidden = !isPool();
    effect.textContent = CONDITIONS.filter(([word]) =>
      [cloth.select.value, cushion.select.value].includes(word),
    )
      .map(([word, does]) => texts.conditionDoes(nameOfCondition(word), translate(does)))
      .join(" ");
    const notes: Record<string, string> = {
      practice: texts.thereAreNoRules,
      person: texts.bothOfYouPlay,
      link: texts.youBreakSendThe,
    };
    const rival = against.select.value;
    note.textContent = notes[rival] ?? wordsOfOpponent(s, rival, game.select.value);
  }
  const chosenTable = (): ReturnType<typeof tableOf> =>
    tableOf({
      ...(table.select.value !== "9ft" && { table: table.select.value }),
      ...(cloth.select.value !== USUAL && { cloth: cloth.select.value }),
      ...(cushion.select.value !== USUAL && { cushion: cushion.select.value }),
    });
  const start = button(
    texts.start,
    () => {
      root.close();
      begin(s, {
        game: game.select.value,
        against: against.select.value as Against,
        own: against.select.value === "practice" ? "0" : errors.select.value,
        seed: Math.floor(Math.random() * 2 ** 31),
        ...(isPool() ? chosenTable() : {}),
        ...(race.root.hidden || race.select.value === RACES[0]
          ? {}
          : { race: Number(race.select.value), racks: [0, 0] as const }),
        ...(!equal.root.hidden && equal.input.checked && { equalInnings: true }),
        ...(!clock.root.hidden &&
          clock.select.value !== CLOCKS[0] && { clock: Number(clock.select.value) }),
      });
    },
    "#start.main",
  );
  const games = gamesList(s, () => root.close());
  const root: HTMLDialogElement = dialog(
    "menu",
    texts.newGame,
    el("div.fields", game.root, ...ofPool, against.root),
    ladder.root,
    el("div.fields", errors.root, race.root, clock.root, equal.root),
    note,
    rulesOf,
    start,
    games.root,
    el("h3", texts.settings),
    speech.root,
    lines.root,
    coach.root,
    numbers.root,
    el("div.row", el("span", texts.speedOfTheFilm), s.film.pace),
    ...more,
  );
  return {
    root,
    calibration: calibration.root,
    open() {
      const { setup } = s.play;
      game.select.value = setup.game;
      against.select.value = setup.against;
      errors.select.value = setup.own;
      race.select.value = String(setup.race ?? RACES[0]);
      equal.input.checked = setup.equalInnings ?? false;
      clock.select.value = String(setup.clock ?? CLOCKS[0]);
      table.select.value = setup.table ?? "9ft";
      cloth.select.value = setup.cloth ?? USUAL;
      listCushions(setup.cushion ?? USUAL);
      describe();
      void games.refresh();
      root.showModal();
    },
  };
}
