/* A page to print for a lesson: A4 at 96 pixels an inch. */
#include "lesson.h"

#include "memory.h"
#include "picture.h"
#include "stroke_words.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* pixels */
static const double wide = 794.0, high = 1123.0, margin = 48.0, letters = 14.0, small = 10.5;
static const double ball_radius = 62.0, note_line = 30.0;

/* The ball as the player sees it from behind the cue; the inner ring is the limit of the miscue. */
static void draw_ball(FILE *out, double x, double y) {
  svg_circle(out, x, y, ball_radius, "fill=\"#fff\" stroke=\"#111\" stroke-width=\"1.5\"");
  svg_circle(out, x, y, 0.5 * ball_radius,
             "fill=\"none\" stroke=\"#999\" stroke-dasharray=\"3 3\"");
  for (int hour = 1; hour <= 12; hour++) {
    char text[4];
    const double angle = 2.0 * acos(-1.0) * hour / 12.0, at = ball_radius + 11.0;
    snprintf(text, sizeof text, "%d", hour);
    svg_text(out, x + at * sin(angle), y - at * cos(angle) + 0.36 * small, text, 2,
             "font-size=\"%.1f\" text-anchor=\"middle\"", small);
  }
}

/* Where the tip touches it. */
static void draw_tip(FILE *out, const carom_cue *cue, double x, double y) {
  svg_circle(out, x - ball_radius * cue->a, y - ball_radius * cue->b, 6.0, "fill=\"#1d6fb8\"");
}

/* "Aim: ...", "Tip: ...", "Speed: ...", or in one line for one of several shots. */
static void tell_stroke(FILE *said, const played *shot, int number) {
  const shot_line *line = shot->line;
  if (number > 0)
    fprintf(said, "%d: ", number);
  else
    fputs("Aim: ", said);
  if (!tell_aim(said, line, &line->cue, shot->shot))
    fprintf(said, "%.1f degrees; nothing is met", line->cue.phi);
  fputs(number > 0 ? "; tip " : "\nTip: ", said);
  tell_tip(said, &line->cue);
  fputs(number > 0 ? "; " : "\nSpeed: ", said);
  tell_speed(said, &line->cue, &line->ball[line->cue.ball].kind);
  fputs("\n", said);
}

void lesson_draw(FILE *out, const played *shots, int count, const char *footer) {
  char *picture, *words;
  size_t size;
  double width = 1.0, height = 1.0;
  FILE *drawn = open_text(&picture, &size);
  shots_draw(drawn, shots, count, "");
  close_text(drawn, &picture);
  const char *box = strstr(picture, "viewBox=");
  sscanf(box != NULL ? box : "", "viewBox=\"0 0 %lf %lf\"", &width, &height);
  svg_begin(out, wide, high, "fill=\"#fff\"");
  svg_text(out, margin, margin, "Lesson", 20, "font-size=\"22\" font-weight=\"bold\"");
  svg_text(out, wide - margin, margin, "Player ____________________   Date ____________", 60,
           "font-size=\"%.1f\" text-anchor=\"end\"", letters);

  /* the picture, as wide as the page */
  const double scale = (wide - 2.0 * margin) / width;
  double y = margin + 16.0;
  fprintf(out, "<g transform=\"translate(%.1f %.1f) scale(%.5f)\">\n%s</g>\n", margin, y, scale,
          picture);
  y += scale * height + 2.0 * letters;

  /* the stroke, beside the ball with its tip; then what the balls do */
  const double ball_space = 2.0 * ball_radius + 44.0;
  const double ball_top = y;
  draw_ball(out, wide - margin - 0.5 * ball_space, y + ball_radius);
  for (int k = 0; k < count; k++)
    draw_tip(out, &shots[k].line->cue, wide - margin - 0.5 * ball_space, y + ball_radius);
  FILE *said = open_text(&words, &size);
  for (int k = 0; k < count; k++)
    tell_stroke(said, &shots[k], count > 1 ? k + 1 : 0);
  close_text(said, &words);
  y = svg_lines(out, margin, y, letters, 58, "font-weight=\"bold\"", words) + 0.5 * letters;
  /* smaller, where they are many */
  double size_of = small;
  int columns = 84;
  while (size_of > 4.0 &&
         svg_lines(NULL, margin, y, size_of, columns, "", footer) > high - margin) {
    size_of -= 0.5;
    columns = (int)(84.0 * small / size_of);
  }
  y = svg_lines(out, margin, y, size_of, columns, "", footer);
  free(words);
  free(picture);

  /* notes, up to the end of the page */
  y = fmax(y, ball_top + 2.0 * ball_radius + 30.0) + letters;
  svg_text(out, margin, y, "Notes", 20, "font-size=\"%.1f\" font-weight=\"bold\"", letters);
  for (y += note_line; y < high - 0.5 * margin; y += note_line)
    fprintf(out, "<path d=\"M%.1f %.1fH%.1f\" stroke=\"#999\"/>\n", margin, y, wide - margin);
  fputs("</svg>\n", out);
}
