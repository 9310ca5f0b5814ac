/* `carom hit`: the collision of a cue ball with a ball at rest, from speed, cut angle and spin;
 * in words, as rows, pictures and curves.
 *
 * The cue ball comes along +x. A cut above 0 sends the object ball to the left as seen from
 * above.
 */
#include "pictures/contact_picture.h"
#include "pictures/picture.h"
#include "pictures/series.h"
#include "program/program.h"
#include "rows/quantities.h"
#include "shots/endless_cloth.h"
#include "subcommands.h"

enum { SPIN, SPEED, CUT, SIDE, RESTITUTION, CLOTH, ROLL, RADIUS, MASS, OBJECT_MASS, FRICTION };
static const char *const inputs[] = {[SPIN] = "spin",
                                     [SPEED] = "speed",
                                     [CUT] = "cut angle",
                                     [SIDE] = "side spin",
                                     [RESTITUTION] = "restitution",
                                     [CLOTH] = "friction of the cloth",
                                     [ROLL] = "rolling resistance",
                                     [RADIUS] = "radius of the balls",
                                     [MASS] = "mass of the balls",
                                     [OBJECT_MASS] = "mass of the object ball",
                                     [FRICTION] = "friction between the balls",
                                     [FRICTION + 1] = NULL};

/* How the names of quantities stand on axes. */
enum {
  THROW,
  DEFLECTION,
  ROLLING_DEFLECTION,
  ANGLE_BETWEEN,
  OBJECT_SPEED,
  SPIN_TRANSFER,
  ENERGY,
  CUE_DISTANCE,
  OBJECT_DISTANCE
};
#define QUANTITIES                                                                       \
  "throw|deflection|rolling-deflection|angle-between|object-speed|spin-transfer|energy|" \
  "cue-distance|object-distance"
static const char *const quantity[] = {"throw of the object ball (degrees)",
                                       "deflection of the cue ball at once (degrees)",
                                       "deflection of the cue ball once it rolls (degrees)",
                                       "angle between the balls once they roll (degrees)",
                                       "speed of the object ball at once (m/s)",
                                       "side spin of the object ball over that of the cue ball (%)",
                                       "kinetic energy that is lost (%)",
                                       "distance at which the cue ball rests (m)",
                                       "distance at which the object ball rests (m)"};

INPUT(option_speed, "speed", SPEED, SPEED_WORDS "|V", MEASURE_SPEED,
      "speed of the cue ball at contact, m/s or with a unit: mph, km/h; or " SPEEDS,
      .usual = "1.5");
INPUT(option_cut, "cut", CUT, "full|three-quarter|half|quarter|thin|DEGREES", MEASURE_CUT,
      "angle from the cue ball's direction to the line of centres, -90 to 90; above 0 the object "
      "ball goes to the left. Or the fullness of the hit: full, three-quarter, half or "
      "half-ball, quarter, thin (an eighth), 2/5ball, 0.4ball",
      .usual = "30");
INPUT(option_spin, "spin", SPIN, "stun|follow|draw|SPIN", MEASURE_SPIN,
      "stun: no spin; follow or roll: the ball rolls; draw: the same spin backwards. Or "
      "a number with a unit, above 0 for follow: rad/s, % of rolling, tip (height of the cue's "
      "tip above the centre; 1 tip is 13 mm)",
      .usual = "stun");
INPUT(
    option_side, "side", SIDE, "right|left|outside|inside|gearing|none|SPIN", MEASURE_SIDE,
    "side spin, above 0 for right english (counterclockwise seen from above). A number with a "
    "unit: rad/s, % of english (100%: the tip half a radius off centre, 1.25 V/R) or tip; "
    "right, left: 100%; outside: 100% on the side away from the way of the object ball, right of "
    "a cut to the left; inside: on the other; gearing: the balls roll on each other without slip; "
    "none",
    .usual = "none");
INPUT(option_radius, "radius", RADIUS, "R", MEASURE_LENGTH,
      "radius of the balls, m, or with a unit: mm, cm, in; a pool ball has 0.028575",
      .usual = "0.028575");
INPUT(option_mass, "mass", MASS, "M", MEASURE_MASS,
      "mass of the balls, kg, or with a unit: g, oz; 0.170097 is 6 oz", .usual = "0.170097");
INPUT(option_object_mass, "object-mass", OBJECT_MASS, "same|M", MEASURE_OBJECT_MASS,
      "mass of the object ball", .usual = "same");

