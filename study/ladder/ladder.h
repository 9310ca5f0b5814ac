/* The ladder from outside: its rungs, its modules, and how to run one on the other.
 *
 *     // or "o3", "gcc-o3", "clang-archnative", ...
 *     const ladder_module *module = ladder_module_find("default", &why);
 *     const ladder_rung *rung = ladder_rung_find("cse");
 *     carom_status status = ladder_resolve(module, rung, &impact, &options, &result);
 */
#ifndef CAROM_LADDER_H
#define CAROM_LADDER_H

#include "carom.h"
#include "rung.h"

#include <stdbool.h>

/* What a rung computes in, and what it needs of the processor beyond x86-64's baseline. */
typedef enum ladder_precision { LADDER_DOUBLE, LADDER_SINGLE } ladder_precision;
typedef enum ladder_isa { LADDER_BASELINE, LADDER_AVX2, LADDER_AVX512 } ladder_isa;

/* A row of kernels.def, where the columns are explained. */
typedef struct ladder_rung {
  const char *name, *parent;
  ladder_precision precision;
  ladder_isa isa;
  size_t width;
  double bound;
  const char *paper;
  int over_1e3, over_1e2;
  const char *idea;
} ladder_rung;

/* The k-th rung, from the bottom, or NULL behind the last; the rung of that name, or NULL. */
const ladder_rung *ladder_rung_at(size_t k);
const ladder_rung *ladder_rung_find(const char *name);

/* Whether this processor can run it. */
bool ladder_rung_runs(const ladder_rung *rung);

/* "scalar", "avx2" or "avx512". */
const char *ladder_isa_name(ladder_isa isa);

/* One compiler's build of all rungs with one configuration. */
typedef struct ladder_module {
  const char *name;        /* "clang-default" */
  const char *compiler;    /* "clang" */
  const char *version;     /* of the compiler */
  const char *config;      /* "default" */
  const char *flags;       /* "-O3 ..." */
  const char *fingerprint; /* of its file, as fingerprint.h writes it */
  carom_rung *const *run;  /* by number of the rung */
} ladder_module;

/* The name of the k-th module that the build made ("clang-default"), or NULL behind the last. */
const char *ladder_module_name(size_t k);

/* Loads a module by its full name, or by that of a configuration alone: then the first
 * compiler's, and that is clang where there is one. A module stays loaded. NULL if there is no
 * such module or if it may not run here; `why`, of LADDER_WHY_SIZE, then says so in a sentence
 * and says what to do. Not to be called from two threads at once. */
enum { LADDER_WHY_SIZE = 1024 };
const ladder_module *ladder_module_find(const char *name, char why[LADDER_WHY_SIZE]);

/* Resolves one collision as carom_collide() does, with `opt->slip` and `opt->steps`;
 * `opt->solver` does not matter. More than the library, a rung refuses: unequal masses
 * (CAROM_ERROR_MASSES_DIFFER), steps that its precision does not resolve (CAROM_ERROR_TOO_SLOW),
 * and sizes and speeds beyond all billiards (CAROM_ERROR_OVERFLOW); resolve.c says where. */
carom_status ladder_resolve(const ladder_module *module, const ladder_rung *rung,
                            const carom_impact *in, const carom_options *opt, carom_result *out);

/* Resolves n collisions as carom_collide_batch() does; each pair as ladder_resolve() does. A rung
 * across collisions takes rung->width of them at once, and as long for one as for all of these. */
carom_status ladder_resolve_batch(const ladder_module *module, const ladder_rung *rung,
                                  const carom_impact *in, size_t n, const carom_options *opt,
                                  carom_result *out, int8_t *status);

#endif
