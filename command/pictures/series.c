/* Impacts from words. */
#include "pictures/series.h"

#include "pictures/contact_picture.h"
#include "pictures/picture.h"
#include "program/program.h"
#include "rows/doubts.h"
#include "rows/number.h"
#include "rows/quantities.h"
#include "rows/sink.h"

#include <limits.h>

enum { MOST_COMBINED = 1000000 }; /* of a table */

static int inputs_of(const series *s) {
  int count = 0;
  while (s->scene->inputs[count] != NULL)
    count++;
  return count;
}

/* The input that is a range; -1 if there is none. */
static int range_of(const series *s) {
  int range = -1;
  for (int k = 0; k < inputs_of(s); k++)
    if (s->in[k].range)
      range = k;
  return range;
}

/* How many combinations there are, or INT_MAX. */
static int count_of(const series *s) {
  double count = 1.0;
  for (int k = 0; k < inputs_of(s); k++)
    count *= s->in[k].count;
  return (int)fmin(count, INT_MAX);
}

/* Whether a curve's footer tells it as another input, or as the law. */
static bool is_tacit(const series *s, int k) {
  return isnan(s->in[k].item[0].x) || k == s->scene->model;
}

/* Combination number `index`: a range changes fastest, then the last of the lists. */
static void make_case(const series *s, int index, one_case *c) {
  const int range = range_of(s), inputs = inputs_of(s);
  *c = (one_case){.shared = s->shared};
  for (int k = inputs; k >= 0; k--) {
    const int input = k == inputs ? range : k;
    if (input < 0 || c->inputs[input] != NULL)
      continue;
    c->inputs[input] = &s->in[input].item[index % s->in[input].count];
    index /= s->in[input].count;
  }
  /* The first value, and those of lists. */
  for (int k = 0; k < inputs; k++)
    if (k == 0 || s->in[k].count > 1)
      append(c->id, sizeof c->id, "-", "%s", c->inputs[k]->name);
  for (char *blank = c->id; (blank = strchr(blank, ' ')) != NULL;)
    memmove(blank, blank + 1, strlen(blank));
  s->scene->make(s, c);
}

static carom_status resolve_case(const series *s, int index, one_case *c) {
  int8_t status;
  make_case(s, index, c);
  s->scene->kind->solve(&c->shared, false, c->row, 1, c->result, &status);
  return (carom_status)status;
}

/* Whether all can be resolved; else a complaint. */
static bool check_all(const series *s, int count) {
  const row_kind *kind = s->scene->kind;
  doubts found = {0}, tips = {0};
  bool strange = false;
  one_case c;
  for (int k = 0; k < count; k++) {
    int field = -1;
    const carom_status status = resolve_case(s, k, &c);
    if (status != CAROM_OK) {
      kind->check(c.row, &c.shared, &field);
      char where[40] = "";
      if (field >= 0)
        snprintf(where, sizeof where, "%s: ", kind->columns[field].name);
      complain("no such %s (%s): %s%s (%s)", kind->noun, c.id, where, carom_status_string(status),
               carom_status_name(status));
      return false;
    }
    const double tip = tip_offset(c.inputs, inputs_of(s), c.row[kind->radius]);
    if (tip > 1.0) {
      complain("no such %s (%s): the tip is %.4g R from the centre, beside the ball", kind->noun,
               c.id, tip);
      return false;
    }
    strange |= doubts_about(&found, kind, c.row) != NULL;
    strange |= doubts_about_tip(&tips, tip) != NULL;
  }
  for (int k = 0; k < inputs_of(s); k++)
    strange |= s->in[k].comma;
  doubts_report(&found, kind->noun, "the values given");
  doubts_report(&tips, kind->noun, "the values given");
  return !(s->shared.strict && strange);
}

/* ---- Velocities and spins in words */

const char *velocity_text(const double v[2], double scale, char text[64]) {
  const double speed = plane_size(v), angle = angle_between((const double[]){1.0, 0.0}, v);
  if (speed < 1e-9 * scale)
    snprintf(text, 64, "at rest");
  else {
    const int size = snprintf(text, 64, speed < 1e6 ? "%.3f m/s, " : "%.4g m/s, ", speed);
    if (fabs(angle) < 0.005 || fabs(angle) > 179.995)
      snprintf(text + size, (size_t)(64 - size), "straight %s", fabs(angle) < 90.0 ? "on" : "back");
    else
      snprintf(text + size, (size_t)(64 - size), "%.2f degrees to the %s", fabs(angle),
               left_or_right(angle));
  }
  return text;
}

