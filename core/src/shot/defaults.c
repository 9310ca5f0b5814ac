/* What a ball is played with where 0 means a default: the one reading of a game's numbers. The
 * functions that play a shot read a number by its row of CAROM_USUAL_... (schema/numbers.h), or by
 * the law of friction of models.c; here the same rows are written into the ball, so a shot of the
 * resulting ball has the bits of a shot of the original one. */
#include "platform/ranges.h"
#include "schema/numbers.h"
#include "shot/shot.h"
#include "shot/sim.h"

/* The height of the noses of a table, m; 0 where they differ or there are none. */
static double common_nose_height(const carom_table *table) {
  double height = table->rails > 0 ? table->rail[0].height : 0.0;
  for (int64_t index = 0; index < table->rails; index++)
    if (table->rail[index].height != height)
      height = 0.0;
  for (int64_t index = 0; index < table->jaws; index++)
    if (table->jaw[index].height != height)
      height = 0.0;
  return height;
}

/* The law of friction between balls, one number of which is above 0, as all 0 are a default: for a
 * constant friction the width law_c of a change of 0 is taken from carom_alciatore(). */
static void write_law(carom_ball_friction friction, carom_ball_kind *kind) {
  double law[3];
  carom_law_of_ball(friction, kind, law);
  if (friction == CAROM_FRICTION_CONSTANT)
    law[2] = carom_alciatore().c;
  kind->law_a = law[0];
  kind->law_b = law[1];
  kind->law_c = law[2];
}

carom_status carom_ball_kind_resolve(const carom_table *table, carom_shot_options *options,
                                     carom_ball_kind *kind) {
  static const carom_shot_options defaults = {.threads = 0};
  if (kind == NULL)
    return CAROM_ERROR_NULL;
  carom_shot_options chosen = options == NULL ? defaults : *options;
  carom_status status = carom_check_shot_options(&chosen);
  if (status == CAROM_OK && table != NULL)
    status = carom_check_table(table, &(int){0});
  if (status != CAROM_OK)
    return status;

  /* models of the world, and the numbers that they read */
  const carom_cushion_model cushion = carom_cushion_model_of(&chosen, kind);
  chosen.cushion_model = (carom_shot_cushion)((int)cushion + 1);
  chosen.ball_model = carom_ball_model_of(&chosen);
  if (cushion == CAROM_CUSHION_STRONGE)
    kind->omega_ratio = carom_or_usual(kind->omega_ratio, CAROM_USUAL_OMEGA_RATIO);
  if (cushion == CAROM_CUSHION_SMOOTH && !(kind->smooth_q > 0.0)) {
#define WRITE(member, usual) kind->member = (usual);
    CAROM_USUAL_SMOOTH(WRITE)
#undef WRITE
  }

  /* friction between balls as a law, the slate, contacts that last, noses */
  write_law(chosen.friction, kind);
  chosen.friction = CAROM_FRICTION_ALCIATORE;
  if (kind->restitution_table >= 0.0)
    kind->restitution_table = carom_slate_restitution(kind->restitution_table);
  kind->modulus = carom_or_usual(kind->modulus, CAROM_USUAL_MODULUS);
  if (table != NULL)
    kind->nose_height = carom_nose_height(kind, common_nose_height(table));
  if (options != NULL)
    *options = chosen;
  return CAROM_OK;
}
