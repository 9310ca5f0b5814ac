// The dialog of a new game: which game, against whom, and the settings.
import { words } from "carom";
import { GAMES, hasMember, PLAYED, POOL_TABLE_NAMES, SEATS } from "../table/games.js";
import { percent, RATINGS } from "../table/words.js";
import { button, check, choice, dialog, el } from "../ui.js";
import { CLOCKS } from "./clock.js";
import { calibrationPage, ownCushion, wordsOfCushion } from "./calibration.js";
import { type Against, isComputer, tableOf } from "./game.js";
import { keepText, keptValue } from "./keep.js";
import type { Session, Settings } from "./parts.js";
import { gamesList } from "./games_list.js";
import { levels, wordsOfRung } from "./ladder.js";
import { rackPicture } from "./marks.js";
import { begin } from "./opening.js";
import { chooseLanguage, language, LANGUAGE_NAMES, texts, translate } from "../texts/texts.js";

const KEY = "carom-settings";
/** Games of the race whose odds are shown. */
const RACE = 7;
const LINES: readonly (readonly [Settings["lines"], string])[] = [
  ["level", texts.byYourRating],
  ["none", texts.none],
  ["short", texts.shortTheWayOf],
  ["full", texts.fullBothBalls],
];
const VIEWS: readonly (readonly [Settings["view"], string])[] = [
  ["device", texts.asTheDeviceAllows],
  ["scene", texts.litScene],
  ["drawn", texts.plainDrawing],
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
    pull = true,
    view = "device",
  } = value as Partial<Settings>;
  const isKnown = LINES.some(([name]) => name === lines) && VIEWS.some(([name]) => name === view);
  return isKnown && [sound, coach, numbers, pull].every((flag) => typeof flag === "boolean");
}
/** The settings that the browser has kept. Sound is on after the first touch, unless it was muted. */
export const settingsOf = (): Settings => ({
  lines: "level",
  sound: true,
  coach: false,
  numbers: false,
  pull: true,
  view: "device",
  ...keptValue<Partial<Settings>>(KEY, {}, areSettings),
});

export const keepSettings = ({ settings }: Pick<Session, "settings">): void =>
  keepText(JSON.stringify(settings), KEY);

/** How many racks a race may go to; the first is no race. */
const RACES = ["1", "2", "3", "5", "7"];

/** A card for an option of a select: a press chooses it. */
function cardOf(
  select: HTMLSelectElement,
  value: string,
  title: string,
  more: string,
  image?: HTMLElement,
): HTMLButtonElement {
  const choose = (): void => {
    select.value = value;
    select.dispatchEvent(new Event("change"));
  };
  const card = button("", choose, ".card", { value });
  card.append(...(image ? [image] : []), el("span", el("b", title), el("small", more)));
  return card;
}
/** Marks the card of the option that is chosen. */
const markCard = (cards: HTMLElement, chosen: string): void =>
  cards
    .querySelectorAll("button")
    .forEach((card) => card.setAttribute("aria-pressed", String(card.value === chosen)));
/** A choice represented by cards, which are what the player sees and a screen reader announces. */
function hide({ root, select }: ReturnType<typeof choice>): HTMLElement {
  root.classList.add("behind");
  root.setAttribute("aria-hidden", "true");
  select.tabIndex = -1;
  return root;
}
const STARS = 3;
/** The levels of a game's ladder: a star for each game won, up to those that climb it. */
const rungsOf = (select: HTMLSelectElement, game: string): HTMLElement[] =>
  levels(game).map((level) => {
    const { rating, needed } = level;
    const stars = "★".repeat(STARS - needed) + "☆".repeat(needed);
    const rung = cardOf(select, rating, rating, stars);
    rung.title = wordsOfRung(level);
    return el("li", rung);
  });

/** How an opponent of a rating plays, and how likely one wins by one's own rating against one. */
function wordsOfOpponent(s: Session, against: string, kind: string, isDuel: boolean): string {
  const { rating, words } = s.training.rating(kind);
  if (!isDuel) return texts.theComputerPlaysLike(against, words);
  const { game, match } = s.carom.odds({ ratings: [rating, Number(against)], games: RACE });
  return `${texts.theComputerPlaysLike(against, words)} ${texts.youWinOf(percent(game), percent(match), RACE)}`;
}

