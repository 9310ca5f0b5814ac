/* The cushion of a table by three banks.
 *
 * A lone ball is played three times, and returns to its rail at y_i(e, mu), i = 1 to 3, with the
 * restitution e and the friction mu of the cushion. A player reads r_i there. The most probable
 * pair minimises
 *
 *     sum (r_i - y_i)^2 / s^2 + (e - e_0)^2 / s_e^2 + (mu - mu_0)^2 / s_mu^2
 *
 * by Gauss and Newton, with differences of complete shots. e_0 and mu_0 are the ball's. s_e and
 * s_mu are how much tables differ from them: public systems of players leave 0.74 to 0.89 and 0.18
 * to 0.42. s = 50 mm contains the error of a reading, 25 mm, most of which is the speed of the
 * stroke, and what the law of the cushion leaves out. The bands are the roots of the diagonal of
 * the inverse of the matrix. A hard bank determines e, because friction has little to do with it;
 * soft ones determine mu.
 *
 * The banks and s are those that help, or harm least, on drawn tables of three laws
 * (study/lab/cushions.py). With 25 mm, or with a soft bank through 3.5, numbers fitted to a table
 * of Han's cushion predict it less well than the usual numbers do. The three return away from
 * pockets, beyond the side pocket. */
#include "carom_shot.h"
#include "platform/arithmetic.h"
#include "platform/ranges.h"

#include <math.h>

static const carom_bank banks[CAROM_BANKS] = {{2.5, 1.3, 1.0}, {3.0, 1.3, 1.0}, {3.5, 5.0, 0.0}};

static const double sight = 0.094; /* m, behind the noses */
static const double start = 0.35;  /* m, from the rail to the ball at first */
static const double unsure_restitution = 0.05, unsure_friction = 0.06, unsure_reading = 0.05;
static const double reading_error = 0.025; /* m; the unit of the misfit */
static const double step = 1e-3;           /* of differences */

enum { EVENTS = 16, ROUNDS = 30 };

carom_status carom_bank_of(int bank, carom_bank *out) {
  if (out == NULL)
    return CAROM_ERROR_NULL;
  if (bank < 0 || bank >= CAROM_BANKS)
    return CAROM_ERROR_POSITION;
  *out = banks[bank];
  return CAROM_OK;
}

/* Where a ball with these two numbers returns to its rail, in m from the corner. */
static carom_status comes_back(const carom_table *table, const carom_ball_kind *kind,
                               const carom_bank *bank, double *place) {
  /* the line from behind the corner through the sight */
  const double across = table->width + 2.0 * sight, along = bank->aim * table->length / 8.0 + sight;
  const double length = sqrt(across * across + along * along), radius = kind->radius;
  const double v_x = bank->speed * across / length, v_y = bank->speed * along / length;
  const carom_shot_ball ball = {
      *kind,
      {.r = {start, (start + sight) * along / across - sight, radius},
       .v = {v_x, v_y, 0.0},
       .w = {-bank->roll * v_y / radius, bank->roll * v_x / radius, 0.0}}};

  /* the second cushion that it meets */
  carom_event events[EVENTS];
  carom_shot shot = {.events = events, .room = EVENTS};
  const carom_status status = carom_shoot(table, &ball, 1, NULL, NULL, &shot);
  if (status != CAROM_OK)
    return status;
  int contacts = 0;
  for (int index = 0; index < EVENTS && index < shot.count; index++) {
    if (events[index].type != CAROM_EVENT_RAIL && events[index].type != CAROM_EVENT_JAW)
      continue;
    contacts++;
    if (contacts == 2) {
      *place = events[index].before[0].r[1];
      return CAROM_OK;
    }
  }
  return CAROM_ERROR_POSITION;
}

/* All three, for two numbers of the cushion. */
static carom_status all_come_back(const carom_table *table, const carom_ball_kind *ball,
                                  const double number[2], double place[CAROM_BANKS]) {
  carom_ball_kind kind = *ball;
  kind.restitution_cushion = number[0];
  kind.mu_cushion = number[1];
  carom_status status = CAROM_OK;
  for (int k = 0; k < CAROM_BANKS && status == CAROM_OK; k++)
    status = comes_back(table, &kind, &banks[k], &place[k]);
  return status;
}

