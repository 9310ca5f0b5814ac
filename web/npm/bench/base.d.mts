export function base(rows: ArrayLike<number>, at: number, N: number, s: number, out: Float64Array | number[], to: number): void;
