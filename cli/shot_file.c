/* Tables and shots from JSON Lines. What is missing takes pooltool's defaults; what is wrong is told by its key. */
#include "shot_file.h"

#include "memory.h"
#include "message.h"

#include <errno.h>
#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

struct shot_file {
  FILE *in;
  const char *path;
  char *text;
  size_t space, number;
  named_table **table; /* each stays where it is, for the shots that refer to it */
  size_t tables, room;
  char engine[64];
};

/* ---- Values, with the key that is at fault */

typedef struct fault {
  char text[256];
} fault;

__attribute__((format(printf, 2, 3))) static bool wrong(fault *f, const char *format, ...) {
  va_list arguments;
  va_start(arguments, format);
  vsnprintf(f->text, sizeof f->text, format, arguments);
  va_end(arguments);
  return false;
}

/* The number object[key], or *value as it is where there is none. */
static bool get_number(const json_t *object, const char *where, const char *key, double *value, fault *f) {
  const json_t *v = json_object_get(object, key);
  if (v == NULL)
    return true;
  if (!json_is_number(v))
    return wrong(f, "%s%s must be a number", where, key);
  *value = json_number_value(v);
  return true;
}

/* `count` numbers of an array. */
static bool get_numbers(const json_t *array, const char *where, size_t count, double *value, fault *f) {
  if (!json_is_array(array) || json_array_size(array) < count)
    return wrong(f, "%s must be an array of %zu numbers", where, count);
  for (size_t k = 0; k < count; k++) {
    const json_t *v = json_array_get(array, k);
    if (!json_is_number(v))
      return wrong(f, "%s[%zu] must be a number", where, k);
    value[k] = json_number_value(v);
  }
  return true;
}

static char *copy_text(const char *text) {
  char *copy = allocate(strlen(text) + 1, 1);
  return strcpy(copy, text);
}

/* An id: a text or a whole number. */
static bool get_id(const json_t *object, const char *where, char **id, fault *f) {
  const json_t *v = json_object_get(object, "id");
  char digits[32];
  if (json_is_integer(v)) {
    snprintf(digits, sizeof digits, "%lld", (long long)json_integer_value(v));
    *id = copy_text(digits);
  } else if (json_is_string(v)) {
    *id = copy_text(json_string_value(v));
  } else {
    return wrong(f, "%sid must be a text", where);
  }
  return true;
}

/* ---- Tables */

static void free_table(named_table *t) {
  for (int k = 0; k < CAROM_RAILS_MOST; k++)
    free(t->rail[k]);
  for (int k = 0; k < CAROM_JAWS_MOST; k++)
    free(t->jaw[k]);
  for (int k = 0; k < CAROM_POCKETS_MOST; k++)
    free(t->pocket[k]);
  free(t->id);
  free(t);
}

static bool read_rail(const json_t *v, const char *where, carom_rail *rail, char **id, fault *f) {
  double p[3], q[3], side = NAN;
  char key[80];
  snprintf(key, sizeof key, "%sp1", where);
  if (!get_numbers(json_object_get(v, "p1"), key, 3, p, f))
    return false;
  snprintf(key, sizeof key, "%sp2", where);
  if (!get_numbers(json_object_get(v, "p2"), key, 3, q, f))
    return false;
  *rail = (carom_rail){.p = {p[0], p[1]}, .q = {q[0], q[1]}, .height = p[2]};
  if (!get_number(v, where, "lx", &rail->line[0], f) || !get_number(v, where, "ly", &rail->line[1], f) ||
      !get_number(v, where, "l0", &rail->line[2], f) || !get_number(v, where, "direction", &side, f))
    return false;
  if (side != 0.0 && side != 1.0)
    return wrong(f, "%sdirection must be 0 or 1", where);
  rail->side = side == 1.0;
  return get_id(v, where, id, f);
}

