// The end of a game, shown over the table: who won and why, the score, the best stroke, the effect
// on the rating, and what to do next.
import { wordsOfPot } from "../table/words.js";
import { button, el } from "../ui.js";
import { type Deed, OPTIONS, type Play } from "./game.js";
import { isRaceOver, racksOf } from "./keep.js";
import { levels, mayCount, wordsOfRung } from "./ladder.js";
import { ballPicture } from "./marks.js";
import type { EndView, Session } from "./parts.js";
import { nameOf, wordsOfEnd, wordsOfScore } from "./state.js";
import { texts } from "../texts/texts.js";

/** By how many degrees the aim of a pot could have turned; none where the pot was no plain one. */
function roomOf({ carom, table }: Play, { balls, cue, hitBall, pots }: Deed): number | undefined {
  const [pot] = pots;
  if (!pot || pot.ball !== hitBall) return undefined;
  const { outcome, phi } = carom.aim(table, balls, cue, pot, OPTIONS);
  const off = (angle: number): number => ((angle - cue.phi + 540) % 360) - 180;
  const isInside = off(phi[0]) <= 0.01 && off(phi[1]) >= -0.01;
  return outcome === "falls" && isInside ? phi[1] - phi[0] : undefined;
}
/** The best stroke of a player: the pot with the least room for its aim, or the most cushions. */
function bestOf(play: Play, player: number): string {
  const deeds = play.deeds.filter((deed) => deed.player === player);
  if (!play.hasPockets) {
    const most = Math.max(0, ...deeds.map(({ cushions }) => cushions));
    return most > 0 ? texts.aPointOffCushions(most) : "";
  }
  const rooms = deeds.flatMap((deed) => {
    const room = roomOf(play, deed);
    return room === undefined ? [] : [{ ...deed.pots[0]!, room }];
  });
  const [best] = rooms.sort((a, b) => a.room - b.room);
  if (!best) return "";
  return texts.aPotWithRoom(wordsOfPot(play.table, play.names, best), best.room.toFixed(2));
}

/** The ball that the game ended with, as an emblem, from behind which the others roll out. */
function emblem({ last, names, balls, winner }: Play): HTMLElement {
  const fallen = last?.shot?.events.filter(({ type }) => type === "ball_pocket") ?? [];
  const ball = winner === last?.player ? (fallen.at(-1)?.a ?? last?.cue.ball ?? 0) : 0;
  const pictures = balls.map(({ kind }, k) => ballPicture(names[k]!, k, kind.radius));
  const [ended] = pictures.splice(ball, 1);
  pictures.forEach((picture, k) => {
    picture.classList.add("out");
    picture.style.setProperty("--side", k % 2 === 0 ? "-1" : "1");
    picture.style.setProperty("--place", String(k));
  });
  return el("div.emblem", ...pictures, ended);
}

/** What a game against the computer did to one's rating, and to one's level. */
function wordsOfRating(s: Session, previous: EndView["rated"]): string[] {
  const hints = s.play.aims.filter((aimer) => aimer === "hint").length;
  if (!previous) return hints > 0 && mayCount(s.play.setup) ? [texts.hintedGame(hints)] : [];
  const { against, game } = s.play.setup;
  const current = s.training.rating(game);
  const changed = previous.isGuess
    ? texts.firstRating(current.rating)
    : texts.ratingChanged(previous.rating, current.rating);
  const level = levels(game).find(({ rating }) => rating === against);
  return level ? [changed, wordsOfRung(level)] : [changed];
}

export function endView(s: Session, restart: () => void, list: () => void): EndView {
  const root = el("section#end", { "aria-label": texts.endOfTheGame, hidden: "" });
  const hide = (): void => void (root.hidden = true);
  function show(): void {
    const { play, seat } = s;
    // Of a drawn game the last stroke drew level.
    const winner = play.winner ?? play.last!.player;
    const name = nameOf(play, winner, seat);
    const isShared = play.setup.against === "person";
    const isWon = !play.isDrawn && (isShared || winner === seat);
    const ends = play.isDrawn ? texts.isDrawn("") : texts.hasWon(name, name === texts.you, "");
    const title = ends.replace(/\.$/, "");
    const racks = racksOf(play);
    const race =
      play.setup.race !== undefined && isRaceOver(play)
        ? texts.theRaceIsWon(Math.max(...racks), Math.min(...racks))
        : "";
    const player = isShared ? winner : seat;
    const best = bestOf(play, player);
    const isRace = play.setup.race !== undefined;
    const reasons = [race, wordsOfEnd(play) && `${wordsOfEnd(play)}.`];
    // Of points, the score is what decided.
    const isScoreSaid = race !== "" || (play.played?.points && play.last?.shot);
    const lines = [
      isScoreSaid ? "" : wordsOfScore(play, seat, racks),
      best && texts.bestStrokeOf(!isShared, nameOf(play, player, seat), best),
      ...wordsOfRating(s, s.end.rated),
    ];
    const paragraphs = (words: readonly string[], attributes = {}): HTMLElement[] =>
      words
        .filter((line) => line !== "")
        .map((line) => el("p", attributes, `${line[0]!.toUpperCase()}${line.slice(1)}`));
    const next = isRace && race === "" ? texts.nextRack : texts.playAgain;
    root.replaceChildren(
      button("×", hide, ".close", { "aria-label": texts.close }),
      ...(isWon ? [emblem(play)] : []),
      el("h2", title),
      ...paragraphs(reasons, { class: "why" }),
      ...paragraphs(lines),
      el(
        "div.row",
        button(next, restart, "#play-again.main"),
        button(texts.yourGames, list, "#end-games"),
      ),
    );
    if (!play.isDrawn) s.sound.end(isWon);
    root.classList.toggle("won", isWon);
    root.classList.toggle("lost", !isWon && !play.isDrawn);
    root.hidden = false;
  }
  return { root, rated: undefined, show, hide };
}
