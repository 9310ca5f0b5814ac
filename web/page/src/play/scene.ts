// The table from behind the cue, by three.js: the table in its room (furniture.ts), the cue, and
// balls with stripes and numbers that turn as the library computed. A module by itself: the page has it
// compressed and starts it when it is asked for.
import type { Cue } from "carom";
import * as THREE from "three";
import { WOOD } from "../../../player/table.js";
import { furnish } from "./furniture.js";
import { IVORY, type Pose, type Table } from "../../../player/words.js";

interface SceneOf {
  table: Table;
  balls: { name: string; radius: number; colour: string }[];
  cloth: string;
  wood: string;
}
/**
 * The cue, how far its tip is from the cue ball's middle, and where the cue ball first meets
 * something, m.
 */
interface Stick {
  cue: Cue;
  gap: number;
  first: readonly number[] | undefined;
}

const DEGREES = 180 / Math.PI;
/** The colour of numbers. */
const NUMBER = [22, 24, 27];

/**
 * The surface of a ball, around its z: white caps at both ends of x of a stripe, numbers at both
 * ends of z, or six dots of a cue ball.
 */
function surface({ name, colour }: SceneOf["balls"][number]): THREE.CanvasTexture {
  const canvas = document.createElement("canvas");
  [canvas.width, canvas.height] = [512, 256];
  const g = canvas.getContext("2d")!;
  const number = Number(name);
  // How much ink of the number there is in a square.
  g.font = `bold ${name.length > 1 ? 72 : 88}px sans-serif`;
  g.textAlign = "center";
  g.textBaseline = "middle";
  g.fillText(name, 64, 68);
  const ink = g.getImageData(0, 0, 128, 128).data;
  const pixels = g.createImageData(512, 256);
  const rgb = (hex: string): number[] => [1, 3, 5].map((k) => parseInt(hex.slice(k, k + 2), 16));
  const base = rgb(colour);
  const ivory = rgb(IVORY);
  const dot = colour === IVORY ? [200, 16, 46] : [255, 255, 255];
  for (let row = 0; row < 256; row++)
    for (let column = 0; column < 512; column++) {
      // three's sphere: u around its y, v from the top; z of the ball is y of the sphere.
      const around = (2 * Math.PI * (column + 0.5)) / 512;
      const down = (Math.PI * (row + 0.5)) / 256;
      const x = -Math.cos(around) * Math.sin(down);
      const y = -Math.sin(around) * Math.sin(down);
      const z = Math.cos(down);
      let colour = base;
      if (number > 8 && Math.abs(x) > Math.cos(0.9)) colour = ivory;
      if (number > 0 && Math.abs(z) > Math.cos(0.52)) {
        // The square on the ball: whoever sees the lower end has x to the left.
        const [u, v] = [64 + 160 * x * Math.sign(z), 64 - 160 * y].map(Math.floor) as [
          number,
          number,
        ];
        const black = (ink[4 * (128 * v + u) + 3] ?? 0) / 255;
        colour = ivory.map((part, k) => part + black * (NUMBER[k]! - part));
      }
      if (!(number > 0) && Math.max(Math.abs(x), Math.abs(y), Math.abs(z)) > Math.cos(0.2))
        colour = dot;
      pixels.data.set([...colour, 255], 4 * (512 * row + column));
    }
  g.putImageData(pixels, 0, 0);
  return Object.assign(new THREE.CanvasTexture(canvas), {
    colorSpace: THREE.SRGBColorSpace,
    anisotropy: 4,
  });
}

