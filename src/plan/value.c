/* Values of layouts: how likely is the best direct pot, and who wins from there.
 *
 * A ball at o gets into a pocket between the tangents from o to its two jaws, moved by 0.93 R: a
 * window of directions with the middle psi and the half width h. The cue ball has to come to the
 * ghost, g = o - (R + R') (cos psi, sin psi), over a distance d, and cuts by an angle c. An
 * error s of its direction becomes one of s d / ((R + R') cos c) of the ball's, to which the
 * uncertainty of throw adds 1.5 degrees sqrt(1.2 - cos c). With e the sum of both in squares the
 * chance is erf(h / (e sqrt 2)). It is 0 where a ball is in either way, where the ghost is in a
 * cushion, or the cut is above 80 degrees.
 *
 * From these chances the numbers of learned.h, which were fitted to racks that were played, make
 * three more: p that the player keeps his turn, by a pot of any kind, a_n that he pots a later ball
 * of this visit where n are left, and e_n that he keeps the turn that the other has left him. All
 * are 1 / (1 + exp(-w x)), with x as carom_plan_features() has it. They are nine-ball's where both
 * have the same balls, one-pocket's where each has pockets of his own, those of snooker or straight
 * pool in races for points, else eight-ball's.
 *
 * What follows a miss is a chain over the balls left, n to the one who plays and m to the other:
 * of a visit he keeps the first turn with the chance e_n and each later one with a_n, both of a
 * layout of the usual kind, and who misses gives the turn away:
 *
 *     W(n, m) = e_n U(n - 1, m) + (1 - e_n) (1 - V(m, n)),
 *     U(n, m) = a_n U(n - 1, m) + (1 - a_n) (1 - V(m, n)),
 *     U(0, m) = 1,
 *
 * and V of the other likewise. The visit is worth
 *
 *     (1 - p) (1 - V(m, n)) + p U'(n - 1, m),
 *
 * U' being U with the a_n of the mean of this layout. Of games that were played to the end, the
 * log-odds of these values were to be stretched by a number for each game.
 */
#include "plan/learned.h"
#include "plan/view.h"
#include "platform/elementary.h"
#include "platform/promise.h"

#include <math.h>
#include <string.h>

const carom_facts carom_no_facts = {.first = {-1, -1}};

uint32_t carom_in_play(const carom_ball_state *balls, int count) {
  uint32_t set = 0;
  for (int k = 0; k < count; k++)
    if (balls[k].label != CAROM_BALL_POCKETED && balls[k].label != CAROM_BALL_OFF)
      set |= UINT32_C(1) << k;
  return set;
}

/* ---- Once for a plan */

/* The two jaws nearest to the centre of a pocket, where both are near. */
carom_mouth carom_mouth_of(const carom_table *table, int index) {
  const carom_pocket *pocket = &table->pocket[index];
  carom_mouth mouth = {.centre = {pocket->centre[0], pocket->centre[1]},
                       .jaw = {{0.0, 0.0, pocket->radius}}};
  double least[2] = {INFINITY, INFINITY};
  int nearest[2] = {-1, -1};
  for (int k = 0; k < table->jaws; k++) {
    const double x = table->jaw[k].centre[0] - pocket->centre[0],
                 y = table->jaw[k].centre[1] - pocket->centre[1];
    const double square = x * x + y * y;
    const int at = square < least[0] ? 0 : square < least[1] ? 1 : 2;
    if (at == 0) {
      least[1] = least[0];
      nearest[1] = nearest[0];
    }
    if (at < 2) {
      least[at] = square;
      nearest[at] = k;
    }
  }

  /* jaws farther off than three radii are those of other pockets */
  mouth.jaws = least[1] < 9.0 * pocket->radius * pocket->radius;
  for (int side = 0; side < 2 && mouth.jaws; side++) {
    const carom_jaw *jaw = &table->jaw[nearest[side]];
    memcpy(mouth.jaw[side], jaw->centre, sizeof jaw->centre);
    mouth.jaw[side][2] = jaw->radius;
  }
  return mouth;
}

/* The chain: of each pair of numbers of balls the equations of W and V are solved together; on[]
 * is U of both. */