/* Spins below this are none in words, rad/s. */
static const double least_told = 0.005;

const char *english_text(double w_z, char text[64]) {
  snprintf(text, 64, "no english");
  if (fabs(w_z) >= least_told)
    snprintf(text, 64, "%.4g rad/s of %s english", fabs(w_z), left_or_right(-w_z));
  return text;
}

void tell_spin(FILE *out, const double v[2], const double w[3]) {
  const double level = plane_size(w);
  char side[64], roll[64] = "no follow or draw";

  /* a ball that rolls along v turns about (-v_y, v_x) */
  const double forward = v[0] * w[1] - v[1] * w[0];
  if (level >= least_told)
    snprintf(roll, sizeof roll, "%.4g rad/s of %s", level, forward < 0.0 ? "draw" : "follow");
  fprintf(out, "              spin after:  %s, %s\n", english_text(w[2], side), roll);
}

/* ---- Tables */

static void write_rows(FILE *out, const series *s, int count) {
  one_case c;
  write_row_header(out, s->scene->kind);
  for (int k = 0; k < count; k++) {
    make_case(s, k, &c);
    write_row(out, s->scene->kind, c.id, c.row);
  }
}

/* The word of a quantity; returns whether there is one. */
static bool quantity_word(const series *s, int quantity, char word[32]) {
  const char *place = s->scene->quantities;
  for (int k = 0; k < quantity && place != NULL; k++)
    place = strchr(place, '|') != NULL ? strchr(place, '|') + 1 : NULL;
  if (place != NULL)
    snprintf(word, 32, "%.*s", (int)strcspn(place, "|"), place);
  return place != NULL;
}

/* The quantities of which a text, or what stands behind its last hyphen, is a part between hyphens,
 * such as "distance" or "roll-distance", as a set. */
static uint32_t quantities_with(const char *words, const char *text) {
  const char *hyphen = strrchr(text, '-');
  if (hyphen != NULL)
    text = hyphen + 1;
  const size_t size = strlen(text);
  uint32_t set = 0;
  for (int place = 0; *words != '\0'; place++) {
    const size_t length = strcspn(words, "|");
    for (size_t start = 0, part; start < length; start += part + 1) {
      part = strcspn(words + start, "|-");
      if (same_word(text, size, words + start, part))
        set |= 1U << place;
    }
    words += length + (words[length] != '\0');
  }
  return set;
}

OPTION_SET(set_quantities) {
  uint32_t *asked_for = field;
  char *rest = NULL;
  int place;
  *asked_for = 0;
  for (char *word = strtok_r(text, ",", &rest); word != NULL; word = strtok_r(NULL, ",", &rest)) {
    const uint32_t parts = quantities_with(row->argument, word);
    const bool whole = word_among(row->argument, word, strlen(word)) >= 0;
    if (!whole && parts != 0) {
      *asked_for |= parts;
      continue;
    }
    if (!set_place(row, word, row->argument, &place))
      return false;
    *asked_for |= 1U << place;
  }
  return *asked_for != 0 || set_place(row, "", row->argument, &place);
}

/* The next quantity of a table from `q` on, with its word: those asked for, or all; false: there is
 * none. */
static bool next_quantity(const series *s, int *q, char word[32]) {
  for (; quantity_word(s, *q, word); ++*q)
    if (s->asked_for == 0 || (s->asked_for >> *q & 1) != 0)
      return true;
  return false;
}

/* The quantity of curves: the first of those asked for. */
static int quantity_of_curves(const series *s) {
  int first = 0;
  while (s->asked_for != 0 && (s->asked_for >> first & 1) == 0)
    first++;
  return first;
}

/* " (degrees)" of a quantity, which ends its words. */
static const char *unit_of(const series *s, int quantity) {
  const char *unit = strrchr(s->scene->quantity[quantity], '(');
  return unit != NULL ? unit - 1 : "";
}

/* The values that are several, as they were given, and the quantities: for readers with units and
 * six digits, with --csv for programs. */
