/* `carom-lab published`: values that others measured or stated, beside those that carom computes.
 *
 * data/measured.csv has a value a row, with its bounds and its source. The last column, `computed`,
 * names a function of the table below and up to six numbers for it: `rebound:1:1.5`; "-" where
 * nothing of carom can be compared, which the conditions explain. A row without bounds is printed
 * and not judged. */
#include "command.h"
#include "kernel.h"
#include "message.h"
#include "output.h"
#include "place.h"
#include "random.h"
#include "records.h"
#include "rounds.h"
#include "subcommands.h"

#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double degree = 3.14159265358979323846 / 180.0;

/* ---- Balls, cloth and equipment: x[0] is a carom_game or a carom_table_kind */

static double ball_restitution(const double *x) {
  return carom_ball_kind_of((carom_game)x[0]).restitution;
}

static double ball_friction(const double *x) {
  return carom_ball_kind_of((carom_game)x[0]).mu_ball;
}

static double ball_mass(const double *x) {
  return carom_ball_kind_of((carom_game)x[0]).mass;
}

static double ball_diameter(const double *x) {
  return 2000.0 * carom_ball_kind_of((carom_game)x[0]).radius;
}

static double rolling_friction(const double *x) {
  return carom_ball_kind_of((carom_game)x[0]).mu_roll;
}

static double sliding_friction(const double *x) {
  return carom_ball_kind_of((carom_game)x[0]).mu_slide;
}

/* m/s^2 at x[1] m/s */
static double rolling_deceleration(const double *x) {
  const carom_ball_kind kind = carom_ball_kind_of((carom_game)x[0]);
  return kind.mu_roll * kind.gravity + kind.drag * x[1] * x[1];
}

static double sliding_deceleration(const double *x) {
  const carom_ball_kind kind = carom_ball_kind_of((carom_game)x[0]);
  return kind.mu_slide * kind.gravity;
}

/* rad/s^2, of a ball that turns on the spot */
static double spin_deceleration(const double *x) {
  const carom_ball_kind kind = carom_ball_kind_of((carom_game)x[0]);
  return 5.0 * kind.mu_spin * kind.gravity / (2.0 * kind.radius);
}

static double nose_height(const double *x) {
  carom_table table;
  carom_table_make((carom_table_kind)x[0], &table);
  return 1000.0 * table.rail[0].height;
}

static double table_length(const double *x) {
  carom_table table;
  carom_table_make((carom_table_kind)x[0], &table);
  return table.length;
}

/* ---- The tip: x[0] is where it touches, in R; the cue is level */

static carom_motion struck(double a, double b) {
  carom_cue cue = carom_cue_of(CAROM_GAME_POOL);
  const carom_ball_kind kind = carom_ball_kind_of(CAROM_GAME_POOL);
  carom_motion out = {{0}, {0}};
  cue.a = a;
  cue.b = b;
  carom_strike(&cue, &kind, &out);
  return out;
}

static double tip_restitution(const double *x) {
  return carom_cue_of((carom_game)x[0]).tip_restitution;
}

/* of the ball over that of the cue */
static double tip_speed(const double *x) {
  return struck(0.0, x[0]).v[1] / carom_cue_of(CAROM_GAME_POOL).speed;
}

static double squirt(const double *x) {
  const carom_motion out = struck(x[0], 0.0);
  return fabs(atan2(out.v[0], out.v[1])) / degree;
}

/* R w_z / v */
static double english(const double *x) {
  const carom_motion out = struck(x[0], 0.0);
  return carom_ball_kind_of(CAROM_GAME_POOL).radius * fabs(out.w[2]) / hypot(out.v[0], out.v[1]);
}

/* R w / v of a ball that is hit above its centre: it rolls at 1 */
static double follow(const double *x) {
  const carom_motion out = struck(0.0, x[0]);
  return -carom_ball_kind_of(CAROM_GAME_POOL).radius * out.w[0] / out.v[1];
}

