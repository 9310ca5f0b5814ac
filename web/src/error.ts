import type { Shot } from "./shot.js";

/** What a call refuses, or how a shot ended that cannot go on. */
export class CaromError extends Error {
  /** The name of the status, such as "bad_radius". */
  readonly status: string;
  /** Its number in carom.h. */
  readonly code: number;
  /** The field or the ball at fault, where there is one: "a.r[0]", "balls[3]". */
  readonly field: string | undefined;
  /** What had happened of a shot until then. */
  readonly shot: Shot | undefined;

  constructor(code: number, status: string, text: string, field?: string, shot?: Shot) {
    super(field === undefined ? text : `${field}: ${text}`);
    this.name = "CaromError";
    this.code = code;
    this.status = status;
    this.field = field;
    this.shot = shot;
  }
}
