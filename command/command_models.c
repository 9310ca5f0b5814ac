/* `carom models`: what there is, by the rows of the library: models, words and numbers. */
#include "program/program.h"
#include "subcommands.h"

/* Enumerations with models or ways to play, and the options that take their words. */
static const struct kind {
  carom_words list;
  const char *what, *option;
} kinds[] = {{CAROM_WORDS_SHOT_CUSHION, "impact on a cushion", "--cushion, --model"},
             {CAROM_WORDS_BALL_FRICTION, "friction between balls", "--friction"},
             {CAROM_WORDS_BALL_MODEL, "collision of two balls", "--ball-model"},
             {CAROM_WORDS_WORLD, "rules of contact", "--world"},
             {CAROM_WORDS_SPACE, "space", "--space"},
             {CAROM_WORDS_SIMULTANEOUS, "several contacts at one instant", "--simultaneous"},
             {CAROM_WORDS_GAME, "game of a file", "params.game"},
             {CAROM_WORDS_CONDITION, "condition of a pool table", "--with of shots"}};
enum { KINDS = COUNT_OF(kinds), NAME_WIDTH = 20 };

/* What has numbers, and the title of its list. */
static const struct list {
  carom_part_kind part;
  const char *title;
} lists[] = {{CAROM_PART_OPTIONS, "options of a shot in programs, and their options here"},
             {CAROM_PART_PLAN_OPTIONS, "options of a plan in programs, and their options here"},
             {CAROM_PART_BALL, "numbers of a ball and its cushions, by their names, for --with, "
                               "and their keys in files"},
             {CAROM_PART_CUE,
              "numbers of a cue, by their names, for --with of shots, and their keys in "
              "files"},
             {CAROM_PART_TABLE, "numbers of a table, and their keys in files"},
             {CAROM_PART_MEASURES, "measures of a table, and their keys for --table"},
             {CAROM_PART_RAIL, "numbers of a rail, and their keys in files"},
             {CAROM_PART_JAW, "numbers of a jaw, and their keys in files"},
             {CAROM_PART_POCKET, "numbers of a pocket, and their keys in files"}};
enum { LISTS = COUNT_OF(lists) };

static void print_number(FILE *out, const carom_number *n) {
  char range[100], reader[160];
  carom_number_range(n, range, sizeof range);
  fprintf(out, "  %-*s %-12s %s; %s", NAME_WIDTH, n->name, n->key, n->text, range);
  if (n->reader == CAROM_READ_BY_CUSHION || n->reader == CAROM_READ_BY_FRICTION)
    fprintf(out, " (%s)", reader_of(n, "cushion", reader));
  putc('\n', out);
}

/* The numbers that the model of these options reads and others do not. */
static void print_numbers_of(FILE *out, carom_reader reader, carom_shot_options options) {
  static const carom_ball_kind any = {0};
  const carom_number *n;
  int count = 0;
  for (int k = 0; (n = carom_number_of(CAROM_PART_BALL, k)) != NULL; k++)
    if (n->reader == reader && carom_number_is_read(n, &any, &options)) {
      if (count++ == 0)
        fputs("numbers of its own, by their names, for --with, and their keys in files:\n", out);
      print_number(out, n);
    }
  if (count == 0)
    fputs("it has no numbers of its own\n", out);
}

static void print_all(FILE *out) {
  const carom_number *n;
  const char *word;
  for (int k = 0; k < KINDS; k++) {
    fprintf(out, "%s (%s):\n", kinds[k].what, kinds[k].option);
    for (int value = 0; (word = carom_word(kinds[k].list, value)) != NULL; value++)
      fprintf(out, "  %-*s %s\n", NAME_WIDTH, word, carom_word_text(kinds[k].list, value));
  }
  for (int list = 0; list < LISTS; list++) {
    fprintf(out, "%s:\n", lists[list].title);
    for (int k = 0; (n = carom_number_of(lists[list].part, k)) != NULL; k++)
      print_number(out, n);
  }
}

/* Prints all that has this name; whether there is something. */
static bool print_named(FILE *out, const char *name) {
  const carom_number *n;
  const char *word;
  bool found = false;
  for (int k = 0; k < KINDS; k++)
    for (int value = 0; (word = carom_word(kinds[k].list, value)) != NULL; value++) {
      if (!same_text(word, name))
        continue;
      found = true;
      fprintf(out, "%s: %s (%s): %s\n", word, kinds[k].what, kinds[k].option,
              carom_word_text(kinds[k].list, value));
      if (kinds[k].list == CAROM_WORDS_SHOT_CUSHION && value > 0)
        print_numbers_of(out, CAROM_READ_BY_CUSHION,
                         (carom_shot_options){.cushion_model = (carom_shot_cushion)value});
      if (kinds[k].list == CAROM_WORDS_BALL_FRICTION)
        print_numbers_of(out, CAROM_READ_BY_FRICTION,
                         (carom_shot_options){.friction = (carom_ball_friction)value});
    }
  for (int list = 0; list < LISTS; list++)
    for (int k = 0; (n = carom_number_of(lists[list].part, k)) != NULL; k++)
      if (same_text(n->name, name) || same_text(n->key, name)) {
        found = true;
        print_number(out, n);
      }
  return found;
}

/* What the name may have been. */
static void hint_at_name(const char *name) {
  char known[3000] = "", hint[HINT_TEXT];
  const carom_number *n;
  const char *word;
  for (int k = 0; k < KINDS; k++)
    for (int value = 0; (word = carom_word(kinds[k].list, value)) != NULL; value++)
      append(known, sizeof known, "|", "%s", word);
  for (int list = 0; list < LISTS; list++)
    for (int k = 0; (n = carom_number_of(lists[list].part, k)) != NULL; k++)
      append(known, sizeof known, "|", "%s|%s", n->name, n->key);
  complain("'%.40s': no such model or parameter%s", name, did_you_mean(name, known, hint));
}

static const command_form form = {
    .name = "models",
    .usage = "[OPTIONS] [NAME]",
    .about = "Lists the models, the options of shots, and the parameters of balls, cushions, cues "
             "and tables with ranges and units. With NAME, describes this model with its own "
             "parameters, or this parameter with its range and the model that reads it.\n",
    .options = (const option_row *const[]){&option_output, NULL},
    .details = "exit code: 0; 2 for bad usage or an unknown name\n",
    .example = "carom models smooth",
    .files = FILE_OR_NONE,
};

int command_models(int argc, char **argv) {
  shared_options job = {0};
  const char *name;
  const int code = parse_arguments(&form, argc, argv, &job, &name);
  if (code >= 0)
    return code;
  FILE *out = output_open(job.output);
  if (out == NULL)
    return EXIT_USAGE;
  if (name == NULL)
    print_all(out);
  else if (!print_named(out, name)) {
    output_abandon();
    hint_at_name(name);
    return usage_hint(&form);
  }
  return output_commit() ? EXIT_GOOD : EXIT_USAGE;
}
