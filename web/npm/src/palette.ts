// Written by tools/palette.py from data/palette.csv: colours and sizes of a table from above.

/** Colours and sizes (m; margin and letters are shares) of a table from above, as carom's command draws it. */
export const palette = {
  cloth: {
    pool: "#0a5568",
    snooker: "#15592f",
    carom: "#17508a",
  },
  cushion: {
    pool: "#073d4b",
    snooker: "#0f4022",
    carom: "#103a63",
  },
  wood: {
    pool: "#5f3721",
    snooker: "#5f2814",
    carom: "#3a2418",
  },
  part: {
    nose: "#06181d",
    pocket: "#111111",
    mark: "#e8dcc0",
    text: "#ffffff",
    aim: "#ffd166",
  },
  size: {
    margin: 0.05,
    corner: 0.045,
    bedCorner: 0.025,
    nose: 0.01,
    path: 0.0055,
    diamond: 0.01,
    diamondWidth: 0.0075,
    letters: 0.0184,
  },
  /** The cue ball, 1 to 8, and others of snooker. */
  balls: [
    { name: "white", colour: "#fbfaf5", path: "#ffffff", ink: "#111111" },
    { name: "yellow", colour: "#e3b505", path: "#faee26", ink: "#111111" },
    { name: "blue", colour: "#1446a0", path: "#75b2fb", ink: "#ffffff" },
    { name: "red", colour: "#c8102e", path: "#fc7460", ink: "#ffffff" },
    { name: "purple", colour: "#5b2a86", path: "#e4d3ff", ink: "#ffffff" },
    { name: "orange", colour: "#e8702a", path: "#fead10", ink: "#111111" },
    { name: "green", colour: "#12664f", path: "#b7f3a8", ink: "#ffffff" },
    { name: "maroon", colour: "#7a1f2b", path: "#cb8ba6", ink: "#ffffff" },
    { name: "black", colour: "#16181b", path: "#c0c0c0", ink: "#ffffff" },
    { name: "brown", colour: "#7b4a21", path: "#fead10", ink: "#ffffff" },
    { name: "pink", colour: "#e58fa5", path: "#cb8ba6", ink: "#111111" },
  ],
} as const;
