/* Which collocation step comes next.
 *
 * At the rate of its start a collision loses the share q of |u| on the whole way to its end. If q is not large and the
 * direction of the cloth slip smooth, one step in the impulse ends it: with four nodes (EASY), six (FULL) or, where much of |u|
 * is lost, eight graded ones (FULL_GRADED). If it will stick, and what is left of |u| is so small that the error of a step to
 * there does not count, that ends it (STICK); else a step takes away most of |u| first (PART). Where the cloth slip turns,
 * steps with their nodes drawn together there lose less of |u| at a time (TURN).
 *
 * HOW SMOOTH. Along the straight way that d is about to take, t is analytic in the ellipse with foci at the ends of the step
 * that passes through the zeros of |d|^2; with rho the sum of its half axes over the half length of the step, n Gauss nodes
 * leave out about rho^-2n. For a TURN step, whose map takes the zeros to xi = +- i pi / 2, the same holds with the range of xi.
 *
 * A step is accepted if its error estimate is below the tolerance. If it is not, a TURN step is tried, and then TURN steps of
 * half the length. After MOST_ATTEMPTS steps, or if they get too short, collocation refuses the collision, which then is for
 * the fallback (fallback.c).
 *
 * The limits below were found with `carom-lab stress`, which finds them again: it prints the largest errors of what was
 * accepted.
 */
#include "ball_ball/impulse_step.h"
#include "ball_ball/kernels.h"
#include "ball_ball/stick_step.h"

enum { EASY_NODES = 4, FULL_NODES = 6 }; /* of STICK: stick_step.h; of all others: MOST_NODES */
/* Iterations at most. */
enum { EASY_MOST = 3, FULL_MOST = 4, GRADED_MOST = 5, TURN_MOST = 6 };
enum { MOST_ATTEMPTS = 14 };

static const float EASY_SHARE = 6;            /* error of an EASY step over mu_b rho^-8 with rho for u, */
static const float MOST_EASY_Q = 0.62f;       /* its q */
static const float MOST_EASY_MU_MU_B = 5e-3f; /* and its mu mu_b q^2 */
static const float FULL_Q = 0.66f;            /* q of a FULL step over even nodes, */
static const float FULL_GRADED_Q = 0.96f;     /* and over graded ones */
static const float BEND_4 = 20,
                   BEND_8 = 30;     /* by q^2: what a way that is not straight adds to the error, with 4 nodes and with more */
static const float STICK_Q = 1.05f; /* q from which the balls will stick */
static const float TURN_Q = 0.5f;   /* q of a TURN step */
static const float LEFT_Q = 0.5f;   /* q that a PART would leave; */
static const float LEAST_PART = 0.3f, MOST_PART = 0.85f, MOST_OF_WAY = 0.8f; /* its share of |u|, and of q */
static const float LEAST_WIDTH = 1e-5f, LEAST_WIDTH_SENSITIVE = 1e-3f; /* distance delta of a turn; of sensitive collisions */
static const float WIDEST_RANGE = 4.5f;                                /* of xi of a TURN step */
static const float TURN_SHARE = 350;                                   /* its error over (mu mu_b sigma)^2 L rho^-16 */
static const float LEAST_SHARE = 0.1f;                                 /* of its usual length */

/* After refusals of steps from a state. */
typedef struct retries {
  vreal share;   /* of the usual length that a TURN step may have */
  vmask careful; /* a step was refused: only TURN steps now */
} retries;

#define separate static __attribute__((noinline)) /* the inlined text of a step is long */

always vreal choose_kind(vmask m, enum step_kind kind, vreal otherwise) {
  return v_select(m, v_splat((float)kind), otherwise);
}

always vreal power_4(vreal x) {
  return (x * x) * (x * x);
}

/* 1 / rho, at most: with d_1 for d at the end of the way, rho + 1 / rho = 2 (|d| + |d_1|) / |d_1 - d|; less what the cloth
 * takes from |d| on the way, whatever the direction. */
