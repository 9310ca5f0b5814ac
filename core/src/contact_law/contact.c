/* The regime of the two contacts that begins where a slip is zero, and its coefficients.
 *
 * HOLDING. Where a = 0, the friction that keeps it there follows from a' = 0. With the cloth
 * slipping in the direction t under the load g, F = -mu_c g t, this is linear:
 *
 *     f_x = (C_x / K_x) mu_c g t_x        f_y = -A_0 / K_y + (C_y / K_y) mu_c g t_y
 *     g = G_0 / (1 - G_1 t_y)
 *     G_0 = g_0 - g_1 A_0 / K_y           G_1 = mu_c g_1 C_y / K_y
 *
 * so the cloth bears a load if and only if G_0 > 0. Where b = 0, b' = 0 asks for F = -(L_x f_x,
 * B_0 + L_y f_y) / H. If friction holds both, f_x = F_x = 0, and v' = 0 for a cushion: the ball
 * is JAMMED, nothing changes any more, and the impact ends. A contact is held if this friction
 * lies within the cone, |f| <= mu or |F| <= mu_c g. It is held until it leaves the cone.
 *
 * LEAVING. Where friction cannot hold, the slip begins in a direction to which its own rate is
 * parallel. On the cloth that is the direction of (0, B_0) + L f, which does not depend on F. At
 * the driving contact it is that of -h, h the friction that would hold it: a' = M (f - h) with
 * M_xx = K_x, M_xy = -C_x mu_c g_1 t_x, M_yy = K_y - C_y mu_c g_1 t_y, and by the numbers of
 * law.h M h = M_yy h for a cushion, so that f = mu h/|h| gives an a' along -h. For two balls h =
 * 0. Where both slips are zero all is symmetric about the y axis, and so are the directions.
 *
 * UNSTABLE. Where H < 0 friction drives the slip on the cloth. Let it begin at b = 0 with the
 * rate d without friction, and let friction alone have the rate h. A slip that is not zero but
 * an error e goes on in its own direction if h > d. If not, its component across d grows like
 * |b|^(h / (d + h)), to e^(d / (d + h)). At h = MOST_DRIVEN d a rounding error of 1e-16 becomes
 * 2.5e-10; beyond that there is no result.
 *
 * A frictionless contact has no direction and no cone. */
#include "contact_law/impact.h"

#include <math.h>

static const double EDGE = 1e-9;          /* share of the cone that is not used */
static const double MOST_DRIVEN = 2. / 3; /* h / d: see the head */
static const double NEARLY_JAMMED = 5e-8; /* v and both slips together, of a ball that is about
                                             to be jammed */

typedef struct pair {
  double x, y;
} pair;

static double size(pair a) {
  return sqrt(a.x * a.x + a.y * a.y);
}

static pair direction(pair a, pair otherwise) {
  const double s = size(a);
  return s > 0 ? (pair){a.x / s, a.y / s} : otherwise;
}

static double load(const carom_law *l, double f_y) {
  return l->g_0 + l->g_1 * f_y;
}

/* a' for given frictions. */
static pair driving_rate(const carom_law *l, pair f, pair F) {
  return (pair){l->K_x * f.x + l->C_x * F.x, l->A_0 + l->K_y * f.y + l->C_y * F.y};
}

/* The rate of b without friction of the cloth. */
static pair cloth_drive(const carom_law *l, pair f) {
  return (pair){l->L_x * f.x, l->B_0 + l->L_y * f.y};
}

/* The friction of a cloth that slips in the direction t, or bears no load. */
static pair cloth_friction(const carom_law *l, pair f, pair t) {
  const double g = l->mu_c * fmax(load(l, f.y), 0);
  return (pair){-g * t.x, -g * t.y};
}

/* The friction that holds the driving contact while the cloth slips in the direction t. */
static pair holding(const carom_law *l, pair t) {
  const double G_0 = l->g_0 - l->g_1 * l->A_0 / l->K_y;
  const double w = G_0 > 0 ? l->mu_c * G_0 / (1 - l->mu_c * l->g_1 * l->C_y / l->K_y * t.y) : 0;
  return (pair){l->C_x / l->K_x * w * t.x, (l->C_y * w * t.y - l->A_0) / l->K_y};
}

