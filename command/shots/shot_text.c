/* Shots with their results as JSON Lines; numbers read back to the same doubles. */
#include "shots/shot_file.h"

#include "shots/json_values.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

int shot_event_side(const carom_event *event, int ball) {
  if (event->a == ball)
    return 0;
  return event->type == CAROM_EVENT_BALL_BALL && event->b == ball ? 1 : -1;
}

int64_t shot_events_kept(const carom_shot *shot) {
  return shot->count < shot->room ? shot->count : shot->room;
}

const char *shot_event_name(int type) {
  return carom_word(CAROM_WORDS_EVENT, type);
}

const char *shot_part_name(const named_table *table, const carom_event *event) {
  const int64_t rails = table->table.rails;
  switch (event->type) {
  case CAROM_EVENT_RAIL:
    return table->rail[event->b];
  case CAROM_EVENT_JAW:
    return table->jaw[event->b];
  case CAROM_EVENT_POCKET:
    return table->pocket[event->b];
  case CAROM_EVENT_RAIL_TOP:
    return event->b < rails ? table->rail[event->b] : table->jaw[event->b - rails];
  default:
    return NULL;
  }
}

/* ---- Parts of a line. Non-finite numbers, which JSON has not, become null. */

static void append_numbers(json_t *array, const double *x, int count) {
  for (int k = 0; k < count; k++)
    json_array_append_new(array, isfinite(x[k]) ? json_real(x[k]) : json_null());
}

/* [label, r, v, w] */
static json_t *state_of(const carom_ball_state *s) {
  json_t *state = json_pack("[i]", (int)s->label);
  append_numbers(state, s->r, 3);
  append_numbers(state, s->v, 3);
  append_numbers(state, s->w, 3);
  return state;
}

/* [time, type, ids], and in full the states before and after. */
static json_t *event_of(const shot_line *line, const carom_event *e, int detail) {
  const bool pair = e->type == CAROM_EVENT_BALL_BALL;
  const char *part = shot_part_name(line->table, e);
  json_t *ids = json_array();
  /* What took part. */
  if (e->type == CAROM_EVENT_STRIKE)
    json_array_append_new(ids, json_string("cue_stick"));
  json_array_append_new(ids, json_string(line->name[e->a]));
  if (pair || part != NULL)
    json_array_append_new(ids, json_string(pair ? line->name[e->b] : part));
  json_t *event = json_pack("[f, s, o]", e->time, shot_event_name(e->type), ids);
  /* How it moved. */
  for (int side = 0; side < 2 && detail == EVENTS_FULL; side++) {
    const carom_ball_state *states = side == 0 ? e->before : e->after;
    json_t *both = json_pack("[o]", state_of(&states[0]));
    if (pair)
      json_array_append_new(both, state_of(&states[1]));
    json_array_append_new(event, both);
  }
  return event;
}

/* pooltool's lists of events have one of nothing at either end. */
static json_t *nothing_at(double time, int detail) {
  return detail == EVENTS_FULL ? json_pack("[f, s, [], [], []]", time, "none")
                               : json_pack("[f, s, []]", time, "none");
}

/* Which balls fell where: by the final states, which lie at the pockets' centres. */
static json_t *pockets_of(const shot_line *line, const carom_ball_state *final) {
  const named_table *t = line->table;
  json_t *pockets = json_object();
  for (int p = 0; p < t->table.pockets; p++) {
    const double *centre = t->table.pocket[p].centre;
    json_t *in = json_array();
    for (int k = 0; k < line->count; k++)
      if (final[k].label == CAROM_BALL_POCKETED && final[k].r[0] == centre[0] &&
          final[k].r[1] == centre[1])
        json_array_append_new(in, json_string(line->name[k]));
    json_object_set_new(pockets, t->pocket[p], in);
  }
  return pockets;
}

/* ---- Lines */

json_t *shot_json(json_t *id, json_t *family, const char *table, json_t *cue, json_t *balls) {
  json_t *line = json_pack("{s: s, s: o}", "kind", "shot", "id", id != NULL ? id : json_null());
  if (family != NULL)
    json_object_set_new(line, "family", family);
  if (table != NULL)
    json_object_set_new(line, "table", json_string(table));
  if (cue != NULL)
    json_object_set_new(line, "cue", cue);
  if (balls != NULL)
    json_object_set_new(line, "balls", balls);
  return line;
}

/* ---- What the lines of shots by options say */

/* The numbers of a cue by their keys: the stroke, and what is given or not 0 besides. */
static json_t *cue_of_options(const shot_line *line) {
  const carom_number *n;
  json_t *object = json_object();
  for (int k = 0; (n = carom_number_of(CAROM_PART_CUE, k)) != NULL; k++) {
    double x = 0.0;
    if (n->key[0] != '\0')
      memcpy(&x, (const char *)&line->cue + n->offset, sizeof x);
    const bool of_stroke = n->offset <= (int32_t)offsetof(carom_cue, b);
    if (x != 0.0 || (line->given.of_cue >> k & 1) != 0 || of_stroke)
      json_object_set_new(object, n->key, json_short(x + 0.0));
  }
  json_object_set_new(object, "ball", json_string(line->name[line->cue.ball]));
  return object;
}

