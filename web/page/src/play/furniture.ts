// The fixed parts of the table in the scene: slate with cloth and holes, cushions, wood with
// rounded edges, pockets with castings or leather and their wells, lines, sights, and legs. Lengths
// are in m, z points upwards from the cloth.
import * as THREE from "three";
import { CUSHION, markingsOf, WOOD } from "../../../player/table.js";
import type { Table } from "../../../player/words.js";
import {
  CLOTH_PICTURE,
  type Cushion,
  cushionBody,
  cushionsOf,
  type End,
  freeBeside,
  type Pocket,
  shadeOf,
  TOP,
  woodAround,
} from "./cushions.js";
import { acrossOf } from "./ribbons.js";
import { FLOOR } from "./room.js";
import {
  angleFrom,
  arcAround,
  bodyOf,
  box,
  joined,
  laid,
  painted,
  type Place,
  type Point,
  ringBody,
  shapeOf,
  stripOf,
  turned,
} from "./shapes.js";
import { grain, type Style, weave } from "./surfaces.js";

/** How much wood a texture of its grain covers, along and across. */
const WOOD_PICTURE: Point = [1.3, 0.22];
/** A flat part on top of another one is drawn slightly in front of it. */
const INLAID = { polygonOffset: true, polygonOffsetFactor: -1 } as const;

// ---- Wood

/** The way out of a pocket: through the corner of the frame, or straight through its side. */
function wayOut({ width, length }: Table, { centre, radius }: Pocket): Point {
  const [x, y] = centre;
  const isMiddle = Math.abs(y - length / 2) < radius;
  const across = x < width / 2 ? -WOOD : width + WOOD;
  if (isMiddle) return [across, y];
  return [across, y < length / 2 ? -WOOD : length + WOOD];
}
/** The outline of the wood at one end of a cushion: around the pocket, and to the frame. */
function woodAt(table: Table, { pocket, wood }: End): Point[] {
  if (!pocket) {
    // A mitre continues to the corner of the frame.
    const corner = (coordinate: number, size: number): number =>
      coordinate < size / 2 ? -WOOD : size + WOOD;
    return [wood, [corner(wood[0], table.width), corner(wood[1], table.length)]];
  }
  const { centre } = pocket;
  const out = wayOut(table, pocket);
  const start = angleFrom(centre, wood);
  const sweep = turned(angleFrom(centre, out) - start);
  return [...arcAround(centre, woodAround(pocket), start, sweep, 16), out];
}
/** The wood behind a cushion, its grain along it. */
function railOf(table: Table, { outward, ends: [first, second] }: Cushion, k: number) {
  const outline = [...woodAt(table, second), ...woodAt(table, first).reverse()];
  const along = Math.abs(outward[0]) > 0.5 ? "y" : "x";
  return laid(bodyOf(outline, -0.07, TOP + 0.0003, 0.01), along, WOOD_PICTURE, 0.37 * k);
}
/** Aprons below the wood, and legs. */
function frameOf({ width, length }: Table): THREE.BufferGeometry[] {
  const places = length > 3 ? [0.06, 0.5, 0.94] : [0.1, 0.9];
  const legs = [0.1, 0.9].flatMap((x) =>
    places.map((y) => box(x * width, y * length, 0.16, 0.16, FLOOR, -0.2)),
  );
  const out = WOOD - 0.014;
  const parts = [
    ...[-out, width + out].map((x) => box(x, length / 2, 0.02, length + 2 * out, -0.24, -0.06)),
    ...[-out, length + out].map((y) => box(width / 2, y, width + 2 * out, 0.02, -0.24, -0.06)),
    box(width / 2, length / 2, width, length, -0.23, -0.2),
    ...legs,
  ];
  return parts.map((part) => laid(part, "y", [1.3, 0.3]));
}

// ---- Pockets

/** The well below a pocket, dark towards its bottom. */
function wellOf({ centre, radius }: Pocket, tint: readonly number[]): THREE.BufferGeometry[] {
  const [x, y] = centre;
  const side = new THREE.CylinderGeometry(radius, 0.86 * radius, 0.13, 36, 4, true);
  const bottom = new THREE.CircleGeometry(0.87 * radius, 24);
  return [side.rotateX(Math.PI / 2).translate(x, y, -0.065), bottom.translate(x, y, -0.128)].map(
    (part) =>
      painted(part.toNonIndexed(), ([, , z]: Place) => {
        const light = Math.max(1 + z / 0.085, 0) ** 2;
        return [...tint.map((share) => 0.004 + share * light), 1];
      }),
  );
}
/** Liners at the backs of pockets, from the slate up, and castings or leather on them. */
function pocketParts(table: Table, cushions: readonly Cushion[], hasCastings: boolean) {
  const parts = table.pockets.map((pocket) => {
    const { centre, radius } = pocket;
    const out = angleFrom(centre, wayOut(table, pocket));
    const reach = (circle: number): number => freeBeside(pocket, circle, out, cushions);
    const back = reach(radius + 0.004);
    const liner = ringBody(
      centre,
      [radius, radius + 0.006],
      [out - back, 2 * back],
      [-0.02, TOP + 0.001],
      0.0015,
    );
    if (hasCastings) {
      const cast = reach(radius + 0.032);
      const lip = ringBody(
        centre,
        [radius + 0.0045, radius + 0.034],
        [out - cast, 2 * cast],
        [TOP - 0.01, TOP + 0.0055],
        0.004,
      );
      return { liner, lip };
    }
    const lip = new THREE.TorusGeometry(radius + 0.006, 0.0085, 12, 32, 2 * back)
      .rotateZ(out - back)
      .translate(centre[0], centre[1], TOP);
    return { liner, lip };
  });
  return { liners: parts.map(({ liner }) => liner), lips: parts.map(({ lip }) => lip) };
}
function addPockets(
  scene: THREE.Object3D,
  table: Table,
  cushions: readonly Cushion[],
  { metal, leather }: Style,
): void {
  const hide = new THREE.MeshStandardMaterial({
    color: leather,
    roughness: 0.7,
    envMapIntensity: 0.3,
  });
  const castings = new THREE.MeshStandardMaterial({
    color: metal ?? leather,
    roughness: 0.32,
    metalness: 0.85,
    envMapIntensity: 0.95,
  });
  const dark = new THREE.MeshBasicMaterial({ vertexColors: true, side: THREE.DoubleSide });
  const tint = new THREE.Color(leather).multiplyScalar(4).toArray();
  const wells = table.pockets.flatMap((pocket) => wellOf(pocket, tint));
  const { liners, lips } = pocketParts(table, cushions, metal !== undefined);
  const lip = joined(lips, metal === undefined ? hide : castings);
  lip.receiveShadow = true;
  scene.add(joined(wells, dark), joined(liners, hide), lip);
}