static void chain(carom_view *view, double a[2][MOST_LEFT + 1], double e[2][MOST_LEFT + 1]) {
  const bool shared = view->rules->race == CAROM_RACE_SHARED;
  double on[2][MOST_LEFT + 1][MOST_LEFT + 1];
  for (int k = 0; k <= MOST_LEFT; k++)
    on[0][0][k] = on[1][0][k] = 1.0;
  for (int total = 2; total <= 2 * MOST_LEFT; total++)
    for (int n = total > MOST_LEFT ? total - MOST_LEFT : 1; n < total && n <= MOST_LEFT; n++) {
      const int m = total - n;
      if (shared && n != m)
        continue;
      const double s = on[0][n - 1][shared ? n - 1 : m], t = on[1][m - 1][shared ? m - 1 : n];
      const double c = e[0][n], d = e[1][m], f = c * s + 1.0 - c, g = d * t + 1.0 - d;
      const double det = 1.0 - (1.0 - c) * (1.0 - d);
      const double w = (f - (1.0 - c) * g) / det, v = (g - (1.0 - d) * f) / det;
      view->win[0][n][m] = w;
      view->win[1][m][n] = v;
      on[0][n][m] = a[0][n] * s + (1.0 - a[0][n]) * (1.0 - v);
      on[1][m][n] = a[1][m] * t + (1.0 - a[1][m]) * (1.0 - w);
    }
}

static double chance(const double *w, const double *x, int n) {
  double sum = 0.0;
  for (int k = 0; k < n; k++)
    sum += w[k] * x[k];
  return 1.0 / (1.0 + carom_exp(-sum));
}

/* The numbers of the race of the game, and of its pockets or its rack. */
static const learned *numbers_of(const carom_view *view) {
  const carom_plan_rules *rules = view->rules;
  switch (rules->race) {
  case CAROM_RACE_SHARED:
    return &learned_of[OF_NINEBALL];
  case CAROM_RACE_POINTS:
    return &learned_of[rules->rack == CAROM_RACK_SNOOKER ? OF_SNOOKER : OF_STRAIGHT];
  case CAROM_RACE_OWN:
    return &learned_of[rules->pockets != NULL ? OF_ONEPOCKET : OF_EIGHTBALL];
  default:
    return &learned_of[OF_EIGHTBALL];
  }
}

double carom_chance_next(const carom_view *view, const double x[NEXT_NUMBERS]) {
  return chance(numbers_of(view)->next, x, NEXT_NUMBERS);
}

static const double least_chance = 1e-3; /* between two who never pot the chain has no end */

/* a_n, of a layout with this mean over the balls. */
double carom_chance_later(const carom_view *view, int who, double mean, int n) {
  const double x[LATER_NUMBERS] = {1.0, view->log_error[who], 1.0 / n, mean};
  const double a =
      view->given[who] > 0.0 ? view->given[who] : chance(numbers_of(view)->later, x, LATER_NUMBERS);
  return a > least_chance ? a : least_chance;
}

/* e_n */
double carom_chance_first(const carom_view *view, int who, int n) {
  const double x[FIRST_NUMBERS] = {1.0, view->log_error[who], 1.0 / n};
  const double e = chance(numbers_of(view)->first, x, FIRST_NUMBERS);
  return e > least_chance ? e : least_chance;
}

void carom_view_make(carom_view *view, const carom_plan_job *job,
                     const carom_plan_options *options) {
  const carom_player *other = options->opponent != NULL ? options->opponent : job->player;
  view->rules = job->rules;
  view->pockets = (int)job->table->pockets;
  view->count = (int)job->count;
  view->cue_ball = (int)job->cue->ball;
  view->width = job->table->width;
  view->length = job->table->length;
  for (int p = 0; p < view->pockets; p++)
    view->mouth[p] = carom_mouth_of(job->table, p);
  for (int k = 0; k < view->count; k++) {
    view->radius[k] = job->balls[k].kind.radius;
    for (int p = 0; p < view->pockets; p++)
      view->window[k][p] = carom_window_of(&view->mouth[p], job->balls[k].state.r, view->radius[k]);
    memcpy(view->at[k], job->balls[k].state.r, sizeof view->at[k]);
  }
  const carom_player *players[2] = {job->player, other};
  for (int who = 0; who < 2; who++) {
    view->sigma[who] = players[who]->phi * (pi / 180.0);
    view->log_error[who] = carom_log(players[who]->phi > 0.01 ? players[who]->phi / 0.1 : 0.1);
    view->given[who] = who == 0 ? options->chance_me : options->chance_opponent;
  }
  const double mean = numbers_of(view)->mean;
  double a[2][MOST_LEFT + 1] = {{0.0}}, e[2][MOST_LEFT + 1] = {{0.0}};
  for (int who = 0; who < 2; who++)
    for (int n = 1; n <= MOST_LEFT; n++) {
      a[who][n] = carom_chance_later(view, who, mean, n);
      e[who][n] = carom_chance_first(view, who, n);
    }
  chain(view, a, e);
}

