// A game by link: the address contains it, a link sends it to the other player, and pages on one
// machine exchange each stroke and compare it bit by bit.
import { wrong } from "../ui.js";
import type { Play, Setup } from "./game.js";
import { pack, send } from "./keep.js";
import type { Link, Session } from "./parts.js";
import { says } from "./session.js";
import { next, saveAndCount } from "./turns.js";
import { texts } from "../texts/texts.js";

const wholeOf = ({ play, watched }: Session): Play => watched ?? play;

export function byLink(s: Session): Link {
  let queue: string[] = [];
  let aims: string | undefined;
  let writing = 0;

  /** Strokes of the same game, behind those that are known here. */
  function heard(text: string): void {
    const play = wholeOf(s);
    if (play.setup.against !== "link") return;
    const { lines, ...setup } = JSON.parse(text) as Setup & { lines: string[]; aims?: string };
    const known = play.lines;
    const isOther = setup.game !== play.setup.game || setup.seed !== play.setup.seed;
    if (isOther || lines.length <= known.length + queue.length) return;
    if (known.some((line, k) => line !== lines[k])) return says(s, texts.theOtherPageHas);
    s.watching.leave();
    queue = lines.slice(known.length);
    ({ aims } = setup);
    // When the film ends, the next stroke follows.
    if (!s.film.playing && s.continuation === undefined) onward();
  }
  function onward(): void {
    try {
      const stroke = s.play.read(queue, aims);
      if (!stroke) return next(s);
      says(s, texts.strokeWasRepeatedEvery(s.play.strokes));
      saveAndCount(s);
      s.showing.perform(stroke, onward);
    } catch (error) {
      queue = [];
      says(s, wrong(error));
      s.showing.rest();
    }
  }
  /** What a link does not bring that is sent before a stroke, or again after it. */
  function wordsOfTooEarly(): string {
    const { play, seat } = s;
    if (play.isOver) return "";
    if (play.turn === seat) return texts.youAreStillAt;
    const hasPlayed = play.last?.player === seat;
    return hasPlayed ? "" : texts.itHasNothingNew;
  }
  /** Pages on this machine send the text of a changed game, or request it. */
  const others = new BroadcastChannel("carom-games");
  others.addEventListener("message", ({ data: { text } }: MessageEvent<{ text?: string }>) => {
    if (text !== undefined) heard(text);
    else if (s.play.setup.against === "link") others.postMessage({ text: wholeOf(s).text() });
  });

  return {
    save() {
      const text = s.play.text();
      const generation = ++writing;
      others.postMessage({ text });
      void pack(s.play.shortText()).then(
        (packed) =>
          generation === writing &&
          history.replaceState(null, "", `#view=play&seat=${s.seat}&g=${packed}`),
      );
    },
    async send() {
      const play = wholeOf(s);
      // The other one has the other seat; who goes on elsewhere with a game of his own keeps his.
      const isByLink = play.setup.against === "link" && !s.watched;
      const seat = isByLink && s.seat === 0 ? 1 : 0;
      const how = s.watched ? "watch=1" : `seat=${seat}`;
      const url = `${location.href.split("#")[0]}#view=play&${how}&g=${await pack(play.shortText())}`;
      const result = await send(
        url,
        texts.aGameOfBilliards,
        s.coarse,
        isByLink ? texts.theLinkForThe : texts.theLinkToThisGame,
      );
      says(s, isByLink ? result + wordsOfTooEarly() : result);
    },
    ask: () => others.postMessage({}),
    waiting: () => queue.length > 0,
    onward,
    close: () => others.close(),
  };
}
