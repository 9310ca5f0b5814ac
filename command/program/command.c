/* A program of subcommands: finds the one that is asked for and hands over. */
#include "program/command.h"

#include "carom.h"
#include "program/manual.h"
#include "program/message.h"
#include "program/output.h"
#include "program/report.h"
#include "program/words.h"

#include <fcntl.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static void print_help(FILE *out, const program *p) {
  fprintf(out, "usage: %s COMMAND [ARGUMENTS]\n\n%s\n", p->name, p->about);
  for (size_t k = 0; k < p->count; k++) {
    if (k == 0 || !same_text(p->commands[k].group, p->commands[k - 1].group))
      fprintf(out, "\n%s:\n", p->commands[k].group);
    fprintf(out, "  %-12s%s\n", p->commands[k].name, p->commands[k].text);
  }
  fprintf(out, "\n`%s COMMAND --help` lists its arguments,\n`%s --version` the version.\n", p->name,
          p->name);
  if (p->cites != NULL)
    fprintf(
        out,
        "`%s --cite` lists what to cite, as BibTeX, with the models of `%s`,\n`%s --report` what "
        "a report of a bug needs.\n",
        p->name, p->cites, p->name);
  fprintf(out, "\nexample:\n  %s\n", p->example);
}

/* The same as a page of the manual. */
static void print_manual(FILE *out, const program *p) {
  manual_begin(out, p->name, NULL, "COMMAND [ARGUMENTS]", p->about);
  manual_section(out, "DESCRIPTION", p->about);
  manual_section(out, "COMMANDS", "");
  for (size_t k = 0; k < p->count; k++)
    manual_item(out, p->commands[k].name, NULL, p->commands[k].text);
  manual_section(out, "OPTIONS", "");
  manual_item(out, "--help", NULL, "the commands; behind a command, its arguments");
  manual_item(out, "--version", NULL, "the version");
  if (p->cites != NULL) {
    manual_item(out, "--cite", NULL,
                "what to cite, as BibTeX: the sources of the models of shots; options such as "
                "--cushion choose them");
    manual_item(out, "--report", NULL, "what a report of a bug needs: versions, system, processor");
  }
  manual_section(out, "ENVIRONMENT", "");
  manual_item(out, "CAROM_ISA", NULL,
              "the largest instruction set to use: plain, sse2, avx2 or avx512; on arm64 plain or "
              "neon. With plain, results have the same bits on every machine");
  manual_end(
      out,
      "0 if all went well; 1 if some rows or shots are in error, or a picture could not be drawn, "
      "and all others were computed; 2 for bad usage or unreadable input, with nothing written",
      p->example);
}

/* What could not be written was not said, so the run was not good. */
static int finish(int code) {
  if (code == EXIT_USAGE || (fflush(stdout) == 0 && !ferror(stdout)))
    return code;
  complain("cannot write standard output");
  return EXIT_USAGE;
}

/* The library ignores what it does not know, as it cannot speak; a command can. */
static bool isa_is_known(void) {
  const char *request = getenv("CAROM_ISA"), *name;
  char names[100] = "";
  if (request == NULL || request[0] == '\0')
    return true;
  for (int isa = 0; (name = carom_word(CAROM_WORDS_ISA, isa)) != NULL; isa++) {
    if (same_text(request, name))
      return true;
    append(names, sizeof names, ", ", "%s", name);
  }
  complain("CAROM_ISA '%.40s': no such instruction set; try %s", request, names);
  return false;
}

/* Where standard input, output or error are closed, something stands in their places on which
 * every reading and writing fails: else the next file opened would take the number, and be what
 * the program and gnuplot write to. */
static void hold_standard_places(void) {
  for (int place = STDIN_FILENO; place <= STDERR_FILENO; place++)
    if (fcntl(place, F_GETFD) < 0 &&
        open("/dev/null", place == STDIN_FILENO ? O_WRONLY : O_RDONLY) != place)
      exit(EXIT_USAGE);
}

/* An option of the program itself, which stands alone: --help, --version and the like. Returns
 * whether `name` is one, which then is done. */
static bool run_option(const program *p, const char *name) {
  if (same_text(name, "--help") || same_text(name, "-h") || same_text(name, "help"))
    print_help(stdout, p);
  else if (same_text(name, "--complete")) /* for the shells: completion.* */
    for (size_t k = 0; k < p->count; k++)
      puts(p->commands[k].name);
  else if (same_text(name, "--manual")) /* for manual.cmake */
    print_manual(stdout, p);
  else if (same_text(name, "--version"))
    printf("%s %s\n", p->name, carom_version());
  else
    return false;
  return true;
}

static const command *find_command(const program *p, const char *name) {
  for (size_t k = 0; k < p->count; k++)
    if (same_text(name, p->commands[k].name))
      return &p->commands[k];
  return NULL;
}

static void complain_unknown(const program *p, const char *name) {
  char words[256] = "--help|--version", hint[HINT_TEXT];
  if (p->cites != NULL)
    strcat(words, "|--cite|--report");
  for (size_t k = 0; k < p->count; k++)
    append(words, sizeof words, "|", "%s", p->commands[k].name);
  if (is_nearly(name, words))
    complain("'%.40s': no such command; try %s (`%s --help` lists them)", name,
             words_to_try(name, words, hint), p->name);
  else
    complain("'%.40s': no such command; try `%s --help`, which lists them", name, p->name);
}

int program_run(const program *p, int argc, char **argv) {
  program_name = p->name;
  hold_standard_places();
  atexit(output_abandon); /* a program that ends early leaves no half-written output */
  if (argc < 2) {
    print_help(stderr, p);
    return EXIT_USAGE;
  }

  /* help COMMAND is COMMAND --help */
  const char *name = argv[1];
  static char help[] = "--help";
  char *for_help[] = {argv[0], argc > 2 ? argv[2] : NULL, help, NULL};
  if (same_text(name, "help") && argc > 2) {
    name = argv[2];
    argc = 3;
    argv = for_help;
  }

  /* options of the program; --cite is also one of the command that cites, as what follows */
  const bool cite = p->cites != NULL && same_text(name, "--cite");
  if (name[0] == '-' && !same_text(name, "--cite") && argc > 2) {
    complain("%s '%.40s': it takes no argument; try %s alone", name, argv[2], name);
    return EXIT_USAGE;
  }
  if (run_option(p, name))
    return finish(EXIT_GOOD);
  if (p->cites != NULL && same_text(name, "--report"))
    return finish(print_report(p->name));
  if (cite)
    name = p->cites;
  if (!isa_is_known())
    return EXIT_USAGE;

  const command *found = find_command(p, name);
  if (found == NULL) {
    complain_unknown(p, name);
    return EXIT_USAGE;
  }
  return finish(found->run(argc - !cite, argv + !cite));
}
