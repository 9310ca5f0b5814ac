/* Cases as rows of a file: calls that are rejected, and what they leave. A row has statements with
 * ; between them, and begins with the objects of set_up() in functions.h.
 *
 *   table KIND, table empty SIZE      a table without balls and without a cue
 *   balls GAME COUNT                  more balls, at rest on the cloth
 *   cue GAME
 *   PATH = VALUE, ...                 one number, or several of an array
 *   call FUNCTION,... STATUS NOTES    each function returns this status
 *   expect PATH = VALUE within VALUE  or >
 *
 * NOTES: `without N`, argument N is NULL; `where N`, the position that a check names; `unchanged`,
 * nothing of the shot or of states is written; `nan PATH`, this object has no numbers.
 *
 * A value is a number, a path or a word of the library. A path is like ball[1].r[0], the position
 * of a ball. */
#include "functions.h"
#include "row_file.h"

static const char *file_name;

/* The letters, digits and underscores that come next. */
static const char *read_word(void) {
  static char word[64];
  size_t length = 0;
  skip_spaces();
  while (is_word_part(*cursor) && length + 1 < sizeof word)
    word[length++] = *cursor++;
  word[length] = '\0';
  return word;
}

/* ---- Numbers by their paths */

/* What a position is: a number of a type, or a struct. Those with rows of numbers are 10 and their
 * kind of part. */
enum { DOUBLE, INT32, INT64, UINT64, STRUCT = 10 };
enum {
  STRUCT_rail = STRUCT + CAROM_PART_RAIL,
  STRUCT_jaw = STRUCT + CAROM_PART_JAW,
  STRUCT_pocket = STRUCT + CAROM_PART_POCKET,
  STRUCT_ball_kind = STRUCT + CAROM_PART_BALL,
  STRUCT_shot_options = STRUCT + CAROM_PART_OPTIONS,
  STRUCT_options = STRUCT + CAROM_PART_IMPACT_OPTIONS,
  STRUCT_cushion_options = STRUCT + CAROM_PART_CUSHION_OPTIONS,
  STRUCT_cue = STRUCT + CAROM_PART_CUE,
  STRUCT_table = STRUCT + CAROM_PART_TABLE,
  STRUCT_ball_state = STRUCT + CAROM_PART_STATE,
  STRUCT_measures = STRUCT + CAROM_PART_MEASURES,
  STRUCT_corner = STRUCT + CAROM_PART_CORNER,
  STRUCT_shot_ball,
  STRUCT_event,
  STRUCT_shot,
  STRUCT_impact,
  STRUCT_cushion_impact,
  STRUCT_result,
  STRUCT_motion,
  STRUCT_part,
  STRUCT_table_fault,
  STRUCT_shot_job,
  STRUCT_fault,
  STRUCT_trace_point,
  STRUCT_cushion_point,
  KINDS
};

typedef struct location {
  char *address;
  int type;  /* what is there */
  int words; /* the names of its values; -1: none */
} location;

