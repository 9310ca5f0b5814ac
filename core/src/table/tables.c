/* Tables from measures: cushions with pockets, as rule books give them, and those that are built
 * in.
 *
 *                   |<-- mouth -->|
 *     rail  __________           __________  rail
 *                     '.       .'               jaws, tangent to rail and facing
 *                      /       \
 *             facing  /  .---.  \  facing       cut: the angle between rail and facing
 *                    /  ( hole ) \
 *                        '---'
 *
 * Rails end where the pockets' mouths begin; there a jaw, a cylinder, leads from the rail into the
 * pocket's facing. Each jaw is tangent to its rail and its facing at their ends. A mouth is the
 * distance between the points where its rails would meet its facings; a cut is the angle between
 * both. With c = cut - 90 degrees: a corner's points are q = mouth cos(45 degrees) from the corner;
 * the jaw takes d = jaw / tan(cut / 2) of rail and facing. Facings go back to the depth of the
 * cushion. The hole is a circle whose edge is the shelf behind the middle of the mouth. Source:
 * pooltool's generator, whose default table is CAROM_TABLE_POOLTOOL with its order of parts. */
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

static void add_rail(carom_table *table, double height, int side, double p_x, double p_y,
                     double q_x, double q_y) {
  carom_rail *rail = &table->rail[table->rails++];
  *rail = (carom_rail){.p = {p_x, p_y}, .q = {q_x, q_y}, .height = height, .side = side};
  /* the line as pooltool has it: by its slope, so that the side does not depend on the order of
   * p and q */
  if (p_x == q_x) {
    rail->line[0] = 1.0;
    rail->line[2] = -p_x;
  } else {
    const double slope = (q_y - p_y) / (q_x - p_x);
    rail->line[0] = -slope;
    rail->line[1] = 1.0;
    rail->line[2] = slope * p_x - p_y;
  }
}

static void add_jaw(carom_table *table, double height, double radius, double x, double y) {
  table->jaw[table->jaws++] = (carom_jaw){.centre = {x, y}, .radius = radius, .height = height};
}

static void add_pocket(carom_table *table, double radius, double x, double y) {
  table->pocket[table->pockets++] = (carom_pocket){{x, y}, radius, 0.08};
}

static void add_plain_rails(carom_table *table, double nose) {
  add_rail(table, nose, 1, 0.0, 0.0, 0.0, table->length);
  add_rail(table, nose, 0, table->width, table->length, table->width, 0.0);
  add_rail(table, nose, 0, 0.0, table->length, table->width, table->length);
  add_rail(table, nose, 1, 0.0, 0.0, table->width, 0.0);
}

static openings openings_of(const carom_measures *measures) {
  openings opening;
  double sine, cosine;
  carom_sincos_degrees(45.0, &sine, &cosine);
  opening.q = measures->corner_mouth * cosine;
  carom_sincos_degrees(measures->corner_cut - 90.0, &opening.sin_c, &opening.cos_c);
  carom_sincos_degrees(measures->side_cut - 90.0, &opening.sin_s, &opening.cos_s);
  carom_sincos_degrees(0.5 * measures->corner_cut, &sine, &cosine);
  opening.dc = measures->corner_jaw * cosine / sine;
  carom_sincos_degrees(0.5 * measures->side_cut, &sine, &cosine);
  opening.ds = measures->side_jaw * cosine / sine;
  opening.corner_back = opening.sin_c / opening.cos_c;
  opening.side_back = opening.sin_s / opening.cos_s;
  return opening;
}

/* Where the rails of the six sides end, from the head and from the left. */
typedef struct rail_ends {
  double low, middle_low, middle_high, high, right;
} rail_ends;

static void add_sides(carom_table *table, double nose, const rail_ends *ends) {
  const double width = table->width, length = table->length;
  add_rail(table, nose, 1, 0.0, ends->low, 0.0, ends->middle_low);
  add_rail(table, nose, 1, 0.0, ends->middle_high, 0.0, ends->high);
  add_rail(table, nose, 0, width, ends->low, width, ends->middle_low);
  add_rail(table, nose, 0, width, ends->middle_high, width, ends->high);
  add_rail(table, nose, 1, ends->low, 0.0, ends->right, 0.0);
  add_rail(table, nose, 0, ends->low, length, ends->right, length);
}

