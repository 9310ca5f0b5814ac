/* One impact from above. Its paths are those of a whole shot that begins just after it, on a
 * cloth whose cushions are out of sight. */
#include "pictures/contact_picture.h"

#include "pictures/colours.h"
#include "pictures/labels.h"
#include "pictures/palette.h"
#include "pictures/picture.h"
#include "rows/quantities.h"
#include "shots/endless_cloth.h"

#include <math.h>
#include <string.h>

enum { MOST_EVENTS = 64, SAMPLES = 64, ARC_PIECES = 8, MOST_CHARACTERS = 200 };
static const double reach = 14.0;          /* of the faster ball at least, in radii */
static const double least_friction = 1e-6; /* the library's motion needs some; balls slide
                                              straight on by so little */
static const double margin = 26.0, most_height = 620.0; /* pixels */

/* A part of the cloth, and its labels. */
typedef struct sketch {
  FILE *out;
  double low[2], high[2], scale, bottom;
  labels labels;
} sketch;

static double across(const sketch *s, const double r[2]) {
  return margin + s->scale * (r[0] - s->low[0]);
}
static double down(const sketch *s, const double r[2]) {
  return margin + s->scale * (s->high[1] - r[1]);
}

static void include(sketch *s, const double r[2], double around) {
  for (int k = 0; k < 2; k++) {
    s->low[k] = fmin(s->low[k], r[k] - around);
    s->high[k] = fmax(s->high[k], r[k] + around);
  }
}

/* A dashed line; labels are not put on it. */
static void dash(sketch *s, const double start[2], const double end[2]) {
  const double a[2] = {across(s, start), down(s, start)}, b[2] = {across(s, end), down(s, end)};
  fprintf(s->out,
          "<path d=\"M%.1f %.1fL%.1f %.1f\" fill=\"none\" stroke=\"" PALETTE_MARK
          "\" stroke-dasharray=\"5 "
          "4\"/>\n",
          a[0], a[1], b[0], b[1]);
  keep_line(&s->labels, a[0], a[1], b[0], b[1]);
}

/* Keeps an arc free of labels. */
static void keep_arc(sketch *s, const contact_arc *a, double radius) {
  double last[2] = {0};
  for (int k = 0; k <= ARC_PIECES; k++) {
    const double angle = (a->start + (a->end - a->start) * k / ARC_PIECES) * degree;
    const double point[2] = {across(s, a->centre) + radius * cos(angle),
                             down(s, a->centre) - radius * sin(angle)};
    if (k > 0)
      keep_line(&s->labels, last[0], last[1], point[0], point[1]);
    memcpy(last, point, sizeof last);
  }
}

/* An arc of so many pixels about a place, and its angle beside its middle. */
static void draw_arc(sketch *s, const contact_arc *a, double radius) {
  const double x = across(s, a->centre), y = down(s, a->centre),
               middle = 0.5 * (a->start + a->end) * degree;
  const double angle = fabs(a->end - a->start);
  char text[60];
  if (angle < 0.05)
    return;
  fprintf(s->out,
          "<path d=\"M%.1f %.1fA%.1f %.1f 0 %d %d %.1f %.1f\" fill=\"none\" stroke=\"" PALETTE_MARK
          "\"/>\n",
          x + radius * cos(a->start * degree), y - radius * sin(a->start * degree), radius, radius,
          angle > 180.0, a->end < a->start, x + radius * cos(a->end * degree),
          y - radius * sin(a->end * degree));
  snprintf(text, sizeof text, "%s %.1f\u00b0", a->label, angle);
  put_label(&s->labels, x + radius * cos(middle), y - radius * sin(middle), text);
}

/* The shot that begins after the impact: its states at any time, and from when on each ball
 * rolls. */
typedef struct motion {
  carom_shot_ball ball[2];
  carom_event events[MOST_EVENTS];
  carom_ball_state final[2];
  carom_shot shot;
  double rolls[2], end; /* s; of the picture */
} motion;

