/* An impact step by step: the choice of a step, and the state after it.
 *
 * A REGIME (contact.c) lasts until a slip is zero or its event happens. Where all rates are
 * constant, as in an impact without motion along x, the solution is a straight line. Otherwise a
 * step is planned by the motion of the slip a at the driving contact:
 *
 *     a slides             a stretched map (map.h)
 *     a is quasi-steady    friction nearly balances the force on a, and a has settled in the
 *                          direction in which friction lets it go. The equations are stiff and
 *                          their solution is smooth: an even map, and exact steps
 *     a begins from zero   the same
 *     a is held            only b moves: an even map
 *
 * A step in which b passes near zero has a sinh map. A b that is quasi-steady takes an even map
 * and exact steps.
 *
 * SAFETY. A step that is refused is tried again with a shorter length. After MOST_REFUSALS in a
 * row the rest of the impact goes by careful steps: exact ones over even maps, each only a share
 * of the way to where a slip could vanish. The caller bounds the number of iterations of all
 * steps together. */
#include "contact_law/map.h"
#include "contact_law/variation_step.h"
#include "platform/elementary.h"

#include <float.h>

/* Found by trial with `carom-lab stress --cushion 20000`, whose largest error is 1.1e-7 in play
 * and 1.5e-6 anywhere, and the times of docs/understanding/cushion.md.
 * Times vary by about 3 %. At twice and at half:
 *
 *     MOST_TURN                twice: nothing changes; half: play takes 4 % longer
 *     MOST_FALL                twice: play takes 58 % longer; half: 8 %
 *     BOLDER                   twice: play takes 5 % longer, 3 impacts of 20,000 are unresolved
 *                              instead of 2; half: nothing
 *     ALIGNED                  twice: errors to 2.1e-6; half: nothing changes
 *     CAREFUL_SHARE            twice: nothing changes; half: all takes 3 to 4 % longer
 *     STIFF, SETTLING          nothing changes for the worse at either */
static const double MOST_TURN = 2.3;     /* D tau of a stretched step, */
static const double MOST_FALL = 2.6;     /* and the logarithm by which r falls in it: */
static const double BOLDER = 0.15;       /* both plus this times -log(r), since small slips
                                            matter less */
static const double STIFF = 3;           /* D p / r from which on a slip is quasi-steady, */
static const double ALIGNED = 0.15;      /* if sin(psi) is at most this */
static const double SETTLING = 10;       /* D p / r of a quasi-steady step whose direction still
                                            settles */
static const double NEGLIGIBLE = 1e-7;   /* r sin(psi) that need not settle first */
static const double SLOW = 0.5;          /* rate of a slip over that by friction alone, below
                                            which it is quasi-steady */
static const double CAREFUL_SHARE = 0.6; /* of the way to a slip of zero, for a careful step */
static const double IMMEDIATE = 1e-9;    /* share of a step at which an event happens where the
                                            step begins */
static const double MOST_GROWTH = 6.9;   /* carom_point.growth: log of 1000 */
static const double MOST_ACROSS = 1e-6;  /* carom_trajectory.across */
static const double AGAIN = 1e-6;        /* v in restitution of a ball that approaches again: a
                                            second compression */
enum {
  MOST_REFUSALS = 6,         /* in a row, before steps become careful; */
  MOST_MISSED = 3,           /* steps to stick that diverged, as a only passes near zero, before
                                the same; */
  MOST_CAREFUL_REFUSALS = 30 /* and before careful ones give up */
};

/* The kinds of steps, compiled one by one so that each leaves out the terms of the others. */
typedef enum outcome step_kind(const carom_terms *, const step *, carom_point *, int *, double *);
#define KIND(name, driving_slips, loaded, exact)                                               \
  static __attribute__((noinline)) enum outcome name(                                          \
      const carom_terms *k, const step *s, carom_point *at, int *iterations, double *advice) { \
    return collocate(k, s, driving_slips, loaded, exact, at, iterations, advice);              \
  }
KIND(sliding, true, true, FOR_NONE)
KIND(sliding_unloaded, true, false, FOR_NONE)
KIND(exact_in_a, true, true, FOR_U)
KIND(exact_unloaded, true, false, FOR_U)
KIND(exact_in_both, true, true, FOR_BOTH)
KIND(held_straight, false, true, FOR_NONE)
KIND(held_exact, false, true, FOR_BOTH)

