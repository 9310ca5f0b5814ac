// A game by link: it is in the address, goes to the other one as a link, and pages of one machine hear of each stroke, which they compare bit by bit.
import type { Entry, Play, Setup, Stroke } from "./game.js";
import { channel, pack, send } from "./keep.js";
import { wrong } from "../ui.js";

export interface Host {
  play(): Play;
  seat(): 0 | 1;
  /** Whether a film is shown, after which `next` follows. */
  busy(): boolean;
  /** A stroke of the other one was played here: it is kept. */
  keep(): void;
  perform(one: Stroke, then: () => void): void;
  next(): void;
  rest(): void;
  told(text: string): void;
}

export function byLink(host: Host): { save(): void; send(share: boolean): Promise<void>; ask(): void; waiting(): boolean; onward(): void; close(): void } {
  let queue: Entry[] = [];
  let writing = 0;

  /** Strokes of the same game, behind those that are known here. */
  function heard(text: string): void {
    const play = host.play();
    if (play.setup.against !== "link") return;
    const { entries, ...setup } = JSON.parse(text) as Setup & { entries: Entry[] };
    const known = play.entries.length + queue.length;
    if (setup.game !== play.setup.game || setup.seed !== play.setup.seed || entries.length <= known) return;
    if (JSON.stringify(entries.slice(0, play.entries.length)) !== JSON.stringify(play.entries)) return host.told("The other page has other strokes of this game: send the link again.");
    queue.push(...entries.slice(known));
    if (!host.busy()) onward();
  }
  function onward(): void {
    const entry = queue.shift();
    if (!entry) return host.next();
    const play = host.play();
    try {
      const one = play.read(entry);
      host.told(`Stroke ${play.entries.length} was repeated; every bit agrees.`);
      host.keep();
      host.perform(one, onward);
    } catch (error) {
      queue = [];
      host.told(wrong(error));
      host.rest();
    }
  }
  const others = channel(heard, () => (host.play().setup.against === "link" ? host.play().text() : undefined));

  return {
    save() {
      const text = host.play().text();
      const mine = ++writing;
      others.send(text);
      void pack(text).then((packed) => mine === writing && history.replaceState(null, "", `#view=play&seat=${host.seat()}&g=${packed}`));
    },
    async send(share) {
      const play = host.play();
      // The other one has the other seat; who goes on elsewhere with a game of his own keeps his.
      const seat = play.setup.against === "link" && host.seat() === 0 ? 1 : 0;
      const url = `${location.href.split("#")[0]}#view=play&seat=${seat}&g=${await pack(play.text())}`;
      host.told(await send(url, "A game of billiards", share, play.setup.against === "link" ? "The link for the other player is copied." : "The link to this game is copied."));
    },
    ask: others.ask,
    waiting: () => queue.length > 0,
    onward,
    close: others.close,
  };
}