/* ---- Two balls of pool: cut x[0] degrees, speed x[1] m/s, roll x[2] of 1, friction x[3],
 * 0: Alciatore's, side spin R w_z / v x[4] */

static carom_result hit(const double *x) {
  const carom_ball_kind kind = carom_ball_kind_of(CAROM_GAME_POOL);
  carom_impact in = {.restitution = kind.restitution, .mu_ball = x[3]};
  carom_result out;
  in.a = (carom_ball){.v = {x[1] * sin(x[0] * degree), x[1] * cos(x[0] * degree), 0.0},
                      .radius = kind.radius,
                      .mass = kind.mass,
                      .mu_cloth = kind.mu_slide};
  in.b = in.a;
  in.b.v[0] = in.b.v[1] = 0.0;
  in.b.r[1] = 2.0 * kind.radius;
  in.a.w[0] = -x[2] * in.a.v[1] / kind.radius;
  in.a.w[1] = x[2] * in.a.v[0] / kind.radius;
  in.a.w[2] = x[4] * x[1] / kind.radius;
  if (x[3] == 0.0)
    in.mu_ball = carom_mu_ball(&in, carom_alciatore());
  carom_collide(&in, NULL, &out);
  return out;
}

/* degrees from the line of centres, along which the ball would go without friction */
static double throw_angle(const double *x) {
  const carom_result out = hit(x);
  return fabs(atan2(out.b.v[0], out.b.v[1])) / degree;
}

/* degrees from the path before to the path once the ball rolls */
static double deflection(const double *x) {
  const carom_result out = hit(x);
  double v[3];
  carom_rolling_velocity(out.a.v, out.a.w, carom_ball_kind_of(CAROM_GAME_POOL).radius, v);
  return atan2(v[0], v[1]) / degree - x[0];
}

static double deflection_over_cut(const double *x) {
  return deflection(x) / x[0];
}

/* of the way from the path before to the tangent line */
static double deflection_share(const double *x) {
  return deflection(x) / (90.0 - x[0]);
}

/* The middle of a number between `low` and `high` at which f(x, number) passes `wanted`. */
static double found(double (*f)(const double *x, double number), const double *x, double low,
                    double high, double wanted) {
  const bool rises = f(x, high) > f(x, low);
  for (int k = 0; k < 60; k++) {
    const double middle = 0.5 * (low + high);
    *((f(x, middle) > wanted) == rises ? &high : &low) = middle;
  }
  return 0.5 * (low + high);
}

static double deflection_by_roll(const double *x, double roll) {
  return deflection((const double[]){x[0], x[1], roll, x[3], x[4]});
}

/* between the path to the ball and the path back, with the draw that turns that of a half-ball hit
 * by 90 degrees */
static double draw_angle(const double *x) {
  const double half_ball[] = {30.0, x[1], 0.0, x[3], x[4]};
  return 180.0 - deflection_by_roll(x, found(deflection_by_roll, half_ball, -2.0, 0.0, 90.0));
}

static double thrown_by_side(const double *x, double side) {
  const carom_result out = hit((const double[]){x[0], x[1], x[2], x[3], side});
  return out.b.v[0] / out.b.v[1];
}

/* the offset of the tip at which nothing is thrown, over that of the point of contact */
static double gearing(const double *x) {
  return found(thrown_by_side, x, -1.25, 1.25, 0.0) / 2.5 / sin(x[0] * degree);
}

/* the cut, in degrees, at which the throw is greatest */
static double throw_most(const double *x) {
  double most = 0.0, at = 0.0;
  for (double cut = 1.0; cut < 89.5; cut += 0.5) {
    const double thrown = throw_angle((const double[]){cut, x[1], x[2], x[3], x[4]});
    at = thrown > most ? cut : at;
    most = thrown > most ? thrown : most;
  }
  return at;
}

