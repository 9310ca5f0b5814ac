/* What options read into their fields, and the rows that several tables have. */
#include "program/program.h"
#include "rows/number.h"
#include "rows/values.h"

#include <errno.h>
#include <jansson.h>
#include <limits.h>
#include <unistd.h>

/* 2^53: greater whole numbers may not be doubles. */
static const double WHOLE_MOST = 9007199254740992.0;

OPTION_SET(set_flag) {
  (void)row;
  (void)text;
  *(bool *)field = true;
  return true;
}

OPTION_SET(set_text) {
  (void)row;
  *(const char **)field = text;
  return true;
}

enum { FAULT_ROOM = 200 };

/* Whether a text is a list or a range, where an option takes one value. */
static bool is_several(const char *text) {
  return strpbrk(text, ",:") != NULL || strstr(text, "..") != NULL;
}

/* What is wrong with a text that is no number of a range, such as "a number, 0 or more". */
static const char *fault_of(const char *text, const char *range, char fault[FAULT_ROOM]) {
  if (is_several(text))
    snprintf(fault, FAULT_ROOM, "it takes one value, %s", range);
  else
    snprintf(fault, FAULT_ROOM, "not %s", range);
  return fault;
}

/* A number to try: the row's example, its default, or another one. */
static const char *example_of(const option_row *row, const char *other) {
  return text_or(row->example, text_or(row->usual, other));
}

bool is_torn(const option_row *row, const char *text, const char *next, char whole[WHOLE_TEXT]) {
  const size_t size = strlen(text);
  const char *argument = argument_of(row);
  const size_t digits = strspn(next, "+-.0123456789");
  const bool ends_in_digit = size > 0 && text[size - 1] >= '0' && text[size - 1] <= '9';
  const bool is_number = digits > 0 && (next[digits] == '\0' || is_unit(next + digits));
  const bool is_pair =
      is_number && strchr(text, ',') == NULL && strchr(text_or(argument, ""), ',') != NULL;
  if (!ends_in_digit || (!is_unit(next) && !is_pair) || access(next, F_OK) == 0)
    return false;
  snprintf(whole, WHOLE_TEXT, "%.30s%s%.30s", text, text_if(is_pair, ","), next);
  return true;
}

OPTION_SET(set_count) {
  enum { USUAL_COUNT = 10 };
  char *end, range[40], fault[FAULT_ROOM], other[16];
  errno = 0;
  const long count = strtol(text, &end, 10);
  const bool is_too_large = errno != 0 || count > INT_MAX;
  if (end == text || *end != '\0' || count < row->least || is_too_large) {
    snprintf(range, sizeof range, "a whole number, %d or more", row->least);
    if (is_too_large)
      snprintf(range, sizeof range, "a whole number, %d to %d", row->least, INT_MAX);
    snprintf(other, sizeof other, "%d", row->least > USUAL_COUNT ? row->least : USUAL_COUNT);
    return refuse_value(row, text, "%s; try %s", fault_of(text, range, fault),
                        example_of(row, other));
  }
  *(int *)field = (int)count;
  return true;
}

static OPTION_SET(set_threads) {
  int *threads = field;
  if (same_text(text, "all")) {
    *threads = CAROM_ALL_THREADS;
    return true;
  }
  if (!same_text(text, "0"))
    return set_count(row, text, threads);
  return refuse_value(row, text, "there must be a thread; try all, one for each processor, or 1");
}

OPTION_SET(set_number) {
  char fault[FAULT_ROOM];
  if (parse_number(text, field) && isfinite(*(double *)field))
    return true;
  return refuse_value(row, text, "%s; try %s", fault_of(text, "a number", fault),
                      example_of(row, "1"));
}

OPTION_SET(set_amount) {
  char fault[FAULT_ROOM];
  if (parse_number(text, field) && *(double *)field >= 0.0 && isfinite(*(double *)field))
    return true;
  return refuse_value(row, text, "%s; try %s", fault_of(text, "a number, 0 or more", fault),
                      example_of(row, "1"));
}

bool set_place(const option_row *row, const char *text, const char *words, int *place) {
  const int found = word_among(words, text, strlen(text));
  const size_t first = strcspn(text, ",:");
  if (found >= 0) {
    *place = found;
    return true;
  }
  if (place_among(words, text, first) >= 0)
    return refuse_value(row, text, "it takes one value; try %.*s", (int)first, text);
  return refuse_word(row, text, words);
}

OPTION_SET(set_choice) {
  return set_place(row, text, row->argument, field);
}

const char *words_of(int list, bool with_default, char text[MOST_WORDS]) {
  const char *word;
  text[0] = '\0';
  for (int k = 0; (word = carom_word((carom_words)list, k)) != NULL; k++)
    if (with_default || !same_text(word, "default"))
      append(text, MOST_WORDS, "|", "%s", word);
  return text;
}