always vreal inverse_rho(const problem *a, const state *s, const prediction *g, vreal length) {
  const float own = a->spin < 1 ? 1 - a->spin : 0;
  const vreal g_x = length * (a->mu_b * g->c), g_y = length * v_fma(-a->spin * a->mu_b, g->z, v_splat(1)), tiny = v_splat(TINY);
  const vreal d_x = s->d_x - g_x, d_y = s->d_y - g_y;
  const vreal d_0 = root(v_fma(s->d_x, s->d_x, v_fma(s->d_y, s->d_y, tiny))),
              d_1 = root(v_fma(d_x, d_x, v_fma(d_y, d_y, tiny)));
  const vreal taken = own * a->mu_mu_b * g->z * length;
  const vreal sum = v_max((d_0 + d_1 - taken) * inverse_length(g_x, g_y), v_splat(1));
  return v_select(has_no_slip(a, s), v_splat(0), v_reciprocal(2 * sum - v_reciprocal(sum)));
}

/* The same on the way ahead, to the end or to stick. */
always vreal inverse_rho_ahead(const problem *a, const state *s, const prediction *g, vreal to_end) {
  return inverse_rho(a, s, g, v_min(to_end, v_reciprocal(g->rate)));
}

/* Is the direction of the cloth slip smooth enough for n nodes? The more of |u| is lost, the less straight the way. */
always vmask is_smooth(int n, const problem *a, const prediction *g, vreal length, vreal inverse) {
  const vreal inverse_4 = power_4(inverse), inverse_8 = inverse_4 * inverse_4, q = g->rate * length;
  const vreal left_out =
      a->mu_mu_b * g->z * length * (n == 4 ? 4 * inverse_8 : (n == 6 ? 6.0f : 2.0f) * (inverse_8 * inverse_8));
  return v_less(left_out * v_fma((n == 4 ? BEND_4 : BEND_8) * q, q, v_splat(1)), a->tolerance);
}

/* Will an EASY step do? *g: to the end. |u| would reach zero at X = 1 / q, so that (1 + s) / (1 - s) is its rho, with
 * s^2 = 1 - q. */
always vmask is_easy(const problem *a, const prediction *g, vreal to_end, vreal inverse) {
  const vreal q = g->rate * to_end, root_left = v_sqrt(v_max(1 - q, v_splat(0)));
  const vreal inverse_4 = power_4((1 - root_left) * v_rough_reciprocal(1 + root_left));
  return v_less(EASY_SHARE * a->mu_b * (inverse_4 * inverse_4), a->tolerance) & v_less(q, v_splat(MOST_EASY_Q)) &
         v_less(a->mu_mu_b * q * q, v_splat(MOST_EASY_MU_MU_B)) & is_smooth(4, a, g, to_end, inverse);
}

/* The error of a step to stick, over |u|, by how smooth tau and W are in lambda. */
always vreal stick_error(const problem *a, const state *s, const prediction *g, vreal inverse) {
  const vreal inverse_2 = inverse * inverse, mu = a->mu;
  const vreal by_turn = 0.35f * inverse_2 * (inverse_2 * inverse_2);
  const vreal share = mu * v_reciprocal(a->kappa - mu), from_rest = 2.6e-4f * (share * share * share) * (g->z * g->z);
  const vreal by_b =
      1e-4f * v_max(v_fma(-12 * mu, g->t_y, -5 * a->kappa), v_splat(0)); /* W falls with a high power of lambda */
  return mu * (v_select(has_no_slip(a, s), from_rest, by_turn) + by_b + 1e-6f);
}