/* alciatore=a,b,c is a law, and all else values. */
static OPTION_SET(set_frictions) {
  series *s = (series *)(void *)((char *)field - row->field);
  if (strncmp(text, "alciatore=", strlen("alciatore=")) != 0)
    return set_values(row, text, field);
  values_default(field, MEASURE_FRICTION, "alciatore");
  return option_friction.set(row, text, &s->shared.friction);
}

OPTION(series, option_frictions, "friction", in[FRICTION], "alciatore|MU", set_frictions,
       MEASURE_FRICTION,
       "friction between the balls: numbers; or alciatore, which falls with the slip "
       "speed u as mu = a + b exp(-c |u|); or alciatore=a,b,c, the same with other constants",
       .usual = "alciatore");
INPUT(option_cloth, "mu-slide", CLOTH, "MU", MEASURE_NUMBER, "friction with the cloth",
      .usual = "0.2");
INPUT(option_roll, "roll", ROLL, "MU", MEASURE_NUMBER,
      "rolling resistance of the cloth, for distances", .usual = "0.01");
INPUT(option_restitution, "restitution", RESTITUTION, "E", MEASURE_NUMBER,
      "restitution of the balls", .usual = "0.95");
OPTION(series, option_quantity, "quantity", asked_for, QUANTITIES, set_quantities, 0,
       "the quantity of curves, or the quantities of tables, with commas",
       .else_usual = "throw; all in tables");
FLAG(series, option_csv, "csv", csv,
     "write the collisions as rows for `carom resolve`. An id is the spin and the values of "
     "other lists, such as draw-1.5m/s. With --quantity: write a table of it");
OPTION(series, option_plot, "plot", picture, "OUT", set_picture, 0,
       "draw the balls and their paths of every collision from above; or curves over a range, by "
       "gnuplot. OUT.svg, OUT.png or OUT.pdf");

static void make(const series *s, one_case *c) {
  const value *const *v = c->inputs;
  const double angle = v[CUT]->x * degree, speed = v[SPEED]->x, R = v[RADIUS]->x,
               rolling = speed / R;
  carom_impact in = {.restitution = v[RESTITUTION]->x};
  /* gearing: the surfaces move alike along the tangent line */
  const double side = spin_of(v[SIDE], speed, R, rolling * sin(angle));
  in.a = (carom_ball){.r = {0.0, 0.0, R},
                      .v = {speed, 0.0, 0.0},
                      .w = {0.0, spin_of(v[SPIN], speed, R, 0.0), side},
                      .radius = R,
                      .mass = v[MASS]->x,
                      .mu_slide = v[CLOTH]->x};
  in.b = in.a;
  if (!isnan(v[OBJECT_MASS]->x))
    in.b.mass = v[OBJECT_MASS]->x;
  memset(in.b.v, 0, sizeof in.b.v);
  memset(in.b.w, 0, sizeof in.b.w);
  in.b.r[0] = 2.0 * R * cos(angle);
  in.b.r[1] = 2.0 * R * sin(angle);
  in.mu_ball = value_or(v[FRICTION], carom_mu_ball(&in, s->shared.friction.law));
  memcpy(c->row, &in, sizeof in);
}

/* 1 where angles to the left are positive, -1 where they are to the right: throw and deflection
 * are positive for what a cut does. Where every cut is 0, throw is positive to the left, which
 * is where right english throws. */
static double sign_of(const series *s) {
  double sum = 0.0;
  for (int k = 0; k < s->in[CUT].count; k++)
    sum += s->in[CUT].item[k].x;
  return sum > 0.0 ? -1.0 : 1.0;
}

/* How far from the contact a ball rests on an endless cloth, m: a shot without a strike. */
static double distance_of(const carom_ball *ball, const carom_motion *motion, double mu_roll) {
  const carom_table cloth = endless_cloth(ball->radius);
  const carom_cue none = {0};
  carom_shot_ball pool_ball = {.kind = carom_ball_kind_of(CAROM_GAME_POOL)};
  carom_ball_state rests;
  carom_shot shot = {.final = &rests};
  pool_ball.kind.radius = ball->radius;
  pool_ball.kind.mass = ball->mass;
  pool_ball.kind.mu_slide = ball->mu_slide;
  pool_ball.kind.mu_roll = mu_roll;
  pool_ball.state = (carom_ball_state){.r = {0.0, 0.0, ball->radius},
                                       .v = {motion->v[0], motion->v[1], 0.0},
                                       .w = {motion->w[0], motion->w[1], motion->w[2]},
                                       .label = CAROM_BALL_SLIDING};
  if (carom_shoot(&cloth, &pool_ball, 1, &none, NULL, &shot) != CAROM_OK)
    return (double)NAN;
  return plane_size(rests.r);
}

