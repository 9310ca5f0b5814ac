/* The exact limit by collocation: which step is next, and the loop of steps, of one collision with
 * all nodes of a step in a register (CAROM_LANES_ONE), or of one step of many collisions, one in
 * each lane. batch.c sorts collisions by the step that they need next.
 *
 * THE KINDS OF STEPS. q is the fraction of |u| that a collision would lose up to its end at the
 * present rate. If q is small and the direction of the cloth slip is smooth, one step in the
 * impulse ends the collision: with four nodes (EASY), with six (FULL) or, where much of |u| is
 * lost, with eight graded ones (FULL_GRADED). If the balls will stick, and |u| is so small that
 * the error of a step to there does not count, that step ends it (STICK); else a step takes away
 * most of |u| first (PART). Where the cloth slip passes near zero, steps whose nodes lie close
 * together there lose less of |u| at a time (TURN).
 *
 * SMOOTHNESS. While d moves along a straight line, t is analytic in the ellipse with foci at the
 * ends of the step that passes through the zeros of |d|^2. With rho the sum of its half axes
 * over the half length of the step, n Gauss nodes converge like rho^-2n. For a TURN step, whose
 * map takes the zeros to xi = +- i pi / 2, the same holds with the range of xi.
 *
 * ACCEPTANCE. A step is accepted if its error estimate is below the tolerance. If it is not, a
 * TURN step is tried, and then TURN steps of half the length. After MOST_ATTEMPTS steps, or if
 * they get too short, collocation rejects the collision, and the precise solver takes it. */
#include "ball_ball/impulse_step.h"
#include "ball_ball/kernels.h"
#include "ball_ball/stick_step.h"

enum { EASY_NODES = 4, FULL_NODES = 6 }; /* of STICK: stick_step.h; of all others: MOST_NODES */
/* Iterations at most. */
enum { EASY_MOST = 3, FULL_MOST = 4, GRADED_MOST = 5, TURN_MOST = 6 };
enum { MOST_ATTEMPTS = 14 };

/* Found by trial with `carom-lab stress --draws 60000`, which prints the largest errors in units
 * of the fastest speed: 3.5e-7 for the paper's slip and 4.4e-7 for pooltool's. Times are of
 * collisions of play, measured to about 4 %. At twice and at half:
 *
 *     EASY_SHARE, BEND_8    nothing changes at either
 *     MOST_EASY_Q           twice: nothing changes; half: calls take 4 % longer, batches 9 %
 *     FULL_Q                twice: errors to 7.6e-7; half: calls take 4 % longer, batches 5 %
 *     BEND_4                twice: calls and batches take 4 % longer; half: nothing changes
 *     TURN_Q                twice: errors to 1.2e-6; half: 0.03 % go to the precise solver, not
 *                           0.01 %
 *     WIDEST_RANGE          twice: errors to 1.1e-6; half: 0.02 % go to the precise solver
 *     LEAST_PART            twice: errors to 5.2e-7; half: nothing changes
 *     TURN_SHARE            twice: 0.02 % go to the precise solver with pooltool's slip; half:
 *                           nothing changes */
static const real EASY_SHARE = 6;                 /* error of an EASY step over mu_b rho^-8 with rho
                                                 for u, */
static const real MOST_EASY_Q = REAL(0.62);       /* its q */
static const real MOST_EASY_MU_MU_B = REAL(5e-3); /* and its mu mu_b q^2 */
static const real FULL_Q = REAL(0.66);            /* q of a FULL step over even nodes, */
static const real FULL_GRADED_Q = REAL(0.96);     /* and over graded ones */
static const real BEND_4 = 20;
static const real BEND_8 = 30; /* by q^2: a way that is not straight adds this to the error,
                                       with 4 nodes and with more */
