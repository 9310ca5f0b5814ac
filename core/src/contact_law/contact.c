/* The regime of the two contacts that begins where a slip is zero, and its coefficients.
 *
 * HOLDING. Where a = 0, the friction that keeps it there follows from a' = 0. With the cloth
 * slipping in the direction t under the load g, F = -mu_c g t, this is linear:
 *
 *     f_x = (C_x / K_x) mu_c g t_x        f_y = -A_0 / K_y + (C_y / K_y) mu_c g t_y
 *     g = G_0 / (1 - G_1 t_y)
 *     G_0 = g_0 - g_1 A_0 / K_y           G_1 = mu_c g_1 C_y / K_y
 *
 * so the cloth bears a load if and only if G_0 > 0. Where b = 0, b' = 0 requires F = -(L_x f_x,
 * B_0 + L_y f_y) / H. If friction holds both, f_x = F_x = 0, and v' = 0 for a cushion: the ball
 * is JAMMED, nothing changes any more, and the impact ends. A contact is held if this friction
 * is within the cone, |f| <= mu or |F| <= mu_c g. It is held until it leaves the cone.
 *
 * LEAVING. Where friction cannot hold, the slip begins in a direction to which its own rate is
 * parallel. On the cloth that is the direction of (0, B_0) + L f, which does not depend on F. At
 * the driving contact it is that of -h, h the friction that would hold it: a' = M (f - h) with
 * M_xx = K_x, M_xy = -C_x mu_c g_1 t_x, M_yy = K_y - C_y mu_c g_1 t_y, and by the numbers of
 * law.h M h = M_yy h for a cushion, so that f = mu h/|h| gives an a' along -h. For two balls h =
 * 0. Where both slips are zero all is symmetric about the y axis, and so are the directions.
 *
 * UNSTABLE. Where H < 0 friction drives the slip on the cloth. Let it begin at b = 0 with the rate
 * d without friction, and let only friction have the rate h. A slip that is not zero but an error e
 * continues in its own direction if h > d. If not, its component across d grows like |b|^(h / (d +
 * h)), to e^(d / (d + h)). At h = MOST_DRIVEN d a rounding error of 1e-16 becomes 2.5e-10; beyond
 * that there is no result.
 *
 * A frictionless contact has no direction and no cone. */
#include "contact_law/impact.h"

#include <math.h>

static const double EDGE = 1e-9;          /* fraction of the cone that is not used */
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
  const double length = size(a);
  return length > 0 ? (pair){a.x / length, a.y / length} : otherwise;
}

static double load(const carom_law *law, double f_y) {
  return law->g_0 + law->g_1 * f_y;
}

/* a' for given frictions. */
static pair driving_rate(const carom_law *law, pair f, pair F) {
  return (pair){law->K_x * f.x + law->C_x * F.x, law->A_0 + law->K_y * f.y + law->C_y * F.y};
}

/* The rate of b without friction of the cloth. */
static pair cloth_drive(const carom_law *law, pair f) {
  return (pair){law->L_x * f.x, law->B_0 + law->L_y * f.y};
}

/* The friction of a cloth that slips in the direction t, or bears no load. */
static pair cloth_friction(const carom_law *law, pair f, pair t) {
  const double g = law->mu_c * fmax(load(law, f.y), 0);
  return (pair){-g * t.x, -g * t.y};
}

/* The friction that holds the driving contact while the cloth slips in the direction t. */
static pair holding(const carom_law *law, pair t) {
  const double G_0 = law->g_0 - law->g_1 * law->A_0 / law->K_y;
  const double w =
      G_0 > 0 ? law->mu_c * G_0 / (1 - law->mu_c * law->g_1 * law->C_y / law->K_y * t.y) : 0;
  return (pair){law->C_x / law->K_x * w * t.x, (law->C_y * w * t.y - law->A_0) / law->K_y};
}

/* Whether friction holds the cloth under the friction f; H > 0 means that friction opposes slip. */
static bool cloth_holds(const carom_law *law, pair f) {
  return law->H > 0 && size(cloth_drive(law, f)) <= law->H * law->mu_c * load(law, f.y);
}