static double speed_rolling(const carom_motion *m) {
  double v[3];
  carom_rolling_velocity(m->v, m->w, carom_ball_kind_of(CAROM_GAME_POOL).radius, v);
  return hypot(v[0], v[1]);
}

/* of the object ball over the cue ball, at once after the impact */
static double speed_ratio(const double *x) {
  const carom_result out = hit(x);
  return hypot(out.b.v[0], out.b.v[1]) / hypot(out.a.v[0], out.a.v[1]);
}

/* of the object ball over the speed before */
static double speed_share(const double *x) {
  const carom_result out = hit(x);
  return hypot(out.b.v[0], out.b.v[1]) / x[1];
}

/* of the distance that the object ball goes over that which the cue ball would have gone: both
 * slide at first, and grow with the square of the speed */
static double distance_share(const double *x) {
  return speed_share(x) * speed_share(x);
}

/* the same ratio of the distances that both balls roll, which grow with the square of the speed */
static double distance_ratio(const double *x) {
  const carom_result out = hit(x);
  const double ratio = speed_rolling(&out.b) / speed_rolling(&out.a);
  return ratio * ratio;
}

/* of Marlow's law at a slip of x[0] sin(45 degrees) */
static double friction_at(const double *x) {
  const carom_speed_law law = carom_alciatore();
  return law.a + law.b * exp(-law.c * x[0] * sin(45.0 * degree));
}

/* of the balls of the game x[0] at a slip of x[1] m/s */
static double friction_of(const double *x) {
  const carom_ball_kind kind = carom_ball_kind_of((carom_game)x[0]);
  return kind.law_a + kind.law_b * exp(-kind.law_c * x[1]);
}

/* of the first of two frozen balls: how far from the kiss line to the line of centres its path
 * lies, by tangents; a third ball drives it at x[0] degrees from the kiss line, at x[1] m/s */
static double kiss_share(const double *x) {
  const carom_ball_kind kind = carom_ball_kind_of(CAROM_GAME_POOL);
  const double R = kind.radius, along = sin(x[0] * degree), across = cos(x[0] * degree);
  const carom_shot_ball balls[3] = {
      {kind, {.r = {0.0, 0.0, R}}},
      {kind, {.r = {2.0 * R, 0.0, R}}},
      {kind,
       {.r = {-2.0 * R * along, -2.0 * R * across, R}, .v = {x[1] * along, x[1] * across, 0.0}}}};
  carom_motion out[3];
  carom_cluster(balls, 3, NULL, out, NULL, 0, NULL);
  return out[0].v[0] / out[0].v[1] / tan(x[0] * degree);
}

/* ---- Cushions: the ball of the game x[0] rolls into a rail at x[1] m/s across, full on */

static double rebound(const double *x) {
  static const carom_table_kind table_of[] = {CAROM_TABLE_POOL_9FT, CAROM_TABLE_SNOOKER,
                                              CAROM_TABLE_THREECUSHION};
  enum { EVENTS = 100 };
  carom_event events[EVENTS];
  carom_shot_ball ball = {.kind = carom_ball_kind_of((carom_game)x[0])};
  carom_table table;
  carom_table_make(table_of[(int)x[0]], &table);
  ball.state = (carom_ball_state){.r = {0.5, 0.7, ball.kind.radius},
                                  .v = {-x[1], 0.0, 0.0},
                                  .w = {0.0, -x[1] / ball.kind.radius, 0.0}};
  /* once to find where it meets the rail, and once from just before it */
  for (int run = 0; run < 2; run++) {
    carom_shot shot = {.events = events, .room = EVENTS};
    carom_shoot(&table, &ball, 1, NULL, NULL, &shot);
    int64_t k = 0;
    while (k < shot.count && k < EVENTS && events[k].type != CAROM_EVENT_RAIL)
      k++;
    if (k == shot.count || k == EVENTS)
      return NAN;
    if (run == 1)
      return -events[k].after[0].v[0] / events[k].before[0].v[0];
    ball.state.r[0] = events[k].before[0].r[0] + 1e-6;
  }
  return NAN;
}

