// Recordings of shots: shot.save() and carom.load(). A recording has the table, the balls, each
// stroke and a hash of each shot's end, but no events: the shots are played again, and every bit is
// compared. docs/reference/files.md has the format.
import { CaromError } from "./error.js";
import { layout, values } from "./generated/layout.js";
import type { Memory } from "./memory.js";
import type { Replayed } from "./recording.js";
import type { Shot } from "./shot.js";
import { readState, writeBalls, writeOptions, writeStruct, writeTable } from "./structs.js";

const RECORD = layout.carom_record.offset;
const END = layout.carom_record_end.offset;
/** Parts of a shot that was stopped and continued. */
const PARTS_MOST = 1000;

/** The functions of the library that this file uses. */
export interface Host {
  readonly memory: Memory;
  statusName(code: number): string;
  replay(recording: string | Iterable<string>): Iterable<Replayed>;
  /** The shot of a recording with its events, after the shot before it where it continues that. */
  replayed(shot: Replayed, previous: Shot | undefined): Shot;
}

/** A shot that is written: the members of `Shot` that a recording has. */
export type Played = Pick<
  Shot,
  "table" | "balls" | "cue" | "options" | "count" | "final" | "status"
>;

/** The recording of shots on one table; `names` are those for errors. */
export function recordingOf(
  host: Host,
  shots: readonly Played[],
  names: readonly string[],
): string {
  const [first] = shots;
  if (first === undefined)
    throw new RangeError("shots: the batch is empty; a recording needs at least one shot");
  const { memory } = host;
  const record = memory.allocate(layout.carom_record.size);
  const text = memory.allocate(values.CAROM_RECORD_TEXT);
  const line = (kind: number): string => {
    const size = memory.exports.carom_record_write(record, kind, text, values.CAROM_RECORD_TEXT);
    if (size === 0) throw new Error(`carom: a line of kind ${kind} of a recording was not written`);
    return new TextDecoder().decode(memory.u8.slice(text, text + size));
  };
  const number = (offset: number): number => Number(memory.i64[(record + offset) / 8]);

  /** The lines of a shot. One that was continued is played in parts up to its end. */
  const linesOf = (shot: Played, name: string): string => {
    const differs = `${name}: playing it again has other bits, so it cannot be saved; its table, balls or cue have been changed since it was played`;
    writeBalls(memory, record + RECORD.balls, shot.balls);
    memory.i64[(record + RECORD.moved) / 8] = 0n;
    let lines = line(values.CAROM_RECORD_BALLS);
    const cueAt = record + RECORD.cue;
    memory.u8.fill(0, cueAt, cueAt + layout.carom_cue.size);
    if (shot.cue) writeStruct(memory, cueAt, "carom_cue", shot.cue, "cue");
    for (let part = 0; part < PARTS_MOST; part++) {
      writeOptions(memory, record + RECORD.options, "carom_shot_options", shot.options);
      const kind = part === 0 ? values.CAROM_RECORD_SHOT : values.CAROM_RECORD_CONTINUE;
      const code = memory.exports.carom_record_play(record, kind, 0);
      if (number(RECORD.pending) !== values.CAROM_PENDING_LINE)
        throw new TypeError(
          `${name}: it was not played, so it cannot be saved: ${memory.text(memory.exports.carom_status_string(code))}`,
        );
      lines += line(kind);
      const status = number(RECORD.played + END.status);
      if (status <= 0 || number(RECORD.played + END.events) >= shot.count) break;
    }
    const final = shot.balls.map((_, k) =>
      readState(memory, record + RECORD.final + k * layout.carom_ball_state.size),
    );
    if (number(RECORD.played + END.events) !== shot.count || !isSame(final, shot.final))
      throw new TypeError(differs);
    return lines;
  };

  try {
    memory.i64[(record + RECORD.count) / 8] = BigInt(first.balls.length);
    writeTable(memory, record + RECORD.table, first.table);
    writeOptions(memory, record + RECORD.options, "carom_shot_options", first.options);
    const head = [values.CAROM_RECORD_HEAD, values.CAROM_RECORD_TABLE, values.CAROM_RECORD_OPTIONS];
    const begin = head.map(line).join("");
    const parts = shots.map((shot, k) => linesOf(shot, names[k]!));
    return begin + parts.join("") + line(values.CAROM_RECORD_END);
  } finally {
    memory.free(record);
    memory.free(text);
  }
}

/** Whether two lists of states have the same numbers. */
function isSame(a: readonly object[], b: readonly object[]): boolean {
  return JSON.stringify(a) === JSON.stringify(b);
}

/** The shots of a recording, each played again and compared. */
export function shotsOf(host: Host, recording: string | Iterable<string>): Shot[] {
  const shots: Shot[] = [];
  for (const read of host.replay(recording)) {
    if (!read.same)
      throw new CaromError(
        values.CAROM_ERROR_RECORD,
        host.statusName(values.CAROM_ERROR_RECORD),
        `shot ${read.shot} has other bits here than when it was recorded`,
        `line ${read.line}`,
      );
    const previous = read.continues ? shots.pop() : undefined;
    shots.push(host.replayed(read, previous));
  }
  if (shots.length === 0) throw new RangeError("recording: it contains no shot");
  return shots;
}

/** Whether lines are those of a match, which have format 3. */
export function isMatch(lines: readonly string[]): boolean {
  const head = lines.find((line) => line.trim() !== "") ?? "";
  return /^\s*\{\s*"recording"\s*:\s*\{\s*"format"\s*:\s*3\b/.test(head);
}
