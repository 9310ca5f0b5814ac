// The sound of impacts, by their impulses: clicks of balls, knocks of cushions, slate and pockets,
// and the tip; the noise of rolling balls, by their speed; and a chord at the end of a game. Each
// sound is made of decaying tones and noise, is heard from where the impact is seen, and has the
// echo of a small room; none is loaded. Phone speakers are weak below 400 Hz, so every voice is
// loud enough above.
import type { EventType, Shot, ShotEvent } from "carom";

export interface Voice {
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
/** Rubber, which gives slowly, and the wood behind it, which is heard. */
const CUSHION: Voice = {
  tones: [
    [105, 0.35, 0.05],
    [640, 0.5, 0.024],
    [1130, 0.3, 0.012],
  ],
  noise: [0.5, 0.014, 0.55],
  full: 1.2,
};
const TIP: Voice = {
  tones: [
    [820, 0.5, 0.014],
    [330, 0.4, 0.02],
    [1900, 0.15, 0.006],
  ],
  noise: [0.4, 0.006, 0.5],
  full: 1.2,
};
/** A knock on the liner, and leather that rustles as the ball stops. */
const POCKET: Voice = {
  tones: [
    [120, 0.35, 0.08],
    [540, 0.5, 0.035],
    [910, 0.35, 0.022],
  ],
  noise: [0.45, 0.09, 0.7],
  full: 0.25,
};
const SLATE: Voice = {
  tones: [
    [150, 0.4, 0.05],
    [720, 0.5, 0.02],
    [1480, 0.25, 0.01],
  ],
  noise: [0.4, 0.01, 0.5],
  full: 0.25,
};
const VOICES: Partial<Record<EventType, Voice>> = {
  ball_ball: BALL,
  ball_linear_cushion: CUSHION,
  ball_circular_cushion: CUSHION,
  stick_ball: TIP,
  ball_pocket: POCKET,
  slate: SLATE,
  rail_top: SLATE,
};
/** The chords of a game that is won and of one that is lost: tones, Hz. */
const CHORDS = { won: [523.3, 659.3, 784, 1046.5], lost: [466.2, 415.3, 349.2] } as const;

/** How many values of a film's frame each ball has, and where its velocity is among them. */
const OF_BALL = 10;
const VELOCITY = 3;
/** The speed at which rolling is loudest, m/s, and how loud it is then. */
const FAST = 4;
const ROLLING = 0.16;
/** The room: for how long it sounds, s, its echo's decay, s, and its share. */
const ECHO = 0.4;
const ECHO_DECAY = 0.09;
const WET = 0.16;
/** A frame of a film longer than this skips its sounds, s: all would play at once. */
const LEAP = 0.5;

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

/** Noise from -1 to 1 by a fixed rule, so that it is the same each time. */
function hiss(seed: number): () => number {
  let state = seed;
  return () => {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return state / 2 ** 31 - 1;
  };
}
/** The wave of a voice, samples from -1 to 1. */
export function wave(
  { tones, noise: [share, decay, low] }: Voice,
  rate: number,
): Float32Array<ArrayBuffer> {
  const longest = Math.max(decay, ...tones.map(([, , d]) => d));
  const next = hiss(12345);
  let smooth = 0;
  return Float32Array.from({ length: Math.ceil(6 * longest * rate) }, (_, k) => {
    const t = k / rate;
    smooth += (1 - low) * (next() - smooth);
    let sum = share * smooth * Math.exp(-t / decay) * (1 + 2 * low);
    for (const [hertz, part, d] of tones)
      sum += part * Math.sin(2 * Math.PI * hertz * t) * Math.exp(-t / d);
    return 0.7 * Math.tanh(sum);
  });
}

/** Where a point of the table is seen: from -1, the left, to 1, the right. */
export type Side = (place: ArrayLike<number>) => number;
const panOf = (side: number): number => 0.8 * Math.min(Math.max(side || 0, -1), 1);

/** What sounds in one context of audio: voices from their sides, rolling, and their room. */
export class Mixer {
  readonly #buffers = new Map<Voice, AudioBuffer>();
  readonly #input: GainNode;
  readonly #rolling: { filter: BiquadFilterNode; gain: GainNode; pan: StereoPannerNode };

