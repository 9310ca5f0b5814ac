/* The kind of row that is an impact of a ball on a cushion: 15 numbers, those of a
 * carom_cushion_impact, and 6 results. */
#include "derived.h"
#include "kind.h"
#include "memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
  NUMBERS = sizeof(carom_cushion_impact) / sizeof(double),
  RESULTS = sizeof(carom_motion) / sizeof(double)
};
enum { DERIVED = 6, POINT = 13, NORMAL = 6, HEIGHT = 8, RADIUS = 9 };

#define PLAIN(name) \
  { name, NULL, NO_NUMBER, false }
static const column columns[NUMBERS] = {PLAIN("vx"),
                                        PLAIN("vy"),
                                        PLAIN("vz"),
                                        PLAIN("wx"),
                                        PLAIN("wy"),
                                        PLAIN("wz"),
                                        {"nx", NULL, NORMAL + 1, true},
                                        {"ny", NULL, NORMAL, true},
                                        PLAIN("h"),
                                        PLAIN("R"),
                                        PLAIN("M"),
                                        PLAIN("mu_s"),
                                        PLAIN("mu_w"),
                                        PLAIN("e"),
                                        {"rho", NULL, NO_NUMBER, true}};
static const double defaults[NUMBERS] = {[NORMAL + 1] = 1.0};

static const char *name(const shared_options *asked, int variant) {
  (void)variant;
  return carom_cushion_model_name(asked->rail.model);
}

/* The options of the library: those of the cushion, with the steps and threads that every kind
 * has. */
static carom_cushion_options options_of(const shared_options *asked) {
  carom_cushion_options options = asked->rail;
  options.steps = asked->options.steps;
  options.threads = asked->options.threads;
  return options;
}

static carom_status check(const void *in, const shared_options *asked, int *field) {
  const carom_cushion_options options = options_of(asked);
  return carom_cushion_check(in, &options, field);
}

static void solve(const shared_options *asked, bool single, const void *in, size_t n, void *out,
                  int8_t *status) {
  const carom_cushion_options options = options_of(asked);
  (void)single;
  carom_cushion_batch(in, n, &options, out, status);
}

/* The angle of a velocity that leaves the cushion from its normal; a mirror keeps that of the
 * velocity that came. */
static double rebound(const carom_cushion_impact *in, const double v[2]) {
  return hypot(v[0], v[1]) > 0.0
             ? angle_between(v, (const double[]){-in->normal[0], -in->normal[1]})
             : (double)NAN;
}

static void derive_row(const void *in, const void *out, double *numbers) {
  const carom_cushion_impact *impact = in;
  const carom_motion *after = out;
  const double m = impact->mass, R = impact->radius;
  double rolling[3];
  carom_rolling_velocity(after->v, after->w, R, rolling);
  const double all[DERIVED] = {angle_between(impact->normal, impact->v),
                               rebound(impact, after->v),
                               rebound(impact, rolling),
                               rolling[0],
                               rolling[1],
                               1.0 - energy_of(m, R, after->v, after->w) /
                                         energy_of(m, R, impact->v, impact->w)};
  memcpy(numbers, all, sizeof all);
}

static void describe(FILE *out, const shared_options *asked, const void *in) {
  const carom_cushion_impact *impact = in;
  fprintf(out, "# impact: %s\n# model: %s\n# steps: %d\n", asked->id, name(asked, 0),
          asked->options.steps);
  fprintf(out,
          "# friction of the cushion: %.3g\n# friction of the cloth: %.3g\n# restitution: %.3g\n",
          impact->mu_cushion, impact->mu_cloth, impact->restitution);
}

static carom_status trace(const shared_options *asked, int variant, const void *in, int n,
                          trace_point *points) {
  const carom_cushion_impact *impact = in;
  const carom_cushion_options options = options_of(asked);
  carom_cushion_point *own = allocate((size_t)n, sizeof *own);
  (void)variant;
  const carom_status status = carom_cushion_trace(impact, &options, (size_t)n, own);
  for (int k = 0; k < n; k++) {
    const carom_cushion_point *p = &own[k];
    points[k] = (trace_point){.impulse = p->normal,
                              .work = p->work,
                              .restitution = p->phase == CAROM_PHASE_RESTITUTION,
                              .sticks = {p->nose_sticks != 0, p->cloth_sticks != 0},
                              .number = {p->v_n, p->s_x, p->s_t, p->c_x, p->c_y}};
    into_frame(impact->normal, p->state.v, points[k].number + 5);
    memcpy(points[k].number + 7, &p->state, sizeof p->state);
  }
  free(own);
  return status;
}

/* The first point from which the ball sticks to the end, for the nose and for the cloth. */
static void stuck(const shared_options *asked, const void *in, int n, const trace_point *points,
                  double at[2]) {
  (void)asked;
  (void)in;
  for (int contact = 0; contact < 2; contact++) {
    int k = n;
    while (k > 0 && points[k - 1].sticks[contact])
      k--;
    at[contact] = k < n ? points[k].impulse : (double)NAN;
  }
}

static carom_status look(const shared_options *asked, int variant, const void *in, void *out,
                         double lead[2], double *tail) {
  const carom_cushion_options options = options_of(asked);
  (void)variant;
  (void)lead;
  const carom_status status = carom_cushion(in, &options, out);
  *tail = rebound(in, out);
  return status;
}

const row_kind cushion_kind = {
    .noun = "impact",
    .which = "model",
    .clue = "r2x",
    .meant = "collisions of two balls are read without --cushion; ",
    .numbers = NUMBERS,
    .results = RESULTS,
    .columns = columns,
    .defaults = defaults,
    .radius = RADIUS,
    .height = HEIGHT,
    .motion = {0, NO_NUMBER},
    .result_columns = "vx,vy,vz,wx,wy,wz",
    .name = name,
    .check = check,
    .solve = solve,
    .derived_columns = "angle_in_deg,angle_out_deg,angle_rolling_deg,rollx,rolly,energy_lost",
    .derived = DERIVED,
    .derive = derive_row,
    .describe = describe,
    .trace_columns =
        "nose_sticks,cloth_sticks,v_n_m_s,s_x_m_s,s_t_m_s,c_x_m_s,c_y_m_s,v_x_m_s,v_y_m_s",
    .contacts = {"the nose sticks", "the cloth sticks"},
    .trace_numbers = POINT,
    .trace = trace,
    .stuck = stuck,
    .inputs = "angle speed vx vy wx wy wz nx ny R M h mu_s mu_w e rho",
    .turning = "angle",
    .lead_columns = "",
    .tail_columns = "rebound_deg",
    .title = "Rebound from the cushion",
    .axis = "angle after from the normal (degrees)",
    .direction = {NO_NUMBER, NORMAL},
    .look = look,
};