static bool read_circle(const json_t *v, const char *where, double centre[2], double *third, double *radius, char **id,
                        fault *f) {
  double c[3] = {0.0};
  char key[80];
  snprintf(key, sizeof key, "%scenter", where);
  const size_t numbers = json_array_size(json_object_get(v, "center")) >= 3 ? 3 : 2;
  if (!get_numbers(json_object_get(v, "center"), key, numbers, c, f))
    return false;
  centre[0] = c[0];
  centre[1] = c[1];
  *third = c[2];
  *radius = NAN;
  if (!get_number(v, where, "radius", radius, f))
    return false;
  return isnan(*radius) ? wrong(f, "%sradius is missing", where) : get_id(v, where, id, f);
}

/* The array object[key] with at most `most` elements; missing is empty. */
static bool get_list(const json_t *object, const char *key, size_t most, const json_t **list, fault *f) {
  *list = json_object_get(object, key);
  if (*list != NULL && !json_is_array(*list))
    return wrong(f, "%s must be an array", key);
  return json_array_size(*list) <= most ? true : wrong(f, "%s has more than %zu elements", key, most);
}

static bool read_table(const json_t *json, named_table *t, fault *f) {
  const json_t *list, *v;
  size_t k;
  char where[64];
  carom_table *table = &t->table;
  if (!get_id(json, "", &t->id, f) || !get_number(json, "", "w", &table->width, f) ||
      !get_number(json, "", "l", &table->length, f) || !get_list(json, "linear", CAROM_RAILS_MOST, &list, f))
    return false;
  json_array_foreach((json_t *)list, k, v) {
    snprintf(where, sizeof where, "linear[%zu].", k);
    if (!read_rail(v, where, &table->rail[k], &t->rail[k], f))
      return false;
    table->rails++;
  }
  if (!get_list(json, "circular", CAROM_JAWS_MOST, &list, f))
    return false;
  json_array_foreach((json_t *)list, k, v) {
    carom_jaw *jaw = &table->jaw[k];
    snprintf(where, sizeof where, "circular[%zu].", k);
    if (!read_circle(v, where, jaw->centre, &jaw->height, &jaw->radius, &t->jaw[k], f))
      return false;
    table->jaws++;
  }
  if (!get_list(json, "pockets", CAROM_POCKETS_MOST, &list, f))
    return false;
  json_array_foreach((json_t *)list, k, v) {
    carom_pocket *pocket = &table->pocket[k];
    double unused;
    snprintf(where, sizeof where, "pockets[%zu].", k);
    pocket->depth = 0.08;
    if (!read_circle(v, where, pocket->centre, &unused, &pocket->radius, &t->pocket[k], f) ||
        !get_number(v, where, "depth", &pocket->depth, f))
      return false;
    table->pockets++;
  }
  return true;
}

static named_table *find_table(const shot_file *file, const char *id) {
  for (size_t k = file->tables; k-- > 0;)
    if (strcmp(file->table[k]->id, id) == 0)
      return file->table[k];
  return NULL;
}

static void keep_table(shot_file *file, named_table *t) {
  file->table = grow(file->table, &file->room, file->tables + 1, sizeof *file->table);
  file->table[file->tables++] = t;
}

/* Tables that need no line, by the name of carom_table_make()'s kinds. */
static named_table *built_in_table(shot_file *file, const char *id) {
  static const char *const names[] = {"7ft", "8ft", "9ft", "snooker", "threecushion"};
  static const char *const rails[] = {"3",  "6", "15", "12", "18", "9",  "5",  "4",  "13",
                                      "14", "1", "2",  "8",  "7",  "11", "10", "16", "17"};
  static const char *const plain[] = {"3", "12", "9", "18"};
  static const char *const jaws[] = {"1t", "2t", "4t", "5t", "7t", "8t", "10t", "11t", "13t", "14t", "16t", "17t"};
  static const char *const pockets[] = {"lb", "lc", "lt", "rb", "rc", "rt"};
  for (int kind = 0; kind <= CAROM_TABLE_THREECUSHION; kind++) {
    if (strcmp(id, names[kind]) != 0)
      continue;
    named_table *t = allocate(1, sizeof *t);
    carom_table_make((carom_table_kind)kind, &t->table);
    t->id = copy_text(id);
    for (int k = 0; k < t->table.rails; k++)
      t->rail[k] = copy_text(t->table.rails == 4 ? plain[k] : rails[k]);
    for (int k = 0; k < t->table.jaws; k++)
      t->jaw[k] = copy_text(jaws[k]);
    for (int k = 0; k < t->table.pockets; k++)
      t->pocket[k] = copy_text(pockets[k]);
    keep_table(file, t);
    return t;
  }
  return NULL;
}