/** What a ball reflects: a dark room with a lamp above. */
function surroundings(): THREE.CubeTexture {
  const faces = ["px", "nx", "py", "ny", "pz", "nz"].map((name) => {
    const canvas = document.createElement("canvas");
    [canvas.width, canvas.height] = [64, 64];
    const g = canvas.getContext("2d")!;
    g.fillStyle = name === "nz" ? "#0d2a20" : "#0a0b0d";
    g.fillRect(0, 0, 64, 64);
    g.fillStyle = "#fff4dd";
    if (name === "pz") g.fillRect(28, 20, 8, 24);
    return canvas;
  });
  const cube = new THREE.CubeTexture(faces);
  cube.colorSpace = THREE.SRGBColorSpace;
  cube.needsUpdate = true;
  return cube;
}
/** A cue, its tip at the origin, and its butt towards -y: tip, ferrule, shaft, butt. */
function cueOf(): THREE.Group {
  const cue = new THREE.Group();
  const parts = [
    [0, 0.006, 0.0058, 0.006, "#3f7fbf"],
    [0.006, 0.026, 0.006, 0.0062, "#f6f2e6"],
    [0.026, 0.75, 0.0062, 0.0105, "#dcb783"],
    [0.75, 0.79, 0.0105, 0.011, "#1a1a1c"],
    [0.79, 1.42, 0.011, 0.0148, "#5a2a1c"],
  ] as const;
  for (const [start, end, thin, thick, colour] of parts) {
    const part = new THREE.Mesh(
      new THREE.CylinderGeometry(thin, thick, end - start, 20),
      new THREE.MeshPhongMaterial({ color: colour, shininess: 50, specular: "#444444" }),
    );
    part.position.y = -(start + end) / 2;
    part.castShadow = true;
    cue.add(part);
  }
  return cue;
}
/** A ball: a sphere whose y is the ball's z. */
function ballOf(ball: SceneOf["balls"][number], envMap: THREE.CubeTexture): THREE.Group {
  const sphere = new THREE.Mesh(
    new THREE.SphereGeometry(ball.radius, 40, 28),
    new THREE.MeshPhongMaterial({
      map: surface(ball),
      shininess: 140,
      specular: "#333333",
      envMap,
      combine: THREE.AddOperation,
      reflectivity: 0.15,
    }),
  );
  sphere.rotation.x = Math.PI / 2;
  sphere.castShadow = true;
  return new THREE.Group().add(sphere);
}

export class Scene {
  readonly canvas: HTMLCanvasElement;
  readonly #renderer: THREE.WebGLRenderer;
  readonly #scene = new THREE.Scene();
  readonly #camera = new THREE.PerspectiveCamera(40, 1, 0.02, 12);
  readonly #balls: THREE.Group[];
  readonly #stick: THREE.Group;
  readonly #aim: THREE.Mesh;
  readonly #ghost: THREE.Mesh;
  readonly #within: readonly [number, number];