/* Lengths of a 9 ft table that a ball goes at x[0] m/s from the head spot through the foot spot. */
static double lengths_of_travel(const double *x) {
  enum { EVENTS = 100 };
  carom_event events[EVENTS];
  carom_shot_ball ball = {.kind = carom_ball_kind_of(CAROM_GAME_POOL)};
  carom_shot shot = {.events = events, .room = EVENTS};
  carom_table table;
  carom_table_make(CAROM_TABLE_POOL_9FT, &table);
  ball.state = (carom_ball_state){.r = {0.5 * table.width, 0.25 * table.length, ball.kind.radius},
                                  .v = {0.0, x[0], 0.0}};
  carom_shoot(&table, &ball, 1, NULL, NULL, &shot);
  double from = ball.state.r[1], sum = 0.0;
  for (int64_t k = 0; k < shot.count && k < EVENTS; k++) {
    sum += fabs(events[k].before[0].r[1] - from);
    from = events[k].before[0].r[1];
  }
  return sum / table.length;
}

/* How far beyond its aim a ball meets a rail, in diamonds: it rolls from the diamond `from` of one
 * long rail to the diamond `at` of the other, with side spin R w_z / v to run on; diamonds count
 * from the end that it nears, and lie 94 mm behind the noses. The diamond of the rail `nth`, which
 * is that from which it came. */
static double diamond(carom_table_kind of, carom_game game, double from, double at, double speed,
                      double side, int nth) {
  enum { EVENTS = 100 };
  const double back = 0.094;
  carom_event events[EVENTS];
  carom_shot_ball ball = {.kind = carom_ball_kind_of(game)};
  carom_shot shot = {.events = events, .room = EVENTS};
  carom_table table;
  carom_table_make(of, &table);
  const double one = table.length / 8.0, across = table.width + 2.0 * back,
               along = (from - at) * one, R = ball.kind.radius;
  const double v_x = speed * across / hypot(across, along),
               v_y = speed * along / hypot(across, along), start = 0.3;
  ball.state = (carom_ball_state){
      .r = {start, table.length - from * one + (start + back) * along / across, R},
      .v = {v_x, v_y, 0.0},
      .w = {-v_y / R, v_x / R, -side * speed / R}};
  carom_shoot(&table, &ball, 1, NULL, NULL, &shot);
  int64_t k = 0;
  for (int rails = 0; k < shot.count && k < EVENTS; k++)
    if (events[k].type == CAROM_EVENT_RAIL && ++rails == nth)
      break;
  if (k == shot.count || k == EVENTS)
    return NAN;
  const carom_ball_state *s = &events[k].before[0];
  return s->r[0] < 0.5 * table.width
             ? (table.length - s->r[1] + (s->r[0] + back) * s->v[1] / s->v[0]) / one
             : NAN;
}

/* Diamonds between a ball and where it comes back by one rail: aimed x[1] / 2 diamonds beyond
 * x[0], at x[2] m/s. */
static double one_rail(const double *x) {
  return x[0] -
         diamond(CAROM_TABLE_POOL_9FT, CAROM_GAME_POOL, x[0], x[0] - 0.5 * x[1], x[2], 0.0, 2);
}

/* The corner-five system: from x[0], whose numbers are half as dense, at x[1], at x[2] m/s, with
 * side spin x[3]. */
static double three_rails(const double *x) {
  return diamond(CAROM_TABLE_THREECUSHION, CAROM_GAME_BILLIARD, 2.0 * (x[0] - 1.0), x[1], x[2],
                 x[3], 3);
}

