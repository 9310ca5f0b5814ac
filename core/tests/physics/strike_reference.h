/* A strike of balls at rest by the equations of core/src/cluster/tip.h, cluster.h, closing.h and
 * places.c, in long double and short even steps, written from the equations alone. All balls are of
 * one kind, with a constant friction. A step moves the overlaps, then the velocities by the forces
 * there; friction is found ball by ball, as the impulse within its cone that ends the slip. */
#ifndef CAROM_TESTS_STRIKE_REFERENCE_H
#define CAROM_TESTS_STRIKE_REFERENCE_H

#include "carom_shot.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

typedef long double num;
enum { REF_BALLS = 6, REF_TOUCHES = 64 };

/* A contact that is pressed d deep, F = k d^power as it loads, 1 or 1.5, and returns e^2
 * of the work. Where F has reached 0 the rest recovers as d falls. */
typedef struct ref_press {
  num k, e, power, d, most;
  bool met, acted; /* acted: it has had a force */
  int touch;       /* its last one */
} ref_press;

/* A touch of two balls, or of the tip and ball i, where j is -1. */
typedef struct ref_touch {
  int i, j;
  num time, approach, n[3]; /* when; how far the two came together before; from i to j */
  num P[3];                 /* the impulse on i */
  num normal, moment;       /* sums of the normal impulses, and of these by their times */
} ref_touch;

typedef struct ref_strike {
  int count;
  num m, R, mu, mu_slide, M, V, first; /* first: V before the strike */
  num axis[3], push[3], arm[3];
  num v[REF_BALLS][3], W[REF_BALLS][3], r[REF_BALLS][3]; /* W = R w */
  num from[REF_BALLS][3], time, went;                    /* r at the start; s; m, of the cue */
  num lifted[REF_BALLS], lift[REF_BALLS];                /* by the slate, N s: all, of a step */
  ref_touch touch[REF_TOUCHES];
  int count_of_touches; /* of all, and in touches of the tip */
  bool slate;
  num phi[REF_BALLS]; /* how free of the cloth contacts of ball 0 with these are */
  ref_press tip, under[REF_BALLS], pair[REF_BALLS][REF_BALLS];
  num n[REF_BALLS][REF_BALLS][3];
  num impulse; /* of the tip, N s */
  num reach;   /* m: how far the cue continues */
  num T;       /* s: how long the tip touches a single ball */
  int touches;
} ref_strike;

static inline num ref_phi(const ref_strike *s, int i, int j) {
  if (i == 0)
    return s->phi[j];
  return j == 0 ? s->phi[i] : 0;
}

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
  x->most = x->d / (1 - x->e * x->e);
  return 0;
}

/* An impulse at the position c from the centre, over R, of ball i. */
static inline void ref_hit(ref_strike *s, int i, const num c[3], const num J[3]) {
  num turn[3];
  ref_cross(c, J, turn);
  for (int k = 0; k < 3; k++) {
    s->v[i][k] += J[k] / s->m;
    s->W[i][k] += 2.5L * turn[k] / s->m;
  }
}

/* The velocity of the surface at the position c. */
static inline void ref_surface(const ref_strike *s, int i, const num c[3], num u[3]) {
  ref_cross(s->W[i], c, u);
  for (int k = 0; k < 3; k++)
    u[k] += s->v[i][k];
}

/* The impulse g with which friction continues, of size `most` at most, to end the slip u of which a
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
  s->T = T;
  const num mass = 1 / (1 / s->M + (1 + 2.5L * (a * a + b * b)) / s->m);
  s->tip = (ref_press){.k = mass * powl(pi / 2 * (1 + e) / T, 2), .e = e, .power = 1};

  /* the slate lasts 1 ms; balls by Hertz: delta = (5 v^2 / (4 K/m))^0.4 */
  const num E = 6.6e9L / 2, given = kind->restitution_table, e_s = given > 0 ? given : 0.5L;
  for (int i = 0; i < count; i++) {
    s->under[i] =
        (ref_press){.k = s->m * powl(pi / 2 * (1 + e_s) / 1e-3L, 2), .e = e_s, .power = 1};
    for (int k = 0; k < 3; k++)
      s->r[i][k] = s->from[i][k] = balls[i].state.r[k];
    for (int j = 0; j < i; j++)
      s->pair[j][i] =
          (ref_press){.k = 4 / 3.0L * E * sqrtl(s->R / 2), .e = kind->restitution, .power = 1.5L};
  }
}

/* How fast the tip closes, and how two balls do. */
static inline num ref_closing(const ref_strike *s) {
  return s->V - ref_dot(s->v[0], s->push) - ref_dot(s->W[0], s->arm);
}