/* Whether friction holds the cloth under the friction f; H > 0 says that friction opposes slip. */
static bool cloth_holds(const carom_law *l, pair f) {
  return l->H > 0 && size(cloth_drive(l, f)) <= l->H * l->mu_c * load(l, f.y);
}

static bool within(pair f, double mu) {
  return size(f) <= (1 - EDGE) * mu;
}

/* Whether friction holds both contacts, once they do not slip. */
static bool both_hold(const carom_law *l) {
  const double det = l->K_y * l->H - l->C_y * l->L_y;
  const pair f = {0, (l->C_y * l->B_0 - l->H * l->A_0) / det},
             F = {0, (l->L_y * l->A_0 - l->K_y * l->B_0) / det};
  return l->H > 0 && within(f, l->mu) && load(l, f.y) > 0 && size(F) <= l->mu_c * load(l, f.y);
}

/* The regime where both slips are zero: the first of these that is consistent with its own
 * rates. Everything lies along y. False if none is. */
static bool from_rest(const carom_law *l, carom_regime *r) {
  const double mu = l->mu;
  if (both_hold(l)) {
    *r = (carom_regime){.held = true, .cloth_held = true};
    return true;
  }
  for (int side = 1; side >= -1; side -= 2) {
    /* the driving contact holds, the cloth's slip begins */
    const pair t = {0, side}, h = holding(l, t);
    if (within(h, mu)) {
      /* b' must point along t; a cloth without load is dragged along t = y */
      const pair drive = cloth_drive(l, h), w = cloth_friction(l, h, t);
      if (side * (drive.y + l->H * w.y) > 0 || (load(l, h.y) <= 0 && side > 0)) {
        *r = (carom_regime){.held = true, .loaded = load(l, h.y) > 0, .t_y = side};
        return true;
      }
    }
  }
  for (int side = 1; side >= -1; side -= 2) {
    /* the driving contact's slip begins; the cloth holds, or slips too */
    const pair u = {0, side}, s = {0, -mu * side};
    const bool stays = cloth_holds(l, s);
    const pair drive = cloth_drive(l, s), t = direction(drive, (pair){0, -1});
    pair w = cloth_friction(l, s, t);
    if (stays)
      w = (pair){0, -drive.y / l->H};
    /* a' must point along u */
    const pair rate = driving_rate(l, s, w);
    if (side * rate.y > 0) {
      *r = (carom_regime){.cloth_held = stays,
                          .loaded = !stays && load(l, s.y) > 0,
                          .u_x = u.x,
                          .u_y = u.y,
                          .t_x = t.x,
                          .t_y = t.y};
      return true;
    }
  }
  return false;
}

/* The regime that begins at a point, after *r. event: that of *r has ended it. False if no
 * regime is consistent. */
static bool choose(const carom_law *l, const carom_point *point, bool event, carom_regime *r) {
  const bool a_rests = l->mu > 0 && point->a_x == 0 && point->a_y == 0,
             b_rests = l->mu_c > 0 && point->b_x == 0 && point->b_y == 0;
  if (a_rests && b_rests)
    return from_rest(l, r);
  const carom_regime last = *r;
  *r = (carom_regime){.held = false};

  /* the driving contact: friction f holds it, or its slip begins, or it slips */
  pair u, f;
  if (a_rests) {
    const pair t = direction((pair){point->b_x, point->b_y}, (pair){0, -1});
    f = holding(l, t);
    r->held = within(f, l->mu) && !(event && last.held);
    if (!r->held) {
      u = direction((pair){-f.x, -f.y}, (pair){0, 1});
      r->u_x = u.x;
      r->u_y = u.y;
      f = (pair){-l->mu * u.x, -l->mu * u.y};
    }
  } else {
    u = direction((pair){point->a_x, point->a_y}, (pair){0, 0});
    f = (pair){-l->mu * u.x, -l->mu * u.y};
  }

  /* the load of the cloth; an event of two slipping contacts was its beginning or end */
  r->loaded = l->mu_c > 0 && load(l, f.y) > 0;
  if (event && !last.held && !last.cloth_held)
    r->loaded = !last.loaded;

  /* the cloth: friction holds it, or its slip begins */
  if (b_rests && r->loaded) {
    r->cloth_held = cloth_holds(l, f) && !(event && last.cloth_held);
    r->loaded = !r->cloth_held;
    const pair drive = cloth_drive(l, f), lead = direction(drive, (pair){0, -1});
    const double driven = -l->H * l->mu_c * load(l, f.y);
    if (r->loaded && driven > MOST_DRIVEN * size(drive))
      return false;
    r->t_x = lead.x;
    r->t_y = lead.y;
  }
  return true;
}

