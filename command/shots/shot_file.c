/* Tables and shots from JSON Lines, and shots by options. What is missing in a line takes
 * pooltool's defaults; what is wrong is told by its key.
 *
 * The library has a second reader of balls and cues, core/src/record/record.c, because recordings
 * are another format: the names of members as keys, 0 as default, and exact text with a hash, which
 * the library reads without a parser of JSON. Both take the numbers of a ball and of a cue from the
 * rows of core/src/schema/numbers.h: here by carom_number_of(), there by macros. */
#include "shots/shot_file.h"

#include "program/program.h"
#include "rows/records.h"
#include "shots/json_values.h"
#include "shots/shot_table.h"

#include <errno.h>

enum { FIRST_ROOM = 512 }; /* for events */

struct shot_file {
  FILE *in;         /* NULL of shots by options, */
  shot_line *given; /* which are these: `count` of them, of which `number` have been read */
  size_t count, given_room;
  const char *path;
  char *text;
  size_t space, number;
  bool begun;          /* a line has been met that is not blank */
  named_table **table; /* each stays where it is, for the shots that refer to it */
  size_t tables, room;
  layout_moment moment;       /* of the shots, whose balls are read */
  carom_shot_cushion cushion; /* whose constants balls have by the name of their game */
};

static named_table *find_table(const shot_file *file, const char *id) {
  for (size_t k = file->tables; k-- > 0;)
    if (same_text(file->table[k]->id, id))
      return file->table[k];
  return NULL;
}

static void keep_table(shot_file *file, named_table *t) {
  file->table = grow(file->table, &file->room, file->tables + 1, sizeof *file->table);
  file->table[file->tables++] = t;
}

const named_table *shot_file_table(shot_file *file, const char *name, json_fault *f) {
  named_table *table = find_table(file, name);
  if (table != NULL)
    return table;
  table = built_in_table(name, f);
  if (table != NULL)
    keep_table(file, table);
  return table;
}

/* ---- Shots */

uint64_t numbers_that_differ(const carom_ball_kind *a, const carom_ball_kind *b) {
  const carom_number *n;
  uint64_t differ = 0;
  for (int k = 0; (n = carom_number_of(CAROM_PART_BALL, k)) != NULL; k++)
    if (memcmp((const char *)a + n->offset, (const char *)b + n->offset, sizeof(double)) != 0)
      differ |= (uint64_t)1 << k;
  return differ;
}

/* The numbers of a ball by their keys; the bits of `own_numbers` become those that differ from the
 * game's. */
static bool read_kind(const json_t *params, const char *where, carom_ball_kind *kind,
                      uint64_t *own_numbers, json_fault *f) {
  const carom_ball_kind of_game = *kind;
  char known[JSON_KEYS];
  if (!json_get_part(params, where, CAROM_PART_BALL, kind, f) ||
      !json_only(params, where, json_keys_of(CAROM_PART_BALL, "game", known), f))
    return false;
  *own_numbers |= numbers_that_differ(kind, &of_game);
  return true;
}

void kind_of_game(carom_game game, carom_shot_cushion cushion, carom_ball_kind *kind) {
  static bool warned = false;
  if (!carom_ball_kind_for(game, cushion, kind) && !warned)
    complain("%s has no constants for the cushion %s: the balls have those for its default model",
             carom_word(CAROM_WORDS_GAME, (int)game),
             carom_word(CAROM_WORDS_SHOT_CUSHION, (int)cushion));
  warned |= !carom_ball_kind_for(game, cushion, NULL);
}

/* The kind of the balls of a game, by its name; pooltool's pool balls where there is none. */
static bool read_game(shot_file *file, const json_t *params, const char *where,
                      carom_ball_kind *kind, json_fault *f) {
  const json_t *game = json_object_get(params, "game");
  *kind = carom_ball_kind_of(CAROM_GAME_POOLTOOL_POOL);
  if (game == NULL)
    return true;
  const char *name;
  for (int k = 0; (name = carom_word(CAROM_WORDS_GAME, k)) != NULL; k++)
    if (json_is_string(game) && same_text(name, json_string_value(game))) {
      kind_of_game((carom_game)k, file->cushion, kind);
      return true;
    }
  return json_wrong(f, "%sgame must be %s", where,
                    words_of(CAROM_WORDS_GAME, true, (char[MOST_WORDS]){""}));
}

/* Whether no ball before ball k has its name. */
static bool has_own_name(const shot_line *line, int k, json_fault *f) {
  for (int earlier = 0; earlier < k; earlier++)
    if (same_text(line->name[earlier], line->name[k]))
      return json_wrong(f, "balls[%d].id '%s' is that of another ball", k, line->name[k]);
  return true;
}