static inline num ref_closing_of(const ref_strike *s, int i, int j) {
  return ref_dot(s->v[i], s->n[i][j]) - ref_dot(s->v[j], s->n[i][j]);
}

/* Contacts that close slower are none: of tip and slate, m/s, and of balls. */
static inline num ref_slow(const ref_strike *s) {
  return 1e-9L * s->first;
}
static const num ref_slow_balls = 1e-6L;

/* Positions and overlaps after h; those of balls that have touched continue along the normal that
 * they had then. */
static inline void ref_move(ref_strike *s, num h, bool first) {
  num w[3];
  s->time += h;
  s->went += h * s->V;
  s->tip.d += h * ref_closing(s);
  for (int i = 0; i < s->count; i++) {
    s->under[i].d -= h * s->v[i][2];
    for (int k = 0; k < 3; k++)
      s->r[i][k] += h * s->v[i][k];
  }
  for (int i = 0; i < s->count; i++)
    for (int j = i + 1; j < s->count; j++) {
      ref_press *x = &s->pair[i][j];
      for (int k = 0; k < 3; k++)
        w[k] = s->r[j][k] - s->r[i][k];
      if (x->met && !x->acted && x->d < 0 && ref_dot(w, w) > powl(2 * s->R + 1e-9L, 2))
        x->met = false; /* it has parted before a force */
      if (x->met) {
        x->d += h * ref_closing_of(s, i, j);
        continue;
      }
      const num far = sqrtl(ref_dot(w, w)), gap = far - 2 * s->R;
      for (int k = 0; k < 3; k++)
        s->n[i][j][k] = w[k] / far;
      x->met = first && gap < 1e-9L;
      x->d = x->met ? 0 : -gap;
    }
}

/* The force of a contact, which may touch in this step. */
static inline num ref_press_on(ref_strike *s, ref_press *x, int i, int j) {
  const bool open = !(x->most > 0);
  const num F = ref_force(x);
  if (!open || !(x->most > 0))
    return F;
  ref_touch l = {.i = i, .j = j, .time = s->time};
  if (j >= 0) {
    const num closing = ref_closing_of(s, i, j);
    if (closing > 0)
      l.time = fmaxl(s->time - x->d / closing, 0);
    l.approach = -x->d;
    for (int k = 0; k < 3; k++) {
      l.n[k] = s->n[i][j][k];
      l.approach += (s->r[i][k] - s->from[i][k] - s->r[j][k] + s->from[j][k]) * l.n[k];
    }
    l.approach = fmaxl(l.approach, 0);
  }
  x->touch = s->count_of_touches < REF_TOUCHES ? s->count_of_touches++ : x->touch;
  s->touch[x->touch] = l;
  return F;
}

/* Whether the tip has parted for good. */
static inline bool ref_gone(const ref_strike *s) {
  return s->touches > 0 && !(s->tip.most > 0) && !(s->reach > 0);
}

/* The velocities after h by the forces at these overlaps. Whether tip or balls act; and the slate.
 */
