/* A strike by the equations of src/cluster/tip.h and cluster.h, in long double and short even
 * steps, written from the equations alone. All balls are of one kind, with a constant friction. A
 * step moves the overlaps, then the velocities by the forces there; friction is found ball by ball,
 * as the impulse within its cone that ends the slip. */
#ifndef CAROM_TESTS_STRIKE_REFERENCE_H
#define CAROM_TESTS_STRIKE_REFERENCE_H

#include "carom_shot.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

typedef long double num;
enum { REF_BALLS = 6 };

/* A contact that is pressed d deep, F = k d^power as it loads, 1 or 1.5, and gives back e^2
 * of the work. Where F has reached 0 the rest is forgotten, or recovers as d falls. */
typedef struct ref_press {
  num k, e, power, d, most;
  bool met, acted, recovers; /* acted: it has had a force */
} ref_press;

typedef struct ref_strike {
  int count;
  num m, R, mu, mu_slide, M, V, first; /* first: V before the strike */
  num axis[3], push[3], arm[3];
  num v[REF_BALLS][3], W[REF_BALLS][3], r[REF_BALLS][3]; /* W = R w */
  bool slate;
  num phi; /* how free of the cloth contacts of balls are */
  ref_press tip, under[REF_BALLS], pair[REF_BALLS][REF_BALLS];
  num n[REF_BALLS][REF_BALLS][3];
  num impulse; /* of the tip, N s */
  num reach;   /* m: how far the cue goes on */
  int touches;
} ref_strike;

