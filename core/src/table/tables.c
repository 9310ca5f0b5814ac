/* Tables from measures: cushions with pockets, as rule books give them, and those that are built
 * in.
 *
 * Rails end where the pockets' mouths begin; there a jaw, a cylinder, leads from the rail into
 * the pocket's facing. Each jaw is tangent to its rail and its facing at their ends. A mouth lies
 * between the points where its rails would meet its facings; a cut is the angle between both. With
 * c = cut - 90 degrees: a corner's points are q = mouth cos(45 degrees) from the corner; the jaw
 * takes d = jaw / tan(cut / 2) of rail and facing. Facings go back to the depth of the cushion. The
 * hole is a circle whose edge is the shelf behind the middle of the mouth. Source: pooltool's
 * generator, whose default table is CAROM_TABLE_POOLTOOL with its order of parts. */
#include "platform/elementary.h"
#include "table/table.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

/* What follows of the measures: cut - 90 degrees, of both pockets; what the facings lose to the
 * back for each m of depth; q; and d. */
typedef struct openings {
  double sin_c, cos_c, sin_s, cos_s, corner_back, side_back, q, dc, ds;
} openings;

static void add_rail(carom_table *t, double height, int side, double p_x, double p_y, double q_x,
                     double q_y) {
  carom_rail *r = &t->rail[t->rails++];
  *r = (carom_rail){.p = {p_x, p_y}, .q = {q_x, q_y}, .height = height, .side = side};
  /* the line as pooltool has it: by its slope, so that the side does not depend on the order of
   * p and q */
  if (p_x == q_x) {
    r->line[0] = 1.0;
    r->line[2] = -p_x;
  } else {
    const double slope = (q_y - p_y) / (q_x - p_x);
    r->line[0] = -slope;
    r->line[1] = 1.0;
    r->line[2] = slope * p_x - p_y;
  }
}

static void add_jaw(carom_table *t, double height, double radius, double x, double y) {
  t->jaw[t->jaws++] = (carom_jaw){.centre = {x, y}, .radius = radius, .height = height};
}

static void add_pocket(carom_table *t, double radius, double x, double y) {
  t->pocket[t->pockets++] = (carom_pocket){{x, y}, radius, 0.08};
}

static void add_plain_rails(carom_table *t, double h) {
  add_rail(t, h, 1, 0.0, 0.0, 0.0, t->length);
  add_rail(t, h, 0, t->width, t->length, t->width, 0.0);
  add_rail(t, h, 0, 0.0, t->length, t->width, t->length);
  add_rail(t, h, 1, 0.0, 0.0, t->width, 0.0);
}

static openings openings_of(const carom_measures *m) {
  openings f;
  double s, c;
  carom_sincos_degrees(45.0, &s, &c);
  f.q = m->corner_mouth * c;
  carom_sincos_degrees(m->corner_cut - 90.0, &f.sin_c, &f.cos_c);
  carom_sincos_degrees(m->side_cut - 90.0, &f.sin_s, &f.cos_s);
  carom_sincos_degrees(0.5 * m->corner_cut, &s, &c);
  f.dc = m->corner_jaw * c / s;
  carom_sincos_degrees(0.5 * m->side_cut, &s, &c);
  f.ds = m->side_jaw * c / s;
  f.corner_back = f.sin_c / f.cos_c;
  f.side_back = f.sin_s / f.cos_s;
  return f;
}

/* Where the rails of the six sides end, from the head and from the left. */
typedef struct rail_ends {
  double low, middle_low, middle_high, high, right;
} rail_ends;

static void add_sides(carom_table *t, double h, const rail_ends *e) {
  const double w = t->width, l = t->length;
  add_rail(t, h, 1, 0.0, e->low, 0.0, e->middle_low);
  add_rail(t, h, 1, 0.0, e->middle_high, 0.0, e->high);
  add_rail(t, h, 0, w, e->low, w, e->middle_low);
  add_rail(t, h, 0, w, e->middle_high, w, e->high);
  add_rail(t, h, 1, e->low, 0.0, e->right, 0.0);
  add_rail(t, h, 0, e->low, l, e->right, l);
}

