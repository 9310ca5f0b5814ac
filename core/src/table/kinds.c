/* Balls and cues of the games. docs/reference/constants.md has the source of each number. */
#include "carom_shot.h"
#include "platform/arithmetic.h"
#include "schema/numbers.h"
#include "schema/rows.h"

#include <stdbool.h>
#include <stddef.h>

carom_cue carom_cue_of(carom_game game) {
  const bool snooker = game == CAROM_GAME_SNOOKER || game == CAROM_GAME_POOLTOOL_SNOOKER;
  const bool pooltool = game == CAROM_GAME_POOLTOOL_POOL || game == CAROM_GAME_POOLTOOL_SNOOKER ||
                        game == CAROM_GAME_POOLTOOL_BILLIARD;
  return (carom_cue){.speed = 2.0,
                     .phi = 90.0,
                     .b = 0.25,
                     .mass = snooker ? 0.478 : 0.567,
                     .end_mass = carom_ball_kind_of(game).mass / 30.0,
                     .tip_restitution = pooltool ? 1.0 : CAROM_TIP_LEATHER,
                     .tip_radius = 0.0106045,
                     .follow = pooltool ? 0.0 : CAROM_CUE_FOLLOW};
}

/* What the smooth law has in every game: its form was read off one billiard table. */
static void take_smooth_law(carom_ball_kind *kind) {
#define TAKE(member, usual) kind->member = (usual);
  CAROM_USUAL_SMOOTH(TAKE)
#undef TAKE
  kind->roll_loss_log = 0.034;
}

/* Takes away what the default's model of the cushion has in addition to friction and
 * restitution. */
static void drop_smooth_law(carom_ball_kind *kind) {
#define DROP(member, usual) kind->member = 0.0;
  CAROM_USUAL_SMOOTH(DROP)
#undef DROP
  kind->mu_log = kind->restitution_log = kind->restitution_log2 = 0.0;
  kind->roll_loss = kind->roll_loss_log = kind->nose_height = 0.0;
}

static void take_pool(carom_ball_kind *kind) {
  /* throws at known speeds */
  kind->law_a = 0.042;
  kind->law_b = 0.12;
  kind->law_c = 1.3;

  take_smooth_law(kind);
  kind->mu_cushion = 0.28;
  kind->restitution_cushion = 0.8;
  kind->nose_height = 0.034;
  kind->roll_loss = 0.09;
}

/* From filmed shots (data/README.md); mu_slide was measured on one table. */
static void take_snooker(carom_ball_kind *kind) {
  kind->mu_slide = 2.075 / 9.81;
  kind->mu_roll = 0.0084;
  kind->drag = 0.0107;
  kind->restitution = 0.955;

  /* the change with speed was measured in straight rebounds, at 0.5 to 2.5 m/s */
  take_smooth_law(kind);
  kind->smooth_x = 1.0;
  kind->mu_cushion = 0.28;
  kind->restitution_cushion = 0.85;
  kind->restitution_log = 0.017;
  kind->restitution_log2 = -0.0989;
  kind->nose_height = 0.0304;
  kind->roll_loss = 0.09;
}

/* Measured on one table, from recorded shots. */
static void take_billiard(carom_ball_kind *kind) {
  kind->mu_slide = 0.196;
  kind->mu_roll = 0.0042;
  kind->drag = 0.0118;
  kind->mu_spin = 0.0038;
  kind->restitution = 0.947;
  kind->mu_ball = 0.08;
  kind->law_a = 0.049;
  kind->law_b = 0.165;
  kind->law_c = 0.56;

  take_smooth_law(kind);
  kind->mu_cushion = 0.255;
  kind->mu_log = -0.010;
  kind->restitution_cushion = 0.798;
  kind->nose_height = 0.0365;
  kind->roll_loss = 0.091;
}

/* Games with the balls of another game in another size, a row each. */
static const struct sized {
  carom_game game, base;
  double radius, mass;
} sized_games[] = {
    {CAROM_GAME_BLACKBALL, CAROM_GAME_POOL, 0.0254, 0.116},
    {CAROM_GAME_PYRAMID, CAROM_GAME_POOL, 0.034, 0.285},
    {CAROM_GAME_FOURBALL, CAROM_GAME_BILLIARD, 0.03275, 0.210 * 1.0650 * 1.0650 * 1.0650}};

