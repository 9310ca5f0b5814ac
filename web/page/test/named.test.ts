// The words of each state of each rule set, in each language of the page, read as a referee would:
// the states are forced by the beginning of a match or by strokes that the referee has ruled.
import { type GameState, load, type MatchOptions, type ShotBall } from "carom";
import { describe, expect, test, vi } from "vitest";

const carom = await load();

type Modules = {
  game: typeof import("../src/play/game.js");
  games: typeof import("../src/table/games.js");
  named: typeof import("../src/play/named.js");
  state: typeof import("../src/play/state.js");
  words: typeof import("../src/table/words.js");
};
/** The page's modules in a language. */
async function modulesIn(language: string): Promise<Modules> {
  vi.resetModules();
  vi.stubGlobal("localStorage", { getItem: () => language });
  const modules = {
    game: await import("../src/play/game.js"),
    games: await import("../src/table/games.js"),
    named: await import("../src/play/named.js"),
    state: await import("../src/play/state.js"),
    words: await import("../src/table/words.js"),
  };
  vi.unstubAllGlobals();
  return modules;
}
const LANGUAGES = { en: await modulesIn("en"), de: await modulesIn("de") };
type Language = keyof typeof LANGUAGES;
type Play = InstanceType<Modules["game"]["Play"]>;
type Place = (m: Modules) => Play;

/** A new game of two at the page. */
const begun = (m: Modules, game: string, more: object = {}): Play =>
  new m.game.Play(carom, { game, against: "person", own: "0", seed: 4, ...more });
/** A game that begins with this state of the referee. */
function forced(
  m: Modules,
  game: string,
  state: Partial<GameState>,
  options: MatchOptions = {},
): Play {
  const play = begun(m, game);
  const beginning = { ...play.state, opening: false, ...state };
  const { lines } = carom.match(beginning, play.table, { balls: play.balls, ...options });
  const resumed = new m.game.Play(carom, play.setup, [...lines]);
  resumed.strokes = 1; // not the first stroke of a rack
  return resumed;
}
/** The game after a stroke. */
function after(play: Play, aim: object): Play {
  play.stroke({ ...play.cue, ball: play.cueBall, speed: 1, phi: 90, ...aim });
  return play;
}
/** The balls of a layout, without those of a set. */
const without = (balls: readonly ShotBall[], gone: (k: number) => boolean): ShotBall[] =>
  balls.map((ball, k) =>
    gone(k) ? { ...ball, state: { ...ball.state, label: "pocketed" } } : ball,
  ) as ShotBall[];

