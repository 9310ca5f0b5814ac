/* clang-format off */
/* Written by tools/palette.py from data/palette.csv: colours and sizes of a table from above. */
#ifndef CAROM_CLI_PALETTE_H
#define CAROM_CLI_PALETTE_H

#define PALETTE_NOSE "#06181d"
#define PALETTE_POCKET "#111111"
#define PALETTE_MARK "#e8dcc0"
#define PALETTE_TEXT "#ffffff"
#define PALETTE_AIM "#ffd166"
/* Sizes are in metres, but the margin and the letters are shares. */
#define PALETTE_SIZE_MARGIN 0.05
#define PALETTE_SIZE_CORNER 0.045
#define PALETTE_SIZE_BED_CORNER 0.025
#define PALETTE_SIZE_NOSE 0.01
#define PALETTE_SIZE_PATH 0.0055
#define PALETTE_SIZE_DIAMOND 0.01
#define PALETTE_SIZE_DIAMOND_WIDTH 0.0075
#define PALETTE_SIZE_LETTERS 0.0184

/* TABLE(discipline, cloth, cushion, wood) */
#define PALETTE_TABLES(TABLE) \
  TABLE(pool, "#0a5568", "#073d4b", "#5f3721") \
  TABLE(snooker, "#15592f", "#0f4022", "#5f2814") \
  TABLE(carom, "#17508a", "#103a63", "#3a2418")

/* BALL(name, colour, path, ink): the cue ball, 1 to 8, and others of snooker */
#define PALETTE_BALLS(BALL) \
  BALL("white", "#fbfaf5", "#ffffff", "#111111") \
  BALL("yellow", "#e3b505", "#faee26", "#111111") \
  BALL("blue", "#1446a0", "#75b2fb", "#ffffff") \
  BALL("red", "#c8102e", "#fc7460", "#ffffff") \
  BALL("purple", "#5b2a86", "#e4d3ff", "#ffffff") \
  BALL("orange", "#e8702a", "#fead10", "#111111") \
  BALL("green", "#12664f", "#b7f3a8", "#ffffff") \
  BALL("maroon", "#7a1f2b", "#cb8ba6", "#ffffff") \
  BALL("black", "#16181b", "#c0c0c0", "#ffffff") \
  BALL("brown", "#7b4a21", "#fead10", "#ffffff") \
  BALL("pink", "#e58fa5", "#cb8ba6", "#111111")

#endif