/* How high a ball of pool bounces on the slate, over the height x[0] from which it falls. */
static double bounce(const double *x) {
  enum { EVENTS = 4 };
  carom_event events[EVENTS];
  carom_shot_ball ball = {.kind = carom_ball_kind_of(CAROM_GAME_POOL)};
  carom_shot shot = {.events = events, .room = EVENTS};
  carom_table table;
  carom_table_make(CAROM_TABLE_POOL_9FT, &table);
  ball.state = (carom_ball_state){.r = {0.5, 0.7, ball.kind.radius + x[0]}};
  carom_shoot(&table, &ball, 1, NULL, NULL, &shot);
  if (shot.count == 0 || events[0].type != CAROM_EVENT_SLATE)
    return NAN;
  const double ratio = events[0].after[0].v[2] / events[0].before[0].v[2];
  return ratio * ratio;
}

/* ---- Breaks: the rack x[0] on the table x[1] with a gap of x[2] mm, 1600 times.
 * The cue ball is x[3] m beside the long string, on the head string; the ball's speed is x[4], and
 * the tip touches it x[5] R above its centre. */

enum { BREAKS = 1600, BALLS_OF_A_RACK = 16, NUMBERS_MOST = 6 };

/* What was counted: `any` are breaks that made a ball, `squares` sums the squares of how many each
 * of them made, place[] how often the ball of a place of the rack fell: places are in rows from the
 * cue ball, and from the left. */
typedef struct break_counts {
  int breaks, success, scratch, eight, made, squares, any, front_in_side, place[BALLS_OF_A_RACK];
  double back[BREAKS]; /* velocity of the cue ball along the table just after it met the rack, over
                          that before */
  double rest[BREAKS]; /* m: where it stopped, from the middle of the table; NAN where it is gone */
} break_counts;

/* The standard error of the last value, where it was counted or drawn. */
static double error_of_value;

static double normal_draw(lab_random *draw) {
  double sum = -6.0;
  for (int k = 0; k < 12; k++)
    sum += lab_uniform(draw, 0.0, 1.0);
  return sum;
}

/* The place of a ball in its rack, from 0: the ball in front. */
static int place_of(const carom_shot_ball *balls, int count, int ball) {
  const double *r = balls[ball].state.r, R = balls[ball].kind.radius;
  int place = 0;
  for (int b = 1; b < count; b++) {
    const double *other = balls[b].state.r;
    const bool same_row = fabs(other[1] - r[1]) < R;
    place += same_row ? other[0] < r[0] : other[1] < r[1];
  }
  return place;
}

/* The velocity of the cue ball along the table once it has met the rack, over that before: contacts
 * within a millisecond are one. */
static double thrown_back(const carom_shot *shot, int64_t kept) {
  double before = NAN, after = NAN, when = INFINITY;
  for (int64_t k = 0; k < kept && shot->events[k].time <= when + 1e-3; k++) {
    const carom_event *e = &shot->events[k];
    const int own = e->a == 0 ? 0 : e->b == 0 ? 1 : -1;
    if (e->type != CAROM_EVENT_BALL_BALL || own < 0)
      continue;
    if (isinf(when)) {
      when = e->time;
      before = e->before[own].v[1];
    }
    after = e->after[own].v[1];
  }
  return after / before;
}

static void count_break(const carom_shot *shot, const carom_table *table,
                        const carom_shot_ball *balls, int count, int number, break_counts *counts) {
  const carom_facts *facts = shot->facts;
  int made = 0;
  for (int b = 1; b < count; b++) {
    const int place = place_of(balls, count, b);
    if ((facts->down >> b & 1) == 0)
      continue;
    made++;
    counts->place[place]++;
    const double y = table->pocket[facts->pocket[b]].centre[1];
    counts->front_in_side += place == 0 && fabs(y - 0.5 * table->length) < 0.25 * table->length;
  }
  const bool scratch = (facts->down | facts->off) & 1;
  counts->success += made > 0 && !scratch;
  counts->scratch += scratch;
  counts->eight += (facts->down >> 8 & 1) != 0;
  counts->made += made;
  counts->squares += made * made;
  counts->any += made > 0;

  const double *end = shot->final[0].r;
  counts->rest[number] =
      scratch ? NAN : hypot(end[0] - 0.5 * table->width, end[1] - 0.5 * table->length);
}

