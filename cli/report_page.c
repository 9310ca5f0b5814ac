/* The report's page: one HTML file that needs no other, with figures and tables. */
#include "message.h"
#include "output.h"
#include "report.h"

#include <stdlib.h>
#include <string.h>

static const char head[] =
    "<!DOCTYPE html>\n"
    "<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n"
    "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n"
    "<title>carom: report</title>\n"
    "<style>\n"
    "body { margin: 0 auto; max-width: 72rem; padding: 1.5rem; font: 16px/1.5 Helvetica, Arial, \"DejaVu Sans\", sans-serif;\n"
    "  color: #222; background: #fff }\n"
    "h1 { font-size: 1.9rem; margin: 0.5rem 0 } h2 { font-size: 1.35rem; margin: 2.6rem 0 0.6rem }\n"
    "p { max-width: 46rem } nav a { margin-right: 1.1em; white-space: nowrap } a { color: #0072b2 }\n"
    "figure { margin: 2rem 0; max-width: 64rem } figure svg { display: block; width: 100%; height: auto; border: 1px solid "
    "#e4e4e4 }\n"
    "figcaption { margin-top: 0.6rem; max-width: 46rem } figcaption b { font-weight: 600 }\n"
    ".missing { border: 1px dashed #999; padding: 1rem }\n"
    ".wide { overflow-x: auto }\n"
    "table { border-collapse: collapse; font-size: 0.875rem; font-variant-numeric: tabular-nums; margin: 0.8rem 0 }\n"
    "th, td { padding: 0.22rem 0.5rem; text-align: right; border-bottom: 1px solid #e4e4e4; white-space: nowrap }\n"
    "th { border-bottom: 2px solid #888; font-weight: 600; vertical-align: bottom; white-space: normal }\n"
    "th.t, td.t { text-align: left } td.wrap { white-space: normal; text-align: left; min-width: 13rem }\n"
    "td.paper, th.paper { color: #a04600 } td.best { font-weight: 700; outline: 2px solid #e69f00 } td.fail { background: "
    "#ffe0d0 }\n"
    "code { font-size: 0.9em } dl { display: grid; grid-template-columns: max-content 1fr; gap: 0.1rem 1rem; font-size: "
    "0.875rem }\n"
    "dt { color: #6b6b6b } dd { margin: 0 }\n"
    "@media print { nav { display: none } figure { break-inside: avoid } }\n"
    "</style>\n</head>\n<body>\n";

void report_escape(FILE *out, const char *text) {
  for (; *text != '\0'; text++)
    switch (*text) {
    case '&':
      fputs("&amp;", out);
      break;
    case '<':
      fputs("&lt;", out);
      break;
    case '>':
      fputs("&gt;", out);
      break;
    case '"':
      fputs("&quot;", out);
      break;
    default:
      fputc(*text, out);
    }
}

static void write_machine(const report *r, FILE *out) {
  static const char *const notes[] = {"processor",        "processor family", "cores",       "system",
                                      "reference cycles", "pinning",          "load before", "counters",
                                      "commit",           "compiler",         "flags",       "date"};
  const sheet *s = &r->data[DATA_ladder];
  fputs("<h2 id=\"machine\">Where this was measured</h2>\n", out);
  if (s->rows == 0) {
    fputs("<p>Nothing was measured.</p>\n", out);
    return;
  }
  fputs("<dl>\n", out);
  for (size_t k = 0; k < sizeof notes / sizeof notes[0]; k++) {
    const char *text = sheet_note(s, notes[k]);
    if (text == NULL)
      continue;
    fprintf(out, "<dt>%s</dt><dd>", notes[k]);
    report_escape(out, text);
    fputs("</dd>\n", out);
  }
  fputs("</dl>\n", out);
}

