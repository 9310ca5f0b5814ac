// The room of the scene: a lamp above the table with its shadows, floorboards near the table, a
// dark wall far behind, and the reflections in balls, wood and metal. Lengths are in m.
import * as THREE from "three";
import type { Table } from "../../../player/words.js";
import { painted } from "./shapes.js";
import { boards, wall } from "./surfaces.js";

export const FLOOR = -0.8;
/** How far off the wall is. */
const WALL = 5.2;

/** A lamp above the middle, whose light falls off towards the ends. Returns it with its shadows. */
export function light(scene: THREE.Object3D, { width, length }: Table): THREE.SpotLight {
  scene.add(new THREE.HemisphereLight("#ffe9c9", "#1a2a24", 0.6));
  const height = 0.95 * length;
  const lamp = new THREE.SpotLight("#fff1d8", 4.4 * height ** 2, 0, Math.atan(0.78), 0.75, 2);
  lamp.position.set(width / 2, length / 2, height);
  lamp.target.position.set(width / 2, length / 2, 0);
  lamp.castShadow = true;
  const { shadow } = lamp;
  shadow.mapSize.set(2048, 2048);
  shadow.camera.near = 0.5 * height;
  shadow.camera.far = 1.2 * height;
  shadow.bias = -3e-4;
  shadow.normalBias = 0.004;
  shadow.radius = 4;
  shadow.intensity = 0.8;
  scene.add(lamp, lamp.target);
  return lamp;
}

/** The floor with the light of the lamp around the table, and the wall. */
export function roomOf({ width, length }: Table): THREE.Object3D[] {
  const map = boards();
  map.repeat.set(7, 7);
  const floor = painted(new THREE.CircleGeometry(WALL, 48), ([x, y]) => {
    const lit = Math.hypot(x, y) < 0.1 ? 1.9 : 0.1;
    return [lit, lit, lit, 1];
  });
  const ground = new THREE.Mesh(floor, new THREE.MeshBasicMaterial({ map, vertexColors: true }));
  ground.position.set(width / 2, length / 2, FLOOR);
  const around = new THREE.Mesh(
    new THREE.CylinderGeometry(WALL, WALL, 3.2, 48, 1, true).rotateX(Math.PI / 2),
    new THREE.MeshBasicMaterial({ map: wall(), side: THREE.BackSide, fog: false }),
  );
  around.position.set(width / 2, length / 2, FLOOR + 1.6);
  return [ground, around];
}

/**
 * What is reflected: a dark room with two long lamps, the cloth below, walls washed with light, and
 * a dim ceiling.
 */
export function surroundings(renderer: THREE.WebGLRenderer, cloth: string): THREE.Texture {
  const room = new THREE.Scene();
  room.background = new THREE.Color("#0b0a0a");
  const parts: { geometry: THREE.BufferGeometry; material: THREE.Material }[] = [];
  const panel = (
    [width, height]: readonly [number, number],
    place: readonly [number, number, number],
    tint: string,
    brightness: number,
  ): void => {
    const geometry = new THREE.PlaneGeometry(width, height);
    const color = new THREE.Color(tint).multiplyScalar(brightness);
    const material = new THREE.MeshBasicMaterial({ color, side: THREE.DoubleSide });
    const mesh = new THREE.Mesh(geometry, material);
    mesh.position.set(...place);
    mesh.lookAt(0, 0, 0);
    room.add(mesh);
    parts.push({ geometry, material });
  };
  for (const x of [-0.62, 0.62]) panel([0.5, 5.6], [x, 0, 3.6], "#fff0d6", 15);
  panel([30, 30], [0, 0, -3], cloth, 0.2);
  for (let k = 0; k < 8; k++) {
    const turn = (k * Math.PI) / 4 + 0.3;
    // Nearly a band: small lights would be specks on small balls.
    panel([5.6, 1.6], [8 * Math.cos(turn), 8 * Math.sin(turn), 1.6], "#ffb46a", 0.42);
  }
  panel([24, 24], [0, 0, 12], "#c9d6ff", 0.32);
  const generator = new THREE.PMREMGenerator(renderer);
  const { texture } = generator.fromScene(room, 0.012, 0.1, 40);
  generator.dispose();
  for (const { geometry, material } of parts) {
    geometry.dispose();
    material.dispose();
  }
  return texture;
}
