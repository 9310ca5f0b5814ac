/* One collision from above as a picture.
 *
 * While a ball slides the cloth slows its slip at a constant rate, mu g, in a constant direction: its velocity goes evenly from
 * that just after the collision to that of rolling, which the library knows, and its path is a parabola.
 */
#include "hit_picture.h"

#include "output.h"

#include <math.h>
#include <stdio.h>

enum { STEPS = 24 };
static const double steps = STEPS, gravity = 9.81, width = 900.0, margin = 30.0; /* m/s^2; pixels */

/* A path: where it begins, its velocity at once and when rolling, how long it slides, how long it is drawn. */
typedef struct path {
  double from[2], v[2], rolling[2], sliding, drawn;
} path;

static path path_of(const carom_ball *ball, const carom_motion *after, double reach) {
  path p = {.from = {ball->r[0], ball->r[1]}, .v = {after->v[0], after->v[1]}};
  double rolling[3];
  carom_rolling_velocity(after->v, after->w, ball->radius, rolling);
  p.rolling[0] = rolling[0];
  p.rolling[1] = rolling[1];
  const double change = hypot(rolling[0] - p.v[0], rolling[1] - p.v[1]);
  p.sliding = ball->mu_cloth > 0.0 ? change / (ball->mu_cloth * gravity) : 0.0;
  /* To the end of sliding and a little further, but not out of sight. */
  const double speed = fmax(hypot(p.v[0], p.v[1]), hypot(rolling[0], rolling[1]));
  p.drawn = speed > 0.0 ? fmin(p.sliding + 0.25 * reach / speed, reach / speed) : 0.0;
  return p;
}

static void place_at(const path *p, double time, double r[2]) {
  const double slid = fmin(time, p->sliding), rolled = time - slid;
  for (int k = 0; k < 2; k++) {
    const double gained = p->sliding > 0.0 ? (p->rolling[k] - p->v[k]) * slid * slid / (2.0 * p->sliding) : 0.0;
    r[k] = p->from[k] + p->v[k] * slid + gained + p->rolling[k] * rolled;
  }
}

/* The part of the table that is shown, and its scale. */
typedef struct view {
  FILE *out;
  double low[2], high[2], scale;
} view;

static void include(view *v, const double r[2], double around) {
  for (int k = 0; k < 2; k++) {
    v->low[k] = fmin(v->low[k], r[k] - around);
    v->high[k] = fmax(v->high[k], r[k] + around);
  }
}

static double across(const view *v, double x) {
  return margin + v->scale * (x - v->low[0]);
}
static double down(const view *v, double y) {
  return margin + v->scale * (v->high[1] - y);
}

static void draw_line(const view *v, const double centre[2], double x, double y, const char *style) {
  fprintf(v->out, "<path d=\"M%.1f %.1fL%.1f %.1f\" %s/>\n", across(v, centre[0] - x), down(v, centre[1] - y),
          across(v, centre[0] + x), down(v, centre[1] + y), style);
}

static void draw_ball(const view *v, const double r[2], double radius, const char *style) {
  fprintf(v->out, "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"%.1f\" %s/>\n", across(v, r[0]), down(v, r[1]), v->scale * radius,
          style);
}

/* Thick while the ball slides, thin where it rolls; dashed the way that it would take without the cloth. */
static void draw_path(const view *v, const path *p, double radius, const char *colour) {
  double r[2];
  const double length = hypot(p->v[0], p->v[1]), slid = fmin(p->sliding, p->drawn);
  if (length > 0.0)
    fprintf(v->out, "<path d=\"M%.1f %.1fl%.1f %.1f\" stroke=\"%s\" stroke-width=\"1.5\" stroke-dasharray=\"6 4\"/>\n",
            across(v, p->from[0]), down(v, p->from[1]), v->scale * 5.0 * radius * p->v[0] / length,
            -v->scale * 5.0 * radius * p->v[1] / length, colour);
  fprintf(v->out, "<path fill=\"none\" stroke=\"%s\" stroke-width=\"4\" d=\"M%.1f %.1f", colour, across(v, p->from[0]),
          down(v, p->from[1]));
  for (int k = 1; k <= STEPS; k++) {
    place_at(p, slid * k / steps, r);
    fprintf(v->out, "L%.1f %.1f", across(v, r[0]), down(v, r[1]));
  }
  fprintf(v->out, "\"/>\n<path stroke=\"%s\" stroke-width=\"1.8\" d=\"M%.1f %.1f", colour, across(v, r[0]), down(v, r[1]));
  place_at(p, p->drawn, r);
  fprintf(v->out, "L%.1f %.1f\"/>\n", across(v, r[0]), down(v, r[1]));
}