static bool within(pair f, double mu) {
  return size(f) <= (1 - EDGE) * mu;
}

/* Whether friction holds both contacts, once they do not slip. */
static bool both_hold(const carom_law *law) {
  const double det = law->K_y * law->H - law->C_y * law->L_y;
  const pair f = {0, (law->C_y * law->B_0 - law->H * law->A_0) / det},
             F = {0, (law->L_y * law->A_0 - law->K_y * law->B_0) / det};
  return law->H > 0 && within(f, law->mu) && load(law, f.y) > 0 &&
         size(F) <= law->mu_c * load(law, f.y);
}

/* The regime where both slips are zero: the first of these that is consistent with its own
 * rates. Everything is along y. False if none is. */
static bool from_rest(const carom_law *law, carom_regime *regime) {
  const double mu = law->mu;
  if (both_hold(law)) {
    *regime = (carom_regime){.held = true, .cloth_held = true};
    return true;
  }
  for (int side = 1; side >= -1; side -= 2) {
    /* the driving contact holds, the cloth's slip begins */
    const pair t = {0, side}, hold = holding(law, t);
    if (within(hold, mu)) {
      /* b' must point along t; a cloth without load is dragged along t = y */
      const pair drive = cloth_drive(law, hold), of_cloth = cloth_friction(law, hold, t);
      if (side * (drive.y + law->H * of_cloth.y) > 0 || (load(law, hold.y) <= 0 && side > 0)) {
        *regime = (carom_regime){.held = true, .loaded = load(law, hold.y) > 0, .t_y = side};
        return true;
      }
    }
  }
  for (int side = 1; side >= -1; side -= 2) {
    /* the driving contact's slip begins; the cloth holds, or slips too */
    const pair u = {0, side}, friction = {0, -mu * side};
    const bool stays = cloth_holds(law, friction);
    const pair drive = cloth_drive(law, friction), t = direction(drive, (pair){0, -1});
    pair of_cloth = cloth_friction(law, friction, t);
    if (stays)
      of_cloth = (pair){0, -drive.y / law->H};
    /* a' must point along u */
    const pair rate = driving_rate(law, friction, of_cloth);
    if (side * rate.y > 0) {
      *regime = (carom_regime){.cloth_held = stays,
                               .loaded = !stays && load(law, friction.y) > 0,
                               .u_x = u.x,
                               .u_y = u.y,
                               .t_x = t.x,
                               .t_y = t.y};
      return true;
    }
  }
  return false;
}

/* The regime that begins at a point, after *regime. event: the event of *regime has ended it. False
 * if no regime is consistent. */
static bool choose(const carom_law *law, const carom_point *point, bool event,
                   carom_regime *regime) {
  const bool a_rests = law->mu > 0 && point->a_x == 0 && point->a_y == 0,
             b_rests = law->mu_c > 0 && point->b_x == 0 && point->b_y == 0;
  if (a_rests && b_rests)
    return from_rest(law, regime);
  const carom_regime last = *regime;
  *regime = (carom_regime){.held = false};

  /* the driving contact: friction f holds it, or its slip begins, or it slips */
  pair u, f;
  if (a_rests) {
    const pair t = direction((pair){point->b_x, point->b_y}, (pair){0, -1});
    f = holding(law, t);
    regime->held = within(f, law->mu) && !(event && last.held);
    if (!regime->held) {
      u = direction((pair){-f.x, -f.y}, (pair){0, 1});
      regime->u_x = u.x;
      regime->u_y = u.y;
      f = (pair){-law->mu * u.x, -law->mu * u.y};
    }
  } else {
    u = direction((pair){point->a_x, point->a_y}, (pair){0, 0});
    f = (pair){-law->mu * u.x, -law->mu * u.y};
  }

  /* the load of the cloth; an event of two slipping contacts was its beginning or end */
  regime->loaded = law->mu_c > 0 && load(law, f.y) > 0;
  if (event && !last.held && !last.cloth_held)
    regime->loaded = !last.loaded;

  /* the cloth: friction holds it, or its slip begins */
  if (b_rests && regime->loaded) {
    regime->cloth_held = cloth_holds(law, f) && !(event && last.cloth_held);
    regime->loaded = !regime->cloth_held;
    const pair drive = cloth_drive(law, f), lead = direction(drive, (pair){0, -1});
    const double driven = -law->H * law->mu_c * load(law, f.y);
    if (regime->loaded && driven > MOST_DRIVEN * size(drive))
      return false;
    regime->t_x = lead.x;
    regime->t_y = lead.y;
  }
  return true;
}

