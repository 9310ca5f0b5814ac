/* `carom rail`: the impact of a ball on a cushion, from speed, angle and spin; in words, as
 * rows, pictures and curves.
 *
 * The cushion lies along x, and the ball comes to it towards +y and, at an angle of incidence
 * above 0, +x: to the right. Right english then is running english, left english is reverse.
 */
#include "pictures/contact_picture.h"
#include "pictures/picture.h"
#include "pictures/series.h"
#include "program/program.h"
#include "rows/quantities.h"
#include "subcommands.h"

enum { SPIN, SPEED, ANGLE, SIDE, HEIGHT, RESTITUTION, FRICTION, CLOTH, RADIUS, MASS, MODEL };
static const char *const inputs[] = {[SPIN] = "spin",
                                     [SPEED] = "speed",
                                     [ANGLE] = "angle of incidence",
                                     [SIDE] = "side spin",
                                     /* without a default: those of the game for the model */
                                     [HEIGHT] = "height of the nose",
                                     [RESTITUTION] = "restitution",
                                     [FRICTION] = "friction of the cushion",
                                     [CLOTH] = "friction of the cloth",
                                     [RADIUS] = "radius of the ball",
                                     [MASS] = "mass of the ball",
                                     [MODEL] = "model",
                                     [MODEL + 1] = NULL};
_Static_assert(COUNT_OF(inputs) <= MOST_INPUTS + 1, "room for all");

enum { ROLLING_REBOUND, REBOUND, SPEED_AFTER, SIDE_AFTER, ENERGY };
#define QUANTITIES "rolling-rebound|rebound|speed|side|energy"
static const char *const quantity[] = {
    "angle of rebound once the ball rolls (degrees)", "angle of rebound at once (degrees)",
    "speed at once (m/s)", "side spin after (rad/s)", "kinetic energy that is lost (%)"};

INPUT(option_speed, "speed", SPEED, SPEED_WORDS "|V", MEASURE_SPEED,
      "speed of the ball, m/s or with a unit: mph, km/h; or " SPEEDS, .usual = "1.5");
INPUT(option_angle, "angle", ANGLE, "DEGREES", MEASURE_ANGLE,
      "angle of incidence, from the normal of the cushion, -90 to 90; above 0 the ball moves to "
      "the right",
      .usual = "45");
INPUT(option_spin, "spin", SPIN, "roll|stun|draw|SPIN", MEASURE_SPIN,
      "roll or follow: the ball rolls; stun: no spin; draw: the same spin backwards. Or "
      "a number with a unit: rad/s, % of rolling, tip",
      .usual = "roll");
INPUT(option_side, "side", SIDE, "right|left|running|reverse|gearing|none|SPIN", MEASURE_SIDE_RAIL,
      "side spin, above 0 for right english. Running english turns the ball as if it rolled along "
      "the "
      "cushion: right at an angle above 0; reverse is the other. A number with a unit: rad/s, % of "
      "english (100%: 1.25 V/R) or tip; right, left, running, reverse: 100%; "
      "gearing: the ball rolls along the cushion; none",
      .usual = "none");
OPTION(series, option_game, "game", game, NULL, set_named, CAROM_WORDS_GAME,
       "the game whose ball, cloth and cushion provide the parameters that you leave out",
       .usual = "pool");
INPUT(option_height, "height", HEIGHT, "H", MEASURE_LENGTH,
      "height of the nose above the cloth, m, or with a unit: mm, in", .else_usual = "the game's");
INPUT(option_restitution, "restitution", RESTITUTION, "E", MEASURE_NUMBER,
      "restitution of the cushion", .else_usual = "the game's, for the model");
INPUT(option_friction_rail, "friction", FRICTION, "MU", MEASURE_NUMBER, "friction of the cushion",
      .else_usual = "the game's, for the model");
INPUT(option_cloth, "mu-slide", CLOTH, "MU", MEASURE_NUMBER, "friction with the cloth",
      .else_usual = "the game's");
INPUT(option_radius, "radius", RADIUS, "R", MEASURE_LENGTH,
      "radius of the ball, m, or with a unit: mm, cm, in", .else_usual = "the game's");
INPUT(option_mass, "mass", MASS, "M", MEASURE_MASS, "mass of the ball, kg, or with a unit: g, oz",
      .else_usual = "the game's");

static OPTION_SET(set_models) {
  series *s = (series *)(void *)((char *)field - row->field);
  const values *list = field;
  const bool good = set_values(row, text, field);
  s->shared.models = 0;
  for (int k = 0; k < list->count && good; k++)
    s->shared.models |= 1U << (int)list->item[k].x;
  return good;
}