/* A plan: the step and its kind. */
typedef struct plan {
  step s;
  step_kind *kind;
} plan;

static double least(double x, double y) {
  return x < y ? x : y;
}

static double most_of(double x, double y) {
  return x > y ? x : y;
}

static bool driving_slips(const carom_trajectory *path) {
  return !path->regime.held && path->law.mu > 0;
}

/* W at the end of restitution. */
static double work_end(const carom_trajectory *path) {
  return -path->law.e * path->law.e * path->W_c;
}

/* Where a step starts: slips, directions and rates, and how far it may go. */
static void start_at(const carom_trajectory *path, double target, step_start *s) {
  const carom_point *point = &path->point;
  const carom_terms *k = &path->terms;
  /* the slips: sizes, and directions or, of a slip that begins, those of the regime */
  s->r = sqrt(point->a_x * point->a_x + point->a_y * point->a_y);
  s->q = sqrt(point->b_x * point->b_x + point->b_y * point->b_y);
  const double per_r = 1 / s->r, per_q = 1 / s->q;
  s->u_x = s->r > 0 ? point->a_x * per_r : path->regime.u_x;
  s->u_y = s->r > 0 ? point->a_y * per_r : path->regime.u_y;
  s->t_x = s->q > 0 ? point->b_x * per_q : path->regime.t_x;
  s->t_y = s->q > 0 ? point->b_y * per_q : path->regime.t_y;

  /* the rates */
  s->w = (k->w_0 + k->w_u * s->u_y) / (1 - k->w_t * s->t_y);
  const double x = s->w * s->t_x, y = s->w * s->t_y;
  s->da_x = k->S_x * s->u_x - k->C_x * x;
  s->da_y = k->A_0 + k->S_y * s->u_y - k->C_y * y;
  s->db_x = k->R_x * s->u_x - k->H_x * x;
  s->db_y = k->B_0 + k->R_y * s->u_y - k->H_y * y;
  s->dv = k->V_0 + k->V_u * s->u_y - k->V_w * y;

  /* the mean of b' if b passes zero, where the cloth's own friction changes its sign */
  s->line_x = s->db_x + 0.5 * k->H_x * x;
  s->line_y = s->db_y + 0.5 * k->H_y * y;

  /* the end of the phase if v' were constant; or an earlier end. Friction of a steep nose
   * may push the ball on, v' > 0, until slip has changed: then no end is in sight, and a step
   * may go as far as slip lasts */
  if (path->restitution) {
    /* p where W = target, by the quadratic equation for a constant v' */
    s->goal = AT_WORK;
    s->target = work_end(path);
    const double missing = s->target - point->W, square = point->v * point->v + 2 * s->dv * missing;
    s->to_goal =
        square > 0 || s->dv < 0 ? 2 * missing / (point->v - sqrt(most_of(square, 0))) : INFINITY;
  } else {
    s->goal = AT_END_OF_APPROACH;
    s->target = 0;
    s->to_goal = s->dv < 0 ? -point->v / s->dv : INFINITY;
  }

  /* no end in sight: as far as the larger of the slips lasts, but no more than 1 */
  if (s->to_goal == INFINITY) {
    s->goal = AT_LENGTH;
    s->to_goal =
        most_of(s->r / (fabs(s->da_x) + fabs(s->da_y)), s->q / (fabs(s->db_x) + fabs(s->db_y)));
    if (!(s->to_goal > 0 && s->to_goal < 1))
      s->to_goal = 1;
  }

  /* an earlier end: p asked for, the event of the regime, the length left by a refusal */
  if (target - point->p < s->to_goal) {
    s->goal = AT_P;
    s->target = s->to_goal = target - point->p;
  }
  if (path->event_at - point->p < (s->goal == AT_P ? s->to_goal : DBL_MAX)) {
    s->goal = AT_EVENT;
    s->to_goal = most_of(path->event_at - point->p, DBL_MIN);
  }
  if (path->longest < s->to_goal) {
    s->goal = AT_LENGTH;
    s->to_goal = path->longest;
  }
}

/* Directions to begin with: both slips along straight lines. */
static void aim_u(plan *n, const carom_point *point, const step_start *s) {
  aim(&n->s, point->a_x, point->a_y, s->da_x, s->da_y, s->u_x, s->u_y, n->s.u_x, n->s.u_y);
}