static double measure(const series *s, const one_case *c, int which_quantity) {
  const carom_impact *in = (const carom_impact *)(const void *)c->row;
  const carom_result *out = (const carom_result *)(const void *)c->result;
  const derived d = derive(in, out);
  switch (which_quantity) {
  case THROW:
    return sign_of(s) * d.throw_deg;
  case DEFLECTION:
    return sign_of(s) * d.deflection_deg;
  case ROLLING_DEFLECTION:
    return sign_of(s) * d.deflection_rolls;
  case ANGLE_BETWEEN:
    return plane_size(d.rolling_1) > 1e-9 * in->a.v[0] ? fabs(turn(in, d.rolling_1, d.rolling_2))
                                                       : (double)NAN;
  case OBJECT_SPEED:
    return plane_size(out->b.v);
  case SPIN_TRANSFER:
    return 100.0 * d.spin_transfer;
  case CUE_DISTANCE:
    return distance_of(&in->a, &out->a, c->inputs[ROLL]->x);
  case OBJECT_DISTANCE:
    return distance_of(&in->b, &out->b, c->inputs[ROLL]->x);
  default:
    return 100.0 * d.energy_lost;
  }
}

static void tell_distance(FILE *out, double distance) {
  if (isfinite(distance))
    fprintf(out, "              rests:       %.3f m from the contact, on an endless cloth\n",
            distance);
}

/* Says in words what came of a collision. */
static void tell(FILE *out, const one_case *c) {
  const carom_impact *in = (const carom_impact *)(const void *)c->row;
  const carom_result *result = (const carom_result *)(const void *)c->result;
  const derived d = derive(in, result);
  const double energy = energy_of(in->a.mass, in->a.radius, in->a.v, in->a.w), scale = in->a.v[0];
  char text[64];
  fprintf(out,
          "A cue ball at %.4g m/s meets a ball at rest: cut %.4g degrees, spin %s%s (%.4g rad/s), "
          "%s.\n",
          scale, c->inputs[CUT]->x, c->inputs[SPIN]->name, share_of_rolling(c->inputs[SPIN]),
          in->a.w[1], english_text(in->a.w[2], text));
  fprintf(out, "Friction between the balls %.4f, with the cloth %.4g, restitution %.4g.\n",
          in->mu_ball, in->a.mu_slide, in->restitution);
  /* The object ball, the cue ball, both together. */
  fprintf(out, "object ball   at once:     %s\n", velocity_text(result->b.v, scale, text));
  fprintf(out, "              rolling:     %s\n", velocity_text(d.rolling_2, scale, text));
  tell_distance(out, distance_of(&in->b, &result->b, c->inputs[ROLL]->x));
  if (fabs(d.throw_deg) < 0.005)
    fputs("              throw:       none: it leaves along the line of centres\n", out);
  else
    fprintf(out, "              throw:       %.2f degrees to the %s of the line of centres\n",
            fabs(d.throw_deg), left_or_right(d.throw_deg));
  tell_spin(out, result->b.v, result->b.w);
  fprintf(out, "cue ball      at once:     %s\n", velocity_text(result->a.v, scale, text));
  fprintf(out, "              rolling:     %s\n", velocity_text(d.rolling_1, scale, text));
  tell_distance(out, distance_of(&in->a, &result->a, c->inputs[ROLL]->x));
  tell_spin(out, result->a.v, result->a.w);
  if (isfinite(d.energy_lost))
    fprintf(out, "energy        lost:        %.2f %% of %.4g J\n", 100.0 * d.energy_lost, energy);
  else
    fputs("energy        lost:        unknown: the energies are beyond the range of numbers\n",
          out);
}

