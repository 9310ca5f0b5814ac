// Shots from outside: lines of `carom shoot`, shots of recordings, and the aim at a pocket that was
// clicked.
import { fromLine, type Line, type Replayed, toLine } from "carom";
import { pocketName } from "../../../player/words.js";
import { GAMES, gameOf, type Read, TABLES } from "../table/games.js";
import { wrong } from "../ui.js";
import { aim, cueOf, type Desk, lay, optionsOf, says } from "./desk.js";
import { present } from "./shown.js";
import { texts, translate } from "../texts/texts.js";

export const lineOf = (d: Desk, id?: string): string =>
  toLine({
    ...(id !== undefined && { id }),
    tableName: d.game.table,
    balls: d.balls,
    cue: cueOf(d),
    names: d.names,
  });
export function importLine(d: Desk): void {
  try {
    const { name, also } = take(d, d.controls.line.value);
    d.aimed();
    if (also) says(d, texts.theBallsAreRead(GAMES[name]!.text, GAMES[also]!.text));
  } catch (error) {
    says(d, wrong(error));
  }
}
/** Sets up the balls and the aim of a line. Throws where the line cannot be read. */
export function take(d: Desk, text: string): Read<Line> {
  const read = fromLine(d.carom, text);
  const { ball } = read.cue;
  if (ball !== 0) throw new TypeError(texts.cueBallThisPage(ball));
  return use(d, gameOf(read, d.gameName));
}
function use<L extends Line>(d: Desk, read: Read<L>): Read<L> {
  const { balls, names, table, tableName, cue } = read.line;
  d.gameName = read.name;
  lay(d);
  Object.assign(d, {
    balls,
    names,
    table,
    imported: cue,
    game: { ...GAMES[d.gameName]!, table: tableName },
    faces: balls.map(() => 0),
    moved: true,
  });
  aim(d, cue);
  return read;
}
/**
 * A shot of a recording, which has neither names of balls nor of the table: they are those of the
 * game that it fits.
 */
export function showRecorded(d: Desk, replayed: Replayed, source: number): void {
  const same = JSON.stringify(replayed.table);
  const tableName = TABLES.find((name) => JSON.stringify(d.carom.table(name)) === same);
  const isGame = tableName !== undefined && tableName in GAMES;
  const poolGame = replayed.balls.length > 10 ? "eightball" : "nineball";
  const name = isGame ? tableName : poolGame;
  use(
    d,
    gameOf(
      {
        ...replayed,
        id: "",
        balls: [...replayed.balls],
        tableName: tableName ?? "9ft",
        names: replayed.balls.map((_, k) => GAMES[name]!.names(k)),
      },
      name,
    ),
  );
  d.builtIn = tableName !== undefined;
  present(d, cueOf(d), replayed);
  d.film.go(source);
}

/**
 * Aims so that a ball rolls to a pocket: the one that was picked, or else the one that is hit now.
 */
export function aimAt(d: Desk, pocket: number): void {
  const { names, table, balls } = d;
  const ball = d.chosen > 0 ? d.chosen : (d.shot?.firstContact?.ball ?? -1);
  const name = texts.ballIntoThe(names[ball], translate(pocketName(table, pocket)));
  if (ball < 0) return says(d, texts.whichBallClickIt);
  const pot = d.carom.aim(table, balls, cueOf(d), { ball, pocket }, optionsOf(d));
  const { outcome, met: contact } = pot;
  if (outcome === "no_way") return says(d, texts.noSuchAimNo(name));
  d.controls.set("phi", Math.round(pot.cue.phi * 1e4) / 1e4);
  d.aimed();
  const roller = names[contact?.a ?? 0];
  const obstacle = contact?.type === "ball_ball" ? names[contact.b] : texts.aCushion;
  const why = {
    falls: "",
    stick: texts.theStickWouldHave,
    rejected: texts.theJawsSendIt,
    short: texts.ballComesToRest(roller),
    barred: texts.ballMeets(roller, obstacle),
  }[outcome];
  const [low, high] = pot.speed.map((speed) => speed.toFixed(1));
  if (outcome !== "falls") says(d, texts.aimedButDoesNot(name, why));
  else
    says(
      d,
      texts.aimedTheCutIs(name, Math.abs(pot.cut).toFixed(1), pot.margin.toFixed(2), low, high),
    );
}
