/* What models are on: the entries of shot/cite.c, as a set. */
#ifndef CAROM_SRC_SCHEMA_SOURCES_H
#define CAROM_SRC_SCHEMA_SOURCES_H

enum {
  CAROM_BY_CAROM = 1 << 0, /* of every shot, with the next two */
  CAROM_BY_MARLOW1995 = 1 << 1,
  CAROM_BY_ALCIATORE_SQUIRT = 1 << 2,
  CAROM_BY_ALCIATORE_THROW = 1 << 3,
  CAROM_BY_BANNERMAN2014 = 1 << 4,
  CAROM_BY_MATHAVAN2014 = 1 << 5,
  CAROM_BY_MATHAVAN2010 = 1 << 6,
  CAROM_BY_HAN2005 = 1 << 7,
  CAROM_BY_THREECUSHIONTOOL = 1 << 8,
  CAROM_BY_STRONGE2000 = 1 << 9,
  CAROM_BY_HERTZ1882 = 1 << 10,
  CAROM_BY_KIEFL2024 = 1 << 11,
  CAROM_BY_JORIS_ACCELERATING = 1 << 12
};

#endif
