// server.mjs PORT SECONDS: nine-ball between the first two who connect by a websocket, with SECONDS
// for a stroke. Others look on. README.md has the lines that it sends.
import { setTimeout as sleep } from "node:timers/promises";
import { load } from "carom";
import { WebSocketServer } from "ws";

const CLIENTS_MOST = 64;
const LINE_MOST = 8192;
const BEHIND_MOST = 1 << 20;
const [port, seconds] = process.argv.slice(2).map(Number);
const carom = await load();
const match = carom.match("nineball", carom.table("9ft"), { seed: 5 });
const clients = new Map(); // by seat

/** Nobody waits for a client: one that does not read must leave. */
function send(client, text) {
  client.send(text);
  if (client.bufferedAmount > BEHIND_MOST) client.terminate();
}

/** Sends the lines behind those that are known to all. */
function publish(known) {
  const text = match.lines.slice(known).join("");
  for (const client of clients.values()) send(client, text);
}

function receive(client, seat, line) {
  const known = match.lines.length;
  try {
    if (match.receive(line, seat)) publish(known);
  } catch (refused) {
    send(client, `refused ${refused.message}\n`);
  }
}

// A message may have several lines. One that is too long closes the connection.
const server = new WebSocketServer({ port, maxPayload: LINE_MOST });
server.on("connection", (client) => {
  let seat = 0;
  while (clients.has(seat)) seat++;
  client.on("error", () => client.terminate());
  if (seat === CLIENTS_MOST) return client.terminate();
  clients.set(seat, client);
  client.on("close", () => clients.delete(seat));
  client.on("message", (message) => {
    for (const line of message.toString().split("\n")) receive(client, seat, line);
  });
  send(client, `${match.lines.join("")}seat ${seat}\n`);
});

let turn;
let due = 0; // of the stroke, once both seats are taken
while (match.phase !== "over") {
  await sleep(100);
  const state = `${match.shots} ${match.seat}`;
  const isDue = turn === state && Date.now() >= due;
  if (isDue) {
    const known = match.lines.length;
    if (match.phase === "moving") match.continue();
    else match.clock();
    publish(known);
  }
  if (isDue || (turn !== state && (turn !== undefined || clients.has(1)))) {
    turn = `${match.shots} ${match.seat}`;
    due = Date.now() + 1000 * seconds;
  }
}
if (!match.lines.pop().startsWith('{"end"')) {
  const known = match.lines.length;
  match.receive(match.copy().end().trimEnd().split("\n").pop(), null);
  publish(known);
}
await sleep(1000); // in which all read the end
server.close();
for (const client of clients.values()) client.terminate();
