/* `carom report`: measures, draws, and writes one page with all figures and tables. */
#include "command.h"
#include "message.h"
#include "option.h"
#include "report.h"

#include <errno.h>
#include <getopt.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

static const char help[] =
    "usage: carom report [OPTIONS] DIR\n\n"
    "Verifies and times the kernels, and writes to DIR (made if it is not there): the CSV files, the figures as SVG, and\n"
    "index.html, one page with the figures and tables and the seed paper's values beside ours. Figures are drawn by gnuplot;\n"
    "without it the CSV files and the tables come all the same.\n\n"
    "  --budget SECONDS  how long to measure in all, about (default 110)\n"
    "  --from DIR2       measure nothing: take the CSV files of an earlier report from DIR2 (it may be DIR)\n"
    "  --png             the figures as PNG too\n"
    "  --data DIR        folder of the cases and references (default: $CAROM_DATA, else the one that came with carom)\n"
    "  -h, --help        this text\n\n"
    "docs/report.md says which command makes which file, and how to add a figure.\n\n"
    "exit code: 0 if all is there, 1 if data or figures are missing (the page says which), 2 for bad usage or if DIR cannot\n"
    "be written\n";

static bool is_folder(const char *path) {
  struct stat status;
  return stat(path, &status) == 0 && S_ISDIR(status.st_mode);
}

/* Makes the folder and those it lies in. */
static bool make_folder(const char *folder) {
  char path[PATH_MAX];
  if (!report_path(path, folder, "", ""))
    return false;
  for (char *slash = strchr(path + 1, '/'); slash != NULL; slash = strchr(slash + 1, '/')) {
    *slash = '\0';
    if (mkdir(path, 0777) != 0 && errno != EEXIST) {
      complain("cannot make the folder %s: %s", path, strerror(errno));
      return false;
    }
    *slash = '/';
  }
  if (is_folder(path))
    return true;
  complain("%s is not a folder", folder);
  return false;
}

static int make_report(report *r) {
  if (r->from != NULL && !is_folder(r->from)) {
    complain("--from: there is no folder %s", r->from);
    return EXIT_USAGE;
  }
  if (!make_folder(r->folder))
    return EXIT_USAGE;
  report_collect(r);
  report_draw(r);
  report_print_speedups(r);
  int code = EXIT_GOOD;
  for (int k = 0; k < DATA_COUNT; k++)
    if (r->data[k].rows == 0)
      code = EXIT_SOME;
  for (int k = 0; k < FIGURE_COUNT; k++)
    if (r->figure[k].missing[0] != '\0')
      code = EXIT_SOME;
  if (!report_write_page(r))
    code = EXIT_USAGE;
  for (int k = 0; k < DATA_COUNT; k++)
    sheet_free(&r->data[k]);
  return code;
}

int command_report(int argc, char **argv) {
  static const struct option options[] = {
      {"budget", required_argument, NULL, 'b'}, {"from", required_argument, NULL, 'f'}, {"png", no_argument, NULL, 'p'},
      {"data", required_argument, NULL, 'd'},   {"help", no_argument, NULL, 'h'},       {0},
  };
  report r = {.budget = 110.0};
  int option;
  while ((option = getopt_long(argc, argv, "h", options, NULL)) != -1)
    switch (option) {
    case 'b':
      if (!option_budget(optarg, &r.budget))
        return EXIT_USAGE;
      break;
    case 'f':
      r.from = optarg;
      break;
    case 'p':
      r.png = true;
      break;
    case 'd':
      r.references = optarg;
      break;
    case 'h':
      fputs(help, stdout);
      return EXIT_GOOD;
    default:
      return usage_hint("report");
    }
  if (optind != argc - 1 || argv[optind][0] == '\0') {
    complain("report takes one folder to write to, but got %d", argc - optind);
    return usage_hint("report");
  }
  r.folder = argv[optind];
  return make_report(&r);
}
