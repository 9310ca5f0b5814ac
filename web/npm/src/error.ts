import type { Shot } from "./shot.js";

/** What a call refuses, or how a shot ended that cannot go on. */
export class CaromError extends Error {
  constructor(
    /** Its number in carom.h. */
    readonly code: number,
    /** The name of the status, such as "bad_radius". */
    readonly status: string,
    text: string,
    /** The field or the ball at fault, where there is one: "a.r[0]", "balls[3]". */
    readonly field?: string,
    /** What had happened of a shot until then. */
    readonly shot?: Shot,
  ) {
    super(field === undefined ? text : `${field}: ${text}`);
    this.name = "CaromError";
  }
}
