/* What advance.c is compiled to: once with vectors of two numbers, and once with four for AVX2. */
#ifndef CAROM_SRC_IMPACT_ADVANCE_H
#define CAROM_SRC_IMPACT_ADVANCE_H

#include "impact/impact.h"

/* As carom_impact_advance(). */
carom_status carom_impact_advance_plain(carom_trajectory *path, double to, int most);
carom_status carom_impact_advance_avx2(carom_trajectory *path, double to, int most);

#ifdef CAROM_LANES_AVX2
#define CAROM_IMPACT_ADVANCE carom_impact_advance_avx2
#else
#define CAROM_IMPACT_ADVANCE carom_impact_advance_plain
#endif

#endif
