// Watching a game from its first stroke: a bar steps forward and back while nobody plays. A link
// can open a game in this mode. Closing the bar resumes the game.
import { button, el } from "../ui.js";
import { read } from "./game.js";
import type { Session, Watching } from "./parts.js";
import { says } from "./session.js";
import { wordsOfStroke } from "./state.js";
import { next } from "./turns.js";
import { texts } from "../texts/texts.js";

export function watching(s: Session): Watching {
  const count = el("strong#watched", { role: "status" });
  const back = button(texts.strokeBack, () => show(s.play.strokes - 1), "#watch-back");
  const forth = button(texts.nextStroke, () => show(s.play.strokes + 1), "#watch-forth.main");
  const close = button(texts.closeWatch, leave, "#watch-close");
  const root = el("div#watch.row", { hidden: "" }, back, count, forth, close);

  /** Shows the game after so many strokes, the last of them with its film. */
  function show(strokes: number): void {
    const whole = s.watched;
    if (!whole) return;
    s.film.stop();
    s.continuation = undefined;
    const isNext = strokes === s.play.strokes + 1;
    s.play = read(s.carom, whole.text(), strokes);
    if (!isNext) s.turned = s.play.balls.map(() => [1, 0, 0, 0]);
    count.textContent = texts.strokeOf(strokes, whole.strokes);
    back.disabled = strokes === 0;
    forth.disabled = strokes === whole.strokes;
    const { last } = s.play;
    const finish = (): void => {
      says(s, last ? wordsOfStroke(s.play, last, s.seat) : "");
      s.showing.rest();
    };
    if (isNext && last) s.showing.perform(last, finish);
    else finish();
  }
  function enter(): void {
    if (s.watched || s.play.practice || s.play.strokes === 0) return;
    s.showing.skip();
    s.searchGeneration++; // the page's player thinks anew behind the bar
    s.thinks = false;
    s.theirs = undefined;
    s.end.hide();
    s.watched = s.play;
    show(0);
    forth.focus();
  }
  function leave(): void {
    if (!s.watched) return;
    s.film.stop();
    s.continuation = undefined;
    s.play = s.watched;
    s.watched = undefined;
    says(s, "");
    next(s);
  }
  return { root, enter, leave };
}