static void write_text(const view *v, double x, double y, const char *text) {
  fprintf(v->out, "<text xml:space=\"preserve\" x=\"%.1f\" y=\"%.1f\">", x, y);
  for (const char *c = text; *c != '\0'; c++)
    *c == '<' ? fputs("&lt;", v->out) : *c == '&' ? fputs("&amp;", v->out) : fputc(*c, v->out);
  fputs("</text>\n", v->out);
}

bool hit_draw(const char *name, const carom_impact *in, const carom_result *out, const char *const *text) {
  const double radius = in->a.radius, reach = 24.0 * radius;
  const path paths[2] = {path_of(&in->a, &out->a, reach), path_of(&in->b, &out->b, reach)};
  view v = {.low = {INFINITY, INFINITY}, .high = {-INFINITY, -INFINITY}};
  int lines = 0;
  while (text[lines] != NULL)
    lines++;
  /* What is to be seen: both balls, the last of the way there, both paths. */
  const double speed = hypot(in->a.v[0], in->a.v[1]), back = speed > 0.0 ? 7.0 * radius / speed : 0.0;
  const double start[2] = {in->a.r[0] - back * in->a.v[0], in->a.r[1] - back * in->a.v[1]};
  include(&v, start, radius);
  include(&v, in->a.r, 4.0 * radius);
  include(&v, in->b.r, 4.0 * radius);
  for (int ball = 0; ball < 2; ball++)
    for (int k = 0; k <= STEPS; k++) {
      double r[2];
      place_at(&paths[ball], paths[ball].drawn * k / steps, r);
      include(&v, r, 1.5 * radius);
    }
  v.scale = fmin((width - 2.0 * margin) / (v.high[0] - v.low[0]), 700.0 / (v.high[1] - v.low[1]));
  const double table = 2.0 * margin + v.scale * (v.high[1] - v.low[1]), height = table + 20.0 * (lines + 1);
  v.out = output_open(name);
  if (v.out == NULL)
    return false;
  fprintf(v.out,
          "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 %.0f %.0f\" width=\"%.0f\" height=\"%.0f\" "
          "font-family=\"Helvetica, Arial, sans-serif\" font-size=\"14\">\n<rect width=\"100%%\" height=\"100%%\" "
          "fill=\"#fff\"/>\n<rect width=\"100%%\" height=\"%.0f\" fill=\"#e9f2ee\"/>\n",
          width, height, width, height, table);
  const double x = (in->b.r[0] - in->a.r[0]) / (2.0 * radius), y = (in->b.r[1] - in->a.r[1]) / (2.0 * radius);
  const double contact[2] = {0.5 * (in->a.r[0] + in->b.r[0]), 0.5 * (in->a.r[1] + in->b.r[1])};
  const char *const thin = "stroke=\"#777\" stroke-width=\"1\" stroke-dasharray=\"2 3\"";
  draw_line(&v, contact, 5.0 * radius * x, 5.0 * radius * y, thin);
  draw_line(&v, contact, -4.0 * radius * y, 4.0 * radius * x, thin);
  draw_ball(&v, start, radius, "fill=\"none\" stroke=\"#0072B2\" stroke-dasharray=\"4 3\"");
  fprintf(v.out, "<path d=\"M%.1f %.1fL%.1f %.1f\" stroke=\"#0072B2\" stroke-width=\"1.8\"/>\n", across(&v, start[0]),
          down(&v, start[1]), across(&v, in->a.r[0]), down(&v, in->a.r[1]));
  draw_ball(&v, in->a.r, radius, "fill=\"#fff\" stroke=\"#0072B2\" stroke-width=\"1.5\"");
  draw_ball(&v, in->b.r, radius, "fill=\"#f6c9ae\" stroke=\"#D55E00\" stroke-width=\"1.5\"");
  draw_path(&v, &paths[0], radius, "#0072B2");
  draw_path(&v, &paths[1], radius, "#D55E00");
  fputs("<g fill=\"#333\">\n", v.out);
  write_text(&v, across(&v, contact[0] - 4.2 * radius * y) + 4.0, down(&v, contact[1] + 4.2 * radius * x), "tangent line");
  write_text(&v, across(&v, contact[0] - 5.2 * radius * x) - 40.0, down(&v, contact[1] - 5.2 * radius * y) + 12.0,
             "line of centres");
  write_text(&v, margin, table - 10.0, "thick: the ball slides; thin: it rolls; dashed: the way at once");
  fputs("</g>\n<g fill=\"#333\" font-family=\"DejaVu Sans Mono, Menlo, Consolas, monospace\" font-size=\"12.5\">\n", v.out);
  for (int k = 0; k < lines; k++)
    write_text(&v, margin, table + 20.0 * (k + 1), text[k]);
  fputs("</g>\n</svg>\n", v.out);
  return output_commit();
}
