// What never moves of the view in three dimensions: slate with cloth, cushions, wood, pockets with
// leather, legs, a floor, and the lamp above the table. Lengths in m, z upwards from the cloth.
import * as THREE from "three";
import { arcOf, markingsOf, WOOD } from "../../../player/table.js";
import type { Table } from "../../../player/words.js";

interface Furnished {
  table: Table;
  cloth: string;
  wood: string;
}
type Point = readonly [number, number];

/** How wide a cushion is, from its nose to the wood. */
const CUSHION = 0.05;
/** The outer edge of the wood, from the noses. */
const FRAME = CUSHION + WOOD;
/** The height of the rails; noses are a little lower. */
const TOP = 0.045;
/** Rails longer than this are cushions, the others facings of pockets. */
const FACING = 0.3;
const FLOOR = -0.8;

const distance = (a: Point, b: Point): number => Math.hypot(a[0] - b[0], a[1] - b[1]);
const angleFrom = (centre: Point, point: Point): number =>
  Math.atan2(point[1] - centre[1], point[0] - centre[0]);
const onCircle = (centre: Point, radius: number, angle: number): Point => [
  centre[0] + radius * Math.cos(angle),
  centre[1] + radius * Math.sin(angle),
];
/** An angle as it is nearest to 0, radians. */
const turned = (angle: number): number => Math.atan2(Math.sin(angle), Math.cos(angle));

/** Parts of one material as one mesh: each mesh that is drawn costs a frame some time. */
function joined(geometries: THREE.BufferGeometry[], material: THREE.Material): THREE.Mesh {
  const parts = geometries.map((geometry) => (geometry.index ? geometry.toNonIndexed() : geometry));
  const geometry = new THREE.BufferGeometry();
  for (const name of ["position", "normal"])
    geometry.setAttribute(
      name,
      new THREE.Float32BufferAttribute(
        parts.flatMap((part) => [...part.getAttribute(name)!.array]),
        3,
      ),
    );
  return new THREE.Mesh(geometry, material);
}
/** A polygon of the plane, as a body between two heights. */
function bodyOf(points: readonly Point[], low: number, high: number): THREE.BufferGeometry {
  const shape = new THREE.Shape(points.map(([x, y]) => new THREE.Vector2(x, y)));
  const body = new THREE.ExtrudeGeometry(shape, { depth: high - low, bevelEnabled: false });
  return body.translate(0, 0, low);
}
function box(x: number, y: number, w: number, l: number, low: number, high: number) {
  return new THREE.BoxGeometry(w, l, high - low).translate(x, y, (low + high) / 2);
}

/** One end of a cushion: its edge from the nose into the pocket, and that pocket. */
interface End {
  edge: Point[];
  pocket: Table["pockets"][number] | undefined;
}
/** A long cushion: the ends of its nose, the way outwards, and its edges at both ends. */
interface Cushion {
  p: Point;
  q: Point;
  outward: Point;
  ends: [End, End];
}

/** The edge from the end of a nose: along the arc of a jaw, and then along a facing. */
function edgeFrom(table: Table, nose: Point): Point[] {
  const arcs = table.jaws.map((jaw) => arcOf(table, jaw)).filter((arc) => arc.length > 0);
  const ordered = arcs.map((arc) =>
    distance(arc[0]!, nose) < distance(arc.at(-1)!, nose) ? arc : [...arc].reverse(),
  );
  const edge: Point[] = [...(ordered.find((arc) => distance(arc[0]!, nose) < 2e-3) ?? [])];
  const end = edge.at(-1) ?? nose;
  for (const { p, q } of table.rails) {
    if (distance(p, q) > FACING) continue;
    if (distance(p, end) < 2e-3) edge.push(q);
    else if (distance(q, end) < 2e-3) edge.push(p);
  }
  return edge;
}
function cushionsOf(table: Table): Cushion[] {
  const middle: Point = [table.width / 2, table.length / 2];
  return table.rails
    .filter(({ p, q }) => distance(p, q) > FACING)
    .map(({ p, q }) => {
      const along = distance(p, q);
      const normal: Point = [(q[1] - p[1]) / along, (p[0] - q[0]) / along];
      const side = Math.sign(normal[0] * (p[0] - middle[0]) + normal[1] * (p[1] - middle[1])) || 1;
      const outward: Point = [side * normal[0], side * normal[1]];
      const endAt = (nose: Point, back: Point): End => {
        const pocket = table.pockets.find(
          ({ centre, radius }) => distance(centre, nose) < 3 * radius,
        );
        const edge = edgeFrom(table, nose);
        const last = edge.at(-1) ?? nose;
        // The cushion is as deep at its ends as along its back; without a pocket it is mitred.
        const depth = (last[0] - nose[0]) * outward[0] + (last[1] - nose[1]) * outward[1];
        const more = Math.max(CUSHION - depth, 0);
        const slant = pocket ? 0 : CUSHION / along;
        if (more > 0)
          edge.push([
            last[0] + more * outward[0] + slant * (nose[0] - back[0]),
            last[1] + more * outward[1] + slant * (nose[1] - back[1]),
          ]);
        return { edge, pocket };
      };
      return { p, q, outward, ends: [endAt(p, q), endAt(q, p)] };
    });
}