/* Sets a word of the library; a complaint does not suggest "default". */
static bool set_word(const option_row *row, const char *text, int kind, char list[MOST_WORDS],
                     void *field) {
  const int found = word_among(words_of(kind, true, list), text, strlen(text));
  if (found < 0)
    return set_place(row, text, words_of(kind, false, list), field);
  *(int *)field = found;
  return true;
}

OPTION_SET(set_named) {
  char list[MOST_WORDS];
  return set_word(row, text, row->least, list, field);
}

/* ---- Options of the library, as it tells them */

static carom_part_kind part_of(const option_row *row) {
  if (row->part == CAROM_PART_NONE)
    return CAROM_PART_OPTIONS;
  return (carom_part_kind)row->part;
}

static const carom_number *option_of(const option_row *row) {
  if (row->set != set_option)
    return NULL;
  return carom_number_of(part_of(row), row->least);
}

OPTION_SET(set_option) {
  const carom_number *n = option_of(row);
  char list[MOST_WORDS], must[100], range[120], fault[FAULT_ROOM];
  value v;
  if (n->words >= 0)
    return set_word(row, text, n->words, list, field);
  const bool whole = n->type != CAROM_TYPE_DOUBLE;
  double most = n->high;
  if (n->type == CAROM_TYPE_UINT64)
    most = WHOLE_MOST;
  const bool good = value_of(measure_of_unit(n->unit), text, &v);
  const double x = v.x;
  if (good && ((x >= n->low && x <= most) || x == n->other) && (!whole || x == floor(x))) {
    if (n->type == CAROM_TYPE_UINT64)
      *(uint64_t *)field = (uint64_t)x;
    else if (whole)
      *(int32_t *)field = (int32_t)x;
    else
      *(double *)field = x;
    return true;
  }
  if (n->type == CAROM_TYPE_UINT64)
    snprintf(must, sizeof must, "0 to %.0f", WHOLE_MOST);
  else
    carom_number_range(n, must, sizeof must);
  snprintf(range, sizeof range, "a %snumber, %s", text_if(whole, "whole "), must);
  return refuse_value(row, text, "%s; try %s", fault_of(text, range, fault), whole ? "100" : "1");
}

int rows_of(const option_row *for_all, option_row rows[MOST_OF_LIBRARY]) {
  const carom_number *n;
  int count = 0;
  for (int k = 0; (n = carom_number_of(part_of(for_all), k)) != NULL; k++)
    if (n->key[0] != '\0' && (n->reader == CAROM_READ_ALWAYS || (int)n->reader == for_all->least))
      rows[count++] = (option_row){.name = n->key,
                                   .help = n->text,
                                   .set = set_option,
                                   .field = for_all->field + (size_t)n->offset,
                                   .least = k,
                                   .part = for_all->part,
                                   .is_physics = for_all->part == CAROM_PART_NONE};
  return count;
}

const char *argument_of(const option_row *row) {
  static char text[MOST_WORDS];
  const carom_number *n = option_of(row);
  if (n != NULL && n->words >= 0)
    return words_of(n->words, false, text);
  if (n != NULL && n->type == CAROM_TYPE_DOUBLE)
    return "X";
  if (n != NULL)
    return "N";
  if (row->set == set_named)
    return words_of(row->least, false, text);
  if (row->words == 0)
    return row->argument;
  words_of(row->words, false, text);
  if (row->argument != NULL)
    append(text, sizeof text, "|", "%s", row->argument);
  return text;
}

/* ---- Numbers of balls and cues */

/* Whose numbers --with may name, in the order in which a name is looked up. */
static const struct {
  carom_part_kind part;
  const char *whose;
} owners[] = {{CAROM_PART_BALL, "a ball"},     {CAROM_PART_CUE, "a cue"},
              {CAROM_PART_TABLE, "a table"},   {CAROM_PART_RAIL, "a rail"},
              {CAROM_PART_JAW, "a jaw"},       {CAROM_PART_POCKET, "a pocket"},
              {CAROM_PART_MEASURES, "a table"}};
enum { OWNERS = COUNT_OF(owners) };

/* What to try where an option does not take a parameter; NULL: it takes it. Those of one impact
 * on a cushion are parameters of its model. */
static const char *refusal(const option_row *row, carom_part_kind part, const carom_number *n) {
  if (part == CAROM_PART_MEASURES)
    return "try --table with its key, as in --table 9ft,corner=4.25in";
  if (part != CAROM_PART_BALL && part != CAROM_PART_CUE)
    return "try a table in a file for `carom shoot`";
  if (part == CAROM_PART_CUE && row->part == CAROM_PART_BALL)
    return "try --with";
  if (part == CAROM_PART_CUE && n->offset == (int32_t)offsetof(carom_cue, tip_radius))
    return "no strike reads it; try without it";
  if (part == CAROM_PART_CUE && n->type != CAROM_TYPE_DOUBLE)
    return "try a file for `carom shoot`";
  if (part == CAROM_PART_CUE && n->offset <= (int32_t)offsetof(carom_cue, b))
    return "try --speed, --aim, --elevation or --tip of `carom shoot`";
  if (row->only == CUSHION_ONLY && n->cushion_offset < 0)
    return "the cushion does not read it; try `carom shoot --with`";
  return NULL;
}

