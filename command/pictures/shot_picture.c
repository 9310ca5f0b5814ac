/* A shot as a picture. Paths are drawn by evaluating the motion between events, so a curve is a
 * curve. */
#include "pictures/shot_picture.h"

#include "pictures/colours.h"
#include "pictures/palette.h"
#include "pictures/picture.h"
#include "pictures/table_picture.h"
#include "program/program.h"
#include "rows/quantities.h"
#include "shots/shot_story.h"

#include <stdint.h>

enum { MOST_MARKED = 9 }; /* cushions of a shot */

bool shot_has_id(const shot_line *line, const char *id) {
  if (id == NULL)
    return true;
  const size_t size = strlen(id);
  if (line->id == NULL)
    return false;
  return same_text(line->id, id) || (strlen(line->id) == size + 2 && line->id[0] == '"' &&
                                     strncmp(line->id + 1, id, size) == 0);
}

static const double side_margin = 30.0, least_arrow = 40.0; /* pixels */
/* a usual one, over the size of letters */
static const double letter_width = 0.53;
static const double thin_path = 0.8, outline = 1.4; /* pixels */
/* Half the width of the band around a striped ball, in radii. */
static const double half_band = 0.66;

/* Goes on with a path from a place to another and a time: straight, or in short pieces where the
 * ball slides. */
static void draw_piece(const view *v, const shot_line *line, const carom_shot *shot, int ball,
                       double start_time, double end_time, const double start[2],
                       const double end[2], bool curved) {
  carom_ball_state states[CAROM_BALLS_MOST];
  double x = across(v, start), y = down(v, start);
  for (int n = curved ? 1 : 8; n <= 8; n++) {
    const double last[2] = {x, y}, *r = end;
    if (n < 8) {
      carom_shot_at(line->ball, line->count, shot, start_time + (end_time - start_time) * n / 8.0,
                    states);
      r = states[ball].r;
    }
    x = across(v, r);
    y = down(v, r);
    fprintf(v->out, "L%.1f %.1f", x, y);
    keep_line(v->labels, last[0], last[1], x, y);
  }
}

/* An arrow's head on a long piece of a path. */
static void draw_arrow(const view *v, FILE *out, const char *colour, const carom_ball_state *start,
                       const double tip[2], const carom_ball_state *middle) {
  const double ux =
      across(v, (double[]){v->low[0] + middle->v[0], v->low[1] + middle->v[1]}) - across(v, v->low);
  const double uy =
      down(v, (double[]){v->low[0] + middle->v[0], v->low[1] + middle->v[1]}) - down(v, v->low);
  const double x = ux / hypot(ux, uy), y = uy / hypot(ux, uy);
  if (hypot(across(v, tip) - across(v, start->r), down(v, tip) - down(v, start->r)) > least_arrow)
    fprintf(out,
            "<path fill=\"%s\" stroke=\"" PALETTE_NOSE
            "\" stroke-width=\"0.5\" d=\"M%.1f %.1fl%.1f "
            "%.1fl%.1f %.1fZ\"/>\n",
            colour, across(v, middle->r) + 6.0 * x, down(v, middle->r) + 6.0 * y,
            -11.0 * x - 4.5 * y, -11.0 * y + 4.5 * x, 9.0 * y, -9.0 * x);
}

static bool is_moving(int64_t label) {
  return label == CAROM_BALL_SLIDING || label == CAROM_BALL_ROLLING || label == CAROM_BALL_AIRBORNE;
}