/* The SVG without the XML declaration, which only a file of its own may have. */
static bool write_svg(const report *r, FILE *out, const report_figure *figure) {
  char path[PATH_MAX];
  FILE *in = report_path(path, r->folder, figure->name, ".svg") ? fopen(path, "rb") : NULL;
  char *text = NULL;
  size_t size = 0;
  const bool read = in != NULL && getdelim(&text, &size, '\0', in) > 0;
  const char *svg = read ? strstr(text, "<svg") : NULL;
  if (svg != NULL)
    fputs(svg, out);
  free(text);
  if (in != NULL)
    fclose(in);
  return svg != NULL;
}

static void write_figure(const report *r, FILE *out, const report_figure *figure) {
  fprintf(out, "<figure id=\"figure-%s\">\n", figure->name);
  if (figure->missing[0] != '\0' || !write_svg(r, out, figure)) {
    fputs("<p class=\"missing\">This figure could not be drawn: ", out);
    report_escape(out, figure->missing);
    fprintf(out, ". Its data are in <code>%s.csv</code> where there are any.</p>\n", figure->csv);
  }
  fputs("<figcaption><b>", out);
  report_escape(out, figure->title);
  fputs("</b>", out);
  if (figure->number[0] != '\0')
    fprintf(out, " (the paper's %s)", figure->number);
  fputs(". ", out);
  report_escape(out, figure->sentence);
  fprintf(out, " Data: <code>%s.csv</code>.</figcaption>\n</figure>\n", figure->csv);
}

static void write_commands(FILE *out) {
  fputs("<h2 id=\"again\">How to repeat it</h2>\n<p>All of this: <code>carom report DIR</code>. From these CSV files alone: "
        "<code>carom report --from DIR OTHER</code>. One file of it:</p>\n<table>\n<tr><th class=\"t\">file</th><th "
        "class=\"t\">command</th></tr>\n",
        out);
  for (int k = 0; k < DATA_COUNT; k++)
    if (report_data_command(k) != NULL) {
      fprintf(out, "<tr><td class=\"t\"><code>%s.csv</code></td><td class=\"wrap\"><code>carom ", report_data_name(k));
      report_escape(out, report_data_command(k));
      fputs("</code></td></tr>\n", out);
    }
  fputs(
      "</table>\n<p><code>{solvers}</code> stands for the library's own kernels; <code>docs/measuring.md</code> says what the "
      "figures mean and how far to trust them, <code>docs/ladder.md</code> why they are what they are.</p>\n",
      out);
}

static void write_page(const report *r, FILE *out) {
  fputs(head, out);
  fputs(
      "<h1>carom: how fast, how exact</h1>\n<p>Collisions of two billiard balls by Mathavan's model: the kernels of the seed "
      "paper (<i>Accelerating Mathavan's Billiard Ball Collision Algorithm</i>) and this library's own, each verified against "
      "references and then timed on 204 real collisions. The paper's values, measured on an AMD EPYC 7302 (Zen 2) with clang, "
      "stand beside ours.</p>\n<nav>",
      out);
  for (int k = 0; k < FIGURE_COUNT; k++) {
    fprintf(out, "<a href=\"#figure-%s\">", r->figure[k].name);
    report_escape(out, r->figure[k].title);
    fputs("</a> ", out);
  }
  fputs("<a href=\"#tables\">Tables</a> <a href=\"#machine\">Machine</a> <a href=\"#again\">How to repeat it</a></nav>\n", out);
  for (int k = 0; k < FIGURE_COUNT; k++)
    write_figure(r, out, &r->figure[k]);
  fputs("<div id=\"tables\">\n", out);
  report_write_tables(r, out);
  fputs("</div>\n", out);
  write_machine(r, out);
  write_commands(out);
  fputs("</body>\n</html>\n", out);
}

bool report_write_page(const report *r) {
  char path[PATH_MAX];
  FILE *out = report_path(path, r->folder, "index.html", "") ? output_open(path) : NULL;
  if (out == NULL)
    return false;
  write_page(r, out);
  if (!output_commit())
    return false;
  printf("report: %s\n", path);
  return true;
}
