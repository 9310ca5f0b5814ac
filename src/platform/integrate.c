/* integrate.c - adaptive steps of an ordinary differential equation y' = f(x, y), in double precision.
 *
 * METHOD. The explicit Runge-Kutta pair of Dormand and Prince, of order 8 with 12 stages. The error estimate is that of Hairer,
 * |h| E5^2 / sqrt(E5^2 + E3^2 / 100) from two embedded formulas of orders 5 and 3. A step whose estimate exceeds the tolerance
 * is repeated with the length h (tolerance / estimate)^(1/8) and a safety factor; the same formula proposes the next one. Where
 * the right-hand side is singular (a slip that vanishes) the system itself says how long a step may be.
 *
 * EVENTS. If the event function has become positive, its zero is located by trial steps of shorter length. Each goes to the
 * zero of the cubic Hermite interpolant of the event function on the bracket known so far, so two or three suffice, and the
 * point that is returned has the accuracy of a step; no dense output is needed. After PATIENCE trials every other one halves
 * the bracket: an event function may be the largest of several, and has corners then.
 *
 * The eighth root is three square roots: no function enters whose bits differ between systems.
 *
 * Source of the coefficients: E. Hairer, S. P. Norsett, G. Wanner, Solving Ordinary Differential Equations I, 2nd ed. (1993),
 * section II.10, DOP853. */
#include "platform/integrate.h"

#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <string.h>

enum { STAGES = 12, PAIRS = CAROM_ODE_MOST / 2 };
typedef double pair __attribute__((vector_size(16), may_alias)); /* two unknowns at once */

/* The table of the pair: nodes, stages, result, and the two formulas of the error estimate. */
static const double c[STAGES] = {0.0,
                                 0.05260015195876773,
                                 0.0789002279381516,
                                 0.1183503419072274,
                                 0.2816496580927726,
                                 0.3333333333333333,
                                 0.25,
                                 0.3076923076923077,
                                 0.6512820512820513,
                                 0.6,
                                 0.8571428571428571,
                                 1.0};
static const double a[STAGES][STAGES - 1] = {
    {0.0},
    {0.05260015195876773},
    {0.0197250569845379, 0.0591751709536137},
    {0.02958758547680685, 0.0, 0.08876275643042054},
    {0.2413651341592667, 0.0, -0.8845494793282861, 0.924834003261792},
    {0.037037037037037035, 0.0, 0.0, 0.17082860872947386, 0.12546768756682242},
    {0.037109375, 0.0, 0.0, 0.17025221101954405, 0.06021653898045596, -0.017578125},
    {0.03709200011850479, 0.0, 0.0, 0.17038392571223998, 0.10726203044637328, -0.015319437748624402, 0.008273789163814023},
    {0.6241109587160757, 0.0, 0.0, -3.3608926294469414, -0.868219346841726, 27.59209969944671, 20.154067550477894,
     -43.48988418106996},
    {0.47766253643826434, 0.0, 0.0, -2.4881146199716677, -0.590290826836843, 21.230051448181193, 15.279233632882423,
     -33.28821096898486, -0.020331201708508627},
    {-0.9371424300859873, 0.0, 0.0, 5.186372428844064, 1.0914373489967295, -8.149787010746927, -18.52006565999696,
     22.739487099350505, 2.4936055526796523, -3.0467644718982196},
    {2.273310147516538, 0.0, 0.0, -10.53449546673725, -2.0008720582248625, -17.9589318631188, 27.94888452941996,
     -2.8589982771350235, -8.87285693353063, 12.360567175794303, 0.6433927460157636},
};
static const double b[STAGES] = {0.054293734116568765,
                                 0.0,
                                 0.0,
                                 0.0,
                                 0.0,
                                 4.450312892752409,
                                 1.8915178993145003,
                                 -5.801203960010585,
                                 0.3111643669578199,
                                 -0.1521609496625161,
                                 0.20136540080403034,
                                 0.04471061572777259};
static const double e_5[STAGES] = {0.01312004499419488,
                                   0.0,
                                   0.0,
                                   0.0,
                                   0.0,
                                   -1.2251564463762044,
                                   -0.4957589496572502,
                                   1.6643771824549864,
                                   -0.35032884874997366,
                                   0.3341791187130175,
                                   0.08192320648511571,
                                   -0.022355307863886294};
static const double e_3[STAGES] = {-0.18980075407240762,
                                   0.0,
                                   0.0,
                                   0.0,
                                   0.0,
                                   4.450312892752409,
                                   1.8915178993145003,
                                   -5.801203960010585,
                                   -0.4226823213237919,
                                   -0.1521609496625161,
                                   0.20136540080403034,
                                   0.02265179219836082};

static const double SAFETY = 0.9;                               /* on the length that the estimate asks for */
static const double SHRINK = 0.2;                               /* shortest step after a rejected one, over that */
static const double GROW = 5;                                   /* longest step after an accepted one, over that */
static const double SHORTEST = 4 * DBL_EPSILON;                 /* step, over x, that is taken whatever the estimate */
static const double EVENT_WIDTH = 1e-12;                        /* of a step: how narrowly an event is located */
enum { MOST_TRIALS = 60, PATIENCE = 6, MOST_NEWTON_STEPS = 6 }; /* of one event; trials without a bisection */

/* The values of one step: the slopes of the stages, and y behind it. */
typedef struct trial {
  pair k[STAGES][PAIRS], y[PAIRS];
  double error; /* its estimate */
} trial;