/* The path of one ball, from event to event that it is in; thin, without arrows. */
static void draw_path(const view *v, const shot_line *line, const carom_shot *shot, int ball,
                      const char *colour, const char *dashes, bool thin) {
  char *heads;
  size_t heads_size;
  FILE *head = open_text(&heads, &heads_size);
  carom_ball_state states[CAROM_BALLS_MOST];
  double last = 0.0;
  bool moved = false;
  for (int64_t k = 0; last < shot->time; k++) {
    /* The next event, or the end of the picture. */
    const bool is_event = k < shot_events_kept(shot) && shot->events[k].time <= shot->time;
    const carom_ball_state *end = &shot->final[ball];
    double time = shot->time;
    if (is_event) {
      const int side = shot_event_side(&shot->events[k], ball);
      if (side < 0)
        continue;
      end = &shot->events[k].before[side];
      time = shot->events[k].time;
    }
    carom_shot_at(line->ball, line->count, shot, 0.5 * (last + time), states);
    const carom_ball_state middle = states[ball];
    const int64_t label = is_event ? end->label : middle.label;
    carom_shot_at(line->ball, line->count, shot, last, states);

    /* a piece from the event before, unless the ball has not moved yet or lies at the end */
    const bool has_piece = is_event ? moved || time > last : is_moving(label);
    if (has_piece) {
      if (!moved)
        fprintf(
            v->out,
            "<path fill=\"none\" stroke=\"%s\" stroke-width=\"%.1f\" stroke-linejoin=\"round\"%s "
            "d=\"M%.1f %.1f",
            colour, thin ? thin_path : v->scale * PALETTE_SIZE_PATH, dashes,
            across(v, states[ball].r), down(v, states[ball].r));
      moved = true;
      draw_piece(v, line, shot, ball, last, time, states[ball].r, end->r,
                 label == CAROM_BALL_SLIDING);
      if (!thin)
        draw_arrow(v, head, colour, &states[ball], end->r, &middle);
    }
    last = time;
  }
  if (moved)
    fputs("\"/>\n", v->out);
  close_text(head, &heads);
  fputs(heads, v->out);
  free(heads);
}

/* Part of a band, from a point to another: along one side and back along the other. */
static void draw_part(const view *v, FILE *out, const band_point *band, int start, int end) {
  char letter = 'M';
  for (int sign = 1; sign >= -1; sign -= 2)
    for (int n = 0; n <= end - start; n++, letter = 'L') {
      const band_point *p = &band[sign > 0 ? start + n : end - n];
      const double r[2] = {p->r[0] + sign * p->side[0], p->r[1] + sign * p->side[1]};
      fprintf(out, "%c%.1f %.1f", letter, across(v, r), down(v, r));
    }
  fputc('Z', out);
}

static ball_look look_in(const shot_line *line, int ball) {
  return look_of(line->name[ball], ball, line->ball[ball].kind.radius);
}

/* The band of a player's spread around a ball's path: where it is beyond reach, pale and dashed. */
static void draw_band(const view *v, const shot_line *line, const spread *s, int ball) {
  const band_point *band = s->band[ball];
  const char *colour = look_in(line, ball).path;
  for (int beyond = 0; beyond < 2; beyond++) {
    char *parts;
    size_t size;
    FILE *part = open_text(&parts, &size);
    for (int k = 0, start = -1; k < s->points[ball]; k++) {
      const bool goes_on =
          k + 1 < s->points[ball] && !band[k + 1].begins && (band[k + 1].time > s->end) == beyond;
      if (!goes_on && start >= 0)
        draw_part(v, part, band, start, k);
      if (!goes_on)
        start = -1;
      else if (start < 0)
        start = k;
    }
    close_text(part, &parts);
    if (size > 0)
      fprintf(v->out, "<path class=\"band\" fill=\"%s\" %s d=\"%s\"/>\n", colour,
              beyond ? "fill-opacity=\"0.12\" stroke=\"" PALETTE_TEXT "\" stroke-width=\"0.8\" "
                       "stroke-dasharray=\"5 4\""
                     : "fill-opacity=\"0.4\"",
              parts);
    free(parts);
  }
}

/* The ellipse of one standard deviation around the place where a ball ends. */
static void draw_ellipse(const view *v, const spread *s, const carom_ball_state *final, int ball) {
  const spread_axes axes = axes_of(s->final[ball]);
  if (s->cut[ball] || axes.along > spread_most || axes.along == 0.0 ||
      final->label == CAROM_BALL_POCKETED)
    return;
  const double x = across(v, final->r), y = down(v, final->r);
  fprintf(v->out,
          "<ellipse class=\"band\" cx=\"%.1f\" cy=\"%.1f\" rx=\"%.1f\" ry=\"%.1f\" "
          "transform=\"rotate(%.1f %.1f %.1f)\" fill=\"none\" stroke=\"" PALETTE_TEXT "\" "
          "stroke-width=\"1.6\"%s/>\n",
          x, y, v->scale * axes.along, v->scale * axes.across,
          v->turned ? 90.0 - axes.degrees : -axes.degrees, x, y,
          s->end < INFINITY ? " stroke-dasharray=\"5 4\"" : "");
}