#define MODEL_OF_SHOTS "smooth"
static const option_row option_models = {
    .name = "model",
    .help = "model of the impact (`carom models NAME` describes it); shots use smooth",
    .else_usual = MODEL_OF_SHOTS,
    .set = set_models,
    .field = offsetof(series, in[MODEL]),
    .least = MEASURE_MODEL,
    .words = CAROM_WORDS_CUSHION_MODEL};
OPTION(series, option_quantity, "quantity", asked_for, QUANTITIES, set_quantities, 0,
       "the quantity of curves, or the quantities of tables, with commas",
       .else_usual = "rolling-rebound; all in tables");
FLAG(series, option_csv, "csv", csv,
     "write the impacts as rows for `carom resolve --cushion`. With --quantity: write a table of "
     "it");
OPTION(series, option_plot, "plot", picture, "OUT", set_picture, 0,
       "draw the ball and its path of every impact from above; or curves over a range, by gnuplot. "
       "OUT.svg, OUT.png or OUT.pdf");

/* The ball and the cushion of the game for a model, with the numbers of --with; false where the
 * game has none for the model. */
static bool ball_of_game(const series *s, int model, carom_ball_kind *kind) {
  static const carom_table_kind table[] = {
      [CAROM_GAME_POOL] = CAROM_TABLE_POOL_9FT,
      [CAROM_GAME_SNOOKER] = CAROM_TABLE_SNOOKER,
      [CAROM_GAME_BILLIARD] = CAROM_TABLE_THREECUSHION,
      [CAROM_GAME_POOLTOOL_POOL] = CAROM_TABLE_POOLTOOL,
      [CAROM_GAME_POOLTOOL_SNOOKER] = CAROM_TABLE_SNOOKER,
      [CAROM_GAME_POOLTOOL_BILLIARD] = CAROM_TABLE_THREECUSHION,
      [CAROM_GAME_BLACKBALL] = CAROM_TABLE_BLACKBALL,
      [CAROM_GAME_PYRAMID] = CAROM_TABLE_PYRAMID,
      [CAROM_GAME_FOURBALL] = CAROM_TABLE_FOURBALL,
  };
  carom_measures measures;
  const bool has_cushion_of_game =
      carom_ball_kind_for((carom_game)s->game, (carom_shot_cushion)(model + 1), kind) != 0;
  give_ball(&s->shared.with, kind);
  carom_table_measures(table[s->game], &measures);
  if (kind->nose_height == 0.0)
    kind->nose_height = measures.nose_height;
  return has_cushion_of_game;
}

/* The numbers of a ball that the options of its impacts have too. */
static void give_cushion(const carom_ball_kind *kind, carom_cushion_options *options) {
  const carom_number *n;
  for (int k = 0; (n = carom_number_of(CAROM_PART_BALL, k)) != NULL; k++)
    if (n->cushion_offset >= 0)
      memcpy((char *)options + n->cushion_offset, (const char *)kind + n->offset, sizeof(double));
}

static void make(const series *s, one_case *c) {
  const value *const *v = c->inputs;
  carom_ball_kind kind;
  c->shared.rail.model = (carom_cushion_model)v[MODEL]->x;
  ball_of_game(s, (int)c->shared.rail.model, &kind);
  give_cushion(&kind, &c->shared.rail);

  const double angle = v[ANGLE]->x * degree, speed = v[SPEED]->x;
  const double R = value_or(v[RADIUS], kind.radius), x = sin(angle), y = cos(angle),
               spin = spin_of(v[SPIN], speed, R, 0.0);
  const carom_cushion_impact in = {
      .v = {speed * x, speed * y, 0.0},
      .w = {-spin * y, spin * x, spin_of(v[SIDE], speed, R, speed * x / R)},
      .normal = {0.0, 1.0},
      .height = value_or(v[HEIGHT], kind.nose_height),
      .radius = R,
      .mass = value_or(v[MASS], kind.mass),
      .mu_slide = value_or(v[CLOTH], kind.mu_slide),
      .mu_cushion = value_or(v[FRICTION], kind.mu_cushion),
      .restitution = value_or(v[RESTITUTION], kind.restitution_cushion)};
  memcpy(c->row, &in, sizeof in);
}