static break_counts break_as(const double *x) {
  const carom_rack_kind rack = (carom_rack_kind)x[0];
  const int count = carom_rack_size(rack);
  carom_table table;
  carom_table_make((carom_table_kind)x[1], &table);
  lab_random draw = {1};
  break_counts counts = {.breaks = BREAKS};
  for (int k = 0; k < BREAKS; k++) {
    carom_shot_ball balls[BALLS_OF_A_RACK];
    carom_rack(rack, &table, 1e-3 * x[2], (uint64_t)k, balls, BALLS_OF_A_RACK);
    balls[0].state.r[0] = 0.5 * table.width + x[3];
    balls[0].state.r[1] = 0.25 * table.length;

    /* at the ball in front; errors of a good player: 0.2 degrees, 3 % of the speed, 0.03 R */
    int front = 1;
    while (place_of(balls, count, front) > 0)
      front++;
    carom_cue cue = carom_cue_of(CAROM_GAME_POOL);
    cue.b = x[5] + 0.03 * normal_draw(&draw);
    cue.a = 0.03 * normal_draw(&draw);
    cue.phi = atan2(balls[front].state.r[1] - balls[0].state.r[1],
                    balls[front].state.r[0] - balls[0].state.r[0]) /
                  degree +
              0.2 * normal_draw(&draw);
    cue.speed = x[4] / tip_speed((const double[]){x[5]}) * (1.0 + 0.03 * normal_draw(&draw));

    enum { FEW = 64 };
    carom_event events[FEW];
    carom_ball_state final[BALLS_OF_A_RACK];
    carom_facts facts;
    carom_shot shot = {.facts = &facts, .final = final, .events = events, .room = FEW};
    carom_shoot(&table, balls, count, &cue, NULL, &shot);
    const int64_t kept = shot.count < FEW ? shot.count : FEW;
    count_break(&shot, &table, balls, count, k, &counts);
    counts.back[k] = thrown_back(&shot, kept);
  }
  return counts;
}

/* The breaks of the last row are kept, as rows that follow may count something else of them. */
static break_counts breaks(const double *x) {
  static double kept_x[NUMBERS_MOST];
  static break_counts kept; /* none yet: breaks is 0 */
  if (kept.breaks == 0 || memcmp(x, kept_x, sizeof kept_x) != 0) {
    memcpy(kept_x, x, sizeof kept_x);
    kept = break_as(x);
  }
  return kept;
}

/* %, with the error of its binomial distribution */
static double share_of_breaks(int counted) {
  const double share = (double)counted / BREAKS;
  error_of_value = 100.0 * sqrt(share * (1.0 - share) / BREAKS);
  return 100.0 * share;
}

static double break_success(const double *x) {
  return share_of_breaks(breaks(x).success);
}

static double break_any(const double *x) {
  return share_of_breaks(breaks(x).any);
}

static double break_scratch(const double *x) {
  return share_of_breaks(breaks(x).scratch);
}

static double break_eight(const double *x) {
  return share_of_breaks(breaks(x).eight);
}

static double break_front_in_side(const double *x) {
  return share_of_breaks(breaks(x).front_in_side);
}

/* balls of a break that made one */
static double break_made(const double *x) {
  const break_counts counts = breaks(x);
  const double mean = (double)counts.made / counts.any;
  error_of_value = sqrt(((double)counts.squares / counts.any - mean * mean) / counts.any);
  return mean;
}

/* How often the likelier wing ball of nine-ball falls over how often the likeliest other ball does;
 * the error is that of both shares. */