static const real STICK_Q = REAL(1.05); /* q from which the balls will stick */
static const real TURN_Q = REAL(0.5);   /* q of a TURN step */
static const real LEFT_Q = REAL(0.5);   /* q that a PART would leave; */
/* its fraction of |u|, and of q */
static const real LEAST_PART = REAL(0.3);
static const real MOST_PART = REAL(0.85);
static const real MOST_OF_WAY = REAL(0.8);
/* delta of a TURN step; of sensitive collisions */
static const real LEAST_DELTA = REAL(1e-5);
static const real LEAST_DELTA_SENSITIVE = REAL(1e-3);
/* of xi of a TURN step */
static const real WIDEST_RANGE = REAL(4.5);
/* its error over (mu mu_b sigma)^2 L rho^-16 */
static const real TURN_SHARE = 350;
/* of its usual length */
static const real LEAST_SHARE = REAL(0.1);

#define separate static __attribute__((noinline)) /* the inlined text of a step is long */

always vreal choose_kind(vmask m, enum step_kind kind, vreal otherwise) {
  return v_select(m, v_splat((real)kind), otherwise);
}

always vreal power_4(vreal x) {
  return (x * x) * (x * x);
}

/* A collision between two steps. */
typedef struct collision {
  state s;
  vreal to_end;   /* p to the end, if no more work were done on the cloth's friction */
  prediction g;   /* for that way */
  vreal share;    /* of its usual length that a TURN step may have, after refusals from this
                     state */
  vmask careful;  /* a step from this state was rejected: only TURN steps now */
  vreal attempts; /* steps tried so far, but for an easy step at the start */
} collision;

/* An upper bound of 1 / rho for a step of a length. The sum of the distances of a zero of |d|^2
 * to the ends of the step is |d_0| + |d_1| over the rate of d, so that rho + 1 / rho = 2 (|d_0|
 * + |d_1|) / |d_1 - d_0|. Friction of the cloth shortens d on the way, in a direction that is
 * not known: its size is subtracted. */
always vreal inverse_rho(const problem *a, const state *s, const prediction *g, vreal length) {
  const real margin = a->spin < 1 ? 1 - a->spin : 0;
  const vreal g_x = length * (a->mu_b * g->c),
              g_y = length * v_fma(-a->spin * a->mu_b, g->z, v_splat(1)), tiny = v_splat(TINY);
  /* d at the end of the step, and |d| at both ends */
  const vreal d_x = s->d_x - g_x, d_y = s->d_y - g_y;
  const vreal d_0 = root(v_fma(s->d_x, s->d_x, v_fma(s->d_y, s->d_y, tiny))),
              d_1 = root(v_fma(d_x, d_x, v_fma(d_y, d_y, tiny)));
  /* half of rho + 1 / rho; rho is at least twice that less its inverse */
  const vreal shortening = margin * a->mu_mu_b * g->z * length;
  const vreal sum = v_max((d_0 + d_1 - shortening) * inverse_length(g_x, g_y), v_splat(1));
  return v_select(has_no_slip(a, s), v_splat(0), v_reciprocal(2 * sum - v_reciprocal(sum)));
}

/* The same up to the end or to stick, whichever is first. */
always vreal inverse_rho_ahead(const problem *a, const state *s, const prediction *g,
                               vreal to_end) {
  return inverse_rho(a, s, g, v_min(to_end, v_reciprocal(g->rate)));
}

/* Is the direction of the cloth slip smooth enough for n nodes? d moves along a straight line
 * the less, the more of |u| is lost. */
always vmask is_smooth(int n, const problem *a, const prediction *g, vreal length, vreal inverse) {
  const vreal inverse_4 = power_4(inverse), inverse_8 = inverse_4 * inverse_4, q = g->rate * length;
  const real scale = n == 6 ? REAL(6.0) : REAL(2.0);
  const vreal share = n == 4 ? 4 * inverse_8 : scale * (inverse_8 * inverse_8);
  const vreal left_out = a->mu_mu_b * g->z * length * share;
  return v_less(left_out * v_fma((n == 4 ? BEND_4 : BEND_8) * q, q, v_splat(1)), a->tolerance);
}

/* Will an EASY step do? *g: predicted for the way to the end. |u| would reach zero at X = 1 / q,
 * so that its ellipse has rho = (1 + s) / (1 - s) with s^2 = 1 - q. */