/* Whether an impact at another speed is another but for its scale. */
static bool knows_speed(const carom_cushion_options *o) {
  const bool slides = !(o->smooth_q > 0.0) || o->smooth_g_log != 0.0;
  return o->law == CAROM_CUSHION_LAW_HAN || o->restitution_log != 0.0 ||
         o->restitution_log2 != 0.0 || o->mu_log != 0.0 || o->roll_loss_log != 0.0 ||
         (o->model == CAROM_CUSHION_SMOOTH && slides);
}

/* The first value of each input. */
static void case_of_first(const series *s, one_case *c) {
  *c = (one_case){.shared = s->shared};
  for (int k = 0; k < MOST_INPUTS; k++)
    c->inputs[k] = &s->in[k].item[0];
}

/* Whether all impacts can be made; else a complaint. */
static bool check(const series *s) {
  carom_ball_kind kind;
  const values *models = &s->in[MODEL];
  if (!condition_fits(&s->shared.with, (carom_game)s->game))
    return false;
  for (int k = 0; k < models->count; k++)
    if (!ball_of_game(s, (int)models->item[k].x, &kind) &&
        (isnan(s->in[FRICTION].item[0].x) || isnan(s->in[RESTITUTION].item[0].x))) {
      complain("%s has no constants for the cushion %s; give --friction and --restitution",
               carom_word(CAROM_WORDS_GAME, s->game), models->item[k].name);
      return false;
    }

  /* a list of speeds is a question that some laws do not answer */
  one_case c;
  for (int k = 0; k < models->count && s->in[SPEED].count > 1; k++) {
    case_of_first(s, &c);
    c.inputs[MODEL] = &models->item[k];
    make(s, &c);
    if (!knows_speed(&c.shared.rail))
      complain(
          "the law of %s does not depend on the speed: at another speed the angles are the same",
          models->item[k].name);
  }
  return true;
}

/* angle_in, angle_out, angle_rolling, rollx, rolly, energy_lost: see kind_cushion.c; angles to
 * the left. */
static void derive_case(const one_case *c, double d[MOST_DERIVED]) {
  cushion_kind.derive(c->row, c->result, d);
}

static double measure(const series *s, const one_case *c, int which_quantity) {
  const double *v = c->result;
  double d[MOST_DERIVED];
  derive_case(c, d);
  (void)s;
  switch (which_quantity) {
  case ROLLING_REBOUND:
    return -d[2];
  case REBOUND:
    return -d[1];
  case SPEED_AFTER:
    return plane_size(v);
  case SIDE_AFTER:
    return v[5];
  default:
    return 100.0 * d[5];
  }
}

/* "45.00 degrees from the normal to the right" */
static const char *rebound_text(double angle, const double v[2], char text[64]) {
  const bool aside = fabs(angle) >= 0.005;
  if (isnan(angle))
    snprintf(text, 64, "at rest");
  else
    snprintf(text, 64, "%.3f m/s, %.2f degrees from the normal%s%s", plane_size(v), fabs(angle),
             text_if(aside, " to the "), text_if(aside, left_or_right(angle)));
  return text;
}

static const char *longer_or_shorter(double difference) {
  return difference > 0.0 ? "longer" : "shorter";
}

/* What the cloth makes of the spin while the ball slips: the ball rolls with 5/7 of its velocity
 * and 2/7 of that at which its spin would roll. Topspin that the cushion left turns it longer. */
static void tell_cloth(FILE *out, const double v[2], const double d[MOST_DERIVED]) {
  const double along = d[3] - 5.0 / 7.0 * v[0], into = d[4] - 5.0 / 7.0 * v[1];
  const double longer = fabs(d[2]) - fabs(d[1]);
  if (isnan(longer) || fmax(fabs(along), fabs(into)) < 0.0005)
    return;
  fputs("              by spin:     until it rolls the path ", out);
  if (d[1] * d[2] < 0.0)
    fputs("bends across the normal", out);
  else if (fabs(longer) < 0.005)
    fputs("stays straight", out);
  else
    fprintf(out, "bends %.2f degrees %s", fabs(longer), longer_or_shorter(longer));
  fprintf(out, ": %.3f m/s %s the cushion", fabs(into), into > 0.0 ? "towards" : "away from");
  if (fabs(along) >= 0.0005)
    fprintf(out, ", %.3f m/s to the %s", fabs(along), left_or_right(-along));
  fputc('\n', out);
}