/** The way out of a pocket: through the corner of the frame, or straight through its side. */
function wayOut({ width, length }: Table, { centre, radius }: Table["pockets"][number]): Point {
  const [x, y] = centre;
  const isMiddle = Math.abs(y - length / 2) < radius;
  const across = x < width / 2 ? -FRAME : width + FRAME;
  if (isMiddle) return [across, y];
  return [across, y < length / 2 ? -FRAME : length + FRAME];
}
/** The outline of the wood at one end of a cushion: around the pocket, and to the frame. */
function woodAt(table: Table, { edge, pocket }: End): Point[] {
  const last = edge.at(-1)!;
  if (!pocket) {
    // A mitre goes on to the corner of the frame.
    const corner = (coordinate: number, size: number): number =>
      coordinate < size / 2 ? -FRAME : size + FRAME;
    return [last, [corner(last[0], table.width), corner(last[1], table.length)]];
  }
  const { centre, radius } = pocket;
  const out = wayOut(table, pocket);
  const start = angleFrom(centre, last);
  const sweep = turned(angleFrom(centre, out) - start);
  const arc = Array.from({ length: 13 }, (_, k) =>
    onCircle(centre, radius + 0.004, start + (sweep * k) / 12),
  );
  return [last, ...arc, out];
}

/** The leather around a pocket, from one cushion around its back to the other. */
function linerOf(table: Table, pocket: Table["pockets"][number], ends: Point[]) {
  const { centre, radius } = pocket;
  const out = angleFrom(centre, wayOut(table, pocket));
  const reach = Math.max(...ends.map((end) => Math.abs(turned(angleFrom(centre, end) - out))));
  return new THREE.TorusGeometry(radius + 0.005, 0.009, 10, 28, 2 * reach)
    .rotateZ(out - reach)
    .translate(centre[0], centre[1], TOP);
}

/** A lamp above the middle, whose light falls off towards the ends, and little light from around. */
function light(scene: THREE.Scene, { width, length }: Table): void {
  scene.add(new THREE.HemisphereLight("#e8eeff", "#4a6a58", 1.15));
  const height = 0.85 * length;
  const lamp = new THREE.SpotLight("#fff2d8", 3.1 * height ** 2, 0, Math.atan(0.72), 0.5, 2);
  lamp.position.set(width / 2, length / 2, height);
  lamp.target.position.set(width / 2, length / 2, 0);
  lamp.castShadow = true;
  lamp.shadow.mapSize.set(2048, 2048);
  lamp.shadow.camera.near = 0.5 * height;
  lamp.shadow.camera.far = 1.2 * height;
  lamp.shadow.bias = -4e-4;
  lamp.shadow.radius = 3;
  scene.add(lamp, lamp.target);
}
/** A dark room: a floor that is seen near the table. */
function floorOf({ width, length }: Table): THREE.Mesh {
  const canvas = document.createElement("canvas");
  [canvas.width, canvas.height] = [128, 128];
  const g = canvas.getContext("2d")!;
  const fall = g.createRadialGradient(64, 64, 8, 64, 64, 64);
  fall.addColorStop(0, "#4a382b");
  fall.addColorStop(1, "#0e0f11");
  g.fillStyle = fall;
  g.fillRect(0, 0, 128, 128);
  const map = Object.assign(new THREE.CanvasTexture(canvas), { colorSpace: THREE.SRGBColorSpace });
  const floor = new THREE.Mesh(
    new THREE.CircleGeometry(2 * length, 48),
    new THREE.MeshBasicMaterial({ map }),
  );
  floor.position.set(width / 2, length / 2, FLOOR);
  return floor;
}

