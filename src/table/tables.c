/* Built-in tables: cushions with pockets from a few measures of a table.
 *
 * Rails end where the pockets' mouths begin; there a jaw, a cylinder, leads from the rail into
 * the pocket's facing. Each jaw is tangent to its rail and its facing at their ends. With ca =
 * 45 degrees + angle at corners and sa = angle at sides: a corner's rails would meet its facings
 * at q = width cos(45 degrees) from the corner; the jaw takes dc = rc / tan((90 degrees + ca) /
 * 2) of both, at a side ds = rs / tan((90 degrees + sa) / 2). Facings go back to the depth of
 * the cushion. Source: pooltool's generator, whose default table is CAROM_TABLE_POOL_7FT with
 * its order of parts. */
#include "platform/elementary.h"
#include "table/table.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

typedef struct measures {
  double width, length, cushion, height;
  double corner_width, corner_angle, corner_depth, corner_radius, corner_jaw; /* m, degrees */
  double side_width, side_angle, side_depth, side_radius, side_jaw;
} measures;

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

static void add_pockets(carom_table *t, const measures *m) {
  const double w = m->width, l = m->length, h = m->height, cw = m->cushion, rc = m->corner_jaw,
               rs = m->side_jaw, sw = m->side_width;
  double sin_c, cos_c, sin_s, cos_s, s, c;
  carom_sincos_degrees(45.0, &s, &c);
  const double q = m->corner_width * c, off = m->corner_depth * c;
  carom_sincos_degrees(45.0 + m->corner_angle, &sin_c, &cos_c);
  carom_sincos_degrees(m->side_angle, &sin_s, &cos_s);
  const double tan_c = sin_c / cos_c;
  carom_sincos_degrees(0.5 * (135.0 + m->corner_angle), &s, &c);
  const double dc = rc * c / s;
  carom_sincos_degrees(0.5 * (90.0 + m->side_angle), &s, &c);
  const double ds = rs * c / s;

  /* rails */
  const double low = q + dc, middle_low = (l - sw) / 2.0 - ds, middle_high = (l + sw) / 2.0 + ds,
               high = l - q - dc;
  add_rail(t, h, 1, 0.0, low, 0.0, middle_low);
  add_rail(t, h, 1, 0.0, middle_high, 0.0, high);
  add_rail(t, h, 0, w, low, w, middle_low);
  add_rail(t, h, 0, w, middle_high, w, high);
  add_rail(t, h, 1, low, 0.0, w - q - dc, 0.0);
  add_rail(t, h, 0, low, l, w - q - dc, l);

  /* facings of the side pockets */
  const double back_high = (l + sw) / 2.0 - cw * sin_s, back_low = (l - sw) / 2.0 + cw * sin_s;
  const double front_high = (l + sw) / 2.0 - ds * sin_s, front_low = (l - sw) / 2.0 + ds * sin_s;
  add_rail(t, h, 0, -cw, back_high, -ds * cos_s, front_high);
  add_rail(t, h, 1, -cw, back_low, -ds * cos_s, front_low);
  add_rail(t, h, 0, w + cw, back_high, w + ds * cos_s, front_high);
  add_rail(t, h, 1, w + cw, back_low, w + ds * cos_s, front_low);

  /* facings of the corner pockets */
  const double back = q - cw * tan_c, front = q - dc * sin_c, in = dc * cos_c;
  add_rail(t, h, 1, back, -cw, front, -in);
  add_rail(t, h, 0, -cw, back, -in, front);
  add_rail(t, h, 0, back, l + cw, front, l + in);
  add_rail(t, h, 1, -cw, l - back, -in, l - front);
  add_rail(t, h, 1, w + cw, l - back, w + in, l - front);
  add_rail(t, h, 0, w - back, l + cw, w - front, l + in);
  add_rail(t, h, 0, w + cw, back, w + in, front);
  add_rail(t, h, 1, w - back, -cw, w - front, -in);

  /* jaws */
  add_jaw(t, h, rc, low, -rc);
  add_jaw(t, h, rc, -rc, low);
  add_jaw(t, h, rs, -rs, middle_low);
  add_jaw(t, h, rs, -rs, middle_high);
  add_jaw(t, h, rc, -rc, high);
  add_jaw(t, h, rc, low, l + rc);
  add_jaw(t, h, rc, w - q - dc, l + rc);
  add_jaw(t, h, rc, w + rc, high);
  add_jaw(t, h, rs, w + rs, middle_high);
  add_jaw(t, h, rs, w + rs, middle_low);
  add_jaw(t, h, rc, w + rc, low);
  add_jaw(t, h, rc, w - q - dc, -rc);

  /* pockets */
  add_pocket(t, m->corner_radius, -off, -off);
  add_pocket(t, m->side_radius, -m->side_depth, l / 2.0);
  add_pocket(t, m->corner_radius, -off, l + off);
  add_pocket(t, m->corner_radius, w + off, -off);
  add_pocket(t, m->side_radius, w + m->side_depth, l / 2.0);
  add_pocket(t, m->corner_radius, w + off, l + off);
}

static measures pool(double length) {
  return (measures){.width = length / 2.0,
                    .length = length,
                    .cushion = 0.0508,
                    .height = 0.64 * 2.0 * 0.028575,
                    .corner_width = 0.118,
                    .corner_angle = 5.3,
                    .corner_depth = 0.0417,
                    .corner_radius = 0.062,
                    .corner_jaw = 0.02095,
                    .side_width = 0.137,
                    .side_angle = 7.14,
                    .side_depth = 0.0685,
                    .side_radius = 0.0645,
                    .side_jaw = 0.00795};
}

/* A snooker table's playing area by the rules of the sport; nose at 7/5 R as in the 2010 paper;
 * pockets with parallel facings and well-rounded jaws. */
static measures snooker(void) {
  return (measures){.width = 1.778,
                    .length = 3.569,
                    .cushion = 0.0508,
                    .height = 1.4 * 0.02619375,
                    .corner_width = 0.0865,
                    .corner_depth = 0.0417,
                    .corner_radius = 0.055,
                    .corner_jaw = 0.07,
                    .side_width = 0.0865,
                    .side_depth = 0.0585,
                    .side_radius = 0.05,
                    .side_jaw = 0.04};
}

carom_status carom_table_make(carom_table_kind kind, carom_table *table) {
  if (table == NULL)
    return CAROM_ERROR_NULL;

  /* what the builders of each kind say */
  measures m;
  switch (kind) {
  case CAROM_TABLE_POOL_7FT:
  case CAROM_TABLE_POOLTOOL:
    *table = carom_table_pooltool;
    return CAROM_OK;
  case CAROM_TABLE_POOL_8FT:
    m = pool(2.2352);
    break;
  case CAROM_TABLE_POOL_9FT:
    m = pool(2.54);
    break;
  case CAROM_TABLE_SNOOKER:
    m = snooker();
    break;
  case CAROM_TABLE_THREECUSHION:
    m = (measures){.width = 1.42, .length = 2.84, .height = 0.037};
    break;
  default:
    return CAROM_ERROR_TABLE;
  }

  /* rails, and with pockets the jaws of their mouths */
  memset(table, 0, sizeof *table);
  table->width = m.width;
  table->length = m.length;
  if (kind == CAROM_TABLE_THREECUSHION)
    add_plain_rails(table, m.height);
  else
    add_pockets(table, &m);
  return CAROM_OK;
}