/* A number of balls or cues, and where it stands: carom_number_of(part, index) is `number`. */
typedef struct named_number {
  const carom_number *number; /* NULL: none */
  carom_part_kind part;
  int index;
} named_number;

/* A number that the option takes, by its name or its key of files; none after a complaint. */
static named_number number_named(const option_row *row, const char *name) {
  char known[1200] = "", list[HINT_TEXT];
  const carom_number *n, *refused = NULL;
  int of_other = 0;
  for (int owner = 0; owner < OWNERS; owner++)
    for (int k = 0; (n = carom_number_of(owners[owner].part, k)) != NULL; k++) {
      const bool named = same_text(n->name, name) || (name[0] != '\0' && same_text(n->key, name));
      const bool taken = refusal(row, owners[owner].part, n) == NULL;
      if (taken && named)
        return (named_number){n, owners[owner].part, k};
      if (taken)
        append(known, sizeof known, "|", "%s", n->name);
      else if (named && refused == NULL) {
        refused = n;
        of_other = owner;
      }
    }
  if (refused != NULL)
    refuse_value(row, name, "a parameter of %s; %s", owners[of_other].whose,
                 refusal(row, owners[of_other].part, refused));
  else if (name[strspn(name, "+-.:0123456789")] == '\0')
    refuse_value(row, name, "it has no NAME; try %s", example_of(row, "mass=6oz"));
  else if (is_nearly(name, known))
    refuse_value(row, name, "no such parameter; try %s, as `carom models` lists them",
                 words_to_try(name, known, list));
  else
    refuse_value(row, name, "no such parameter; try one that `carom models` lists, as in %s",
                 example_of(row, "mass=6oz"));
  return (named_number){NULL, CAROM_PART_NONE, 0};
}

static bool is_within(const carom_number *n, double x) {
  return (x >= n->low && x <= n->high) || x == n->other;
}

/* Complains of the value of a parameter, and returns false. */
static bool refuse_number(const option_row *row, const carom_number *n, const char *text) {
  char must[100], range[120], typed[120], fault[FAULT_ROOM];
  const bool is_own_option = row->set == set_cue_number;
  carom_number_range(n, must, sizeof must);
  snprintf(range, sizeof range, "a number, %s", must);
  snprintf(typed, sizeof typed, "%.40s=%.40s", n->name, text);
  double x;
  const bool is_number = parse_number(text, &x);
  if (is_number)
    snprintf(fault, sizeof fault, "it must be %s", must);
  else
    fault_of(text, range, fault);
  if (is_own_option)
    return refuse_value(row, text, "%s; try %s", fault, example_of(row, row->else_usual));
  return refuse_value(row, typed, "%s; try a number of this range, as in %s", fault,
                      example_of(row, "mass=6oz"));
}

/* A fit whose smooth_q is 0 has no smooth law: what it does not say of the law is 0, whatever the
 * balls of the game have. */
static void give_no_smooth_law(given_numbers *numbers) {
  static const carom_shot_options smooth = {.cushion_model = CAROM_SHOT_CUSHION_SMOOTH};
  const carom_number *n;
  bool dropped = false;
  for (int k = 0; (n = carom_number_of(CAROM_PART_BALL, k)) != NULL; k++) {
    if (same_text(n->name, "smooth_q"))
      dropped = (numbers->of_balls >> k & 1) != 0 && numbers->kind.smooth_q == 0.0;
    if (!dropped || n->reader != CAROM_READ_BY_CUSHION || (numbers->of_balls >> k & 1) != 0 ||
        !carom_number_is_read(n, &numbers->kind, &smooth))
      continue;
    memset((char *)&numbers->kind + n->offset, 0, sizeof(double));
    numbers->of_balls |= (uint64_t)1 << k;
  }
}

/* Where a number of the cue or of balls stands. */
static void *given_at(given_numbers *owner, carom_part_kind part, int k) {
  char *numbers = (char *)&owner->kind;
  if (part == CAROM_PART_CUE)
    numbers = (char *)&owner->cue;
  return numbers + carom_number_of(part, k)->offset;
}

/* The set of the numbers of the cue or of balls that are given. */
static uint64_t *given_set(given_numbers *numbers, carom_part_kind part) {
  if (part == CAROM_PART_CUE)
    return &numbers->of_cue;
  return &numbers->of_balls;
}

