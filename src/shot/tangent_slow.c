/* Tangents of the rule of slow contacts, of two balls or of a ball at a nose: part_slowly() of resolve.c, differentiated line
 * by line. */
#include "shot/tangent_free.h"

#include <math.h>

void carom_tangent_part(carom_tangent_work *w, const carom_event *event, int bodies, const carom_normal *at, bool in_space,
                        const double (*v)[3], const double (*spin)[3]) {
  const int m = w->m;
  const double slow = carom_slow_speed(w->slow_instants);
  w->slow_instants += event->time > w->slow_last;
  w->slow_last = event->time;
  w->note.flags |= CAROM_TANGENT_SLOW;
  const double *n = at->N;
  const carom_tangent_ball *ball[2] = {&w->ball[event->a], bodies == 2 ? &w->ball[event->b] : NULL};
  /* the masses that an impulse along each axis moves: the cloth holds what is pushed into it; and the motion past each other,
   * which counts in space only */
  double per[2][3] = {{0.0}}, mobility[3] = {0.0}, u[3], relative[3], closing = 0.0, along = 0.0, energy = 0.0;
  for (int side = 0; side < bodies; side++)
    for (int k = 0; k < 3; k++) {
      const bool held =
          in_space && bodies == 2 && k == 2 && !carom_flies(&event->before[side]) && (side == 0 ? n[2] > 0.0 : n[2] < 0.0);
      const carom_ball_kind *kind = ball[side]->kind;
      per[side][k] = held ? 0.0 : 1.0 / kind->mass;
      mobility[k] += per[side][k];
      energy += 0.2 * kind->mass * kind->radius * kind->radius * spin[side][k] * spin[side][k];
    }
  for (int k = 0; k < 3; k++) {
    relative[k] = v[0][k] - (bodies == 2 ? v[1][k] : 0.0);
    closing += relative[k] * n[k];
    along += n[k] * n[k] * mobility[k];
  }
  const double mass = 1.0 / along;
  for (int k = 0; k < 3; k++) {
    u[k] = in_space ? relative[k] - closing * mass * mobility[k] * n[k] : 0.0;
    energy += 0.5 * u[k] * u[k] / mobility[k];
  }
  /* a ball that a model leaves moving into a cushion parts without more */
  const double want = 0.5 * mass * (slow * slow - closing * closing), taken = fmin(want, 0.5 * energy);
  const bool takes = taken > 0.0, all = want <= 0.5 * energy;
  const double share = takes ? sqrt(1.0 - taken / energy) : 1.0;
  const double parts = takes ? sqrt(closing * closing + 2.0 * taken / mass) : closing >= slow ? slow : fmax(closing, 0.0);
  const double P = mass * (closing + parts);
  for (int j = 0; j < m; j++) {
    double dv[3], dn[3], d_per[2][3] = {{0.0}}, d_mobility[3], du[3], d_closing = 0.0, d_along = 0.0, d_energy = 0.0;
    for (int k = 0; k < 3; k++) {
      dn[k] = at->dN[k][j];
      dv[k] = w->d[0][CAROM_S_V[k]][j] - (bodies == 2 ? w->d[1][CAROM_S_V[k]][j] : 0.0);
      for (int side = 0; side < bodies; side++)
        d_per[side][k] = -per[side][k] * per[side][k] * carom_d_kind(ball[side], CAROM_KIND_ROW(mass), m, j);
      d_mobility[k] = d_per[0][k] + d_per[1][k];
      d_closing += dv[k] * n[k] + relative[k] * dn[k];
      d_along += n[k] * (2.0 * dn[k] * mobility[k] + n[k] * d_mobility[k]);
    }
    const double d_mass = -mass * mass * d_along;
    for (int k = 0; k < 3; k++) {
      const double grows = d_closing * mass * n[k] + closing * (d_mass * n[k] + mass * dn[k]);
      du[k] = in_space ? dv[k] - grows * mobility[k] - closing * mass * n[k] * d_mobility[k] : 0.0;
      d_energy += u[k] / mobility[k] * (du[k] - 0.5 * u[k] / mobility[k] * d_mobility[k]);
      for (int side = 0; side < bodies; side++) {
        const carom_ball_kind *kind = ball[side]->kind;
        const double R = kind->radius, dR = carom_d_kind(ball[side], CAROM_KIND_ROW(radius), m, j),
                     dM = carom_d_kind(ball[side], CAROM_KIND_ROW(mass), m, j), spins = spin[side][k];
        d_energy +=
            0.2 * R * spins * ((dM * R + 2.0 * kind->mass * dR) * spins + 2.0 * kind->mass * R * w->d[side][CAROM_S_W[k]][j]);
      }
    }
    double d_share = 0.0, d_parts = closing > 0.0 && closing < slow ? d_closing : 0.0;
    if (takes) {
      const double d_want = 0.5 * d_mass * (slow * slow - closing * closing) - mass * closing * d_closing;
      const double d_taken = all ? d_want : 0.5 * d_energy;
      d_share = -0.5 / share * (d_taken - taken / energy * d_energy) / energy;
      d_parts = (closing * d_closing + d_taken / mass - taken / (mass * mass) * d_mass) / parts;
    }
    const double dP = d_mass * (closing + parts) + mass * (d_closing + d_parts);
    for (int k = 0; k < 3; k++) {
      const double passes = u[k] / mobility[k], d_passes = (du[k] - passes * d_mobility[k]) / mobility[k];
      const double impulse = (1.0 - share) * passes + P * n[k],
                   d_impulse = (1.0 - share) * d_passes - d_share * passes + dP * n[k] + P * dn[k];
      for (int side = 0; side < bodies; side++) {
        double *of_v = &w->d[side][CAROM_S_V[k]][j], *of_w = &w->d[side][CAROM_S_W[k]][j];
        *of_v += (side == 0 ? -1.0 : 1.0) * (per[side][k] * d_impulse + d_per[side][k] * impulse);
        *of_w = share * *of_w + d_share * spin[side][k];
      }
    }
  }
}

void carom_tangent_part_balls(carom_tangent_work *w, const carom_event *event, const carom_normal *at, bool in_space) {
  const carom_ball_state *a = &event->before[0], *b = &event->before[1];
  const double v[2][3] = {{a->v[0], a->v[1], a->v[2]}, {b->v[0], b->v[1], b->v[2]}};
  const double spin[2][3] = {{a->w[0], a->w[1], a->w[2]}, {b->w[0], b->w[1], b->w[2]}};
  carom_tangent_part(w, event, 2, at, in_space, v, spin);
}