static void move(const contact_picture *p, motion *m) {
  const double R = p->ball[0]->radius;
  const carom_table table = endless_cloth(R);
  double fastest = 1e-9, rolling[3];
  *m = (motion){.shot = {.events = m->events, .room = MOST_EVENTS, .final = m->final}};
  for (int k = 0; k < p->balls; k++) {
    carom_shot_ball *b = &m->ball[k];
    *b = (carom_shot_ball){.kind = carom_ball_kind_of(CAROM_GAME_POOL)};
    b->kind.mass = p->ball[k]->mass;
    b->kind.radius = R;
    b->kind.mu_slide = fmax(p->ball[k]->mu_slide, least_friction);
    memcpy(b->state.r, p->ball[k]->r, sizeof b->state.r);
    memcpy(b->state.v, p->outgoing[k]->v, sizeof b->state.v);
    memcpy(b->state.w, p->outgoing[k]->w, sizeof b->state.w);
    carom_rolling_velocity(b->state.v, b->state.w, R, rolling);
    fastest = fmax(fastest, fmax(plane_size(b->state.v), plane_size(rolling)));
  }
  const carom_shot_options options = {.events_most = MOST_EVENTS, .time_most = 1e12};
  carom_shoot(&table, m->ball, p->balls, NULL, &options, &m->shot);
  /* The picture ends some way after the later ball rolls, unless it slides on for ever. */
  m->end = reach * R / fastest;
  for (int64_t k = 0; k < m->shot.count && k < MOST_EVENTS; k++)
    if (m->events[k].type == CAROM_EVENT_SLIDING_ROLLING && m->rolls[m->events[k].a] == 0.0) {
      m->rolls[m->events[k].a] = m->events[k].time;
      if (p->ball[0]->mu_slide > least_friction)
        m->end = fmax(m->end, 1.25 * m->events[k].time);
    }
  m->end = fmin(m->end, m->shot.time);
}

static void draw_path(sketch *s, const contact_picture *p, const motion *m, int ball) {
  carom_ball_state states[2];
  double last[2] = {0}, point[2] = {0}, sum = 0.0;
  fprintf(s->out, "<path fill=\"none\" stroke=\"%s\" stroke-width=\"2.2\" d=\"", line_colour(ball));
  for (int k = 0; k <= SAMPLES; k++) {
    carom_shot_at(m->ball, p->balls, &m->shot, m->end * k / SAMPLES, states);
    memcpy(last, point, sizeof last);
    memcpy(point, states[ball].r, sizeof point);
    sum += k > 0 ? plane_distance(point, last) : 0.0;
    fprintf(s->out, "%c%.1f %.1f", k > 0 ? 'L' : 'M', across(s, point), down(s, point));
    keep_free(&s->labels, across(s, point) - 4.0, down(s, point) - 4.0, across(s, point) + 4.0,
              down(s, point) + 4.0);
  }
  fputs("\"/>\n", s->out);
  if (s->scale * sum < 4.0)
    return;
  /* An arrow's head, and from where on the ball rolls. */
  const double angle = atan2(point[1] - last[1], point[0] - last[0]), x = across(s, point),
               y = down(s, point);
  fprintf(s->out, "<path fill=\"%s\" d=\"M%.1f %.1f", line_colour(ball), x + 13.0 * cos(angle),
          y - 13.0 * sin(angle));
  for (int side = -1; side < 2; side += 2)
    fprintf(s->out, "L%.1f %.1f", x + 5.0 * cos(angle + 90.0 * side * degree),
            y - 5.0 * sin(angle + 90.0 * side * degree));
  fputs("Z\"/>\n", s->out);
  keep_free(&s->labels, x - 6.0, y - 6.0, x + 6.0, y + 6.0);
  keep_free(&s->labels, x + 13.0 * cos(angle) - 4.0, y - 13.0 * sin(angle) - 4.0,
            x + 13.0 * cos(angle) + 4.0, y - 13.0 * sin(angle) + 4.0);
  if (m->rolls[ball] > 0.0 && m->rolls[ball] < m->end) {
    carom_shot_at(m->ball, p->balls, &m->shot, m->rolls[ball], states);
    fprintf(s->out, "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"4\" fill=\"" PALETTE_MARK "\"/>\n",
            across(s, states[ball].r), down(s, states[ball].r));
  }
  put_label(&s->labels, x + 14.0 * cos(angle), y - 14.0 * sin(angle), p->way[ball]);
}

/* The largest of 1, 2, 5, 10, 20 ... that is not above a length. */
static double round_length(double most) {
  const double power = pow(10.0, floor(log10(most))), share = most / power;
  if (share >= 5.0)
    return 5.0 * power;
  return share >= 2.0 ? 2.0 * power : power;
}

/* A bar of a round length, about a sixth of the width. */
static void draw_scale(sketch *s) {
  const double length = round_length(CONTACT_WIDTH / 6.0 / s->scale), x = CONTACT_WIDTH - margin;
  char text[40];
  snprintf(text, sizeof text, length < 1.0 ? "%.3g cm" : "%.3g m",
           length < 1.0 ? 100.0 * length : length);
  fprintf(s->out,
          "<path d=\"M%.1f %.1fv6h%.1fv-6\" fill=\"none\" stroke=\"" PALETTE_MARK
          "\" stroke-width=\"1.5\"/>\n",
          x - s->scale * length, s->bottom - 16.0, s->scale * length);
  svg_text(s->out, x - 0.5 * s->scale * length, s->bottom - 16.0, text, MOST_CHARACTERS,
           "class=\"bar\" font-size=\"%.1f\" fill=\"" PALETTE_MARK "\" text-anchor=\"middle\"",
           s->labels.size);
  keep_free(&s->labels, x - s->scale * length, s->bottom - 36.0, x, s->bottom);
}

