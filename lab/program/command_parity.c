/* `carom-lab parity`: shots that pooltool recorded, beside carom.
 *
 * A shot is played anew by pooltool's rules and models. It agrees if its first events, up
 * to where pooltool's own histories part when the start is moved by 1e-13, have the same types
 * and balls in the same order, and times and states are within 1e-12 + 5e-13 times the recorded
 * amplification. */
#include "program/program.h"
#include "shots/shot_file.h"
#include "subcommands.h"

/* One row of the table: a family of shots. */
typedef struct row {
  char *name;
  size_t shots, events, agreed, whole;
  double time, state; /* largest differences over the allowed */
} row;

typedef struct parity_job {
  shared_options shared;
  bool every_difference; /* every difference is told */
  row *each;
  size_t count, room;
} parity_job;

OPTION(parity_job, option_verbose, "verbose", every_difference, 'v', NULL, set_flag, 0,
       "print the first difference of each shot that disagrees");

/* ---- The record */

static int type_of(const char *name) {
  for (int type = CAROM_EVENT_STRIKE; type <= CAROM_EVENT_LEFT_TABLE; type++)
    if (name != NULL && same_text(name, shot_event_name(type)))
      return type;
  return 0;
}

static int ball_of(const shot_line *line, const json_t *id) {
  for (int i = 0; i < line->count; i++)
    if (json_is_string(id) && same_text(json_string_value(id), line->name[i]))
      return i;
  return -1;
}

static bool read_state(const json_t *v, carom_ball_state *s) {
  double *const parts[] = {s->r, s->v, s->w};
  for (size_t k = 0; k < 9; k++) {
    const json_t *number = json_array_get(v, k + 1);
    if (!json_is_number(number))
      return false;
    parts[k / 3][k % 3] = json_number_value(number);
  }
  s->label = (int64_t)json_number_value(json_array_get(v, 0));
  return true;
}

/* How many balls an event changes. */
static size_t sides_of(const carom_event *e) {
  return 1 + (e->type == CAROM_EVENT_BALL_BALL);
}

/* A recorded event as one of carom, but for the index of what a ball met. */
static bool read_event(const shot_line *line, const json_t *json, carom_event *e) {
  *e = (carom_event){.time = json_number_value(json_array_get(json, 0)),
                     .type = type_of(json_string_value(json_array_get(json, 1)))};
  const json_t *ids = json_array_get(json, 2);
  const size_t sides = sides_of(e);
  e->a = ball_of(line, json_array_get(ids, e->type == CAROM_EVENT_STRIKE)); /* behind the cue */
  e->b = -1;
  if (sides == 2)
    e->b = ball_of(line, json_array_get(ids, 1));
  for (size_t k = 0; k < sides; k++)
    if (!read_state(json_array_get(json_array_get(json, 3), k), &e->before[k]) ||
        !read_state(json_array_get(json_array_get(json, 4), k), &e->after[k]))
      return false;
  return e->type != 0 && e->a >= 0 && (sides == 1 || e->b >= 0);
}

/* ---- Shots, played again */

static row *family_of(parity_job *job, const char *name) {
  for (size_t k = 0; k < job->count; k++)
    if (same_text(job->each[k].name, name))
      return &job->each[k];
  job->each = grow(job->each, &job->room, job->count + 1, sizeof *job->each);
  row *f = &job->each[job->count++];
  *f = (row){.name = copy_text(name)};
  return f;
}

/* What is allowed where the start moved by 1e-13 moves a number by 1e-13 times so much. */
static double allowed(const json_t *sens, const char *quantity, size_t k) {
  return 1e-12 +
         5e-13 * fmax(json_number_value(json_array_get(json_object_get(sens, quantity), k)), 1.0);
}

/* The largest difference of places, of velocities, and of spins times the radius. */
static double states_apart(const carom_ball_state *a, const carom_ball_state *b, double R) {
  double worst = 0.0;
  for (int k = 0; k < 3; k++)
    worst = fmax(fmax(worst, fabs(a->r[k] - b->r[k])),
                 fmax(fabs(a->v[k] - b->v[k]), R * fabs(a->w[k] - b->w[k])));
  return worst;
}

/* Whether an event of carom is that of the record: type, balls, and the part of the table. */
static bool same_event(const shot_line *line, const carom_event *played, const carom_event *e,
                       const json_t *json) {
  if (played->type != e->type || played->a != e->a ||
      (e->type == CAROM_EVENT_BALL_BALL && played->b != e->b))
    return false;
  if (e->type < CAROM_EVENT_RAIL || e->type > CAROM_EVENT_POCKET)
    return true;
  const char *part = shot_part_name(line->table, played),
             *id = json_string_value(json_array_get(json_array_get(json, 2), 1));
  return part != NULL && id != NULL && same_text(part, id);
}

/* Compares the events of a shot; false where they disagree, told in `why`. The record begins and
 * ends with an event of nothing.
 */
