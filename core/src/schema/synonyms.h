/* Other names that players use for words of the library: one row each.
 *
 * SYNONYM(name, word): `name` means `word` wherever that is one of the words to choose from. Names
 * and words are compared without capitals, hyphens, underscores and blanks. */
#ifndef CAROM_SRC_SCHEMA_SYNONYMS_H
#define CAROM_SRC_SCHEMA_SYNONYMS_H

#define CAROM_SYNONYM_ROWS(SYNONYM)      \
  /* games, racks and tables */          \
  SYNONYM("8ball", "eightball")          \
  SYNONYM("9ball", "nineball")           \
  SYNONYM("10ball", "tenball")           \
  SYNONYM("4ball", "fourball")           \
  SYNONYM("3cushion", "threecushion")    \
  SYNONYM("carom", "threecushion")       \
  SYNONYM("billiards", "threecushion")   \
  SYNONYM("14.1", "straight")            \
  SYNONYM("straightpool", "straight")    \
  SYNONYM("bankpool", "bank")            \
  SYNONYM("1pocket", "onepocket")        \
  SYNONYM("englishpool", "blackball")    \
  SYNONYM("chineseeightball", "heyball") \
  SYNONYM("chinese8ball", "heyball")     \
  SYNONYM("freepyramid", "pyramid")      \
  SYNONYM("russianpyramid", "pyramid")   \
  SYNONYM("pool", "9ft")                 \
  SYNONYM("7foot", "7ft")                \
  SYNONYM("8foot", "8ft")                \
  SYNONYM("9foot", "9ft")                \
  SYNONYM("10ft", "threecushion")        \
  SYNONYM("10foot", "threecushion")      \
  SYNONYM("12ft", "snooker")             \
  SYNONYM("12foot", "snooker")           \
  /* positions and pockets */            \
  SYNONYM("center", "centre")            \
  SYNONYM("middle", "centre")            \
  SYNONYM("head", "head-spot")           \
  SYNONYM("foot", "foot-spot")           \
  SYNONYM("top-left", "foot-left")       \
  SYNONYM("top-right", "foot-right")     \
  SYNONYM("middle-left", "side-left")    \
  SYNONYM("middle-right", "side-right")  \
  SYNONYM("bottom-left", "head-left")    \
  SYNONYM("bottom-right", "head-right")  \
  /* spins, speeds and tips */           \
  SYNONYM("rolling", "roll")             \
  SYNONYM("topspin", "follow")           \
  SYNONYM("backspin", "draw")            \
  SYNONYM("screw", "draw")               \
  SYNONYM("stop", "stun")                \
  SYNONYM("gentle", "soft")              \
  SYNONYM("firm", "fast")                \
  SYNONYM("hard", "fast")                \
  SYNONYM("check", "reverse")            \
  SYNONYM("top", "high")                 \
  SYNONYM("follow", "high")              \
  SYNONYM("bottom", "low")               \
  SYNONYM("draw", "low")                 \
  SYNONYM("screw", "low")                \
  SYNONYM("stun", "centre")              \
  /* conditions of a table */            \
  SYNONYM("slow", "slow_cloth")          \
  SYNONYM("dirty", "slow_cloth")         \
  SYNONYM("medium", "medium_cloth")      \
  SYNONYM("fast", "fast_cloth")          \
  SYNONYM("old", "old_cushion")          \
  SYNONYM("new", "new_cushion")          \
  SYNONYM("humid", "humid_cushion")      \
  SYNONYM("lively", "lively_cushion")    \
  SYNONYM("dead", "dead_cushion")

#endif