always vmask is_easy(const problem *a, const prediction *g, vreal to_end, vreal inverse) {
  const vreal q = g->rate * to_end, root_left = v_sqrt(v_max(1 - q, v_splat(0)));
  const vreal inverse_4 = power_4((1 - root_left) * v_rough_reciprocal(1 + root_left));
  return v_less(EASY_SHARE * a->mu_b * (inverse_4 * inverse_4), a->tolerance) &
         v_less(q, v_splat(MOST_EASY_Q)) & v_less(a->mu_mu_b * q * q, v_splat(MOST_EASY_MU_MU_B)) &
         is_smooth(4, a, g, to_end, inverse);
}

/* The error of a step to stick, over |u|: of a tau that turns (rho^-6), or that starts without
 * slip on the cloth; and of a W that falls with a high power of lambda. */
always vreal stick_error(const problem *a, const state *s, const prediction *g, vreal inverse) {
  const vreal inverse_2 = inverse * inverse, mu = a->mu;
  const vreal by_turn = REAL(0.35) * inverse_2 * (inverse_2 * inverse_2);
  const vreal share = mu * v_reciprocal(a->kappa - mu),
              from_rest = REAL(2.6e-4) * (share * share * share) * (g->z * g->z);
  const vreal by_b = REAL(1e-4) * v_max(v_fma(-12 * mu, g->t_y, -5 * a->kappa), v_splat(0));
  return mu * (v_select(has_no_slip(a, s), from_rest, by_turn) + by_b + REAL(1e-6));
}

/* The TURN step from a state of a collision: where d passes nearest to zero, and how far the
 * step may go. last: the lanes in which it ends the collision; rejected: those in which it would
 * be too short, or d passes too close to zero. */
always turn_step select_turn_step(const problem *a, const collision *c, const prediction *g,
                                  vmask *last, vmask *refused) {
  turn_step p;
  const state *const s = &c->s;
  /* d' = g, with the cloth's own friction along d; and its curvature c, as u turns at the rate
   * `angular` */
  const vreal drive = (a->spin - 1) * a->mu_mu_b * g->z * inverse_length(s->d_x, s->d_y);
  const vreal g_x = drive * s->d_x - a->mu_b * g->c,
              g_y = drive * s->d_y + (a->spin * a->mu_b * g->z - 1);
  const vreal angular = -a->mu_b * g->inverse_u * g->z * g->c * a->kappa;
  const vreal c_x = -a->mu_b * g->z * angular, c_y = -a->spin * a->mu_b * g->c * angular;

  /* p at the point of the straight line that is nearest to zero; d and its rate v there, along
   * the curve */
  const vreal straight =
      -(s->d_x * g_x + s->d_y * g_y) * v_reciprocal(g_x * g_x + g_y * g_y + TINY);
  const vreal d_x = s->d_x + straight * (g_x + REAL(0.5) * straight * c_x),
              d_y = s->d_y + straight * (g_y + REAL(0.5) * straight * c_y);
  const vreal v_x = g_x + straight * c_x, v_y = g_y + straight * c_y,
              per_v = inverse_length(v_x, v_y), per_v2 = per_v * per_v;

  /* p_t, and delta with the sign of the side on which zero is passed: of the straight line
   * through that point */
  const vreal side = (d_x * v_y - d_y * v_x) * per_v2,
              nearest = straight - (d_x * v_x + d_y * v_y) * per_v2, width = v_abs(side);

  /* the longest step by how much of |u| it may lose, and after refusals */
  const vreal unit = v_splat(1), q = g->rate * c->to_end,
              reach = c->share * v_min(c->to_end, TURN_Q * v_reciprocal(g->rate));

  /* rho^16 that the tolerance needs; the singularities at +- i pi / 2 then allow a range of xi
   * of 2 pi / (rho - 1 / rho) */
  const vreal cloth = a->mu_mu_b * g->z,
              needed = v_max((TURN_SHARE * v_reciprocal(a->tolerance)) * cloth * cloth * reach,
                             v_splat(REAL(1.0001)));
  const vreal rho = root(root(root(root(needed))));
  const vreal widest =
      v_min(REAL(6.2831853) * v_reciprocal(rho - v_reciprocal(rho)), v_splat(WIDEST_RANGE));

  /* a zero far from the step is as good as one that is nearer by and wider: p_t near the step,
   * delta within bounds */
  const vmask rests = has_no_slip(a, s);
  p.p_t = v_select(rests, 2 * reach, v_min(v_max(nearest, -reach), 2 * reach));
  const vreal moved = v_select(rests, reach, v_abs(nearest - p.p_t));
  p.delta = v_min(v_max(v_max(width, v_splat(LEAST_DELTA)), moved), 2 * reach);

  /* sinh(xi) at the start and at `reach`, and how far that range leads: to `reach`, or to the
   * widest range allowed */
  const vreal per_delta = v_reciprocal(p.delta), sinh_0 = -p.p_t * per_delta,
              sinh_1 = (reach - p.p_t) * per_delta;
  const vreal low = inverse_sinh(sinh_0), range = inverse_sinh(sinh_1) - low;
  const vreal e = ONE_OF(exponential(SPREAD(low + widest))),
              bound = p.p_t + REAL(0.5) * p.delta * (e - v_reciprocal(e));
  const vmask whole = v_less_equal(range, widest);
  p.length = v_select(whole, reach, v_min(bound, reach));
  *last = whole & v_less(q, v_splat(TURN_Q)) & v_less_equal(unit, c->share);

  /* rejected: d passes too close to zero on the step or, in a sensitive collision, shortly before
   * it */
  const vreal least = v_select(a->sensitive, v_splat(LEAST_DELTA_SENSITIVE), v_splat(LEAST_DELTA));
  const vmask on_step =
      v_less(v_select(a->sensitive, -least, v_splat(0)), nearest) & v_less(nearest, reach);
  *refused =
      v_less(c->share, v_splat(LEAST_SHARE)) | (v_less(width, least) & v_not(rests) & on_step);

  /* the mean of t_y along the straight line, whose parts along and across v integrate to sqrt(1
   * + sinh^2) and to xi; and the mean of f that follows */
  const vreal along = root(v_fma(sinh_1, sinh_1, unit)) - root(v_fma(sinh_0, sinh_0, unit)),
              across = v_select(v_less(side, v_splat(0)), v_x, -v_x) * range;
  const vreal mean_y = p.delta * per_v * v_reciprocal(reach) * v_fma(v_y, along, across);
  p.mean_f = -a->mu_mu_b_y * g->z * v_select(v_less(moved, v_splat(TINY)), mean_y, g->t_y);
  return p;
}

