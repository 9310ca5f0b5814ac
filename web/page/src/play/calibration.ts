// The dialog that finds the cushions of a player's pool table from three banks: a drawing of the
// banks, where each came back, and the two resulting constants, which the browser keeps and the
// player can save as a file.
import { type Carom, CaromError, type Table } from "carom";
import { POOL_TABLE_NAMES, POOL_TABLES } from "../table/games.js";
import { button, choice, dialog, el } from "../ui.js";
import { keepText, stored } from "./keep.js";
import { texts } from "../texts/texts.js";

/** Where the browser keeps the cushions of one's own table, as "restitution,friction". */
const KEY = "carom-cushion";
const BANKS = [0, 1, 2] as const;
const COLOURS = ["#1f6fb2", "#b2361f", "#2a7d3a"];
/** How far sights lie behind the noses, m. */
const SIGHT = 0.094;
/** A larger misfit means that a bank was misread. */
const MISREAD = 2;

export const ownCushion = (): string | undefined => stored(KEY);
/** The two constants of a cushion as text. */
export const wordsOfCushion = (pair: string): string => {
  const [restitution, friction] = pair.split(",");
  return texts.restitutionFriction(restitution!, friction!);
};

const soft = (roll: number): string => (roll > 0.5 ? texts.softSoThat : texts.hardAtItsMiddle);

/** The table lying on its side: the corner of the banks is on the left below. Units are m. */
function picture(carom: Carom, table: Table, back: readonly number[]): string {
  const { length, width } = table;
  const diamond = length / 8;
  const sights = Array.from({ length: 7 }, (_, k) => k + 1).map((k) =>
    [-SIGHT, width + SIGHT]
      .map(
        (y) =>
          `<circle cx="${k * diamond}" cy="${y}" r="0.014"/><text x="${k * diamond + 0.03}" y="${y + 0.035}">${k}</text>`,
      )
      .join(""),
  );
  const ways = BANKS.map((k) => {
    // The line runs from behind the corner to behind the other rail, through its sight.
    const share = (width + SIGHT) / (width + 2 * SIGHT);
    const hit = share * (carom.bank(k).aim * diamond + SIGHT) - SIGHT;
    const end = back[k]! * diamond;
    return (
      `<path d="M0 ${width}L${hit} 0L${end} ${width}" stroke="${COLOURS[k]}"/>` +
      `<text x="${end - 0.035}" y="${width - 0.06 - 0.09 * k}" style="fill:${COLOURS[k]}">${k + 1}</text>`
    );
  });
  return (
    `<svg viewBox="-0.05 -0.16 ${length + 0.1} ${width + 0.32}" role="img" aria-label="${texts.threeBanks}">` +
    `<rect width="${length}" height="${width}"/>${sights.join("")}${ways.join("")}</svg>`
  );
}

/** The dialog; `use` receives the constants that the player accepts, as `cushion` of a game. */
export function calibrationPage(
  carom: Carom,
  use: (pair: string) => void,
): { root: HTMLDialogElement; open(table: string): void } {
  const size = choice("calibration-table", texts.table, POOL_TABLE_NAMES, show);
  const drawn = el("div#calibration-picture");
  const outcomes = BANKS.map(() => el("span"));
  const inputs = BANKS.map((k) => {
    const input = el("input", {
      type: "number",
      id: `bank-${k + 1}`,
      min: "0.1",
      max: "7.9",
      step: "0.1",
      inputmode: "decimal",
    });
    input.addEventListener("input", find);
    return input;
  });
  const message = el("p#calibration-said", { role: "status" });
  let pair = "";
  let file = "";
  const play = button(
    texts.playOnThisTable,
    () => {
      keepText(pair, KEY);
      root.close();
      use(pair);
    },
    "#use-calibration.main",
  );
  const save = button(
    texts.saveForTheCommand,
    () => {
      const link = el("a", {
        href: URL.createObjectURL(new Blob([file], { type: "application/json" })),
        download: "my.json",
      });
      link.click();
      URL.revokeObjectURL(link.href);
    },
    "#save-calibration",
  );

  function allow(isFound: boolean): void {
    play.disabled = !isFound;
    save.disabled = !isFound;
  }
  const tableHere = (): Table => {
    const [, name, measures] = POOL_TABLES[size.select.value]!;
    return carom.table(name, measures);
  };
  function show(): void {
    const table = tableHere();
    const { comesBack } = carom.calibrate(undefined, table);
    drawn.innerHTML = picture(carom, table, comesBack);
    for (const k of BANKS) {
      const { aim, roll } = carom.bank(k);
      outcomes[k]!.textContent = texts.throughSight(
        aim.toFixed(1),
        soft(roll),
        comesBack[k]!.toFixed(1),
      );
    }
    find();
  }
  function find(): void {
    const readings = inputs.map((input) => input.valueAsNumber);
    const [a, b, c] = readings as [number, number, number];
    const isRead = readings.every((reading) => reading > 0 && reading < 8);
    allow(false);
    if (!isRead) {
      message.textContent = texts.enterTheSight;
      return;
    }
    try {
      const found = carom.calibrate([a, b, c], tableHere());
      const { restitution, restitutionError, friction, frictionError, misfit } = found;
      if (misfit > MISREAD) {
        message.textContent = texts.noCushionBrings((2.5 * misfit).toFixed(0));
        return;
      }
      pair = `${restitution.toFixed(3)},${friction.toFixed(3)}`;
      file = JSON.stringify({
        cushion_model: "smooth",
        constants: { restitution_cushion: restitution, mu_cushion: friction },
        spread: { restitution_cushion: restitutionError, mu_cushion: frictionError },
      });
      message.textContent = texts.yourCushions(
        restitution.toFixed(3),
        restitutionError.toFixed(3),
        friction.toFixed(3),
        frictionError.toFixed(3),
      );
      allow(true);
    } catch (error) {
      if (!(error instanceof CaromError)) throw error;
      message.textContent = texts.nothingIsFound(error.message);
    }
  }

  const root = dialog(
    "calibration",
    texts.calibrateByBanks,
    el("p.note", texts.putTheCueBall),
    el("div.fields", size.root),
    drawn,
    ...BANKS.map((k) =>
      el(
        "label.bank",
        { style: `--bank: ${COLOURS[k]}` },
        el("b", String(k + 1)),
        outcomes[k]!,
        inputs[k]!,
      ),
    ),
    message,
    el("div.row", play, save),
  );
  return {
    root,
    open(table) {
      size.select.value = table;
      show();
      root.showModal();
    },
  };
}
