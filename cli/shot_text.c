/* Shots with their results as JSON Lines; numbers read back to the same doubles. */
#include "number.h"
#include "shot_file.h"

const char *shot_event_name(int type) {
  static const char *const names[] = {
      [CAROM_EVENT_STRIKE] = "stick_ball",
      [CAROM_EVENT_BALL_BALL] = "ball_ball",
      [CAROM_EVENT_RAIL] = "ball_linear_cushion",
      [CAROM_EVENT_JAW] = "ball_circular_cushion",
      [CAROM_EVENT_POCKET] = "ball_pocket",
      [CAROM_EVENT_SLIDING_ROLLING] = "sliding_rolling",
      [CAROM_EVENT_ROLLING_SPINNING] = "rolling_spinning",
      [CAROM_EVENT_ROLLING_STATIONARY] = "rolling_stationary",
      [CAROM_EVENT_SPINNING_STATIONARY] = "spinning_stationary",
  };
  return type >= 0 && type < (int)(sizeof names / sizeof names[0]) ? names[type] : NULL;
}

const char *shot_part_name(const named_table *table, const carom_event *event) {
  return event->type == CAROM_EVENT_RAIL  ? table->rail[event->b]
         : event->type == CAROM_EVENT_JAW ? table->jaw[event->b]
                                          : table->pocket[event->b];
}

/* A text with its quotes. */
static void write_text(FILE *out, const char *text) {
  putc('"', out);
  for (; *text != '\0'; text++) {
    const unsigned char c = (unsigned char)*text;
    if (c < 0x20)
      fprintf(out, "\\u%04x", c);
    else
      fprintf(out, c == '"' || c == '\\' ? "\\%c" : "%c", c);
  }
  putc('"', out);
}

static void write_state(FILE *out, const carom_ball_state *s) {
  fprintf(out, "[%d", (int)s->label);
  write_numbers(out, s->r, 3);
  write_numbers(out, s->v, 3);
  write_numbers(out, s->w, 3);
  putc(']', out);
}

static void write_event(FILE *out, const shot_line *line, const carom_event *e, int detail) {
  char text[NUMBER_TEXT];
  const bool pair = e->type == CAROM_EVENT_BALL_BALL;
  fprintf(out, ", [%s, \"%s\", [", number_text(e->time, text), shot_event_name(e->type));
  if (e->type == CAROM_EVENT_STRIKE)
    fputs("\"cue_stick\", ", out);
  write_text(out, line->name[e->a]);
  if (pair || (e->type >= CAROM_EVENT_RAIL && e->type <= CAROM_EVENT_POCKET)) {
    fputs(", ", out);
    write_text(out, pair ? line->name[e->b] : shot_part_name(line->table, e));
  }
  putc(']', out);
  for (int side = 0; side < 2 && detail == EVENTS_FULL; side++) {
    const carom_ball_state *states = side == 0 ? e->before : e->after;
    fputs(", [", out);
    write_state(out, &states[0]);
    if (pair) {
      fputs(", ", out);
      write_state(out, &states[1]);
    }
    putc(']', out);
  }
  putc(']', out);
}

/* Which balls fell where: by the final states, which lie at the pockets' centres. */
static void write_pockets(FILE *out, const shot_line *line, const carom_ball_state *final) {
  const named_table *t = line->table;
  fputs(", \"pockets\": {", out);
  for (int p = 0; p < t->table.pockets; p++) {
    fputs(p > 0 ? ", " : "", out);
    write_text(out, t->pocket[p]);
    fputs(": [", out);
    int in = 0;
    for (int k = 0; k < line->count; k++)
      if (final[k].label == CAROM_BALL_POCKETED && final[k].r[0] == t->table.pocket[p].centre[0] &&
          final[k].r[1] == t->table.pocket[p].centre[1]) {
        fputs(in++ > 0 ? ", " : "", out);
        write_text(out, line->name[k]);
      }
    putc(']', out);
  }
  putc('}', out);
}

static void write_head(FILE *out, const shot_line *line) {
  fprintf(out, "{\"kind\": \"shot\", \"id\": %s, ", line->id != NULL ? line->id : "null");
}

/* What was read, as it was read. */
static void write_given(FILE *out, const shot_line *line, const char *key) {
  char *text = json_dumps(json_object_get(line->json, key), JSON_ENCODE_ANY | JSON_REAL_PRECISION(17));
  if (text != NULL)
    fprintf(out, "\"%s\": %s, ", key, text);
  free(text);
}

void shot_write(FILE *out, const shot_line *line, const carom_shot *shot, carom_status status, int events) {
  char text[NUMBER_TEXT];
  write_head(out, line);
  write_given(out, line, "family");
  fputs("\"table\": ", out);
  write_text(out, line->table->id);
  fputs(", ", out);
  write_given(out, line, "cue");
  write_given(out, line, "balls");
  /* pooltool's list has an event of nothing at either end */
  fprintf(out, "\"n_events\": %lld, ", (long long)shot->count + 2);
  if (events != EVENTS_NONE) {
    const char *nothing = events == EVENTS_FULL ? ", [], []" : "";
    fprintf(out, "\"events\": [[0, \"none\", []%s]", nothing);
    for (int64_t k = 0; k < shot->count && k < shot->room; k++)
      write_event(out, line, &shot->events[k], events);
    fprintf(out, ", [%s, \"none\", []%s]], ", number_text(shot->time, text), nothing);
  }
  fprintf(out, "\"final\": {\"t\": %s, \"balls\": {", number_text(shot->time, text));
  for (int k = 0; k < line->count; k++) {
    fputs(k > 0 ? ", " : "", out);
    write_text(out, line->name[k]);
    fputs(": ", out);
    write_state(out, &shot->final[k]);
  }
  putc('}', out);
  write_pockets(out, line, shot->final);
  fprintf(out, "}, \"status\": \"%s\"", carom_status_name(status));
  if (status < 0) {
    fputs(", \"error\": ", out);
    write_text(out, carom_status_string(status));
  }
  fputs("}\n", out);
}

void shot_write_error(FILE *out, const shot_line *line, const char *status, const char *error) {
  write_head(out, line);
  fprintf(out, "\"status\": \"%s\", \"error\": ", status);
  write_text(out, error);
  fputs("}\n", out);
}
