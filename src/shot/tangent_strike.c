/* Tangents of the strike: strike.c, differentiated. */
#include "platform/elementary.h"
#include "shot/tangent_work.h"

#include <math.h>

void carom_tangent_strike(carom_tangent_work *w, const carom_event *event) {
  const int m = w->m;
  const carom_cue *cue = w->cue;
  const carom_tangent_ball *ball = &w->ball[event->a];
  const bool flat = w->opt->space == CAROM_SPACE_FLAT;
  const double *q = w->seeds->cue, R = ball->kind->radius, mass = ball->kind->mass, a = cue->a, b = cue->b,
               inside = 1.0 - a * a;
  double sin_phi, cos_phi, sin_theta, cos_theta;
  carom_sincos_degrees(cue->phi, &sin_phi, &cos_phi);
  carom_sincos_degrees(cue->theta, &sin_theta, &cos_theta);
  const double degree = 0.017453292519943295, heavy = 1.0 + mass / cue->mass + 2.5 * (a * a + b * b),
               V = 2.0 * cue->speed / heavy;
  const double root = sqrt(inside), aside = -2.5 * a * root, ahead = 1.0 + mass / cue->end_mass + 2.5 * inside;
  const double size = sqrt(aside * aside + ahead * ahead), s = aside / size, c = ahead / size, turn = 2.5 * V / R;
  const double x = turn * b, y = turn * a * sin_theta;
  /* v / V ahead, to the left and up. In flat play the elevation shortens both level parts. */
  const double v_ahead = c * cos_theta, v_left = flat ? s * cos_theta : s, v_up = flat ? 0.0 : -c * sin_theta;
  for (int j = 0; j < m; j++) {
    const double d_mass = carom_d_kind(ball, CAROM_KIND_ROW(mass), m, j), dR = carom_d_kind(ball, CAROM_KIND_ROW(radius), m, j);
    double d[CAROM_CUE_NUMBERS];
    for (int k = 0; k < CAROM_CUE_NUMBERS; k++)
      d[k] = carom_seed(carom_seeds_row(q, k, m), j);
    const double d_speed = d[0], d_phi = degree * d[1], d_theta = degree * d[2], da = d[3], db = d[4], dM = d[5], d_end = d[6];
    /* the speed along the cue, and squirt */
    const double d_heavy = d_mass / cue->mass - mass / (cue->mass * cue->mass) * dM + 5.0 * (a * da + b * db);
    const double dV = (2.0 * d_speed - V * d_heavy) / heavy;
    const double d_aside = -2.5 * da * (root - a * a / root);
    const double d_ahead = d_mass / cue->end_mass - mass / (cue->end_mass * cue->end_mass) * d_end - 5.0 * a * da;
    const double d_squirt = (d_aside * c - d_ahead * s) / size; /* of the angle */
    const double d_sin = cos_theta * d_theta, d_cos = -sin_theta * d_theta, dc = -s * d_squirt, ds = c * d_squirt;
    const double d_v_ahead = dc * cos_theta + c * d_cos, d_v_left = flat ? ds * cos_theta + s * d_cos : ds;
    /* along the axes of the table */
    const double along = dV * v_ahead + V * (d_v_ahead - v_left * d_phi), left = dV * v_left + V * (d_v_left + v_ahead * d_phi);
    w->d[0][S_V_X][j] = along * cos_phi - left * sin_phi;
    w->d[0][S_V_Y][j] = along * sin_phi + left * cos_phi;
    w->d[0][S_V_Z][j] = flat ? 0.0 : dV * v_up - V * (dc * sin_theta + c * d_sin);
    const double d_turn = 2.5 * dV / R - turn / R * dR, dx = d_turn * b + turn * db;
    const double dy = (d_turn * a + turn * da) * sin_theta + turn * a * d_sin;
    w->d[0][S_W_X][j] = -dx * sin_phi - dy * cos_phi + (-x * cos_phi + y * sin_phi) * d_phi;
    w->d[0][S_W_Y][j] = dx * cos_phi - dy * sin_phi + (-x * sin_phi - y * cos_phi) * d_phi;
    w->d[0][S_W_Z][j] = -(d_turn * a + turn * da) * cos_theta - turn * a * d_cos;
    w->d_time[j] = 0.0;
  }
}