/* ---- Shots */

static bool read_ball(const json_t *v, int k, shot_line *line, fault *f) {
  char where[64], key[80];
  snprintf(where, sizeof where, "balls[%d].", k);
  if (!get_id(v, where, &line->name[k], f))
    return false;
  for (int other = 0; other < k; other++)
    if (strcmp(line->name[other], line->name[k]) == 0)
      return wrong(f, "%sid '%s' is that of another ball", where, line->name[k]);
  carom_ball_kind *kind = &line->ball[k].kind;
  *kind = carom_ball_kind_of(CAROM_GAME_POOL);
  const json_t *params = json_object_get(v, "params");
  if (params != NULL && !json_is_object(params))
    return wrong(f, "%sparams must be an object", where);
  snprintf(key, sizeof key, "%sparams.", where);
  double spin = NAN;
  if (!get_number(params, key, "m", &kind->mass, f) || !get_number(params, key, "R", &kind->radius, f) ||
      !get_number(params, key, "u_s", &kind->mu_slide, f) || !get_number(params, key, "u_r", &kind->mu_roll, f) ||
      !get_number(params, key, "u_sp", &spin, f) || !get_number(params, key, "u_b", &kind->mu_ball, f) ||
      !get_number(params, key, "e_b", &kind->restitution, f) ||
      !get_number(params, key, "e_c", &kind->restitution_cushion, f) || !get_number(params, key, "f_c", &kind->mu_cushion, f) ||
      !get_number(params, key, "g", &kind->gravity, f))
    return false;
  kind->mu_spin = isnan(spin) ? 10.0 * 2.0 / 5.0 / 9.0 * kind->radius : spin;
  double state[10];
  snprintf(key, sizeof key, "%sstate", where);
  if (!get_numbers(json_object_get(v, "state"), key, 10, state, f))
    return false;
  if (!(state[0] >= 0.0 && state[0] <= 9.0))
    return wrong(f, "%s[0] must be a label, 0 to 4", key);
  carom_ball_state *s = &line->ball[k].state;
  *s = (carom_ball_state){.r = {state[1], state[2], state[3]},
                          .v = {state[4], state[5], state[6]},
                          .w = {state[7], state[8], state[9]},
                          .label = (int64_t)state[0]};
  return true;
}

static bool read_cue(const json_t *json, shot_line *line, fault *f) {
  const json_t *v = json_object_get(json, "cue");
  carom_cue *cue = &line->cue;
  *cue = carom_cue_of(CAROM_GAME_POOL);
  cue->phi = 0.0;
  if (v == NULL)
    return true;
  if (!json_is_object(v))
    return wrong(f, "cue must be an object");
  if (!get_number(v, "cue.", "V0", &cue->speed, f) || !get_number(v, "cue.", "phi", &cue->phi, f) ||
      !get_number(v, "cue.", "theta", &cue->theta, f) || !get_number(v, "cue.", "a", &cue->a, f) ||
      !get_number(v, "cue.", "b", &cue->b, f) || !get_number(v, "cue.", "M", &cue->mass, f) ||
      !get_number(v, "cue.", "end_mass", &cue->end_mass, f) || !get_number(v, "cue.", "tip_radius", &cue->tip_radius, f))
    return false;
  const json_t *ball = json_object_get(v, "ball");
  if (ball == NULL)
    return true;
  if (!json_is_string(ball))
    return wrong(f, "cue.ball must be the id of a ball");
  for (cue->ball = 0; cue->ball < line->count; cue->ball++)
    if (strcmp(line->name[cue->ball], json_string_value(ball)) == 0)
      return true;
  return wrong(f, "cue.ball '%s' is no ball of the shot", json_string_value(ball));
}