/* Sets one value of a number. */
static void give_value(given_numbers *numbers, carom_part_kind part, int k, double x) {
  memcpy(given_at(numbers, part, k), &x, sizeof x);
  *given_set(numbers, part) |= (uint64_t)1 << k;
}

/* Gives a number of balls by its name; complains and returns false where it is out of bounds. */
static bool give_named(given_numbers *numbers, const char *name, double x) {
  const option_row with = {.name = "with", .part = CAROM_PART_BALL};
  const named_number named = number_named(&with, name);
  char text[NUMBER_TEXT];
  if (named.number == NULL)
    return false;
  snprintf(text, sizeof text, "%.17g", x);
  if (!is_within(named.number, x))
    return refuse_number(&with, named.number, text);
  give_value(numbers, named.part, named.index, x);
  return true;
}

/* Gives the numbers of a fit, which `python -m carom.fit -o` wrote: constants, radius, cushion. */
static bool give_fit(const char *path, given_numbers *numbers) {
  json_error_t error;
  json_t *fit = json_load_file(path, 0, &error), *constants = json_object_get(fit, "constants"), *x;
  const json_t *bands = json_object_get(fit, "bands");
  const char *name, *model = json_string_value(json_object_get(fit, "cushion_model"));
  bool good = json_is_object(constants);
  json_object_set(constants, "radius", json_object_get(fit, "radius"));
  json_unpack(constants, "{s?: F, s?: F}", "slope_x", &numbers->slope[0], "slope_y",
              &numbers->slope[1]);
  json_object_del(constants, "slope_x");
  json_object_del(constants, "slope_y");
  json_object_foreach(constants, name, x) good =
      good && give_named(numbers, name, json_is_number(x) ? json_number_value(x) : NAN);
  if (fit == NULL)
    complain("--with %.200s: %s", path, error.text);
  else if (!good)
    complain("--with %.200s: the file has no fit, an object with `constants` of balls", path);
  for (int k = 0; model != NULL && carom_word(CAROM_WORDS_CUSHION_MODEL, k) != NULL; k++)
    if (same_text(carom_word(CAROM_WORDS_CUSHION_MODEL, k), model))
      numbers->fitted = (carom_shot_cushion)(k + 1);
  give_no_smooth_law(numbers);
  numbers->of_fit = numbers->of_balls;
  double *row = numbers->band[0];
  for (numbers->bands = 0; numbers->bands < 8; row = numbers->band[++numbers->bands])
    if (json_unpack(json_array_get(bands, (size_t)numbers->bands), "[FFF]", row, row + 1,
                    row + 2) != 0)
      break;
  json_decref(fit);
  return good;
}

/* Gives the numbers of a condition, which are not 0. */
static void give_numbers_of(const carom_ball_kind *kind, given_numbers *numbers) {
  const carom_number *n;
  for (int k = 0; (n = carom_number_of(CAROM_PART_BALL, k)) != NULL; k++) {
    double x;
    memcpy(&x, (const char *)kind + n->offset, sizeof x);
    if (x != 0.0)
      give_value(numbers, CAROM_PART_BALL, k, x);
  }
}

/* The first number that a condition gives. */
static int first_given(const carom_ball_kind *kind) {
  given_numbers given = {0};
  int first = 0;
  give_numbers_of(kind, &given);
  while ((given.of_balls >> first & 1) == 0)
    first++;
  return first;
}

void give_of_list(const number_list *list, int k, given_numbers *numbers) {
  carom_ball_kind kind = {0};
  if (list->part != CAROM_PART_NONE) {
    give_value(numbers, (carom_part_kind)list->part, list->number, list->value[k]);
    return;
  }
  carom_condition_give((carom_condition)list->value[k], &kind);
  give_numbers_of(&kind, numbers);
}

void name_of_list(const number_list *list, int k, char text[NUMBER_NAME]) {
  const carom_number *n = carom_number_of((carom_part_kind)list->part, list->number);
  if (list->part == CAROM_PART_NONE)
    snprintf(text, NUMBER_NAME, "%s", carom_word(CAROM_WORDS_CONDITION, (int)list->value[k]));
  else
    snprintf(text, NUMBER_NAME, "%s %.6g%s%s", n->name, list->value[k],
             text_if(n->unit[0] != '\0', " "), n->unit);
}

/* Adds a value to a list, which begins with `first`, the value that was given before; false after
 * a complaint. */
static bool add_to_list(const option_row *row, given_numbers *numbers, carom_part_kind part, int k,
                        double first, double x) {
  number_list *list = numbers->list;
  while (list < numbers->list + numbers->lists && (list->part != (int)part || list->number != k))
    list++;
  if (row->only == CUSHION_ONLY) {
    complain("--%s: it takes one value of a parameter here; try `carom shoot`, which takes lists",
             row->name);
    return false;
  }
  if (list == numbers->list + LISTS_MOST || list->count == LIST_MOST) {
    complain("--%s: at most %d parameters have lists, of at most %d values", row->name, LISTS_MOST,
             LIST_MOST);
    return false;
  }
  if (list == numbers->list + numbers->lists) {
    *list = (number_list){.part = (int)part, .number = k, .count = 1, .value = {first}};
    numbers->lists++;
  }
  list->value[list->count++] = x;
  if (part != CAROM_PART_NONE)
    *given_set(numbers, part) &= ~((uint64_t)1 << k);
  return true;
}