/* One step of Gauss and Newton: changes the two numbers, and writes the inverse of the matrix. */
static carom_status improve(const carom_table *table, const carom_ball_kind *ball,
                            const double reading[CAROM_BANKS], double number[2],
                            double inverse[2][2]) {
  const double usual[2] = {ball->restitution_cushion, ball->mu_cushion},
               unsure[2] = {unsure_restitution, unsure_friction};
  double calculated[CAROM_BANKS], slope[2][CAROM_BANKS];
  carom_status status = all_come_back(table, ball, number, calculated);

  /* differences to both sides */
  for (int n = 0; n < 2 && status == CAROM_OK; n++) {
    double less[2] = {number[0], number[1]}, more[2] = {number[0], number[1]};
    double below[CAROM_BANKS];
    less[n] -= step;
    more[n] += step;
    status = all_come_back(table, ball, less, below);
    if (status == CAROM_OK)
      status = all_come_back(table, ball, more, slope[n]);
    for (int index = 0; index < CAROM_BANKS; index++)
      slope[n][index] = (slope[n][index] - below[index]) / (2.0 * step);
  }
  if (status != CAROM_OK)
    return status;

  /* the matrix and the right side, in units of the errors */
  double matrix[2][2] = {{0}}, right[2];
  const double weight = 1.0 / (unsure_reading * unsure_reading);
  for (int axis = 0; axis < 2; axis++) {
    const double prior = 1.0 / (unsure[axis] * unsure[axis]);
    matrix[axis][axis] = prior;
    right[axis] = prior * (usual[axis] - number[axis]);
    for (int index = 0; index < CAROM_BANKS; index++) {
      right[axis] += weight * slope[axis][index] * (reading[index] - calculated[index]);
      for (int m = 0; m < 2; m++)
        matrix[axis][m] += weight * slope[axis][index] * slope[m][index];
    }
  }

  /* its inverse; no step leaves what a cushion can be */
  const double det = matrix[0][0] * matrix[1][1] - matrix[0][1] * matrix[1][0];
  inverse[0][0] = matrix[1][1] / det;
  inverse[1][1] = matrix[0][0] / det;
  inverse[0][1] = inverse[1][0] = -matrix[0][1] / det;
  for (int axis = 0; axis < 2; axis++) {
    const double moved = number[axis] + inverse[axis][0] * right[0] + inverse[axis][1] * right[1];
    number[axis] = carom_greater(carom_lesser(moved, 0.99), 0.01);
  }
  return CAROM_OK;
}

carom_status carom_calibrate(const carom_table *table, const carom_ball_kind *ball,
                             const double *reading, carom_calibration *out) {
  if (table == NULL || ball == NULL || out == NULL)
    return CAROM_ERROR_NULL;
  *out = (carom_calibration){.restitution = ball->restitution_cushion,
                             .friction = ball->mu_cushion,
                             .restitution_error = unsure_restitution,
                             .friction_error = unsure_friction};
  const double diamond = table->length / 8.0;
  double number[2] = {out->restitution, out->friction}, inverse[2][2] = {{0}};
  double place[CAROM_BANKS], m[CAROM_BANKS] = {0};

  /* without readings: where the banks return */
  for (int k = 0; k < CAROM_BANKS && reading != NULL; k++) {
    if (!(reading[k] > 0.0 && reading[k] < 8.0))
      return CAROM_ERROR_POSITION;
    m[k] = reading[k] * diamond;
  }
  carom_status status = all_come_back(table, ball, number, place);
  for (int round = 0; round < ROUNDS && reading != NULL && status == CAROM_OK; round++)
    status = improve(table, ball, m, number, inverse);
  if (status == CAROM_OK && reading != NULL)
    status = all_come_back(table, ball, number, place);
  if (status != CAROM_OK)
    return status;

  /* the results */
  double squares = 0.0;
  for (int index = 0; index < CAROM_BANKS; index++) {
    out->comes_back[index] = place[index] / diamond;
    squares += (m[index] - place[index]) * (m[index] - place[index]);
  }
  if (reading == NULL)
    return CAROM_OK;
  out->restitution = number[0];
  out->friction = number[1];
  out->restitution_error = sqrt(inverse[0][0]);
  out->friction_error = sqrt(inverse[1][1]);
  out->misfit = sqrt(squares / (double)CAROM_BANKS) / reading_error;
  return CAROM_OK;
}