static void aim_t(plan *n, const carom_point *point, const step_start *s) {
  aim(&n->s, point->b_x, point->b_y, s->line_x, s->line_y, s->t_x, s->t_y, n->s.t_x, n->s.t_y);
}

/* Limits the length, which then is the end of the step. */
static void limit(double *length, enum goal *goal, double most) {
  if (*length > most) {
    *length = most;
    *goal = AT_LENGTH;
  }
}

/* A careful step: exact, over an even map, at most a share of the way to where a slip could
 * vanish. */
static void plan_carefully(const carom_trajectory *path, const step_start *s, plan *n) {
  double length = s->to_goal;
  n->s.goal = s->goal;
  /* |a| and |b| over their rates: sums of components are upper bounds */
  if (driving_slips(path) && s->r > 0)
    limit(&length, &n->s.goal, CAREFUL_SHARE * s->r / (fabs(s->da_x) + fabs(s->da_y) + DBL_MIN));
  if (path->regime.loaded && s->q > 0)
    limit(&length, &n->s.goal, CAREFUL_SHARE * s->q / (fabs(s->db_x) + fabs(s->db_y) + DBL_MIN));
  even_map(&n->s, length);
  n->kind = held_exact;
  if (driving_slips(path))
    n->kind = path->regime.loaded ? exact_in_both : exact_unloaded;
  aim_u(n, &path->point, s);
  aim_t(n, &path->point, s);
}

/* Whether the equations for b are stiff: b is quasi-steady, so that friction nearly balances
 * the force that drives it, or begins from zero while friction is strong. */
static bool cloth_is_stiff(const carom_trajectory *path, const step_start *s) {
  /* |b|' by friction alone; it must be able to stop b several times before the goal */
  const double friction = path->terms.H_y * s->w;
  if (!path->regime.loaded || friction * s->to_goal < STIFF * s->q)
    return false;
  if (s->q == 0)
    return fabs(s->db_x) + fabs(s->db_y) < SLOW * friction || path->regime.held;
  /* b hardly turns, and its size changes slowly, against friction alone */
  const double along = s->t_x * s->db_x + s->t_y * s->db_y,
               across = s->t_x * s->db_y - s->t_y * s->db_x;
  return fabs(across) < ALIGNED * friction && fabs(along) < SLOW * friction;
}

/* The step for a stiff b: exact, over an even map, with a constant first direction of b. */
static void plan_stiff_cloth(const carom_trajectory *path, const step_start *s, plan *n) {
  const double along = s->t_x * s->db_x + s->t_y * s->db_y;
  double length = s->to_goal;
  n->s.goal = s->goal;
  /* up to where b becomes zero, if a straight line takes it there; the iteration finds the
   * length */
  if (s->q > 0 && along < 0 && length > -0.95 * s->q / along) {
    length = -0.95 * s->q / along;
    n->s.goal = AT_CLOTH_STICK;
  }
  /* a is not stiff, and must not vanish within the step */
  if (driving_slips(path) && s->r > 0)
    limit(&length, &n->s.goal, CAREFUL_SHARE * s->r / (fabs(s->da_x) + fabs(s->da_y) + DBL_MIN));
  even_map(&n->s, length);
  n->kind = driving_slips(path) ? exact_in_both : held_exact;
  aim_u(n, &path->point, s);
  aim(&n->s, 0, 0, 0, 0, s->t_x, s->t_y, n->s.t_x, n->s.t_y);
}

/* The step while friction holds the driving contact: a sinh map if b passes near zero, else an
 * even one. */
static void plan_held(const carom_trajectory *path, const step_start *s, plan *n) {
  const passage g = passage_of_b(&path->point, &path->terms, s, s->to_goal);
  n->kind = held_straight;
  n->s.goal = s->goal;
  if (!g.matters)
    even_map(&n->s, s->to_goal);
  else if (!sinh_map(&n->s, &g, s->to_goal))
    n->s.goal = AT_LENGTH;
  aim_t(n, &path->point, s);
}

/* The step for a stiff a, which is quasi-steady or begins from zero: exact, over an even map,
 * with a constant first direction.
 */
