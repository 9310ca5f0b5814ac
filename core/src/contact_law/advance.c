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
 * SAFETY. A step that is rejected is tried again with a shorter length. After MOST_REFUSALS in a
 * row the rest of the impact is computed in careful steps: exact ones over even maps, each only a
 * fraction of the way to where a slip could vanish. The caller bounds the number of iterations of
 * all steps together. */
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
static const double SLOW = 0.5;          /* rate of a slip over the rate by friction only, below
                                            which it is quasi-steady */
static const double CAREFUL_SHARE = 0.6; /* of the way to a slip of zero, for a careful step */
static const double IMMEDIATE = 1e-9;    /* fraction of a step at which an event happens where the
                                            step begins */
static const double MOST_GROWTH = 6.9;   /* carom_point.growth: log of 1000 */
static const double MOST_ACROSS = 1e-6;  /* carom_trajectory.across */
static const double AGAIN = 1e-6;        /* v in restitution of a ball that approaches again: a
                                            second compression */

/* A step to stick begins with this fraction of the way to a slip of zero along a straight line, if
 * the goal of the phase is not nearer than about that. */
static const double STICK_SHARE = 0.95, STICK_NEAR = 0.97;
/* cos(psi) of a slip that points along the drive. */
static const double ALONG_DRIVE = 0.9;
/* The fraction of the way to a slip of zero at a that a step may go while b passes zero. */
static const double PASSING_SHARE = 0.7;
/* The least rate at which r falls, by which the largest tau is divided. */
static const double LEAST_FALL = 1e-12;
/* The growth of r to the goal, over r, below which it would be nearly 0: there is no guess of tau.
 * */
static const double LEAST_GROWTH = -0.9;
/* A tau that is this much larger than the largest is taken in two steps. */
static const double TOO_LONG = 1.1;
/* The rate of |b| over h below which |b| is constant. */
static const double STEADY = 1e-3;
/* A rejected step is tried with SAFETY times the length that its error allows, within these
 * fractions of its length; or with half of it if there is no estimate, or a meaningless one. */
static const double SAFETY = 0.9, LEAST_SHARE = 0.3, HALF = 0.5, MOST_ESTIMATE = 1e12;
/* The same of one that derivatives reject. */
static const double LEAST_VARIED = 0.2, MOST_VARIED = 0.7;
enum {
  MOST_REFUSALS = 6,         /* in a row, before steps become careful; */
  MOST_MISSED = 3,           /* steps to stick that diverged, as a only passes near zero, before
                                the same; */
  MOST_CAREFUL_REFUSALS = 30 /* and before careful ones give up */
};

/* The kinds of steps, compiled one by one so that each leaves out the terms of the others. */
typedef enum outcome step_kind(const carom_terms *, const planned_step *, carom_point *, int *,
                               double *);