/* The prediction for a state that is not easy: up to the end or, where |u| would not last so
 * long, to stick. */
always prediction predict_ahead(const problem *a, const collision *c) {
  const vmask is_short = v_less(c->g.rate * c->to_end, v_splat(FULL_GRADED_Q));
  if (!v_any(v_not(is_short)))
    return c->g;
  return predict(a, &c->s,
                 v_select(is_short, c->to_end, v_min(c->to_end, v_reciprocal(c->g.rate))));
}

/* The fraction of |u| that a PART takes away: so much that LEFT_Q of the rest is lost up to the
 * end; and the length that loses it.
 */
always vreal part_share(vreal q) {
  const vreal most = v_select(v_less(v_splat(STICK_Q), q), v_splat(MOST_PART),
                              v_min(MOST_OF_WAY * q, v_splat(MOST_PART)));
  return v_min(v_max((q - LEFT_Q) * (1 / (1 - LEFT_Q)), v_splat(LEAST_PART)), most);
}
always vreal part_length(const prediction *g, vreal to_end) {
  return part_share(g->rate * to_end) * v_reciprocal(g->rate);
}

/* The kind of the next step, a step_kind as a number, with the prediction for it in *ahead.
 * inverse: 1 / rho of the way ahead. at_start: the collision has not begun, and is known not to
 * be easy. */
