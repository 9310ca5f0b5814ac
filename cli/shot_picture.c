/* A shot as a picture. Paths are drawn by evaluating the motion between events, so a curve is a curve. Long tables lie on their
 * side: y of the table runs to the right. */
#include "shot_picture.h"

#include "picture.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

bool shot_has_id(const shot_line *line, const char *id) {
  if (id == NULL)
    return true;
  const size_t size = strlen(id);
  if (line->id == NULL)
    return false;
  return strcmp(line->id, id) == 0 ||
         (strlen(line->id) == size + 2 && line->id[0] == '"' && strncmp(line->id + 1, id, size) == 0);
}

static const double table_scale = 400.0, table_margin = 0.11, side_margin = 30.0; /* pixels a metre; m; pixels */

/* The usual colours of pool balls by number; the first is for the cue ball and others. */
static const char *const colours[] = {"#ffffff", "#f2c230", "#1d4fd8", "#e02d24", "#5b2a9d", "#ee7a22", "#0b5d2e", "#8c1d3a",
                                      "#222222", "#f2c230", "#1d4fd8", "#e02d24", "#5b2a9d", "#ee7a22", "#0b5d2e", "#8c1d3a"};

static const char *colour_of(const char *name, int index) {
  static const struct {
    const char *name, *colour;
  } named[] = {{"cue", "#ffffff"}, {"white", "#ffffff"}, {"yellow", "#f2c230"}, {"red", "#e02d24"}, {"black", "#222222"}};
  for (size_t k = 0; k < sizeof named / sizeof named[0]; k++)
    if (strcmp(name, named[k].name) == 0)
      return named[k].colour;
  char *end;
  const long number = strtol(name, &end, 10);
  return *end == '\0' && number >= 1 && number <= 15 ? colours[number] : colours[index % 16];
}

static bool is_striped(const char *name) {
  char *end;
  const long number = strtol(name, &end, 10);
  return *end == '\0' && number >= 9 && number <= 15;
}

/* The table's axes on the picture. */
typedef struct view {
  FILE *out;
  double low[2], high[2], scale, margin; /* m, but for the scale */
  bool turned;
} view;

static double across(const view *v, const double r[2]) {
  return v->scale * ((v->turned ? r[1] - v->low[1] : r[0] - v->low[0]) + v->margin);
}
static double down(const view *v, const double r[2]) {
  return v->scale * ((v->turned ? r[0] - v->low[0] : v->high[1] - r[1]) + v->margin);
}

static view view_of(FILE *out, const carom_table *t) {
  view v = {
      .out = out, .low = {INFINITY, INFINITY}, .high = {-INFINITY, -INFINITY}, .scale = table_scale, .margin = table_margin};
  for (int k = 0; k < t->rails; k++)
    for (int end = 0; end < 2; end++)
      for (int axis = 0; axis < 2; axis++) {
        const double x = end == 0 ? t->rail[k].p[axis] : t->rail[k].q[axis];
        v.low[axis] = fmin(v.low[axis], x);
        v.high[axis] = fmax(v.high[axis], x);
      }
  v.turned = v.high[1] - v.low[1] > v.high[0] - v.low[0];
  return v;
}

/* With `below` pixels free under the table. */
static void draw_table(const view *v, const carom_table *t, double below) {
  FILE *out = v->out;
  const double scale = v->scale;
  const double width = scale * ((v->turned ? v->high[1] - v->low[1] : v->high[0] - v->low[0]) + 2.0 * v->margin);
  const double height = scale * ((v->turned ? v->high[0] - v->low[0] : v->high[1] - v->low[1]) + 2.0 * v->margin);
  svg_begin(out, width, height + below, "rx=\"18\" fill=\"#5b3a21\"");
  const double inset = scale * 0.5 * v->margin;
  fprintf(out, "<rect x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\" rx=\"10\" fill=\"#3f9d80\"/>\n", inset, inset,
          width - 2.0 * inset, height - 2.0 * inset);
  for (int k = 0; k < t->pockets; k++)
    fprintf(out, "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"%.1f\" fill=\"#111\"/>\n", across(v, t->pocket[k].centre),
            down(v, t->pocket[k].centre), scale * t->pocket[k].radius);
  for (int k = 0; k < t->jaws; k++)
    fprintf(out, "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"%.1f\" fill=\"#2b6f5a\"/>\n", across(v, t->jaw[k].centre),
            down(v, t->jaw[k].centre), scale * t->jaw[k].radius);
  for (int k = 0; k < t->rails; k++)
    fprintf(out, "<path d=\"M%.1f %.1fL%.1f %.1f\" stroke=\"#1d4a3c\" stroke-width=\"4\" stroke-linecap=\"round\"/>\n",
            across(v, t->rail[k].p), down(v, t->rail[k].p), across(v, t->rail[k].q), down(v, t->rail[k].q));
}