  constructor(parts: SceneOf) {
    this.#renderer = new THREE.WebGLRenderer({ antialias: true });
    this.canvas = this.#renderer.domElement;
    this.#renderer.shadowMap.enabled = true;
    this.#renderer.shadowMap.type = THREE.PCFSoftShadowMap;
    this.#renderer.setPixelRatio(Math.min(window.devicePixelRatio || 1, 2));
    const { width, length } = parts.table;
    const scene = this.#scene;
    const around = surroundings();
    this.#camera.up.set(0, 0, 1);
    scene.background = new THREE.Color("#0e0f11");

    furnish(scene, parts);
    this.#balls = parts.balls.map((ball) => ballOf(ball, around));
    scene.add(...this.#balls);
    this.#stick = cueOf();
    // The aim on the cloth: a line to the place of the cue ball at its first contact, and a ring
    // there.
    const light = new THREE.MeshBasicMaterial({
      color: "#ffffff",
      transparent: true,
      opacity: 0.7,
    });
    const R = parts.balls[0]!.radius;
    this.#aim = new THREE.Mesh(new THREE.BoxGeometry(1, 0.007, 0.001), light);
    this.#ghost = new THREE.Mesh(new THREE.RingGeometry(0.88 * R, R, 32), light);
    this.#within = [width, length];
    scene.add(this.#stick, this.#aim, this.#ghost);
  }

  size(width: number, height: number): void {
    this.#renderer.setSize(width, height);
    this.#camera.aspect = width / height;
    // On a tall screen the table stays as wide as it is on a wide one.
    this.#camera.fov = width > height ? 38 : 58;
    this.#camera.updateProjectionMatrix();
  }

  /** Looks along the cue from behind a place, m. */
  look(target: readonly number[], phi: number): void {
    const along = [Math.cos(phi / DEGREES), Math.sin(phi / DEGREES)] as const;
    // A tall screen sees the table from higher, or it would show the room above it.
    const high = this.#camera.aspect > 1 ? 0.48 : 0.95;
    // How far off the outer wood is where the cue points, and behind the cue ball, where the camera
    // stays near it.
    const wood = (sign: number): number =>
      Math.min(
        ...along.map((d, c) =>
          Math.abs(d) < 1e-9
            ? Infinity
            : ((sign * d > 0 ? this.#within[c]! + WOOD : -WOOD) - target[c]!) / (sign * d),
        ),
      );
    const far = wood(1);
    const back = Math.min(wood(-1) + 0.5, 1.15);
    // That wood is seen below the upper edge, but the cue ball never near it.
    const half = this.#camera.fov / 2;
    const down =
      Math.min(
        half - 2.2 + Math.atan2(high, back + far) * DEGREES,
        0.5 * half + Math.atan2(high, back) * DEGREES,
      ) / DEGREES;
    const x = target[0]! - back * along[0];
    const y = target[1]! - back * along[1];
    this.#camera.position.set(x, y, high);
    this.#camera.lookAt(
      x + along[0] * Math.cos(down),
      y + along[1] * Math.cos(down),
      high - Math.sin(down),
    );
  }

  draw(poses: readonly Pose[], stick: Stick | undefined): void {
    poses.forEach(({ r, q, seen }, k) => {
      const ball = this.#balls[k]!;
      ball.visible = seen;
      ball.position.set(r[0]!, r[1]!, r[2]!);
      ball.quaternion.set(q[1]!, q[2]!, q[3]!, q[0]!);
    });
    const tip = stick?.first;
    const { r } = poses[stick?.cue.ball ?? 0]!;
    this.#stick.visible = stick !== undefined;
    this.#aim.visible = tip !== undefined;
    this.#ghost.visible = tip !== undefined;
    if (tip) {
      const dx = tip[0]! - r[0]!;
      const dy = tip[1]! - r[1]!;
      const gone = Math.hypot(dx, dy);
      this.#aim.scale.x = Math.max(gone, 1e-3);
      this.#aim.rotation.z = Math.atan2(dy, dx);
      this.#aim.position.set(r[0]! + dx / 2, r[1]! + dy / 2, 0.001);
      this.#ghost.position.set(tip[0]!, tip[1]!, 0.002);
    }
    if (stick) {
      const R = r[2]!;
      const { a, b } = stick.cue;
      const phi = stick.cue.phi / DEGREES;
      const theta = Math.max(stick.cue.theta, 3) / DEGREES;
      // From the butt to the tip, and what is to the right of it and above.
      const along = new THREE.Vector3(
        Math.cos(phi) * Math.cos(theta),
        Math.sin(phi) * Math.cos(theta),
        -Math.sin(theta),
      );
      const right = new THREE.Vector3(Math.sin(phi), -Math.cos(phi), 0);
      const up = new THREE.Vector3().crossVectors(right, along);
      this.#stick.position
        .set(r[0]!, r[1]!, R)
        .addScaledVector(right, -a * R)
        .addScaledVector(up, b * R)
        .addScaledVector(along, -stick.gap);
      this.#stick.quaternion.setFromUnitVectors(new THREE.Vector3(0, 1, 0), along);
    }
    this.#renderer.render(this.#scene, this.#camera);
  }

  /** Where a place is seen, pixels of the page; NaN: behind the camera. */
  place(x: number, y: number, z: number): [number, number] {
    const point = new THREE.Vector3(x, y, z).project(this.#camera);
    return point.z > 1
      ? [NaN, NaN]
      : [
          ((point.x + 1) * this.canvas.clientWidth) / 2,
          ((1 - point.y) * this.canvas.clientHeight) / 2,
        ];
  }

  /** The place at a height that is seen at a pixel of the page; none above the horizon. */
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
    this.#renderer.forceContextLoss();
  }
}
