/* What options read into their fields, and the rows that several tables have. */
#include "message.h"
#include "number.h"
#include "options.h"
#include "words.h"

#include <errno.h>
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

OPTION_SET(set_flag) {
  (void)row;
  (void)text;
  *(bool *)field = true;
  return true;
}

OPTION_SET(set_text) {
  (void)row;
  *(const char **)field = text;
  return true;
}

OPTION_SET(set_count) {
  char *end;
  errno = 0;
  const long value = strtol(text, &end, 10);
  if (end == text || *end != '\0' || errno != 0 || value < row->least || value > INT_MAX) {
    complain("--%s is a whole number from %d to %d, not '%s'", row->name, row->least, INT_MAX,
             text);
    return false;
  }
  *(int *)field = (int)value;
  return true;
}

/* 0 stands for all, as in other commands. */
static OPTION_SET(set_threads) {
  int *threads = field;
  if (!set_count(row, text, threads))
    return false;
  if (*threads == 0)
    *threads = CAROM_ALL_THREADS;
  return true;
}

OPTION_SET(set_number) {
  if (parse_number(text, field) && isfinite(*(double *)field))
    return true;
  complain("--%s is a number, not '%s'%s", row->name, text, comma_hint(text));
  return false;
}

OPTION_SET(set_amount) {
  if (parse_number(text, field) && *(double *)field >= 0.0 && isfinite(*(double *)field))
    return true;
  complain("--%s is a number, 0 or more, not '%s'%s", row->name, text, comma_hint(text));
  return false;
}

/* Sets the place of the text among words with bars between them; complains where it is none of
 * them. */
static bool set_place(const option_row *row, const char *text, const char *words, int *place) {
  const int found = place_among(words, text, strlen(text));
  char list[120] = "", hint[HINT_TEXT]; /* "this, that or another" */
  for (const char *at = words; found < 0 && *at != '\0';) {
    const size_t used = strlen(list), size = strcspn(at, "|");
    const bool last = at[size] == '\0';
    snprintf(list + used, sizeof list - used, "%s%.*s",
             at == words ? ""
             : last      ? " or "
                         : ", ",
             (int)size, at);
    at += size + !last;
  }
  if (found >= 0)
    *place = found;
  else
    complain("--%s is %s, not '%s'%s", row->name, list, text, did_you_mean(text, words, hint));
  return found >= 0;
}

OPTION_SET(set_choice) {
  return set_place(row, text, row->argument, field);
}

OPTION_SET(set_ball_model) {
  return set_place(row, text, "default|exact|euler|inelastic|mirror", field);
}

OPTION_SET(set_cushion_model) {
  return set_place(row, text, "default|" CUSHION_WORDS, field);
}

static OPTION_SET(set_solvers) {
  static const solver_list lists[] = {{{CAROM_SOLVER_EXACT}, 1},
                                      {{CAROM_SOLVER_EULER}, 1},
                                      {{CAROM_SOLVER_EXACT, CAROM_SOLVER_EULER}, 2}};
  static const char words[] = "exact|euler|exact,euler";
  char hint[HINT_TEXT];
  const int place = place_among(words, text, strlen(text));
  if (place >= 0)
    *(solver_list *)field = lists[place];
  else
    complain("--%s is exact, euler, or both as exact,euler, not '%s'%s", row->name, text,
             did_you_mean(text, words, hint));
  return place >= 0;
}

static OPTION_SET(set_law) {
  friction_law *law = field;
  static const char name[] = "alciatore";
  const size_t size = sizeof name - 1;
  char rest, hint[HINT_TEXT];
  double mu;
  *law = (friction_law){.given = true, .law = carom_alciatore()};
  if (parse_number(text, &mu) && mu >= 0.0 && mu <= 1.0) {
    law->law = (carom_speed_law){.a = mu};
    return true;
  }
  if (strncmp(text, name, size) == 0 &&
      (text[size] == '\0' ||
       (text[size] == '=' && sscanf(text + size + 1, "%lf,%lf,%lf%c", &law->law.a, &law->law.b,
                                    &law->law.c, &rest) == 3)))
    return true;
  complain("--%s is alciatore, alciatore=a,b,c (mu = a + b exp(-c |u|)) or a number from 0 to 1, "
           "not '%s'%s",
           row->name, text, did_you_mean(strchr(text, '=') == NULL ? text : name, name, hint));
  return false;
}

/* ---- The rows */