/* How much longer or shorter the rebound is than that of the same ball without side spin. */
static void tell_english(FILE *out, const one_case *c, const double d[MOST_DERIVED]) {
  enum { SIDE_SPIN = offsetof(carom_cushion_impact, w) / sizeof(double) + 2 };
  one_case none = *c;
  double plain[MOST_DERIVED];
  int8_t status;
  none.row[SIDE_SPIN] = 0.0;
  if (c->row[SIDE_SPIN] == 0.0)
    return;
  cushion_kind.solve(&c->shared, false, none.row, 1, none.result, &status);
  derive_case(&none, plain);
  double way = -1.0;
  if (c->inputs[ANGLE]->x < 0.0) /* angles are to the left */
    way = 1.0;
  const double once = way * (d[1] - plain[1]), rolling = way * (d[2] - plain[2]);
  if (status != CAROM_OK || isnan(once) || isnan(rolling))
    return;
  const bool topspin =
      rolling > 0.0 && d[4] - 5.0 / 7.0 * c->result[1] > plain[4] - 5.0 / 7.0 * none.result[1];
  fprintf(out,
          "              by english:  %.2f degrees %s than without it at once, %.2f %s once "
          "rolling%s\n",
          fabs(once), longer_or_shorter(once), fabs(rolling), longer_or_shorter(rolling),
          text_if(topspin, ", as it keeps more topspin"));
}

/* Whether the ball sticks to the nose, contact 0, or the cloth, contact 1. */
static bool sticks_at(const carom_cushion_point *point, int contact) {
  if (contact == 0)
    return point->nose_sticks;
  return point->cloth_sticks;
}

/* Where the ball sticks to nose and cloth, for models that follow the impact: the first point from
 * which it sticks to the end. */
static void tell_sticking(FILE *out, const one_case *c) {
  static const char *const what[2] = {"contacts      nose: ", "              cloth:"};
  enum { POINTS = 401 };
  carom_cushion_point point[POINTS];
  const carom_cushion_options options = cushion_options_of(&c->shared);
  if (carom_cushion_trace((const void *)c->row, &options, POINTS, point) != CAROM_OK)
    return;
  for (int contact = 0; contact < 2; contact++) {
    int k = POINTS;
    while (k > 0 && sticks_at(&point[k - 1], contact))
      k--;
    fprintf(out, "%s       ", what[contact]);
    if (k == POINTS)
      fputs("the ball slips on it throughout\n", out);
    else if (k == 0)
      fputs("the ball sticks to it throughout\n", out);
    else
      fprintf(out, "the ball slips on it, and sticks after %.0f %% of the impulse\n",
              100.0 * point[k].normal / point[POINTS - 1].normal);
  }
}

static void tell(FILE *out, const one_case *c) {
  const carom_cushion_impact *in = (const carom_cushion_impact *)(const void *)c->row;
  const double *v = c->result;
  double d[MOST_DERIVED];
  char text[64];
  derive_case(c, d);
  fprintf(
      out,
      "A ball at %.4g m/s meets a cushion: %.4g degrees from its normal, spin %s%s (%.4g rad/s), "
      "%s.\n",
      plane_size(in->v), c->inputs[ANGLE]->x, c->inputs[SPIN]->name,
      share_of_rolling(c->inputs[SPIN]), copysign(plane_size(in->w), c->inputs[SPIN]->x),
      english_text(in->w[2], text));
  fprintf(out, "Friction with the cushion %.4g, with the cloth %.4g, restitution %.4g; model %s.\n",
          in->mu_cushion, in->mu_slide, in->restitution, cushion_kind.name(&c->shared));
  if (!knows_speed(&c->shared.rail))
    fprintf(out, "At another speed the angles are the same, because the law does not depend on the "
                 "speed.\n");
  fprintf(out, "rebound       at once:     %s\n", rebound_text(d[1], v, text));
  fprintf(out, "              rolling:     %s\n", rebound_text(d[2], d + 3, text));
  tell_cloth(out, v, d);
  tell_english(out, c, d);
  tell_spin(out, v, v + 3);
  tell_sticking(out, c);
  fprintf(out, "energy        lost:        %.2f %%\n", 100.0 * d[5]);
}

