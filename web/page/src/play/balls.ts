// All balls as one mesh: copies of one sphere with different colours and numbers. Stripes, circles
// and dots are computed for each pixel, so that their edges stay sharp at any distance. The numbers
// are read from one texture of sixteen.
import * as THREE from "three";
import { IVORY, type Pose } from "../../../player/words.js";
import { canvasOf, shadowPicture } from "./surfaces.js";

export interface PaintedBall {
  name: string;
  radius: number;
  colour: string;
}

/** The width of a number in the texture, pixels. */
const CELL = 128;
/** The numbers from 0 to 15, four by four: white on black. */
function numbers(): THREE.CanvasTexture {
  const [canvas, g] = canvasOf(4 * CELL, 4 * CELL);
  g.fillStyle = "#000";
  g.fillRect(0, 0, 4 * CELL, 4 * CELL);
  g.fillStyle = "#fff";
  g.textAlign = "center";
  g.textBaseline = "alphabetic";
  for (let number = 0; number < 16; number++) {
    const text = String(number);
    const size = text.length > 1 ? 84 : 96;
    g.save();
    g.translate(((number % 4) + 0.5) * CELL, (Math.floor(number / 4) + 0.5) * CELL);
    g.font = `700 ${size}px "Helvetica Neue", Helvetica, "Nimbus Sans", Arial, sans-serif`;
    // As wide as the circle lets it be, and its ink in the middle.
    const ink = g.measureText(text);
    const wide = ink.actualBoundingBoxRight + ink.actualBoundingBoxLeft;
    const high = ink.actualBoundingBoxAscent + ink.actualBoundingBoxDescent;
    const fit = Math.min(1, 84 / wide, 74 / high);
    g.scale(fit, fit);
    const right = (ink.actualBoundingBoxLeft - ink.actualBoundingBoxRight) / 2;
    g.fillText(text, right, (ink.actualBoundingBoxAscent - ink.actualBoundingBoxDescent) / 2);
    // A 6 and a 9 differ by a line below them.
    if (number === 6 || number === 9) g.fillRect(-24, high / 2 + 8, 48, 7);
    g.restore();
  }
  return Object.assign(new THREE.CanvasTexture(canvas), { anisotropy: 4 });
}

const VARYINGS = `varying vec3 vBall;
varying vec4 vPaint;
varying float vNumber;
varying float vHeight;
`;
const VERTEX = `attribute vec4 paint;
attribute float number;
${VARYINGS}`;
/**
 * The paint of a pixel. Of vPaint the last part says which dots a ball without a number has, by
 * which one sees how it turns: 1 pale ones, 2 the red ones of a cue ball.
 */
const PAINT = `
  vec3 d = normalize(vBall);
  vec3 a = abs(d);
  vec3 soft = max(fwidth(d), 1e-4);
  vec3 coat = vPaint.rgb;
  vec3 ivory = vec3(0.74, 0.71, 0.62);
  // A stripe leaves white caps at both ends of x.
  if (vNumber > 8.5) coat = mix(coat, ivory, smoothstep(0.6216 - soft.x, 0.6216 + soft.x, a.x));
  if (vNumber > 0.5) {
    float white = smoothstep(0.878 - soft.z, 0.878 + soft.z, a.z);
    vec2 cell = vec2(0.5) + 1.12 * vec2(d.x * sign(d.z), d.y);
    float n = floor(vNumber + 0.5);
    vec2 place = (vec2(mod(n, 4.0), 3.0 - floor(n / 4.0)) + clamp(cell, 0.02, 0.98)) / 4.0;
    float ink = textureGrad(numbers, place, dFdx(1.12 * d.xy) / 4.0, dFdy(1.12 * d.xy) / 4.0).r;
    coat = mix(coat, mix(ivory, vec3(0.012), ink), white);
  } else if (vPaint.a > 0.5) {
    float most = max(a.x, max(a.y, a.z));
    float w = max(fwidth(most), 1e-4);
    bool isCueBall = vPaint.a > 1.5;
    vec3 dot = isCueBall ? vec3(0.58, 0.01, 0.03) : mix(coat, vec3(0.86), 0.55);
    float r = isCueBall ? 0.9848 : 0.9925;
    coat = mix(coat, dot, smoothstep(r - w, r + w, most));
  }
  diffuseColor.rgb = coat;
`;
/** Down in a pocket there is no light. */
const DEPTH = "outgoingLight *= clamp(1.0 + vHeight / 0.08, 0.04, 1.0);\n";
function lacquer(): THREE.MeshPhysicalMaterial {
  const material = new THREE.MeshPhysicalMaterial({
    roughness: 0.25,
    clearcoat: 1,
    clearcoatRoughness: 0.04,
    // By its lower side, a ball would leave light on the cloth around its contact.
    shadowSide: THREE.FrontSide,
  });
  const map = numbers();
  material.onBeforeCompile = (shader) => {
    shader.uniforms.numbers = { value: map };
    shader.vertexShader =
      VERTEX +
      shader.vertexShader.replace(
        "#include <begin_vertex>",
        `#include <begin_vertex>
  vBall = position; vPaint = paint; vNumber = number;
  vHeight = (instanceMatrix * vec4(position, 1.0)).z;`,
      );
    shader.fragmentShader =
      `uniform sampler2D numbers;\n${VARYINGS}` +
      shader.fragmentShader
        .replace("#include <color_fragment>", PAINT)
        .replace("#include <opaque_fragment>", `${DEPTH}#include <opaque_fragment>`);
  };
  return material;
}