/* ---- A pot */

/* Whether no ball but i and j is nearer to the segment from p to q than its own radius and R
 * together. */
static bool is_clear(const carom_view *view, const carom_ball_state *balls, uint32_t in_play,
                     const double p[2], const double q[2], int i, int j, double R) {
  double d[2] = {q[0] - p[0], q[1] - p[1]};
  const double length = sqrt(d[0] * d[0] + d[1] * d[1]);
  if (length < 1e-9)
    return true;
  d[0] /= length;
  d[1] /= length;
  in_play &= ~(UINT32_C(1) << i | UINT32_C(1) << j);
  for (int k = 0; in_play >> k != 0; k++) {
    if (!(in_play >> k & 1))
      continue;
    const double x = balls[k].r[0] - p[0], y = balls[k].r[1] - p[1], least = R + view->radius[k];
    double along = x * d[0] + y * d[1];
    along = along < 0.0 ? 0.0 : along > length ? length : along;
    const double off[2] = {x - along * d[0], y - along * d[1]};
    if (off[0] * off[0] + off[1] * off[1] < least * least)
      return false;
  }
  return true;
}

carom_window carom_window_of(const carom_mouth *mouth, const double o[2], double R) {
  const double x = mouth->centre[0] - o[0], y = mouth->centre[1] - o[1], mid = carom_angle_of(x, y);
  carom_window window = {.psi = mid, .half = 0.5}; /* of a ball between the jaws */
  if (!mouth->jaws) {
    const double sine = mouth->jaw[0][2] / sqrt(x * x + y * y);
    window.half = sine < 1.0 ? carom_asin(sine) : 0.5;
  } else {
    /* Where the jaws are from the middle, and how far their tangents are turned. */
    double turn[2], tangent[2];
    bool between = false;
    for (int side = 0; side < 2 && !between; side++) {
      const double jx = mouth->jaw[side][0] - o[0], jy = mouth->jaw[side][1] - o[1];
      const double sine = (mouth->jaw[side][2] + 0.93 * R) / sqrt(jx * jx + jy * jy);
      between = sine >= 1.0;
      turn[side] = carom_angle_of(jx, jy) - mid;
      turn[side] += turn[side] > pi ? -2.0 * pi : turn[side] < -pi ? 2.0 * pi : 0.0;
      tangent[side] = between ? 0.0 : carom_asin(sine);
    }

    /* Between the left one and the right one; from the side both may be on one side of the
     * pocket's centre. */
    if (!between) {
      const int left = turn[1] > turn[0];
      const double high = turn[left] - tangent[left], low = turn[1 - left] + tangent[1 - left];
      window.psi = mid + 0.5 * (low + high);
      window.half = 0.5 * (high - low);
    }
  }
  carom_sincos(window.psi, &window.sine, &window.cosine);
  return window;
}

