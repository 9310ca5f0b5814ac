// A pinhole camera, for pictures whose camera is known.
import type { Pixel } from "../src/play/photo.js";

/**
 * A camera at a place that looks at another, with a focal length in pixels: where a point of space
 * is seen.
 */
export function pinhole(
  size: Pixel,
  eye: number[],
  target: number[],
  focal: number,
): (x: number, y: number, z: number) => Pixel {
  const minus = (a: number[], b: number[]) => a.map((x, k) => x - b[k]!);
  const cross = ([a, b, c]: number[], [x, y, z]: number[]) => [
    b! * z! - c! * y!,
    c! * x! - a! * z!,
    a! * y! - b! * x!,
  ];
  const unit = (a: number[]) => a.map((x) => x / Math.hypot(...a));
  const dot = (a: number[], b: number[]) => a.reduce((sum, x, k) => sum + x * b[k]!, 0);
  const ahead = unit(minus(target, eye));
  const right = unit(cross(ahead, Math.abs(ahead[2]!) > 0.999 ? [0, 1, 0] : [0, 0, 1]));
  const down = cross(ahead, right);
  return (x, y, z) => {
    const offset = minus([x, y, z], eye);
    const far = dot(offset, ahead);
    return [
      size[0] / 2 + (focal * dot(offset, right)) / far,
      size[1] / 2 + (focal * dot(offset, down)) / far,
    ];
  };
}