static void write_table(FILE *out, const series *s, int count) {
  char word[32];
  one_case c;
  for (int k = 0; k < inputs_of(s); k++)
    if (s->in[k].count > 1)
      fprintf(out, s->in[k].unit[0] != '\0' ? "%s (%s)," : "%s%s,", s->scene->inputs[k],
              s->in[k].unit);
  const char *separator = "";
  for (int q = 0; next_quantity(s, &q, word); q++) {
    fprintf(out, "%s%s%s", separator, word, text_if(!s->csv, unit_of(s, q)));
    separator = ",";
  }
  fputc('\n', out);
  for (int k = 0; k < count; k++) {
    char text[NUMBER_TEXT];
    resolve_case(s, k, &c);
    for (int input = 0; input < inputs_of(s); input++)
      if (s->in[input].count > 1) {
        const value *v = c.inputs[input];
        fprintf(out, "%s,", isnan(v->number) ? v->name : number_text(v->number, text));
      }
    separator = "";
    for (int q = 0; next_quantity(s, &q, word); q++) {
      const double x = s->scene->measure(s, &c, q) + 0.0;
      if (s->csv)
        number_text(x, text);
      else
        snprintf(text, sizeof text, "%.6g", x);
      fprintf(out, "%s%s", separator, text);
      separator = ",";
    }
    fputc('\n', out);
  }
}

static void write_words(FILE *out, const series *s, int count) {
  one_case c;
  for (int k = 0; k < count; k++) {
    resolve_case(s, k, &c);
    fputs(text_if(k > 0, "\n"), out);
    s->scene->tell(out, &c);
  }
}

/* ---- Pictures */

/* The name of the axis of a range: of a cut that is given as a part of the ball, that part. */
static void name_axis(FILE *out, const char *input, const char *unit) {
  if (same_text(unit, part_of_ball))
    fprintf(out, "# x: %s\n", unit);
  else
    fprintf(out, "# x: %s (%s)\n", input, unit);
}

/* The data of figures/curves.gp: a curve for each combination of the lists, over the range. */
static void write_curves(FILE *out, const void *data) {
  const series *s = data;
  const int range = range_of(s), points = s->in[range].count, curves = count_of(s) / points;
  const int quantity = quantity_of_curves(s);
  char law[80];
  one_case c;
  name_axis(out, s->scene->inputs[range], s->in[range].unit);
  fprintf(out, "# y: %s\n# footer: ", s->scene->quantity[quantity]);
  /* What is the same for all, on lines of a few, and the law. */
  const char *separator = "";
  for (int k = 0, written = 0; k < inputs_of(s); k++)
    if (s->in[k].count == 1 && !is_tacit(s, k)) {
      fprintf(out, "%s%s %s", separator, s->scene->inputs[k], s->in[k].item[0].name);
      written++;
      separator = written % 3 > 0 ? ", " : "\n# footer: ";
    }
  if (s->scene->law(s, law)[0] != '\0')
    fprintf(out, "\n# footer: %s", law);
  putc('\n', out);
  for (int curve = 0; curve < curves; curve++) {
    make_case(s, curve * points, &c);
    fprintf(out, "# curve %d: ", curve + 1);
    separator = "";
    for (int k = 0; k < inputs_of(s); k++)
      if (k != range && s->in[k].count > 1) {
        fputs(separator, out);
        if (!isnan(c.inputs[k]->number))
          fprintf(out, "%s ", s->scene->inputs[k]);
        fputs(c.inputs[k]->name, out);
        separator = ", ";
      }
    fputc('\n', out);
  }
  fputs("curve,x,y\n", out);
  for (int k = 0; k < curves * points; k++) {
    resolve_case(s, k, &c);
    fprintf(out, "%d,%.9g,%.9g\n", k / points + 1, c.inputs[range]->number,
            s->scene->measure(s, &c, quantity));
  }
}

/* All of the cases, below each other. */
static void write_pictures(FILE *out, const void *data) {
  const series *s = data;
  char *body, *words;
  size_t body_size, words_size;
  double top = 0.0;
  FILE *part = open_text(&body, &body_size);
  for (int k = 0; k < count_of(s); k++) {
    one_case c;
    FILE *stream = open_text(&words, &words_size);
    resolve_case(s, k, &c);
    s->scene->tell(stream, &c);
    close_text(stream, &words);
    top += s->scene->draw(part, top, &c, words);
    free(words);
  }
  close_text(part, &body);
  svg_begin(out, CONTACT_WIDTH, top, "fill=\"#fff\"");
  fwrite(body, 1, body_size, out);
  fputs("</svg>\n", out);
  free(body);
}

static bool draw(const series *s) {
  if (range_of(s) < 0)
    return svg_draw(s->picture, write_pictures, s);
  return picture_draw(s->picture, "curves", "", write_curves, s);
}

/* ---- */