/* What is to be seen: balls, lines, paths. */
static sketch sketch_of(FILE *out, const contact_picture *p, const motion *m) {
  sketch s = {.out = out, .low = {INFINITY, INFINITY}, .high = {-INFINITY, -INFINITY}};
  const double R = p->ball[0]->radius;
  carom_ball_state states[2];
  for (int k = 0; k < p->balls; k++)
    include(&s, p->ball[k]->r, 1.5 * R);
  for (int k = 0; k < p->lines; k++) {
    include(&s, p->line[k].start, 0.5 * R);
    include(&s, p->line[k].end, 0.5 * R);
  }
  for (int k = 1; k <= SAMPLES; k++) {
    carom_shot_at(m->ball, p->balls, &m->shot, m->end * k / SAMPLES, states);
    for (int ball = 0; ball < p->balls; ball++)
      include(&s, states[ball].r, 1.5 * R);
  }
  if (p->rail)
    s.high[1] = 1.8 * R;
  const double wide = s.high[0] - s.low[0], high = s.high[1] - s.low[1];
  s.scale = fmin((CONTACT_WIDTH - 2.0 * margin) / wide, most_height / high);
  s.bottom = s.scale * high + 2.0 * margin;
  s.labels = (labels){
      .out = out, .width = CONTACT_WIDTH, .height = s.bottom, .size = svg_letters(CONTACT_WIDTH)};
  s.low[0] -= 0.5 * ((CONTACT_WIDTH - 2.0 * margin) / s.scale - wide);
  return s;
}

double contact_draw(FILE *out, double top, const contact_picture *p) {
  motion m;
  move(p, &m);
  sketch s = sketch_of(out, p, &m);
  const double R = p->ball[0]->radius, size = s.labels.size, first = s.bottom + 1.5 * size;
  const int columns = (int)((CONTACT_WIDTH - 1.5 * margin) / (0.602 * size));
  const double height = svg_lines(NULL, 0.0, first, size, columns, "", p->words);
  fprintf(out,
          "<svg y=\"%.1f\" width=\"%d\" height=\"%.1f\">\n<rect width=\"100%%\" height=\"%.1f\" "
          "fill=\"%s\"/>\n",
          top, CONTACT_WIDTH, height, s.bottom, pool_colours.cloth);
  draw_scale(&s);
  if (p->rail) {
    fprintf(out, "<rect width=\"100%%\" height=\"%.1f\" fill=\"%s\"/>\n",
            down(&s, (double[]){0.0, R}), pool_colours.cushion);
    keep_free(&s.labels, 0.0, 0.0, CONTACT_WIDTH, down(&s, (double[]){0.0, R}));
  }
  /* Balls as they meet, lines, angles, paths; labels last find what is free. */
  for (int k = 0; k < p->balls; k++) {
    const double x = across(&s, p->ball[k]->r), y = down(&s, p->ball[k]->r),
                 r = fmax(s.scale * R, 3.0);
    svg_circle(out, x, y, r, "fill=\"%s\" fill-opacity=\"0.85\" stroke=\"" PALETTE_NOSE "\"",
               line_colour(k));
    keep_free(&s.labels, x - r, y - r, x + r, y + r);
  }
  for (int k = 0; k < p->lines; k++)
    dash(&s, p->line[k].start, p->line[k].end);
  for (int k = 0; k < p->arcs; k++)
    keep_arc(&s, &p->arc[k], fmax(46.0, s.scale * R * 1.3) + 34.0 * k);
  for (int k = 0; k < p->balls; k++)
    draw_path(&s, p, &m, k);
  for (int k = 0; k < p->arcs; k++)
    draw_arc(&s, &p->arc[k], fmax(46.0, s.scale * R * 1.3) + 34.0 * k);
  for (int k = 0; k < p->lines; k++)
    if (p->line[k].label != NULL)
      put_label(&s.labels, across(&s, p->line[k].end), down(&s, p->line[k].end), p->line[k].label);
  svg_lines(out, margin, first, size, columns,
            "font-family=\"DejaVu Sans Mono, Menlo, Consolas, monospace\"", p->words);
  fputs("</svg>\n", out);
  return height;
}