carom_way carom_way_of(const carom_view *view, const carom_ball_state *balls, uint32_t in_play,
                       int k, int pocket, int who, bool in_hand, double least) {
  const carom_mouth *mouth = &view->mouth[pocket];
  const double *o = balls[k].r, *c = balls[view->cue_ball].r;
  const double R = view->radius[view->cue_ball], both = R + view->radius[k];
  const bool there = o[0] == view->at[k][0] && o[1] == view->at[k][1];
  const carom_window window =
      there ? view->window[k][pocket] : carom_window_of(mouth, o, view->radius[k]);
  carom_way way = {.psi = window.psi, .half = window.half};
  if (!(way.half > 0.0))
    return way;

  /* The ghost has to be on the table. */
  const double sine = window.sine, cosine = window.cosine;
  const double g[2] = {o[0] - both * cosine, o[1] - both * sine}, edge = 0.9 * R;
  if (g[0] < edge || g[1] < edge || g[0] > view->width - edge || g[1] > view->length - edge)
    return way;

  /* Distance and cut; in hand they are those of an easy shot. */
  const double dx = g[0] - c[0], dy = g[1] - c[1];
  double d = sqrt(dx * dx + dy * dy), cut = d < 0.01 ? 1.0 : (dx * cosine + dy * sine) / d;
  if (in_hand) {
    d = 0.3;
    cut = 0.97;
  }
  const double cosine_most = 0.17; /* of 80 degrees */
  if (cut < cosine_most)
    return way;

  /* Whether something is in the way takes longest, and is asked last. */
  const double aim = view->sigma[who] * d / (both * cut), by_throw = 1.5 * pi / 180.0;
  const double error = sqrt(aim * aim + by_throw * by_throw * (1.2 - cut));
  const double chance = carom_erf(way.half / (error * 1.4142135623730951));
  if (chance > least &&
      is_clear(view, balls, in_play, o, mouth->centre, view->cue_ball, k, view->radius[k]) &&
      (in_hand || is_clear(view, balls, in_play, c, g, view->cue_ball, k, R)))
    way.chance = chance;
  return way;
}

/* ---- A layout */

void carom_plan_features(const carom_view *view, const carom_ball_state *balls, uint32_t in_play,
                         uint32_t targets, uint32_t pockets, int who, bool in_hand,
                         double x[NEXT_NUMBERS]) {
  /* the best pot of each ball */
  double best = 0.0, second = 0.0, sum = 0.0;
  int count = 0;
  targets &= in_play;
  for (int k = 0; targets >> k != 0; k++) {
    if (!(targets >> k & 1))
      continue;
    /* the likeliest pocket of ball k; others are asked only whether they are likelier */
    double of = 0.0;
    for (int p = 0; p < view->pockets; p++) {
      if (!(pockets >> p & 1))
        continue;
      const carom_way way = carom_way_of(view, balls, in_play, k, p, who, in_hand, of);
      of = way.chance > of ? way.chance : of;
    }

    /* the two best of all balls */
    count++;
    sum += of;
    if (of > best) {
      second = best;
      best = of;
    } else if (of > second) {
      second = of;
    }
  }

  const double is[NEXT_NUMBERS] = {1.0,
                                   view->log_error[who],
                                   count > 0 ? sum / count : 0.0,
                                   best,
                                   second,
                                   count == 1 ? 1.0 : 0.0,
                                   in_hand ? 1.0 : 0.0};
  memcpy(x, is, sizeof is);
}

/* A value with its log-odds stretched. */
static double stretched(const carom_view *view, double value) {
  const double least = 1e-9, v = value < least ? least : value > 1.0 - least ? 1.0 - least : value;
  return 1.0 / (1.0 + carom_exp(-numbers_of(view)->stretch * carom_log(v / (1.0 - v))));
}

double carom_chain_value(const carom_view *view, const carom_ball_state *balls, uint32_t in_play,
                         uint32_t targets, uint32_t pockets, const int32_t given[2], int who,
                         bool in_hand) {
  const bool alone = view->rules->race == CAROM_RACE_ALONE;
  const bool shared = view->rules->race == CAROM_RACE_SHARED;
  const int32_t most = alone ? CAROM_BALLS_MOST : MOST_LEFT;
  int32_t left[2];
  for (int k = 0; k < 2; k++)
    left[k] = given[k] < 1 ? 1 : given[k] > most ? most : given[k];
  CAROM_PROMISE(who == 0 || who == 1);
  double x[NEXT_NUMBERS];
  carom_plan_features(view, balls, in_play, targets, pockets, who, in_hand, x);
  const double p = carom_chance_next(view, x);

  /* the visit, ball by ball: how likely it is to come so far, and what a miss there is worth */
  double worth = 0.0, so_far = 1.0, next = p;
  for (int n = left[0]; n > 0; n--) {
    if (alone)
      worth += so_far * next;
    else
      worth += so_far * (1.0 - next) * (1.0 - view->win[1 - who][shared ? n : left[1]][n]);
    so_far *= next;
    next = n > 1 ? carom_chance_later(view, who, x[2], n - 1) : 0.0;
  }
  CAROM_PROMISE(worth >= 0.0 && so_far >= 0.0 && so_far <= 1.0 && (alone || worth <= 1.0));
  return alone ? worth : stretched(view, worth + so_far);
}