/* A ball at rest, with the numbers that are given. */
static json_t *ball_of_options(const shot_line *line, int k) {
  enum { LABEL, X, Y, Z, NUMBERS = 10 };
  const double *r = line->ball[k].state.r;
  const double state[NUMBERS] = {[X] = r[0], [Y] = r[1], [Z] = r[2]};
  const given_keys *given = &line->given;
  const uint64_t set = k == line->cue.ball ? given->of_cue_ball : given->of_balls;
  const carom_number *n;
  json_t *params = json_pack("{s: s}", "game", carom_word(CAROM_WORDS_GAME, (int)given->game)),
         *numbers = json_array();
  for (int number = 0; (n = carom_number_of(CAROM_PART_BALL, number)) != NULL; number++) {
    double x;
    memcpy(&x, (const char *)&line->ball[k].kind + n->offset, sizeof x);
    if ((set >> number & 1) != 0)
      json_object_set_new(params, n->key, json_short(x));
  }
  for (int number = LABEL; number < NUMBERS; number++)
    json_array_append_new(numbers, json_short(state[number]));
  return json_pack("{s: s, s: o, s: o}", "id", line->name[k], "params", params, "state", numbers);
}

static json_t *balls_of_options(const shot_line *line) {
  json_t *balls = json_array();
  for (int k = 0; k < line->count; k++)
    json_array_append_new(balls, ball_of_options(line, k));
  return balls;
}

json_t *shot_line_value(const shot_line *line, const char *key) {
  if (line->json != NULL || !line->given.by_options)
    return json_incref(json_object_get(line->json, key));
  if (strcmp(key, "id") == 0)
    return json_string(line->title);
  if (strcmp(key, "cue") == 0)
    return cue_of_options(line);
  if (strcmp(key, "balls") == 0)
    return balls_of_options(line);
  return NULL;
}

json_t *shot_line_of_options(const shot_line *line) {
  return shot_json(shot_line_value(line, "id"), NULL, line->table->id, shot_line_value(line, "cue"),
                   shot_line_value(line, "balls"));
}

json_t *shot_line_json(const shot_line *line, json_t *id, const carom_cue *cue) {
  /* the numbers of the stroke, of which a < 0 is right in the file */
  json_t *stroke = json_object(), *line_cue = shot_line_value(line, "cue");
  if (line_cue != NULL)
    json_object_update(stroke, line_cue);
  json_decref(line_cue);
  const carom_number *n;
  for (int k = 0; (n = carom_number_of(CAROM_PART_CUE, k)) != NULL; k++) {
    double x = 0.0;
    if (n->key[0] != '\0')
      memcpy(&x, (const char *)cue + n->offset, sizeof x);
    if (n->offset <= (int32_t)offsetof(carom_cue, b))
      json_object_set_new(stroke, n->key, json_real(x + 0.0));
  }

  /* the balls in the order of the file, which a subcommand may have changed in its copy */
  json_t *line_balls = shot_line_value(line, "balls"), *balls = json_deep_copy(line_balls), *ball;
  json_decref(line_balls);
  size_t place;
  json_array_foreach(balls, place, ball) {
    char *ball_id;
    json_fault fault;
    json_get_id(ball, "", &ball_id, &fault);
    for (int k = 0; k < line->count; k++)
      if (strcmp(ball_id, line->name[k]) == 0)
        json_object_set_new(ball, "state", state_of(&line->ball[k].state));
    free(ball_id);
  }
  return shot_json(id, NULL, line->table->id, stroke, balls);
}

void shot_json_write(FILE *out, json_t *line) {
  json_dumpf(line, out, JSON_REAL_PRECISION(17));
  putc('\n', out);
  json_decref(line);
}

void shot_write(FILE *out, const shot_line *line, const carom_shot *shot, carom_status status,
                int events, json_t *spread) {
  json_t *object =
      shot_json(shot_line_value(line, "id"), shot_line_value(line, "family"), line->table->id,
                shot_line_value(line, "cue"), shot_line_value(line, "balls"));
  /* What happened. */
  json_object_set_new(object, "n_events", json_integer(shot->count + 2));
  if (events != EVENTS_NONE) {
    json_t *list = json_pack("[o]", nothing_at(0.0, events));
    for (int64_t k = 0; k < shot->count && k < shot->room; k++)
      json_array_append_new(list, event_of(line, &shot->events[k], events));
    json_array_append_new(list, nothing_at(shot->time, events));
    json_object_set_new(object, "events", list);
  }
  /* How it ended. */
  json_t *balls = json_object();
  for (int k = 0; k < line->count; k++)
    json_object_set_new(balls, line->name[k], state_of(&shot->final[k]));
  json_object_set_new(object, "final",
                      json_pack("{s: f, s: o, s: o}", "t", shot->time, "balls", balls, "pockets",
                                pockets_of(line, shot->final)));
  if (spread != NULL)
    json_object_set_new(object, "spread", spread);
  json_object_set_new(object, "status", json_string(carom_status_name(status)));
  if (status < 0)
    json_object_set_new(object, "error", json_string(carom_status_string(status)));
  shot_json_write(out, object);
}

void shot_write_error(FILE *out, const shot_line *line, const char *status, const char *error) {
  json_t *object = shot_json(shot_line_value(line, "id"), NULL, NULL, NULL, NULL);
  json_object_set_new(object, "status", json_string(status));
  json_object_set_new(object, "error", json_string(error));
  shot_json_write(out, object);
}
