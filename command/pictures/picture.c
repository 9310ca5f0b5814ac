/* Pictures. A program that draws reads its data and writes the picture in memory, so that no
 * temporary file can stay behind; a picture that is whole then goes to its place. */
#include "pictures/picture.h"

#include "pictures/palette.h"
#include "program/program.h"

#include <errno.h>
#include <limits.h>
#include <stdarg.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

enum { NOT_INSTALLED = 127 };
static char converter[] = "rsvg-convert";
static const char converter_package[] = "librsvg2-bin";

static const char *ending_of(const char *path) {
  const size_t size = strlen(path);
  return size > 4 ? path + size - 4 : "";
}

OPTION_SET(set_picture) {
  const char *ending = ending_of(text);
  *(const char **)field = text;
  if (same_text(ending, ".svg") || same_text(ending, ".png") || same_text(ending, ".pdf"))
    return true;
  return refuse_value(row, text, "its name does not end in .svg, .png or .pdf; try picture.svg");
}

static void complain_missing(const char *path, const char *executable, const char *package) {
  complain("cannot draw %s: %s is not installed (Debian: %s)", path, executable, package);
}

/* A file in memory, which the child inherits. Complains and returns NULL if there can be none. */
static FILE *in_memory(const char *name) {
  const int descriptor = memfd_create(name, 0);
  FILE *file = descriptor >= 0 ? fdopen(descriptor, "w+b") : NULL;
  if (file == NULL)
    complain("cannot make a file in memory: %s", strerror(errno));
  return file;
}

/* Runs a program from one file in memory to another. What it says is shown only if it fails:
 * gnuplot also warns of every part of a plot that a CSV has no rows for, and those are optional.
 * False after a complaint. */
static bool run(const char *path, char *const words[], const char *package, FILE *input,
                FILE *output, FILE *noise) {
  int status;
  fflush(NULL);
  rewind(input);
  const pid_t child = fork();
  if (child == 0) {
    if (dup2(fileno(input), STDIN_FILENO) >= 0 && dup2(fileno(output), STDOUT_FILENO) >= 0 &&
        dup2(fileno(noise), STDERR_FILENO) >= 0)
      execvp(words[0], words);
    _exit(NOT_INSTALLED);
  }
  if (child < 0 || waitpid(child, &status, 0) != child)
    status = -1;
  if (status == 0)
    return true;
  if (WIFEXITED(status) && WEXITSTATUS(status) == NOT_INSTALLED)
    complain_missing(path, words[0], package);
  else {
    output_copy(noise, stderr);
    complain("cannot draw %s: %s failed", path, words[0]);
  }
  return false;
}

/* What `write` writes, put to its place by a program with these words; without one as it is. */
static bool make(const char *path, char *const words[], const char *package, FILE *input,
                 void (*write)(FILE *, const void *), const void *data) {
  FILE *noise = in_memory("noise"), *drawn = in_memory("picture"), *out = NULL;
  bool good = input != NULL && noise != NULL && drawn != NULL;
  if (good) {
    write(words != NULL ? input : drawn, data);
    good = (words == NULL || run(path, words, package, input, drawn, noise)) &&
           (out = output_open(path)) != NULL;
  }
  if (good && output_copy(drawn, out) == 0) {
    complain("cannot draw %s: %s drew nothing", path, words != NULL ? words[0] : "carom");
    output_abandon();
    good = false;
  }
  for (int k = 0; k < 3; k++)
    if ((FILE *[]){input, noise, drawn}[k] != NULL)
      fclose((FILE *[]){input, noise, drawn}[k]);
  return good && output_commit();
}

bool picture_draw(const char *path, const char *name, const char *title,
                  void (*write)(FILE *out, const void *data), const void *data) {
  char scripts[PATH_MAX], script[PATH_MAX + 64], input[32], heading[256];
  FILE *csv = in_memory("data");
  snprintf(script, sizeof script, "%s/%s.gp", place_find("figures", scripts), name);
  snprintf(input, sizeof input, "/dev/fd/%d", csv != NULL ? fileno(csv) : 0);
  snprintf(heading, sizeof heading, "%s", title);
  char ending[8];
  snprintf(ending, sizeof ending, "%s", ending_of(path));
  char *const words[] = {(char[]){"gnuplot"}, (char[]){"-c"}, script, input, ending, heading, NULL};
  return make(path, words, "gnuplot-nox", csv, write, data);
}

