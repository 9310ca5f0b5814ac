/* The speed that stops a ball: the shots of many speeds are played, and the best of them is
 * refined.
 *
 * The miss is the distance of the ball at rest from the position, or the difference between the
 * length of its path and the distance. It is continuous in the speed except where the ball meets
 * something else, so a scan in small ratios finds the right interval, and the golden section its
 * least value. */
#include "shots/stop.h"

#include "program/program.h"
#include "rows/quantities.h"
#include "shots/given_shots.h"
#include "shots/strokes.h"

#define STOP_RADIUS "0.1"
enum { SPEEDS_TRIED = 200, REFINEMENTS = 40, CHORDS = 8 /* between two events */ };
static const double least_speed = 0.1, most_speed = 10.0; /* m/s, of the cue */

OPTION_SET(set_stop) {
  stop_target *target = field;
  const char *equals = strchr(text, '='), *position = text;
  *target = (stop_target){.is_set = true};
  if (equals != NULL && equals - text < PLACE_NAME) {
    snprintf(target->ball, PLACE_NAME, "%.*s", (int)(equals - text), text);
    position = equals + 1;
  }
  if (value_of(MEASURE_PLACE, position, &target->x) && target->x.x > 0.0) {
    target->is_distance = true;
    value_of(MEASURE_LENGTH, STOP_RADIUS, &target->radius);
    return true;
  }
  if (read_disc(position, STOP_RADIUS, &target->x, &target->y, &target->radius))
    return true;
  return refuse_value(row, text, "not a position or a distance; try 2d,4d, foot-spot or 1.5m");
}

/* What a speed is tried for, and how. */
typedef struct stop_search {
  const stop_target *target;
  const shoot_flags *flags;
  const carom_shot_options *options;
  bool failed;        /* after a complaint */
  double position[2]; /* m; of a distance [0] */
  double radius;      /* m */
} stop_search;

/* The index of the target's ball; -1 after a complaint. */
static int ball_of(stop_search *s, const shot_line *line) {
  char names[NAMES_TEXT] = "", list[HINT_TEXT];
  const char *name = s->target->ball;
  if (name[0] == '\0')
    return (int)line->cue.ball;
  for (int k = 0; k < line->count; k++) {
    if (same_text(line->name[k], name))
      return k;
    append(names, sizeof names, "|", "%s", line->name[k]);
  }
  complain("--stop '%s': no such ball; try %s", name, words_to_try(name, names, list));
  s->failed = true;
  return -1;
}

/* The length of the path of a ball, m: chords between points at equal times between events. */
static double path_length(const shot_line *line, const carom_shot *shot, int ball) {
  const size_t events = (size_t)shot_events_kept(shot), n = (events + 1) * CHORDS + 1;
  double *times = allocate(n, sizeof *times);
  carom_ball_state *states = allocate(n * (size_t)line->count, sizeof *states);
  double begin = 0.0, length = 0.0;
  size_t count = 0;
  for (size_t k = 0; k <= events; k++) {
    const double end = k < events ? shot->events[k].time : shot->time;
    for (int step = 0; step < CHORDS; step++)
      times[count++] = begin + (end - begin) * step / CHORDS;
    begin = end;
  }
  times[count++] = shot->time;
  carom_shot_frames(line->ball, line->count, shot, times, count, NULL, states, NULL);
  for (size_t k = 1; k < count; k++)
    length += plane_distance(states[k * (size_t)line->count + (size_t)ball].r,
                             states[(k - 1) * (size_t)line->count + (size_t)ball].r);
  free(states);
  free(times);
  return length;
}

/* How far the ball of a line that was played stops from where it should, m; infinite where it does
 * not stay on the table. */
static double miss_of(stop_search *s, const shot_line *line, const carom_shot *shot) {
  const carom_table *table = &line->table->table;
  const int ball = ball_of(s, line);
  if (ball < 0 || shot->final[ball].label != CAROM_BALL_STATIONARY)
    return INFINITY;
  s->radius = place_along(&s->target->radius, 0.125 * table->length);
  if (s->target->is_distance) {
    s->position[0] = place_along(&s->target->x, 0.125 * table->length);
    return fabs(path_length(line, shot, ball) - s->position[0]);
  }
  s->position[0] = place_along(&s->target->x, 0.25 * table->width);
  s->position[1] = place_along(&s->target->y, 0.125 * table->length);
  return plane_distance(shot->final[ball].r, s->position);
}

/* The miss of one speed of the cue; infinite where the shot cannot be aimed with it. */
static double try_speed(stop_search *s, double speed) {
  static shoot_flags flags; /* too large for the stack */
  static shot_line line;
  static carom_ball_state final[CAROM_BALLS_MOST];
  carom_cue cue;
  double miss = INFINITY;
  if (s->failed)
    return miss;
  flags = *s->flags;
  flags.tries = true;
  flags.speed = (values){.count = 1, .unit = "m/s", .item = {{.x = speed, .number = speed}}};
  shot_file *file = flags_open(&flags, s->options, MOST_SHOTS);
  if (file != NULL && shot_file_count(file) > 1) {
    complain("--stop finds the speed of one shot; give one value of each option");
    s->failed = true;
  }
  s->failed |= file == NULL;
  if (!s->failed && shot_file_count(file) == 1 &&
      strokes_read(file, &flags.shared, &line, &cue, 1) == 1) {
    carom_shot shot = {.final = final};
    if (shot_line_play(&line, s->options, &shot) >= 0)
      miss = miss_of(s, &line, &shot);
    free(shot.events);
    shot_line_free(&line);
  }
  if (file != NULL)
    shot_file_close(file);
  return miss;
}