static inline bool ref_push(ref_strike *s, num h, bool *slate) {
  static const num foot[3] = {0, 0, -1};
  num J[REF_BALLS][REF_BALLS], load[REF_BALLS] = {0}, g[REF_BALLS][REF_BALLS][3],
                               cloth[REF_BALLS][3], f[3], u[3], w[3], back[3];
  bool any = false;
  *slate = false;
  memset(g, 0, sizeof g);
  memset(cloth, 0, sizeof cloth);

  /* normal forces, and what their touches give */
  const bool gone = ref_gone(s), open = !(s->tip.most > 0);
  const num F = gone ? 0 : h * ref_press_on(s, &s->tip, 0, -1);
  s->touches += open && s->tip.most > 0;
  s->V -= F / s->M;
  s->impulse += F;
  for (int k = 0; k < 3; k++) {
    s->v[0][k] += F * s->push[k] / s->m;
    s->W[0][k] += 2.5L * F * s->arm[k] / s->m;
    s->touch[s->tip.touch].P[k] += F * s->push[k];
  }
  any |= F > 0;
  for (int i = 0; i < s->count; i++) {
    if (s->slate) {
      load[i] = h * ref_force(&s->under[i]);
      s->lifted[i] += s->lift[i] = load[i];
      s->v[i][2] += load[i] / s->m;
      *slate |= load[i] > 0 || (s->under[i].d > 0 && -s->v[i][2] > ref_slow(s));
    }
    for (int j = i + 1; j < s->count; j++) {
      ref_press *x = &s->pair[i][j];
      J[i][j] = h * ref_press_on(s, x, i, j);
      any |= J[i][j] > 0 || (x->d > 0 && ref_closing_of(s, i, j) >= ref_slow_balls);
      if (!(J[i][j] > 0))
        continue;
      ref_touch *l = &s->touch[x->touch];
      l->normal += J[i][j];
      l->moment += J[i][j] * s->time;
      for (int k = 0; k < 3; k++) {
        s->v[i][k] -= J[i][j] * s->n[i][j][k] / s->m;
        s->v[j][k] += J[i][j] * s->n[i][j][k] / s->m;
        l->P[k] -= J[i][j] * s->n[i][j][k];
      }
    }
  }

  /* the tip's load frees contacts of its ball from the cloth */
  for (int j = 1; j < s->count; j++) {
    const num down = s->slate ? fmaxl(-s->push[2] * F, 0) : 0;
    s->phi[j] = down > 0 && J[0][j] > 0 ? fminl(down / (s->mu * J[0][j]), 1) : 0;
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
        u[2] -= (1 - ref_phi(s, i, j)) * (s->v[i][2] - s->v[j][2]);
        const num along = ref_dot(u, n);
        for (int k = 0; k < 3; k++)
          u[k] -= along * n[k];
        ref_rub(u, 7 / s->m, s->mu * J[i][j], g[i][j], f);
        ref_hit(s, i, n, f);
        s->v[i][2] -= (1 - ref_phi(s, i, j)) * f[2] / s->m;
        s->v[j][2] += (1 - ref_phi(s, i, j)) * f[2] / s->m;
        for (int k = 0; k < 3; k++) {
          s->touch[s->pair[i][j].touch].P[k] += k < 2 ? f[k] : ref_phi(s, i, j) * f[k];
          f[k] = -f[k];
        }
        ref_hit(s, j, back, f);
      }
    for (int i = 0; i < s->count; i++) {
      num most = load[i];
      for (int j = 0; j < s->count; j++) /* what friction presses on the cloth */
        most += (1 - ref_phi(s, i, j)) * (j > i ? -g[i][j][2] : g[j][i][2]);
      most = fmaxl(most, 0);
      if (!s->slate)
        s->v[i][2] = 0;
      ref_surface(s, i, foot, u);
      u[2] = 0;
      ref_rub(u, 3.5L / s->m, s->mu_slide * most, cloth[i], f);
      ref_hit(s, i, foot, f);
    }
  }
  return any || (!ref_gone(s) && s->tip.d > 0 && ref_closing(s) > ref_slow(s));
}

/* The speed upwards at which the slate lets ball i go if nothing else acts. The energy above the
 * greatest compression so far is loaded anew, of which the speed is e times. The compression is
 * that in the middle of the last impulse. */
static inline num ref_release(const ref_strike *s, int i) {
  const ref_press *x = &s->under[i];
  const num v = s->v[i][2] - s->lift[i] / s->m / 2, k = x->k / s->m, e = x->e;
  if (!(x->d > 0))
    return s->v[i][2];
  const num y = fmaxl(x->d - (1 - e * e) * x->most, 0), line = v * v + k / (e * e) * y * y;
  if (y == 0 && v >= 0)
    return s->v[i][2];
  const num beyond = line - k * powl(e * x->most, 2);
  return v < 0 && beyond > 0 ? e * sqrtl(k * x->most * x->most + beyond) : sqrtl(line);
}

/* Neither tip nor balls act. Whether the slate lets the balls go, at once and with the friction of
 * their feet: unless its release would bring the struck ball back to the tip. */
static inline bool ref_slate_ends(ref_strike *s) {
  static const num foot[3] = {0, 0, -1};
  const num closing = ref_closing(s), by_slate = -s->push[2] * (ref_release(s, 0) - s->v[0][2]),
            slow = ref_slow(s);
  if (!ref_gone(s) && closing <= slow && closing + by_slate > slow)
    return false;
  for (int i = 0; i < s->count; i++) {
    num u[3], g[3] = {0, 0, 0}, f[3];
    const num J = s->m * (ref_release(s, i) - s->v[i][2]);
    s->lifted[i] += J;
    s->v[i][2] += J / s->m;
    s->under[i].d = fminl(s->under[i].d, 0);
    s->under[i].most = 0;
    ref_surface(s, i, foot, u);
    u[2] = 0;
    ref_rub(u, 3.5L / s->m, s->mu_slide * J, g, f);
    ref_hit(s, i, foot, f);
  }
  return true;
}

/* Balls that have had a force and close again do so at once, as their positions stay. */
static inline bool ref_touch_again(ref_strike *s) {
  bool any = false;
  for (int i = 0; i < s->count; i++)
    for (int j = i + 1; j < s->count; j++)
      if (s->pair[i][j].acted && ref_closing_of(s, i, j) >= ref_slow_balls) {
        s->pair[i][j].d = 0;
        any = true;
      }
  return any;
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
      const num closing = ref_closing_of(s, i, j);
      if (x->met && closing >= ref_slow_balls)
        first = fminl(first, fmaxl(-x->d / closing, 0));
      else if (!x->met && B < 0 && D > 0)
        first = fminl(first, (-B - sqrtl(D)) / A);
    }
  return first;
}