/* A TURN step. `last`: it ends the collision; `refused`: it would be too short, or the turn is too sharp. */
always turn_step select_turn_step(const problem *a, const state *s, const prediction *g, vreal to_end, const retries *tried,
                                  vmask *last, vmask *refused) {
  turn_step p;
  /* the velocity of d, with the cloth's own pull along d, and its curvature as u turns */
  const vreal own = (a->spin - 1) * a->mu_mu_b * g->z * inverse_length(s->d_x, s->d_y);
  const vreal g_x = own * s->d_x - a->mu_b * g->c, g_y = own * s->d_y + (a->spin * a->mu_b * g->z - 1);
  const vreal angular = -a->mu_b * g->inverse_u * g->z * g->c * a->kappa;
  const vreal c_x = -a->mu_b * g->z * angular, c_y = -a->spin * a->mu_b * g->c * angular;
  const vreal straight = -(s->d_x * g_x + s->d_y * g_y) * v_reciprocal(g_x * g_x + g_y * g_y + TINY);
  /* the closest point of the straight line, and from there that of the line along the curve */
  const vreal d_x = s->d_x + straight * (g_x + 0.5f * straight * c_x), d_y = s->d_y + straight * (g_y + 0.5f * straight * c_y);
  const vreal v_x = g_x + straight * c_x, v_y = g_y + straight * c_y, per_v = inverse_length(v_x, v_y), per_v2 = per_v * per_v;
  const vreal side = (d_x * v_y - d_y * v_x) * per_v2, at = straight - (d_x * v_x + d_y * v_y) * per_v2, width = v_abs(side);

  /* the range of xi that the tolerance allows: rho = y + sqrt(y^2 + 1) with y = pi / range */
  const vreal one = v_splat(1), q = g->rate * to_end, reach = tried->share * v_min(to_end, TURN_Q * v_reciprocal(g->rate));
  const vreal cloth = a->mu_mu_b * g->z,
              needed = v_max((TURN_SHARE * v_reciprocal(a->tolerance)) * cloth * cloth * reach, v_splat(1.0001f));
  const vreal rho = root(root(root(root(needed))));
  const vreal widest = v_min(6.2831853f * v_reciprocal(rho - v_reciprocal(rho)), v_splat(WIDEST_RANGE));
  /* a turn far away is as good as one nearer by and wider */
  const vmask rests = has_no_slip(a, s);
  p.p_t = v_select(rests, 2 * reach, v_min(v_max(at, -reach), 2 * reach));
  const vreal moved = v_select(rests, reach, v_abs(at - p.p_t));
  p.delta = v_min(v_max(v_max(width, v_splat(LEAST_WIDTH)), moved), 2 * reach);
  const vreal per_width = v_reciprocal(p.delta), a_0 = -p.p_t * per_width, a_1 = (reach - p.p_t) * per_width;
  const vreal from = inverse_sinh(a_0), range = inverse_sinh(a_1) - from;
  const vreal e = ONE_OF(exponential(SPREAD(from + widest))), bound = p.p_t + 0.5f * p.delta * (e - v_reciprocal(e));
  const vmask whole = v_less_equal(range, widest);
  p.length = v_select(whole, reach, v_min(bound, reach));
  *last = whole & v_less(q, v_splat(TURN_Q)) & v_less_equal(one, tried->share);
  /* the turn is too sharp, and lies on the step or, in a sensitive collision, shortly before it */
  const vreal least = v_select(a->sensitive, v_splat(LEAST_WIDTH_SENSITIVE), v_splat(LEAST_WIDTH));
  const vmask on_step = v_less(v_select(a->sensitive, -least, v_splat(0)), at) & v_less(at, reach);
  *refused = v_less(tried->share, v_splat(LEAST_SHARE)) | (v_less(width, least) & v_not(rests) & on_step);
  /* the mean of t_y on the straight way, and with it of f */
  const vreal along = root(v_fma(a_1, a_1, one)) - root(v_fma(a_0, a_0, one)),
              across = v_select(v_less(side, v_splat(0)), v_x, -v_x) * range;
  const vreal mean_y = p.delta * per_v * v_reciprocal(reach) * v_fma(v_y, along, across);
  p.mean_f = -a->mu_mu_b_y * g->z * v_select(v_less(moved, v_splat(TINY)), mean_y, g->t_y);
  return p;
}

/* The way ahead of a state that is not easy, to the end or to stick; *first: predicted for the way to the end. */
always prediction predict_ahead(const problem *a, const state *s, const prediction *first, vreal to_end) {
  const vmask is_short = v_less(first->rate * to_end, v_splat(FULL_GRADED_Q));
  if (!v_any(v_not(is_short)))
    return *first;
  return predict(a, s, v_select(is_short, to_end, v_min(to_end, v_reciprocal(first->rate))));
}

/* The share of |u| that a PART takes away. */
always vreal part_share(vreal q) {
  const vreal most = v_select(v_less(v_splat(STICK_Q), q), v_splat(MOST_PART), v_min(MOST_OF_WAY * q, v_splat(MOST_PART)));
  return v_min(v_max((q - LEFT_Q) * (1 / (1 - LEFT_Q)), v_splat(LEAST_PART)), most);
}
always vreal part_length(const prediction *g, vreal to_end) {
  return part_share(g->rate * to_end) * v_reciprocal(g->rate);
}