/* Where a ball lies before the shot. */
static void draw_start(const view *v, const shot_line *line, int ball, double y) {
  svg_circle(v->out, across(v, line->ball[ball].state.r), y,
             v->scale * line->ball[ball].kind.radius,
             "fill=\"none\" stroke=\"%s\" stroke-dasharray=\"3 2\"", look_in(line, ball).path);
}

/* The band around a striped ball, as it is seen from the side of its number. */
static void draw_stripe(FILE *out, double x, double y, double r, const char *colour) {
  const double high = half_band * r, wide = sqrt(r * r - high * high);
  fprintf(out,
          "<path fill=\"%s\" d=\"M%.1f %.1fh%.1fA%.1f %.1f 0 0 1 %.1f %.1fh%.1fA%.1f %.1f 0 0 1 "
          "%.1f %.1fZ\"/>\n",
          colour, x - wide, y - high, 2.0 * wide, r, r, x + wide, y + high, -2.0 * wide, r, r,
          x - wide, y - high);
}

void draw_disc(const view *v, const shot_line *line, int ball, double x, double y, const char *name,
               const char *rim) {
  const ball_look look = look_in(line, ball);
  const double r = v->scale * line->ball[ball].kind.radius;
  const bool striped = is_striped(line->name[ball], line->ball[ball].kind.radius);
  svg_circle(v->out, x, y, r, "fill=\"%s\"", striped ? PALETTE_TEXT : look.colour);
  if (striped)
    draw_stripe(v->out, x, y, r, look.colour);
  svg_circle(v->out, x, y, r, "fill=\"none\" stroke=\"%s\" stroke-width=\"%.1f\"",
             rim != NULL ? rim : look.path, outline);
  if (strlen(name) <= 2)
    svg_text(v->out, x, y + 0.36 * v->labels->size, name, 2,
             "font-size=\"%.1f\" letter-spacing=\"%d\" fill=\"%s\" text-anchor=\"middle\"",
             v->labels->size, strlen(name) == 2 ? -3 : 0, look.ink);
}

/* A name of more than two letters stands beside the ball, unless the ball's colour says it: of the
 * reds of snooker that of one that moved. */
static void draw_ball(const view *v, const shot_line *line, const carom_ball_state *s, int ball,
                      const char *name, bool moved, const char *rim) {
  const double x = across(v, s->r), y = down(v, s->r);
  const bool one_of_many = strncmp(name, "red", 3) == 0 && name[3] != '\0' && moved;
  draw_disc(v, line, ball, x, y, name, rim);
  if (strlen(name) > 2 && (!is_colour(name) || one_of_many))
    put_label(v->labels, x, y, name);
}

/* ---- Balls that are down before the shot lie in a row under the table */

static bool is_missing(const shot_line *line, int ball) {
  return line->ball[ball].state.label == CAROM_BALL_POCKETED;
}

/* Draws them at a height of the picture, behind a word; returns the height of the row, 0 of none.
 * Without `draws` it only tells that. */
static double draw_missing(const view *v, const shot_line *line, double left, double top,
                           bool draws) {
  const double letters = v->labels->size;
  double x = left + 4.0 * letters, high = 0.0;
  for (int k = 0; k < line->count; k++) {
    if (!is_missing(line, k))
      continue;
    const double r = v->scale * line->ball[k].kind.radius;
    if (draws && high == 0.0)
      svg_text(v->out, left, top + r + 0.36 * letters, "Down:", 5,
               "font-size=\"%.1f\" fill=\"" PALETTE_TEXT "\"", letters);
    if (draws)
      draw_disc(v, line, k, x, top + r, line->name[k], NULL);
    x += 2.3 * r;
    high = fmax(high, 2.0 * r + 0.75 * letters);
  }
  return high;
}

/* Balls that fell lie beside each other in the pocket's place. */
static void spread_pocketed(const shot_line *line, carom_ball_state *final) {
  for (int k = 0; k < line->count; k++) {
    int fallen = 0;
    for (int earlier = 0; earlier < k; earlier++)
      fallen += final[k].label == CAROM_BALL_POCKETED &&
                line->ball[k].state.label != CAROM_BALL_POCKETED &&
                fabs(final[earlier].r[0] - final[k].r[0]) < 0.2 &&
                fabs(final[earlier].r[1] - final[k].r[1]) < 1e-9 &&
                final[earlier].label == CAROM_BALL_POCKETED;
    final[k].r[0] += 1.6 * fallen * line->ball[k].kind.radius;
  }
}

