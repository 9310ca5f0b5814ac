/* What the user sees on stderr. */
#include "program/message.h"

#include "program/monotonic.h"
#include "program/words.h"

#include <limits.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

enum { LONGEST = 2 * PATH_MAX }; /* a message; what is beyond is cut */
enum { TABLE_MOST = 32 };        /* columns in which a paragraph's first words stand */

const char random_name[7] = {'X', 'X', 'X', 'X', 'X', 'X', '\0'};

const char *program_name = "carom";
static double started, drawn; /* ns */
static bool standing;

/* What a terminal would obey becomes '?': control characters of ASCII, and those that UTF-8
 * writes as C2 80 to C2 9F. */
static void disarm(char *text) {
  for (unsigned char *byte = (unsigned char *)text; *byte != '\0'; byte++)
    if (*byte < 0x20 || *byte == 0x7f)
      *byte = '?';
    else if (*byte == 0xC2 && byte[1] >= 0x80 && byte[1] < 0xA0)
      byte[0] = byte[1] = '?';
}

void complain(const char *format, ...) {
  char text[LONGEST];
  va_list arguments;
  va_start(arguments, format);
  vsnprintf(text, sizeof text, format, arguments);
  va_end(arguments);
  disarm(text);
  flockfile(stderr); /* the reading thread complains too */
  progress_clear();
  fprintf(stderr, "%s: %s\n", program_name, text);
  funlockfile(stderr);
}

static int hanging_indent(const char *line, size_t size) {
  const size_t blanks = strspn(line, " "), most = size < TABLE_MOST ? size : TABLE_MOST;
  size_t indent = blanks;
  for (size_t k = blanks; k + 2 < most; k++)
    if (line[k] == ' ' && line[k + 1] == ' ')
      indent = k + 2;
  return (int)indent;
}

void print_wrapped(FILE *out, const char *text, int width) {
  for (size_t size; *text != '\0'; text += size + (text[size] == '\n')) {
    size = strcspn(text, "\n");
    const int indent = hanging_indent(text, size);
    int column = 0;
    for (size_t k = 0; k < size;) { /* a word with the blanks before it */
      const int blanks = (int)strspn(text + k, " "), word = (int)strcspn(text + k + blanks, " \n");
      const bool breaks = column > indent && column + blanks + word > width;
      fprintf(out, "%s%*s%.*s", text_if(breaks, "\n"), breaks ? indent : blanks, "", word,
              text + k + blanks);
      column = (breaks ? indent : column + blanks) + word;
      k += (size_t)(blanks + word);
    }
    putc('\n', out);
  }
}

const char *id_text(const char *id, char text[ID_TEXT]) {
  const int most = ID_TEXT - 4;
  snprintf(text, ID_TEXT, "%.*s%s", most, id, strlen(id) > (size_t)most ? "..." : "");
  return text;
}

void progress_show(const char *unit, double done, double total) {
  const double time = clock_ns();
  started = started == 0.0 ? time : started;
  if (time - started < 1e9 || time - drawn < 1e8 || !isatty(STDERR_FILENO))
    return;
  flockfile(stderr);
  drawn = time;
  standing = true;
  fprintf(stderr, "\r\033[K%.0f %s", done, unit);
  if (total > 0.0)
    fprintf(stderr, ", %.0f %%", 100.0 * done / total);
  fflush(stderr);
  funlockfile(stderr);
}

void progress_clear(void) {
  flockfile(stderr);
  if (standing)
    fputs("\r\033[K", stderr);
  standing = false;
  funlockfile(stderr);
}
