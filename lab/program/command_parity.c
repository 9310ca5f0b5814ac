/* `carom-lab parity`: whole shots beside the histories that pooltool recorded.
 *
 * Shots recorded in space (engine "space") are compared event by event: parity_space.c. Another shot agrees if its first
 * events, up to where pooltool's own histories part when the start is moved by 1e-13, have the same types and balls in the same
 * order, and times and states are within 1e-12 + 5e-13 times the recorded amplification. */
#include "command.h"
#include "memory.h"
#include "message.h"
#include "options.h"
#include "parity_space.h"
#include "recorded.h"
#include "shot_file.h"
#include "subcommands.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct parity_job {
  shared_options shared;
  bool all; /* every shot that disagrees is told */
} parity_job;

OPTION(parity_job, option_verbose, "verbose", all, 'v', NULL, set_flag, 0,
       "print the first difference of each shot that disagrees");

typedef struct family {
  char *name;
  size_t shots, events, agreed, whole;
  double time, state; /* largest differences over the allowed */
} family;

typedef struct families {
  family *each;
  size_t count, room;
} families;

static family *family_of(families *all, const char *name) {
  for (size_t k = 0; k < all->count; k++)
    if (strcmp(all->each[k].name, name) == 0)
      return &all->each[k];
  all->each = grow(all->each, &all->room, all->count + 1, sizeof *all->each);
  family *f = &all->each[all->count++];
  *f = (family){.name = strcpy(allocate(strlen(name) + 1, 1), name)};
  return f;
}

/* What is allowed where the start moved by 1e-13 moves a number by 1e-13 times so much. */
static double allowed(double amplification) {
  return 1e-12 + 5e-13 * fmax(amplification, 1.0);
}

/* The largest difference of two states: x, v and 0.03 w. */
static double state_distance(const carom_ball_state *s, const json_t *recorded) {
  double worst = s->label == (int64_t)json_number_value(json_array_get(recorded, 0)) ? 0.0 : INFINITY;
  for (size_t k = 0; k < 9; k++) {
    const double *part = k < 3 ? s->r : k < 6 ? s->v : s->w;
    const double difference = fabs(part[k % 3] - json_number_value(json_array_get(recorded, k + 1)));
    worst = fmax(worst, k < 6 ? difference : 0.03 * difference);
  }
  return worst;
}

static bool same_event(const shot_line *line, const carom_event *e, const json_t *recorded) {
  const json_t *ids = json_array_get(recorded, 2);
  const size_t first = e->type == CAROM_EVENT_STRIKE ? 1 : 0;
  const bool pair = e->type == CAROM_EVENT_BALL_BALL;
  const char *other = pair                                                           ? line->name[e->b]
                      : e->type >= CAROM_EVENT_RAIL && e->type <= CAROM_EVENT_POCKET ? shot_part_name(line->table, e)
                                                                                     : NULL;
  const char *type = json_string_value(json_array_get(recorded, 1)), *id = json_string_value(json_array_get(ids, first));
  const char *other_id = json_string_value(json_array_get(ids, first + 1));
  return type != NULL && id != NULL && strcmp(type, shot_event_name(e->type)) == 0 && strcmp(id, line->name[e->a]) == 0 &&
         (other == NULL ? other_id == NULL : other_id != NULL && strcmp(other, other_id) == 0);
}

/* Compares the events of a shot; false where they disagree, told in `why`. */
static bool compare(const shot_line *line, const carom_shot *shot, family *f, char why[200]) {
  const json_t *events = json_object_get(line->json, "events"), *sens = json_object_get(line->json, "sens");
  const size_t recorded = json_array_size(events);
  const size_t same = (size_t)json_integer_value(json_object_get(sens, "same_events"));
  /* the recorded list begins and ends with an event of nothing */
  const size_t needed = same < recorded ? same : recorded - 1;
  for (size_t k = 1; k < needed; k++) {
    const json_t *r = json_array_get(events, k);
    if ((int64_t)k > shot->count) {
      snprintf(why, 200, "event %zu of %zu: there is none", k, recorded);
      return false;
    }
    const carom_event *e = &shot->events[k - 1];
    if (!same_event(line, e, r)) {
      snprintf(why, 200, "event %zu of %zu: %s at %.17g, not %s at %.17g", k, recorded, shot_event_name(e->type), e->time,
               json_string_value(json_array_get(r, 1)), json_number_value(json_array_get(r, 0)));
      return false;
    }
    const double dt = fabs(e->time - json_number_value(json_array_get(r, 0))) /
                      allowed(json_number_value(json_array_get(json_object_get(sens, "t"), k)));
    double worst = 0.0; /* of the states after the event, whose amplification is recorded */
    for (int side = 0; side < (e->type == CAROM_EVENT_BALL_BALL ? 2 : 1); side++)
      worst = fmax(worst, state_distance(&e->after[side], json_array_get(json_array_get(r, 4), (size_t)side)));
    worst /= allowed(json_number_value(json_array_get(json_object_get(sens, "state"), k)));
    f->time = fmax(f->time, dt);
    f->state = fmax(f->state, worst);
    f->events++;
    if (!(dt <= 1.0 && worst <= 1.0)) {
      snprintf(why, 200, "event %zu of %zu, %s: time %.2g and state %.2g times the allowed", k, recorded,
               shot_event_name(e->type), dt, worst);
      return false;
    }
  }
  if (same >= recorded && (size_t)shot->count + 2 != recorded) {
    snprintf(why, 200, "%lld events, not %zu", (long long)shot->count + 2, recorded);
    return false;
  }
  f->whole += same >= recorded;
  return true;
}