always vreal next_kind(const problem *a, const collision *c, vreal inverse, bool at_start,
                       prediction *ahead) {
  *ahead = predict_ahead(a, c);
  const state *const s = &c->s;
  const vreal to_end = c->to_end, q = ahead->rate * to_end, u = v_reciprocal(ahead->inverse_u);
  /* to the end by eight graded nodes, by six even ones if they are enough; or to stick */
  const vmask full =
      v_less(q, v_splat(FULL_GRADED_Q)) & is_smooth(MOST_NODES, a, ahead, to_end, inverse);
  const vmask even =
      full & v_less_equal(q, v_splat(FULL_Q)) & is_smooth(FULL_NODES, a, ahead, to_end, inverse);
  const vmask stick =
      v_less(v_splat(STICK_Q), q) & v_less(u * stick_error(a, s, ahead, inverse), a->tolerance);
  /* a fraction of |u|, if t is smooth on the way that removes it */
  vmask part = v_less_equal(v_splat(TURN_Q), q) & v_not(stick | full | c->careful);
  if (v_any(part)) {
    const vreal length = part_length(ahead, to_end);
    part = part & is_smooth(MOST_NODES, a, ahead, length, inverse_rho(a, s, ahead, length));
  }
  /* the cheapest that is possible; later lines win */
  vreal kind = choose_kind(part, PART, v_splat((real)TURN));
  kind = choose_kind(stick, STICK, kind);
  kind = choose_kind(full, FULL_GRADED, kind);
  kind = choose_kind(even, FULL, kind);
  if (!at_start)
    kind = choose_kind(is_easy(a, &c->g, to_end, inverse), EASY, kind);
  return choose_kind(c->careful, TURN, kind);
}

/* ---- Steps of each kind, with the error estimate that they return ---- */

separate vreal take_easy_step(const problem *a, const prediction *g, vreal to_end, const state *s,
                              solution *out) {
  return take_impulse_step(EASY_NODES, EASY_MOST, a, g, s, length_to_end(a, g, to_end), NULL,
                           v_all(), NULL, out);
}
separate vreal take_full_step(const problem *a, const prediction *g, vreal to_end, const state *s,
                              solution *out) {
  return take_impulse_step(FULL_NODES, FULL_MOST, a, g, s, length_to_end(a, g, to_end), NULL,
                           v_all(), NULL, out);
}
separate vreal take_graded_step(const problem *a, const prediction *g, vreal length, vmask last,
                                const state *s, state *next, solution *out) {
  return take_impulse_step(MOST_NODES, GRADED_MOST, a, g, s, length, NULL, last, next, out);
}
separate vreal take_turn_step(const problem *a, const turn_step *p, vmask last, const state *s,
                              state *next, solution *out) {
  const prediction g = predict(a, s, p->length);
  const vreal length =
      v_select(last, p->length * v_fma(p->mean_f, 1 + p->mean_f, v_splat(1)), p->length);
  return take_impulse_step(MOST_NODES, TURN_MOST, a, &g, s, length, p, last, next, out);
}
separate vreal take_stick_step(const problem *a, const prediction *g, const state *s,
                               solution *out) {
  return stick_step(a, g, s, out);
}

/* ---- The control of steps, for calls and for lanes ---- */

/* Of the lanes of a register, as many as the first step does not wait for; none in a call. */
enum { MOST_UNCONVERGED = LANES / 8 };

/* At the start. */
always collision collision_of(const problem *a, in_column *in) {
  collision c = {
      .s = state_of(a, in), .to_end = 1 + a->e, .share = v_splat(1), .careful = v_not(v_all())};
  c.attempts = v_splat(0);
  c.g = predict(a, &c.s, c.to_end);
  return c;
}

/* Puts collisions at their start, and solves those that an EASY step solves, which is most.
 * Returns these lanes, with *out. In others, *kind is the next step, and *ahead is predicted
 * for that. A lane that the others did not wait for gets EASY again.
 */
always vmask begin_collision(const problem *a, in_column *in, vmask good, collision *c, vreal *kind,
                             prediction *ahead, solution *out) {
  *c = collision_of(a, in);
  const vreal inverse = inverse_rho_ahead(a, &c->s, &c->g, c->to_end);
  const vmask easy = good & is_easy(a, &c->g, c->to_end, inverse);
  vmask solved = v_not(v_all());
  if (v_any(easy)) {
    /* an EASY step, until nearly all lanes have converged */
    impulse_step step;
    start_step(EASY_NODES, a, &c->g, &c->s, length_to_end(a, &c->g, c->to_end), NULL, &step);
    step.f.going = easy;
    int i = 0;
    for (; i < EASY_MOST && v_more(step.f.going, MOST_UNCONVERGED); i++)
      iterate_directions(EASY_NODES, false, &gauss_4, &step);
    const vreal error = end_step(EASY_NODES, false, &step, v_all(), NULL, out);
    /* lanes that may still iterate are not done */
    solved = easy & v_less(error, a->tolerance);
    if (LANES > 1)
      solved = solved & v_not(step.f.going);
    if (!v_any(good & v_not(solved)))
      return solved;
  }
  /* a call knows that its EASY step is rejected; lanes take it again */
  if (LANES == 1)
    c->careful = easy;
  *kind = next_kind(a, c, inverse, true, ahead);
  if (LANES > 1)
    *kind = choose_kind(easy, EASY, *kind);
  return solved;
}

