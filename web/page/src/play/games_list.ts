// The list of saved games: the player resumes one, saves it as a file for `carom verify`, opens
// such a file, or deletes a game.
import { GAMES, PLAYED } from "../table/games.js";
import { button, el, wrong } from "../ui.js";
import { imported, recordingOf } from "./game.js";
import { countGame, isRated } from "./ladder.js";
import { goOnWith, openGame } from "./opening.js";
import type { Session } from "./parts.js";
import { deleteGame, type ListedGame, listedGames, type SavedGame, savedGame } from "./saved.js";
import { says } from "./session.js";
import { texts } from "../texts/texts.js";

const OPPONENTS: Record<string, string> = {
  practice: texts.practiceOpponent,
  person: texts.twoPlayersAtThis,
  link: texts.byLink,
};
function titleOf({ setup }: ListedGame): string {
  const game = (PLAYED[setup.game] ?? GAMES[setup.game])?.text ?? setup.game;
  return `${game}, ${OPPONENTS[setup.against] ?? texts.againstA(setup.against)}`;
}
function detailsOf({ when, strokes, score, isOver }: ListedGame): string {
  const date = new Date(when).toISOString().slice(0, 16).replace("T", " ");
  const count = texts.strokesCounted(strokes);
  return [date, count, score, isOver ? texts.over : ""].filter((part) => part !== "").join(" · ");
}
/** A game against a rating that is left for good counts as lost. */
const isLostByLeaving = (game: ListedGame): boolean =>
  isRated(game) && !game.isOver && game.strokes > 0;

function download(s: Session, { setup, text, when }: SavedGame): void {
  const recording = new Blob([recordingOf(s.carom, text)], { type: "application/jsonl" });
  const url = URL.createObjectURL(recording);
  const date = new Date(when).toISOString().slice(0, 10);
  el("a", { href: url, download: `carom-${setup.game}-${date}.jsonl` }).click();
  URL.revokeObjectURL(url);
}

export function gamesList(
  s: Session,
  close: () => void,
): { root: HTMLElement; refresh(): Promise<void> } {
  const list = el("ul#saved-games.saved");
  const file = el("input#open-game", { type: "file", accept: ".jsonl", hidden: "" });
  file.addEventListener("change", () => void openFile());
  const open = button(texts.openFile, () => file.click());
  const root = el("section", el("h3", texts.yourGames), list, open, file);

  async function goOn(game: ListedGame): Promise<void> {
    close();
    try {
      if (game.id !== s.id) await openGame(s, game.id);
    } catch (error) {
      says(s, texts.theGameWasNot(wrong(error)));
    }
  }
  /** A file that a page saved, or `carom match` wrote: two players at this page go on with it. */
  async function openFile(): Promise<void> {
    const [recording] = file.files!;
    if (!recording) return;
    close();
    try {
      goOnWith(s, imported(s.carom, await recording.text()));
    } catch (error) {
      says(s, texts.theGameWasNot(wrong(error)));
    }
    file.value = "";
  }
  /** The first press shows what the second one does. */
  function deleteButton(game: ListedGame): HTMLButtonElement {
    const question = isLostByLeaving(game) ? texts.deleteItCountsAs : texts.deleteForGood;
    const deletion = button(texts.deleteWord, async () => {
      if (deletion.textContent !== question) {
        deletion.textContent = question;
        return;
      }
      if (isLostByLeaving(game)) countGame(game, 1);
      await deleteGame(game.id);
      await refresh();
    });
    return deletion;
  }
  async function save({ id }: ListedGame): Promise<void> {
    try {
      const game = await savedGame(id);
      if (!game) throw new TypeError(texts.thatGameIsNo);
      download(s, game);
    } catch (error) {
      close();
      says(s, texts.theGameWasNotSaved(wrong(error)));
    }
  }
  function rowOf(game: ListedGame): HTMLElement {
    const isOpen = game.id === s.id;
    const title = titleOf(game);
    // Practice has no recording, and the game on the table is not deleted under the player's hands.
    const isPractice = game.setup.against === "practice";
    const goes = button(texts.goOn, () => void goOn(game), "", {
      "aria-label": texts.goOnWith(title),
    });
    const buttons = [
      ...(isOpen ? [] : [goes]),
      ...(isPractice ? [] : [button(texts.saveFile, () => void save(game))]),
      ...(isOpen ? [] : [deleteButton(game)]),
    ];
    const mark = isOpen ? texts.onTheTable : "";
    return el(
      "li",
      el("div", el("strong", title + mark), el("p.note", detailsOf(game))),
      el("div.row", ...buttons),
    );
  }
  async function refresh(): Promise<void> {
    try {
      const games = await listedGames();
      list.replaceChildren(...games.map(rowOf));
    } catch (error) {
      list.replaceChildren(el("li", texts.thisBrowserShowsNo(wrong(error))));
    }
  }
  return { root, refresh };
}
