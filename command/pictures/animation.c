/* Shots that play, by the player of the page: web/player is in this program. Poses are written
 * at equal steps and at every event, so that between two of them a straight line does, and no
 * contact is cut short. */
#include "pictures/animation.h"

#include "player.h"
#include "program/program.h"
#include "shots/shot_story.h"

#include <jansson.h>

static const double step = 1.0 / 40.0; /* s */

bool is_moving_picture(const char *path) {
  const size_t size = strlen(path);
  return size > 4 && same_text(path + size - 4, ".svg");
}

OPTION_SET(set_animation) {
  const size_t size = strlen(text);
  *(const char **)field = text;
  if (size > 5 && same_text(text + size - 5, ".html"))
    return true;
  if (is_moving_picture(text))
    return true;
  return refuse_value(row, text, "its name does not end in .html or .svg; try shot.html");
}

/* The times of a shot's frames in order, to be freed. */
static double *frames_of(const carom_shot *shot, size_t *count) {
  const int64_t events = shot_events_kept(shot);
  const size_t steps = (size_t)ceil(shot->time / step) + 1;
  double *times = allocate(steps + (size_t)events, sizeof *times);
  int64_t next = 0;
  *count = 0;
  for (size_t k = 0; k < steps; k++) {
    const double time = fmin((double)k * step, shot->time);
    for (; next < events && shot->events[next].time <= time; next++)
      if (*count == 0 || shot->events[next].time > times[*count - 1])
        times[(*count)++] = shot->events[next].time;
    if (*count == 0 || time > times[*count - 1])
      times[(*count)++] = time;
  }
  return times;
}

static void write_text(FILE *out, const char *text) {
  json_t *json = json_string(text);
  /* No text ends the page's script. */
  json_dumpf(json, out, JSON_ENCODE_ANY | JSON_ESCAPE_SLASH);
  json_decref(json);
}

/* "table":{...},"balls":[[name, radius], ...] */
static void write_layout(FILE *out, const shot_line *line) {
  const carom_table *t = &line->table->table;
  fprintf(out, "\"table\":{\"width\":%.6g,\"length\":%.6g,\"rails\":[", t->width, t->length);
  for (int64_t k = 0; k < t->rails; k++)
    fprintf(out, "%s{\"p\":[%.5f,%.5f],\"q\":[%.5f,%.5f]}", text_if(k > 0, ","), t->rail[k].p[0],
            t->rail[k].p[1], t->rail[k].q[0], t->rail[k].q[1]);
  fputs("],\"jaws\":[", out);
  for (int64_t k = 0; k < t->jaws; k++)
    fprintf(out, "%s{\"centre\":[%.5f,%.5f],\"radius\":%.5f}", text_if(k > 0, ","),
            t->jaw[k].centre[0], t->jaw[k].centre[1], t->jaw[k].radius);
  fputs("],\"pockets\":[", out);
  for (int64_t k = 0; k < t->pockets; k++)
    fprintf(out, "%s{\"centre\":[%.5f,%.5f],\"radius\":%.5f}", text_if(k > 0, ","),
            t->pocket[k].centre[0], t->pocket[k].centre[1], t->pocket[k].radius);
  fputs("]},\n\"balls\":[", out);
  for (int ball = 0; ball < line->count; ball++) {
    fputs(ball > 0 ? ",[" : "[", out);
    write_text(out, line->name[ball]);
    fprintf(out, ",%.6f]", line->ball[ball].kind.radius);
  }
  fputs("]", out);
}

/* A pose: where the ball is, how it has turned, how it spins. Off the table it lies below it. */
static void write_pose(FILE *out, const carom_ball_state *s, const double turned[4]) {
  const double height = s->label == CAROM_BALL_OFF ? -1.0 : s->r[2];
  fprintf(out, "%.4f,%.4f,%.4f,%.4f,%.4f,%.4f,%.4f,%.1f,%.1f,%.1f", s->r[0], s->r[1], height,
          turned[0], turned[1], turned[2], turned[3], s->w[0], s->w[1], s->w[2]);
}