/** A state, how it comes about, and what is said of it: the turn, and the buttons. */
const STATES: readonly [
  name: string,
  place: Place,
  turn: Record<Language, string>,
  buttons: Record<Language, string[]>,
][] = [
  [
    "snooker: a red is on",
    (m) => forced(m, "snooker", {}),
    { en: "Player 1's turn, on a red.", de: "Spieler 1 ist dran, auf eine Rote." },
    { en: [], de: [] },
  ],
  [
    "snooker: a colour is on while reds are left",
    (m) => forced(m, "snooker", { on: 1 }),
    { en: "Player 1's turn, on a colour.", de: "Spieler 1 ist dran, auf eine Farbe." },
    { en: [], de: [] },
  ],
  [
    "snooker: the yellow is on",
    (m) => {
      const { balls } = begun(m, "snooker");
      return forced(m, "snooker", {}, { balls: without(balls, (k) => k > 0 && k < 16) });
    },
    { en: "Player 1's turn, on the yellow.", de: "Spieler 1 ist dran, auf die Gelbe." },
    { en: [], de: [] },
  ],
  [
    "snooker: a free ball",
    (m) => forced(m, "snooker", { may: ["pass", "free_ball"] }),
    {
      en: "Player 1's turn: free ball, any ball counts as a red.",
      de: "Spieler 1 ist dran: Freeball, jede Kugel zählt als eine Rote.",
    },
    { en: ["Play again"], de: ["Noch einmal spielen lassen"] },
  ],
  [
    "snooker: a miss",
    (m) => after(forced(m, "snooker", {}), { phi: 270, speed: 0.3 }),
    {
      en: "Player 1 fouls: no ball hit. Player 2's turn, on a red.",
      de: "Spieler 1 foult: keine Kugel getroffen. Spieler 2 ist dran, auf eine Rote.",
    },
    { en: ["Play again"], de: ["Noch einmal spielen lassen"] },
  ],
  [
    "nine-ball: a push-out may be played",
    (m) => forced(m, "nineball", { may: ["push"] }),
    { en: "Player 1's turn.", de: "Spieler 1 ist dran." },
    { en: [], de: [] },
  ],
  [
    "nine-ball: after a push-out",
    (m) => {
      const play = forced(m, "nineball", { may: ["push"] });
      play.stroke({ ...play.cue, ball: 0, speed: 0.5, phi: 270 }, "push");
      return play;
    },
    { en: "Player 2's turn.", de: "Spieler 2 ist dran." },
    { en: ["Give it back"], de: ["Zurückgeben"] },
  ],
  [
    "ten-ball: after a push-out",
    (m) => forced(m, "tenball", { may: ["pass"] }),
    { en: "Player 1's turn.", de: "Spieler 1 ist dran." },
    { en: ["Give it back"], de: ["Zurückgeben"] },
  ],
  [
    "nine-ball: two fouls in a row",
    (m) => forced(m, "nineball", { fouls: [2, 0] }),
    { en: "Player 1's turn, on two fouls.", de: "Spieler 1 ist dran, mit zwei Fouls in Folge." },
    { en: [], de: [] },
  ],
  [
    "nine-ball: the third foul",
    (m) => after(forced(m, "nineball", { fouls: [2, 0] }), { phi: 270, speed: 0.3 }),
    {
      en: "Player 2 has won: third foul in a row: no ball hit.",
      de: "Spieler 2 hat gewonnen: drittes Foul in Folge: keine Kugel getroffen.",
    },
    { en: [], de: [] },
  ],
  [
    "eight-ball: a bad break",
    (m) => after(begun(m, "eightball"), { speed: 0.8, phi: 90 }),
    {
      en:
        "Player 1 fouls: no pot on the break, and too few balls hit a cushion. " +
        "Player 2's turn, open table.",
      de:
        "Spieler 1 foult: beim Anstoß nichts versenkt und zu wenige Kugeln an Banden. " +
        "Spieler 2 ist dran, Tisch offen.",
    },
    {
      en: ["Re-rack and break", "Re-rack, opponent breaks"],
      de: ["Neu aufbauen und anstoßen", "Neu aufbauen, Gegner stößt an"],
    },
  ],
  [
    "straight pool: a bad break",
    (m) => after(begun(m, "straight"), { speed: 0.8, phi: 90 }),
    {
      en: "Player 1 fouls: no pot, and no cushion after contact. Player 2's turn.",
      de:
        "Spieler 1 foult: nichts versenkt, und keine Bande nach dem Kontakt. " +
        "Spieler 2 ist dran.",
    },
    {
      en: ["Re-rack, opponent breaks again"],
      de: ["Neu aufbauen, Gegner stößt wieder an"],
    },
  ],
  [
    "blackball: a free shot",
    (m) => forced(m, "blackball", { group: "solids", freeBall: 1, may: ["stay"] }),
    {
      en: "Player 1's turn, reds, free shot: any ball may be hit.",
      de: "Spieler 1 ist dran, Rote, freier Stoß: jede Kugel darf getroffen werden.",
    },
    { en: ["Leave it where it lies"], de: ["Liegen lassen"] },
  ],
  [
    "English billiards: double baulk",
    (m) => forced(m, "billiards", { on: 1 }),
    {
      en: "Player 1's turn, both balls in baulk: a miss is no foul.",
      de: "Spieler 1 ist dran, beide Bälle im Baulk: ein Fehlstoß ist kein Foul.",
    },
    { en: [], de: [] },
  ],
  [
    "English billiards: after a foul",
    (m) => forced(m, "billiards", { may: ["rack"] }),
    { en: "Player 1's turn.", de: "Spieler 1 ist dran." },
    { en: ["Spot the balls, play from the D"], de: ["Bälle aufsetzen, aus dem D spielen"] },
  ],
  [
    "three-cushion: touching balls",
    (m) => forced(m, "threecushion", { group: "solids", may: ["spot"] }),
    { en: "Player 1's turn.", de: "Spieler 1 ist dran." },
    { en: ["Spot the touching balls"], de: ["Berührende Kugeln aufsetzen"] },
  ],
  [
    "killer: the last life",
    (m) => forced(m, "killer", { user: [1, 3, 2] }, { seats: 3 }),
    { en: "Player 1's turn, last life.", de: "Spieler 1 ist dran, letztes Leben." },
    { en: [], de: [] },
  ],
  [
    "nine-ball: the time is over",
    (m) => {
      const play = forced(m, "nineball", {});
      play.clock();
      return play;
    },
    {
      en: "Player 1 fouls: time ran out. Player 2's turn. Ball in hand: drag the cue ball.",
      de:
        "Spieler 1 foult: die Zeit ist abgelaufen. Spieler 2 ist dran. " +
        "Ball in Hand: Ziehe den Spielball.",
    },
    { en: [], de: [] },
  ],
];