static inline num ref_dot(const num a[3], const num b[3]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static inline void ref_cross(const num a[3], const num b[3], num c[3]) {
  for (int k = 0; k < 3; k++)
    c[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
}

static inline num ref_power(const ref_press *x, num y) {
  return x->power == 1 ? y : y * sqrtl(y);
}

/* The force at d, and how it ends. */
static inline num ref_force(ref_press *x) {
  x->met |= x->d > 0;
  x->acted |= x->d > 0;
  if (x->d <= 0) {
    x->most = 0;
    return 0;
  }
  if (x->d >= x->most) {
    x->most = x->d;
    return x->k * ref_power(x, x->d);
  }
  const num y = x->d - (1 - x->e * x->e) * x->most;
  if (y > 0) /* k / e^(2 power) of the spring, and e^2 of the work */
    return x->k / ref_power(x, x->e * x->e) * ref_power(x, y);
  if (x->recovers && x->e < 1)
    x->most = x->d / (1 - x->e * x->e);
  else
    x->d = x->most = 0;
  return 0;
}

/* An impulse at the place c from the centre, over R, of ball i. */
static inline void ref_hit(ref_strike *s, int i, const num c[3], const num J[3]) {
  num turn[3];
  ref_cross(c, J, turn);
  for (int k = 0; k < 3; k++) {
    s->v[i][k] += J[k] / s->m;
    s->W[i][k] += 2.5L * turn[k] / s->m;
  }
}

/* The velocity of the surface at the place c. */
static inline void ref_surface(const ref_strike *s, int i, const num c[3], num u[3]) {
  ref_cross(s->W[i], c, u);
  for (int k = 0; k < 3; k++)
    u[k] += s->v[i][k];
}

/* The impulse g with which friction goes on, of size `most` at most, to end the slip u of which a
 * unit of it takes `takes`; what it changes by is `change`. */
static inline void ref_rub(const num u[3], num takes, num most, num g[3], num change[3]) {
  num next[3];
  for (int k = 0; k < 3; k++)
    next[k] = g[k] - u[k] / takes;
  const num size = sqrtl(ref_dot(next, next)), share = size > most ? most / size : 1;
  for (int k = 0; k < 3; k++) {
    change[k] = share * next[k] - g[k];
    g[k] = share * next[k];
  }
}

static inline void ref_begin(ref_strike *s, const carom_shot_ball *balls, int count,
                             const carom_cue *cue) {
  const carom_ball_kind *kind = &balls[0].kind;
  const num pi = acosl(-1.0L), phi = cue->phi * pi / 180, theta = cue->theta * pi / 180;
  const num a = cue->a, b = cue->b;
  memset(s, 0, sizeof *s);
  s->count = count;
  s->m = kind->mass;
  s->R = kind->radius;
  s->mu = kind->mu_ball;
  s->mu_slide = kind->mu_slide;
  s->M = cue->mass;
  s->V = s->first = cue->speed;
  s->slate = cue->theta > 0.0;
  s->reach = cue->follow;

  /* the cue: its axis, the push turned by squirt, and the arm p x c / R */
  const num c[3] = {cosl(theta) * cosl(phi), cosl(theta) * sinl(phi), -sinl(theta)};
  const num left[3] = {-sinl(phi), cosl(phi), 0},
            up[3] = {sinl(theta) * cosl(phi), sinl(theta) * sinl(phi), cosl(theta)};
  const num turn =
      -atan2l(2.5L * a * sqrtl(1 - a * a), 1 + s->m / cue->end_mass + 2.5L * (1 - a * a));
  num p[3];
  for (int k = 0; k < 3; k++) {
    s->axis[k] = c[k];
    s->push[k] = cosl(turn) * c[k] + sinl(turn) * left[k];
    p[k] = a * left[k] + b * up[k] - sqrtl(1 - a * a - b * b) * c[k];
  }
  ref_cross(p, c, s->arm);
  const num e = cue->tip_restitution, T = cue->tip_time;
  const num mass = 1 / (1 / s->M + (1 + 2.5L * (a * a + b * b)) / s->m);
  s->tip =
      (ref_press){.k = mass * powl(pi / 2 * (1 + e) / T, 2), .e = e, .power = 1, .recovers = true};
  s->phi = fminl(powl(s->push[2] / 0.1L, 2), 1);

  /* the slate lasts 1 ms; balls by Hertz: delta = (5 v^2 / (4 K/m))^0.4 */
  const num E = 6.6e9L / 2, given = kind->restitution_table, e_s = given > 0 ? given : 0.5L;
  for (int i = 0; i < count; i++) {
    s->under[i] = (ref_press){
        .k = s->m * powl(pi / 2 * (1 + e_s) / 1e-3L, 2), .e = e_s, .power = 1, .recovers = true};
    for (int k = 0; k < 3; k++)
      s->r[i][k] = balls[i].state.r[k];
    for (int j = 0; j < i; j++)
      s->pair[j][i] =
          (ref_press){.k = 4 / 3.0L * E * sqrtl(s->R / 2), .e = kind->restitution, .power = 1.5L};
  }
}

/* Positions and overlaps after h; those of balls that have touched go on along the normal that they
 * had then. */
static inline void ref_move(ref_strike *s, num h, bool first) {
  num u[3], w[3];
  s->tip.d += h * (s->V - ref_dot(s->v[0], s->push) - ref_dot(s->W[0], s->arm));
  for (int i = 0; i < s->count; i++) {
    s->under[i].d -= h * s->v[i][2];
    for (int k = 0; k < 3; k++)
      s->r[i][k] += h * s->v[i][k];
  }
  for (int i = 0; i < s->count; i++)
    for (int j = i + 1; j < s->count; j++) {
      ref_press *x = &s->pair[i][j];
      for (int k = 0; k < 3; k++)
        u[k] = s->v[i][k] - s->v[j][k];
      for (int k = 0; k < 3; k++)
        w[k] = s->r[j][k] - s->r[i][k];
      if (x->met && !x->acted && x->d < 0 && ref_dot(w, w) > powl(2 * s->R + 1e-9L, 2))
        x->met = false; /* it has parted before a force */
      if (x->met) {
        x->d += h * ref_dot(u, s->n[i][j]);
        continue;
      }
      for (int k = 0; k < 3; k++)
        u[k] = s->r[j][k] - s->r[i][k];
      const num far = sqrtl(ref_dot(u, u)), gap = far - 2 * s->R;
      for (int k = 0; k < 3; k++)
        s->n[i][j][k] = u[k] / far;
      x->met = first && gap < 1e-9L;
      x->d = x->met ? 0 : -gap;
    }
}

/* The velocities after h by the forces at these overlaps. Whether any acts. */
static inline bool ref_push(ref_strike *s, num h) {
  static const num foot[3] = {0, 0, -1};
  num J[REF_BALLS][REF_BALLS], load[REF_BALLS] = {0}, g[REF_BALLS][REF_BALLS][3],
                               cloth[REF_BALLS][3], f[3], u[3], w[3], back[3];
  bool any = false;
  memset(g, 0, sizeof g);
  memset(cloth, 0, sizeof cloth);

  /* normal forces */
  const bool was = s->tip.most > 0, gone = s->touches > 0 && !was && !(s->reach > 0);
  const num F = gone ? 0 : h * ref_force(&s->tip);
  s->touches += !was && s->tip.most > 0;
  s->V -= F / s->M;
  s->impulse += F;
  for (int k = 0; k < 3; k++) {
    s->v[0][k] += F * s->push[k] / s->m;
    s->W[0][k] += 2.5L * F * s->arm[k] / s->m;
  }
  const num comes = gone ? 0 : s->V - ref_dot(s->v[0], s->push) - ref_dot(s->W[0], s->arm);
  any |= F > 0 || (s->tip.d > 0 && comes > 0);
  bool slate = false;
  for (int i = 0; i < s->count; i++) {
    if (s->slate) {
      load[i] = h * ref_force(&s->under[i]);
      s->v[i][2] += load[i] / s->m;
      slate |= load[i] > 0 || (s->under[i].d > 0 && s->v[i][2] < 0);
    }
    for (int j = i + 1; j < s->count; j++) {
      J[i][j] = h * ref_force(&s->pair[i][j]);
      any |= s->pair[i][j].most > 0;
      for (int k = 0; k < 3; k++) {
        s->v[i][k] -= J[i][j] * s->n[i][j][k] / s->m;
        s->v[j][k] += J[i][j] * s->n[i][j][k] / s->m;
      }
    }
  }

  /* friction, of balls and of the cloth, until both are as they should be */
  for (int round = 0; round < 8; round++) {
    for (int i = 0; i < s->count; i++)
      for (int j = i + 1; j < s->count; j++) {
        if (J[i][j] <= 0)
          continue;
        const num *n = s->n[i][j];
        for (int k = 0; k < 3; k++)
          back[k] = -n[k];
        ref_surface(s, i, n, u);
        ref_surface(s, j, back, w);
        for (int k = 0; k < 3; k++)
          u[k] -= w[k];
        u[2] -= (1 - s->phi) * (s->v[i][2] - s->v[j][2]);
        const num along = ref_dot(u, n);
        for (int k = 0; k < 3; k++)
          u[k] -= along * n[k];
        ref_rub(u, 7 / s->m, s->mu * J[i][j], g[i][j], f);
        ref_hit(s, i, n, f);
        s->v[i][2] -= (1 - s->phi) * f[2] / s->m;
        s->v[j][2] += (1 - s->phi) * f[2] / s->m;
        for (int k = 0; k < 3; k++)
          f[k] = -f[k];
        ref_hit(s, j, back, f);
      }
    for (int i = 0; i < s->count; i++) {
      num most = load[i];
      for (int j = 0; j < s->count; j++) /* what friction presses on the cloth */
        most += (1 - s->phi) * (j > i ? -g[i][j][2] : g[j][i][2]);
      most = fmaxl(most, 0);
      if (!s->slate)
        s->v[i][2] = 0;
      ref_surface(s, i, foot, u);
      u[2] = 0;
      ref_rub(u, 3.5L / s->m, s->mu_slide * most, cloth[i], f);
      ref_hit(s, i, foot, f);
    }
  }
  return any || slate;
}

/* How long until balls touch that have not. */
static inline num ref_wait_of_balls(const ref_strike *s) {
  num first = INFINITY, d[3], v[3];
  for (int i = 0; i < s->count; i++)
    for (int j = i + 1; j < s->count; j++) {
      for (int k = 0; k < 3; k++) {
        d[k] = s->r[j][k] - s->r[i][k];
        v[k] = s->v[j][k] - s->v[i][k];
      }
      const num A = ref_dot(v, v), B = ref_dot(d, v),
                D = B * B - A * (ref_dot(d, d) - 4 * s->R * s->R);
      const ref_press *x = &s->pair[i][j];
      const num closing = -ref_dot(v, s->n[i][j]);
      if (x->met && closing > 1e-6L)
        first = fminl(first, fmaxl(-x->d / closing, 0));
      else if (!x->met && B < 0 && D > 0)
        first = fminl(first, (-B - sqrtl(D)) / A);
    }
  return first;
}

/* Where nothing acts: on to the next touch of balls, of a tip whose set recovers, or under a raised
 * cue to the next one of tip or slate, if there is one. */
static inline bool ref_go_to_touch(ref_strike *s) {
  const num closing = s->V - ref_dot(s->v[0], s->push) - ref_dot(s->W[0], s->arm),
            least = 1e-9L * s->first;
  const bool comes =
      s->slate && s->tip.d <= 0 && closing > least && -s->tip.d / closing * s->V <= s->reach;
  const num of_tip = comes ? -s->tip.d / closing : INFINITY;
  num wait = of_tip, recovery = s->tip.d > 0 && closing < 0 ? -s->tip.d / closing : 0;
  for (int i = 0; s->slate && i < s->count; i++) {
    if (s->under[i].d <= 0 && -s->v[i][2] > least)
      wait = fminl(wait, s->under[i].d / s->v[i][2]);
    if (s->under[i].d > 0 && s->v[i][2] > 0)
      recovery = fmaxl(recovery, s->under[i].d / s->v[i][2]);
  }
  const num balls = ref_wait_of_balls(s);
  if (balls < (wait < INFINITY ? wait : recovery))
    wait = balls;
  if (!(wait < INFINITY))
    return false;
  ref_move(s, wait, false);
  if (of_tip <= wait)
    s->tip.d = 1e-15L;
  return true;
}

/* From the touch of the tip until nothing acts. */
static inline void ref_solve(ref_strike *s, num h) {
  for (bool go_on = true, first = true; go_on; first = false) {
    ref_move(s, h, first);
    go_on = ref_push(s, h);
    for (int i = 0; !go_on && i < s->count; i++)
      for (int j = i + 1; j < s->count; j++) {
        num u[3];
        for (int k = 0; k < 3; k++)
          u[k] = s->v[i][k] - s->v[j][k];
        if (s->pair[i][j].acted && ref_dot(u, s->n[i][j]) > 1e-6L) {
          s->pair[i][j].d = 0;
          go_on = true;
        }
      }
    go_on |= !go_on && ref_go_to_touch(s);
  }
}

#endif
