/* A table from above: wood, cloth, cushions, pockets and their names, diamonds, axes. Long tables
 * lie on their side: y of the table runs to the right. */
#include "pictures/table_picture.h"

#include "pictures/colours.h"
#include "pictures/palette.h"
#include "pictures/picture.h"
#include "shots/shot_story.h"

#include <math.h>
#include <string.h>

static const double table_scale = 400.0; /* pixels a metre */

double across(const view *v, const double r[2]) {
  const int axis = v->turned;
  return v->scale * (r[axis] - v->low[axis] + v->margin);
}
double down(const view *v, const double r[2]) {
  if (v->turned)
    return v->scale * (r[0] - v->low[0] + v->margin);
  return v->scale * (v->high[1] - r[1] + v->margin);
}

view view_of(FILE *out, const carom_table *t) {
  view v = {.out = out,
            .low = {INFINITY, INFINITY},
            .high = {-INFINITY, -INFINITY},
            .scale = table_scale};
  for (int k = 0; k < t->rails; k++)
    for (int axis = 0; axis < 2; axis++) {
      const double p = t->rail[k].p[axis], q = t->rail[k].q[axis];
      v.low[axis] = fmin(v.low[axis], fmin(p, q));
      v.high[axis] = fmax(v.high[axis], fmax(p, q));
    }
  v.turned = v.high[1] - v.low[1] > v.high[0] - v.low[0];
  v.margin = PALETTE_SIZE_MARGIN * fmax(v.high[0] - v.low[0], v.high[1] - v.low[1]);
  return v;
}

/* The rectangle of the noses. */
static void noses_of(const carom_table *t, double low[2], double high[2]) {
  for (int axis = 0; axis < 2; axis++) {
    low[axis] = INFINITY;
    high[axis] = -INFINITY;
    for (int k = 0; k < t->rails; k++)
      if (is_cushion(t, k)) {
        low[axis] = fmin(low[axis], fmin(t->rail[k].p[axis], t->rail[k].q[axis]));
        high[axis] = fmax(high[axis], fmax(t->rail[k].p[axis], t->rail[k].q[axis]));
      }
  }
}

/* Diamonds on the wood: the long cushions in eight parts, the short ones in four. None where a
 * pocket is. */
static void draw_diamonds(const view *v, const carom_table *t) {
  double low[2], high[2];
  noses_of(t, low, high);
  const int along = high[1] - low[1] > high[0] - low[0]; /* the axis of the long ones */
  const double tall = v->scale * PALETTE_SIZE_DIAMOND, wide = v->scale * PALETTE_SIZE_DIAMOND_WIDTH;
  for (int axis = 0; axis < 2; axis++) {
    const int parts = axis == along ? 8 : 4, cross_axis = 1 - axis;
    const double edges[2] = {v->low[cross_axis] - 0.75 * v->margin,
                             v->high[cross_axis] + 0.75 * v->margin};
    for (int k = 1; k < parts; k++)
      for (int side = 0; side < 2 && (axis != along || k != 4 || t->pockets == 0); side++) {
        double r[2];
        r[axis] = low[axis] + (high[axis] - low[axis]) * k / parts;
        r[cross_axis] = edges[side];
        fprintf(v->out,
                "<path d=\"M%.1f %.1fl%.1f %.1fl%.1f %.1fl%.1f %.1fZ\" fill=\"" PALETTE_MARK
                "\"/>\n",
                across(v, r), down(v, r) - tall, wide, tall, -wide, tall, -wide, -tall);
      }
  }
}

/* The names of the pockets, on the wood beside them. */
static void name_pockets(const view *v, const carom_table *t, double width, double height) {
  const double band = 0.5 * v->scale * v->margin, size = v->labels->size, edge = 0.8 * band;
  for (int k = 0; k < t->pockets && v->turned; k++) {
    const char *name = carom_pocket_name(t, k);
    const double x = across(v, t->pocket[k].centre), y = down(v, t->pocket[k].centre);
    const char *anchor = "middle";
    double position = x;
    if (x < 0.25 * width) {
      position = edge;
      anchor = "start";
    } else if (x >= 0.75 * width) {
      position = width - edge;
      anchor = "end";
    }
    if (name != NULL)
      svg_text(v->out, position, (y < 0.5 * height ? 0.0 : height - band) + edge, name, 20,
               "class=\"pocket\" font-size=\"%.1f\" fill=\"" PALETTE_MARK "\" text-anchor=\"%s\"",
               size, anchor);
  }
}

/* Axes on the wood beside the corner of the origin, from which aims are counted; that along the
 * table behind the first diamond, if the name of a pocket is before it. */