/* ---- From the side: places along the picture's width, as in the view from above, and heights
 * at the same scale */

/* How high a ball's centre comes above the cloth that it would lie on, m, at events and between. */
static double rise_of(const shot_line *line, const carom_shot *shot, int ball) {
  const double R = line->ball[ball].kind.radius, g = line->ball[ball].kind.gravity;
  const carom_ball_state *start = &line->ball[ball].state;
  const bool flies =
      start->label == CAROM_BALL_AIRBORNE || start->v[2] != 0.0 || start->r[2] > R + 1e-6;
  double most = flies ? start->r[2] - R + 0.5 * start->v[2] * fabs(start->v[2]) / g : 0.0;
  for (int64_t k = 0; k < shot_events_kept(shot); k++) {
    const int side = shot_event_side(&shot->events[k], ball);
    if (side < 0)
      continue;
    const carom_ball_state *s = &shot->events[k].after[side];
    const double climb = s->v[2] > 0.0 ? 0.5 * s->v[2] * s->v[2] / g : 0.0;
    if (s->label == CAROM_BALL_AIRBORNE)
      most = fmax(most, s->r[2] - R + climb);
  }
  return most;
}

/* The heights of one ball, up to the last time that it is on the table. */
static void draw_heights(const view *v, const shot_line *line, const carom_shot *shot, int ball,
                         double cloth) {
  enum { PIECES = 24 };
  carom_ball_state states[CAROM_BALLS_MOST];
  fprintf(v->out,
          "<path fill=\"none\" stroke=\"%s\" stroke-width=\"%.1f\" stroke-linejoin=\"round\" d=\"",
          look_in(line, ball).path, v->scale * PALETTE_SIZE_PATH);
  double last = 0.0;
  for (int64_t k = 0; k < shot_events_kept(shot); k++) {
    const carom_event *e = &shot->events[k];
    const int side = shot_event_side(e, ball);
    if (side < 0)
      continue;
    const int pieces = e->time > last ? PIECES : 0;
    for (int n = 0; n <= pieces; n++) {
      const carom_ball_state *s = &e->before[side];
      if (n < pieces) {
        const double time = last + (e->time - last) * n / pieces;
        carom_shot_at(line->ball, line->count, shot, time, states);
        s = &states[ball];
      }
      const char letter = last == 0.0 && n == 0 ? 'M' : 'L';
      fprintf(v->out, "%c%.1f %.1f", letter, across(v, s->r), cloth - v->scale * s->r[2]);
    }
    last = e->time;
  }
  fputs("\"/>\n", v->out);
}

/* The side view of the balls that rise by more than a millimetre, above a line for the cloth at
 * y = `cloth`, pixels. */
static void draw_side(const view *v, const shot_line *line, const carom_shot *shot, double cloth,
                      double width) {
  const carom_table *t = &line->table->table;
  fprintf(v->out, "<path d=\"M0 %.1fL%.1f %.1f\" stroke=\"%s\" stroke-width=\"3\"/>\n", cloth,
          width, cloth, colours_of(t).cloth);
  for (int k = 0; k < t->rails; k++) /* noses, as posts at their ends */
    for (int end = 0; end < 2; end++) {
      const double x = across(v, end == 0 ? t->rail[k].p : t->rail[k].q);
      fprintf(v->out,
              "<path d=\"M%.1f %.1fV%.1f\" stroke=\"" PALETTE_MARK "\" stroke-width=\"2\"/>\n", x,
              cloth, cloth - v->scale * t->rail[k].height);
    }
  for (int ball = line->count - 1; ball >= 0; ball--) {
    if (rise_of(line, shot, ball) > 1e-3)
      draw_heights(v, line, shot, ball, cloth);
    if (!is_missing(line, ball))
      draw_start(v, line, ball, cloth - v->scale * line->ball[ball].state.r[2]);
  }
}

/* The cushions that the ball of the cue meets, numbered, with their times. */
static void draw_rails(const view *v, labels *l, const shot_line *line, const carom_shot *shot) {
  const int ball = (int)line->cue.ball;
  char text[40];
  for (int64_t k = 0, rails = 0; k < shot_events_kept(shot) && rails < MOST_MARKED; k++)
    if (counts_as_rail(line, shot, k, ball)) {
      snprintf(text, sizeof text, "rail %d, %.2f s", (int)++rails, shot->events[k].time);
      put_label(l, across(v, shot->events[k].before[0].r), down(v, shot->events[k].before[0].r),
                text);
    }
}