static double break_wings(const double *x) {
  const break_counts counts = breaks(x);
  int wing = 0, other = 1;
  for (int place = 0; place < BALLS_OF_A_RACK; place++) {
    int *most = place == 3 || place == 5 ? &wing : &other;
    *most = counts.place[place] > *most ? counts.place[place] : *most;
  }
  const double ratio = (double)wing / other;
  error_of_value = ratio * sqrt(1.0 / (wing + 1) + 1.0 / other);
  return ratio;
}

/* The median of n samples that are no NAN; its error as of a normal distribution. */
static double median_of(double *sample, int count) {
  size_t n = 0;
  for (int k = 0; k < count; k++)
    if (!isnan(sample[k]))
      sample[n++] = sample[k];
  const sample_summary s = summarise(sample, n);
  error_of_value = 1.86 * s.spread / sqrt((double)n);
  return s.median;
}

static double break_back(const double *x) {
  break_counts counts = breaks(x);
  return median_of(counts.back, BREAKS);
}

static double break_rest(const double *x) {
  break_counts counts = breaks(x);
  return median_of(counts.rest, BREAKS);
}

/* ---- The table of rows */

static const struct {
  const char *name;
  double (*value)(const double *x);
} functions[] = {
    {"ball_restitution", ball_restitution},
    {"ball_friction", ball_friction},
    {"ball_mass", ball_mass},
    {"ball_diameter", ball_diameter},
    {"rolling_friction", rolling_friction},
    {"sliding_friction", sliding_friction},
    {"rolling_deceleration", rolling_deceleration},
    {"sliding_deceleration", sliding_deceleration},
    {"spin_deceleration", spin_deceleration},
    {"nose_height", nose_height},
    {"table_length", table_length},
    {"tip_restitution", tip_restitution},
    {"tip_speed", tip_speed},
    {"squirt", squirt},
    {"english", english},
    {"follow", follow},
    {"throw", throw_angle},
    {"deflection", deflection},
    {"deflection_over_cut", deflection_over_cut},
    {"deflection_share", deflection_share},
    {"draw_angle", draw_angle},
    {"gearing", gearing},
    {"throw_most", throw_most},
    {"distance_share", distance_share},
    {"speed_ratio", speed_ratio},
    {"speed_share", speed_share},
    {"distance_ratio", distance_ratio},
    {"friction_at", friction_at},
    {"friction_of", friction_of},
    {"kiss_share", kiss_share},
    {"rebound", rebound},
    {"lengths_of_travel", lengths_of_travel},
    {"one_rail", one_rail},
    {"three_rails", three_rails},
    {"bounce", bounce},
    {"break_success", break_success},
    {"break_any", break_any},
    {"break_scratch", break_scratch},
    {"break_eight", break_eight},
    {"break_front_in_side", break_front_in_side},
    {"break_made", break_made},
    {"break_wings", break_wings},
    {"break_back", break_back},
    {"break_rest", break_rest},
};

/* "rebound:1:1.5": the function and its numbers. False where there is no such function, or it has
 * no value. */
static bool compute(const char *computed, double *value) {
  const size_t length = strcspn(computed, ":");
  double x[NUMBERS_MOST] = {0};
  const char *rest = computed + length;
  for (int k = 0; *rest == ':' && k < NUMBERS_MOST; k++) {
    char *end;
    x[k] = strtod(rest + 1, &end);
    rest = end;
  }
  for (size_t k = 0; k < sizeof functions / sizeof functions[0]; k++)
    if (*rest == '\0' && strlen(functions[k].name) == length &&
        strncmp(functions[k].name, computed, length) == 0) {
      error_of_value = 0.0;
      *value = functions[k].value(x);
      return !isnan(*value);
    }
  return false;
}

/* ---- The command */

enum { QUANTITY, VALUE, LOW, HIGH, UNIT, CONDITIONS, SOURCE, HOW, COMPUTED, COLUMNS };