/* Takes a step of a kind, for which *ahead has been predicted. Returns the lanes that it solved,
 * with *out; in the others the collision continues behind the step or, where it was rejected, will
 * be more careful, and *next is the kind of the next step, or REFUSED, with the prediction for
 * it in *ahead. */
always vmask take_step(enum step_kind kind, const problem *a, prediction *ahead, collision *c,
                       solution *out, vreal *next) {
  const state *const s = &c->s;
  const vreal to_end = c->to_end;
  state behind;
  vreal error;
  vmask last = v_all(), impossible = v_not(v_all());

  /* the step of that kind */
  if (kind == EASY)
    error = take_easy_step(a, &c->g, to_end, s, out);
  else if (kind == FULL)
    error = take_full_step(a, ahead, to_end, s, out);
  else if (kind == STICK)
    error = take_stick_step(a, ahead, s, out);
  /* steps with graded lengths: to the end, a fraction of it, or up to where the slip turns */
  else if (kind == FULL_GRADED)
    error = take_graded_step(a, ahead, length_to_end(a, ahead, to_end), last, s, &behind, out);
  else if (kind == PART) {
    const vreal length = part_length(ahead, to_end);
    const prediction g = predict(a, s, length);
    last = v_not(v_all());
    error = take_graded_step(a, &g, length, last, s, &behind, out);
  } else {
    const turn_step p = select_turn_step(a, c, ahead, &last, &impossible);
    error = take_turn_step(a, &p, last, s, &behind, out);
  }

  /* the lanes that it has brought to the end */
  const vmask accepted = v_less(error, a->tolerance) & v_not(impossible), solved = accepted & last;
  if (!v_any(v_not(solved)))
    return solved;

  /* on behind the step, or again with more care */
  c->attempts = c->attempts + 1;
  if (kind == PART || kind == TURN) {
    const vmask moved_on = accepted & v_not(last);
    c->s = choose_state(moved_on, &behind, s);
    c->to_end = impulse_to_end(a, &c->s);
    c->g = predict(a, &c->s, c->to_end);
    c->share = v_select(moved_on, v_splat(1), kind == TURN ? REAL(0.5) * c->share : c->share);
    c->careful = v_not(moved_on);
  } else
    c->careful = v_all();

  /* those that have tried too often go to the fallback */
  const vmask spent = v_less_equal(v_splat(MOST_ATTEMPTS), c->attempts) | impossible;
  const vreal following =
      next_kind(a, c, inverse_rho_ahead(a, &c->s, &c->g, c->to_end), false, ahead);
  *next = choose_kind(spent, REFUSED, following);
  return solved;
}

#ifdef CAROM_LANES_ONE

/* Right-hand sides of a step of a kind, at most. */
static const int evaluations_of[STEP_KINDS] = {
    [EASY] = EASY_NODES * (EASY_MOST + 1),          [FULL] = FULL_NODES * (FULL_MOST + 1),
    [FULL_GRADED] = MOST_NODES * (GRADED_MOST + 1), [STICK] = STICK_NODES * (STICK_MOST + 1),
    [PART] = MOST_NODES * (GRADED_MOST + 1),        [TURN] = MOST_NODES * (TURN_MOST + 1)};