static void add_facings_of_sides(carom_table *t, const carom_measures *m, const openings *f) {
  const double w = m->width, l = m->length, h = m->nose_height, cw = m->cushion_depth,
               sw = m->side_mouth, ds = f->ds;
  const double back_high = (l + sw) / 2.0 - cw * f->side_back,
               back_low = (l - sw) / 2.0 + cw * f->side_back;
  const double front_high = (l + sw) / 2.0 - ds * f->sin_s,
               front_low = (l - sw) / 2.0 + ds * f->sin_s;
  add_rail(t, h, 0, -cw, back_high, -ds * f->cos_s, front_high);
  add_rail(t, h, 1, -cw, back_low, -ds * f->cos_s, front_low);
  add_rail(t, h, 0, w + cw, back_high, w + ds * f->cos_s, front_high);
  add_rail(t, h, 1, w + cw, back_low, w + ds * f->cos_s, front_low);
}

static void add_facings_of_corners(carom_table *t, const carom_measures *m, const openings *f) {
  const double w = m->width, l = m->length, h = m->nose_height, cw = m->cushion_depth;
  const double back = f->q - cw * f->corner_back, front = f->q - f->dc * f->sin_c,
               in = f->dc * f->cos_c;
  add_rail(t, h, 1, back, -cw, front, -in);
  add_rail(t, h, 0, -cw, back, -in, front);
  add_rail(t, h, 0, back, l + cw, front, l + in);
  add_rail(t, h, 1, -cw, l - back, -in, l - front);
  add_rail(t, h, 1, w + cw, l - back, w + in, l - front);
  add_rail(t, h, 0, w - back, l + cw, w - front, l + in);
  add_rail(t, h, 0, w + cw, back, w + in, front);
  add_rail(t, h, 1, w - back, -cw, w - front, -in);
}

static void add_jaws(carom_table *t, const carom_measures *m, const rail_ends *e) {
  const double w = m->width, l = m->length, h = m->nose_height, rc = m->corner_jaw,
               rs = m->side_jaw;
  add_jaw(t, h, rc, e->low, -rc);
  add_jaw(t, h, rc, -rc, e->low);
  add_jaw(t, h, rs, -rs, e->middle_low);
  add_jaw(t, h, rs, -rs, e->middle_high);
  add_jaw(t, h, rc, -rc, e->high);
  add_jaw(t, h, rc, e->low, l + rc);
  add_jaw(t, h, rc, e->right, l + rc);
  add_jaw(t, h, rc, w + rc, e->high);
  add_jaw(t, h, rs, w + rs, e->middle_high);
  add_jaw(t, h, rs, w + rs, e->middle_low);
  add_jaw(t, h, rc, w + rc, e->low);
  add_jaw(t, h, rc, e->right, -rc);
}

static void add_holes(carom_table *t, const carom_measures *m) {
  const double w = m->width, l = m->length;
  double unused, c;
  carom_sincos_degrees(45.0, &unused, &c);
  const double off = (m->corner_shelf + m->corner_hole - 0.5 * m->corner_mouth) * c,
               out = m->side_shelf + m->side_hole;
  add_pocket(t, m->corner_hole, -off, -off);
  add_pocket(t, m->side_hole, -out, l / 2.0);
  add_pocket(t, m->corner_hole, -off, l + off);
  add_pocket(t, m->corner_hole, w + off, -off);
  add_pocket(t, m->side_hole, w + out, l / 2.0);
  add_pocket(t, m->corner_hole, w + off, l + off);
}

/* The parts of a table with pockets, in the order of pooltool. */
static void add_pockets(carom_table *t, const carom_measures *m, const openings *f) {
  const double w = m->width, l = m->length, sw = m->side_mouth;
  const rail_ends ends = {.low = f->q + f->dc,
                          .middle_low = (l - sw) / 2.0 - f->ds,
                          .middle_high = (l + sw) / 2.0 + f->ds,
                          .high = l - f->q - f->dc,
                          .right = w - f->q - f->dc};
  add_sides(t, m->nose_height, &ends);
  add_facings_of_sides(t, m, f);
  add_facings_of_corners(t, m, f);
  add_jaws(t, m, &ends);
  add_holes(t, m);
}