// ---- Marks

/** Lines and spots on the cloth. */
function drawnOn(table: Table): THREE.BufferGeometry[] {
  const { lines, spots } = markingsOf(table);
  const high = 0.0006;
  const parts = lines.map((points) => {
    const across = acrossOf(points);
    const side = (far: number): Place[] =>
      points.map(([x, y], k) => [x + far * across[k]![0], y + far * across[k]![1], high]);
    return stripOf([side(0.0014), side(-0.0014)]);
  });
  const dots = spots.map(([x, y]) => new THREE.CircleGeometry(0.005, 12).translate(x, y, high));
  return [...parts, ...dots];
}
/**
 * Sights let into the wood: long rails in eight parts, short ones in four; none on large tables.
 * Pool tables have diamonds, carom tables discs.
 */
function sightsOf({ width, length, pockets }: Table): THREE.BufferGeometry[] {
  if (length > 3) return [];
  const isPool = pockets.length > 0;
  const sight = (x: number, y: number, isAlongX: boolean): THREE.BufferGeometry => {
    const high = TOP + 0.0008;
    if (!isPool) return new THREE.CircleGeometry(0.0065, 20).translate(x, y, high);
    const [long, wide] = isAlongX ? [1.35, 0.8] : [0.8, 1.35];
    return new THREE.CircleGeometry(0.0095, 4).scale(long, wide, 1).translate(x, y, high);
  };
  const middle = (CUSHION + WOOD) / 2;
  const long = [1, 2, 3, 4, 5, 6, 7].filter((k) => k !== 4 || !isPool);
  const rows = [
    [-middle, -middle],
    [width + middle, length + middle],
  ] as const;
  return rows.flatMap(([x, y]) => [
    ...long.map((k) => sight(x, (length * k) / 8, true)),
    ...[1, 2, 3].map((k) => sight((width * k) / 4, y, false)),
  ]);
}

// ---- All of it

/** Puts a table into a scene. */
export function furnish(scene: THREE.Object3D, table: Table, style: Style, isFine: boolean): void {
  const { width, length, pockets } = table;
  const threads = weave();
  // Cloth has no gloss, and covers most of the frame: it is lit in the cheap way.
  const cloth = {
    color: style.cloth,
    map: threads,
    bumpMap: isFine ? threads : null,
    bumpScale: 0.6,
  };
  const green = new THREE.MeshLambertMaterial(cloth);
  const covered = new THREE.MeshLambertMaterial({
    ...cloth,
    vertexColors: true,
    side: THREE.DoubleSide,
  });
  const fibres = grain();
  const brown = new THREE.MeshStandardMaterial({
    color: style.wood,
    map: fibres,
    bumpMap: isFine ? fibres : null,
    bumpScale: 0.4,
    roughness: 0.48,
    envMapIntensity: 0.5,
  });
  const darkness = new THREE.MeshBasicMaterial({
    vertexColors: true,
    transparent: true,
    depthWrite: false,
    side: THREE.DoubleSide,
    ...INLAID,
  });

  const cushions = cushionsOf(table);
  const edge = WOOD - 0.012;
  const slate: Point[] = [
    [-edge, -edge],
    [width + edge, -edge],
    [width + edge, length + edge],
    [-edge, length + edge],
  ];
  const holes = pockets.map(({ centre, radius }) => arcAround(centre, radius, 0, 2 * Math.PI, 40));
  const plate = laid(new THREE.ShapeGeometry(shapeOf(slate, holes)), "x", CLOTH_PICTURE);
  const bed = joined([plate], green);
  const rubber = joined(cushions.flatMap(cushionBody), covered);
  const rails = joined(
    cushions.map((cushion, k) => railOf(table, cushion, k)),
    brown,
  );
  for (const part of [bed, rubber, rails]) part.receiveShadow = true;
  rubber.castShadow = true;
  scene.add(bed, rubber, rails, joined(cushions.map(shadeOf), darkness));
  scene.add(joined(frameOf(table), brown));
  if (pockets.length > 0) addPockets(scene, table, cushions, style);

  const chalk = new THREE.MeshBasicMaterial({
    color: "#dfe9e2",
    transparent: true,
    opacity: 0.62,
    depthWrite: false,
    ...INLAID,
  });
  const pearl = new THREE.MeshStandardMaterial({
    color: "#f4ecd8",
    roughness: 0.22,
    envMapIntensity: 0.9,
    ...INLAID,
  });
  for (const [marks, material] of [
    [drawnOn(table), chalk],
    [sightsOf(table), pearl],
  ] as const)
    if (marks.length > 0) scene.add(joined(marks, material));
}