/* Ball k of a line; its state is that of `final`, if there is one, which the line then has too. */
static bool read_ball(shot_file *file, json_t *v, int k, const json_t *final, shot_line *line,
                      json_fault *f) {
  char where[64], key[80];
  snprintf(where, sizeof where, "balls[%d].", k);
  if (!json_get_id(v, where, &line->name[k], f) || !has_own_name(line, k, f))
    return false;
  carom_ball_kind *kind = &line->ball[k].kind;
  const json_t *params = json_object_get(v, "params");
  if (params != NULL && !json_is_object(params))
    return json_wrong(f, "%sparams must be an object", where);
  snprintf(key, sizeof key, "%sparams.", where);
  if (!read_game(file, params, key, kind, f) ||
      !read_kind(params, key, kind, &line->own_numbers, f))
    return false;
  if (json_object_get(params, "u_sp") == NULL && json_object_get(params, "game") == NULL)
    kind->mu_spin = 10.0 * 2.0 / 5.0 / 9.0 * kind->radius;
  if (final != NULL && json_object_get(final, line->name[k]) == NULL)
    return json_wrong(f, "--from final: final.balls has no ball '%s'", line->name[k]);
  if (final != NULL)
    json_object_set(v, "state", json_object_get(final, line->name[k]));
  double state[10];
  snprintf(key, sizeof key, "%sstate", where);
  if (!json_get_numbers(json_object_get(v, "state"), key, 10, state, f))
    return false;
  if (!(state[0] >= 0.0 && state[0] <= 9.0))
    return json_wrong(f, "%s[0] must be a label, 0 to 6", key);
  carom_ball_state *s = &line->ball[k].state;
  *s = (carom_ball_state){.r = {state[1], state[2], state[3]},
                          .v = {state[4], state[5], state[6]},
                          .w = {state[7], state[8], state[9]},
                          .label = (int64_t)state[0]};
  return true;
}

static bool read_cue(const json_t *json, shot_line *line, json_fault *f) {
  const json_t *v = json_object_get(json, "cue");
  carom_cue *cue = &line->cue;
  *cue = carom_cue_of(CAROM_GAME_POOLTOOL_POOL);
  cue->phi = 0.0;
  if (v == NULL)
    return true;
  if (!json_is_object(v))
    return json_wrong(f, "cue must be an object");
  char known[JSON_KEYS];
  if (!json_get_part(v, "cue.", CAROM_PART_CUE, cue, f) ||
      !json_only(v, "cue.", json_keys_of(CAROM_PART_CUE, "ball", known), f))
    return false;
  /* A strike says how high it is: the cue's usual b is not the centre. */
  if (json_object_get(v, "b") == NULL && json_object_size(v) > (json_object_get(v, "ball") != NULL))
    return json_wrong(f, "cue.b is missing: how far above the centre the tip touches, in radii of "
                         "the ball; 0 is the centre");
  const json_t *ball = json_object_get(v, "ball");
  if (ball == NULL)
    return true;
  if (!json_is_string(ball))
    return json_wrong(f, "cue.ball must be the id of a ball");
  for (cue->ball = 0; cue->ball < line->count; cue->ball++)
    if (same_text(line->name[cue->ball], json_string_value(ball)))
      return true;
  return json_wrong(f, "cue.ball '%s' is no ball of the shot", json_string_value(ball));
}

/* The final states of a line, where they are to be read; NULL where the balls before the shot
 * are. */
static bool final_states(const shot_file *file, const json_t *json, const json_t **states,
                         json_fault *f) {
  const json_t *final = json_object_get(json, "final");
  *states = NULL;
  if (file->moment == LAYOUT_START || (file->moment == LAYOUT_DEFAULT && final == NULL))
    return true;
  if (file->moment == LAYOUT_DEFAULT)
    return json_wrong(f, "this shot has been played, and its final states stand in the line: "
                         "--from final takes these, --from start the balls before the shot");
  *states = json_object_get(final, "balls");
  return *states != NULL ||
         json_wrong(f, "--from final: the line has no final states; `carom shoot --events none` "
                       "plays the shot and writes them");
}