#define MEMBER(parent, name, type) \
  { STRUCT_##parent, #name, offsetof(carom_##parent, name), type }
static const struct {
  int parent;
  const char *name;
  size_t offset;
  int type;
} members[] = {
    MEMBER(table, rails, INT64),
    MEMBER(table, jaws, INT64),
    MEMBER(table, pockets, INT64),
    MEMBER(table, rail, STRUCT_rail),
    MEMBER(table, jaw, STRUCT_jaw),
    MEMBER(table, pocket, STRUCT_pocket),
    MEMBER(shot_options, unused, INT32),
    MEMBER(shot_options, reserved, UINT64),
    MEMBER(options, unused, INT32),
    MEMBER(options, reserved, UINT64),
    MEMBER(cushion_options, reserved, UINT64),
    MEMBER(corner, x, DOUBLE),
    MEMBER(event, time, DOUBLE),
    MEMBER(shot, count, INT64),
    MEMBER(shot, room, INT64),
    MEMBER(shot, time, DOUBLE),
    MEMBER(result, a, STRUCT_motion),
    MEMBER(result, b, STRUCT_motion),
    MEMBER(motion, v, DOUBLE),
    MEMBER(motion, w, DOUBLE),
    MEMBER(part, kind, INT32),
    MEMBER(part, index, INT32),
    MEMBER(table_fault, part, STRUCT_part),
    MEMBER(table_fault, other, STRUCT_part),
    MEMBER(table_fault, place, DOUBLE),
    MEMBER(table_fault, gap, DOUBLE),
    MEMBER(fault, part, STRUCT_part),
    MEMBER(trace_point, normal, DOUBLE),
    MEMBER(trace_point, u_z, DOUBLE),
    MEMBER(cushion_point, work, DOUBLE),
    MEMBER(shot_job, count, INT64),
    MEMBER(shot_job, reserved, UINT64),
};

#define SIZE(name) [STRUCT_##name] = sizeof(carom_##name)
static const size_t sizes[KINDS] = {8,
                                    4,
                                    8,
                                    8,
                                    SIZE(rail),
                                    SIZE(jaw),
                                    SIZE(pocket),
                                    SIZE(ball_state),
                                    SIZE(corner),
                                    SIZE(shot_ball),
                                    SIZE(event),
                                    SIZE(result),
                                    SIZE(trace_point),
                                    SIZE(cushion_point),
                                    SIZE(motion)};

#define OBJECT(object, type) \
  { #object, &(object), type }
static const struct {
  const char *name;
  void *object;
  int type;
} objects[] = {
    {"ball", balls, STRUCT_shot_ball},
    {"event", events, STRUCT_event},
    {"corner", corners, STRUCT_corner},
    OBJECT(table, STRUCT_table),
    OBJECT(cue, STRUCT_cue),
    OBJECT(options, STRUCT_shot_options),
    OBJECT(final, STRUCT_ball_state),
    OBJECT(states, STRUCT_ball_state),
    OBJECT(shot, STRUCT_shot),
    {"impact", impacts, STRUCT_impact},
    OBJECT(impact_options, STRUCT_options),
    {"result", results, STRUCT_result},
    {"rail", rails, STRUCT_cushion_impact},
    OBJECT(cushion_options, STRUCT_cushion_options),
    OBJECT(motion, STRUCT_motion),
    OBJECT(measures, STRUCT_measures),
    OBJECT(table_fault, STRUCT_table_fault),
    OBJECT(part, STRUCT_part),
    OBJECT(job, STRUCT_shot_job),
    OBJECT(fault, STRUCT_fault),
    OBJECT(points, STRUCT_trace_point),
    OBJECT(cushion_points, STRUCT_cushion_point),
    OBJECT(times, DOUBLE),
    OBJECT(readings, DOUBLE),
    {"misfit", &calibration.misfit, DOUBLE},
    {"bank_speed", &bank.speed, DOUBLE},
    {"bank_roll", &bank.roll, DOUBLE},
    OBJECT(place_x, DOUBLE),
    OBJECT(place_y, DOUBLE),
    OBJECT(radius, DOUBLE),
    OBJECT(height, DOUBLE),
    OBJECT(jaw_radius, DOUBLE),
    OBJECT(gap, DOUBLE),
    OBJECT(count, INT32),
    OBJECT(place, INT32),
    OBJECT(corners_count, INT32),
    OBJECT(table_kind, INT32),
    OBJECT(points_count, INT32),
    OBJECT(room, INT32),
    OBJECT(found, INT32),
    OBJECT(bank_index, INT32),
};

static double read_value(int words);

/* A number of a part, by its row; options of a cushion have some of those of a ball. */
static bool find_row(location *target, carom_part_kind parent, const char *name) {
  const bool is_option = target->type == STRUCT_cushion_options && parent == CAROM_PART_BALL;
  const carom_number *row;
  for (int k = 0; (row = carom_number_of(parent, k)) != NULL; k++)
    if (strcmp(row->name, name) == 0) {
      *target = (location){target->address + (is_option ? row->cushion_offset : row->offset),
                           (int)row->type, row->words};
      return true;
    }
  return target->type == STRUCT_cushion_options && !is_option &&
         find_row(target, CAROM_PART_BALL, name);
}

static bool find_member(location *target, const char *name) {
  /* a ball has the members of its kind and of its state */
  location ball_part = {target->address + offsetof(carom_shot_ball, kind), STRUCT_ball_kind, -1};
  if (target->type == STRUCT_shot_ball && find_row(&ball_part, CAROM_PART_BALL, name)) {
    *target = ball_part;
    return true;
  }
  if (target->type == STRUCT_shot_ball)
    *target = (location){target->address + offsetof(carom_shot_ball, state), STRUCT_ball_state, -1};
  for (size_t k = 0; k < COUNT_OF(members); k++)
    if (members[k].parent == target->type && strcmp(members[k].name, name) == 0) {
      *target = (location){target->address + members[k].offset, members[k].type, -1};
      return true;
    }
  return target->type > STRUCT && target->type <= STRUCT_corner &&
         find_row(target, (carom_part_kind)(target->type - STRUCT), name);
}

/* A number of an impact, by the library's name of it. */
static bool find_field(location *target) {
  const bool is_cushion = target->type == STRUCT_cushion_impact;
  const char *name;
  for (int k = 0; (name = is_cushion ? carom_cushion_field_name(k) : carom_field_name(k)) != NULL;
       k++)
    if (skip(name)) {
      *target = (location){target->address + (size_t)k * sizeof(double), DOUBLE, -1};
      return true;
    }
  return false;
}

/* Reads the rest of a path: members and indices. */
static location follow(location target) {
  for (;;) {
    if (*cursor == '[') {
      cursor++;
      const int index = (int)read_value(-1);
      target.address += (ptrdiff_t)index * (ptrdiff_t)sizes[target.type];
      if (!skip("]"))
        reject("no ]");
    } else if (*cursor == '.' && target.type >= STRUCT) {
      cursor++;
      const bool is_impact = target.type == STRUCT_impact || target.type == STRUCT_cushion_impact;
      if (is_impact ? !find_field(&target) : !find_member(&target, read_word()))
        reject("no such member");
    } else {
      return target;
    }
  }
}

static bool find_object(const char *name, location *target) {
  for (size_t k = 0; k < COUNT_OF(objects); k++)
    if (strcmp(objects[k].name, name) == 0) {
      *target = (location){objects[k].object, objects[k].type, -1};
      return true;
    }
  return false;
}

static double number_at(location source) {
  const void *const number = source.address;
  if (source.type == DOUBLE)
    return *(const double *)number;
  if (source.type == INT32)
    return *(const int32_t *)number;
  if (source.type == INT64)
    return (double)*(const int64_t *)number;
  reject("no number");
}

static void put_number(location target, double number) {
  void *const address = target.address;
  if (target.type == DOUBLE)
    *(double *)address = number;
  else if (target.type == INT32)
    *(int32_t *)address = (int32_t)number;
  else if (target.type == INT64)
    *(int64_t *)address = (int64_t)number;
  else if (target.type == UINT64)
    *(uint64_t *)address = (uint64_t)number;
  else
    reject("no number");
}

/* The value of a word of the library: of its own list, or a type of event or a label. */
static double word_value(const char *word, int words) {
  const int lists[] = {words, CAROM_WORDS_EVENT, CAROM_WORDS_LABEL};
  for (int list = words < 0; list < 3; list++)
    for (int k = 0; k < 32; k++) {
      const char *known = carom_word((carom_words)lists[list], k);
      if (known != NULL && strcmp(known, word) == 0)
        return k;
    }
  reject("no such name");
}

static double read_value(int words) {
  char *end;
  skip_spaces();
  const double number = strtod(cursor, &end);
  if (end > cursor && !is_word_part(*end)) {
    cursor = end;
    return number;
  }
  const char *word = read_word();
  location source;
  return find_object(word, &source) ? number_at(follow(source)) : word_value(word, words);
}

/* ---- Statements */

static location read_path(void) {
  location target;
  if (!find_object(read_word(), &target))
    reject("no such object");
  return follow(target);
}

/* Sets one number, or several of an array. */
static void assign(void) {
  location target = read_path();
  if (!skip("="))
    reject("no =");
  do {
    put_number(target, read_value(target.words));
    target.address += sizes[target.type];
  } while (skip(","));
}

/* Calls the function whose name comes next. */
static int64_t call_function(void) {
  const char *name = read_word();
  argument = value_index = 0;
  if (strcmp(name, "shoot_pair") == 0)
    return shoot_pair();
  for (int k = 0; k < COUNT; k++)
    if (strcmp(functions[k].name + strlen("carom_"), name) == 0)
      return functions[k].call();
  reject("no such function");
}

static int read_status(void) {
  const char *word = read_word();
  for (int k = -128; k < 128; k++)
    if (strcmp(carom_status_name((carom_status)k), word) == 0)
      return k;
  reject("no such status");
}

/* Of all that a shot writes. */
static uint64_t shot_hash(void) {
  uint64_t hash = hash_of(1, events, 100 * sizeof *events);
  hash = hash_of(hash, final, sizeof final);
  hash = hash_of(hash, states, sizeof states);
  hash = hash_of(hash, &shot, sizeof shot);
  hash = hash_of(hash, &facts, sizeof facts);
  hash = hash_of(hash, statuses, 1);
  return hash_of(hash, &state, sizeof state);
}

static void expect_nan(location target) {
  for (size_t k = 0; k < sizes[target.type] / sizeof(double); k++)
    if (!isnan(((const double *)(const void *)target.address)[k]))
      reject("a number is left");
}

enum { UNSET = -100 }; /* where a function does not say what is wrong */

/* What the notes behind a status say of a call. */
static void expect_notes(bool is_changed) {
  const int expected = skip("where") ? (int)read_value(-1) : UNSET;
  if (expected != UNSET && where != UNSET && where != expected)
    reject("another place");
  if (skip("unchanged") && is_changed)
    reject("the shot is changed");
  if (skip("nan"))
    expect_nan(read_path());
}

/* Calls each function of the list that comes next. */
static void call_functions(void) {
  const char *names[8], *notes;
  int calls = 0;
  do {
    skip_spaces();
    names[calls++] = cursor;
    read_word();
  } while (skip(","));
  const int expected = read_status();
  wrong_argument = skip("without") ? (int)read_value(-1) : -1;
  notes = cursor;
  for (int k = 0; k < calls; k++) {
    cursor = names[k];
    where = UNSET;
    const uint64_t hash = shot_hash();
    const int64_t returned = call_function();
    if (returned != expected && returned != ACCEPTED)
      reject(carom_status_name((carom_status)returned));
    cursor = notes;
    expect_notes(hash != shot_hash());
  }
}

static void make_table(void) {
  if (skip("empty"))
    table = empty_table(read_value(-1));
  else
    carom_table_make((carom_table_kind)word_value(read_word(), CAROM_WORDS_TABLE), &table);
  count = 0;
  cue.speed = 0.0;
}

static void add_balls(void) {
  const carom_game game = (carom_game)word_value(read_word(), CAROM_WORDS_GAME);
  for (int k = (int)read_value(-1); k > 0; k--) {
    balls[count] = (carom_shot_ball){.kind = carom_ball_kind_of(game)};
    balls[count].state.r[2] = balls[count].kind.radius;
    count++;
  }
}

static void expect(void) {
  const double left = read_value(-1);
  skip_spaces();
  const char relation = *cursor++;
  const double right = read_value(-1), tolerance = skip("within") ? read_value(-1) : 0.0;
  bool good = fabs(left - right) <= tolerance || left == right || (isnan(left) && isnan(right));
  if (relation == '>')
    good = left > right;
  ck_assert_msg(good, "%s:%d: %s: it is %.17g", row_file.path, row_file.line_number, row_file.line,
                left);
}

static void make_cue(void) {
  cue = carom_cue_of((carom_game)word_value(read_word(), CAROM_WORDS_GAME));
}

static const struct {
  const char *word;
  void (*run)(void);
} statements[] = {{"table ", make_table},
                  {"balls ", add_balls},
                  {"cue ", make_cue},
                  {"call ", call_functions},
                  {"expect ", expect}};

static void run_statement(void) {
  for (size_t k = 0; k < COUNT_OF(statements); k++)
    if (skip(statements[k].word)) {
      statements[k].run();
      return;
    }
  assign();
}

/* Each case continues where the one before it ended or failed. */
START_TEST(a_case) {
  set_up();
  if (_i == 0)
    open_rows(file_name);
  while (row_file.rows_begun <= _i)
    next_line();
  do {
    for (skip_spaces(); *cursor != '\0'; skip(";"))
      run_statement();
  } while (next_line() && !begins_row());
}
END_TEST

static int count_rows(void) {
  while (next_line()) {
  }
  return row_file.rows_begun;
}

int main(int arguments, char **values) {
  if (arguments != 2 || !find_rows(values[1])) {
    fprintf(stderr, "test_cases takes one file of rows that it can read\n");
    return 1;
  }
  file_name = values[1];
  const looped_test test[] = {{a_case, count_rows()}};
  return RUN_LOOPED("cases", test);
}