/* The kind of the next step, a step_kind as a number. *g: the way to the end, with `inverse` rho ahead. `fresh`: the state is
 * that at the start, which is not easy. */
always vreal next_kind(const problem *a, const state *s, const prediction *g, vreal to_end, vreal inverse, vmask careful,
                       bool fresh, prediction *ahead) {
  *ahead = predict_ahead(a, s, g, to_end);
  const vreal q = ahead->rate * to_end, u = v_reciprocal(ahead->inverse_u);
  /* to the end, over even nodes if six are enough; or to stick */
  const vmask full = v_less(q, v_splat(FULL_GRADED_Q)) & is_smooth(MOST_NODES, a, ahead, to_end, inverse);
  const vmask even = full & v_less_equal(q, v_splat(FULL_Q)) & is_smooth(FULL_NODES, a, ahead, to_end, inverse);
  const vmask stick = v_less(v_splat(STICK_Q), q) & v_less(u * stick_error(a, s, ahead, inverse), a->tolerance);
  vmask part = v_less_equal(v_splat(TURN_Q), q) & v_not(stick | full | careful);
  if (v_any(part)) {
    const vreal length = part_length(ahead, to_end);
    part = part & is_smooth(MOST_NODES, a, ahead, length, inverse_rho(a, s, ahead, length));
  }
  /* the first of these that is possible */
  vreal kind = choose_kind(part, PART, v_splat((float)TURN));
  kind = choose_kind(stick, STICK, kind);
  kind = choose_kind(full, FULL_GRADED, kind);
  kind = choose_kind(even, FULL, kind);
  if (!fresh)
    kind = choose_kind(is_easy(a, g, to_end, inverse), EASY, kind);
  return choose_kind(careful, TURN, kind);
}

/* ---- The kinds of steps ------------------------------------------------------------------------------------------------ */

separate vreal take_easy_step(const problem *a, const prediction *g, vreal to_end, const state *s, solution *out) {
  return take_impulse_step(EASY_NODES, EASY_MOST, a, g, s, length_to_end(a, g, to_end), NULL, v_all(), NULL, out);
}
separate vreal take_full_step(const problem *a, const prediction *g, vreal to_end, const state *s, solution *out) {
  return take_impulse_step(FULL_NODES, FULL_MOST, a, g, s, length_to_end(a, g, to_end), NULL, v_all(), NULL, out);
}
separate vreal take_graded_step(const problem *a, const prediction *g, vreal length, vmask last, const state *s, state *next,
                                solution *out) {
  return take_impulse_step(MOST_NODES, GRADED_MOST, a, g, s, length, NULL, last, next, out);
}
separate vreal take_turn_step(const problem *a, const turn_step *p, vmask last, const state *s, state *next, solution *out) {
  const prediction g = predict(a, s, p->length);
  const vreal length = v_select(last, p->length * v_fma(p->mean_f, 1 + p->mean_f, v_splat(1)), p->length);
  return take_impulse_step(MOST_NODES, TURN_MOST, a, &g, s, length, p, last, next, out);
}
separate vreal take_stick_step(const problem *a, const prediction *g, const state *s, solution *out) {
  return stick_step(a, g, s, out);
}

/* A collision between two steps, and what it becomes. */
typedef struct collision {
  state s;
  vreal to_end;
  prediction g; /* for the way to the end */
  retries tried;
} collision;

/* Takes a step of a kind. Returns the lanes in which it was accepted. last: the lanes in which it ends the collision, with the
 * solution in *out if it is accepted; in the others, *c goes on behind it. Where it is refused, *c is told to be more careful.
 * impossible: the lanes that collocation cannot solve. */