/* Facings, which follow the cushions of the six sides, and jaws have numbers of their own. */
static void give_facings(carom_table *t, const carom_measures *m) {
  static const int sides = 6;
  for (int k = sides; k < t->rails; k++) {
    t->rail[k].restitution = m->facing_restitution;
    t->rail[k].mu_cushion = m->facing_friction;
  }
  for (int k = 0; k < t->jaws; k++) {
    t->jaw[k].restitution = m->facing_restitution;
    t->jaw[k].mu_cushion = m->facing_friction;
  }
}

/* ---- The tables that are built in */

/* A line for each table, its corners, its sides, and its facings with the slope, which is 0. */
/* clang-format off */
/* Pool: the WPA's equipment specification: the middles of its ranges, mouths 4.5 to 4.625 and 5 to
 * 5.125 in, cuts 142 and 104 degrees, shelves 1 to 2.25 and 0 to 0.375 in, noses at 62.5 to 64.5 %
 * of the ball, cushions 1.875 to 2 in deep; 8 ft are those of homes, 7 ft those of bars. What it
 * leaves open, points and holes, is pooltool's. Facings and jaws: docs/reference/constants.md.
 */
#define WPA \
  0.03629025, 0.0492125, \
  0.1158875, 142.0, 0.041275, 0.02095, 0.062, \
  0.1285875, 104.0, 0.0047625, 0.00795, 0.0645, \
  0.8, 0.15, 0.0, 0.0
static const carom_measures built_in[] = {
  [CAROM_TABLE_POOL_7FT] = {0.9906, 1.9812, WPA},
  [CAROM_TABLE_POOL_8FT] = {1.1176, 2.2352, WPA},
  [CAROM_TABLE_POOL_9FT] = {1.27, 2.54, WPA},
  /* the playing area by the rules of the sport, whose templates of pockets are not published; nose
   * at 7/5 R as in the 2010 paper; parallel facings, well-rounded jaws */
  [CAROM_TABLE_SNOOKER] = {1.778, 3.569, 1.4 * 0.02625, 0.0508,
                           0.0865, 135.0, 0.02995, 0.07, 0.055,
                           0.0865, 90.0, 0.0085, 0.04, 0.05,
                           0.8, 0.2, 0.0, 0.0},
  [CAROM_TABLE_THREECUSHION] = {1.42, 2.84, .nose_height = 0.037},
  [CAROM_TABLE_POOLTOOL] = {0.9906, 1.9812, 0.036576, 0.0508,
                            0.118, 140.3, 0.0387, 0.02095, 0.062,
                            0.137, 97.14, 0.004, 0.00795, 0.0645,
                            0.0, 0.0, 0.0, 0.0},
  /* mouths of 85 and 86 mm as makers give them; else snooker's, with noses as in pool */
  [CAROM_TABLE_HEYBALL] = {1.27, 2.54, 0.03629025, 0.0508,
                           0.085, 135.0, 0.02995, 0.07, 0.055,
                           0.086, 90.0, 0.0085, 0.04, 0.05,
                           0.8, 0.15, 0.0, 0.0},
  /* the playing area of the WPA's 7 ft; the templates of pockets are not published: those of
   * snooker in the ratio of the balls */
  [CAROM_TABLE_BLACKBALL] = {0.9144, 1.8288, 1.27 * 0.0254, 0.0508,
                             0.0837, 135.0, 0.029, 0.068, 0.0533,
                             0.0837, 90.0, 0.0082, 0.039, 0.0485,
                             0.8, 0.15, 0.0, 0.0},
  /* mouths of 72 and 82 mm, noses at 5/8 of the ball; facings that are parallel, little rounded */
  [CAROM_TABLE_PYRAMID] = {1.775, 3.55, 0.0425, 0.0508,
                           0.0725, 135.0, 0.03, 0.008, 0.05,
                           0.0825, 90.0, 0.01, 0.008, 0.05,
                           0.8, 0.15, 0.0, 0.0},
  [CAROM_TABLE_FOURBALL] = {1.27, 2.54, .nose_height = 0.0394}};
/* clang-format on */

carom_status carom_table_measures(carom_table_kind kind, carom_measures *measures) {
  if (measures == NULL)
    return CAROM_ERROR_NULL;
  if ((uint32_t)kind >= sizeof built_in / sizeof *built_in)
    return CAROM_ERROR_TABLE_KIND;
  *measures = built_in[kind];
  return CAROM_OK;
}