static void plan_stiff(const carom_trajectory *path, const step_start *s, const closed_form *c,
                       plan *n) {
  const double along = s->u_x * s->da_x + s->u_y * s->da_y;
  double length = s->to_goal;
  n->s.goal = s->goal;
  /* a short step while the direction still settles */
  if (fabs(c->sine) * s->r > NEGLIGIBLE)
    limit(&length, &n->s.goal, SETTLING * s->r / c->D);
  /* up to where a becomes zero, if a straight line takes it there; the iteration finds the
   * length */
  if (s->r > 0 && along < 0 && length > -0.97 * s->r / along) {
    length = -0.95 * s->r / along;
    n->s.goal = AT_STICK;
  }
  /* an even map resolves no b that passes near zero: stop before */
  if (path->regime.loaded && passage_of_b(&path->point, &path->terms, s, length).matters)
    limit(&length, &n->s.goal, CAREFUL_SHARE * s->q / (fabs(s->db_x) + fabs(s->db_y)));
  even_map(&n->s, length);
  n->kind = path->regime.loaded ? exact_in_a : exact_unloaded;
  aim(&n->s, 0, 0, 0, 0, s->u_x, s->u_y, n->s.u_x, n->s.u_y);
  aim_t(n, &path->point, s);
}

/* The step while a slides: a stretched map, or a sinh map if b passes near zero; but that of
 * plan_stiff() for a stiff a. */
static void plan_sliding(const carom_trajectory *path, const step_start *s, plan *n) {
  /* stiff: u points along the drive D, and friction could stop a several times before the goal */
  const closed_form c = closed_form_of(&path->terms, s);
  if (s->r == 0 || (c.cosine > 0.9 && fabs(c.sine) < ALIGNED && s->to_goal * c.D > STIFF * s->r)) {
    plan_stiff(path, s, &c, n);
    return;
  }
  n->kind = path->regime.loaded ? sliding : sliding_unloaded;
  n->s.goal = s->goal;
  const double along = s->u_x * s->da_x + s->u_y * s->da_y;
  passage g = {.matters = false};
  if (path->regime.loaded)
    g = passage_of_b(&path->point, &path->terms, s, s->to_goal);
  if (g.matters) {
    /* a changes little in the step: its E belongs to |a| along a straight line */
    double length = s->to_goal;
    limit(&length, &n->s.goal, 0.7 * s->r / (fabs(s->da_x) + fabs(s->da_y)));
    if (!sinh_map(&n->s, &g, length))
      n->s.goal = AT_LENGTH;
    aim_u(n, &path->point, s);
    EACH n->s.E[i] = exponential(-c.m * n->s.p[i] / (s->r + 0.5 * along * n->s.p[i]));
  } else {
    /* tau to the goal, or the largest that is allowed; two equal steps rather than a long and a
     * short one */
    const double ln = s->r < 1 ? rough_log(1 / s->r) : 0, growth = along * s->to_goal / s->r;
    const double fall = most_of(most_of(-along, c.m - 0.5 * c.D), 1e-12);
    const double share = path->variation != NULL ? SHARE : 1;
    const double most =
        share * least((MOST_TURN + BOLDER * ln) / c.D, (MOST_FALL + BOLDER * ln) / fall);
    double tau =
        tau_at(&c, s->to_goal,
               growth > -0.9 ? s->to_goal / s->r * (6 + growth) / (6 + 4 * growth) : most, most);
    if (tau > 1.1 * most) {
      n->s.goal = AT_LENGTH;
      tau = tau < 2 * most ? 0.5 * tau : most;
    }
    stretched_map(&n->s, &c, s, tau);
  }
  aim_t(n, &path->point, s);
}

/* Sets to zero a slip that has become negligible, and the motion along x of an impact that has
 * become planar. Returns whether the regime has ended. before: where the step began. */
static bool snap_to_zero(carom_trajectory *path, const carom_point *previous) {
  carom_point *point = &path->point;
  if (fabs(point->a_x) <= path->no_slip && fabs(point->b_x) <= path->no_slip) {
    if (path->law.H < 0)
      path->across += fabs(point->a_x) + fabs(point->b_x);
    point->a_x = point->b_x = 0;
  }
  const double a = fabs(point->a_x) + fabs(point->a_y), b = fabs(point->b_x) + fabs(point->b_y);
  const bool a_ends =
      driving_slips(path) && a <= path->no_slip && a < fabs(previous->a_x) + fabs(previous->a_y);
  const bool b_ends =
      path->regime.loaded && b <= path->no_slip && b < fabs(previous->b_x) + fabs(previous->b_y);
  if (a_ends)
    point->a_x = point->a_y = 0;
  if (b_ends)
    point->b_x = point->b_y = 0;
  return a_ends || b_ends;
}

