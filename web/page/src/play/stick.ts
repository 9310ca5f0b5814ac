// The cue of the scene: a body turned from its outline, and its position behind a ball. Lengths are
// in m.
import type { Cue } from "carom";
import * as THREE from "three";
import type { Table } from "../../../player/words.js";
import { CUE_LENGTH, cueSkin } from "./surfaces.js";

/** A cue, the distance of its tip from the centre of the cue ball, and that ball's position, m. */
export interface Stick {
  cue: Cue;
  gap: number;
  place: readonly number[];
}

const RADIANS = Math.PI / 180;
/** How high the upper side of a cue has to be over the wood. */
const OVER_WOOD = 0.074;
/** A cue that would lie level is seen raised by this, degrees: a hand holds it. */
const LEAST = 3.5;
/** Radii of a cue, and how far each is behind the tip. */
const OUTLINE: readonly (readonly [number, number])[] = [
  [0.0001, CUE_LENGTH],
  [0.0125, CUE_LENGTH],
  [0.0148, CUE_LENGTH - 0.012],
  [0.0146, 1.2],
  [0.0112, 0.76],
  [0.0106, 0.72],
  [0.0066, 0.04],
  [0.0063, 0.007],
  [0.0061, 0.003],
  [0.0046, 0.0006],
  [0.0001, 0],
];

/** A cue, its tip at the origin, and its butt towards -y. */
export function stickMesh(): THREE.Mesh {
  const points = OUTLINE.map(([radius, back]) => new THREE.Vector2(radius, -back));
  const body = new THREE.LatheGeometry(points, 24);
  // The texture follows the length, and not the points of the outline.
  const places = body.getAttribute("position");
  const uv = body.getAttribute("uv");
  for (let k = 0; k < places.count; k++)
    uv.setY(k, Math.min(Math.max(1 + places.getY(k) / CUE_LENGTH, 0.001), 0.999));
  const material = new THREE.MeshStandardMaterial({
    map: cueSkin(),
    roughness: 0.3,
    envMapIntensity: 0.6,
  });
  const mesh = new THREE.Mesh(body, material);
  mesh.castShadow = true;
  return mesh;
}

/** Lays a cue behind a ball; over the wood it is raised for the eye. */
export function layStick(
  mesh: THREE.Mesh,
  { cue, gap, place }: Stick,
  { width, length }: Table,
): void {
  const [x, y, R] = place as [number, number, number];
  const phi = cue.phi * RADIANS;
  const behind = Math.min(
    ...(
      [
        [Math.cos(phi), x, width],
        [Math.sin(phi), y, length],
      ] as const
    ).map(([way, coordinate, size]) => {
      if (Math.abs(way) < 1e-9) return Infinity;
      return (coordinate - (way > 0 ? 0 : size)) / way;
    }),
  );
  const raised = Math.atan2(OVER_WOOD - R, Math.max(behind + 0.04, 0.08));
  const theta = Math.max(cue.theta * RADIANS, LEAST * RADIANS, raised);
  // From the butt to the tip, and what is to the right of it and above.
  const along = new THREE.Vector3(
    Math.cos(phi) * Math.cos(theta),
    Math.sin(phi) * Math.cos(theta),
    -Math.sin(theta),
  );
  const right = new THREE.Vector3(Math.sin(phi), -Math.cos(phi), 0);
  const up = new THREE.Vector3().crossVectors(right, along);
  mesh.position
    .set(x, y, R)
    .addScaledVector(right, -cue.a * R)
    .addScaledVector(up, cue.b * R)
    .addScaledVector(along, -gap);
  mesh.quaternion.setFromUnitVectors(new THREE.Vector3(0, 1, 0), along);
}