const LEVEL = new THREE.Quaternion();
/** A shadow on the cloth: its radius relative to the ball's, and its darkness. */
const CONTACT = [1.32, 1] as const;
const LAMP = [2.4, 0.35] as const;

export class Balls {
  readonly group = new THREE.Group();
  readonly #balls: THREE.InstancedMesh;
  readonly #shadows: THREE.InstancedMesh[];
  readonly #radii: number[];

  constructor(balls: readonly PaintedBall[]) {
    this.#radii = balls.map(({ radius }) => radius);
    const sphere = new THREE.SphereGeometry(1, 40, 28);
    const paint = new Float32Array(4 * balls.length);
    const number = new Float32Array(balls.length);
    balls.forEach(({ name, colour }, k) => {
      const { r, g, b } = new THREE.Color(colour);
      const dots = colour === IVORY ? 2 : 1;
      number[k] = Math.max(Number(name) || 0, 0);
      paint.set([r, g, b, number[k] > 0 ? 0 : dots], 4 * k);
    });
    sphere.setAttribute("paint", new THREE.InstancedBufferAttribute(paint, 4));
    sphere.setAttribute("number", new THREE.InstancedBufferAttribute(number, 1));
    this.#balls = new THREE.InstancedMesh(sphere, lacquer(), balls.length);
    this.#balls.castShadow = true;
    const map = shadowPicture();
    this.#shadows = [LAMP, CONTACT].map(([, opacity], k) => {
      const dark = new THREE.MeshBasicMaterial({
        map,
        opacity,
        transparent: true,
        depthWrite: false,
        polygonOffset: true,
        polygonOffsetFactor: -2,
      });
      const shadow = new THREE.InstancedMesh(new THREE.PlaneGeometry(2, 2), dark, balls.length);
      shadow.renderOrder = k + 1;
      return shadow;
    });
    for (const mesh of [...this.#shadows, this.#balls]) mesh.frustumCulled = false;
    this.group.add(...this.#shadows, this.#balls);
  }

  /** Whether a shadow of the lamp is drawn below each ball, where the lamp itself casts none. */
  set lampShadows(isShown: boolean) {
    this.#shadows[0]!.visible = isShown;
  }

  pose(poses: readonly Pose[]): void {
    const place = new THREE.Vector3();
    const turn = new THREE.Quaternion();
    const size = new THREE.Vector3();
    const matrix = new THREE.Matrix4();
    poses.forEach(({ r, q, seen }, k) => {
      const R = seen ? this.#radii[k]! : 0;
      place.set(r[0]!, r[1]!, r[2]!);
      turn.set(q[1]!, q[2]!, q[3]!, q[0]!);
      this.#balls.setMatrixAt(k, matrix.compose(place, turn, size.setScalar(R)));
      // Its shadows widen and go as a ball leaves the cloth.
      const height = Math.max(r[2]! - R, 0) / (R || 1);
      const isFalling = r[2]! < 0.6 * R;
      const share = isFalling || height > 2 ? 0 : R * (1 + 0.4 * height);
      place.z = 0.0012;
      [LAMP, CONTACT].forEach(([radius], which) => {
        matrix.compose(place, LEVEL, size.setScalar(radius * share));
        this.#shadows[which]!.setMatrixAt(k, matrix);
      });
    });
    for (const mesh of [...this.#shadows, this.#balls]) mesh.instanceMatrix.needsUpdate = true;
  }
}