  constructor(readonly context: BaseAudioContext) {
    // Many sounds of a break together stay below what a speaker can do.
    const speaker = new DynamicsCompressorNode(context, {
      threshold: -12,
      ratio: 6,
      release: 0.12,
    });
    this.#input = new GainNode(context);
    this.#input.connect(speaker).connect(context.destination);
    const echo = new ConvolverNode(context, { buffer: this.#noise(ECHO, ECHO_DECAY) });
    this.#input
      .connect(new GainNode(context, { gain: WET }))
      .connect(echo)
      .connect(speaker);

    const source = new AudioBufferSourceNode(context, { buffer: this.#noise(2), loop: true });
    const filter = new BiquadFilterNode(context, { type: "bandpass", Q: 0.6 });
    const gain = new GainNode(context, { gain: 0 });
    const pan = new StereoPannerNode(context);
    source.connect(filter).connect(gain).connect(pan).connect(this.#input);
    source.start();
    this.#rolling = { filter, gain, pan };
  }
  /** So many s of noise, another at each ear, that decays. */
  #noise(seconds: number, decay = Infinity): AudioBuffer {
    const { sampleRate } = this.context;
    const length = Math.ceil(seconds * sampleRate);
    const buffer = new AudioBuffer({ length, sampleRate, numberOfChannels: 2 });
    for (const ear of [0, 1]) {
      const next = hiss(71 + ear);
      const samples = Float32Array.from(
        { length },
        (_, k) => next() * Math.exp(-k / sampleRate / decay),
      );
      buffer.copyToChannel(samples, ear);
    }
    return buffer;
  }
  #bufferOf(voice: Voice): AudioBuffer {
    const { sampleRate } = this.context;
    const known = this.#buffers.get(voice);
    if (known) return known;
    const samples = wave(voice, sampleRate);
    const buffer = new AudioBuffer({ length: samples.length, sampleRate });
    buffer.copyToChannel(samples, 0);
    this.#buffers.set(voice, buffer);
    return buffer;
  }

  /** Sounds an event after so many s, on its side. */
  strike(event: Pick<ShotEvent, "type" | "impulse" | "a" | "b">, side: number, delay = 0): void {
    const voice = VOICES[event.type];
    const loud = loudness(event);
    const { context } = this;
    if (!voice || loud < 0.02) return;
    const source = new AudioBufferSourceNode(context, {
      buffer: this.#bufferOf(voice),
      playbackRate: 0.94 + (0.12 * ((event.a * 7 + Math.max(event.b, 0) * 3) % 5)) / 5,
    });
    // What meets softly touches longer, and is duller.
    const frequency = 1500 + 14_000 * loud;
    source
      .connect(new BiquadFilterNode(context, { type: "lowpass", frequency }))
      .connect(new GainNode(context, { gain: 0.9 * loud }))
      .connect(new StereoPannerNode(context, { pan: panOf(side) }))
      .connect(this.#input);
    source.start(context.currentTime + delay);
  }
  /** Sounds balls that roll, by their speed, m/s; it fades where nobody renews it. */
  roll(speed: number, side: number): void {
    const { filter, gain, pan } = this.#rolling;
    const time = this.context.currentTime;
    const share = Math.min(speed / FAST, 1);
    filter.frequency.setTargetAtTime(420 + 900 * share, time, 0.03);
    pan.pan.setTargetAtTime(panOf(side), time, 0.03);
    gain.gain.cancelScheduledValues(time);
    gain.gain.setTargetAtTime(ROLLING * share, time, 0.03);
    gain.gain.setTargetAtTime(0, time + 0.2, 0.06);
  }
  /** Sounds the chord of a game that is over, tone after tone. */
  end(isWon: boolean): void {
    const { context } = this;
    CHORDS[isWon ? "won" : "lost"].forEach((hertz, k) => {
      const tones = [
        [hertz, 0.4, 0.3],
        [2 * hertz, 0.12, 0.15],
      ] as const;
      const buffer = this.#bufferOf({ tones, noise: [0, 0.01, 0], full: 1 });
      const source = new AudioBufferSourceNode(context, { buffer });
      source.connect(new GainNode(context, { gain: 0.35 })).connect(this.#input);
      source.start(context.currentTime + (isWon ? 0.09 : 0.16) * k);
    });
  }
}

/**
 * How fast balls roll over the cloth together, m/s, and on which side: loud ones count more. A ball
 * that is not on the cloth is not heard.
 */
function rollingOf(shot: Shot, time: number, sideOf: Side): readonly [number, number] {
  const { states, label } = shot.frame(time);
  let squares = 0;
  let sides = 0;
  shot.balls.forEach((_, k) => {
    const state = states.subarray(OF_BALL * k, OF_BALL * (k + 1));
    if (label(k) !== "rolling" && label(k) !== "sliding") return;
    const square = Math.hypot(state[VELOCITY]!, state[VELOCITY + 1]!) ** 2;
    squares += square;
    sides += square * sideOf(state);
  });
  return [Math.sqrt(squares), squares > 0 ? sides / squares : 0];
}

export class Sound {
  #context: AudioContext | undefined;
  #mixer: Mixer | undefined;

  constructor(public isOn: boolean) {}
  /** To be called when the reader has pressed something: browsers let pages sound only then. */
  wake(): void {
    if (!this.isOn) return;
    this.#context ??= new AudioContext();
    this.#mixer ??= new Mixer(this.#context);
    void this.#context.resume();
  }
  /** Plays the sounds of a shot between two times of its film, s. */
  play(shot: Shot, start: number, end: number, sideOf: Side): void {
    if (!this.isOn || !this.#mixer || end - Math.max(start, 0) > LEAP) return;
    for (const event of shot.events)
      if (event.time > start && event.time <= end)
        this.#mixer.strike(event, sideOf(event.after[0]!.r), event.time - Math.max(start, 0));
    this.#mixer.roll(...rollingOf(shot, end, sideOf));
  }
  /** Sounds that a game is over. */
  end(isWon: boolean): void {
    if (this.isOn) this.#mixer?.end(isWon);
  }
}