int COLLOCATION_KERNEL(carom_collocate)(const real in[IN_COLUMNS], double spin, float tolerance,
                                        real out[OUT_COLUMNS]) {
  const problem a = problem_of(in, (real)spin, tolerance);
  collision c;
  solution answer;
  vreal kind;
  prediction ahead;
  if (begin_collision(&a, in, v_all(), &c, &kind, &ahead, &answer)) {
    put_solution(&answer, out);
    return evaluations_of[EASY];
  }
  for (int evaluations = 0; kind < (real)STEP_KINDS;) {
    evaluations += evaluations_of[(int)kind];
    if (take_step((enum step_kind)kind, &a, &ahead, &c, &answer, &kind)) {
      put_solution(&answer, out);
      return evaluations;
    }
  }
  return 0;
}

#else

_Static_assert(LANE_STATE + (int)STATE_COLUMNS == LANE_RESTITUTION,
               "the columns of a state come first");

static collision load_collision(const problem *a, lane_state lanes) {
  collision c = {.share = COLUMN(lanes, LANE_SHARE), .attempts = COLUMN(lanes, LANE_ATTEMPTS)};
  lanes_unrolled for (int k = 0; k < STATE_COLUMNS; k++) c.s.column[k] =
      COLUMN(lanes, LANE_STATE + k);
  c.s.restitution = v_less(v_splat(0), COLUMN(lanes, LANE_RESTITUTION));
  c.careful = v_less(v_splat(0), COLUMN(lanes, LANE_CAREFUL));
  c.to_end = impulse_to_end(a, &c.s);
  c.g = predict(a, &c.s, c.to_end);
  return c;
}

static void store_collision(const collision *c, lane_state lanes) {
  lanes_unrolled for (int k = 0; k < STATE_COLUMNS; k++)
      put_column(lanes, LANE_STATE + k, c->s.column[k]);
  put_column(lanes, LANE_RESTITUTION, v_select(c->s.restitution, v_splat(1), v_splat(0)));
  put_column(lanes, LANE_SHARE, c->share);
  put_column(lanes, LANE_CAREFUL, v_select(c->careful, v_splat(1), v_splat(0)));
  put_column(lanes, LANE_ATTEMPTS, c->attempts);
}

/* The next step after a step, in the lanes that it solved and in others. Returns whether there
 * are others. */
static bool store_kinds(vmask solved, vmask others, vreal kind, lanes_by_step next) {
  memset(next, 0, sizeof(lanes_by_step));
  next[SOLVED] = v_bits(solved);
  if (!v_any(others))
    return false;
  kind = choose_kind(solved, SOLVED, kind);
  lanes_unrolled for (int k = 0; k < STEP_ENDS; k++) next[k] =
      v_bits(v_equal(kind, v_splat((real)k)));
  return true;
}

void COLLOCATION_KERNEL(carom_first_step)(step_inputs in, uint32_t good, double spin,
                                          float tolerance, step_outputs out, lanes_by_step next) {
  const problem a = problem_of(in, (real)spin, tolerance);
  const vmask lanes = v_from_bits(good);
  collision c;
  solution answer = {.K_c = v_splat(0)}; /* of lanes that no step solves: zeros */
  vreal kind = v_splat((real)REFUSED);
  prediction ahead;
  const vmask solved = begin_collision(&a, in, lanes, &c, &kind, &ahead, &answer);
  if (v_any(solved))
    put_solution(&answer, out);
  store_kinds(solved, lanes & v_not(solved), kind, next);
}

void COLLOCATION_KERNEL(carom_next_step)(enum step_kind kind, int at_start, step_inputs in,
                                         double spin, float tolerance, lane_state lanes,
                                         step_outputs out, lanes_by_step next) {
  const problem a = problem_of(in, (real)spin, tolerance);
  collision c = at_start ? collision_of(&a, in) : load_collision(&a, lanes);
  if (at_start && kind == EASY) /* lanes that the first step did not wait for: it does not count */
    c.attempts = v_splat(-1);
  solution answer;
  vreal following = v_splat((real)REFUSED);
  prediction ahead = kind == EASY ? c.g : predict_ahead(&a, &c);
  const vmask solved = take_step(kind, &a, &ahead, &c, &answer, &following);
  if (kind != PART)
    put_solution(&answer, out);
  if (store_kinds(solved, v_not(solved), following, next))
    store_collision(&c, lanes);
}

#endif
