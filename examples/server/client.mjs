// client.mjs HOST PORT: plays a seat of a server by plans, or looks on, and prints the match.
import { load } from "carom";
import WebSocket from "ws";

const [host, port] = process.argv.slice(2);
const carom = await load();
const match = carom.match();
let seat;
let awaited = ""; // the last line that was sent, until it comes back

/** The lines of the best stroke of the seat at the table, and of what comes before it. */
function act() {
  const mine = match.copy();
  const [best] = mine.plan({ shots: 100 });
  mine.take(best);
  const lines = mine.lines.slice(match.lines.length);
  mine.free();
  return lines;
}

function receive(line) {
  if (line.startsWith("refused ")) {
    console.error(line); // such as an act that came after its time
    awaited = "";
    return;
  }
  if (line.startsWith("seat ")) seat = Number(line.slice(5));
  else match.receive(line, null);
  if (line === awaited) awaited = "";
  const isMine = ["stroke", "place"].includes(match.phase) && match.seat === seat;
  if (line.startsWith('{"end"')) {
    process.stdout.write(match.lines.join(""));
    server.close();
  } else if (isMine && awaited === "") {
    const lines = act();
    awaited = lines[lines.length - 1].trimEnd();
    server.send(lines.join(""));
  }
}

const server = new WebSocket(`ws://${host}:${port}`);
server.on("message", (message) => {
  for (const line of message.toString().split("\n")) if (line !== "") receive(line);
});