/* Reads the value of a number with its unit, or a range of values; false after a complaint. */
static bool read_numbers(const option_row *row, const carom_number *n, char *text, values *list) {
  const option_row of_number = {.name = row->name, .least = measure_of_unit(n->unit)};
  bool good = text != NULL;
  if (good && (strchr(text, ':') != NULL || strstr(text, "..") != NULL)) {
    if (!set_values(&of_number, text, list))
      return false;
  } else {
    list->count = 1;
    good = good && value_of(of_number.least, text, &list->item[0]);
  }
  for (int k = 0; k < list->count && good; k++)
    good = is_within(n, list->item[k].x);
  return good || refuse_number(row, n, text_or(text, ""));
}

/* The condition of the table with that name; -1: none. */
static int condition_named(const char *name) {
  const char *word;
  for (int k = 0; (word = carom_word(CAROM_WORDS_CONDITION, k)) != NULL; k++)
    if (same_word(name, strlen(name), word, strlen(word)))
      return k;
  return -1;
}

/* Gives the numbers of a condition, or makes a list of those of one thing, the cloth or the
 * cushions; false after a complaint: an impact has no rolling ball. */
static bool give_condition(const option_row *row, int condition, given_numbers *numbers) {
  const char *word = numbers->condition = carom_word(CAROM_WORDS_CONDITION, condition);
  const unsigned before = numbers->conditions;
  carom_ball_kind kind = {0};
  carom_condition_give((carom_condition)condition, &kind);
  const int first = first_given(&kind);
  if (row->only == CUSHION_ONLY && kind.restitution_cushion == 0.0) {
    complain("--%s %s: it has no effect on one impact; try `carom shoot --with`", row->name, word);
    return false;
  }
  numbers->conditions |= 1U << condition;
  for (int k = 0; carom_word(CAROM_WORDS_CONDITION, k) != NULL; k++) {
    carom_ball_kind other = {0};
    carom_condition_give((carom_condition)k, &other);
    if ((before >> k & 1) != 0 && first_given(&other) == first)
      return add_to_list(row, numbers, CAROM_PART_NONE, first, k, condition);
  }
  give_numbers_of(&kind, numbers);
  return true;
}

bool condition_fits(const given_numbers *numbers, carom_game game) {
  const carom_ball_kind pool = carom_ball_kind_of(CAROM_GAME_POOL), kind = carom_ball_kind_of(game);
  if (numbers->condition == NULL ||
      (kind.mu_roll == pool.mu_roll && kind.restitution_cushion == pool.restitution_cushion))
    return true;
  complain("--with %s: a condition of pool tables has no effect in %s", numbers->condition,
           carom_word(CAROM_WORDS_GAME, (int)game));
  return false;
}

/* Whether the rows of a command have their own restitution and friction, which no condition
 * changes: those of impacts that are not of a game. */
static bool has_own_cushion(const option_row *row, const given_numbers *numbers) {
  if (row->only != CUSHION_ONLY)
    return false;
  const shared_options *shared = (const void *)((const char *)numbers - row->field);
  return !shared->of_game;
}

/* Whether each condition of a list gives a number, which has no other value then. */
static bool is_listed(const given_numbers *numbers, const named_number *named) {
  bool listed = false;
  for (int k = 0; k < numbers->lists && named->part == CAROM_PART_BALL; k++) {
    given_numbers given = {0};
    if (numbers->list[k].part == CAROM_PART_NONE)
      give_of_list(&numbers->list[k], 0, &given);
    listed |= (given.of_balls >> named->index & 1) != 0;
  }
  return listed;
}

/* Gives a number its value, or its values; where it has one already, as further ones. */
static bool give_values(const option_row *row, const named_number *named, char *text,
                        bool is_further, given_numbers *numbers) {
  static values list;
  if (!read_numbers(row, named->number, text, &list))
    return false;
  if (is_listed(numbers, named)) {
    complain("--%s: several conditions set %s; give it or the conditions, not both", row->name,
             named->number->name);
    return false;
  }
  if (!is_further)
    give_value(numbers, named->part, named->index, list.item[0].x);
  double first;
  memcpy(&first, given_at(numbers, named->part, named->index), sizeof first);
  for (int k = is_further ? 0 : 1; k < list.count; k++)
    if (!add_to_list(row, numbers, named->part, named->index, first, list.item[k].x))
      return false;
  return true;
}