/* {"times":[...],"poses":[[10 numbers at each time] of each ball],"events":[[time, name, a, b]]} */
static void write_shot(FILE *out, const played *p) {
  size_t frames;
  double *times = frames_of(p->shot, &frames);
  const int count = p->line->count;
  fputs("{\"times\":[", out);
  for (size_t k = 0; k < frames; k++)
    fprintf(out, "%s%.6f", text_if(k > 0, ","), times[k]);
  fputs("],\"poses\":[", out);

  /* Of all balls at each time, and then ball by ball. */
  carom_ball_state *states = allocate(frames * (size_t)count, sizeof *states);
  double(*turned)[4] = allocate(frames * (size_t)count, sizeof *turned);
  carom_shot_frames(p->line->ball, count, p->shot, times, frames, NULL, states, turned);
  for (int ball = 0; ball < count; ball++) {
    fputs(ball > 0 ? ",\n[" : "[", out);
    /* A ball that lies still has one pose. */
    for (size_t k = 0; k < (ball_moved(p->shot, ball) ? frames : 1); k++) {
      const size_t pose = k * (size_t)count + (size_t)ball;
      fputs(text_if(k > 0, ","), out);
      write_pose(out, &states[pose], turned[pose]);
    }
    fputc(']', out);
  }
  free(turned);
  free(states);
  free(times);

  fputs("],\n\"events\":[", out);
  const char *separator = "";
  for (int64_t k = 0; k < p->shot->count && k < p->shot->room; k++) {
    const carom_event *e = &p->shot->events[k];
    const char *name = carom_word(CAROM_WORDS_EVENT, e->type);
    if (name == NULL)
      continue;
    fprintf(out, "%s[%.6f,\"%s\",%d,%d]", separator, e->time, name, (int)e->a, (int)e->b);
    separator = ",";
  }
  fputs("]}", out);
}

static const char head[] =
    "<!DOCTYPE html>\n<html lang=\"en\">\n<meta charset=\"utf-8\">\n<meta name=\"viewport\" "
    "content=\"width=device-width\">\n<title>carom shoot</title>\n"
    "<style>\n"
    "body{margin:1em auto;max-width:1200px;padding:0 8px;font:15px sans-serif;color:#1c1f22;"
    "background:#f7f7f5}\n"
    "h1{font-size:1.1em}svg{width:100%;height:auto}canvas{display:block;width:100%;margin:auto;"
    "border-radius:6px}\n"
    ".film{display:flex;gap:8px;align-items:center;margin:8px 0}.film input{flex:1;min-width:0}"
    "button,select{font:inherit;min-height:2em}\n"
    ".events{max-height:14em;overflow:auto;border:1px solid #ccc;margin-bottom:1em}ol{margin:0;"
    "padding:0;list-style:none}\n"
    ".events button{width:100%;border:0;background:none;text-align:left;display:grid;"
    "grid-template-columns:5em 1fr}[aria-current] button{background:#0b5fa5;color:#fff}\n"
    "@media print{canvas,.film,.events,h1{display:none}}\n"
    "</style>\n<main id=\"main\"><h1>carom shoot</h1></main>\n";

void shots_animate(FILE *out, const played *shots, int count, const char *footer) {
  fprintf(out, "%s<script type=\"module\">\n", head);
  fwrite(player_text, 1, sizeof player_text, out);
  fputs("\nconst film=recorded({", out);
  write_layout(out, shots[0].line);
  fputs(",\n\"shots\":[", out);
  for (int k = 0; k < count; k++) {
    fputs(text_if(k > 0, ",\n"), out);
    write_shot(out, &shots[k]);
  }
  fputs("]});\n"
        "const one=player();\n"
        "document.getElementById('main').append(one.canvas,one.controls,one.events,"
        "document.getElementById('picture'));\n"
        "addEventListener('resize',one.draw);\n"
        "one.show(film);one.start();\n"
        "</script>\n<div id=\"picture\">\n",
        out);
  shots_draw(out, shots, count, footer);
  fputs("</div>\n</html>\n", out);
}
