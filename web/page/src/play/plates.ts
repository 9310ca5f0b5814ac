// Both seats above the table with the game between them: names, ratings, points, racks of a race,
// whose turn it is, and which balls are left. A screen reader hears the score as a sentence.
import { onTable } from "../table/filmed.js";
import { GAMES } from "../table/games.js";
import { el } from "../ui.js";
import { isComputer, type Play } from "./game.js";
import { racksOf } from "./keep.js";
import { ballPicture } from "./marks.js";
import type { Plates, Session } from "./parts.js";
import { groupOf, isEight, nameOf, wordsOfTarget } from "./state.js";
import { texts, translate } from "../texts/texts.js";

/** A row of balls, drawn anew only where they are others than before. */
function tray(selector: string): { root: HTMLElement; show(play: Play, balls: number[]): void } {
  const root = el(selector as "div");
  let before = "";
  return {
    root,
    show({ balls, names }, shown) {
      const key = shown.map((k) => `${names[k]} ${onTable(balls[k]!.state)}`).join();
      if (key === before) return;
      before = key;
      const pictures = shown.map((k) => {
        const ball = ballPicture(names[k]!, k, balls[k]!.kind.radius);
        ball.classList.toggle("gone", !onTable(balls[k]!.state));
        return ball;
      });
      root.replaceChildren(...pictures);
    },
  };
}
const range = (first: number, last: number): number[] =>
  Array.from({ length: last - first + 1 }, (_, k) => first + k);
/** The balls that a player of two groups has to pot. */
function ballsOf(play: Play, player: number): number[] {
  const own = play.setup.game === "cutthroat" ? play.state.user?.[player] : undefined;
  if (own !== undefined) return range(1, 15).filter((ball) => (own >> ball) & 1);
  if (!isEight(play) || play.practice) return [];
  const group = groupOf(play, player);
  if (group === "open") return [];
  return [...(group === "solids" ? range(1, 7) : range(9, 15)), 8];
}
/** The balls that both players play: a pool rack. */
function sharedBalls(play: Play): number[] {
  const isPool = play.hasPockets && play.balls.length <= 16 && play.names[0] === "cue";
  const hasGroups = ballsOf(play, 0).length > 0;
  return isPool && !hasGroups ? range(1, play.balls.length - 1) : [];
}

/** The seat at the right: the one at the table, or the next that has something left. */
function opposite({ points }: Play, left: number, atTable: number): number {
  if (atTable !== left) return atTable;
  const others = points.map((_, k) => (left + 1 + k) % points.length);
  return others.find((player) => points.length === 2 || points[player]! > 0)!;
}

export function plates(s: Session): Plates {
  const seats = ([0, 1] as const).map((place) => {
    const face = el("span.face");
    const name = el("span.name");
    const racks = el("span.racks");
    const points = el("span.points");
    const balls = tray("span.tray");
    const root = el(
      `div.plate.${place === 0 ? "left" : "right"}` as "div",
      face,
      el("span.who", name, racks, balls.root),
      points,
    );
    return { face, name, racks, points, balls, root };
  });
  const title = el("h1");
  const note = el("p.note-of-turn");
  const shared = tray("div.tray");
  note.style.margin = "0";
  const middle = el("div.middle", title, note, shared.root);
  const root = el("div.plates", seats[0]!.root, middle, seats[1]!.root);
  for (const { root } of seats) root.setAttribute("aria-hidden", "true");

  /** Where the visit to the table began: what it made since is a break. */
  let visit = { game: "", turn: -1, points: 0, isWhole: false };
  function breakOf(play: Play): number {
    const { turn, points, strokes } = play;
    if (visit.game !== s.id || visit.turn !== turn)
      visit = {
        game: s.id,
        turn,
        points: points[turn]!,
        isWhole: strokes === 0 || visit.game === s.id,
      };
    return visit.isWhole ? points[turn]! - visit.points : 0;
  }
  /** What to meet first, where the rules name it, and the break. */
  function wordsOfVisit(play: Play): string {
    if (play.practice || play.isOver) return "";
    const made = play.played?.points ? breakOf(play) : 0;
    return [wordsOfTarget(play), made > 0 ? texts.breakOf(made) : ""]
      .filter((part) => part !== "")
      .join(" · ");
  }
  function showSeat(place: 0 | 1, player: number, atTable: number): void {
    const { play, seat } = s;
    const { against, race } = play.setup;
    const { face, name, racks, points, balls, root } = seats[place]!;
    const isMachine = isComputer(against) && player !== seat;
    const text = nameOf(play, player, seat);
    name.textContent = text[0]!.toUpperCase() + text.slice(1);
    const rating = isComputer(against)
      ? String(s.training.rating(play.setup.game).rating)
      : text[0]!;
    const own = against === "person" ? String(player + 1) : rating;
    face.textContent = isMachine ? against : own;
    face.classList.toggle("machine", isMachine);
    root.classList.toggle("at-table", !play.isOver && player === atTable);
    points.textContent =
      play.played?.points || play.isOwn ? String(play.points[player]).replace("-", "−") : "";
    racks.textContent = race === undefined ? "" : texts.racksOf(racksOf(play)[player] ?? 0, race);
    balls.show(play, ballsOf(play, player));
  }
  function update(): void {
    const { play, seat } = s;
    const { against, game } = play.setup;
    title.textContent = play.played?.text ?? GAMES[game]!.text;
    for (const { root } of seats) root.hidden = play.practice;
    note.textContent = play.practice ? translate(texts.practice) : wordsOfVisit(play);
    shared.show(play, sharedBalls(play));
    if (play.practice) return;
    const isFilmed = s.continuation !== undefined && s.shown !== undefined;
    const atTable = isFilmed ? s.shown!.player : play.turn;
    // Whoever sits here is at the left.
    const left = against === "person" ? 0 : seat;
    showSeat(0, left, atTable);
    showSeat(1, opposite(play, left, atTable), atTable);
  }
  return { root, update };
}