/* Whether rows, where they are asked for, say all; false after a complaint. */
static bool rows_have_all(const series *s) {
  const bool rows = s->csv && s->asked_for == 0;
  if (rows && s->shared.models != 0)
    complain("--csv writes rows, which have no model: give --model to `carom resolve --cushion`, "
             "or --quantity here");
  else if (rows && s->shared.options.solver != CAROM_SOLVER_EXACT)
    complain("--csv writes rows, which have no solver: give --solver to `carom resolve`, or "
             "--quantity here");
  else
    return true;
  return false;
}

/* What is asked for and cannot be; false after a complaint. */
static bool is_possible(const series *s, int count) {
  int ranges = 0;
  for (int k = 0; k < inputs_of(s); k++)
    ranges += s->in[k].range;
  if (ranges > 1)
    complain("one number can be a range, and the others lists, with commas");
  else if (ranges == 0 && count > MOST_CASES)
    complain(
        "%d combinations are too many: at most %d, or a range of one number, such as --speed 1:5",
        count, MOST_CASES);
  else if (count > MOST_COMBINED)
    complain("%d combinations are too many: at most %d", count, MOST_COMBINED);
  else if (ranges > 0 && s->picture != NULL && count / s->in[range_of(s)].count > MOST_CASES)
    complain("%d curves are too many to draw: at most %d", count / s->in[range_of(s)].count,
             MOST_CASES);
  else if (ranges == 0 && s->asked_for != 0 && !s->csv && s->picture != NULL)
    complain("--quantity is for curves and tables: give a range, such as --speed 1:5");
  else if (s->picture != NULL && (s->asked_for & (s->asked_for - 1)) != 0)
    complain("curves show one --quantity; a table has several");
  else
    return rows_have_all(s);
  return false;
}

static bool is_below_90(double angle) {
  return fabs(angle) < 90.0;
}
static bool is_above_0(double speed) {
  return speed > 0.0;
}

/* Takes those values out of a list that are out of range, with a complaint; returns whether any is
 * left, and notes in `*some` that some are not. */
static bool take_out(values *list, bool (*is_right)(double), const char *complaint, bool *some) {
  const int total = list->count;
  double first = 0.0;
  list->count = 0;
  for (int k = 0; k < total; k++)
    if (is_right(list->item[k].x))
      list->item[list->count++] = list->item[k];
    else if (list->count == k)
      first = list->item[k].number;
  const int out = total - list->count;
  if (out == 1)
    complain("%s; %g is left out", complaint, first);
  else if (out > 1)
    complain("%s; %d values are left out, from %g on", complaint, out, first);
  *some |= out > 0;
  return list->count > 0;
}

/* Writes the words, the table or the rows; false after a complaint. */
static bool write_all(const series *s, int count) {
  const bool curves = range_of(s) >= 0, quantity = s->asked_for != 0;
  FILE *out = output_open(s->shared.output != NULL ? s->shared.output : "-");
  if (out == NULL)
    return false;
  if (s->csv && !quantity)
    write_rows(out, s, count);
  else if (curves || quantity)
    write_table(out, s, count);
  else
    write_words(out, s, count);
  return output_commit();
}

int series_command(series *s, const command_form *form, int argc, char **argv, int angle,
                   const char *complaint) {
  for (int k = 0; k < inputs_of(s); k++)
    if (s->in[k].count == 0)
      s->in[k] = (values){.count = 1, .unit = "", .item = {{.x = NAN, .number = NAN}}};
  const int code = parse_arguments(form, argc, argv, s, NULL);
  bool left_out = false;
  if (code >= 0)
    return code;
  if (!take_out(&s->in[angle], is_below_90, complaint, &left_out) ||
      !take_out(&s->in[SPEED_INPUT], is_above_0, "--speed is above 0", &left_out))
    return EXIT_USAGE;
  const int count = count_of(s);
  if (s->scene->check != NULL && !s->scene->check(s))
    return EXIT_USAGE;
  if (!is_possible(s, count) || !output_possible(s->picture) || !check_all(s, count))
    return EXIT_USAGE;
  /* With a picture of curves the table is only written where it is asked for. */
  const bool writes = range_of(s) < 0 || s->picture == NULL || s->csv || s->shared.output != NULL;
  if (writes && !write_all(s, count))
    return EXIT_USAGE;
  if (s->picture != NULL && !draw(s))
    return EXIT_USAGE;
  return left_out ? EXIT_SOME : EXIT_GOOD;
}
