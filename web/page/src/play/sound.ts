// The sound of what meets, by its impulse: clicks of balls, thuds of cushions, the tip, and balls
// that drop. Each is made of decaying tones and noise; no sound is loaded.
import type { EventType, ShotEvent } from "carom";

interface Voice {
  /** Tones: frequency, Hz, share, and decay, s. */
  tones: readonly (readonly [number, number, number])[];
  /** Noise: share, decay, s, and how much of it is low, 0 to 1. */
  noise: readonly [number, number, number];
  /** The impulse at which it is full, N s. */
  full: number;
}
const BALL: Voice = {
  tones: [
    [2750, 0.5, 0.012],
    [4300, 0.25, 0.007],
    [1500, 0.2, 0.01],
  ],
  noise: [0.3, 0.003, 0.1],
  full: 0.8,
};
const CUSHION: Voice = {
  tones: [
    [95, 0.9, 0.06],
    [170, 0.4, 0.04],
  ],
  noise: [0.25, 0.03, 0.9],
  full: 1.2,
};
const TIP: Voice = {
  tones: [
    [820, 0.5, 0.014],
    [330, 0.5, 0.02],
  ],
  noise: [0.4, 0.006, 0.5],
  full: 1.2,
};
const DROP: Voice = {
  tones: [
    [130, 0.7, 0.09],
    [62, 0.6, 0.12],
  ],
  noise: [0.4, 0.08, 0.95],
  full: 0.25,
};
const VOICES: Partial<Record<EventType, Voice>> = {
  ball_ball: BALL,
  ball_linear_cushion: CUSHION,
  ball_circular_cushion: CUSHION,
  stick_ball: TIP,
  ball_pocket: DROP,
  slate: DROP,
  rail_top: DROP,
};

/**
 * How loud an event is, 0 to 1: the ear hears about the root of the impulse. A ball that drops has
 * the sound of its weight.
 */
export function loudness({ type, impulse }: Pick<ShotEvent, "type" | "impulse">): number {
  const voice = VOICES[type];
  if (!voice) return 0;
  if (type === "ball_pocket") return 0.7;
  return Math.min(Math.sqrt(impulse / voice.full), 1);
}

/**
 * The wave of a voice, samples from -1 to 1. The noise is drawn by a fixed rule, so that it is the
 * same each time.
 */
export function wave(
  { tones, noise: [share, decay, low] }: Voice,
  rate: number,
): Float32Array<ArrayBuffer> {
  const longest = Math.max(decay, ...tones.map(([, , d]) => d));
  const samples = new Float32Array(Math.ceil(6 * longest * rate));
  let state = 12345;
  let smooth = 0;
  samples.forEach((_, k) => {
    const t = k / rate;
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    const white = state / 2 ** 31 - 1;
    smooth += (1 - low) * (white - smooth);
    let sum = share * smooth * Math.exp(-t / decay) * (1 + 2 * low);
    for (const [hertz, part, d] of tones)
      sum += part * Math.sin(2 * Math.PI * hertz * t) * Math.exp(-t / d);
    samples[k] = 0.7 * Math.tanh(sum);
  });
  return samples;
}

export class Sound {
  #context: AudioContext | undefined;
  readonly #buffers = new Map<Voice, AudioBuffer>();

  constructor(public isOn: boolean) {}
  /** To be called when the reader has pressed something: browsers let pages sound only then. */
  wake(): void {
    if (!this.isOn) return;
    this.#context ??= new AudioContext();
    void this.#context.resume();
  }
  /** Sounds what happens after one time of a film and until another, s. */
  play(events: readonly ShotEvent[], start: number, end: number): void {
    if (!this.isOn || !this.#context) return;
    for (const event of events) if (event.time > start && event.time <= end) this.#play(event);
  }
  #play(event: ShotEvent): void {
    const voice = VOICES[event.type];
    const loud = loudness(event);
    const context = this.#context!;
    if (!voice || loud < 0.02) return;
    let buffer = this.#buffers.get(voice);
    if (!buffer) {
      const samples = wave(voice, context.sampleRate);
      buffer = context.createBuffer(1, samples.length, context.sampleRate);
      buffer.copyToChannel(samples, 0);
      this.#buffers.set(voice, buffer);
    }
    const source = new AudioBufferSourceNode(context, {
      buffer,
      playbackRate: 0.94 + (0.12 * ((event.a * 7 + Math.max(event.b, 0) * 3) % 5)) / 5,
    });
    source.connect(new GainNode(context, { gain: 0.9 * loud })).connect(context.destination);
    source.start();
  }
}
