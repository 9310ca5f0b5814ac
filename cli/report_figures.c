/* The report's figures: gnuplot draws each from its CSV by its script in lab/figures; what makes the SVG depend on more than
 * the data, or keeps it from standing beside others in one page, is put right here. */
#include "gnuplot.h"
#include "message.h"
#include "output.h"
#include "place.h"
#include "report.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const report_figure figures[FIGURE_COUNT] = {
#define FIGURE(name, number, csv, title, sentence) {#name, number, #csv, title, sentence, ""},
#include "figures.def"
#undef FIGURE
};

static char *read_text(const char *path) {
  FILE *in = fopen(path, "rb");
  if (in == NULL)
    return NULL;
  char *text = NULL;
  size_t size = 0;
  if (getdelim(&text, &size, '\0', in) < 0) {
    free(text);
    text = NULL;
  }
  fclose(in);
  return text;
}

/* Does an id begin at `at`, or a reference to one? */
static bool begins_id(const char *text, const char *at) {
  static const char *const before[] = {" id='", " id=\"", "url(#", "href='#", "href=\"#"};
  for (size_t k = 0; k < sizeof before / sizeof before[0]; k++) {
    const size_t size = strlen(before[k]);
    if ((size_t)(at - text) >= size && strncmp(at - size, before[k], size) == 0)
      return true;
  }
  return false;
}

/* Writes gnuplot's SVG with ids of its own, so that many can stand in one page, and with a title and a description for those
 * who do not see it, in place of gnuplot's name and version. */
static void write_svg(FILE *out, const report_figure *figure, const char *text) {
  const char *at = text;
  while (*at != '\0') {
    const char *end;
    if (strncmp(at, "<title>Gnuplot</title>", 22) == 0) {
      fputs("<title>", out);
      report_escape(out, figure->title);
      fputs("</title>", out);
      at += 22;
    } else if (strncmp(at, "<desc>", 6) == 0 && (end = strstr(at, "</desc>")) != NULL) {
      fputs("<desc>", out);
      report_escape(out, figure->sentence);
      fputs("</desc>", out);
      at = end + 7;
    } else {
      if (begins_id(text, at))
        fprintf(out, "%s-", figure->name);
      fputc(*at++, out);
    }
  }
}

static bool finish_svg(const report_figure *figure, const char *path) {
  char *text = read_text(path);
  const bool whole = text != NULL && strstr(text, "</svg>") != NULL;
  FILE *out = whole ? output_open(path) : NULL;
  if (out != NULL)
    write_svg(out, figure, text);
  free(text);
  return out != NULL && output_commit();
}

static const sheet *data_of(const report *r, const char *name) {
  int k = 0;
  while (strcmp(report_data_name(k), name) != 0)
    k++;
  return &r->data[k];
}

/* Draws one picture of the figure; false, with the reason in figure->missing, if that cannot be. */
static bool draw(const report *r, report_figure *figure, const char *extension) {
  char folder[PATH_MAX], script[PATH_MAX], path[PATH_MAX], csv[64], picture[64];
  place_find(CAROM_SOURCE_LAB "/figures", CAROM_INSTALLED_SHARE "/figures", folder);
  snprintf(csv, sizeof csv, "%s.csv", figure->csv);
  snprintf(picture, sizeof picture, "%s%s", figure->name, extension);
  snprintf(figure->missing, sizeof figure->missing, "there are no data in %s", csv);
  if (!report_path(script, folder, figure->name, ".gp") || !report_path(path, r->folder, picture, ""))
    return false;
  unlink(path);
  if (data_of(r, figure->csv)->rows == 0)
    return false;
  const int code = gnuplot_run(r->folder, script, csv, picture, figure->title);
  if (code == NO_GNUPLOT) {
    snprintf(figure->missing, sizeof figure->missing, "%s", no_gnuplot);
    return false;
  }
  if (code != 0 || access(path, R_OK) != 0 || (strcmp(extension, ".svg") == 0 && !finish_svg(figure, path))) {
    snprintf(figure->missing, sizeof figure->missing, "gnuplot failed on %s.gp", figure->name);
    return false;
  }
  figure->missing[0] = '\0';
  printf("%s: %s\n", picture, figure->title);
  return true;
}

void report_draw(report *r) {
  bool said = false;
  for (int k = 0; k < FIGURE_COUNT; k++) {
    report_figure *figure = &r->figure[k];
    *figure = figures[k];
    if (draw(r, figure, ".svg") && (!r->png || draw(r, figure, ".png")))
      continue;
    if (strcmp(figure->missing, no_gnuplot) != 0)
      complain("no figure %s: %s", figure->name, figure->missing);
    else if (!said)
      complain("no figures: %s; the CSV files and the page's tables come all the same", no_gnuplot);
    said |= strcmp(figure->missing, no_gnuplot) == 0;
  }
}