always vmask take_step(enum step_kind kind, const problem *a, const prediction *ahead, collision *c, vmask *last,
                       vmask *impossible, solution *out) {
  const state *const s = &c->s;
  const vreal to_end = c->to_end;
  state next;
  vreal error;
  *last = v_all();
  *impossible = v_not(v_all());
  if (kind == EASY)
    error = take_easy_step(a, &c->g, to_end, s, out);
  else if (kind == FULL)
    error = take_full_step(a, ahead, to_end, s, out);
  else if (kind == STICK)
    error = take_stick_step(a, ahead, s, out);
  else if (kind == FULL_GRADED)
    error = take_graded_step(a, ahead, length_to_end(a, ahead, to_end), *last, s, &next, out);
  else if (kind == PART) {
    const vreal length = part_length(ahead, to_end);
    const prediction g = predict(a, s, length);
    *last = v_not(v_all());
    error = take_graded_step(a, &g, length, *last, s, &next, out);
  } else {
    const turn_step p = select_turn_step(a, s, ahead, to_end, &c->tried, last, impossible);
    error = take_turn_step(a, &p, *last, s, &next, out);
  }
  const vmask accepted = v_less(error, a->tolerance) & v_not(*impossible);
  if (kind == PART || kind == TURN) {
    const vmask moved_on = accepted & v_not(*last);
    c->s = choose_state(moved_on, &next, s);
    c->to_end = impulse_to_end(a, &c->s);
    c->g = predict(a, &c->s, c->to_end);
    c->tried.share = v_select(moved_on, v_splat(1), kind == TURN ? 0.5f * c->tried.share : c->tried.share);
    c->tried.careful = v_not(moved_on);
  } else
    c->tried.careful = v_all();
  return accepted;
}

#ifdef CAROM_LANES_ONE

/* Right-hand sides of a step of a kind, at most. */
static const int evaluations_of[STEP_KINDS] = {
    [EASY] = EASY_NODES * (EASY_MOST + 1),          [FULL] = FULL_NODES * (FULL_MOST + 1),
    [FULL_GRADED] = MOST_NODES * (GRADED_MOST + 1), [STICK] = STICK_NODES * (STICK_MOST + 1),
    [PART] = MOST_NODES * (GRADED_MOST + 1),        [TURN] = MOST_NODES * (TURN_MOST + 1)};

/* From a state that is not easy at first, to the end. Returns the number of right-hand sides evaluated, 0 if it did not get
 * there. */
always int take_steps(const problem *a, collision c, vreal inverse, solution *out) {
  int evaluations = 0;
  for (int attempt = 1; attempt <= MOST_ATTEMPTS; attempt++) {
    prediction ahead;
    const enum step_kind kind =
        (enum step_kind)next_kind(a, &c.s, &c.g, c.to_end, inverse, c.tried.careful, attempt == 1, &ahead);
    vmask last, impossible;
    const vmask accepted = take_step(kind, a, &ahead, &c, &last, &impossible, out);
    if (impossible)
      return 0;
    evaluations += evaluations_of[kind];
    if (accepted & last)
      return evaluations;
    inverse = inverse_rho_ahead(a, &c.s, &c.g, c.to_end);
  }
  return 0;
}

int KERNEL(carom_collocate)(const float in[IN_COLUMNS], float spin, float tolerance, float out[OUT_COLUMNS]) {
  const problem a = problem_of(in, spin, tolerance);
  const state s = state_of(&a, in);
  const vreal to_end = 1 + a.e;
  const prediction g = predict(&a, &s, to_end);
  const vreal inverse = inverse_rho_ahead(&a, &s, &g, to_end);
  const vmask easy = is_easy(&a, &g, to_end, inverse);
  solution answer;
  if (easy && take_impulse_step(EASY_NODES, EASY_MOST, &a, &g, &s, length_to_end(&a, &g, to_end), NULL, v_all(), NULL,
                                &answer) < a.tolerance) {
    put_solution(&answer, out);
    return evaluations_of[EASY];
  }
  const collision c = {.s = s, .to_end = to_end, .g = g, .tried = {.share = 1, .careful = easy}};
  const int evaluations = take_steps(&a, c, inverse, &answer);
  put_solution(&answer, out);
  return evaluations;
}

#else

_Static_assert(LANE_STATE + (int)STATE_COLUMNS == LANE_RESTITUTION, "the columns of a state come first");

static state load_state(lane_state at) {
  state s;
  lanes_unrolled for (int c = 0; c < STATE_COLUMNS; c++) s.column[c] = v_load(at[LANE_STATE + c]);
  s.restitution = v_less(v_splat(0), v_load(at[LANE_RESTITUTION]));
  return s;
}