/* Gives what one part of --with says: the file of a fit, a further value of the last number, a
 * condition, or NAME=X. */
static bool give_part(const option_row *row, char *part, named_number *last,
                      given_numbers *numbers) {
  char *text = strchr(part, '=');
  if (text == NULL && strstr(part, ".json") != NULL)
    return give_fit(part, numbers);
  if (text == NULL && last->number != NULL && strchr("+-.0123456789", *part) != NULL)
    return give_values(row, last, part, true, numbers);

  int condition = -1;
  if (text == NULL && !has_own_cushion(row, numbers))
    condition = condition_named(part);
  if (condition >= 0) {
    last->number = NULL;
    return give_condition(row, condition, numbers);
  }

  if (text != NULL)
    *text++ = '\0';
  *last = number_named(row, part);
  return last->number != NULL && give_values(row, last, text, false, numbers);
}

static bool give_parts(const option_row *row, char *text, named_number last,
                       given_numbers *numbers) {
  char *rest = NULL;
  for (char *part = strtok_r(text, ",", &rest); part != NULL; part = strtok_r(NULL, ",", &rest))
    if (!give_part(row, part, &last, numbers))
      return false;
  return true;
}

OPTION_SET(set_numbers) {
  return give_parts(row, text, (named_number){.number = NULL}, field);
}

OPTION_SET(set_cue_number) {
  char name[32];
  snprintf(name, sizeof name, "%s", row->name);
  for (char *letter = name; *letter != '\0'; letter++)
    if (*letter == '-')
      *letter = '_';
  const named_number named = number_named(row, name);
  char *rest = text + strcspn(text, ",");
  if (*rest != '\0')
    *rest++ = '\0';
  return named.number != NULL && give_values(row, &named, text, false, field) &&
         give_parts(row, rest, named, field);
}

void give_cue(const given_numbers *numbers, carom_cue *cue) {
  const carom_number *n;
  for (int k = 0; (n = carom_number_of(CAROM_PART_CUE, k)) != NULL; k++)
    if ((numbers->of_cue >> k & 1) != 0)
      memcpy((char *)cue + n->offset, (const char *)&numbers->cue + n->offset, sizeof(double));
}

static void give(const given_numbers *numbers, void *target, bool to_cushion) {
  const carom_number *n;
  for (int k = 0; (n = carom_number_of(CAROM_PART_BALL, k)) != NULL; k++) {
    int32_t offset = n->offset;
    if (to_cushion)
      offset = n->cushion_offset;
    if ((numbers->of_balls >> k & 1) != 0 && offset >= 0)
      memcpy((char *)target + offset, (const char *)&numbers->kind + n->offset, sizeof(double));
  }
}

void give_ball(const given_numbers *numbers, carom_ball_kind *kind) {
  give(numbers, kind, false);
}

const char *reader_of(const carom_number *n, const char *of_cushion, char text[160]) {
  static const carom_ball_kind any = {0};
  if (n->reader == CAROM_READ_BY_CUSHION) {
    snprintf(text, 160, "--%s %s", of_cushion, carom_word(CAROM_WORDS_CUSHION_MODEL, n->model));
    return text;
  }

  /* several laws may read the same numbers */
  const char *word, *separator = " ";
  snprintf(text, 160, "--friction");
  for (int k = 0; (word = carom_word(CAROM_WORDS_BALL_FRICTION, k)) != NULL; k++) {
    const carom_shot_options options = {.friction = (carom_ball_friction)k};
    if (carom_number_is_read(n, &any, &options)) {
      append(text, 160, separator, "%s", word);
      separator = "|";
    }
  }
  return text;
}

/* Whether the shots, or one of the models of impacts, read a number of --with. */
static bool is_read(const shared_options *shared, uint32_t models, const carom_number *n) {
  carom_shot_options options = shared->shot;
  bool read = false;
  for (int model = 0; carom_word(CAROM_WORDS_CUSHION_MODEL, model) != NULL && !read; model++) {
    if (shared->cushion && (models >> model & 1) == 0)
      continue;
    if (shared->cushion)
      options.cushion_model = (carom_shot_cushion)(model + 1);
    read = carom_number_is_read(n, &shared->with.kind, &options);
  }
  return read;
}

