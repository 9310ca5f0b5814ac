/* The models of an impact on a cushion: each is here once. README.md in this folder explains how to
 * add one; schema/numbers.h has their numbers. */
#ifndef CAROM_SRC_CUSHION_LIST_H
#define CAROM_SRC_CUSHION_LIST_H

#include "schema/sources.h"

/* X(NAME, name, impact, flight, rows, start, sources, text). In `impact` and `flight`, `c` is the
 * contact and `opt` are the options.
 *
 * impact: a call that takes the contact through the impact, with `mass` in kg; a carom_status.
 * flight: friction's impulse over the mass on a ball in flight, m/s. `v_n` is the closing speed
 *         along the line to the nose, `slip` the speed of the ball's surface there, both in m/s.
 *         It is called before c->e is read, and may change it.
 * rows:   fewer rows of a batch than this, about 50 us of work, are not worth a thread.
 * start:  restitution, friction and height of the nose (m) that single impacts on the table of
 *         CAROM_GAME_BILLIARD tell by this model, with which a fit of another table begins
 *         (docs/reference/constants.md); or CAROM_NO_START.
 * sources: the entries of shot/cite.c that it is on, schema/sources.h.
 * text:   what help and pages say of it.
 *
 * In flight there is no cloth. Then Mathavan's equations have a constant direction of slip, as
 * Han's do, so carom_han_friction() is their exact limit. It is also used for the smooth law, which
 * was not measured in flight. */
#define CAROM_CUSHION_MODELS(X)                                                                \
  X(MATHAVAN, "mathavan", carom_mathavan(c, opt->plain), carom_han_friction(c, v_n, slip), 16, \
    CAROM_START(0.898, 0.22, 0.037), CAROM_BY_MATHAVAN2010 | CAROM_BY_STRONGE2000,             \
    "the exact limit of Mathavan's model")                                                     \
  X(STRONGE, "stronge", carom_stronge(c, opt), carom_stronge_friction(c, v_n, slip, opt), 512, \
    CAROM_START(0.874, 0.22, 0.0365), CAROM_BY_STRONGE2000, "a closed form, compliant nose")   \
  X(HAN, "han", carom_han(c), carom_han_friction(c, v_n, slip), 512,                           \
    CAROM_START(0.874, 0.231, 0.03545), CAROM_BY_HAN2005, "a closed form, rigid nose")         \
  X(MIRROR, "mirror", carom_mirror(c), 0.0, 512, CAROM_START(0.875, 0.0, 0.037), 0,            \
    "the velocity into the cushion is reversed and multiplied by e")                           \
  X(EULER, "euler", carom_cushion_by_steps(c, opt, mass), carom_han_friction(c, v_n, slip),    \
    1 + 2000 / carom_cushion_steps(opt), CAROM_NO_START,                                       \
    CAROM_BY_MATHAVAN2010 | CAROM_BY_STRONGE2000, "Mathavan's model in N steps")               \
  X(SMOOTH, "smooth", carom_smooth(c, opt), carom_han_friction(c, v_n, slip), 512,             \
    CAROM_START(0.798, 0.255, 0.0365), CAROM_BY_HAN2005 | CAROM_BY_THREECUSHIONTOOL,           \
    "a closed form read off recorded impacts")

#define CAROM_START(e, mu, height) true, e, mu, height
#define CAROM_NO_START false, 0, 0, 0

#define CAROM_CUSHION_ONE(...) +1
enum { CAROM_CUSHION_MODEL_COUNT = 0 CAROM_CUSHION_MODELS(CAROM_CUSHION_ONE) };

#endif
