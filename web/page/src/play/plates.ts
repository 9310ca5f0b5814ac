// Both seats above the table with the game between them: names, ratings, points, racks of a race,
// whose turn it is, and which balls are left. A screen reader hears the score as a sentence.
import { onTable } from "../table/filmed.js";
import { GAMES, SEATS } from "../table/games.js";
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
  let drawn = "";
  return {
    root,
    show({ balls, names }, shown) {
      const key = shown.map((k) => `${names[k]} ${onTable(balls[k]!.state)}`).join();
      if (key === drawn) return;
      drawn = key;
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

/** The seat that plays next: the first one after the seat at the table that has something left. */
function nextSeat({ points }: Play, atTable: number): number {
  const others = points.map((_, k) => (atTable + 1 + k) % points.length);
  return others.find((player) => points[player]! > 0) ?? -1;
}
/** The lives of killer: a dot for each that is left, and a ring for each that is lost. */
function livesOf({ carom, table }: Play, lives: number): string {
  const [initial = lives] = carom.match("killer", table).game.user ?? [];
  return "●".repeat(lives) + "○".repeat(initial - lives);
}
/** The points of a seat as a plate shows them; "" in a game without points. */
const wordsOfPoints = (play: Play, points: number): string =>
  play.played?.points || play.isOwn ? String(points).replace("-", "−") : "";
/** The most seats of any game. */
const MOST_SEATS = Math.max(2, ...Object.values(SEATS).flat());

export function plates(s: Session): Plates {
  const seats = Array.from({ length: MOST_SEATS }, (_, place) => {
    const face = el("span.face");
    const name = el("span.name");
    const racks = el("span.racks");
    const points = el("span.points");
    const balls = tray("span.tray");
    const root = el(
      `div.plate.${place === 1 ? "right" : "left"}` as "div",
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
  const root = el("div.plates", seats[0]!.root, middle, ...seats.slice(1).map((seat) => seat.root));
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
  function showSeat(place: number, player: number, atTable: number): void {
    const { play, seat } = s;
    const { against, game, race } = play.setup;
    const { face, name, racks, points, balls, root } = seats[place]!;
    const isMachine = isComputer(against) && player !== seat;
    const text = nameOf(play, player, seat);
    const isMany = play.points.length > 2;
    name.textContent = text[0]!.toUpperCase() + text.slice(1);
    const rating = isComputer(against)
      ? String(s.training.rating(play.setup.game).rating)
      : text[0]!;
    const own = against === "person" || isMany ? String(player + 1) : rating;
    face.textContent = isMachine && !isMany ? against : own;
    face.classList.toggle("machine", isMachine);
    root.classList.toggle("at-table", !play.isOver && player === atTable);
    const left = play.points[player]!;
    const isNext = isMany && !play.isOver && player === nextSeat(play, atTable);
    root.classList.toggle("next", isNext);
    root.classList.toggle("out", isMany && left <= 0);
    const isLives = game === "killer";
    points.classList.toggle("lives", isLives);
    points.textContent = isLives ? livesOf(play, left) : wordsOfPoints(play, left);
    racks.textContent = race === undefined ? "" : texts.racksOf(racksOf(play)[player] ?? 0, race);
    balls.show(play, ballsOf(play, player));
  }
  function update(): void {
    const { play, seat } = s;
    const { against, game } = play.setup;
    title.textContent = play.played?.text ?? GAMES[game]!.text;
    const count = play.points.length;
    root.classList.toggle("many", count > 2 && !play.practice);
    root.style.setProperty("--seats", String(count));
    seats.forEach(({ root }, place) => (root.hidden = play.practice || place >= count));
    note.textContent = play.practice ? translate(texts.practice) : wordsOfVisit(play);
    shared.show(play, sharedBalls(play));
    if (play.practice) return;
    const isFilmed = s.continuation !== undefined && s.shown !== undefined;
    const atTable = isFilmed ? s.shown!.player : play.turn;
    // Whoever sits here is at the left.
    const left = against === "person" ? 0 : seat;
    for (let place = 0; place < count; place++) showSeat(place, (left + place) % count, atTable);
  }
  return { root, update };
}