/* A step of length h from *at. */
static void try_step(const carom_ode *ode, carom_ode_point *at, double h, trial *t) {
  const int pairs = (ode->size + 1) / 2;
  pair y[PAIRS];
  memcpy(y, at->y, sizeof y);
  memcpy(t->k[0], at->f, sizeof t->k[0]);
  /* the stages; from the fifth row on columns 1 and 2 of the table are empty */
  for (int s = 1; s < STAGES; s++) {
    for (int q = 0; q < pairs; q++) {
      pair sum = a[s][0] * t->k[0][q];
      for (int j = s < 5 ? 1 : 3; j < s; j++)
        sum += a[s][j] * t->k[j][q];
      t->y[q] = y[q] + h * sum;
    }
    ode->slope(ode->model, at->x + c[s] * h, (const double *)t->y, (double *)t->k[s]);
  }
  at->evaluations += STAGES - 1;
  /* the result and the two error formulas, whose columns 1 to 4 are empty */
  double error_5 = 0, error_3 = 0;
  for (int q = 0; q < pairs; q++) {
    pair sum = b[0] * t->k[0][q], sum_5 = e_5[0] * t->k[0][q], sum_3 = e_3[0] * t->k[0][q];
    for (int j = 5; j < STAGES; j++) {
      sum += b[j] * t->k[j][q];
      sum_5 += e_5[j] * t->k[j][q];
      sum_3 += e_3[j] * t->k[j][q];
    }
    t->y[q] = y[q] + h * sum;
    for (int i = 0; i < 2 && 2 * q + i < ode->size; i++) {
      error_5 += ode->weight[2 * q + i] * fabs(sum_5[i]);
      error_3 += ode->weight[2 * q + i] * fabs(sum_3[i]);
    }
  }
  const double both = sqrt(error_5 * error_5 + 0.01 * error_3 * error_3);
  t->error = both > 0 ? h * error_5 * (error_5 / both) : both;
}

/* What the error control makes of a step's length, as a factor; NaN counts as a large error. */
static double factor(double tolerance, double error) {
  const double share = SAFETY * sqrt(sqrt(sqrt(tolerance / error)));
  return share > GROW ? GROW : share > SHRINK ? share : SHRINK;
}

/* The end of a step: y behind it and f there. */
static void arrive(const carom_ode *ode, carom_ode_point *at, double x, const trial *t) {
  at->x = x;
  memcpy(at->y, t->y, sizeof at->y);
  carom_ode_set(ode, at);
}

double carom_ode_zero_between(const carom_ode_reading *low, const carom_ode_reading *high) {
  const double h = high->x - low->x, rise = high->g - low->g, r_0 = h * low->rate, r_1 = h * high->rate;
  const double c_2 = 3 * rise - 2 * r_0 - r_1, c_3 = r_0 + r_1 - 2 * rise;
  double t = -low->g / rise;
  for (int k = 0; k < MOST_NEWTON_STEPS; k++) {
    const double next = t - (low->g + t * (r_0 + t * (c_2 + t * c_3))) / (r_0 + t * (2 * c_2 + 3 * c_3 * t));
    if (!(next > 0 && next < 1)) /* the cubic is of no use here */
      return low->x + 0.5 * h;
    t = next;
  }
  return low->x + h * t;
}

static carom_ode_reading read_event(const carom_ode *ode, const carom_ode_point *at, double x) {
  carom_ode_reading r = {.x = x};
  r.g = ode->event(ode->model, at->x, at->y, at->f, &r.rate);
  return r;
}

void carom_ode_set(const carom_ode *ode, carom_ode_point *at) {
  ode->slope(ode->model, at->x, at->y, at->f);
  at->evaluations++;
}

int carom_ode_step(const carom_ode *ode, carom_ode_point *at, double x_end) {
  const carom_ode_point start = *at;
  const double left = x_end - at->x, least = fmin(SHORTEST * fabs(at->x) + DBL_MIN, left);
  double h = fmax(fmin(fmin(at->next, ode->longest(ode->model, at->x, at->y, at->f)), left), least);
  trial t;
  /* a step that the estimate accepts */
  while (try_step(ode, at, h, &t), !(t.error <= ode->tolerance) && h > least)
    h = fmax(h * fmin(factor(ode->tolerance, t.error), SAFETY), least);
  at->next = h * factor(ode->tolerance, t.error);
  carom_ode_reading low = read_event(ode, at, 0);
  arrive(ode, at, h < left ? start.x + h : x_end, &t);
  carom_ode_reading high = read_event(ode, at, h);
  if (!(high.g >= 0))
    return 0;
  /* an event inside it, behind `low` and not behind `high` */
  double nearest = high.g > 0 ? high.g : DBL_MIN;
  for (int k = 0; k < MOST_TRIALS && at->x != start.x && !(nearest <= ode->event_tolerance); k++) {
    const double last = at->x - start.x,
                 x = k >= PATIENCE && k % 2 == 0 ? 0.5 * (low.x + high.x) : carom_ode_zero_between(&low, &high);
    if (fabs(x - last) <= EVENT_WIDTH * h)
      break;
    const int evaluations = at->evaluations;
    const double next = at->next;
    *at = start;
    at->evaluations = evaluations;
    at->next = next;
    try_step(ode, at, x, &t);
    arrive(ode, at, start.x + x, &t);
    const carom_ode_reading here = read_event(ode, at, x);
    *(here.g >= 0 ? &high : &low) = here;
    nearest = fabs(here.g);
  }
  return 1;
}