/* Where friction drives the slip on the cloth, it also drives an error e of planar motion that
 * lies across b. With |b|' = r and h = -H w, e' = h e/|b|, so that e follows |b|^(h/r). Where b
 * passes zero, e is the rest of |b|: then |b|^(h/r) e is |b| itself. The error of the
 * friction's impulse is the change of e over |H|. */
static void drive_error(carom_trajectory *path, const step_start *s, const carom_point *start) {
  const double e = path->across, begin = most_of(fabs(start->b_y), e), end = fabs(path->point.b_y);
  const double h = -path->terms.H_x * s->w,
               r = (end - fabs(start->b_y)) / (path->point.p - start->p);
  if (!(e > 0 && h > 0 && path->regime.loaded))
    return;
  if (end > e) /* rates of nearly zero leave |b| as it is, and e grows exponentially */
    path->across =
        e * carom_exp(fabs(r) > 1e-3 * h ? h / r * (rough_log(end) - rough_log(begin))
                                         : h * (path->point.p - start->p) / least(begin, end));
  if (r < 0 && begin > e && !(path->across < end)) {
    const double power = -h / r;
    path->across = carom_exp((rough_log(e) + power * rough_log(begin)) / (1 + power));
  }
}

/* Whether friction would drive a rounding error of b's direction, where the impact begins with a
 * small b that is not planar. */
static bool driven_at_start(const carom_trajectory *path) {
  if (!(path->law.H < 0) || !path->regime.loaded || (path->point.a_x == 0 && path->point.b_x == 0))
    return false;
  step_start s;
  start_at(path, INFINITY, &s);
  /* |b|' = h + d, if the force on b beside friction is along b */
  const double h = -path->terms.H_x * s.w, d_x = s.db_x - h * s.t_x, d_y = s.db_y - h * s.t_y;
  const double d = sqrt(d_x * d_x + d_y * d_y);
  return s.q > 0 && s.q < 1 && DBL_EPSILON * carom_exp(-h / (h + d) * rough_log(s.q)) > MOST_ACROSS;
}

/* On along a straight line, where all rates are constant: to the goal, or to where a slip is
 * zero. Returns whether that is the goal. In planar motion only the y components change. */
static bool go_straight(carom_trajectory *path, const step_start *s) {
  carom_point *point = &path->point;
  const carom_point start = *point;
  const double to_a =
      driving_slips(path) && point->a_y * s->da_y < 0 ? -point->a_y / s->da_y : INFINITY;
  const double to_b =
      path->regime.loaded && point->b_y * s->db_y < 0 ? -point->b_y / s->db_y : INFINITY;
  const double length = least(s->to_goal, least(to_a, to_b));
  /* W before v, since it is the integral of the old v */
  point->W += length * (point->v + 0.5 * s->dv * length);
  point->v += s->dv * length;
  point->p += length;
  point->a_y = length == to_a ? 0 : point->a_y + s->da_y * length;
  point->b_y = length == to_b ? 0 : point->b_y + s->db_y * length;
  path->iterations++;
  drive_error(path, s, &start);
  return length == s->to_goal;
}

static void end_phase(carom_trajectory *path) {
  if (path->restitution)
    path->ended = true;
  else {
    path->restitution = true;
    path->point.v = 0;
    path->W_c = path->point.W;
    path->point.W = 0;
    path->ended = path->law.e == 0;
  }
}

/* Plans a step and takes it, or draws the consequences of its refusal. Returns false if there is
 * no way on. */
