/* Where rows come from: numbers by the names of columns, or by their places in an array. */
#include "rows/source.h"

#include "program/program.h"
#include "rows/npy.h"
#include "rows/number.h"

struct row_source {
  const shared_options *shared;
  const row_kind *kind;
  const char *name;
  size_t next; /* rows that have been read */
  npy_array array;
  record_reader *records;               /* of CSV; NULL for an array */
  size_t width;                         /* fields of the header */
  size_t id_place, place[MOST_NUMBERS]; /* places of the column id and of those that fill the
                                       numbers, or SIZE_MAX; */
  const char *column[MOST_NUMBERS];     /* the names of these */
};

/* ---- Columns */

/* The place of the column, SIZE_MAX if there is none; false after a complaint if there are two. */
static bool find_once(const record *header, const char *file, const char *name, size_t *place) {
  *place = SIZE_MAX;
  for (size_t k = 0; k < header->count && name != NULL; k++) {
    if (!same_text(header->field[k], name))
      continue;
    if (*place != SIZE_MAX) {
      complain("%s:%lld: column '%s' appears twice; which one is meant?", file, header->line, name);
      return false;
    }
    *place = k;
  }
  return true;
}

/* Finds the column of a number; false after a complaint if it has two. */
static bool find_column(row_source *s, const record *header, int number) {
  const column *c = &s->kind->columns[number];
  const char *others = NULL;
  if (c->both != NULL)
    others = s->kind->columns[c->partner].name;
  size_t at_own, at_both, at_others;
  if (!find_once(header, s->name, c->name, &at_own) ||
      !find_once(header, s->name, c->both, &at_both) ||
      !find_once(header, s->name, others, &at_others))
    return false;
  /* One of them is enough. */
  if (at_own != SIZE_MAX && at_both != SIZE_MAX) {
    complain("%s:%lld: columns '%s' and '%s' say the same; give one of them", s->name, header->line,
             c->both, c->name);
    return false;
  }
  s->place[number] = at_own;
  if (at_own == SIZE_MAX)
    s->place[number] = at_both;
  /* What is missing should have been for both balls, unless the other one has a column of its
   * own. */
  const bool alone =
      c->both == NULL || at_own != SIZE_MAX || (at_both == SIZE_MAX && at_others != SIZE_MAX);
  s->column[number] = c->both;
  if (alone)
    s->column[number] = c->name;
  return true;
}

/* Whether the number must have a column but has none. */
static bool is_missing(const row_source *s, int number) {
  const column *c = &s->kind->columns[number];
  const bool named =
      c->both != NULL && c->partner < number && same_text(s->column[number], s->column[c->partner]);
  const bool half = c->optional && c->partner != NO_NUMBER && s->place[c->partner] != SIZE_MAX;
  const bool by_option = s->shared->friction.is_set && same_text(c->name, "u_b");
  return s->place[number] == SIZE_MAX && (half || !c->optional) && !named && !by_option;
}

static bool find_columns(row_source *s, const record *header) {
  char missing[256] = " ";
  size_t unused;
  if (record_is_numbers(header)) {
    complain("%s:%lld: no header: the first row holds numbers; the names of the columns come first "
             "(`%s resolve --help` lists them)",
             s->name, header->line, program_name);
    return false;
  }
  s->width = header->count;
  if (!find_once(header, s->name, "id", &s->id_place))
    return false;
  for (int number = 0; number < s->kind->numbers; number++)
    if (!find_column(s, header, number))
      return false;
  /* Every column that is missing is named. */
  for (int number = 0; number < s->kind->numbers; number++)
    if (is_missing(s, number))
      strcat(strcat(missing, s->column[number]), " ");
  if (missing[1] == '\0')
    return true;
  const bool is_other_kind =
      !find_once(header, s->name, s->kind->clue, &unused) || unused != SIZE_MAX;
  const char *hint = "names are case-sensitive";
  if (header->count == 1)
    hint = "the header is a single field, without commas";
  complain("%s:%lld: missing columns:%s(%s%s; `%s resolve --help` lists them)", s->name,
           header->line, missing, text_if(is_other_kind, s->kind->meant), hint, program_name);
  return false;
}

/* ---- Opening */

static bool open_csv(row_source *s, const char *path) {
  record header;
  s->records = record_open(path);
  if (s->records == NULL)
    return false;
  s->name = record_file_name(s->records);
  const read_result result = record_next(s->records, &header);
  if (result == READ_END)
    complain("%s: empty; a header with the names of the columns is needed", s->name);
  else if (result == READ_ONE && header.malformed)
    complain("%s:%lld: no header: the first row is longer than a mebibyte", s->name, header.line);
  return result == READ_ONE && !header.malformed && find_columns(s, &header);
}

row_source *source_open(const char *path, const shared_options *shared) {
  row_source *s = allocate(1, sizeof *s);
  *s = (row_source){.shared = shared, .kind = kind_of(shared), .name = path};
  const bool is_array = npy_is_name(path);
  if (is_array && npy_open(path, (size_t)s->kind->numbers, &s->array))
    return s;
  if (!is_array && open_csv(s, path))
    return s;
  source_close(s);
  return NULL;
}

bool source_is_single(const row_source *s) {
  return s->records == NULL && s->array.single;
}

/* ---- Reading */

static void set_id(const row_source *s, const record *in, size_t row, row_note *note) {
  char number[24];
  snprintf(number, sizeof number, "%zu", row);
  const char *id = number;
  if (!in->malformed && s->id_place < in->count)
    id = in->field[s->id_place];
  note->id = grow(note->id, &note->id_room, strlen(id) + 1, 1);
  strcpy(note->id, id);
}