export function menu(
  s: Session,
  ...rest: HTMLElement[]
): { root: HTMLDialogElement; calibration: HTMLDialogElement; open(): void } {
  // Practice has every table.
  const tables = Object.entries(GAMES).filter(([key]) => !(key in PLAYED));
  const game = choice(
    "new-which",
    texts.game,
    [...Object.entries(PLAYED), ...tables].map(
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
  const seats = choice(
    "new-seats",
    texts.seats,
    [2, 3, 4, 5].map((count) => [String(count), texts.seatsCounted(count)] as const),
    describe,
  );
  /** Offers the numbers of seats of a game that each plays for itself, of which none is by link. */
  function offerSeats(): void {
    const counts = SEATS[game.select.value] ?? [];
    const hasSeats = counts.length > 0;
    for (const option of seats.select.options) {
      option.disabled = !counts.includes(Number(option.value));
      option.hidden = option.disabled;
    }
    if (hasSeats && seats.select.selectedOptions[0]?.disabled !== false)
      seats.select.value = String(counts[0]);
    for (const card of others.querySelectorAll("button"))
      card.hidden = hasSeats && card.value === "link";
    if (hasSeats && against.select.value === "link") against.select.value = "person";
    seats.root.hidden = !hasSeats || against.select.value === "practice";
  }
  const equal = check("new-equal", texts.equalInnings, () => undefined);
  const clock = choice(
    "new-clock",
    texts.shotClock,
    CLOCKS.map((time) => [time, time === "0" ? texts.none : texts.seconds(time)] as const),
    () => undefined,
  );
  const gameCards = el(
    "div.cards",
    ...Array.from(game.select.options, ({ value, text }) =>
      cardOf(game.select, value, text, texts.cards[value] ?? "", rackPicture(s.carom, value)),
    ),
  );
  const ladder = el("ol#ladder", { "aria-label": texts.ladder });
  const others = el(
    "div.cards",
    ...["practice", "person", "link"].map((value) => {
      const { text } = Array.from(against.select.options).find((one) => one.value === value)!;
      return cardOf(against.select, value, text, "");
    }),
  );
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
  /** The cushions to choose from, with the calibrated ones of the player's table. */
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
  /** Strokes against the page's player have slight errors by default. */
  function chooseErrors(): void {
    errors.select.value = isComputer(against.select.value as Against) ? "800" : "0";
    describe();
  }
  function changeSettings(): void {
    Object.assign(s.settings, {
      lines: lines.select.value,
      coach: coach.input.checked,
      numbers: numbers.input.checked,
      pull: pull.input.checked,
      view: view.select.value,
    });
    keepSettings(s);
    void s.space.prepare();
    s.changed();
  }
  const view = choice("table-view", texts.viewOfTheTable, VIEWS, changeSettings);
  const coach = check("coach", texts.coachShowsTheChances, changeSettings);
  const numbers = check("numbers", texts.lettersOnTheBalls, changeSettings);
  const pull = check("pull-plays", texts.pullPlays, changeSettings);
  const speech = choice("language", texts.language, LANGUAGE_NAMES, () =>
    chooseLanguage(speech.select.value),
  );
  speech.select.value = language;
  lines.select.value = s.settings.lines;
  coach.input.checked = s.settings.coach;
  numbers.input.checked = s.settings.numbers;
  pull.input.checked = s.settings.pull;
  view.select.value = s.settings.view;

  const knowsInnings = (): boolean => {
    const rules = PLAYED[game.select.value]?.rules;
    return rules !== undefined && hasMember(rules, "innings");
  };
  const isPool = (): boolean =>
    GAMES[PLAYED[game.select.value]?.base ?? game.select.value]!.table === "9ft";
  function showRungs(): void {
    ladder.dataset.game = game.select.value;
    ladder.replaceChildren(...rungsOf(against.select, game.select.value));
  }
  function describe(): void {
    if (!(game.select.value in PLAYED)) against.select.value = "practice";
    offerSeats();
    errors.root.hidden = against.select.value === "practice";
    const isHere = !["practice", "link"].includes(against.select.value);
    for (const control of [race, clock]) control.root.hidden = !isHere;
    race.root.hidden ||= !seats.root.hidden;
    equal.root.hidden = against.select.value === "practice" || !knowsInnings();
    markCard(gameCards, game.select.value);
    if (ladder.dataset.game !== game.select.value) showRungs();
    for (const cards of [ladder, others]) markCard(cards, against.select.value);
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
    const isDuel = seats.root.hidden || seats.select.value === "2";
    note.textContent = notes[rival] ?? wordsOfOpponent(s, rival, game.select.value, isDuel);
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
        ...(!seats.root.hidden && { seats: Number(seats.select.value) }),
        ...(!equal.root.hidden && equal.input.checked && { equalInnings: true }),
        ...(!clock.root.hidden &&
          clock.select.value !== CLOCKS[0] && { clock: Number(clock.select.value) }),
      });
    },
    "#start.main",
  );
  const games = gamesList(s, () => root.close());
  const fold = el(
    "div.fields.fold",
    seats.root,
    errors.root,
    race.root,
    clock.root,
    equal.root,
    ...ofPool,
    rulesOf,
  );
  const more = button(
    texts.more,
    () => {
      const isOpen = fold.classList.toggle("open");
      more.setAttribute("aria-expanded", String(isOpen));
      if (isOpen) fold.scrollIntoView({ block: "center" });
    },
    "#new-more",
    { "aria-expanded": "false" },
  );
  const root: HTMLDialogElement = dialog(
    "menu",
    texts.newGame,
    el("h3", texts.against),
    hide(against),
    ladder,
    others,
    note,
    el("h3", texts.game),
    hide(game),
    gameCards,
    fold,
    el("div.row.begin", more, start),
    games.root,
    el("h3", texts.settings),
    speech.root,
    lines.root,
    coach.root,
    numbers.root,
    pull.root,
    view.root,
    el("div.row", el("span", texts.speedOfTheFilm), s.film.pace),
    ...rest,
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
      seats.select.value = String(setup.seats ?? 2);
      equal.input.checked = setup.equalInnings ?? false;
      clock.select.value = String(setup.clock ?? CLOCKS[0]);
      table.select.value = setup.table ?? "9ft";
      cloth.select.value = setup.cloth ?? USUAL;
      listCushions(setup.cushion ?? USUAL);
      showRungs();
      describe();
      void games.refresh();
      root.showModal();
    },
  };
}