static double draw(FILE *out, double top, const one_case *c, const char *words) {
  const carom_cushion_impact *in = (const carom_cushion_impact *)(const void *)c->row;
  const double R = in->radius, speed = plane_size(in->v), x = in->v[0] / speed,
               y = in->v[1] / speed;
  double d[MOST_DERIVED];
  char way[64], lines[2048];
  carom_ball ball = {.r = {0.0, 0.0, R}, .radius = R, .mass = in->mass, .mu_slide = in->mu_slide};
  carom_motion motion;
  memcpy(&motion, c->result, sizeof motion);
  derive_case(c, d);
  snprintf(lines, sizeof lines,
           "Dot: the ball rolls from here on. Angles are from the normal of the cushion.\n%s",
           words);
  contact_picture p = {.balls = 1,
                       .ball = {&ball},
                       .outgoing = {&motion},
                       .rail = true,
                       .way = {rebound_text(d[2], d + 3, way)},
                       .words = lines};
  p.line[p.lines++] = (contact_line){{-8.0 * R * x, -8.0 * R * y}, {0.0, 0.0}, NULL};
  p.line[p.lines++] = (contact_line){{0.0, 0.0}, {0.0, -8.0 * R}, "normal"};
  p.arc[p.arcs++] = (contact_arc){{0.0, 0.0}, -90.0, -90.0 - c->inputs[ANGLE]->x, "in"};
  if (isfinite(d[1]))
    p.arc[p.arcs++] = (contact_arc){{0.0, 0.0}, -90.0, -90.0 - d[1], "at once"};
  return contact_draw(out, top, &p);
}

static const char *law(const series *s, char text[80]) {
  const values *models = &s->in[MODEL];
  one_case first;
  case_of_first(s, &first);
  make(s, &first);

  const char *how = "";
  if (s->shared.rail.law == CAROM_CUSHION_LAW_HAN)
    how = " with Han's restitution and friction";
  else if (models->count == 1 && !knows_speed(&first.shared.rail))
    how = ", whose law does not depend on the speed";
  if (models->count == 1)
    snprintf(text, 80, "model %s%s", models->item[0].name, how);
  else
    snprintf(text, 80, "every model%s", how);
  return text;
}

static const command_form form = {
    .name = "rail",
    .usual =
        (const option_usual[]){
            {.name = "output", .else_usual = "- unless --plot draws curves"},
            {.name = "with",
             .help = "parameters of the model, such as smooth_q=0.2,smooth_x=1,smooth_t=1 (`carom "
                     "models NAME` lists them); a condition of a pool table's cushions, such as "
                     "old_cushion; or the file of a fit, FIT.json"},
            {0}},
    .usage = "[OPTIONS]",
    .about =
        "Computes and describes the impact of a ball on a cushion: the rebound angle just after "
        "and once the ball rolls, speeds, spin, and which contacts stuck or slipped. The ball "
        "moves to the right along the cushion, so right english is running english. A game "
        "provides the ball, the cloth and the cushion, as in shots.\n",
    .options = (const option_row *const[]){&option_speed,       &option_angle,
                                           &option_spin,        &option_side,
                                           &option_game,        &option_height,
                                           &option_restitution, &option_friction_rail,
                                           &option_cloth,       &option_radius,
                                           &option_mass,        &option_models,
                                           &option_with,        &option_convention,
                                           &option_law,         &option_steps,
                                           &option_quantity,    &option_csv,
                                           &option_plot,        &option_strict,
                                           &option_output,      NULL},
    .details =
        "Every number may be a list, separated by commas; one may be a range A:B or A:B:STEP. A "
        "unit after the last number holds for all: --speed 1,3,7mph, --side -100:100%. Each value "
        "of a list is an impact. A range gives a table, with --plot curves.\n\n"
        "quantities:\n"
        "  rolling-rebound      angle from the normal once the ball rolls, degrees; a mirror keeps "
        "the angle of incidence\n"
        "  rebound              the same just after the impact\n"
        "  speed                just after, m/s\n"
        "  side                 side spin after, rad/s; above 0 for right\n"
        "  energy               lost kinetic energy, %\n\n"
        "exit code: 0; 1 if some values are left out; 2 for bad usage or an impossible impact\n",
    .example = "carom rail --angle 0:75 --side -50,0,50% --plot rail.svg",
    .files = NO_FILES,
};

int command_rail(int argc, char **argv) {
  static const scene rail = {&cushion_kind, inputs, MODEL, QUANTITIES, quantity, make,
                             measure,       tell,   draw,  law,        check};
  static series s;
  s = (series){.shared = {.cushion = true,
                          .of_game = true,
                          .rail = {.model = CAROM_CUSHION_SMOOTH},
                          .options = COMMAND_OPTIONS},
               .scene = &rail};
  values_default(&s.in[MODEL], MEASURE_MODEL, MODEL_OF_SHOTS);
  return series_command(&s, &form, argc, argv, ANGLE,
                        "--angle: out of range; give less than 90 degrees, at which the ball moves "
                        "along the cushion");
}
