/* The report's table of the 2014 paper's experiments. */
#include "report.h"
#include "report_cells.h"

#include <math.h>
#include <string.h>

static const struct {
  const char *column, *title, *format;
} outcomes[] = {
    {"v_cue", "cue ball, m/s", "%.3f"},
    {"v_object", "object ball, m/s", "%.3f"},
    {"angle_cue_deg", "cue ball, degrees", "%.2f"},
    {"angle_object_deg", "object ball, degrees", "%.2f"},
};
enum { OUTCOMES = sizeof outcomes / sizeof outcomes[0] };

static double outcome_of(const sheet *s, const char *shot, const char *source, const char *column) {
  for (size_t row = 0; (row = sheet_find(s, row, "shot", shot)) < s->rows; row++)
    if (strcmp(sheet_text(s, row, "source"), source) == 0)
      return sheet_number(s, row, column);
  return NAN;
}

/* Is this the first row of its shot? */
static bool is_new(const sheet *s, size_t row) {
  return sheet_find(s, 0, "shot", sheet_text(s, row, "shot")) == row;
}

/* Sources come in the order in which the first shot has them. */
static size_t sources(const sheet *s) {
  size_t count = 1;
  while (count < s->rows && !is_new(s, count))
    count++;
  return count;
}

void report_write_experiments(const report *r, FILE *out) {
  const sheet *s = &r->data[DATA_experiments];
  open_table(out, "experiments", "The 2014 paper's experiments");
  if (s->rows == 0) {
    no_data(out, DATA_experiments);
    return;
  }
  fputs(
      "<p>Speeds and angles of both balls once they roll. Measured and predicted are the 2014 paper's; the solvers take its "
      "friction and restitution. The measured angle of the object ball equals the cut angle: it is no independent check.</p>\n",
      out);
  const size_t n = sources(s);
  fputs("<div class=\"wide\"><table>\n<tr><th class=\"t\">shot</th><th class=\"t\">outcome</th>", out);
  for (size_t k = 0; k < n; k++) {
    fputs(k < 2 ? "<th class=\"paper\">" : "<th>", out);
    report_escape(out, sheet_text(s, k, "source"));
    fputs("</th>", out);
  }
  fputs("</tr>\n", out);
  for (int o = 0; o < OUTCOMES; o++)
    for (size_t row = 0; row < s->rows; row++) {
      if (!is_new(s, row))
        continue;
      const char *shot = sheet_text(s, row, "shot");
      fputs("<tr>", out);
      cell(out, "t", shot);
      cell(out, "t", outcomes[o].title);
      for (size_t k = 0; k < n; k++) {
        char text[32];
        snprintf(text, sizeof text, outcomes[o].format, outcome_of(s, shot, sheet_text(s, k, "source"), outcomes[o].column));
        cell(out, k < 2 ? "paper" : "", text);
      }
      fputs("</tr>\n", out);
    }
  close_table(out);
}