static void store_state(const state *s, lane_state at) {
  lanes_unrolled for (int c = 0; c < STATE_COLUMNS; c++) v_store(at[LANE_STATE + c], s->column[c]);
  v_store(at[LANE_RESTITUTION], v_select(s->restitution, v_splat(1), v_splat(0)));
}

static void store_kinds(vreal kind, lanes_by_step next) {
  lanes_unrolled for (int k = 0; k < STEP_ENDS; k++) next[k] = v_bits(v_equal(kind, v_splat((float)k)));
}

/* Of the lanes of a register, as many as may be put off. */
enum { MOST_UNCONVERGED = LANES / 8 };

void KERNEL(carom_first_step)(step_inputs in, uint32_t good, float spin, float tolerance, step_outputs out,
                              lanes_by_step next) {
  const problem a = problem_of(in, spin, tolerance);
  const state s = state_of(&a, in);
  const vreal to_end = 1 + a.e;
  const prediction g = predict(&a, &s, to_end);
  const vreal inverse = inverse_rho_ahead(&a, &s, &g, to_end);
  const vmask easy = v_from_bits(good) & is_easy(&a, &g, to_end, inverse);
  solution answer;
  impulse_step step;
  start_step(EASY_NODES, &a, &g, &s, length_to_end(&a, &g, to_end), NULL, &step);
  step.f.going = easy;
  for (int i = 0; i < EASY_MOST && v_more(step.f.going, MOST_UNCONVERGED); i++)
    iterate_directions(EASY_NODES, false, &gauss_4, &step);
  const vreal error = end_step(EASY_NODES, false, &step, v_all(), NULL, &answer);
  const vmask solved = easy & v_not(step.f.going) & v_less(error, a.tolerance);
  put_solution(&answer, out);
  memset(next, 0, sizeof(lanes_by_step));
  next[SOLVED] = v_bits(solved);
  if (next[SOLVED] == good)
    return;
  prediction ahead;
  const vreal then = next_kind(&a, &s, &g, to_end, inverse, v_not(v_all()), true, &ahead);
  store_kinds(choose_kind(solved, SOLVED, choose_kind(easy, EASY, then)), next);
}

void KERNEL(carom_next_step)(enum step_kind kind, int fresh, step_inputs in, float spin, float tolerance, lane_state at,
                             step_outputs out, lanes_by_step next) {
  const problem a = problem_of(in, spin, tolerance);
  collision c = {.tried = {.share = v_splat(1), .careful = v_not(v_all())}};
  vreal attempts = v_splat(kind == EASY ? 0 : 1); /* an easy step from the start is not counted */
  if (fresh) {
    c.s = state_of(&a, in);
    c.to_end = 1 + a.e;
  } else {
    c.s = load_state(at);
    c.to_end = impulse_to_end(&a, &c.s);
    c.tried.share = v_load(at[LANE_SHARE]);
    c.tried.careful = v_less(v_splat(0), v_load(at[LANE_CAREFUL]));
    attempts = v_load(at[LANE_ATTEMPTS]) + 1;
  }
  c.g = predict(&a, &c.s, c.to_end);
  solution answer;
  vmask last, impossible;
  prediction ahead = kind == EASY ? c.g : predict_ahead(&a, &c.s, &c.g, c.to_end);
  const vmask solved = take_step(kind, &a, &ahead, &c, &last, &impossible, &answer) & last;
  if (kind != PART)
    put_solution(&answer, out);
  memset(next, 0, sizeof(lanes_by_step));
  next[SOLVED] = v_bits(solved);
  if (!v_any(v_not(solved)))
    return;
  const vmask spent = v_less_equal(v_splat(MOST_ATTEMPTS), attempts) | impossible;
  const vreal inverse = inverse_rho_ahead(&a, &c.s, &c.g, c.to_end);
  const vreal then = next_kind(&a, &c.s, &c.g, c.to_end, inverse, c.tried.careful, false, &ahead);
  store_kinds(choose_kind(solved, SOLVED, choose_kind(spent, REFUSED, then)), next);
  store_state(&c.s, at);
  v_store(at[LANE_SHARE], c.tried.share);
  v_store(at[LANE_CAREFUL], v_select(c.tried.careful, v_splat(1), v_splat(0)));
  v_store(at[LANE_ATTEMPTS], attempts);
}

#endif