/* The speed between two others with the least miss, by the golden section. */
static double refine(stop_search *s, double low, double high) {
  const double section = 0.5 * (sqrt(5.0) - 1.0);
  double inner[2] = {high - section * (high - low), low + section * (high - low)};
  double miss[2] = {try_speed(s, inner[0]), try_speed(s, inner[1])};
  for (int k = 0; k < REFINEMENTS; k++)
    if (miss[0] <= miss[1]) {
      high = inner[1];
      inner[1] = inner[0];
      miss[1] = miss[0];
      inner[0] = high - section * (high - low);
      miss[0] = try_speed(s, inner[0]);
    } else {
      low = inner[0];
      inner[0] = inner[1];
      miss[0] = miss[1];
      inner[1] = low + section * (high - low);
      miss[1] = try_speed(s, inner[1]);
    }
  return 0.5 * (low + high);
}

/* The speed at which the miss passes the radius, between one within it and one beyond. */
static double boundary(stop_search *s, double inside, double outside) {
  for (int k = 0; k < REFINEMENTS / 2; k++) {
    const double middle = 0.5 * (inside + outside);
    if (try_speed(s, middle) <= s->radius)
      inside = middle;
    else
      outside = middle;
  }
  return inside;
}

/* The speed to play: the nearest one in the longest run of speeds that stop the ball within the
 * radius, because a player needs the widest range; else the nearest of all. */
static int best_of(const double miss[SPEEDS_TRIED], double radius) {
  int nearest = 0, best = -1, longest = 0;
  for (int k = 0; k < SPEEDS_TRIED; k++)
    nearest = miss[k] < miss[nearest] ? k : nearest;
  for (int begin = 0, end; begin < SPEEDS_TRIED; begin = end + 1) {
    int nearest_of_run = begin;
    for (end = begin; end < SPEEDS_TRIED && miss[end] <= radius; end++)
      nearest_of_run = miss[end] < miss[nearest_of_run] ? end : nearest_of_run;
    if (end - begin > longest) {
      longest = end - begin;
      best = nearest_of_run;
    }
  }
  return best >= 0 ? best : nearest;
}

/* Writes what was found. */
static void report_stop(const stop_search *s, double speed, double miss, double low, double high,
                        char report[STOP_TEXT]) {
  char where[80], ball[PLACE_NAME + 8] = "the cue ball";
  if (s->target->ball[0] != '\0')
    snprintf(ball, sizeof ball, "ball %s", s->target->ball);
  if (s->target->is_distance)
    snprintf(where, sizeof where, "a path of %.4g m", s->position[0]);
  else
    snprintf(where, sizeof where, "x = %.3f, y = %.3f m", s->position[0], s->position[1]);
  char how[40] = "at";
  if (s->target->is_distance)
    snprintf(how, sizeof how, "after");
  if (miss > 5e-4)
    snprintf(how, sizeof how, "%.0f mm from", 1e3 * miss);
  if (miss <= s->radius)
    snprintf(report, STOP_TEXT,
             "stop   %s comes to rest %s %s with the cue at %.4g m/s,\n"
             "       and within %.3g m of it with %.4g to %.4g m/s\n",
             ball, how, where, speed, s->radius, low, high);
  else
    snprintf(report, STOP_TEXT,
             "stop   no speed stops %s within %.3g m of %s;\n"
             "       the nearest, %.4g m/s, leaves it %.3g m away\n",
             ball, s->radius, where, speed, miss);
}

bool stop_choose(const stop_target *target, shoot_flags *f, const carom_shot_options *options,
                 char report[STOP_TEXT]) {
  static double speed[SPEEDS_TRIED], miss[SPEEDS_TRIED];
  stop_search s = {.target = target, .flags = f, .options = options};
  if (f->speed.count > 0 || f->ball_speed.count > 0) {
    complain("--stop finds the speed; give it without --speed and --ball-speed");
    return false;
  }
  for (int k = 0; k < SPEEDS_TRIED && !s.failed; k++) {
    speed[k] = least_speed * pow(most_speed / least_speed, k / (SPEEDS_TRIED - 1.0));
    miss[k] = try_speed(&s, speed[k]);
    progress_show("speeds", k, SPEEDS_TRIED);
  }
  progress_clear();
  if (s.failed)
    return false;
  const int best = best_of(miss, s.radius);
  if (isinf(miss[best])) {
    complain(
        "--stop: with no speed of %g to %g m/s does this shot leave the ball on the table; try "
        "another aim",
        least_speed, most_speed);
    return false;
  }

  /* the best speed near it, and the range around that */
  const int lower = best > 0 ? best - 1 : best;
  const int upper = best + 1 < SPEEDS_TRIED ? best + 1 : best;
  double found = refine(&s, speed[lower], speed[upper]), least = try_speed(&s, found);
  if (!(least <= miss[best])) {
    found = speed[best];
    least = miss[best];
  }
  double low = found, high = found;
  if (least <= s.radius) {
    int k = best;
    while (k > 0 && (speed[k] >= found || miss[k] <= s.radius))
      k--;
    low = boundary(&s, found, speed[k]);
    k = best;
    while (k + 1 < SPEEDS_TRIED && (speed[k] <= found || miss[k] <= s.radius))
      k++;
    high = boundary(&s, found, speed[k]);
  }
  report_stop(&s, found, least, low, high, report);
  f->speed = (values){.count = 1, .unit = "m/s", .item = {{.x = found, .number = found}}};
  return true;
}