describe.each(Object.keys(LANGUAGES) as Language[])("the words of each state: %s", (language) => {
  const m = LANGUAGES[language];
  test.each(STATES)("%s", (_, place, turn, buttons) => {
    const play = place(m);
    expect(m.state.wordsOfTurn(play, 0, false)).toBe(turn[language]);
    const shown = m.named.BUTTONS.filter((choice) => play.acts.includes(choice));
    expect(shown.map((choice) => m.named.wordsOfChoice(play, choice).text)).toEqual(
      buttons[language],
    );
  });

  test("each choice that a game offers has a button and tells what was done", () => {
    for (const game of Object.keys(m.games.PLAYED)) {
      const play = begun(m, game);
      for (const choice of m.named.BUTTONS) {
        const { text, deed } = m.named.wordsOfChoice(play, choice);
        expect(text).not.toBe("");
        expect(deed("Anna")).toContain("Anna");
      }
    }
  });
});

test("the plate of a free ball promises what the referee scores", () => {
  const m = LANGUAGES.en;
  const play = forced(m, "snooker", { may: ["pass", "free_ball"] });
  expect(m.state.wordsOfTarget(play)).toBe("free ball: any ball counts as a red");
  expect(m.state.wordsOfTarget(forced(m, "snooker", { on: 1 }))).toBe("ball on: a colour");
});

test("a choice is deed as what it was, also from the lines of a game", () => {
  const m = LANGUAGES.en;
  const play = after(begun(m, "eightball"), { speed: 0.8 });
  play.choose("other_rack");
  expect(m.state.wordsOfStroke(play, play.last!, 0)).toBe("Player 2 let the opponent break again.");
  for (const text of [play.text(), play.shortText()]) {
    const again = m.game.read(carom, text);
    expect(again.last!.choice).toBe("other_rack");
  }
});

test("snooker's pockets have their names, and its reds no numbers", () => {
  const m = LANGUAGES.en;
  const { table, names } = begun(m, "snooker");
  const pockets = table.pockets.map((_, pocket) => m.words.wordsOfPocket(table, pocket));
  expect([...pockets].sort()).toEqual([
    "green pocket",
    "left black pocket",
    "left centre pocket",
    "right black pocket",
    "right centre pocket",
    "yellow pocket",
  ]);
  // The green spot is on the left of the D, as one sees it from baulk.
  const at = (name: string) => table.pockets[pockets.indexOf(name)]!.centre;
  expect(at("green pocket")[0]).toBeLessThan(at("yellow pocket")[0]);
  expect(at("green pocket")[1]).toBeLessThan(at("left black pocket")[1]);
  expect(m.words.ballOf(names, 13)).toBe("the red");
  expect(m.words.ballOf(names, 21)).toBe("the black");
  const pool = begun(m, "nineball");
  expect(m.words.wordsOfPocket(pool.table, 0)).toMatch(/^(head|side|foot)-(left|right) pocket$/);
});
