/* Texts of the help as roff. A line is a paragraph; one that begins with blanks is an item of a
 * list, whose head ends with two.
 */
#include "program/manual.h"

#include <string.h>

/* What roff would take for requests and escapes is put right. A line may break behind a bar or a
 * comma. */
static void write_roff(FILE *out, const char *text, size_t size) {
  if (size > 0 && (text[0] == '.' || text[0] == '\''))
    fputs("\\&", out);
  for (size_t k = 0; k < size; k++)
    switch (text[k]) {
    case '-':
      fputs("\\-", out);
      break;
    case '\\':
      fputs("\\e", out);
      break;
    case '|':
    case ',':
      fprintf(out, "%c\\:", text[k]);
      break;
    default:
      putc(text[k], out);
    }
}

static void write_text(FILE *out, const char *text) {
  for (size_t size; *text != '\0'; text += size + (text[size] == '\n')) {
    size = strcspn(text, "\n");
    const size_t indent = strspn(text, " ");
    const char *gap = indent > 0 ? strstr(text + indent, "  ") : NULL, *rest = text + indent;
    if (size == 0)
      continue;
    if (gap != NULL && gap < text + size) {
      fputs(".TP\n.B ", out);
      write_roff(out, text + indent, (size_t)(gap - text) - indent);
      rest = gap + strspn(gap, " ");
    } else
      fputs(".PP", out);
    putc('\n', out);
    write_roff(out, rest, (size_t)(text + size - rest));
    putc('\n', out);
  }
}

void manual_section(FILE *out, const char *name, const char *text) {
  fprintf(out, ".SH %s\n", name);
  write_text(out, text);
}

void manual_item(FILE *out, const char *head, const char *argument, const char *text) {
  fputs(".TP\n\\fB", out);
  write_roff(out, head, strlen(head));
  fputs("\\fR", out);
  if (argument != NULL) {
    fputs(" \\fI", out);
    write_roff(out, argument, strlen(argument));
    fputs("\\fR", out);
  }
  putc('\n', out);
  write_roff(out, text, strlen(text));
  putc('\n', out);
}

void manual_begin(FILE *out, const char *program, const char *command, const char *usage,
                  const char *about) {
  char name[64];
  if (command != NULL)
    snprintf(name, sizeof name, "%s-%s", program, command);
  else
    snprintf(name, sizeof name, "%s", program);
  fputs(".SH NAME\n", out);
  write_roff(out, name, strlen(name));
  fputs(" \\- ", out);
  write_roff(out, about, strcspn(about, "."));
  fputs("\n.SH SYNOPSIS\n", out);
  /* the ways to call it, a line each */
  for (const char *form_end;; usage = form_end + 3) {
    form_end = strstr(usage, " | ");
    fprintf(out, ".B %s", program);
    if (command != NULL)
      fprintf(out, " %s", command);
    putc('\n', out);
    if (form_end == NULL)
      break;
    write_roff(out, usage, (size_t)(form_end - usage));
    fputs("\n.br\n", out);
  }
  write_roff(out, usage, strlen(usage));
  putc('\n', out);
}

void manual_end(FILE *out, const char *exits, const char *example) {
  manual_section(out, "EXIT STATUS", exits);
  fputs(".SH EXAMPLES\n.nf\n", out);
  write_roff(out, example, strlen(example));
  fputs("\n.fi\n", out);
}