static void draw_axes(const view *v, const carom_table *t) {
  static const char *const names[] = {"x, aim 0\u00b0", "y, aim 90\u00b0"};
  const double far = 0.25, out = 0.55 * v->margin;
  for (int axis = 0; axis < 2; axis++) {
    double start[2] = {v->low[0], v->low[1]}, end[2];
    start[1 - axis] -= out;
    if (axis == 1 && t->pockets > 0 && v->turned)
      start[axis] += 1.2 / 8.0 * t->length;
    memcpy(end, start, sizeof end);
    end[axis] += far;
    const double left = across(v, start), top = down(v, start), x = across(v, end) - left,
                 y = down(v, end) - top;
    const double ux = x / hypot(x, y), uy = y / hypot(x, y);
    fprintf(v->out,
            "<path class=\"axis\" d=\"M%.1f %.1fl%.1f %.1fm%.1f %.1fl%.1f %.1fl%.1f %.1f\" "
            "stroke=\"" PALETTE_MARK "\" fill=\"none\"/>\n",
            left, top, x, y, -7.0 * ux - 4.0 * uy, -7.0 * uy + 4.0 * ux, 7.0 * ux + 4.0 * uy,
            7.0 * uy - 4.0 * ux, -7.0 * ux + 4.0 * uy, -7.0 * uy - 4.0 * ux);
    /* The name is on the outer side of its arrow: above it, left of it, or below one along the
     * lower edge. */
    const double size = v->labels->size;
    const bool is_level = x > 1.0, goes_down = y > 1.0;
    svg_text(v->out, goes_down ? left - 4.0 : left + 4.0,
             is_level && !v->turned ? top + size : top - 0.25 * size, names[axis], 20,
             "class=\"axis\" font-size=\"%.1f\" fill=\"" PALETTE_MARK "\" text-anchor=\"%s\" "
             "transform=\"rotate(%d %.1f %.1f)\"",
             size, goes_down ? "end" : "start", is_level ? 0 : -90, left, top);
  }
}

/* Keeps rails, pockets and what is behind them free of labels. */
static void keep_rails(const view *v, const carom_table *t, double width, double height) {
  double low[2], high[2];
  noses_of(t, low, high);
  const double left = fmin(across(v, low), across(v, high)),
               right = fmax(across(v, low), across(v, high));
  const double top = fmin(down(v, low), down(v, high)), bottom = fmax(down(v, low), down(v, high));
  keep_free(v->labels, 0.0, 0.0, left, height);
  keep_free(v->labels, right, 0.0, width, height);
  keep_free(v->labels, 0.0, 0.0, width, top);
  keep_free(v->labels, 0.0, bottom, width, height);
  for (int k = 0; k < t->rails; k++)
    keep_line(v->labels, across(v, t->rail[k].p), down(v, t->rail[k].p), across(v, t->rail[k].q),
              down(v, t->rail[k].q));
  for (int k = 0; k < t->pockets; k++) {
    const double x = across(v, t->pocket[k].centre), y = down(v, t->pocket[k].centre),
                 r = v->scale * t->pocket[k].radius;
    keep_free(v->labels, x - r, y - r, x + r, y + r);
  }
}

void draw_table(const view *v, const carom_table *t, double below) {
  FILE *out = v->out;
  const double scale = v->scale;
  const int axis = v->turned; /* that across the picture */
  const double width = scale * (v->high[axis] - v->low[axis] + 2.0 * v->margin);
  const double height = scale * (v->high[1 - axis] - v->low[1 - axis] + 2.0 * v->margin);
  const table_colours colours = colours_of(t);
  char frame[64];
  snprintf(frame, sizeof frame, "rx=\"%.0f\" fill=\"%s\"", scale * PALETTE_SIZE_CORNER,
           colours.wood);
  svg_begin(out, width, height + below, frame);
  const double inset = scale * 0.5 * v->margin;
  fprintf(out,
          "<rect x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\" rx=\"%.0f\" fill=\"%s\"/>\n",
          inset, inset, width - 2.0 * inset, height - 2.0 * inset, scale * PALETTE_SIZE_BED_CORNER,
          colours.cloth);
  for (int k = 0; k < t->pockets; k++)
    svg_circle(out, across(v, t->pocket[k].centre), down(v, t->pocket[k].centre),
               scale * t->pocket[k].radius, "fill=\"" PALETTE_POCKET "\"");
  for (int k = 0; k < t->jaws; k++)
    svg_circle(out, across(v, t->jaw[k].centre), down(v, t->jaw[k].centre),
               scale * t->jaw[k].radius, "fill=\"%s\"", colours.cushion);
  for (int k = 0; k < t->rails; k++)
    fprintf(out,
            "<path d=\"M%.1f %.1fL%.1f %.1f\" stroke=\"" PALETTE_NOSE "\" stroke-width=\"%.1f\" "
            "stroke-linecap=\"round\"/>\n",
            across(v, t->rail[k].p), down(v, t->rail[k].p), across(v, t->rail[k].q),
            down(v, t->rail[k].q), scale * PALETTE_SIZE_NOSE);
  draw_diamonds(v, t);
  draw_axes(v, t);
  name_pockets(v, t, width, height);
  keep_rails(v, t, width, height);
}