static void add_facings_of_sides(carom_table *table, const carom_measures *measures,
                                 const openings *opening) {
  const double width = measures->width, length = measures->length, nose = measures->nose_height,
               cw = measures->cushion_depth, sw = measures->side_mouth, ds = opening->ds;
  const double back_high = (length + sw) / 2.0 - cw * opening->side_back,
               back_low = (length - sw) / 2.0 + cw * opening->side_back;
  const double front_high = (length + sw) / 2.0 - ds * opening->sin_s,
               front_low = (length - sw) / 2.0 + ds * opening->sin_s;
  add_rail(table, nose, 0, -cw, back_high, -ds * opening->cos_s, front_high);
  add_rail(table, nose, 1, -cw, back_low, -ds * opening->cos_s, front_low);
  add_rail(table, nose, 0, width + cw, back_high, width + ds * opening->cos_s, front_high);
  add_rail(table, nose, 1, width + cw, back_low, width + ds * opening->cos_s, front_low);
}

static void add_facings_of_corners(carom_table *table, const carom_measures *measures,
                                   const openings *opening) {
  const double width = measures->width, length = measures->length, nose = measures->nose_height,
               cw = measures->cushion_depth;
  const double back = opening->q - cw * opening->corner_back,
               front = opening->q - opening->dc * opening->sin_c, in = opening->dc * opening->cos_c;
  add_rail(table, nose, 1, back, -cw, front, -in);
  add_rail(table, nose, 0, -cw, back, -in, front);
  add_rail(table, nose, 0, back, length + cw, front, length + in);
  add_rail(table, nose, 1, -cw, length - back, -in, length - front);
  add_rail(table, nose, 1, width + cw, length - back, width + in, length - front);
  add_rail(table, nose, 0, width - back, length + cw, width - front, length + in);
  add_rail(table, nose, 0, width + cw, back, width + in, front);
  add_rail(table, nose, 1, width - back, -cw, width - front, -in);
}

static void add_jaws(carom_table *table, const carom_measures *measures, const rail_ends *ends) {
  const double width = measures->width, length = measures->length, nose = measures->nose_height,
               rc = measures->corner_jaw, rs = measures->side_jaw;
  add_jaw(table, nose, rc, ends->low, -rc);
  add_jaw(table, nose, rc, -rc, ends->low);
  add_jaw(table, nose, rs, -rs, ends->middle_low);
  add_jaw(table, nose, rs, -rs, ends->middle_high);
  add_jaw(table, nose, rc, -rc, ends->high);
  add_jaw(table, nose, rc, ends->low, length + rc);
  add_jaw(table, nose, rc, ends->right, length + rc);
  add_jaw(table, nose, rc, width + rc, ends->high);
  add_jaw(table, nose, rs, width + rs, ends->middle_high);
  add_jaw(table, nose, rs, width + rs, ends->middle_low);
  add_jaw(table, nose, rc, width + rc, ends->low);
  add_jaw(table, nose, rc, ends->right, -rc);
}

static void add_holes(carom_table *table, const carom_measures *measures) {
  const double width = measures->width, length = measures->length;
  double unused, cosine;
  carom_sincos_degrees(45.0, &unused, &cosine);
  const double off =
                   (measures->corner_shelf + measures->corner_hole - 0.5 * measures->corner_mouth) *
                   cosine,
               out = measures->side_shelf + measures->side_hole;
  add_pocket(table, measures->corner_hole, -off, -off);
  add_pocket(table, measures->side_hole, -out, length / 2.0);
  add_pocket(table, measures->corner_hole, -off, length + off);
  add_pocket(table, measures->corner_hole, width + off, -off);
  add_pocket(table, measures->side_hole, width + out, length / 2.0);
  add_pocket(table, measures->corner_hole, width + off, length + off);
}

/* The parts of a table with pockets, in the order of pooltool. */
static void add_pockets(carom_table *table, const carom_measures *measures,
                        const openings *opening) {
  const double width = measures->width, length = measures->length, sw = measures->side_mouth;
  const rail_ends ends = {.low = opening->q + opening->dc,
                          .middle_low = (length - sw) / 2.0 - opening->ds,
                          .middle_high = (length + sw) / 2.0 + opening->ds,
                          .high = length - opening->q - opening->dc,
                          .right = width - opening->q - opening->dc};
  add_sides(table, measures->nose_height, &ends);
  add_facings_of_sides(table, measures, opening);
  add_facings_of_corners(table, measures, opening);
  add_jaws(table, measures, &ends);
  add_holes(table, measures);
}

/* Facings, which follow the cushions of the six sides, and jaws have their own constants. */
static void give_facings(carom_table *table, const carom_measures *measures) {
  static const int sides = 6;
  for (int index = sides; index < table->rails; index++) {
    table->rail[index].restitution = measures->facing_restitution;
    table->rail[index].mu_cushion = measures->facing_friction;
  }
  for (int index = 0; index < table->jaws; index++) {
    table->jaw[index].restitution = measures->facing_restitution;
    table->jaw[index].mu_cushion = measures->facing_friction;
  }
}

/* ---- The tables that are built in */