carom_terms carom_impact_terms(const carom_law *l, const carom_regime *r) {
  const double mu = l->mu;
  carom_terms k = {.A_0 = l->A_0,
                   .C_x = l->C_x,
                   .C_y = l->C_y,
                   .B_0 = l->B_0,
                   .H_x = l->H,
                   .H_y = l->H,
                   .V_0 = l->V_0,
                   .V_w = l->V_F,
                   .event = {-1}};
  if (r->held) {
    /* f from a' = 0, put into the rates of b and v */
    const double f = -l->A_0 / l->K_y, f_w = l->C_y / l->K_y;
    k.A_0 = k.C_x = k.C_y = 0;
    k.B_0 += l->L_y * f;
    k.H_x -= l->L_x * l->C_x / l->K_x;
    k.H_y -= l->L_y * f_w;
    k.V_0 += l->V_f * f;
    k.V_w -= l->V_f * f_w;
    if (r->loaded) {
      k.w_0 = l->mu_c * load(l, f);
      k.w_t = l->mu_c * l->g_1 * f_w;
      /* |f|^2 > mu^2 */
      k.event[0] = f * f - mu * mu;
      k.event[1] = 2 * f * f_w;
      k.event[2] = l->C_x / l->K_x * (l->C_x / l->K_x);
      k.event[3] = f_w * f_w;
    }
    return k;
  }
  k.S_x = -mu * l->K_x;
  k.S_y = -mu * l->K_y;
  k.R_x = -mu * l->L_x;
  k.R_y = -mu * l->L_y;
  k.V_u = -mu * l->V_f;
  const double g_u = -l->g_1 * mu;
  if (r->cloth_held) {
    /* F from b' = 0, put into the rates of a and v */
    const double per = 1 / l->H, c = mu * l->L_x * per, d = -l->B_0 * per, d_u = mu * l->L_y * per,
                 h = l->mu_c * l->g_0, h_u = l->mu_c * g_u;
    k.A_0 += l->C_y * d;
    k.S_x += l->C_x * c;
    k.S_y += l->C_y * d_u;
    k.V_0 += l->V_F * d;
    k.V_u += l->V_F * d_u;
    k.B_0 = k.R_x = k.R_y = 0;
    /* |F|^2 > (mu_c g)^2 */
    k.event[0] = d * d - h * h;
    k.event[1] = 2 * (d * d_u - h * h_u);
    k.event[2] = c * c;
    k.event[3] = d_u * d_u - h_u * h_u;
  } else if (r->loaded) {
    k.w_0 = l->mu_c * l->g_0;
    k.w_u = l->mu_c * g_u;
    /* the load falls below zero */
    k.event[0] = -l->g_0;
    k.event[1] = -g_u;
  } else if (l->mu_c > 0 && mu > 0) {
    /* the load rises above zero */
    k.event[0] = l->g_0;
    k.event[1] = g_u;
  }
  return k;
}

bool carom_impact_jams(const carom_trajectory *path) {
  const carom_point *point = &path->point;
  return fabs(point->v) + fabs(point->a_x) + fabs(point->a_y) + fabs(point->b_x) +
                 fabs(point->b_y) <
             NEARLY_JAMMED &&
         both_hold(&path->law);
}

bool carom_impact_regime(carom_trajectory *path, bool event) {
  if (!choose(&path->law, &path->point, event, &path->regime))
    return false;
  path->terms = carom_impact_terms(&path->law, &path->regime);
  path->event_at = INFINITY;
  return true;
}