/* Goes on with a path to a place and time: straight, or in short pieces where the ball slides. */
static void draw_piece(const view *v, const shot_line *line, const carom_shot *shot, int ball, double from, double to,
                       const double end[2], bool curved) {
  carom_ball_state states[CAROM_BALLS_MOST];
  for (int n = 1; curved && n < 8; n++) {
    carom_shot_at(line->ball, line->count, shot, from + (to - from) * n / 8.0, states);
    fprintf(v->out, "L%.1f %.1f", across(v, states[ball].r), down(v, states[ball].r));
  }
  fprintf(v->out, "L%.1f %.1f", across(v, end), down(v, end));
}

/* The path of one ball, from event to event that it is in. */
static void draw_path(const view *v, const shot_line *line, const carom_shot *shot, int ball) {
  carom_ball_state states[CAROM_BALLS_MOST];
  double last = 0.0;
  bool moved = false;
  for (int64_t k = 0; last < shot->time; k++) {
    /* The next event, or the end of the picture. */
    const bool is_event = k < shot->count && k < shot->room && shot->events[k].time <= shot->time;
    const carom_event *e = is_event ? &shot->events[k] : NULL;
    const int side = e == NULL || e->a == ball ? 0 : e->type == CAROM_EVENT_BALL_BALL && e->b == ball ? 1 : -1;
    if (side < 0)
      continue;
    const double time = e != NULL ? e->time : shot->time;
    carom_shot_at(line->ball, line->count, shot, 0.5 * (last + time), states);
    const int64_t label = e != NULL ? e->before[side].label : states[ball].label;
    const bool moves = label == CAROM_BALL_SLIDING || label == CAROM_BALL_ROLLING || label == CAROM_BALL_AIRBORNE;
    if (e != NULL ? moved || time > last : moves) {
      if (!moved) {
        carom_shot_at(line->ball, line->count, shot, last, states);
        fprintf(v->out, "<path fill=\"none\" stroke=\"%s\" stroke-width=\"2.2\" stroke-linejoin=\"round\" d=\"M%.1f %.1f",
                colour_of(line->name[ball], ball), across(v, states[ball].r), down(v, states[ball].r));
        moved = true;
      }
      draw_piece(v, line, shot, ball, last, time, e != NULL ? e->before[side].r : shot->final[ball].r,
                 label == CAROM_BALL_SLIDING);
    }
    last = time;
  }
  if (moved)
    fputs("\"/>\n", v->out);
}

static void draw_ball(const view *v, const shot_line *line, const carom_ball_state *s, int ball, bool final) {
  const char *colour = colour_of(line->name[ball], ball), *name = line->name[ball];
  const double x = across(v, s->r), y = down(v, s->r), r = v->scale * line->ball[ball].kind.radius;
  if (!final) {
    fprintf(v->out, "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"%.1f\" fill=\"none\" stroke=\"%s\" stroke-dasharray=\"3 2\"/>\n", x, y,
            r, colour);
    return;
  }
  const bool dark = strcmp(colour, "#ffffff") != 0 && strcmp(colour, "#f2c230") != 0;
  fprintf(v->out, "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"%.1f\" fill=\"%s\" stroke=\"#111\" stroke-width=\"0.8\"/>\n", x, y, r,
          colour);
  if (is_striped(name))
    fprintf(v->out, "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"%.1f\" fill=\"none\" stroke=\"#fff\" stroke-width=\"2.5\"/>\n", x, y,
            r - 1.8);
  char style[120];
  snprintf(style, sizeof style, "font-size=\"%.1f\" fill=\"%s\" text-anchor=\"middle\" dominant-baseline=\"central\"",
           strlen(name) > 2 ? 7.0 : 11.0, dark ? "#fff" : "#111");
  svg_text(v->out, x, y, style, name, 5);
}

/* Balls that fell lie beside each other in the pocket's place. */
static void spread_pocketed(const shot_line *line, carom_ball_state *final) {
  for (int k = 0; k < line->count; k++) {
    int before = 0;
    for (int other = 0; other < k; other++)
      before += final[k].label == CAROM_BALL_POCKETED && line->ball[k].state.label != CAROM_BALL_POCKETED &&
                fabs(final[other].r[0] - final[k].r[0]) < 0.2 && fabs(final[other].r[1] - final[k].r[1]) < 1e-9 &&
                final[other].label == CAROM_BALL_POCKETED;
    final[k].r[0] += 1.6 * before * line->ball[k].kind.radius;
  }
}

/* ---- From the side: places along the picture's width, as in the view from above, and heights at the same scale */