#define KIND(name, driving_slips, loaded, exact)                                                   \
  static __attribute__((noinline)) enum outcome name(const carom_terms *terms,                     \
                                                     const planned_step *step, carom_point *point, \
                                                     int *iterations, double *advice) {            \
    return collocate(terms, step, driving_slips, loaded, exact, point, iterations, advice);        \
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
  planned_step step;
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
static void start_at(const carom_trajectory *path, double target, step_start *origin) {
  const carom_point *point = &path->point;
  const carom_terms *terms = &path->terms;
  /* the slips: magnitudes, and directions or, for a slip that begins, the regime's */
  origin->size_a = sqrt(point->a_x * point->a_x + point->a_y * point->a_y);
  origin->size_b = sqrt(point->b_x * point->b_x + point->b_y * point->b_y);
  const double per_a = 1 / origin->size_a, per_b = 1 / origin->size_b;
  origin->u_x = origin->size_a > 0 ? point->a_x * per_a : path->regime.u_x;
  origin->u_y = origin->size_a > 0 ? point->a_y * per_a : path->regime.u_y;
  origin->t_x = origin->size_b > 0 ? point->b_x * per_b : path->regime.t_x;
  origin->t_y = origin->size_b > 0 ? point->b_y * per_b : path->regime.t_y;

  /* the rates */
  origin->w = (terms->w_0 + terms->w_u * origin->u_y) / (1 - terms->w_t * origin->t_y);
  const double x = origin->w * origin->t_x, y = origin->w * origin->t_y;
  origin->da_x = terms->S_x * origin->u_x - terms->C_x * x;
  origin->da_y = terms->A_0 + terms->S_y * origin->u_y - terms->C_y * y;
  origin->db_x = terms->R_x * origin->u_x - terms->H_x * x;
  origin->db_y = terms->B_0 + terms->R_y * origin->u_y - terms->H_y * y;
  origin->dv = terms->V_0 + terms->V_u * origin->u_y - terms->V_w * y;

  /* the mean of b' if b passes zero, where the cloth's own friction changes its sign */
  origin->line_x = origin->db_x + 0.5 * terms->H_x * x;
  origin->line_y = origin->db_y + 0.5 * terms->H_y * y;

  /* the end of the phase if v' were constant; or an earlier end. Friction of a steep nose
   * may push the ball on, v' > 0, until slip has changed: then no end is in sight, and a step
   * may go as far as slip lasts */
  if (path->restitution) {
    /* p where W = target, by the quadratic equation for a constant v' */
    origin->goal = AT_WORK;
    origin->target = work_end(path);
    const double missing = origin->target - point->W,
                 square = point->v * point->v + 2 * origin->dv * missing;
    origin->to_goal = square > 0 || origin->dv < 0
                          ? 2 * missing / (point->v - sqrt(most_of(square, 0)))
                          : INFINITY;
  } else {
    origin->goal = AT_END_OF_APPROACH;
    origin->target = 0;
    origin->to_goal = origin->dv < 0 ? -point->v / origin->dv : INFINITY;
  }

  /* no end in sight: as far as the larger of the slips lasts, but no more than 1 */
  if (origin->to_goal == INFINITY) {
    origin->goal = AT_LENGTH;
    origin->to_goal = most_of(origin->size_a / (fabs(origin->da_x) + fabs(origin->da_y)),
                              origin->size_b / (fabs(origin->db_x) + fabs(origin->db_y)));
    if (!(origin->to_goal > 0 && origin->to_goal < 1))
      origin->to_goal = 1;
  }

  /* an earlier end: p requested, the event of the regime, the length left by a refusal */
  if (target - point->p < origin->to_goal) {
    origin->goal = AT_P;
    origin->target = origin->to_goal = target - point->p;
  }
  if (path->event_at - point->p < (origin->goal == AT_P ? origin->to_goal : DBL_MAX)) {
    origin->goal = AT_EVENT;
    origin->to_goal = most_of(path->event_at - point->p, DBL_MIN);
  }
  if (path->longest < origin->to_goal) {
    origin->goal = AT_LENGTH;
    origin->to_goal = path->longest;
  }
}

/* Directions to begin with: both slips along straight lines. */
static void aim_u(plan *next, const carom_point *point, const step_start *origin) {
  aim(&next->step, point->a_x, point->a_y, origin->da_x, origin->da_y, origin->u_x, origin->u_y,
      next->step.u_x, next->step.u_y);
}

static void aim_t(plan *next, const carom_point *point, const step_start *origin) {
  aim(&next->step, point->b_x, point->b_y, origin->line_x, origin->line_y, origin->t_x, origin->t_y,
      next->step.t_x, next->step.t_y);
}

/* Limits the length, which then is the end of the step. */
static void limit(double *length, enum goal *goal, double most) {
  if (*length > most) {
    *length = most;
    *goal = AT_LENGTH;
  }
}

/* A careful step: exact, over an even map, at most a fraction of the way to where a slip could
 * vanish. */
static void plan_carefully(const carom_trajectory *path, const step_start *origin, plan *next) {
  double length = origin->to_goal;
  next->step.goal = origin->goal;
  /* |a| and |b| over their rates: sums of components are upper bounds */
  if (driving_slips(path) && origin->size_a > 0)
    limit(&length, &next->step.goal,
          CAREFUL_SHARE * origin->size_a / (fabs(origin->da_x) + fabs(origin->da_y) + DBL_MIN));
  if (path->regime.loaded && origin->size_b > 0)
    limit(&length, &next->step.goal,
          CAREFUL_SHARE * origin->size_b / (fabs(origin->db_x) + fabs(origin->db_y) + DBL_MIN));
  even_map(&next->step, length);
  next->kind = held_exact;
  if (driving_slips(path))
    next->kind = path->regime.loaded ? exact_in_both : exact_unloaded;
  aim_u(next, &path->point, origin);
  aim_t(next, &path->point, origin);
}

/* Whether the equations for b are stiff: b is quasi-steady, so that friction nearly balances
 * the force that drives it, or begins from zero while friction is strong. */
static bool cloth_is_stiff(const carom_trajectory *path, const step_start *origin) {
  /* |b|' by friction only; it must be able to stop b several times before the goal */
  const double friction = path->terms.H_y * origin->w;
  if (!path->regime.loaded || friction * origin->to_goal < STIFF * origin->size_b)
    return false;
  if (origin->size_b == 0)
    return fabs(origin->db_x) + fabs(origin->db_y) < SLOW * friction || path->regime.held;
  /* b hardly turns, and its magnitude changes slowly, compared with friction */
  const double along = origin->t_x * origin->db_x + origin->t_y * origin->db_y,
               across = origin->t_x * origin->db_y - origin->t_y * origin->db_x;
  return fabs(across) < ALIGNED * friction && fabs(along) < SLOW * friction;
}

/* The step for a stiff b: exact, over an even map, with a constant first direction of b. */
static void plan_stiff_cloth(const carom_trajectory *path, const step_start *origin, plan *next) {
  const double along = origin->t_x * origin->db_x + origin->t_y * origin->db_y;
  double length = origin->to_goal;
  next->step.goal = origin->goal;
  /* up to where b becomes zero, if a straight line takes it there; the iteration finds the
   * length */
  if (origin->size_b > 0 && along < 0 && length > -STICK_SHARE * origin->size_b / along) {
    length = -STICK_SHARE * origin->size_b / along;
    next->step.goal = AT_CLOTH_STICK;
  }
  /* a is not stiff, and must not vanish within the step */
  if (driving_slips(path) && origin->size_a > 0)
    limit(&length, &next->step.goal,
          CAREFUL_SHARE * origin->size_a / (fabs(origin->da_x) + fabs(origin->da_y) + DBL_MIN));
  even_map(&next->step, length);
  next->kind = driving_slips(path) ? exact_in_both : held_exact;
  aim_u(next, &path->point, origin);
  aim(&next->step, 0, 0, 0, 0, origin->t_x, origin->t_y, next->step.t_x, next->step.t_y);
}

/* The step while friction holds the driving contact: a sinh map if b passes near zero, else an
 * even one. */
static void plan_held(const carom_trajectory *path, const step_start *origin, plan *next) {
  const passage passing = passage_of_b(&path->point, &path->terms, origin, origin->to_goal);
  next->kind = held_straight;
  next->step.goal = origin->goal;
  if (!passing.matters)
    even_map(&next->step, origin->to_goal);
  else if (!sinh_map(&next->step, &passing, origin->to_goal))
    next->step.goal = AT_LENGTH;
  aim_t(next, &path->point, origin);
}

/* The step for a stiff a, which is quasi-steady or begins from zero: exact, over an even map,
 * with a constant first direction.
 */
static void plan_stiff(const carom_trajectory *path, const step_start *origin,
                       const closed_form *form, plan *next) {
  const double along = origin->u_x * origin->da_x + origin->u_y * origin->da_y;
  double length = origin->to_goal;
  next->step.goal = origin->goal;
  /* a short step while the direction still settles */
  if (fabs(form->sine) * origin->size_a > NEGLIGIBLE)
    limit(&length, &next->step.goal, SETTLING * origin->size_a / form->D);
  /* up to where a becomes zero, if a straight line takes it there; the iteration finds the
   * length */
  if (origin->size_a > 0 && along < 0 && length > -STICK_NEAR * origin->size_a / along) {
    length = -STICK_SHARE * origin->size_a / along;
    next->step.goal = AT_STICK;
  }
  /* an even map resolves no b that passes near zero: stop before */
  if (path->regime.loaded && passage_of_b(&path->point, &path->terms, origin, length).matters)
    limit(&length, &next->step.goal,
          CAREFUL_SHARE * origin->size_b / (fabs(origin->db_x) + fabs(origin->db_y)));
  even_map(&next->step, length);
  next->kind = path->regime.loaded ? exact_in_a : exact_unloaded;
  aim(&next->step, 0, 0, 0, 0, origin->u_x, origin->u_y, next->step.u_x, next->step.u_y);
  aim_t(next, &path->point, origin);
}

/* The step while a slides: a stretched map, or a sinh map if b passes near zero; but the step of
 * plan_stiff() for a stiff a. */
static void plan_sliding(const carom_trajectory *path, const step_start *origin, plan *next) {
  /* stiff: u points along the drive D, and friction could stop a several times before the goal */
  const closed_form form = closed_form_of(&path->terms, origin);
  if (origin->size_a == 0 || (form.cosine > ALONG_DRIVE && fabs(form.sine) < ALIGNED &&
                              origin->to_goal * form.D > STIFF * origin->size_a)) {
    plan_stiff(path, origin, &form, next);
    return;
  }
  next->kind = path->regime.loaded ? sliding : sliding_unloaded;
  next->step.goal = origin->goal;
  const double along = origin->u_x * origin->da_x + origin->u_y * origin->da_y;
  passage passing = {.matters = false};
  if (path->regime.loaded)
    passing = passage_of_b(&path->point, &path->terms, origin, origin->to_goal);
  if (passing.matters) {
    /* a changes little in the step: its E belongs to |a| along a straight line */
    double length = origin->to_goal;
    limit(&length, &next->step.goal,
          PASSING_SHARE * origin->size_a / (fabs(origin->da_x) + fabs(origin->da_y)));
    if (!sinh_map(&next->step, &passing, length))
      next->step.goal = AT_LENGTH;
    aim_u(next, &path->point, origin);
    EACH next->step.E[i] =
        exponential(-form.m * next->step.p[i] / (origin->size_a + 0.5 * along * next->step.p[i]));
  } else {
    /* tau to the goal, or the largest that is allowed; two equal steps rather than a long and a
     * short one */
    const double ln = origin->size_a < 1 ? rough_log(1 / origin->size_a) : 0,
                 growth = along * origin->to_goal / origin->size_a;
    const double fall = most_of(most_of(-along, form.m - 0.5 * form.D), LEAST_FALL);
    const double share = path->variation != NULL ? SHARE : 1;
    const double most =
        share * least((MOST_TURN + BOLDER * ln) / form.D, (MOST_FALL + BOLDER * ln) / fall);
    double tau = tau_at(&form, origin->to_goal,
                        growth > LEAST_GROWTH
                            ? origin->to_goal / origin->size_a * (6 + growth) / (6 + 4 * growth)
                            : most,
                        most);
    if (tau > TOO_LONG * most) {
      next->step.goal = AT_LENGTH;
      tau = tau < 2 * most ? 0.5 * tau : most;
    }
    stretched_map(&next->step, &form, origin, tau);
  }
  aim_t(next, &path->point, origin);
}

/* Sets to zero a slip that has become negligible, and the motion along x of an impact that has
 * become planar. Returns whether the regime has ended. previous: where the step began. */
static bool snap_to_zero(carom_trajectory *path, const carom_point *previous) {
  carom_point *point = &path->point;
  if (fabs(point->a_x) <= path->no_slip && fabs(point->b_x) <= path->no_slip) {
    if (path->law.H < 0)
      path->across += fabs(point->a_x) + fabs(point->b_x);
    point->a_x = point->b_x = 0;
  }
  const double slip_a = fabs(point->a_x) + fabs(point->a_y),
               slip_b = fabs(point->b_x) + fabs(point->b_y);
  const bool a_ends = driving_slips(path) && slip_a <= path->no_slip &&
                      slip_a < fabs(previous->a_x) + fabs(previous->a_y);
  const bool b_ends = path->regime.loaded && slip_b <= path->no_slip &&
                      slip_b < fabs(previous->b_x) + fabs(previous->b_y);
  if (a_ends)
    point->a_x = point->a_y = 0;
  if (b_ends)
    point->b_x = point->b_y = 0;
  return a_ends || b_ends;
}

/* Where friction drives the slip on the cloth, it also drives an error e of planar motion across b.
 * With |b|' = r, which is `rate`, and h = -H w, e' = h e/|b|, so that e follows |b|^(h/r). Where b
 * passes zero, e is the rest of |b|: then |b|^(h/r) e is |b| itself. The error of the friction's
 * impulse is the change of e over |H|. */
static void drive_error(carom_trajectory *path, const step_start *origin,
                        const carom_point *start) {
  const double across = path->across, begin = most_of(fabs(start->b_y), across),
               end = fabs(path->point.b_y);
  const double h = -path->terms.H_x * origin->w,
               rate = (end - fabs(start->b_y)) / (path->point.p - start->p);
  if (!(across > 0 && h > 0 && path->regime.loaded))
    return;
  if (end > across) /* rates of nearly zero leave |b| as it is, and e grows exponentially */
    path->across = across * carom_exp(fabs(rate) > STEADY * h
                                          ? h / rate * (rough_log(end) - rough_log(begin))
                                          : h * (path->point.p - start->p) / least(begin, end));
  if (rate < 0 && begin > across && !(path->across < end)) {
    const double power = -h / rate;
    path->across = carom_exp((rough_log(across) + power * rough_log(begin)) / (1 + power));
  }
}

/* Whether friction would drive a rounding error of b's direction, where the impact begins with a
 * small b that is not planar. */
static bool driven_at_start(const carom_trajectory *path) {
  if (!(path->law.H < 0) || !path->regime.loaded || (path->point.a_x == 0 && path->point.b_x == 0))
    return false;
  step_start origin;
  start_at(path, INFINITY, &origin);
  /* |b|' = h + d, if the force on b other than friction is along b */
  const double h = -path->terms.H_x * origin.w, d_x = origin.db_x - h * origin.t_x,
               d_y = origin.db_y - h * origin.t_y;
  const double d = sqrt(d_x * d_x + d_y * d_y);
  return origin.size_b > 0 && origin.size_b < 1 &&
         DBL_EPSILON * carom_exp(-h / (h + d) * rough_log(origin.size_b)) > MOST_ACROSS;
}

/* On along a straight line, where all rates are constant: to the goal, or to where a slip is
 * zero. Returns whether that is the goal. In planar motion only the y components change. */
static bool go_straight(carom_trajectory *path, const step_start *origin) {
  carom_point *point = &path->point;
  const carom_point start = *point;
  const double to_a =
      driving_slips(path) && point->a_y * origin->da_y < 0 ? -point->a_y / origin->da_y : INFINITY;
  const double to_b =
      path->regime.loaded && point->b_y * origin->db_y < 0 ? -point->b_y / origin->db_y : INFINITY;
  const double length = least(origin->to_goal, least(to_a, to_b));
  /* W before v, since it is the integral of the old v */
  point->W += length * (point->v + 0.5 * origin->dv * length);
  point->v += origin->dv * length;
  point->p += length;
  point->a_y = length == to_a ? 0 : point->a_y + origin->da_y * length;
  point->b_y = length == to_b ? 0 : point->b_y + origin->db_y * length;
  path->iterations++;
  drive_error(path, origin, &start);
  return length == origin->to_goal;
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
  step_start origin;
  start_at(path, target, &origin);
  const carom_point start = path->point;
  const bool planar = start.a_x == 0 && start.b_x == 0 && origin.u_x == 0 && origin.t_x == 0;
  if (planar || (!driving_slips(path) && !path->regime.loaded)) {
    const bool reached =
        go_straight(path, &origin) && (origin.goal == AT_END_OF_APPROACH || origin.goal == AT_WORK);
    if (path->variation != NULL)
      carom_variation_straight(path, &start, planar);
    if (reached)
      end_phase(path);

    /* a slip that has vanished is zero from here on */
    const bool goes_on = !snap_to_zero(path, &start) || carom_impact_regime(path, false);
    if (path->variation != NULL)
      carom_variation_follow(path, &start, reached);
    return goes_on;
  }

  /* what every plan needs, and the plan: the first that applies */
  plan next;
  next.step.target = origin.target;
  next.step.restitution = path->restitution;
  next.step.least_work = work_end(path);
  next.step.tolerance = path->tolerance;
  next.step.record = path->variation != NULL ? &path->variation->record : NULL;
  if (path->careful)
    plan_carefully(path, &origin, &next);
  else if (cloth_is_stiff(path, &origin))
    plan_stiff_cloth(path, &origin, &next);
  else if (driving_slips(path))
    plan_sliding(path, &origin, &next);
  else
    plan_held(path, &origin, &next);

  /* the step. Behind it a regime may begin, a phase may end, or a slip may be negligible */
  double advice = 1;
  const enum outcome result =
      next.kind(&path->terms, &next.step, &path->point, &path->iterations, &advice);
  if (result == TAKEN && path->variation != NULL) {
    /* derivatives may need a shorter step */
    const double length = path->point.p - start.p;
    int vanishes = -1;
    if (next.step.goal == AT_STICK)
      vanishes = (int)OF_A_X;
    else if (next.step.goal == AT_CLOTH_STICK)
      vanishes = (int)OF_B_X;
    const bool stiff = next.kind == exact_in_a || next.kind == exact_unloaded ||
                       next.kind == exact_in_both || next.kind == held_exact;
    advice = variation_step(path, &start, driving_slips(path), stiff, vanishes);
    if (advice > 1) {
      /* the planner keeps a length that it is given to a few percent only */
      path->point = start;
      path->longest =
          length * most_of(LEAST_VARIED,
                           least(MOST_VARIED,
                                 SAFETY / sqrt(sqrt(sqrt(sqrt(least(advice, MOST_ESTIMATE)))))));
      return true;
    }
  }

  /* taken: the next regime or phase, if one begins at the end of the step */
  if (result == TAKEN) {
    path->longest = INFINITY;
    path->refusals = 0;
    const bool reached = next.step.goal == AT_END_OF_APPROACH || next.step.goal == AT_WORK;
    bool goes_on;
    if (next.step.goal == AT_STICK || next.step.goal == AT_CLOTH_STICK ||
        next.step.goal == AT_EVENT) {
      goes_on = carom_impact_regime(path, next.step.goal == AT_EVENT);
    } else {
      if (reached)
        end_phase(path);
      goes_on = !snap_to_zero(path, &start) || carom_impact_regime(path, false);
    }
    if (path->variation != NULL)
      carom_variation_follow(path, &start, reached);
    return goes_on;
  }

  /* rejected: up to the event; or a shorter step, by the error estimate */
  if (result == EVENT_WITHIN) {
    path->event_at = path->point.p + advice;
    if (advice < IMMEDIATE * origin.to_goal)
      return carom_impact_regime(path, true);
  } else /* the error is of order 16 in the length */
    path->longest =
        next.step.length * (result == INACCURATE && advice < MOST_ESTIMATE
                                ? most_of(LEAST_SHARE, SAFETY / sqrt(sqrt(sqrt(sqrt(advice)))))
                                : HALF);

  /* after too many refusals, careful steps; after too many of those, no way on */
  path->refusals++;
  path->sticks_missed += result == DIVERGED && next.step.goal == AT_STICK;
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