/* What the recording was made with. */
static carom_shot_options options_of(const char *engine) {
  carom_shot_options options = {.world = CAROM_WORLD_POOLTOOL};
  if (engine[0] != 0 && strcmp(engine, "default") != 0)
    options.ball_model = CAROM_BALL_MODEL_EULER;
  if (strcmp(engine, "mathavan_all") == 0)
    options.cushion_model = CAROM_SHOT_CUSHION_EULER;
  return options;
}

static void report(const family *f) {
  printf("%-16s %5zu %7zu %6zu %6zu %10.2g %10.2g\n", f->name, f->shots, f->events, f->agreed, f->whole, f->time, f->state);
}

/* -1 where the file cannot be read. */
static int compare_all(const parity_job *job, shot_file *file, families *all, space_parity *space) {
  shot_line line;
  const char *text;
  shot_read what;
  carom_shot_options options = options_of(shot_file_engine(file));
  while ((what = shot_file_next(file, &line, &text)) == SHOT_SHOT || what == SHOT_TABLE) {
    if (what == SHOT_TABLE)
      continue;
    if (strcmp(shot_file_engine(file), "space") == 0) {
      char why[200] = "";
      if (line.error != NULL || !space_compare(&line, space, why)) {
        complain("line %zu: shot %s: %s", line.number, line.id != NULL ? line.id : "-", line.error != NULL ? line.error : why);
        space->bad++;
      }
      shot_line_free(&line);
      continue;
    }
    options = options_of(shot_file_engine(file));
    const char *name = json_string_value(json_object_get(line.json, "family"));
    family *f = family_of(all, name != NULL ? name : "-");
    f->shots++;
    char why[200] = "";
    bool good = false;
    if (line.error != NULL) {
      snprintf(why, sizeof why, "%s", line.error);
    } else if (!json_is_array(json_object_get(line.json, "events")) || !json_is_object(json_object_get(line.json, "sens"))) {
      snprintf(why, sizeof why, "it has no recorded events");
    } else {
      carom_shot shot;
      const carom_status status = play_recorded(&line, &options, &shot);
      good = compare(&line, &shot, f, why);
      if (status < 0 && !good)
        snprintf(why + strlen(why), sizeof why - strlen(why), "; %s", carom_status_name(status));
      free(shot.events);
    }
    f->agreed += good;
    if (!good && job->all)
      complain("line %zu: shot %s: %s", line.number, line.id != NULL ? line.id : "-", why);
    shot_line_free(&line);
  }
  return what == SHOT_END ? 0 : -1;
}

static const command_form form = {
    .name = "parity",
    .usage = "[OPTIONS] IN.jsonl",
    .about = "Plays recorded shots by pooltool's rules and models, and compares every event with pooltool's record, up to the "
             "first event that rounding errors can change, as the recording says.\n",
    .options = (const option_row *const[]){&option_verbose, NULL},
    .details =
        "columns: shots; events compared; shots that agree; shots that agree to their end, where the recording has no chaos; "
        "largest difference of times, and of states, over the allowed 1e-12 + 5e-13 times the amplification\n\n"
        "shots recorded in space (data/shots-space.jsonl): carom begins anew at each recorded event; columns: what is compared "
        "where the rules permit it, and what not; where the results are apart; largest difference by carom's own rules and by "
        "pooltool's; then the events that come next in pooltool and in carom, where these are not the same\n\n"
        "exit code: 0 if all agree, 1 if one does not, 2 for bad usage or unreadable input\n",
    .example = "carom-lab parity data/shots-pooltool.jsonl",
    .files = ONE_FILE,
};

int command_parity(int argc, char **argv) {
  parity_job job = {.all = false};
  const char *path;
  const int code = parse_arguments(&form, argc, argv, &job, &path);
  if (code >= 0)
    return code;
  shot_file *file = shot_file_open(path);
  if (file == NULL)
    return EXIT_USAGE;
  families all = {0};
  family total = {.name = "all"};
  space_parity space = {0};
  const int read = compare_all(&job, file, &all, &space);
  bool good = true;
  if (space.shots + space.bad > 0)
    good = space_report(&space);
  if (read >= 0 && space.shots + space.bad > 0 && all.count == 0) {
    shot_file_close(file);
    return good ? EXIT_GOOD : EXIT_SOME;
  }
  printf("%-16s %5s %7s %6s %6s %10s %10s\n", "family", "shots", "events", "agreed", "whole", "time", "state");
  for (size_t k = 0; k < all.count; k++) {
    const family *f = &all.each[k];
    report(f);
    total.shots += f->shots;
    total.events += f->events;
    total.agreed += f->agreed;
    total.whole += f->whole;
    total.time = fmax(total.time, f->time);
    total.state = fmax(total.state, f->state);
    free(f->name);
  }
  report(&total);
  free(all.each);
  shot_file_close(file);
  if (read < 0 || total.shots == 0) {
    complain("%s has no shots", path);
    return EXIT_USAGE;
  }
  return good && total.agreed == total.shots ? EXIT_GOOD : EXIT_SOME;
}