/* ---- Several shots over each other: one colour for each, dashes for all but the cue ball */

#define DASHES " stroke-dasharray=\"7 4\""
/* Of a striped ball, whose path has the colour of the solid one that is as dark. */
#define STRIPES " stroke-dasharray=\"16 3\""

/* Which colour is which shot, in lines from y on; returns their height. Without `draws` it only
 * tells that. */
static double draw_legend(FILE *out, double left, double y, double letters, int columns,
                          const played *shots, int count, bool draws) {
  const double line = 1.25 * letters;
  double x = 0.0, height = 0.0;
  for (int shot = 0; shot < count && count > 1; shot++) {
    char text[80];
    snprintf(text, sizeof text, "%d: %s", shot + 1, text_or(shots[shot].line->title, "shot"));
    const double wide = (letter_width * (double)strlen(text) + 4.0) * letters;
    if (height == 0.0 || x + wide > letter_width * letters * columns) {
      height += line;
      x = 0.0;
    }
    if (draws) {
      const double base = y + height - line;
      fprintf(out,
              "<path class=\"legend\" d=\"M%.1f %.1fh%.1f\" stroke=\"%s\" stroke-width=\"4\"/>\n",
              left + x, base - 0.35 * letters, 2.0 * letters, line_colour(shot));
      svg_text(out, left + x + 2.5 * letters, base, text, 80,
               "font-size=\"%.1f\" fill=\"" PALETTE_TEXT "\"", letters);
    }
    x += wide;
  }
  if (draws && height > 0.0)
    svg_text(out, left, y + height, "Solid: the cue ball. Dashed: the other balls.", 80,
             "font-size=\"%.1f\" fill=\"" PALETTE_TEXT "\"", letters);
  return height > 0.0 ? height + line : 0.0;
}

static void draw_paths(const view *v, const played *shots, int count) {
  static labels nowhere; /* labels need not keep clear of thin paths */
  view thin = *v;
  thin.labels = &nowhere;
  for (int shot = 0; shot < count; shot++) {
    fputs(text_if(shots[shot].others_count > 0, "<g class=\"others\" opacity=\"0.4\">\n"), v->out);
    for (int n = 0; n < shots[shot].others_count; n++)
      for (int k = shots[shot].line->count - 1; k >= 0; k--)
        draw_path(&thin, shots[shot].line, &shots[shot].others[n], k,
                  look_in(shots[shot].line, k).path, "", true);
    fputs(text_if(shots[shot].others_count > 0, "</g>\n"), v->out);
  }
  for (int shot = count - 1; shot >= 0; shot--)
    for (int k = shots[shot].line->count - 1; k >= 0; k--) {
      const shot_line *line = shots[shot].line;
      const bool striped = is_striped(line->name[k], line->ball[k].kind.radius);
      if (count == 1)
        draw_path(v, line, shots[shot].shot, k, look_in(line, k).path, text_if(striped, STRIPES),
                  false);
      else
        draw_path(v, line, shots[shot].shot, k, line_colour(shot),
                  text_if(k != line->cue.ball, DASHES), false);
    }
}

static void draw_zones(const view *v, const played *shots, int count) {
  for (int shot = 0; shot < count; shot++) {
    const char *colour = line_colour(shot);
    if (shots[shot].zone_corners == 0)
      continue;
    fputs("<path class=\"zone\" d=\"", v->out);
    for (int k = 0; k < shots[shot].zone_corners; k++)
      fprintf(v->out, "%c%.1f %.1f", k == 0 ? 'M' : 'L', across(v, shots[shot].zone[k]),
              down(v, shots[shot].zone[k]));
    fprintf(v->out, "Z\" fill=\"%s\" fill-opacity=\"0.25\" stroke=\"%s\"/>\n", colour, colour);
  }
}