/* The row of a game; NULL for a game with its own constants. */
static const struct sized *sized_of(carom_game game) {
  for (size_t index = 0; index < sizeof sized_games / sizeof *sized_games; index++)
    if (sized_games[index].game == game)
      return &sized_games[index];
  return NULL;
}

/* The numbers of the base in the size of a row: lengths are in the ratio of the balls. */
static void resize(carom_ball_kind *kind, const struct sized *row) {
  const double ratio = row->radius / kind->radius;
  kind->radius = row->radius;
  kind->mass = row->mass;
  kind->mu_spin *= ratio;
  kind->nose_height *= ratio;
}

carom_game carom_game_of_table(carom_table_kind table) {
  switch (table) {
  case CAROM_TABLE_SNOOKER:
    return CAROM_GAME_SNOOKER;
  case CAROM_TABLE_THREECUSHION:
    return CAROM_GAME_BILLIARD;
  case CAROM_TABLE_BLACKBALL:
    return CAROM_GAME_BLACKBALL;
  case CAROM_TABLE_PYRAMID:
    return CAROM_GAME_PYRAMID;
  case CAROM_TABLE_FOURBALL:
    return CAROM_GAME_FOURBALL;
  default:
    return CAROM_GAME_POOL;
  }
}

carom_ball_kind carom_ball_kind_of(carom_game game) {
  const struct sized *row = sized_of(game);
  if (row != NULL) {
    carom_ball_kind sized_kind = carom_ball_kind_of(row->base);
    resize(&sized_kind, row);
    return sized_kind;
  }

  /* pooltool's: pool */
  carom_ball_kind kind = {.mass = 0.170097,
                          .radius = 0.028575,
                          .mu_slide = 0.2,
                          .mu_roll = 0.01,
                          .mu_ball = 0.05,
                          .restitution = 0.95,
                          .mu_cushion = 0.2,
                          .restitution_cushion = 0.85,
                          .gravity = 9.81};

  /* snooker and carom */
  if (game == CAROM_GAME_SNOOKER || game == CAROM_GAME_POOLTOOL_SNOOKER) {
    kind.mass = 0.140;
    kind.radius = game == CAROM_GAME_SNOOKER ? 0.02625 : 0.02619375;
    kind.mu_slide = kind.mu_cushion = 0.5;
  } else if (game == CAROM_GAME_BILLIARD || game == CAROM_GAME_POOLTOOL_BILLIARD) {
    kind.mass = 0.210;
    kind.radius = 0.03075;
    kind.mu_cushion = 0.15;
  }
  kind.mu_spin = 10.0 * 2.0 / 5.0 / 9.0 * kind.radius;

  /* carom's own */
  if (game == CAROM_GAME_SNOOKER)
    take_snooker(&kind);
  else if (game == CAROM_GAME_BILLIARD)
    take_billiard(&kind);
  else if (game != CAROM_GAME_POOLTOOL_POOL && game != CAROM_GAME_POOLTOOL_SNOOKER &&
           game != CAROM_GAME_POOLTOOL_BILLIARD)
    take_pool(&kind);
  return kind;
}

/* The numbers of a game for a model that is not its default. The constants of billiard are in
 * list.h, because a fit of another table begins with them. */
static const struct model_numbers {
  carom_game game;
  carom_shot_cushion cushion;
  double restitution, mu, nose_height, omega_ratio, restitution_log, restitution_log2;
} others[] = {
    {CAROM_GAME_POOL, CAROM_SHOT_CUSHION_HAN, 0.92, 0.3, 0.0, 0.0, 0.0, 0.0},
    {CAROM_GAME_POOL, CAROM_SHOT_CUSHION_STRONGE, 0.81, 0.28, 0.032, 1.96, 0.0, 0.0},
    {CAROM_GAME_POOL, CAROM_SHOT_CUSHION_MATHAVAN, 0.97, 0.3, 0.0, 0.0, 0.0, 0.0},
    {CAROM_GAME_POOL, CAROM_SHOT_CUSHION_EULER, 0.97, 0.3, 0.0, 0.0, 0.0, 0.0},
    {CAROM_GAME_POOL, CAROM_SHOT_CUSHION_MIRROR, 0.85, 0.0, 0.0, 0.0, 0.0, 0.0},
    {CAROM_GAME_SNOOKER, CAROM_SHOT_CUSHION_HAN, 0.948, 0.2, 0.03074, 0.0, 0.0079, -0.0948},
    {CAROM_GAME_SNOOKER, CAROM_SHOT_CUSHION_MATHAVAN, 0.9, 0.17, 0.0, 0.0, 0.0, 0.0},
    {CAROM_GAME_SNOOKER, CAROM_SHOT_CUSHION_EULER, 0.9, 0.17, 0.0, 0.0, 0.0, 0.0}};