static double draw(FILE *out, double top, const one_case *c, const char *words) {
  const carom_impact *in = (const carom_impact *)(const void *)c->row;
  const carom_result *result = (const carom_result *)(const void *)c->result;
  const derived d = derive(in, result);
  const double R = in->a.radius, cut = c->inputs[CUT]->x, x = cos(cut * degree),
               y = sin(cut * degree);
  char ways[2][64], lines[2048];
  snprintf(lines, sizeof lines,
           "Dots: the ball rolls from here on. Angles are from the direction in which the cue ball "
           "came.\n%s",
           words);
  contact_picture p = {.balls = 2,
                       .ball = {&in->a, &in->b},
                       .outgoing = {&result->a, &result->b},
                       .way = {velocity_text(d.rolling_1, in->a.v[0], ways[0]),
                               velocity_text(d.rolling_2, in->a.v[0], ways[1])},
                       .words = lines};
  /* The way there and on, the line of centres, and the tangent line through the centre of the
   * cue ball. */
  p.line[p.lines++] = (contact_line){{-6.0 * R, 0.0}, {0.0, 0.0}, NULL};
  p.line[p.lines++] = (contact_line){{0.0, 0.0}, {5.0 * R, 0.0}, NULL};
  p.line[p.lines++] =
      (contact_line){{-2.5 * R * x, -2.5 * R * y}, {6.0 * R * x, 6.0 * R * y}, "line of centres"};
  p.line[p.lines++] =
      (contact_line){{-5.0 * R * y, 5.0 * R * x}, {5.0 * R * y, -5.0 * R * x}, "tangent line"};
  p.arc[p.arcs++] = (contact_arc){{0.0, 0.0}, 0.0, cut, "cut"};
  if (isfinite(d.deflection_deg))
    p.arc[p.arcs++] = (contact_arc){{0.0, 0.0}, 0.0, d.deflection_deg, "at once"};
  return contact_draw(out, top, &p);
}

static const char *law(const series *s, char text[80]) {
  const carom_speed_law *l = &s->shared.friction.law, usual = carom_alciatore();
  if (!isnan(s->in[FRICTION].item[0].x) || s->in[FRICTION].count > 1)
    text[0] = '\0';
  else if (l->a == usual.a && l->b == usual.b && l->c == usual.c)
    snprintf(text, 80, "friction between the balls by Alciatore's law");
  else
    snprintf(text, 80, "friction between the balls %.4g + %.4g exp(-%.4g |u|)", l->a, l->b, l->c);
  return text;
}

static const command_form form = {
    .name = "hit",
    .usual =
        (const option_usual[]){{.name = "output", .else_usual = "- unless --plot draws curves"},
                               {0}},
    .usage = "[OPTIONS]",
    .about = "Computes and describes the collision of the cue ball with a ball at rest: throw, "
             "deflection, spin, and the speeds just after the collision and once the balls roll. "
             "Angles are measured from the cue ball's path before, seen from above.\n",
    .options =
        (const option_row *const[]){
            &option_speed,       &option_cut,    &option_spin,   &option_side,   &option_frictions,
            &option_restitution, &option_cloth,  &option_roll,   &option_radius, &option_mass,
            &option_object_mass, &option_solver, &option_slip,   &option_steps,  &option_quantity,
            &option_csv,         &option_plot,   &option_strict, &option_output, NULL},
    .details =
        "Every number may be a list, separated by commas; one may be a range A:B or A:B:STEP. A "
        "unit after the last number holds for all: --speed 1,3,7mph, --side 0:100%. Each value of "
        "a list is a collision. A range gives a table, with --plot curves.\n\n"
        "quantities:\n"
        "  throw                angle of the object ball's velocity from the line of centres, "
        "degrees; above 0 in the direction in which a cut throws, or right english a full hit\n"
        "  deflection           angle between the cue ball's paths before and just after, degrees; "
        "above 0 away from the object ball\n"
        "  rolling-deflection   the same once it rolls\n"
        "  angle-between        angle between the directions of both balls once they roll, "
        "degrees\n"
        "  object-speed         speed of the object ball just after, m/s\n"
        "  spin-transfer        side spin of the object ball over the cue ball's before, %\n"
        "  energy               lost kinetic energy, %\n"
        "  cue-distance         how far from the contact the cue ball rests on an endless cloth, "
        "m\n"
        "  object-distance      the same of the object ball\n\n"
        "exit code: 0; 1 if some values are left out; 2 for bad usage or an impossible collision\n",
    .example = "carom hit --speed 1.5 --cut 30 --spin draw --plot hit.svg",
    .files = NO_FILES,
};

int command_hit(int argc, char **argv) {
  static const scene hit = {&ball_kind, inputs, -1,   QUANTITIES, quantity, make,
                            measure,    tell,   draw, law,        NULL};
  static series s;
  s = (series){.shared = {.options = COMMAND_OPTIONS, .friction = {.law = carom_alciatore()}},
               .scene = &hit};
  return series_command(
      &s, &form, argc, argv, CUT,
      "--cut: out of range; give less than 90 degrees, at which the balls do not meet");
}