/* The parts, without a check. */
static void make(const carom_measures *m, const openings *f, carom_table *table) {
  memset(table, 0, sizeof *table);
  table->width = m->width;
  table->length = m->length;
  table->slope_x = m->slope_x;
  table->slope_y = m->slope_y;
  if (m->corner_mouth == 0.0) {
    add_plain_rails(table, m->nose_height);
    return;
  }
  add_pockets(table, m, f);
  give_facings(table, m);
}

carom_status carom_table_make(carom_table_kind kind, carom_table *table) {
  if (table == NULL)
    return CAROM_ERROR_NULL;
  carom_measures m;
  const carom_status status = carom_table_measures(kind, &m);
  if (status != CAROM_OK)
    return status;
  const openings f = openings_of(&m);
  if (kind == CAROM_TABLE_POOLTOOL)
    *table = carom_table_pooltool;
  else
    make(&m, &f, table);
  return CAROM_OK;
}

/* ---- Tables of one's own */

/* The place of a member among the rows of measures. */
#define AT(member) ((int32_t)(offsetof(carom_measures, member) / sizeof(double)))

/* Tells which measure is at fault beside which other, and its bound by the others. */
static carom_status blame(carom_table_fault *fault, int32_t measure, int32_t second, double bound) {
  fault->part = (carom_part){CAROM_PART_MEASURES, measure};
  if (second >= 0)
    fault->other = (carom_part){CAROM_PART_MEASURES, second};
  fault->gap = bound;
  return CAROM_ERROR_TABLE;
}

/* Whether the parts of pockets have room: each condition bounds a measure from above. */
static carom_status check_room(const carom_measures *m, const openings *f,
                               carom_table_fault *fault) {
  const double cw = m->cushion_depth, root = m->corner_mouth / f->q;
  const struct {
    int32_t measure, second;
    double value, bound;
  } rules[] = {
      /* something is left of the short and the long rails */
      {AT(corner_mouth), AT(width), m->corner_mouth, (0.5 * m->width - f->dc) * root},
      {AT(side_mouth), AT(length), m->side_mouth, m->length - 2.0 * (f->q + f->dc + f->ds)},
      /* jaws end within their facings */
      {AT(corner_jaw), AT(cushion_depth), m->corner_jaw, cw * m->corner_jaw / (f->dc * f->cos_c)},
      {AT(side_jaw), AT(cushion_depth), m->side_jaw, cw * m->side_jaw / (f->ds * f->cos_s)},
      /* the facings of a pocket do not meet */
      {AT(cushion_depth), AT(corner_cut), cw,
       f->corner_back > 1.0 ? f->q / (f->corner_back - 1.0) : INFINITY},
      {AT(cushion_depth), AT(side_cut), cw,
       f->side_back > 0.0 ? 0.5 * m->side_mouth / f->side_back : INFINITY}};
  for (size_t k = 0; k < sizeof rules / sizeof *rules; k++)
    if (rules[k].value >= rules[k].bound)
      return blame(fault, rules[k].measure, rules[k].second, rules[k].bound);
  return CAROM_OK;
}

carom_status carom_table_measured(const carom_measures *measures, double ball_radius,
                                  carom_table *table, carom_table_fault *fault) {
  carom_table_fault unused;
  if (fault == NULL)
    fault = &unused;
  memset(fault, 0, sizeof *fault);
  if (measures == NULL || table == NULL)
    return CAROM_ERROR_NULL;
  memset(table, 0, sizeof *table);

  /* each by itself, those of pockets where there are some */
  const carom_number *n;
  const bool pockets = measures->corner_mouth != 0.0 || measures->side_mouth != 0.0;
  for (int k = 0; (n = carom_number_of(CAROM_PART_MEASURES, k)) != NULL; k++) {
    double x;
    memcpy(&x, (const char *)measures + n->offset, sizeof x);
    if ((pockets || k <= AT(nose_height) || k >= AT(slope_x)) && !(x >= n->low && x <= n->high))
      return blame(fault, k, -1, 0.0);
  }
  const openings f = openings_of(measures);
  carom_status status = CAROM_OK;
  if (pockets)
    status = check_room(measures, &f, fault);
  if (status != CAROM_OK)
    return status;
  make(measures, &f, table);
  return carom_table_check(table, ball_radius, fault);
}