bool numbers_are_read(shared_options *shared) {
  const given_numbers *with = &shared->with;
  uint64_t of_balls = with->of_balls & ~with->of_fit;
  for (int k = 0; k < with->lists; k++)
    if (with->list[k].part == CAROM_PART_BALL)
      of_balls |= (uint64_t)1 << with->list[k].number;
  uint32_t models = shared->models;
  if (models == 0)
    models = 1U << shared->rail.model;
  const carom_number *n;
  char reader[160];
  if (with->fitted != CAROM_SHOT_CUSHION_SMOOTH && shared->shot.cushion_model == 0)
    shared->shot.cushion_model = with->fitted; /* balls with a smooth_q have the smooth one */
  /* a fit has numbers of all models */
  for (int k = 0; (n = carom_number_of(CAROM_PART_BALL, k)) != NULL; k++)
    if ((of_balls >> k & 1) != 0 && !is_read(shared, models, n)) {
      const char *option = "cushion";
      if (shared->cushion)
        option = "model";
      complain("--with %s: it has no effect here; try it with %s", n->name,
               reader_of(n, option, reader));
      return false;
    }
  if (!shared->cushion)
    return true;
  give(with, &shared->rail, true);
  carom_ball_kind kind = carom_ball_kind_of(CAROM_GAME_POOLTOOL_POOL);
  if (shared->of_game)
    kind = carom_ball_kind_of(CAROM_GAME_POOL);
  char must[100];
  give_ball(with, &kind);
  if ((n = carom_ball_fault(&kind, must, sizeof must)) != NULL)
    complain("--with: %s must be %s", n->name, must);
  return n == NULL;
}

static OPTION_SET(set_law) {
  friction_law *law = field;
  static const char name[] = "alciatore";
  const size_t size = sizeof name - 1;
  char rest;
  double mu;
  *law = (friction_law){.is_set = true, .law = carom_alciatore()};
  if (parse_number(text, &mu) && mu >= 0.0 && mu <= 1.0) {
    law->law = (carom_speed_law){.a = mu};
    return true;
  }
  if (strncmp(text, name, size) == 0 &&
      (text[size] == '\0' ||
       (text[size] == '=' && sscanf(text + size + 1, "%lf,%lf,%lf%c", &law->law.a, &law->law.b,
                                    &law->law.c, &rest) == 3)))
    return true;
  if (is_nearly(text, name))
    return refuse_word(row, text, name);
  if (text[0] != 'a' && is_several(text))
    return refuse_value(row, text, "it takes one value, a law or a number; try 0.06 or alciatore");
  return refuse_value(row, text,
                      "not a law or a number from 0 to 1; try 0.06, alciatore or "
                      "alciatore=0.01,0.1,1");
}

/* Takes the player of a fit with repeated strokes. */
static bool take_filmed(const option_row *row, const char *path, given_player *player) {
  json_error_t error;
  json_t *fit = json_load_file(path, 0, &error), *found = json_object_get(fit, "player");
  player->filmed = json_unpack(found, "{s: {s: F}, s: {s: F, s: F, s: F, s: F, s: F, s: F}}",
                               "rating", "mean", &player->rating, "player", "speed_share",
                               &player->speed_share, "phi", &player->phi, "theta", &player->theta,
                               "a", &player->a, "b", &player->b, "growth", &player->growth) == 0;
  if (fit == NULL)
    complain("--%s %.200s: %s", row->name, path, error.text);
  else if (!player->filmed)
    complain("--%s %.200s: the file has no player; `python -m carom.fit --player` writes one",
             row->name, path);
  json_decref(fit);
  return player->filmed;
}

static OPTION_SET(set_player) {
  given_player *player = field;
  const char *end = strrchr(text, '.');
  player->rated = true;
  if (end != NULL && same_text(end, ".json"))
    return take_filmed(row, text, player);
  const bool good =
      parse_number(text, &player->rating) && player->rating >= 200.0 && player->rating <= 850.0;
  if (good)
    return true;
  if (is_several(text))
    return refuse_value(row, text, "it takes one value, a Fargo rating; try 500");
  return refuse_value(row, text,
                      "not a Fargo rating, 200 to 850; try 200 for a beginner, 500 for a league "
                      "player, or FIT.json");
}

static OPTION_SET(set_errors) {
  given_player *player = field;
  player->errs = true;
  return set_amount(row, text, &player->scale);
}

/* The library's 0 is the usual eye, and below 0 is none. */
static OPTION_SET(set_eye) {
  given_player *player = field;
  value v;
  if (!value_of(MEASURE_LENGTH, text, &v) || !(v.x >= 0.0 && v.x <= 0.01)) {
    char fault[FAULT_ROOM];
    return refuse_value(row, text, "%s; try 0.2mm", fault_of(text, "a length of 0 to 10mm", fault));
  }
  player->eye = v.x > 0.0 ? v.x : -1.0;
  return true;
}

/* ---- The rows */

#define ROW(row, name, member, argument, set, least, only, ...) \
  OPTION_ROW(shared_options, only, row, name, member, argument, set, least, __VA_ARGS__)

ROW(option_solver, "solver", options.solver, NULL, set_named, CAROM_WORDS_SOLVER, BALLS_ONLY,
    "exact: the limit of infinitely many steps; fast: the same in less time, but not smooth; "
    "euler: N "
    "steps of equal impulse, as in the 2014 paper",
    .usual = "exact");
