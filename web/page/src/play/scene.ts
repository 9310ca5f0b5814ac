// The table in three.js, seen from above, from behind the cue, and as on television. furniture.ts
// and room.ts make what never moves, balls.ts and stick.ts what moves, ribbons.ts the lines on the
// cloth. This module is a separate part: the page contains it compressed, and starts it after its
// first view.
import * as THREE from "three";
import { WOOD } from "../../../player/table.js";
import type { FlatView, Pose, Table } from "../../../player/words.js";
import type { Line } from "../table/drawing.js";
import { Balls, type PaintedBall } from "./balls.js";
import { furnish } from "./furniture.js";
import { light, roomOf, surroundings } from "./room.js";
import { Ribbons } from "./ribbons.js";
import { clamp, turned } from "./shapes.js";
import { layStick, type Stick, stickMesh } from "./stick.js";
import { styleOf } from "./surfaces.js";

/**
 * A camera: its place, what it looks at, and how much it sees, degrees from top to bottom of its
 * frame: the part of the picture that no control covers counts so much for that, 0 to 1.
 */
interface Shot {
  eye: THREE.Vector3;
  target: THREE.Vector3;
  angle: number;
  framed: number;
}
/** Part of a frame, pixels from its corner. */
export interface Frame {
  left: number;
  top: number;
  width: number;
  height: number;
}
const DEGREES = 180 / Math.PI;
/** The height of the camera above the table: so high that its view is nearly flat. */
const CEILING = 5;
/** How fast a camera glides to another place: the share of its way that is left falls by e^-1 in this, s. */
const GLIDE = 0.18;
/** Behind the cue ball, m; and at most, where the pocket would not be seen. */
const BEHIND = 0.8;
const FARTHEST = 1.3;
/** The width of a line's pixel in the views from behind, m. */
const LINE = 0.0035;
/** The same from above, at most. */
const FINE = 0.0045;
/** How many frames are drawn before one is timed: the first ones compile programs and draw shadows. */
const WARM = 2;

/** From high behind an end of the table, from where all of it is seen within a frame. */
export function shotAcross(
  { width, length }: Table,
  phi: number,
  frame: Pick<Frame, "width" | "height">,
): Shot {
  const isTall = frame.width < frame.height;
  const end = Math.sin(phi / DEGREES) >= 0 ? -1 : 1;
  const [angle, slope] = isTall ? [40, 1.5] : [34, 0.5];
  const half = Math.tan(angle / 2 / DEGREES);
  const extent = length / 2 + WOOD;
  // The eye goes back, and up, until the far end is seen and the near one, which is the wider one.
  for (let back = extent; ; back += 0.02) {
    const height = slope * back;
    const near = Math.atan2(height, back - extent);
    const far = Math.atan2(height, back + extent);
    const spread = (near - far) / 2;
    const ahead = Math.hypot(height, back - extent) * Math.cos(spread);
    const wide = (width / 2 + WOOD) / ahead / half;
    if (Math.tan(spread) > half || wide > frame.width / frame.height) continue;
    const y = length / 2 + end * back;
    const gaze = height / Math.tan((near + far) / 2);
    const eye = new THREE.Vector3(width / 2, y, height);
    return { eye, target: new THREE.Vector3(width / 2, y - end * gaze, 0), angle, framed: 1 };
  }
}

export class Scene {
  readonly canvas: HTMLCanvasElement;
  readonly #renderer: THREE.WebGLRenderer;
  readonly #scene = new THREE.Scene();
  readonly #camera = new THREE.PerspectiveCamera(40, 1, 0.02, 30);
  readonly #fog = new THREE.Fog("#050506", 3.2, 9);
  readonly #lamp: THREE.SpotLight;
  readonly #balls: Balls;
  readonly #stick = stickMesh();
  readonly #ribbons = new Ribbons();
  readonly #table: Table;
  #shot: Shot | undefined;
  #goal: Shot | undefined;
  #isFlat = true;
  #frame: Frame = { left: 0, top: 0, width: 1, height: 1 };
  #pixel = LINE;