/* Where nothing acts: under a raised cue on to the next touch of tip or slate, unless the tip would
 * close without the slate too; and to one of balls that comes before that and within the recovery
 * of the tip. Whether there is one. */
static inline bool ref_go_to_touch(ref_strike *s) {
  const num closing = ref_closing(s), slow = ref_slow(s);
  const bool follows = closing + s->push[2] * s->lifted[0] / s->m > slow,
             comes = s->slate && !follows && s->tip.d <= 0 && closing > slow &&
                     -s->tip.d / closing * s->V <= s->reach;
  const num of_tip = comes ? -s->tip.d / closing : INFINITY, of_balls = ref_wait_of_balls(s),
            recovery = s->tip.d > 0 && closing < 0 ? fminl(-s->tip.d / closing, s->T) : 0;
  num wait = of_tip;
  for (int i = 0; s->slate && i < s->count; i++)
    if (s->under[i].d <= 0 && -s->v[i][2] > slow)
      wait = fminl(wait, s->under[i].d / s->v[i][2]);
  if (of_balls < wait && of_balls >= recovery)
    return false;
  wait = fminl(wait, of_balls);
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
    bool slate;
    ref_move(s, h, first);
    go_on = ref_push(s, h, &slate) || (slate && !ref_slate_ends(s)) || ref_touch_again(s) ||
            ref_go_to_touch(s);
  }
}

/* ---- Positions */

/* The centroid in time of the impulse of the tip at a single ball. */
static inline num ref_lag(const ref_strike *s, num T) {
  const num e = s->tip.e;
  return T / (1 + e) * (2 / acosl(-1.0L) * (1 - e) + e);
}

/* The change of velocity of ball i by a touch. */
static inline void ref_change(const ref_strike *s, const ref_touch *l, int i, num dv[3]) {
  const int side = (l->i == i) - (l->j == i);
  for (int k = 0; k < 3; k++)
    dv[k] = side * l->P[k] / s->m;
}

/* Where balls start, r', and how far the tip is ahead of its ball then; T is that of the tip. The
 * balls were at rest before. */
static inline num ref_places(const ref_strike *s, num T, num places[REF_BALLS][3]) {
  num v[REF_BALLS][3], moment[REF_BALLS][3] = {{0}}, dv[3], delay = 0;
  bool done[REF_TOUCHES] = {false};

  /* all that touches do not give counts at the start */
  memcpy(v, s->v, sizeof v);
  for (int i = 0; i < s->count; i++)
    for (int n = 0; n < s->count_of_touches; n++) {
      ref_change(s, &s->touch[n], i, dv);
      for (int k = 0; k < 3; k++)
        v[i][k] -= dv[k];
    }

  /* the touches in their order, each at the instant at which the two have come so near */
  for (int n = 0; n < s->count_of_touches; n++) {
    int next = -1;
    for (int q = 0; q < s->count_of_touches; q++)
      if (!done[q] && (next < 0 || s->touch[q].time < s->touch[next].time))
        next = q;
    const ref_touch *l = &s->touch[next];
    done[next] = true;
    num t = fmaxl(l->time - ref_lag(s, T), 0);
    if (l->j >= 0) {
      const num rate = ref_dot(v[l->i], l->n) - ref_dot(v[l->j], l->n),
                way = l->approach + ref_dot(moment[l->i], l->n) - ref_dot(moment[l->j], l->n);
      t = way <= 0 ? 0 : l->time;
      if (way > 0 && rate > 0)
        t = fminl(way / rate, l->time);
      if (l->normal > 0) {
        ref_change(s, l, 0, dv);
        delay += ref_dot(dv, s->axis) * (l->moment / l->normal - l->time);
      }
    }
    for (int i = 0; i < s->count; i++) {
      ref_change(s, l, i, dv);
      for (int k = 0; k < 3; k++) {
        v[i][k] += dv[k];
        moment[i][k] += dv[k] * t;
      }
    }
  }

  /* r' = r - sum of dv t, on the slate; the tip */
  num ball[3];
  const num since = s->time - ref_lag(s, T);
  for (int i = 0; i < s->count; i++)
    for (int k = 0; k < 3; k++)
      places[i][k] = s->from[i][k] - (k < 2 ? moment[i][k] : 0);
  for (int k = 0; k < 3; k++)
    ball[k] = places[0][k] + since * s->v[0][k] - s->r[0][k];
  return s->went - since * s->V + ref_dot(ball, s->axis) - delay;
}

#endif