/** Puts table, room and light into a scene. */
export function furnish(scene: THREE.Scene, { table, cloth, wood }: Furnished): void {
  const { width, length, pockets } = table;
  light(scene, table);
  const green = new THREE.MeshLambertMaterial({ color: cloth });
  const brown = new THREE.MeshPhongMaterial({ color: wood, shininess: 60, specular: "#332a22" });
  const leather = new THREE.MeshPhongMaterial({ color: "#2a1c13", shininess: 25 });
  const inside = new THREE.MeshLambertMaterial({ color: "#120c08", side: THREE.BackSide });
  const black = new THREE.MeshBasicMaterial({ color: "#020202" });
  const ivory = new THREE.MeshLambertMaterial({ color: "#f3ead2" });

  const cushions = cushionsOf(table);
  const bodies = cushions.map(({ p, q, ends: [atP, atQ] }) =>
    bodyOf([...[...atP.edge].reverse(), p, q, ...atQ.edge], 0.01, TOP - 0.003),
  );
  const frame = cushions.map(({ ends: [atP, atQ] }) =>
    bodyOf([...woodAt(table, atQ), ...woodAt(table, atP).reverse()], -0.06, TOP + 0.004),
  );
  const bed = joined(
    [box(width / 2, length / 2, width + 2 * CUSHION, length + 2 * CUSHION, -0.03, 0)],
    green,
  );
  const rubber = joined(bodies, green);
  const rails = joined(frame, brown);
  for (const part of [bed, rubber, rails]) part.receiveShadow = true;
  rubber.castShadow = true;
  scene.add(bed, rubber, rails, floorOf(table));

  if (pockets.length > 0) {
    const endsOf = (pocket: Table["pockets"][number]): Point[] =>
      cushions.flatMap(({ ends }) =>
        ends.filter((end) => end.pocket === pocket).map(({ edge }) => edge.at(-1)!),
      );
    const walls = pockets.map(({ centre, radius }) =>
      new THREE.CylinderGeometry(radius, radius, TOP + 0.1, 32, 1, true)
        .rotateX(Math.PI / 2)
        .translate(centre[0], centre[1], (TOP - 0.1) / 2),
    );
    const holes = pockets.map(({ centre, radius }) =>
      new THREE.CircleGeometry(radius, 32).translate(centre[0], centre[1], 0.0012),
    );
    scene.add(
      joined(walls, inside),
      joined(holes, black),
      joined(
        pockets.map((pocket) => linerOf(table, pocket, endsOf(pocket))),
        leather,
      ),
    );
  }
  const marks = drawnOn(table);
  if (marks.length > 0)
    scene.add(joined(marks, new THREE.MeshLambertMaterial({ color: "#b9c9c0" })));
  const below = new THREE.MeshLambertMaterial({ color: wood });
  const legs = [0.12, 0.88].flatMap((x) =>
    [0.1, 0.5, 0.9].map((y) => box(x * width, y * length, 0.15, 0.15, FLOOR, -0.2)),
  );
  const apron = box(width / 2, length / 2, width + FRAME, length + FRAME, -0.22, -0.06);
  scene.add(joined([apron, ...legs], below), joined(sightsOf(table), ivory));
}

/** Lines and spots on the cloth. */
function drawnOn(table: Table): THREE.BufferGeometry[] {
  const { lines, spots } = markingsOf(table);
  const high = 0.0006;
  const parts = lines.flatMap((points) =>
    points.slice(1).map((end, k) => {
      const start = points[k]!;
      const part = new THREE.PlaneGeometry(distance(start, end) + 0.002, 0.003);
      return part
        .rotateZ(angleFrom(start, end))
        .translate((start[0] + end[0]) / 2, (start[1] + end[1]) / 2, high);
    }),
  );
  const dots = spots.map(([x, y]) => new THREE.CircleGeometry(0.005, 12).translate(x, y, high));
  return [...parts, ...dots];
}

/** Sights on the wood: long rails in eight parts, short ones in four; none on large tables. */
function sightsOf({ width, length, pockets }: Table): THREE.BufferGeometry[] {
  const sight = (x: number, y: number): THREE.BufferGeometry =>
    new THREE.CircleGeometry(length > 3 ? 1e-4 : 0.007, 12).translate(x, y, TOP + 0.0045);
  const out = CUSHION + 0.4 * WOOD;
  return [-out, out].flatMap((side) => {
    const x = side < 0 ? side : width + side;
    const y = side < 0 ? side : length + side;
    const long = [1, 2, 3, 4, 5, 6, 7].filter((k) => k !== 4 || pockets.length === 0);
    return [
      ...long.map((k) => sight(x, (length * k) / 8)),
      ...[1, 2, 3].map((k) => sight((width * k) / 4, y)),
    ];
  });
}