/* A line for each table, its corners, its sides, and its facings with the slope, which is 0. */
/* clang-format off */
/* Pool: the WPA's equipment specification: the middles of its ranges, mouths 4.5 to 4.625 and 5 to
 * 5.125 in, cuts 142 and 104 degrees, shelves 1 to 2.25 and 0 to 0.375 in, noses at 62.5 to 64.5 %
 * of the ball, cushions 1.875 to 2 in deep; 8 ft is the size in homes, 7 ft in bars. What it leaves
 * open, points and holes, is pooltool's. Facings and jaws: docs/reference/constants.md.
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
  /* the playing area of the WPA's 7 ft; the templates of pockets are not published: the snooker
   * pockets, scaled by the ratio of the balls */
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
static void make(const carom_measures *measures, const openings *opening, carom_table *table) {
  memset(table, 0, sizeof *table);
  table->width = measures->width;
  table->length = measures->length;
  table->slope_x = measures->slope_x;
  table->slope_y = measures->slope_y;
  if (measures->corner_mouth == 0.0) {
    add_plain_rails(table, measures->nose_height);
    return;
  }
  add_pockets(table, measures, opening);
  give_facings(table, measures);
}

carom_status carom_table_make(carom_table_kind kind, carom_table *table) {
  if (table == NULL)
    return CAROM_ERROR_NULL;
  carom_measures measures;
  const carom_status status = carom_table_measures(kind, &measures);
  if (status != CAROM_OK)
    return status;
  const openings opening = openings_of(&measures);
  if (kind == CAROM_TABLE_POOLTOOL)
    *table = carom_table_pooltool;
  else
    make(&measures, &opening, table);
  return CAROM_OK;
}

/* ---- Tables of one's own */

/* The position of a member among the rows of measures. */
#define AT(member) ((int32_t)(offsetof(carom_measures, member) / sizeof(double)))

/* Reports which measure is at fault together with which other, and its bound by the others. */
static carom_status blame(carom_table_fault *fault, int32_t measure, int32_t second, double bound) {
  fault->part = (carom_part){CAROM_PART_MEASURES, measure};
  if (second >= 0)
    fault->other = (carom_part){CAROM_PART_MEASURES, second};
  fault->gap = bound;
  return CAROM_ERROR_TABLE;
}

/* Whether the parts of pockets have room: each condition bounds a measure from above. */
static carom_status check_room(const carom_measures *measures, const openings *opening,
                               carom_table_fault *fault) {
  const double cw = measures->cushion_depth, root = measures->corner_mouth / opening->q;
  const struct {
    int32_t measure, second;
    double value, bound;
  } rules[] = {
      /* something is left of the short and the long rails */
      {AT(corner_mouth), AT(width), measures->corner_mouth,
       (0.5 * measures->width - opening->dc) * root},
      {AT(side_mouth), AT(length), measures->side_mouth,
       measures->length - 2.0 * (opening->q + opening->dc + opening->ds)},
      /* jaws end within their facings */
      {AT(corner_jaw), AT(cushion_depth), measures->corner_jaw,
       cw * measures->corner_jaw / (opening->dc * opening->cos_c)},
      {AT(side_jaw), AT(cushion_depth), measures->side_jaw,
       cw * measures->side_jaw / (opening->ds * opening->cos_s)},
      /* the facings of a pocket do not meet */
      {AT(cushion_depth), AT(corner_cut), cw,
       opening->corner_back > 1.0 ? opening->q / (opening->corner_back - 1.0) : INFINITY},
      {AT(cushion_depth), AT(side_cut), cw,
       opening->side_back > 0.0 ? 0.5 * measures->side_mouth / opening->side_back : INFINITY}};
  for (size_t index = 0; index < sizeof rules / sizeof *rules; index++)
    if (rules[index].value >= rules[index].bound)
      return blame(fault, rules[index].measure, rules[index].second, rules[index].bound);
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

  /* each by itself, the measures of pockets only if there are some */
  const carom_number *number;
  const bool pockets = measures->corner_mouth != 0.0 || measures->side_mouth != 0.0;
  for (int k = 0; (number = carom_number_of(CAROM_PART_MEASURES, k)) != NULL; k++) {
    double value;
    memcpy(&value, (const char *)measures + number->offset, sizeof value);
    if ((pockets || k <= AT(nose_height) || k >= AT(slope_x)) &&
        !(value >= number->low && value <= number->high))
      return blame(fault, k, -1, 0.0);
  }
  const openings opening = openings_of(measures);
  carom_status status = CAROM_OK;
  if (pockets)
    status = check_room(measures, &opening, fault);
  if (status != CAROM_OK)
    return status;
  make(measures, &opening, table);
  return carom_table_check(table, ball_radius, fault);
}
