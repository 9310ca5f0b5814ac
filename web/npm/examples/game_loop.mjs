/*
 * The loop of a game: frames while the balls move, sounds as they happen, and the layout that the
 * next stroke begins with.  A shot is computed at once, in less time than a frame. The loop then
 * asks where the balls are now; nothing is simulated frame by frame, so a slow machine draws fewer
 * frames and shows the same shot. Here the clock is counted instead of read.  node game_loop.mjs
 */
import { load } from "carom";

const FRAME = 1 / 60; // s; a page would take it from requestAnimationFrame
const carom = await load();
const table = carom.table("9ft");
let balls = carom.rack("nineball", table, { seed: 3 });
const places = new Float64Array(3 * balls.length); // the memory of each frame

/**
 * Plays one stroke; calls draw(places, time) in every frame and sound(event, loudness) once for
 * each contact.
 */
function play(cue, draw, sound) {
  const shot = carom.simulate(table, balls, cue);
  let heard = 0;
  for (let time = 0; time < shot.time + FRAME; time += FRAME) {
    for (; heard < shot.events.length && shot.events[heard].time <= time; heard++) {
      const event = shot.events[heard];
      if (event.impulse > 0) sound(event, event.impulse); // N s: how hard it was
    }
    draw(shot.positions(time, places), time);
  }
  return shot;
}

let frames = 0;
let loudest = 0;
for (const cue of [
  { speed: 8, phi: 90 },
  { speed: 2, phi: 45 },
]) {
  const shot = play(
    cue,
    () => frames++,
    (_, loudness) => (loudest = Math.max(loudest, loudness)),
  );
  // the next stroke begins here
  balls = balls.map(({ kind }, k) => ({ kind, state: shot.final[k] }));
  console.log(
    `${shot.time.toFixed(2)} s, ${frames} frames so far, loudest contact ${loudest.toFixed(2)} N s`,
  );
  // The last frame shows where the balls came to rest.
  if (shot.final.some(({ r }, ball) => r.some((x, k) => x !== places[3 * ball + k])))
    throw new Error("the last frame is not the end");
}
if (!(frames > 100 && loudest > 0.1)) throw new Error("a break should be seen and heard");