  /** `isFine`: for a graphics processor, with smooth edges, shadows of the lamp, and threads. */
  constructor(table: Table, balls: readonly PaintedBall[], isFine: boolean) {
    const renderer = new THREE.WebGLRenderer({
      antialias: isFine,
      powerPreference: "high-performance",
    });
    this.#renderer = renderer;
    this.canvas = renderer.domElement;
    renderer.shadowMap.enabled = true;
    renderer.shadowMap.type = THREE.PCFSoftShadowMap;
    // Neutral: others make yellow and orange balls pastel.
    renderer.toneMapping = THREE.NeutralToneMapping;
    renderer.toneMappingExposure = 1.02;
    renderer.setPixelRatio(Math.min(window.devicePixelRatio || 1, 2));
    const style = styleOf(table);
    const scene = this.#scene;
    this.#table = table;
    this.#camera.up.set(0, 0, 1);
    scene.background = this.#fog.color;
    scene.fog = this.#fog;
    scene.environment = surroundings(renderer, style.cloth);
    this.#lamp = light(scene, table);
    furnish(scene, table, style, isFine);
    this.#balls = new Balls(balls);
    this.#balls.lampShadows = false;
    scene.add(...roomOf(table), this.#balls.group, this.#stick, this.#ribbons.mesh);
    if (!isFine) this.coarsen();
  }

  /** `frame`: the part that no control covers. */
  size(width: number, height: number, frame: Frame): void {
    this.#renderer.setSize(width, height);
    this.#frame = frame;
  }

  // ---- Cameras

  /**
   * From above, as the flat view has the table, whose picture lies so many pixels from the corner of
   * this one. A place at the height of the balls' middles is where the flat view has it.
   */
  lookDown(view: FlatView, [x, y]: readonly [number, number]): void {
    const { width, length } = this.#table;
    const middle = [width / 2, length / 2] as const;
    const { scale, upright } = view;
    const [px, py] = view.place(...middle);
    const camera = this.#camera;
    this.#isFlat = true;
    this.#shot = undefined;
    // A line of a table that is small on the screen is at most a fraction of a ball wide.
    this.#pixel = Math.min(1 / scale, FINE);
    Object.assign(this.#fog, { near: 9, far: 30 });
    // From above, wood and metal would show nothing but the lamps.
    this.#scene.environmentIntensity = 0.4;
    camera.up.set(upright ? 0 : -1, upright ? 1 : 0, 0);
    camera.position.set(...middle, CEILING);
    camera.lookAt(...middle, 0);
    camera.updateMatrixWorld();
    camera.up.set(0, 0, 1);
    // The centre of the table need not be in the centre of the frame.
    const near = 0.1;
    const share = near / (CEILING - 0.0286) / scale;
    const left = -(px + x) * share;
    const top = (py + y) * share;
    const right = left + this.canvas.clientWidth * share;
    const bottom = top - this.canvas.clientHeight * share;
    camera.projectionMatrix.makePerspective(left, right, top, bottom, near, 30);
    camera.projectionMatrixInverse.copy(camera.projectionMatrix).invert();
  }
  /**
   * Looks along the cue from behind a place, from a height, m; and a little aside, so that a pocket
   * is seen too.
   */
  lookAlong(
    place: readonly number[],
    phi: number,
    height: number,
    pocket?: readonly number[],
  ): void {
    const aspect = this.canvas.clientWidth / this.canvas.clientHeight;
    const isTall = aspect < 1;
    const angle = isTall ? 56 : 40;
    const half = angle / 2;
    const direction = phi / DEGREES;
    const along = [Math.cos(direction), Math.sin(direction)] as const;
    const aside = Math.atan(aspect * Math.tan(half / DEGREES));
    const most = this.#wayToWood(place, along, -1) + 0.55;
    let back = Math.min(most, BEHIND);
    const eye = new THREE.Vector3();
    let seen = 0;
    // The camera moves back until both the cue ball and the pocket are in the frame.
    for (; ; back += 0.1) {
      eye.set(place[0]! - back * along[0], place[1]! - back * along[1], height);
      if (pocket) seen = turned(Math.atan2(pocket[1]! - eye.y, pocket[0]! - eye.x) - direction);
      if (Math.abs(seen) < 1.5 * aside || back + 0.1 > Math.min(most, FARTHEST)) break;
    }
    if (Math.abs(seen) > 1.2) seen = 0;
    const gaze = direction + clamp(seen / 2, -0.65 * aside, 0.65 * aside);
    // Above the far wood one sees the lamps of the room, and the cue ball is not above the middle by
    // much.
    const far = back + this.#wayToWood(place, along, 1);
    const down =
      Math.min(
        0.55 * half + Math.atan2(height, far) * DEGREES,
        Math.atan2(height, back) * DEGREES - 0.1 * half,
      ) / DEGREES;
    const target = new THREE.Vector3(
      Math.cos(gaze) * Math.cos(down),
      Math.sin(gaze) * Math.cos(down),
      -Math.sin(down),
    );
    this.#aim({ eye, target: target.add(eye), angle, framed: 0 });
  }
  /** How far the outer wood is off a place, along a direction or against it. */
  #wayToWood(place: readonly number[], along: readonly [number, number], sign: 1 | -1): number {
    const sizes = [this.#table.width, this.#table.length];
    const ways = along.map((share, axis) => {
      if (Math.abs(share) < 1e-9) return Infinity;
      const edge = sign * share > 0 ? sizes[axis]! + WOOD : -WOOD;
      return (edge - place[axis]!) / (sign * share);
    });
    return Math.min(...ways);
  }
  /** As on television, from behind the end of the table from which the stroke was played. */
  lookAcross(phi: number): void {
    this.#aim(shotAcross(this.#table, phi, this.#frame));
  }
  #aim(goal: Shot): void {
    this.#goal = goal;
    this.#pixel = LINE;
    Object.assign(this.#fog, { near: 3.2, far: 9 });
    this.#scene.environmentIntensity = 1;
    if (this.#isFlat || !this.#shot)
      this.#shot = { ...goal, eye: goal.eye.clone(), target: goal.target.clone() };
    this.#isFlat = false;
  }
  /** Moves the camera towards its goal for so many s, and returns whether it has come there. */
  glide(seconds: number): boolean {
    const shot = this.#shot;
    const goal = this.#goal;
    if (this.#isFlat || !shot || !goal) return true;
    const share = 1 - Math.exp(-seconds / GLIDE);
    shot.eye.lerp(goal.eye, share);
    shot.target.lerp(goal.target, share);
    shot.angle += (goal.angle - shot.angle) * share;
    shot.framed += (goal.framed - shot.framed) * share;
    if (shot.eye.distanceTo(goal.eye) + shot.target.distanceTo(goal.target) > 2e-3) return false;
    shot.eye.copy(goal.eye);
    shot.target.copy(goal.target);
    return true;
  }

  /** Shows the frame of a shot. */
  #frameShot({ angle, framed }: Shot): void {
    const { clientWidth, clientHeight } = this.canvas;
    const { left, top, width, height } = this.#frame;
    const camera = this.#camera;
    const wide = clientWidth + framed * (width - clientWidth);
    const high = clientHeight + framed * (height - clientHeight);
    camera.fov = angle;
    camera.aspect = wide / high;
    const corner = [-framed * left, -framed * top] as const;
    camera.setViewOffset(wide, high, ...corner, clientWidth, clientHeight);
  }

  // ---- Pictures

  draw(poses: readonly Pose[], stick: Stick | undefined, lines: readonly Line[]): void {
    this.#balls.pose(poses);
    this.#ribbons.lay(lines, this.#pixel);
    this.#stick.visible = stick !== undefined;
    if (stick) layStick(this.#stick, stick, this.#table);
    const camera = this.#camera;
    if (!this.#isFlat && this.#shot) {
      this.#frameShot(this.#shot);
      camera.position.copy(this.#shot.eye);
      camera.lookAt(this.#shot.target);
    }
    this.#renderer.render(this.#scene, camera);
  }
  /** Fewer pixels, and drawn shadows below the balls instead of the lamp's. */
  coarsen(): void {
    this.#renderer.setPixelRatio(1);
    this.#lamp.castShadow = false;
    this.#balls.lampShadows = true;
  }
  /** How long a frame takes, ms. */
  measure(): number {
    const gl = this.#renderer.getContext();
    const pixel = new Uint8Array(4);
    let start = 0;
    for (let k = 0; k < WARM; k++) {
      start = performance.now();
      this.#renderer.render(this.#scene, this.#camera);
      // Only what is read is certain to be drawn.
      gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
    }
    return performance.now() - start;
  }

  /** Where a point is seen, pixels of the page; NaN: behind the camera. */
  place(x: number, y: number, z: number): [number, number] {
    const point = new THREE.Vector3(x, y, z).project(this.#camera);
    return point.z > 1
      ? [NaN, NaN]
      : [
          ((point.x + 1) * this.canvas.clientWidth) / 2,
          ((1 - point.y) * this.canvas.clientHeight) / 2,
        ];
  }

  /** Whether a number on a ball faces the camera. */
  isFacing({ r, q }: Pose): boolean {
    const axis = new THREE.Vector3(0, 0, 1).applyQuaternion(
      new THREE.Quaternion(q[1]!, q[2]!, q[3]!, q[0]!),
    );
    const way = new THREE.Vector3(r[0]!, r[1]!, r[2]!).sub(this.#camera.position).normalize();
    return Math.abs(axis.dot(way)) > 0.6;
  }
  /** The point at a height that is seen at a pixel of the page; none above the horizon. */
  unplace(px: number, py: number, z: number): [number, number] | undefined {
    const eye = this.#camera.position;
    const way = new THREE.Vector3(
      (2 * px) / this.canvas.clientWidth - 1,
      1 - (2 * py) / this.canvas.clientHeight,
      0.5,
    )
      .unproject(this.#camera)
      .sub(eye);
    return way.z < -1e-6
      ? [eye.x - (way.x * (eye.z - z)) / way.z, eye.y - (way.y * (eye.z - z)) / way.z]
      : undefined;
  }

  close(): void {
    this.#renderer.dispose();
    // One that the browser took away is lost already.
    if (!this.#renderer.getContext().isContextLost()) this.#renderer.forceContextLoss();
  }
}