/* Sets the constants of a kind for another model; false if the game has none for it. */
static bool take_other(carom_game game, carom_shot_cushion cushion, carom_ball_kind *kind) {
  drop_smooth_law(kind);
  if (game == CAROM_GAME_BILLIARD) {
    kind->roll_loss = 0.087;
    if (cushion == CAROM_SHOT_CUSHION_MIRROR)
      kind->roll_loss = 0.0;
    if (cushion == CAROM_SHOT_CUSHION_EULER)
      cushion = CAROM_SHOT_CUSHION_MATHAVAN;
    return carom_cushion_start((carom_cushion_model)((uint32_t)cushion - 1), kind);
  }
  for (size_t index = 0; index < sizeof others / sizeof *others; index++) {
    const struct model_numbers *row = &others[index];
    if (row->game != game || row->cushion != cushion)
      continue;
    kind->restitution_cushion = row->restitution;
    kind->mu_cushion = row->mu;
    kind->nose_height = row->nose_height;
    kind->omega_ratio = row->omega_ratio;
    kind->restitution_log = row->restitution_log;
    kind->restitution_log2 = row->restitution_log2;
    return true;
  }
  return false;
}

int carom_ball_kind_for(carom_game game, carom_shot_cushion cushion, carom_ball_kind *kind) {
  const struct sized *row = sized_of(game);
  if (row != NULL) {
    carom_ball_kind of_base;
    const int has = carom_ball_kind_for(row->base, cushion, &of_base);
    resize(&of_base, row);
    if (kind != NULL)
      *kind = of_base;
    return has;
  }
  carom_ball_kind fitted = carom_ball_kind_of(game);
  const bool smooth = fitted.smooth_q > 0.0;
  bool is_fitted = true;
  if (smooth && cushion != CAROM_SHOT_CUSHION_DEFAULT && cushion != CAROM_SHOT_CUSHION_SMOOTH)
    is_fitted = take_other(game, cushion, &fitted);
  if (kind != NULL)
    *kind = is_fitted ? fitted : carom_ball_kind_of(game);
  return is_fitted;
}

/* Conditions of a pool table; 0: the number stays. docs/reference/constants.md has the sources
 * of the signs and of the range of mu_roll. The changes of the cushion are one standard deviation
 * of the tables that public systems of players describe, as in calibrate.c. The friction of old
 * ones has two, because with less the banks of a slower rebound return longer, not shorter. Lively
 * and dead cushions are the ends of published straight rebounds. */
static const struct condition_numbers {
  double mu_roll, restitution, mu_cushion;
} conditions[] = {[CAROM_CONDITION_SLOW_CLOTH] = {0.015, 0.0, 0.0},
                  [CAROM_CONDITION_MEDIUM_CLOTH] = {0.01, 0.0, 0.0},
                  [CAROM_CONDITION_FAST_CLOTH] = {0.005, 0.0, 0.0},
                  [CAROM_CONDITION_OLD_CUSHION] = {0.0, 0.75, 0.4},
                  [CAROM_CONDITION_NEW_CUSHION] = {0.0, 0.85, 0.22},
                  [CAROM_CONDITION_HUMID_CUSHION] = {0.0, 0.8, 0.34},
                  [CAROM_CONDITION_LIVELY_CUSHION] = {0.0, 0.85, 0.28},
                  [CAROM_CONDITION_DEAD_CUSHION] = {0.0, 0.67, 0.28}};

int carom_condition_give(carom_condition condition, carom_ball_kind *kind) {
  if (kind == NULL || (uint32_t)condition >= sizeof conditions / sizeof *conditions)
    return 0;
  const struct condition_numbers *row = &conditions[condition];
  if (row->mu_roll > 0.0)
    kind->mu_roll = row->mu_roll;
  if (row->restitution > 0.0) {
    kind->restitution_cushion = row->restitution;
    kind->mu_cushion = row->mu_cushion;
  }
  return 1;
}