carom_terms carom_impact_terms(const carom_law *law, const carom_regime *regime) {
  const double mu = law->mu;
  carom_terms terms = {.A_0 = law->A_0,
                       .C_x = law->C_x,
                       .C_y = law->C_y,
                       .B_0 = law->B_0,
                       .H_x = law->H,
                       .H_y = law->H,
                       .V_0 = law->V_0,
                       .V_w = law->V_F,
                       .event = {-1}};
  if (regime->held) {
    /* f from a' = 0, f_y = f_0 + f_w w t_y, put into the rates of b and v */
    const double f_0 = -law->A_0 / law->K_y, f_w = law->C_y / law->K_y;
    terms.A_0 = terms.C_x = terms.C_y = 0;
    terms.B_0 += law->L_y * f_0;
    terms.H_x -= law->L_x * law->C_x / law->K_x;
    terms.H_y -= law->L_y * f_w;
    terms.V_0 += law->V_f * f_0;
    terms.V_w -= law->V_f * f_w;
    if (regime->loaded) {
      terms.w_0 = law->mu_c * load(law, f_0);
      terms.w_t = law->mu_c * law->g_1 * f_w;
      /* |f|^2 > mu^2 */
      terms.event[0] = f_0 * f_0 - mu * mu;
      terms.event[1] = 2 * f_0 * f_w;
      terms.event[2] = law->C_x / law->K_x * (law->C_x / law->K_x);
      terms.event[3] = f_w * f_w;
    }
    return terms;
  }

  /* the driving contact slips, f = -mu u, and with it the load changes by g_u u_y */
  terms.S_x = -mu * law->K_x;
  terms.S_y = -mu * law->K_y;
  terms.R_x = -mu * law->L_x;
  terms.R_y = -mu * law->L_y;
  terms.V_u = -mu * law->V_f;
  const double g_u = -law->g_1 * mu;
  if (regime->cloth_held) {
    /* F from b' = 0, F_x = F_x_u u_x and F_y = F_y_0 + F_y_u u_y, put into the rates of a and v;
     * the size of its cone is cone_0 + cone_u u_y */
    const double per = 1 / law->H;
    const double F_x_u = mu * law->L_x * per;
    const double F_y_0 = -law->B_0 * per, F_y_u = mu * law->L_y * per;
    const double cone_0 = law->mu_c * law->g_0, cone_u = law->mu_c * g_u;
    terms.A_0 += law->C_y * F_y_0;
    terms.S_x += law->C_x * F_x_u;
    terms.S_y += law->C_y * F_y_u;
    terms.V_0 += law->V_F * F_y_0;
    terms.V_u += law->V_F * F_y_u;
    terms.B_0 = terms.R_x = terms.R_y = 0;
    /* |F|^2 > (mu_c g)^2 */
    terms.event[0] = F_y_0 * F_y_0 - cone_0 * cone_0;
    terms.event[1] = 2 * (F_y_0 * F_y_u - cone_0 * cone_u);
    terms.event[2] = F_x_u * F_x_u;
    terms.event[3] = F_y_u * F_y_u - cone_u * cone_u;
  } else if (regime->loaded) {
    terms.w_0 = law->mu_c * law->g_0;
    terms.w_u = law->mu_c * g_u;
    /* the load falls below zero */
    terms.event[0] = -law->g_0;
    terms.event[1] = -g_u;
  } else if (law->mu_c > 0 && mu > 0) {
    /* the load rises above zero */
    terms.event[0] = law->g_0;
    terms.event[1] = g_u;
  }
  return terms;
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