static bool next_step(carom_trajectory *path, double target) {
  /* planar motion, and motion without any friction that changes, is a straight line */
  step_start s;
  start_at(path, target, &s);
  const carom_point start = path->point;
  const bool planar = start.a_x == 0 && start.b_x == 0 && s.u_x == 0 && s.t_x == 0;
  if (planar || (!driving_slips(path) && !path->regime.loaded)) {
    const bool reached =
        go_straight(path, &s) && (s.goal == AT_END_OF_APPROACH || s.goal == AT_WORK);
    if (path->variation != NULL)
      carom_variation_straight(path, &start, planar);
    if (reached)
      end_phase(path);

    /* a slip that has come to nothing is zero from here on */
    const bool goes_on = !snap_to_zero(path, &start) || carom_impact_regime(path, false);
    if (path->variation != NULL)
      carom_variation_follow(path, &start, reached);
    return goes_on;
  }

  /* what every plan needs, and the plan: the first that applies */
  plan n;
  n.s.target = s.target;
  n.s.restitution = path->restitution;
  n.s.least_work = work_end(path);
  n.s.tolerance = path->tolerance;
  n.s.record = path->variation != NULL ? &path->variation->record : NULL;
  if (path->careful)
    plan_carefully(path, &s, &n);
  else if (cloth_is_stiff(path, &s))
    plan_stiff_cloth(path, &s, &n);
  else if (driving_slips(path))
    plan_sliding(path, &s, &n);
  else
    plan_held(path, &s, &n);

  /* the step. Behind it a regime may begin, a phase may end, or a slip may be negligible */
  double advice = 1;
  const enum outcome r = n.kind(&path->terms, &n.s, &path->point, &path->iterations, &advice);
  if (r == TAKEN && path->variation != NULL) {
    /* derivatives may need a shorter step */
    const double length = path->point.p - start.p;
    int vanishes = -1;
    if (n.s.goal == AT_STICK)
      vanishes = (int)OF_A_X;
    else if (n.s.goal == AT_CLOTH_STICK)
      vanishes = (int)OF_B_X;
    const bool stiff = n.kind == exact_in_a || n.kind == exact_unloaded ||
                       n.kind == exact_in_both || n.kind == held_exact;
    advice = variation_step(path, &start, driving_slips(path), stiff, vanishes);
    if (advice > 1) {
      /* the planner keeps a length that it is given to a few percent only */
      path->point = start;
      path->longest =
          length * most_of(0.2, least(0.7, 0.9 / sqrt(sqrt(sqrt(sqrt(least(advice, 1e12)))))));
      return true;
    }
  }

  /* taken: the next regime or phase, if one begins at the end of the step */
  if (r == TAKEN) {
    path->longest = INFINITY;
    path->refusals = 0;
    const bool reached = n.s.goal == AT_END_OF_APPROACH || n.s.goal == AT_WORK;
    bool goes_on;
    if (n.s.goal == AT_STICK || n.s.goal == AT_CLOTH_STICK || n.s.goal == AT_EVENT) {
      goes_on = carom_impact_regime(path, n.s.goal == AT_EVENT);
    } else {
      if (reached)
        end_phase(path);
      goes_on = !snap_to_zero(path, &start) || carom_impact_regime(path, false);
    }
    if (path->variation != NULL)
      carom_variation_follow(path, &start, reached);
    return goes_on;
  }

  /* refused: up to the event; or a shorter step, by the error estimate */
  if (r == EVENT_WITHIN) {
    path->event_at = path->point.p + advice;
    if (advice < IMMEDIATE * s.to_goal)
      return carom_impact_regime(path, true);
  } else /* the error is of order 16 in the length */
    path->longest = n.s.length * (r == INACCURATE && advice < 1e12
                                      ? most_of(0.3, 0.9 / sqrt(sqrt(sqrt(sqrt(advice)))))
                                      : 0.5);

  /* after too many refusals, careful steps; after too many of those, no way on */
  path->refusals++;
  path->sticks_missed += r == DIVERGED && n.s.goal == AT_STICK;
  if ((path->refusals == MOST_REFUSALS || path->sticks_missed == MOST_MISSED) && !path->careful) {
    path->careful = true;
    path->refusals = 0;
    path->longest = INFINITY;
  }
  return path->refusals < MOST_CAREFUL_REFUSALS;
}

carom_status CAROM_IMPACT_ADVANCE(carom_trajectory *path, double target, int most) {
  if (path->point.p == 0 && driven_at_start(path))
    return CAROM_ERROR_UNRESOLVED;
  while (!path->ended && path->point.p < target) {
    if (path->iterations >= most || !next_step(path, target) ||
        !(path->point.growth <= MOST_GROWTH) || !(path->across <= MOST_ACROSS) ||
        (path->restitution && path->point.v > AGAIN))
      return CAROM_ERROR_UNRESOLVED;
    /* the first stick; a regime in which both contacts hold ends the impact */
    if (path->regime.held && isnan(path->p_stick))
      path->p_stick = path->point.p;
    if ((path->regime.held && path->regime.cloth_held) || carom_impact_jams(path))
      path->ended = true;
  }
  return CAROM_OK;
}
