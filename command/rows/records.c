/* Records of a CSV file, over libcsv.
 *
 * libcsv is fed one line at a time, so that the number of the line on which a record began is
 * known and a feed completes at most one record.
 */
#include "rows/records.h"

#include "program/program.h"
#include "rows/number.h"

#include <csv.h>
#include <errno.h>
#include <sys/stat.h>

enum { RECORD_LIMIT = 1 << 20 };

struct record_reader {
  FILE *file;
  const char *name;
  double bytes;    /* of the whole file, or -1 */
  long long lines; /* read so far */
  bool begun;      /* the first record has been met */
  bool refused;    /* the file is of another kind */
  size_t line_size;
  char line[RECORD_LIMIT + 1]; /* the last of them, with its end */
  struct csv_parser parser;
  bool complete; /* the last feed ended a record */
  char *text;    /* the fields of the record, each with its NUL */
  size_t text_size, text_room;
  size_t *start; /* offset of each field in `text` */
  char **field;
  size_t count, start_room, field_room;
};

static void on_field(void *text, size_t size, void *context) {
  record_reader *r = context;
  r->start = grow(r->start, &r->start_room, r->count + 1, sizeof *r->start);
  r->text = grow(r->text, &r->text_room, r->text_size + size + 1, 1);
  char *end = r->text + r->text_size;
  if (size > 0)
    memcpy(end, text, size);
  for (char *nul = end; (nul = memchr(nul, '\0', (size_t)(end + size - nul))) != NULL;)
    *nul = '?'; /* or the field would seem to end here, and 0.5<NUL>junk be a number */
  end[size] = '\0';
  r->start[r->count++] = r->text_size;
  r->text_size += size + 1;
}

static void on_record(int end, void *context) {
  (void)end;
  ((record_reader *)context)->complete = true;
}

record_reader *record_open(const char *path) {
  record_reader *r = allocate(1, sizeof *r);
  csv_init(&r->parser, 0);
  r->name = input_name(path);
  r->file = input_open(path);
  struct stat status = {0};
  if (r->file == NULL) {
    record_close(r);
    return NULL;
  }
  if (fstat(fileno(r->file), &status) != 0 || (S_ISDIR(status.st_mode) && (errno = EISDIR))) {
    complain("cannot read %s: %s", r->name, strerror(errno));
    record_close(r);
    return NULL;
  }
  r->bytes = -1.0;
  if (S_ISREG(status.st_mode))
    r->bytes = (double)status.st_size;
  return r;
}

/* The next line, which ends with LF, CRLF, CR or the input; what exceeds the limit is passed
 * over. False if there is none. */
static bool read_line(record_reader *r) {
  char *end = r->line, *const limit = r->line + RECORD_LIMIT + 1;
  int byte;
  while ((byte = getc_unlocked(r->file)) != EOF) {
    if (end < limit)
      *end++ = (char)byte;
    if (byte == '\n' || byte == '\r')
      break;
  }
  if (byte == '\r' && (byte = getc_unlocked(r->file)) != '\n')
    ungetc(byte, r->file); /* which EOF leaves as it is */
  else if (byte == '\n' && end[-1] == '\r' && end < limit)
    *end++ = '\n';
  r->line_size = (size_t)(end - r->line);
  if (r->lines++ == 0 && r->line_size >= 3 && memcmp(r->line, "\xEF\xBB\xBF", 3) == 0)
    memmove(r->line, r->line + 3, r->line_size -= 3); /* the byte-order mark */
  return end > r->line;
}

bool is_text(const char *bytes, size_t size) {
  for (size_t k = 0; k < size; k++)
    if ((unsigned char)bytes[k] < ' ' && memchr("\t\r\n\f", bytes[k], 4) == NULL)
      return false;
  return true;
}

/* What a file is, by its first line, that is no CSV; NULL if it may be. */
static const char *kind_of(const record_reader *r) {
  const char *first = r->line + strspn(r->line, " \t");
  if (!is_text(r->line, r->line_size))
    return NOT_TEXT;
  if (r->line_size > 1 && *first == '{')
    return "JSON; whole shots in it are played by `carom shoot`";
  return NULL;
}

/* What stands between fields: of comma, semicolon and tab, the first that is as frequent in the
 * first line as any. */
