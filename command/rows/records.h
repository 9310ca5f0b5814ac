/* Records of a CSV file, one at a time, in constant memory.
 *
 * Understood: fields quoted or not, quoted commas, quotes and line ends, LF, CRLF and CR, a
 * UTF-8 byte-order mark, a last line without its end; fields between semicolons or tabs, where
 * the first record has more of them than commas. Passed over: blank lines, records of which
 * every field is empty, and lines that begin with # before the first record, which carom itself
 * writes. Other kinds of files that are given for CSV, such as JSON and archives, are refused. A
 * record of more than a mebibyte, such as an unclosed quote makes, is malformed: it costs that
 * record, and reading goes on at the next line. A NUL in a field is read as '?'.
 */
#ifndef CAROM_CLI_RECORDS_H
#define CAROM_CLI_RECORDS_H

#include <stdbool.h>
#include <stddef.h>

typedef struct record_reader record_reader;

typedef struct record {
  long long line;      /* on which the record begins, counted from 1 */
  size_t count;        /* number of fields */
  char **field;        /* each ends with NUL; valid until the next call */
  bool malformed;      /* too long to be meant; no fields */
  bool decimal_commas; /* the fields stand between semicolons, so that a number may have a
                          decimal comma */
} record;

typedef enum read_result { READ_FAILED = -1, READ_END = 0, READ_ONE = 1 } read_result;

/* Opens `path`, "-" for stdin. Complains and returns NULL if that fails. */
record_reader *record_open(const char *path);

/* The next record, or READ_END; READ_FAILED after a complaint when the input cannot be read on. */
read_result record_next(record_reader *reader, record *out);

/* The share of the file that has been read, or -1 where its size is not known: for progress. */
double record_share(const record_reader *reader);

/* Reads a field as parse_number() does; between semicolons, with a decimal comma or a point. */
bool record_number(const record *r, const char *text, double *number);

/* Whether most fields are numbers: of a first record, that it is no header. */
bool record_is_numbers(const record *r);

/* The name of the file for messages. */
const char *record_file_name(const record_reader *reader);

void record_close(record_reader *reader);

/* Whether bytes may be text: there are no control characters but blanks. What else they are, for
 * messages. */
bool is_text(const char *bytes, size_t size);
#define NOT_TEXT                                                                                  \
  "binary data: unpack what is compressed or an archive, save UTF-16 as UTF-8, name an array of " \
  "NumPy .npy"

#endif
