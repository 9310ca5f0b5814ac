import type { Shot } from "./shot.js";

/** The error of a call that rejects its arguments, or of a shot that cannot be continued. */
export class CaromError extends Error {
  constructor(
    /** The number of the status in carom.h. */
    readonly code: number,
    /** The name of the status, such as "bad_radius". */
    readonly status: string,
    text: string,
    /** The field or the ball at fault, if there is one: "a.r[0]", "balls[3]". */
    readonly field?: string,
    /** The shot up to the error. */
    readonly shot?: Shot,
  ) {
    super(field === undefined ? text : `${field}: ${text}`);
    this.name = "CaromError";
  }
}
