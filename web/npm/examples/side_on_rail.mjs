/*
 * Side spin at a cushion: how far running and reverse english turn the rebound, by two models of
 * the cushion.  A rolling ball meets a rail at 45 degrees. 100 % of english is a tip half a radius
 * off the centre: the ball then turns at 1.25 V/R. Running english takes the ball along the rail.
 * Reverse english holds it back; the ball then slides at the nose all the time, so more of it
 * hardly matters.  node side_on_rail.mjs
 */
import { load } from "carom";

const carom = await load();
const { radius } = carom.kind("pool");
const SPEED = 1.5; // m/s
const along = SPEED * Math.SQRT1_2;

/**
 * The angle of the rebound from the rail's normal, degrees. The rail runs along x, its normal into
 * it is +y.
 */
function rebound(english, model) {
  const spin = (english / 100) * ((1.25 * SPEED) / radius);
  // rolling: w = (-v_y, v_x) / R; the rail is on the ball's left, so spin counterclockwise from
  // above runs
  const impact = {
    v: [along, along, 0],
    w: [-along / radius, along / radius, spin],
    normal: [0, 1],
  };
  const rebound = carom.cushion(impact, { model });
  if (rebound.status !== "ok") throw new Error(`${model}: ${rebound.status}`);
  return (Math.atan2(rebound.v[0], -rebound.v[1]) * 180) / Math.PI;
}

console.log("english, %   exact   Han (degrees from the normal, before the cloth turns the path)");
const angles = [-100, -50, 0, 50, 100].map((english) => {
  const row = ["mathavan", "han"].map((model) => rebound(english, model));
  console.log(
    `${String(english).padStart(10)} ${row.map((angle) => angle.toFixed(1).padStart(7)).join(" ")}`,
  );
  return row;
});
for (const column of [0, 1])
  for (let k = 1; k < angles.length; k++)
    if (!(angles[k][column] > angles[k - 1][column]))
      throw new Error("running english should open the angle");