static bool read_shot(shot_file *file, const json_t *json, shot_line *line, fault *f) {
  const json_t *id = json_object_get(json, "id"), *table = json_object_get(json, "table"), *balls, *v;
  size_t k;
  if (id != NULL)
    line->id = json_dumps(id, JSON_ENCODE_ANY);
  if (table != NULL && !json_is_string(table))
    return wrong(f, "table must be the id of a table");
  if (!get_list(json, "balls", CAROM_BALLS_MOST, &balls, f))
    return false;
  if (json_array_size(balls) == 0)
    return wrong(f, "balls must be an array of 1 to %d balls", CAROM_BALLS_MOST);
  json_array_foreach((json_t *)balls, k, v) {
    if (!read_ball(v, (int)k, line, f))
      return false;
    line->count++;
  }
  if (!read_cue(json, line, f))
    return false;
  const char *name = table != NULL ? json_string_value(table) : "7ft";
  const named_table *found = find_table(file, name);
  if (found == NULL)
    found = built_in_table(file, name);
  if (found == NULL)
    return wrong(f, "table '%s' is not in the lines above, nor 7ft, 8ft, 9ft, snooker or threecushion", name);
  line->table = found;
  return true;
}

/* ---- The file */

shot_file *shot_file_open(const char *path) {
  FILE *in = strcmp(path, "-") == 0 ? stdin : fopen(path, "rb");
  if (in == NULL) {
    complain("cannot read %s: %s", path, strerror(errno));
    return NULL;
  }
  shot_file *file = allocate(1, sizeof *file);
  file->in = in;
  file->path = path;
  return file;
}

static shot_read bad_line(shot_line *line, const char *text) {
  line->error = copy_text(text);
  return SHOT_SHOT;
}

shot_read shot_file_next(shot_file *file, shot_line *line, const char **text) {
  ssize_t size;
  while ((size = getline(&file->text, &file->space, file->in)) >= 0) {
    file->number++;
    if (strspn(file->text, " \t\r\n") == (size_t)size)
      continue;
    *line = (shot_line){.number = file->number};
    fault f;
    json_error_t error;
    json_t *json = json_loadb(file->text, (size_t)size, 0, &error);
    if (json == NULL) {
      wrong(&f, "no JSON at column %d: %s", error.column, error.text);
      return bad_line(line, f.text);
    }
    line->json = json;
    const char *kind = json_string_value(json_object_get(json, "kind"));
    if (kind == NULL)
      return bad_line(line, "kind must be a text");
    if (strcmp(kind, "shot") == 0) {
      if (!read_shot(file, json, line, &f)) {
        line->table = NULL;
        return bad_line(line, f.text);
      }
      return SHOT_SHOT;
    }
    if (strcmp(kind, "table") == 0) {
      named_table *t = allocate(1, sizeof *t);
      if (!read_table(json, t, &f)) {
        free_table(t);
        return bad_line(line, f.text);
      }
      keep_table(file, t);
      json_decref(json);
      line->json = NULL;
      *text = file->text;
      return SHOT_TABLE;
    }
    const char *engine = json_string_value(json_object_get(json, "engine"));
    if (engine != NULL)
      snprintf(file->engine, sizeof file->engine, "%s", engine);
    json_decref(json);
  }
  if (ferror(file->in)) {
    complain("cannot read %s: %s", file->path, strerror(errno));
    return SHOT_FAILED;
  }
  return SHOT_END;
}

const char *shot_file_engine(const shot_file *file) {
  return file->engine;
}

void shot_line_free(shot_line *line) {
  for (int k = 0; k < CAROM_BALLS_MOST; k++)
    free(line->name[k]);
  free(line->id);
  free(line->error);
  json_decref(line->json);
  *line = (shot_line){0};
}

void shot_file_close(shot_file *file) {
  for (size_t k = 0; k < file->tables; k++)
    free_table(file->table[k]);
  free(file->table);
  free(file->text);
  if (file->in != stdin)
    fclose(file->in);
  free(file);
}