/* Whether execvp() would find the program: in the folders of PATH, of which an empty one is the
 * current folder. */
static bool is_installed(const char *executable) {
  const char *path = getenv("PATH"), *folder = path != NULL ? path : "/bin:/usr/bin";
  for (;;) {
    char name[PATH_MAX];
    struct stat about;
    const int size = (int)strcspn(folder, ":");
    snprintf(name, sizeof name, "%.*s/%s", size > 0 ? size : 1, size > 0 ? folder : ".",
             executable);
    if (stat(name, &about) == 0 && S_ISREG(about.st_mode) && access(name, X_OK) == 0)
      return true;
    if (folder[size] == '\0')
      return false;
    folder += size + 1;
  }
}

bool svg_possible(const char *path) {
  if (path == NULL || same_text(ending_of(path), ".svg") || is_installed(converter))
    return output_possible(path);
  complain_missing(path, converter, converter_package);
  return false;
}

bool svg_draw(const char *path, void (*write)(FILE *out, const void *data), const void *data) {
  char format[8];
  snprintf(format, sizeof format, "%s", ending_of(path) + 1);
  /* a page keeps its size; dots are twice as many */
  char zoom[] = "--zoom=1";
  zoom[sizeof zoom - 2] = same_text(format, "png") ? '2' : '1';
  char *const words[] = {converter, (char[]){"--format"}, format, zoom, NULL};
  const bool is_svg = same_text(format, "svg");
  return make(path, is_svg ? NULL : words, converter_package, in_memory("data"), write, data);
}

bool file_draw(const char *path, void (*write)(FILE *out, const void *data), const void *data) {
  FILE *out = output_open(path);
  if (out != NULL)
    write(out, data);
  return out != NULL && output_commit();
}

void svg_begin(FILE *out, double width, double height, const char *background) {
  fprintf(out,
          "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 %.0f %.0f\" width=\"%.0f\" "
          "height=\"%.0f\" font-family=\"DejaVu Sans, sans-serif\">\n<rect width=\"100%%\" "
          "height=\"100%%\" %s/>\n",
          width, height, width, height, background);
}

void svg_circle(FILE *out, double x, double y, double r, const char *attributes, ...) {
  va_list list;
  va_start(list, attributes);
  fprintf(out, "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"%.1f\" ", x, y, r);
  vfprintf(out, attributes, list);
  va_end(list);
  fputs("/>\n", out);
}

void svg_text(FILE *out, double x, double y, const char *text, int most, const char *attributes,
              ...) {
  va_list list;
  va_start(list, attributes);
  fprintf(out, "<text x=\"%.1f\" y=\"%.1f\" ", x, y);
  vfprintf(out, attributes, list);
  va_end(list);
  putc('>', out);
  for (int k = 0; k < most && text[k] != '\0'; k++)
    if (text[k] == '<')
      fputs("&lt;", out);
    else if (text[k] == '&')
      fputs("&amp;", out);
    else
      putc(text[k], out);
  fputs("</text>\n", out);
}

double svg_letters(double width) {
  return PALETTE_SIZE_LETTERS * width;
}

double svg_lines(FILE *out, double x, double y, double size, int columns, const char *style,
                 const char *text) {
  char *lines;
  size_t length;
  FILE *wrapped = open_text(&lines, &length);
  print_wrapped(wrapped, text, columns);
  close_text(wrapped, &lines);
  for (const char *line = lines; *line != '\0'; line += strcspn(line, "\n") + 1, y += 1.25 * size)
    if (out != NULL)
      svg_text(out, x, y, line, (int)strcspn(line, "\n"),
               "xml:space=\"preserve\" font-size=\"%.1f\" %s", size, style);
  free(lines);
  return y;
}