/* How high a ball's centre comes above the cloth that it would lie on, m, at events and between. */
static double rise_of(const shot_line *line, const carom_shot *shot, int ball) {
  const double R = line->ball[ball].kind.radius, g = line->ball[ball].kind.gravity;
  const carom_ball_state *start = &line->ball[ball].state;
  const bool flies = start->label == CAROM_BALL_AIRBORNE || start->v[2] != 0.0 || start->r[2] > R + 1e-6;
  double most = flies ? start->r[2] - R + 0.5 * start->v[2] * fabs(start->v[2]) / g : 0.0;
  for (int64_t k = 0; k < shot->count && k < shot->room; k++)
    for (int side = 0; side < 2; side++) {
      const carom_event *e = &shot->events[k];
      const carom_ball_state *s = &e->after[side];
      if ((side == 0 ? e->a : e->b) == ball && (side == 0 || e->type == CAROM_EVENT_BALL_BALL) &&
          s->label == CAROM_BALL_AIRBORNE)
        most = fmax(most, s->r[2] - R + (s->v[2] > 0.0 ? 0.5 * s->v[2] * s->v[2] / g : 0.0));
    }
  return most;
}

/* The side view of the balls that rise by more than a millimetre, above a line for the cloth at y = `cloth`, pixels. */
static void draw_side(const view *v, const shot_line *line, const carom_shot *shot, double cloth, double width) {
  const carom_table *t = &line->table->table;
  fprintf(v->out, "<path d=\"M0 %.1fL%.1f %.1f\" stroke=\"#3f9d80\" stroke-width=\"3\"/>\n", cloth, width, cloth);
  for (int k = 0; k < t->rails; k++) /* noses, as posts at their ends */
    for (int end = 0; end < 2; end++) {
      const double x = across(v, end == 0 ? t->rail[k].p : t->rail[k].q);
      fprintf(v->out, "<path d=\"M%.1f %.1fV%.1f\" stroke=\"#1d4a3c\" stroke-width=\"2\"/>\n", x, cloth,
              cloth - v->scale * t->rail[k].height);
    }
  carom_ball_state states[CAROM_BALLS_MOST];
  for (int ball = line->count - 1; ball >= 0; ball--) {
    const double r = v->scale * line->ball[ball].kind.radius;
    const carom_ball_state *from = &line->ball[ball].state;
    const char *colour = colour_of(line->name[ball], ball);
    if (rise_of(line, shot, ball) > 1e-3) {
      /* up to the last time that it is on the table */
      fprintf(v->out, "<path fill=\"none\" stroke=\"%s\" stroke-width=\"2.2\" stroke-linejoin=\"round\" d=\"", colour);
      double last = 0.0;
      for (int64_t k = 0; k < shot->count && k < shot->room; k++) {
        const carom_event *e = &shot->events[k];
        const bool in = e->a == ball || (e->type == CAROM_EVENT_BALL_BALL && e->b == ball);
        const int pieces = in && e->time > last ? 24 : 0;
        for (int n = 0; n <= pieces && in; n++) {
          const double time = pieces > 0 ? last + (e->time - last) * n / pieces : e->time;
          const carom_ball_state *s = e->a == ball ? &e->before[0] : &e->before[1];
          if (n < pieces) {
            carom_shot_at(line->ball, line->count, shot, time, states);
            s = &states[ball];
          }
          fprintf(v->out, "%c%.1f %.1f", last == 0.0 && n == 0 ? 'M' : 'L', across(v, s->r), cloth - v->scale * s->r[2]);
        }
        last = in ? e->time : last;
      }
      fputs("\"/>\n", v->out);
    }
    fprintf(v->out, "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"%.1f\" fill=\"none\" stroke=\"%s\" stroke-dasharray=\"3 2\"/>\n",
            across(v, from->r), cloth - v->scale * from->r[2], r, colour);
  }
}

void shot_draw(FILE *out, const shot_line *line, const carom_shot *shot) {
  const view v = view_of(out, &line->table->table);
  carom_ball_state final[CAROM_BALLS_MOST];
  memcpy(final, shot->final, (size_t)line->count * sizeof *final);
  double rise = 0.0;
  for (int k = 0; k < line->count; k++)
    rise = fmax(rise, rise_of(line, shot, k));
  const double width = v.scale * ((v.turned ? v.high[1] - v.low[1] : v.high[0] - v.low[0]) + 2.0 * v.margin);
  const double above = v.scale * ((v.turned ? v.high[0] - v.low[0] : v.high[1] - v.low[1]) + 2.0 * v.margin);
  const double side = rise > 1e-3 ? v.scale * (rise + 2.0 * line->ball[0].kind.radius) + side_margin : 0.0;
  draw_table(&v, &line->table->table, side > 0.0 ? side + side_margin : 0.0);
  if (side > 0.0) {
    fprintf(out, "<rect y=\"%.1f\" width=\"100%%\" height=\"%.1f\" fill=\"#86a398\"/>\n", above, side + side_margin + 20.0);
    draw_side(&v, line, shot, above + side, width);
  }
  for (int k = 0; k < line->count; k++)
    draw_ball(&v, line, &line->ball[k].state, k, false);
  for (int k = line->count - 1; k >= 0; k--)
    draw_path(&v, line, shot, k);
  spread_pocketed(line, final);
  for (int k = 0; k < line->count; k++)
    draw_ball(&v, line, &final[k], k, true);
  fputs("</svg>\n", out);
}