static bool read_shot(shot_file *file, const json_t *json, shot_line *line, json_fault *f) {
  const json_t *id = json_object_get(json, "id"), *table = json_object_get(json, "table"), *balls,
               *final;
  json_t *v;
  size_t k;
  if (id != NULL)
    line->id = json_dumps(id, JSON_ENCODE_ANY);
  if (json_is_string(id))
    line->title = copy_text(json_string_value(id));
  if (table != NULL && !json_is_string(table))
    return json_wrong(f, "table must be the id of a table");
  if (!json_get_list(json, "balls", CAROM_BALLS_MOST, &balls, f))
    return false;
  if (json_array_size(balls) == 0)
    return json_wrong(f, "balls must be an array of 1 to %d balls", CAROM_BALLS_MOST);
  if (!final_states(file, json, &final, f))
    return false;
  json_array_foreach((json_t *)balls, k, v) {
    if (!read_ball(file, v, (int)k, final, line, f))
      return false;
    line->count++;
  }
  if (!read_cue(json, line, f))
    return false;
  const char *name = table != NULL ? json_string_value(table) : "pooltool";
  const named_table *found = shot_file_table(file, name, f);
  char known[MOST_WORDS];
  if (found == NULL && f->text[0] != '\0') {
    const json_fault of_measures = *f;
    return json_wrong(f, "table '%.80s': %s", name, of_measures.text);
  }
  if (found == NULL)
    return json_wrong(f, "table '%s' is not in the lines above, nor one of carom's: %s", name,
                      words_of(CAROM_WORDS_TABLE, true, known));
  line->table = found;
  return true;
}

/* ---- The file */

shot_file *shot_file_open(const char *path, carom_shot_cushion cushion, layout_moment moment) {
  FILE *in = input_open(path);
  if (in == NULL)
    return NULL;
  shot_file *file = allocate(1, sizeof *file);
  json_use_memory();
  file->in = in;
  file->path = input_name(path);
  file->cushion = cushion;
  file->moment = moment;
  return file;
}

shot_file *shot_file_given(const char *name) {
  shot_file *file = allocate(1, sizeof *file);
  json_use_memory();
  file->path = name;
  return file;
}

void shot_file_add(shot_file *file, const shot_line *shot) {
  file->given = grow(file->given, &file->given_room, file->count + 1, sizeof *file->given);
  file->given[file->count++] = *shot;
}

void shot_file_clear(shot_file *file) {
  for (size_t k = file->number; k < file->count; k++)
    shot_line_free(&file->given[k]);
  file->count = file->number = 0;
}

size_t shot_file_count(const shot_file *file) {
  return file->count;
}

void shot_file_print(FILE *out, const shot_file *file) {
  for (size_t k = file->number; k < file->count; k++) {
    const shot_line *line = &file->given[k];
    json_t *json = shot_line_of_options(line);
    json_write_short(out, json);
    putc('\n', out);
    json_decref(json);
  }
}

const char *shot_file_name(const shot_file *file) {
  return file->path;
}

static shot_read bad_line(shot_line *line, const char *text) {
  line->error = copy_text(text);
  return SHOT_SHOT;
}

/* Whether the file is of another kind, by its first line, which is `json` or cannot be read as
 * such: says what it is. */
static bool is_other_kind(const shot_file *file, size_t size, const json_t *json) {
  const char *first = file->text + strspn(file->text, " \t"),
             *kind = is_text(file->text, size) ? NULL : NOT_TEXT;
  if (kind == NULL && *first == '[')
    kind = "one array of JSON; each shot is a line (`jq -c '.[]'` makes lines of it)";
  else if (kind == NULL && json == NULL && *first == '{' && strpbrk(first, ":,}") == NULL)
    kind = "JSON over several lines; each shot is one line (`jq -c .` makes lines of it)";
  else if (kind == NULL && json == NULL && *first != '{')
    kind = "other text; CSV is read by `carom resolve`";
  if (kind != NULL)
    complain("%s: not JSON Lines, but %s", file->path, kind);
  return kind != NULL;
}

/* Reads a table, which is kept. */
static shot_read take_table(shot_file *file, shot_line *line) {
  json_fault f;
  named_table *t = allocate(1, sizeof *t);
  if (!read_table(line->json, t, &f)) {
    free_table(t);
    return bad_line(line, f.text);
  }
  keep_table(file, t);
  json_decref(line->json);
  line->json = NULL;
  return SHOT_TABLE;
}

/* Reads a line that is JSON: a shot or a table. SHOT_END: it is of another kind, and passed
 * over. */