static bool compare(const shot_line *line, const carom_shot *shot, row *f, char why[200]) {
  const json_t *events = json_object_get(line->json, "events"),
               *sens = json_object_get(line->json, "sens");
  const size_t recorded = json_array_size(events);
  const size_t same = (size_t)json_integer_value(json_object_get(sens, "same_events"));
  if (recorded == 0 || sens == NULL)
    return snprintf(why, 200, "it has no recorded events") < 0;
  for (size_t k = 1; k < same && k + 1 < recorded; k++) {
    const json_t *json = json_array_get(events, k);
    const carom_event *played = &shot->events[k - 1];
    carom_event e;
    if ((int64_t)k > shot->count)
      return snprintf(why, 200, "event %zu of %zu: there is none", k, recorded) < 0;
    if (!read_event(line, json, &e) || !same_event(line, played, &e, json))
      return snprintf(why, 200, "event %zu of %zu: %s at %.17g, not %s at %.17g", k, recorded,
                      shot_event_name(played->type), played->time,
                      json_string_value(json_array_get(json, 1)), e.time) < 0;
    const double dt = fabs(played->time - e.time) / allowed(sens, "t", k);
    double worst = 0.0; /* of the states after the event, whose amplification is recorded */
    for (size_t side = 0; side < sides_of(&e); side++) {
      worst = fmax(worst, states_apart(&played->after[side], &e.after[side], 0.03));
      if (played->after[side].label != e.after[side].label)
        worst = INFINITY;
    }
    worst /= allowed(sens, "state", k);
    f->time = fmax(f->time, dt);
    f->state = fmax(f->state, worst);
    f->events++;
    if (!(dt <= 1.0 && worst <= 1.0))
      return snprintf(why, 200, "event %zu of %zu, %s: time %.2g and state %.2g times the allowed",
                      k, recorded, shot_event_name(e.type), dt, worst) < 0;
  }
  if (same >= recorded && (size_t)shot->count + 2 != recorded)
    return snprintf(why, 200, "%lld events, not %zu", (long long)shot->count + 2, recorded) < 0;
  f->whole += same >= recorded;
  return true;
}

/* Plays a shot by what the recording was made with. */
static void play_again(parity_job *job, const shot_line *line, const char *engine) {
  const char *name = json_string_value(json_object_get(line->json, "family"));
  carom_shot_options options = {.world = CAROM_WORLD_POOLTOOL};
  if (engine[0] != 0 && !same_text(engine, "default"))
    options.ball_model = CAROM_BALL_MODEL_EULER;
  if (same_text(engine, "mathavan_all"))
    options.cushion_model = CAROM_SHOT_CUSHION_EULER;
  row *f = family_of(job, text_or(name, "-"));
  f->shots++;
  char why[200] = "";
  bool good = false;
  if (line->error == NULL) {
    carom_shot shot = {0};
    const carom_status status = shot_line_play(line, &options, &shot);
    good = compare(line, &shot, f, why);
    if (status < 0 && !good)
      append(why, sizeof why, "; ", "%s", carom_status_name(status));
    free(shot.events);
  }
  f->agreed += good;
  if (!good && job->every_difference)
    complain("line %zu: shot %s: %s", line->number, text_or(line->id, "-"),
             text_or(line->error, why));
}

/* ---- The table */

static void print_row(const row *f) {
  printf("%-16s %5zu %7zu %6zu %6zu %10.2g %10.2g\n", f->name, f->shots, f->events, f->agreed,
         f->whole, f->time, f->state);
}

static bool print_families(const parity_job *job) {
  row total = {.name = "all"};
  printf("%-16s %5s %7s %6s %6s %10s %10s\n", "family", "shots", "events", "agreed", "whole",
         "time", "state");
  for (const row *f = job->each; f < job->each + job->count; f++) {
    print_row(f);
    total.shots += f->shots;
    total.events += f->events;
    total.agreed += f->agreed;
    total.whole += f->whole;
    total.time = fmax(total.time, f->time);
    total.state = fmax(total.state, f->state);
    free(f->name);
  }
  print_row(&total);
  return total.agreed == total.shots;
}

static const command_form form = {
    .name = "parity",
    .usage = "[OPTIONS] IN.jsonl",
    .about = "Plays recorded shots with pooltool's rules and models, and compares every event with "
             "pooltool's record. The recording says which event is the first that rounding errors "
             "can change; the comparison ends there.\n",
    .options = (const option_row *const[]){&option_verbose, NULL},
    .details =
        "columns: shots; events compared; shots that agree; shots that agree to their end, where "
        "the recording has no chaos; largest difference of times, and of states, over the allowed "
        "1e-12 + 5e-13 times the amplification\n\n"
        "exit code: 0 if all agree, 1 if one does not, 2 for bad usage or unreadable input\n",
    .example = "carom-lab parity data/shots-pooltool.jsonl",
    .files = ONE_FILE,
};

int command_parity(int argc, char **argv) {
  parity_job job = {.every_difference = false};
  const char *path;
  const int code = parse_arguments(&form, argc, argv, &job, &path);
  if (code >= 0)
    return code;
  shot_file *file = shot_file_open(path, CAROM_SHOT_CUSHION_DEFAULT, LAYOUT_START);
  if (file == NULL)
    return EXIT_USAGE;
  shot_line line;
  shot_read what;
  while ((what = shot_file_next_shot(file, &line)) == SHOT_SHOT) {
    play_again(&job, &line, shot_file_engine(file));
    shot_line_free(&line);
  }
  shot_file_close(file);
  if (what != SHOT_END || job.count == 0) {
    complain("%s has no shots", path);
    return EXIT_USAGE;
  }
  const bool good = print_families(&job);
  free(job.each);
  return exit_of(good);
}