/* A bound that is not given is infinite. */
static bool bound(const record *row, int column, double without, double *number) {
  *number = without;
  return row->field[column][0] == '\0' || record_number(row, row->field[column], number);
}

static bool print_row(FILE *out, bool csv, const record *row) {
  double value = NAN, low, high;
  const char *computed = row->count == COLUMNS ? row->field[COMPUTED] : "";
  const bool countable = strcmp(computed, "-") != 0;
  if (row->count != COLUMNS || !bound(row, LOW, -INFINITY, &low) ||
      !bound(row, HIGH, INFINITY, &high))
    return false;
  if (computed[0] == '\0')
    return true;
  if (countable && !compute(computed, &value))
    return false;

  /* what cannot be compared has no value and no verdict; what was drawn has an error */
  char carom[16] = "-", error[16] = "";
  if (countable)
    snprintf(carom, sizeof carom, "%.4g", value);
  if (countable && error_of_value > 0.0)
    snprintf(error, sizeof error, "%.2g", error_of_value);
  const char *verdict = isnan(value) || (isinf(low) && isinf(high)) ? "-"
                        : value < low                               ? "low"
                        : value > high                              ? "high"
                                                                    : "ok";
  if (csv)
    fprintf(out, "%s,%s,%s,%s,%s,%s,%s,%s,%s,%s\n", row->field[QUANTITY], row->field[VALUE],
            row->field[LOW], row->field[HIGH], row->field[UNIT], carom, error, verdict,
            row->field[CONDITIONS], row->field[SOURCE]);
  else
    fprintf(out, "%-42.42s %9s %7s %7s %9s %-7s %-6s %-4s  %s\n", row->field[QUANTITY],
            row->field[VALUE], row->field[LOW], row->field[HIGH], carom, error, row->field[UNIT],
            verdict, row->field[CONDITIONS]);
  return true;
}

typedef struct published_job {
  shared_options shared;
  bool csv;
} published_job;

OPTION(published_job, published_csv, "csv", csv, 0, NULL, set_flag, 0,
       "as CSV: quantity,published,low,high,unit,carom,error,verdict,conditions,source");

static const command_form form = {
    .name = "published",
    .usage = "[OPTIONS]",
    .about = "Values that others measured or stated (data/measured.csv) beside those that carom "
             "computes. The verdict is low or high where carom's value lies outside the bounds of "
             "the source. Breaks are 1600 each; the standard error of what was counted stands "
             "beside it. "
             "docs/understanding/published.md reads the table.\n",
    .options = (const option_row *const[]){&option_data, &published_csv, &option_output, NULL},
    .details = "exit code: 0, or 2 for bad usage or unreadable data\n",
    .example = "carom-lab published --csv -o published.csv",
};

int command_published(int argc, char **argv) {
  published_job job = {.shared = {.options = COMMAND_OPTIONS, .output = "-"}};
  const int code = parse_arguments(&form, argc, argv, &job, NULL);
  if (code >= 0)
    return code;
  char path[PATH_MAX];
  snprintf(path, sizeof path, "%s/measured.csv", data_folder(job.shared.folder));
  record_reader *reader = record_open(path);
  FILE *out = reader != NULL ? output_open(job.shared.output) : NULL;
  if (out == NULL)
    return EXIT_USAGE;
  fputs(job.csv ? "quantity,published,low,high,unit,carom,error,verdict,conditions,source\n"
                : "quantity                                   published     low    high     carom "
                  "error   unit   verdict\n",
        out);
  record row;
  bool good = record_next(reader, &row) == READ_ONE; /* the header */
  while (good && record_next(reader, &row) == READ_ONE)
    if (!(good = print_row(out, job.csv, &row)))
      complain("%s:%lld: not a row of %d columns with bounds and a function", path, row.line,
               COLUMNS);
  record_close(reader);
  return good && output_commit() ? EXIT_GOOD : EXIT_USAGE;
}
