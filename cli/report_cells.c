/* Tables of the report's page, cell by cell. */
#include "report_cells.h"

#include "report.h"

#include <math.h>
#include <stdarg.h>
#include <string.h>

void open_table(FILE *out, const char *id, const char *heading) {
  fprintf(out, "<h2 id=\"table-%s\">%s</h2>\n", id, heading);
}

/* Head cells: "t:" before a name aligns it left, "p:" marks the paper's column. */
void head_row(FILE *out, const char *const name[], size_t n) {
  fputs("<div class=\"wide\"><table>\n<tr>", out);
  for (size_t k = 0; k < n; k++) {
    const char kind = name[k][1] == ':' ? name[k][0] : ' ';
    fprintf(out, "<th%s>", kind == 't' ? " class=\"t\"" : kind == 'p' ? " class=\"paper\"" : "");
    report_escape(out, kind == ' ' ? name[k] : name[k] + 2);
    fputs("</th>", out);
  }
  fputs("</tr>\n", out);
}

void cell(FILE *out, const char *class, const char *text) {
  fprintf(out, class[0] != '\0' ? "<td class=\"%s\">" : "<td>", class);
  report_escape(out, text);
  fputs("</td>", out);
}

__attribute__((format(printf, 3, 4))) void cell_of(FILE *out, const char *class, const char *format, ...) {
  char text[512];
  va_list arguments;
  va_start(arguments, format);
  vsnprintf(text, sizeof text, format, arguments);
  va_end(arguments);
  cell(out, class, text);
}

/* Grouped by thousands; "NA" for what was not measured. */
void cell_count(FILE *out, const char *class, double x) {
  if (isnan(x)) {
    cell(out, class, "NA");
    return;
  }
  char digits[32], text[64] = "";
  snprintf(digits, sizeof digits, "%.0f", x);
  const size_t size = strlen(digits);
  for (size_t k = 0, to = 0; k < size; k++) {
    if (k > 0 && (size - k) % 3 == 0)
      text[to++] = ',';
    text[to++] = digits[k];
    text[to] = '\0';
  }
  cell(out, class, text);
}

void close_table(FILE *out) {
  fputs("</table></div>\n", out);
}

void no_data(FILE *out, int data) {
  fprintf(out, "<p class=\"missing\">There are no data: <code>%s.csv</code> is missing.</p>\n", report_data_name(data));
}

void cell_ns(FILE *out, double ns) {
  if (ns >= 1000.0)
    cell_count(out, "", ns);
  else
    cell_of(out, "", "%.4g", ns);
}
