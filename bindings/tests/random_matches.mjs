// random_matches.mjs ACTS RULED: the acts that random_matches.c wrote, judged in JavaScript.
import { readFileSync, writeFileSync } from "node:fs";
import { CaromError, load } from "../../web/npm/dist/index.js";

const carom = await load();
const MAY = ["pass", "push", "free_ball", "place", "rack", "other_rack", "stay", "spot"];
const PHASES = ["none", "stroke", "place", "moving", "over"];

const bits = (members) => members.reduce((sum, k) => sum + 2 ** k, 0);

/** One act, by its words. */
function act(match, [what, ...words]) {
  const numbers = words.map(Number);
  switch (what) {
    case "choose":
      return match.choose(MAY[numbers[0]]);
    case "place":
      return match.place(...numbers);
    case "call":
      return match.call(...numbers);
    case "clock":
      return match.clock();
    case "concede":
      return match.concede(...numbers);
    case "extend":
    case "timeout":
    case "next":
    case "undo":
    case "redo":
      return match[what]();
    case "again":
      return undefined;
    default: {
      const [ball, speed, phi, theta, a, b] = numbers;
      return match.stroke(carom.cue({ ball, speed, phi, theta, a, b }));
    }
  }
}

/** What came of it. */
function outcome(match, words) {
  try {
    act(match, words);
  } catch (refused) {
    if (!(refused instanceof CaromError)) throw refused;
    return refused.message;
  }
  const may = bits(match.may.map((word) => MAY.indexOf(word)));
  const sets = `on ${bits(match.on)}, touching ${bits(match.touching)}`;
  const winner = match.drawn ? 8 : (match.winner ?? -1);
  const again = words[0] === "again" ? `${match.shot?.events.length ?? 0} events\n` : "";
  const who = `seat ${match.seat}, winner ${winner}`;
  const at = `phase ${PHASES.indexOf(match.phase)}, ${who}, may ${may}`;
  return `${again}taken: ${at}, ball ${match.cueBall}, ${sets}: ${match.ruling?.words ?? ""}`;
}

let match;
let known = 0;
let ruled = "";
for (const line of readFileSync(process.argv[2], "utf8").trimEnd().split("\n")) {
  if (line === "match") {
    match?.free();
    match = carom.match();
    known = 0;
    continue;
  }
  if (line === "again") {
    const copy = match.copy();
    match.free();
    match = copy;
  }
  const said = line.startsWith("{") ? match.read(line) : `${outcome(match, line.split(" "))}\n`;
  ruled += match.lines.slice(known).join("") + (said ?? "");
  known = match.lines.length;
}
writeFileSync(process.argv[3], ruled);