_Static_assert(CAROM_SOLVER_EULER == 1 && CAROM_SLIP_POOLTOOL == 1 && CAROM_CUSHION_EULER == 4 &&
                   CAROM_CONVENTION_POOLTOOL == 1 && CAROM_CUSHION_LAW_HAN == 1,
               "the places of the choices are the values");

#define ROW(row, name, member, letter, argument, set, least, only, help)                        \
  const option_row row = {name,  letter, argument, help, set, offsetof(shared_options, member), \
                          least, only}

ROW(option_solver, "solver", options.solver, 0, "exact|euler", set_choice, 0, BALLS_ONLY,
    "exact: the limit of infinitely many steps (default); euler: N steps of equal impulse, as in "
    "the 2014 paper");
ROW(option_solvers, "solver", solvers, 0, "exact|euler|exact,euler", set_solvers, 0, BALLS_ONLY,
    "exact (default), euler, or exact,euler");
ROW(option_slip, "slip", options.slip, 0, "paper|pooltool", set_choice, 0, BALLS_ONLY,
    "sign of the spin in the slip over the cloth: the 2014 paper's (default), or pooltool's");
ROW(option_friction, "friction", friction, 0, "alciatore|LAW", set_law, 0, BALLS_ONLY,
    "friction between the balls, instead of the column u_b: a number; or alciatore, which falls "
    "with the slip speed u as mu = a + b exp(-c |u|); or alciatore=a,b,c, the same with other "
    "constants");
ROW(option_data, "data", folder, 0, "DIR", set_text, 0, BALLS_ONLY,
    "folder of the reference collisions (default: $CAROM_DATA, else what came with carom)");
ROW(option_steps, "steps", options.steps, 0, "N", set_count, 1, ANY_KIND,
    "steps of Euler's method, 1 or more (default 1000)");
ROW(option_threads, "threads", options.threads, 0, "N", set_threads, 0, ANY_KIND,
    "largest number of threads; 0: one for each processor (default)");
ROW(option_precision, "precision", precision, 0, "double|single", set_choice, 0, ANY_KIND,
    "precision of the results, and of the solver for two balls (default: single for a float32 "
    "array, else double)");
ROW(option_id, "id", id, 0, "X", set_text, 0, ANY_KIND,
    "the row with this id; its number, from 1, if there is no column id");
ROW(option_output, "output", output, 'o', "OUT", set_text, 0, ANY_KIND,
    "file to write; - is standard output (default). OUT is never incomplete: carom writes a file "
    "beside it, and renames it at the end. If the folder cannot be written, carom overwrites OUT "
    "at the end");
ROW(option_derived, "derived", derived, 0, NULL, set_flag, 0, ANY_KIND,
    "more columns after the status: angles, rolling velocities, energy");
ROW(option_strict, "strict", strict, 0, NULL, set_flag, 0, ANY_KIND,
    "treat warnings as errors: centres whose distance is not R1 + R2 to 1 %, more than 50 m/s or "
    "2,000 rad/s, a radius above 0.5 m, a mass above 10 kg, a tip more than 0.5 R from the centre, "
    "two values that look like one with a decimal comma");
ROW(option_bare, "no-comments", bare, 0, NULL, set_flag, 0, ANY_KIND,
    "leave out the lines that begin with #");
ROW(option_summary, "summary", summary, 0, NULL, set_flag, 0, ANY_KIND,
    "print counts and the time on standard error at the end");
ROW(option_cushion, "cushion", cushion, 0, NULL, set_flag, 0, ANY_KIND,
    "impacts of a ball on a cushion, instead of collisions of two balls");
ROW(option_model, "model", rail.model, 0, CUSHION_WORDS, set_choice, 0, CUSHION_ONLY,
    "mathavan: the exact limit of Mathavan's model (default, but of `carom rail` han, as in "
    "shots); "
    "stronge, han: closed forms; mirror: the velocity into the cushion is reversed and multiplied "
    "by e; euler: Mathavan's model in N "
    "steps; smooth: a closed form read off recorded impacts");
ROW(option_convention, "convention", rail.convention, 0, "paper|pooltool", set_choice, 0,
    CUSHION_ONLY,
    "the conventions to follow where pooltool differs from the papers (default: paper)");
ROW(option_law, "law", rail.law, 0, "constant|han", set_choice, 0, CUSHION_ONLY,
    "restitution and friction of the cushion: from the columns (default), or by Han's fits over "
    "speed and angle");
ROW(option_least_step, "least-step", rail.least_step, 0, "P", set_amount, 0, CUSHION_ONLY,
    "smallest step of euler, N s (default 0; pooltool: 0.001)");