ROW(option_slip, "slip", options.slip, NULL, set_named, CAROM_WORDS_SLIP, BALLS_ONLY,
    "sign of the spin in the slip over the cloth, as in the 2014 paper or as in pooltool",
    .usual = "paper");
ROW(option_friction, "friction", friction, "alciatore|LAW", set_law, 0, BALLS_ONLY,
    "friction between the balls, instead of the column u_b: a number; or alciatore, which falls "
    "with the slip speed u as mu = a + b exp(-c |u|); or alciatore=a,b,c, the same with other "
    "constants");
ROW(option_data, "data", folder, "DIR", set_text, 0, BALLS_ONLY,
    "folder of the reference collisions", .else_usual = "$CAROM_DATA, else what came with carom");
ROW(option_steps, "steps", options.steps, "N", set_count, 1, ANY_KIND,
    "steps of Euler's method, 1 or more", .usual = "1000");
ROW(option_threads, "threads", options.threads, "all|N", set_threads, 1, ANY_KIND,
    "number of threads; all: one per processor", .usual = "all");
ROW(option_precision, "precision", precision, "double|single", set_choice, 0, ANY_KIND,
    "precision of the results, and of the solver for two balls",
    .else_usual = "single for a float32 array, otherwise double");
ROW(option_output, "output", output, "OUT", set_text, 0, ANY_KIND,
    "file to write, - for standard output; carom replaces OUT at the end", .usual = "-",
    .letter = 'o');
ROW(option_derived, "derived", derived, NULL, set_flag, 0, ANY_KIND,
    "more columns after the status: angles, rolling velocities, energy");
ROW(option_strict, "strict", strict, NULL, set_flag, 0, ANY_KIND,
    "treat warnings as errors: unusual values (`carom resolve --help` lists them), and lists such "
    "as 1,5");
ROW(option_summary, "summary", summary, NULL, set_flag, 0, ANY_KIND,
    "print counts and the time on standard error at the end");
ROW(option_cushion, "cushion", cushion, NULL, set_flag, 0, ANY_KIND,
    "impacts of a ball on a cushion, instead of collisions of two balls");
ROW(option_model, "model", rail.model, NULL, set_named, CAROM_WORDS_CUSHION_MODEL, CUSHION_ONLY,
    "model of the impact; `carom models NAME` describes it", .usual = "mathavan",
    .else_usual = "`carom rail` uses smooth, as in shots");
ROW(option_convention, "convention", rail.convention, NULL, set_named,
    CAROM_WORDS_CUSHION_CONVENTION, CUSHION_ONLY,
    "the conventions to follow where pooltool differs from the papers", .usual = "paper");
ROW(option_law, "law", rail.law, NULL, set_named, CAROM_WORDS_CUSHION_LAW, CUSHION_ONLY,
    "restitution and friction of the cushion: from the columns, or by Han's fits over speed and "
    "angle",
    .usual = "constant");
ROW(option_least_step, "least-step", rail.least_step, "P", set_amount, 0, CUSHION_ONLY,
    "smallest step of euler, N s", .usual = "0", .else_usual = "pooltool uses 0.001");
ROW(option_with, "with", with, "NAME=X,...", set_numbers, 0, CUSHION_ONLY,
    "parameters of the model, such as smooth_q=0.2,smooth_x=1,smooth_t=1 (`carom models NAME` "
    "lists them), or the file of a fit, FIT.json",
    .example = "restitution_cushion=0.9");

ROW(option_player, "player", player, "RATING", set_player, 0, ANY_KIND,
    "a player with this Fargo rating, 200 to 850, or FIT.json, a player measured by `python -m "
    "carom.fit --player`");
ROW(option_player_errors, "errors", player, "SCALE", set_errors, 0, ANY_KIND,
    "a player with SCALE times the errors 0.1 m/s, 0.1 degrees and 0.003 radii at 2 m/s",
    .else_usual = "1 without --player");
ROW(option_player_eye, "eye", player, "LENGTH", set_eye, 0, ANY_KIND,
    "standard deviation with which the player sees each ball",
    .else_usual = "0.2mm, or 0 with --errors 0");

/* Of whole shots: rows without a name stand for those of rows_of(). */
ROW(options_of_shots, NULL, shot, NULL, set_option, CAROM_READ_TO_STOP, ANY_KIND, NULL);
ROW(options_of_motion, NULL, shot, NULL, set_option, CAROM_READ_ALWAYS, ANY_KIND, NULL);
ROW(option_with_of_shots, "with", with, "NAME=X,...", set_numbers, 0, ANY_KIND,
    "parameters of all balls, their cushions and the cue (`carom models` lists them), such as "
    "mu_slide=0.15,mass=6oz,end_mass=0.01; conditions of a pool table, such as "
    "fast_cloth,old_cushion; or the file of a fit, FIT.json",
    .example = "mass=6oz");