/* Where they end, kept free of labels and then drawn; what does not move, once. */
static void draw_ends(const view *v, const played *shots, int count) {
  for (int drawn = 0; drawn < 2; drawn++)
    for (int shot = 0; shot < count; shot++) {
      const shot_line *line = shots[shot].line;
      carom_ball_state final[CAROM_BALLS_MOST];
      memcpy(final, shots[shot].shot->final, (size_t)line->count * sizeof *final);
      spread_pocketed(line, final);
      for (int k = 0; k < line->count; k++) {
        const double r = v->scale * line->ball[k].kind.radius, x = across(v, final[k].r),
                     y = down(v, final[k].r);
        char number[12];
        if (is_missing(line, k) || (shot > 0 && !ball_moved(shots[shot].shot, k)))
          continue;
        if (drawn == 0) {
          keep_free(v->labels, x - r, y - r, x + r, y + r);
          continue;
        }
        snprintf(number, sizeof number, "%d", shot + 1);
        fputs("<g class=\"ball\">\n", v->out);
        draw_ball(v, line, &final[k], k, count > 1 && k == line->cue.ball ? number : line->name[k],
                  ball_moved(shots[shot].shot, k), count > 1 ? line_colour(shot) : NULL);
        fputs("</g>\n", v->out);
        if (shots[shot].spread != NULL)
          draw_ellipse(v, shots[shot].spread, &final[k], k);
      }
    }
}

/* The size of the table, pixels. */
static double width_of(const view *v) {
  return v->scale * (fmax(v->high[0] - v->low[0], v->high[1] - v->low[1]) + 2.0 * v->margin);
}

double picture_letters(const view *v) {
  return svg_letters(width_of(v));
}

void shots_draw(FILE *out, const played *shots, int count, const char *footer) {
  const carom_table *t = &shots[0].line->table->table;
  view v = view_of(out, t);
  static labels l;
  const double wide = width_of(&v);
  const double high = v.scale * (fmin(v.high[0] - v.low[0], v.high[1] - v.low[1]) + 2.0 * v.margin);
  const double letters = svg_letters(wide), left = 24.0;
  const int columns = (int)((wide - 2.0 * left) / (letter_width * letters));
  v.labels = &l;
  l = (labels){.out = out, .width = wide, .height = high, .size = letters};
  double rise = 0.0;
  for (int shot = 0; shot < count; shot++)
    for (int k = 0; k < shots[shot].line->count; k++)
      rise = fmax(rise, rise_of(shots[shot].line, shots[shot].shot, k));
  const double side =
      rise > 1e-3 ? v.scale * (rise + 2.0 * shots[0].line->ball[0].kind.radius) + side_margin : 0.0;
  const double below = side > 0.0 ? side + side_margin : 0.0,
               footer_height = svg_lines(NULL, left, 0.0, letters, columns, "", footer);
  const double legend = draw_legend(out, left, 0.0, letters, columns, shots, count, false);
  const double missing = draw_missing(&v, shots[0].line, left, 0.0, false);
  draw_table(&v, t,
             below + missing + legend + footer_height +
                 (legend + footer_height > 0.0 ? 1.5 * letters : 0.0));
  if (side > 0.0)
    fprintf(out, "<rect y=\"%.1f\" width=\"100%%\" height=\"%.1f\" fill=\"%s\"/>\n", high,
            below + (legend + footer_height > 0.0 ? 0.0 : 20.0), colours_of(t).cushion);
  for (int shot = 0; shot < count && side > 0.0; shot++)
    draw_side(&v, shots[shot].line, shots[shot].shot, high + side, wide);
  for (int k = 0; k < shots[0].line->count; k++)
    for (int shot = 0; shot < count && !is_missing(shots[shot].line, k); shot++) {
      const double *r = shots[shot].line->ball[k].state.r, *first = shots[0].line->ball[k].state.r;
      if (shot == 0 || r[0] != first[0] || r[1] != first[1])
        draw_start(&v, shots[shot].line, k, down(&v, r));
    }
  for (int shot = count - 1; shot >= 0; shot--)
    for (int k = shots[shot].line->count - 1; k >= 0 && shots[shot].spread != NULL; k--)
      draw_band(&v, shots[shot].line, shots[shot].spread, k);
  draw_zones(&v, shots, count);
  draw_paths(&v, shots, count);
  draw_ends(&v, shots, count);
  if (count == 1)
    draw_rails(&v, &l, shots[0].line, shots[0].shot);
  draw_missing(&v, shots[0].line, left, high + below + 0.25 * letters, true);
  const double under = high + below + missing + 1.25 * letters;
  draw_legend(out, left, under, letters, columns, shots, count, true);
  svg_lines(out, left, under + legend, letters, columns, "fill=\"" PALETTE_TEXT "\"", footer);
  fputs("</svg>\n", out);
}