/* NULL, or the name of what is wrong. */
static const char *fill(const row_source *s, const record *in, row_note *note, double *number) {
  if (in->malformed) {
    snprintf(note->message, sizeof note->message,
             "the row is longer than a mebibyte; is a quote left open?");
    return "malformed_row";
  }
  /* Empty fields behind the last column are no harm. */
  for (size_t k = s->width; k < in->count; k++)
    if (in->field[k][0] != '\0') {
      snprintf(note->message, sizeof note->message, "%zu fields, but the header has %zu", in->count,
               s->width);
      return "too_many_fields";
    }
  /* Each number from its column. */
  for (int k = 0; k < s->kind->numbers; k++) {
    const char *name = s->column[k], *text = "";
    if (s->place[k] == SIZE_MAX) /* it may be missing */
      continue;
    if (s->place[k] < in->count)
      text = in->field[s->place[k]];
    if (text[0] == '\0') {
      snprintf(note->message, sizeof note->message, "%s is missing", name);
      return "missing_value";
    }
    if (!record_number(in, text, &number[k])) {
      snprintf(note->message, sizeof note->message, "%s = '%.60s' is not a number%s", name, text,
               text_if(!in->decimal_commas, comma_hint(text)));
      return "not_a_number";
    }
  }
  return NULL;
}

static read_result read_csv(row_source *s, source_block *block) {
  const size_t row_size = (size_t)s->kind->numbers * sizeof(double);
  read_result result = READ_ONE;
  record in;
  if (block->numbers == NULL) {
    block->numbers = allocate(CSV_BLOCK, row_size);
    block->note = allocate(CSV_BLOCK, sizeof *block->note);
  }
  for (block->count = 0; block->count < CSV_BLOCK; block->count++) {
    row_note *note = &block->note[block->count];
    double *numbers = source_row(s, block, block->count);
    if ((result = record_next(s->records, &in)) != READ_ONE)
      break;
    /* What is known of the row, and its numbers: the defaults, and over them what it says. */
    note->line = in.line;
    set_id(s, &in, s->next + block->count + 1, note);
    memcpy(numbers, s->kind->defaults, row_size);
    note->error = fill(s, &in, note, numbers);
    if (note->error != NULL)
      memset(numbers, 0, row_size);
  }
  return result;
}

static read_result read_array(row_source *s, source_block *block) {
  const size_t left = s->array.rows - s->next;
  if (block->numbers == NULL)
    block->numbers = allocate(NPY_BLOCK, (size_t)s->kind->numbers * sizeof(double));
  block->count = NPY_BLOCK;
  if (left < NPY_BLOCK)
    block->count = left;
  if (!npy_read(&s->array, block->count, block->numbers))
    return READ_FAILED;
  return READ_ONE;
}

read_result source_read(row_source *s, source_block *block) {
  block->first = s->next;
  read_result result;
  if (s->records != NULL)
    result = read_csv(s, block);
  else
    result = read_array(s, block);
  s->next += block->count;
  /* what options say instead of columns */
  for (size_t k = 0; s->kind->prepare != NULL && k < block->count; k++)
    s->kind->prepare(s->shared, source_row(s, block, k));
  if (result == READ_ONE && block->count == 0)
    return READ_END;
  if (result == READ_END && block->count > 0)
    return READ_ONE;
  return result;
}

void source_free_block(source_block *block) {
  for (size_t k = 0; block->note != NULL && k < CSV_BLOCK; k++)
    free(block->note[k].id);
  free(block->note);
  free(block->numbers);
  *block = (source_block){0};
}

double *source_row(const row_source *s, const source_block *block, size_t k) {
  return block->numbers + k * (size_t)s->kind->numbers;
}

/* ---- Messages */

void source_report(const row_source *s, const source_block *block, size_t k, carom_status status,
                   const char *doubt) {
  const row_note *note = row_note_of(block, k);
  const double *row = source_row(s, block, k);
  int field = -1;
  char where[256], what[64] = "", id[ID_TEXT], text[NUMBER_TEXT];
  s->kind->check(row, s->shared, &field);
  /* Where it is, and which of its numbers is to blame. */
  if (note != NULL)
    snprintf(where, sizeof where, "%s:%lld: id '%s'", s->name, note->line, id_text(note->id, id));
  else
    snprintf(where, sizeof where, "%s: row %zu", s->name, block->first + k);
  if (field >= 0 && note != NULL)
    snprintf(what, sizeof what, "%s = %s: ", s->column[field], number_text(row[field], text));
  else if (field >= 0)
    snprintf(what, sizeof what, "%s (number %d) = %s: ", s->kind->columns[field].name, field,
             number_text(row[field], text));
  /* What is wrong with it. */
  if (note != NULL && note->error != NULL)
    complain("%s: %s (%s)", where, note->message, note->error);
  else if (doubt != NULL)
    complain("%s: refused by --strict (%s)", where, doubt);
  else
    complain("%s: %s%s (%s)", where, what, carom_status_string(status), carom_status_name(status));
}

const char *source_name(const row_source *s) {
  return s->name;
}

double source_share(const row_source *s) {
  if (s->records != NULL)
    return record_share(s->records);
  return (double)s->next / (double)s->array.rows;
}

void source_close(row_source *s) {
  if (s == NULL)
    return;
  record_close(s->records);
  npy_close(&s->array);
  free(s);
}