static void find_delimiter(record_reader *r) {
  size_t most = 0;
  for (const char *delimiter = ",;\t"; *delimiter != '\0'; delimiter++) {
    size_t count = 0;
    for (size_t k = 0; k < r->line_size; k++)
      count += r->line[k] == *delimiter;
    if (count > most) {
      csv_set_delim(&r->parser, (unsigned char)*delimiter);
      most = count;
    }
  }
}

/* Whether the line, the first of a record, is passed over. */
static bool is_skipped(const record_reader *r) {
  return r->line_size == 0 || r->line[0] == '\n' || r->line[0] == '\r' ||
         (!r->begun && r->line[0] == '#');
}

/* Feeds lines until a record is complete or the input ends; false if it is malformed, which
 * drops it. */
static bool feed_record(record_reader *r, record *out) {
  size_t fed = 0;
  while (!r->complete && read_line(r)) {
    const char *kind = r->lines == 1 ? kind_of(r) : NULL;
    if (kind != NULL) {
      complain("%s: not a CSV file, but %s", r->name, kind);
      r->refused = true;
      return false;
    }
    if (fed == 0 && is_skipped(r))
      continue;
    if (!r->begun)
      find_delimiter(r);
    r->begun = true;
    if (fed == 0)
      out->line = r->lines;
    fed += r->line_size;
    if (fed <= RECORD_LIMIT)
      csv_parse(&r->parser, r->line, r->line_size, on_field, on_record, r);
    if (!r->complete && fed > RECORD_LIMIT) {
      const unsigned char delimiter = csv_get_delim(&r->parser);
      csv_free(&r->parser);
      csv_init(&r->parser, 0);
      csv_set_delim(&r->parser, delimiter);
      return false;
    }
  }
  if (!r->complete && feof(r->file))
    csv_fini(&r->parser, on_field, on_record, r);
  return true;
}

/* Whether there is nothing in any of the fields, as in ",,,," below a table that came out of a
 * spreadsheet. */
static bool is_empty(const record_reader *r) {
  return r->complete && r->count > 1 && r->text_size == r->count;
}

read_result record_next(record_reader *r, record *out) {
  do {
    r->count = 0;
    r->text_size = 0;
    r->complete = false;
    *out = (record){0};
    out->malformed = !feed_record(r, out);
  } while (!out->malformed && is_empty(r));
  if (r->refused)
    return READ_FAILED;
  /* what ends before the end of the file, without an error of its own, found no memory for its
   * buffer */
  if (ferror(r->file) || !(r->complete || out->malformed || feof(r->file))) {
    complain("cannot read %s: %s", r->name, strerror(errno));
    return READ_FAILED;
  }
  if (out->malformed)
    return READ_ONE;
  r->field = grow(r->field, &r->field_room, r->count, sizeof *r->field);
  for (size_t k = 0; k < r->count; k++)
    r->field[k] = r->text + r->start[k];
  out->count = r->count;
  out->field = r->field;
  out->decimal_commas = csv_get_delim(&r->parser) == ';';
  return r->complete ? READ_ONE : READ_END;
}

bool record_number(const record *r, const char *text, double *number) {
  char point[64];
  const size_t size = strlen(text), comma = strcspn(text, ",");
  if (!r->decimal_commas || comma == size || size >= sizeof point || strpbrk(text, ".xX") != NULL)
    return parse_number(text, number);
  memcpy(point, text, size + 1);
  point[comma] = '.';
  return parse_number(point, number);
}

bool record_is_numbers(const record *r) {
  size_t numbers = 0;
  double unused;
  for (size_t k = 0; k < r->count; k++)
    numbers += record_number(r, r->field[k], &unused);
  return 2 * numbers > r->count;
}

double record_share(const record_reader *r) {
  return r->bytes > 0.0 ? (double)ftello(r->file) / r->bytes : -1.0;
}

const char *record_file_name(const record_reader *r) {
  return r->name;
}

void record_close(record_reader *r) {
  if (r == NULL)
    return;
  if (r->file != NULL && r->file != stdin)
    fclose(r->file);
  csv_free(&r->parser);
  free(r->text);
  free(r->start);
  free(r->field);
  free(r);
}