static shot_read take_line(shot_file *file, json_t *json, shot_line *line) {
  json_fault f;
  line->json = json;
  const char *kind = json_string_value(json_object_get(json, "kind"));
  if (kind == NULL)
    return bad_line(line, "kind must be a text");
  if (same_text(kind, "table"))
    return take_table(file, line);
  if (same_text(kind, "shot")) {
    if (read_shot(file, json, line, &f))
      return SHOT_SHOT;
    line->table = NULL;
    return bad_line(line, f.text);
  }
  json_decref(json);
  line->json = NULL;
  return SHOT_END;
}

/* The next of the shots by options. */
static shot_read next_given(shot_file *file, shot_line *line) {
  json_fault f;
  if (file->number == file->count)
    return SHOT_END;
  *line = file->given[file->number++];
  line->number = file->number;
  for (int k = 0; k < line->count; k++)
    if (!has_own_name(line, k, &f)) {
      line->table = NULL;
      return bad_line(line, f.text);
    }
  return SHOT_SHOT;
}

/* The end of the file, unless it could not be read or is empty. */
static shot_read end_of(const shot_file *file) {
  if (!feof(file->in))
    complain("cannot read %s: %s", file->path, strerror(errno));
  else if (!file->begun)
    complain("%s: empty; a shot is a line of JSON", file->path);
  else
    return SHOT_END;
  return SHOT_FAILED;
}

shot_read shot_file_next(shot_file *file, shot_line *line, const char **text) {
  if (file->in == NULL)
    return next_given(file, line);
  ssize_t size;
  while ((size = getline(&file->text, &file->space, file->in)) >= 0) {
    if (file->number++ == 0 && size >= 3 && memcmp(file->text, "\xEF\xBB\xBF", 3) == 0)
      memmove(file->text, file->text + 3, (size_t)(size -= 3) + 1); /* the byte-order mark */
    if (strspn(file->text, " \t\r\n") == (size_t)size)
      continue;
    *line = (shot_line){.number = file->number};
    json_fault f;
    json_error_t error;
    json_t *json = json_loadb(file->text, (size_t)size, 0, &error);
    if (!file->begun && is_other_kind(file, (size_t)size, json)) {
      json_decref(json);
      return SHOT_FAILED;
    }
    file->begun = true;
    if (json == NULL) {
      json_wrong(&f, "no JSON at column %d: %s", error.column, error.text);
      return bad_line(line, f.text);
    }
    *text = file->text;
    const shot_read what = take_line(file, json, line);
    if (what != SHOT_END)
      return what;
  }
  return end_of(file);
}

shot_read shot_file_next_shot(shot_file *file, shot_line *line) {
  const char *unused;
  shot_read what;
  while ((what = shot_file_next(file, line, &unused)) == SHOT_TABLE)
    continue;
  return what;
}

void shot_line_give(shot_line *line, int k, double x) {
  const carom_number *n = carom_number_of(CAROM_PART_BALL, k);
  json_t *balls = json_object_get(line->json, "balls");
  line->given.of_balls |= (uint64_t)1 << k;
  line->given.of_cue_ball |= (uint64_t)1 << k;
  for (int i = 0; i < line->count; i++)
    memcpy((char *)&line->ball[i].kind + n->offset, &x, sizeof x);
  for (size_t i = 0; i < json_array_size(balls); i++) {
    json_t *ball = json_array_get(balls, i);
    json_t *params = json_object_get(ball, "params");
    if (params == NULL)
      json_object_set_new(ball, "params", params = json_object());
    json_object_set_new(params, n->key, json_real(x));
  }
}

void shot_line_keep(shot_line *line) {
  if (line->json == NULL && line->given.by_options)
    line->json = shot_line_of_options(line);
}

/* Once more, with room for all, where the events are more than there was room for. */
carom_status shot_line_play(const shot_line *line, const carom_shot_options *options,
                            carom_shot *shot) {
  for (shot->room = FIRST_ROOM;; shot->room = shot->count) {
    shot->events = allocate((size_t)shot->room, sizeof *shot->events);
    const carom_status status =
        carom_shoot(&line->table->table, line->ball, line->count, &line->cue, options, shot);
    if (shot->count <= shot->room)
      return status;
    free(shot->events);
  }
}

void shot_line_free(shot_line *line) {
  for (int k = 0; k < CAROM_BALLS_MOST; k++)
    free(line->name[k]);
  free(line->id);
  free(line->title);
  free(line->error);
  json_decref(line->json);
  *line = (shot_line){0};
}

void shot_file_close(shot_file *file) {
  for (size_t k = 0; k < file->tables; k++)
    free_table(file->table[k]);
  free(file->table);
  free(file->text);
  if (file->in != NULL && file->in != stdin)
    fclose(file->in);
  shot_file_clear(file);
  free(file->given);
  free(file);
}
