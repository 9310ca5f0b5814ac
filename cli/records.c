/* Records of a CSV file, over libcsv.
 *
 * libcsv is fed one line at a time, so that the number of the line in which a record began is known and a feed completes at
 * most one record.
 */
#include "records.h"

#include "message.h"

#include <csv.h>
#include <ctype.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

enum { CHUNK = 1 << 16, RECORD_LIMIT = 1 << 20 };

struct record_reader {
  FILE *file;
  const char *name;
  double bytes_read, bytes_total;
  char chunk[CHUNK];
  size_t chunk_size, chunk_at;
  bool at_end;
  long long line;      /* of the next byte */
  bool after_cr;       /* the last byte was CR, so LF would not begin another line */
  bool between;        /* no byte of a record has been fed since the last one ended */
  long long first;     /* line on which the record being fed began */
  size_t record_bytes; /* fed since then */
  bool skipping;       /* the rest of a line that was too long is passed over */
  struct csv_parser parser;
  bool complete; /* the last feed ended a record */
  char *text;    /* the fields of the record, each with its NUL */
  size_t text_size, text_room;
  size_t *start; /* offset of each field in `text` */
  char **field;
  size_t count, field_room;
};

static void *grow(void *block, size_t *room, size_t needed, size_t size) {
  if (needed <= *room)
    return block;
  *room = needed > 2 * *room ? needed : 2 * *room;
  void *larger = realloc(block, *room * size);
  if (larger == NULL) {
    complain("out of memory");
    exit(2);
  }
  return larger;
}

static void on_field(void *text, size_t size, void *context) {
  record_reader *r = context;
  const size_t old_room = r->field_room;
  r->start = grow(r->start, &r->field_room, r->count + 1, sizeof *r->start);
  if (r->field_room != old_room) {
    size_t room = old_room;
    r->field = grow(r->field, &room, r->field_room, sizeof *r->field);
  }
  r->text = grow(r->text, &r->text_room, r->text_size + size + 1, 1);
  if (size > 0)
    memcpy(r->text + r->text_size, text, size);
  for (char *nul = r->text + r->text_size; (nul = memchr(nul, '\0', (size_t)(r->text + r->text_size + size - nul))) != NULL;)
    *nul = '?'; /* or the field would seem to end here, and 0.5<NUL>junk be a number */
  r->text[r->text_size + size] = '\0';
  r->start[r->count++] = r->text_size;
  r->text_size += size + 1;
}

static void on_record(int end, void *context) {
  (void)end;
  ((record_reader *)context)->complete = true;
}

static bool start_parser(record_reader *r) {
  r->between = true;
  r->record_bytes = 0;
  return csv_init(&r->parser, 0) == 0;
}

record_reader *record_open(const char *path) {
  record_reader *r = calloc(1, sizeof *r);
  if (r == NULL || !start_parser(r)) {
    complain("out of memory");
    free(r);
    return NULL;
  }
  const bool is_stdin = strcmp(path, "-") == 0;
  r->name = is_stdin ? "standard input" : path;
  r->file = is_stdin ? stdin : fopen(path, "rb");
  struct stat status;
  if (r->file == NULL || fstat(fileno(r->file), &status) != 0 || (S_ISDIR(status.st_mode) && (errno = EISDIR))) {
    complain("cannot read %s: %s", path, strerror(errno));
    record_close(r);
    return NULL;
  }
  r->bytes_total = S_ISREG(status.st_mode) ? (double)status.st_size : -1.0;
  r->line = 1;
  return r;
}

/* Fills the chunk; false at the end of the input. */
static bool refill(record_reader *r) {
  const bool first = r->bytes_read == 0.0;
  r->chunk_size = fread(r->chunk, 1, CHUNK, r->file);
  r->chunk_at = 0;
  r->bytes_read += (double)r->chunk_size;
  if (first && r->chunk_size >= 3 && memcmp(r->chunk, "\xEF\xBB\xBF", 3) == 0)
    r->chunk_at = 3;
  return r->chunk_size > 0;
}

/* The bytes up to and with the next line end, or to the end of the chunk. */
static size_t line_part(const record_reader *r, bool *ends) {
  const char *from = r->chunk + r->chunk_at;
  const size_t left = r->chunk_size - r->chunk_at;
  size_t size = 0;
  while (size < left && from[size] != '\n' && from[size] != '\r')
    size++;
  *ends = size < left;
  return size + *ends;
}

/* Goes on behind a part, and counts lines. */
static void pass(record_reader *r, size_t size, bool ends) {
  const char last = r->chunk[r->chunk_at + size - 1];
  const bool lf_of_crlf = last == '\n' && r->after_cr && size == 1;
  r->line += ends && !lf_of_crlf;
  r->after_cr = last == '\r';
  r->chunk_at += size;
}

/* Feeds libcsv up to the next line end or the end of the chunk. */
static bool feed(record_reader *r) {
  const char *from = r->chunk + r->chunk_at;
  bool ends;
  const size_t size = line_part(r, &ends);
  if (r->skipping) {
    r->skipping = !ends;
    pass(r, size, ends);
    return true;
  }
  if (r->between && from[0] != '\n' && from[0] != '\r') {
    r->between = false;
    r->first = r->line;
  }
  r->record_bytes += size;
  if (csv_parse(&r->parser, from, size, on_field, on_record, r) != size)
    return false;
  pass(r, size, ends);
  r->skipping = r->record_bytes > RECORD_LIMIT && !ends;
  return true;
}

static void give(record_reader *r, record *out) {
  for (size_t k = 0; k < r->count; k++)
    r->field[k] = r->text + r->start[k];
  *out = (record){.line = r->first, .count = r->count, .field = r->field};
  r->between = true;
  r->record_bytes = 0;
}

read_result record_next(record_reader *r, record *out) {
  r->count = 0;
  r->text_size = 0;
  r->complete = false;
  while (!r->complete) {
    if (r->chunk_at == r->chunk_size && !refill(r)) {
      if (ferror(r->file)) {
        complain("cannot read %s: %s", r->name, strerror(errno));
        return READ_FAILED;
      }
      if (r->at_end)
        return READ_END;
      r->at_end = true;
      if (csv_fini(&r->parser, on_field, on_record, r) != 0)
        return READ_FAILED;
      if (!r->complete)
        return READ_END;
      break;
    }
    if (!feed(r)) {
      complain("%s:%lld: %s", r->name, r->line, csv_strerror(csv_error(&r->parser)));
      return READ_FAILED;
    }
    if (!r->complete && r->record_bytes > RECORD_LIMIT) {
      *out = (record){.line = r->first, .malformed = true};
      csv_free(&r->parser);
      start_parser(r);
      return READ_ONE;
    }
  }
  give(r, out);
  return READ_ONE;
}

double record_bytes_read(const record_reader *r) {
  return r->bytes_read;
}

double record_bytes_total(const record_reader *r) {
  return r->bytes_total;
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

bool parse_number(const char *text, double *number) {
  char *end;
  *number = strtod(text, &end);
  if (end == text)
    return false;
  while (isspace((unsigned char)*end))
    end++;
  return *end == '\0';
}
