/* What a player's error makes of a shot.
 *
 * Speed, aim and tip of the cue have independent errors with standard deviations s_j. With the
 * tangents d_j of a place per s_j, its covariance is, to first order, the sum of d_j d_j^T.
 * Across a path, whose unit normal is n, the paths of a player's shots have the standard
 * deviation sqrt(sum (n . d_j)^2): a ball that is ahead or behind goes the same way.
 */
#include "shots/spread.h"

#include "carom_tangent.h"

#include "program/program.h"
#include "rows/quantities.h"

const double spread_most = 0.3;

enum { MOST_TEXT = 128, TIMES = 512, NUMBERS = CAROM_STATE_NUMBERS * ERRORS };
/* of the numbers of a cue that have tangents */
enum { CUE_SPEED = 0, CUE_PHI = 1, CUE_A = 3, CUE_B = 4 };

/* ---- The option */

OPTION_SET(set_player_error) {
  static const int measure[ERRORS] = {MEASURE_SHARE, MEASURE_ANGLE, MEASURE_TIP, MEASURE_TIP};
  player_error *error = field;
  char copy[MOST_TEXT], *rest = NULL;
  int count = 0;
  bool good = strlen(text) < sizeof copy, all_zero = true;
  snprintf(copy, sizeof copy, "%s", text);
  *error = (player_error){.is_set = true};
  for (char *part = strtok_r(copy, ",", &rest); part != NULL && good;
       part = strtok_r(NULL, ",", &rest)) {
    good = count < ERRORS && value_of(measure[count], part, &error->deviation[count]) &&
           error->deviation[count].x >= 0.0;
    all_zero = all_zero && good && error->deviation[count].x == 0.0;
    count++;
  }
  if (count == ERROR_ABOVE)
    error->deviation[count++] = error->deviation[ERROR_RIGHT];
  if (good && count == ERRORS && !all_zero)
    return true;
  return refuse_value(
      row, text,
      "not the errors SPEED,AIM,RIGHT,ABOVE; try 1%%,0.05,0.01,0.01, in %%, degrees "
      "and radii");
}

/* ---- Bands */

/* What carom_shot_tangent() tells of a shot, per standard deviation of each error. */
typedef struct shot_tangents {
  double *times, *sampled, *incoming, *outgoing, *final, *time;
  carom_ball_state *states; /* at the times */
} shot_tangents;

static void free_tangents(shot_tangents *t) {
  double *arrays[] = {t->times, t->sampled, t->incoming, t->outgoing, t->final, t->time};
  for (size_t k = 0; k < COUNT_OF(arrays); k++)
    free(arrays[k]);
  free(t->states);
}

/* Adds the covariance of a place by its tangents. */
static void add_covariance(const double *d, double c[3]) {
  for (int j = 0; j < ERRORS; j++) {
    const double x = d[j], y = d[ERRORS + j];
    c[0] += x * x;
    c[1] += x * y;
    c[2] += y * y;
  }
}

/* Adds a point to a band, or cuts it there. A ball at rest has the direction of the point
 * before. */
static void add_point(spread *s, int ball, double time, const carom_ball_state *state,
                      const double *d, double along[2], bool begins) {
  const double v = plane_size(state->v);
  for (int axis = 0; axis < 2 && v > 1e-6; axis++)
    along[axis] = state->v[axis] / v;
  double sum = 0.0;
  for (int j = 0; j < ERRORS; j++) {
    const double off = along[0] * d[ERRORS + j] - along[1] * d[j];
    sum += off * off;
  }
  const double across = sqrt(sum);
  s->cut[ball] = s->cut[ball] || across > spread_most;
  if (!s->cut[ball])
    s->band[ball][s->points[ball]++] = (band_point){.time = time,
                                                    .r = {state->r[0], state->r[1]},
                                                    .side = {-along[1] * across, along[0] * across},
                                                    .begins = begins};
}

/* The band of a ball, from event to event that it is in. */
static void make_band(spread *s, const shot_tangents *t, const shot_line *line,
                      const carom_shot *shot, int ball) {
  static const double zeros[NUMBERS];
  const carom_ball_state *start = &line->ball[ball].state;
  const double *d = zeros;
  double last = 0.0, along[2] = {1.0, 0.0};
  int next = 0;
  s->band[ball] = allocate((size_t)(TIMES + 2 * (shot->count + 1)), sizeof *s->band[ball]);
  for (int64_t k = 0; k <= shot->count && !s->cut[ball]; k++) {
    const carom_event *e = k < shot->count ? &shot->events[k] : NULL;
    const int side = e != NULL ? shot_event_side(e, ball) : 0;
    if (side < 0)
      continue;
    const double end = e != NULL ? e->time : shot->time;
    const carom_ball_state *end_state = e != NULL ? &e->before[side] : &shot->final[ball];
    if (end > last && (end_state->r[0] != start->r[0] || end_state->r[1] != start->r[1])) {
      add_point(s, ball, last, start, d, along, true);
      for (; next < TIMES && t->times[next] < end && !s->cut[ball]; next++) {
        const double *tangent = t->sampled + (next * line->count + ball) * NUMBERS;
        double c[3] = {0};
        add_covariance(tangent, c);
        s->cut[ball] = axes_of(c).along > spread_most;
        if (t->times[next] > last)
          add_point(s, ball, t->times[next], &t->states[next * line->count + ball], tangent, along,
                    false);
      }
      d = e != NULL ? t->incoming + (2 * k + side) * NUMBERS : t->final + ball * NUMBERS;
      add_point(s, ball, end, end_state, d, along, false);
    }
    if (e != NULL) {
      start = &e->after[side];
      d = t->outgoing + (2 * k + side) * NUMBERS;
      last = end;
    }
  }
}

/* ---- A shot */

/* In the space of errors over their standard deviations an event is lost beyond a plane, whose
 * distance along axis j is its reach r_j, and whose distance from the shot is 1 / sqrt(sum
 * 1/r_j^2). The least reaches are those of several planes, so this is at most the distance of
 * the nearest one. */
static double together(const double reach[ERRORS]) {
  double sum = 0.0;
  for (int j = 0; j < ERRORS; j++)
    sum += 1.0 / (reach[j] * reach[j]);
  return 1.0 / sqrt(sum);
}

/* Whether the first `count` events end inside a cluster. */
static bool parts_cluster(const carom_shot *shot, int64_t count) {
  const carom_event *e = &shot->events[count];
  return count < shot->count && e[0].cluster > 0 && e[-1].cluster > 0 && e[0].time == e[-1].time;
}

/* When the first event is that one standard deviation would change: the reach of the events up
 * to one falls with each. */
static carom_status find_until(const shot_line *line, const carom_shot *shot,
                               const carom_shot_options *options, const carom_tangent_seeds *seeds,
                               const shot_tangents *t, double *end) {
  int64_t same = 0, changed = shot->count;
  while (changed - same > 1) {
    double reach[ERRORS];
    carom_shot part = *shot;
    part.count = same + (changed - same) / 2;
    while (part.count > same && parts_cluster(shot, part.count))
      part.count--;
    for (part.count += part.count == same; part.count < changed && parts_cluster(shot, part.count);)
      part.count++;
    if (part.count == changed)
      break;
    part.time = shot->events[part.count - 1].time;
    carom_tangent tangent = {.final = t->final, .time = t->time, .reach = reach};
    const carom_status status = carom_shot_tangent(&line->table->table, line->ball, line->count,
                                                   &line->cue, options, &part, seeds, &tangent);
    if (status != CAROM_OK)
      return status;
    if (together(reach) < 1.0)
      changed = part.count;
    else
      same = part.count;
  }
  *end = shot->events[changed - 1].time;
  return CAROM_OK;
}

void spread_of(const player_error *error, const shot_line *line, const carom_shot *shot,
               const carom_shot_options *options, bool bands, spread *result) {
  static const int number_of[ERRORS] = {CUE_SPEED, CUE_PHI, CUE_A, CUE_B};
  const size_t events = (size_t)shot->count + 1, balls = (size_t)line->count,
               times = bands ? TIMES : 0;
  const double R = line->ball[line->cue.ball].kind.radius;
  *result = (spread){.end = INFINITY};
  /* one direction for each error, as long as its standard deviation */
  double cue[CAROM_CUE_NUMBERS][ERRORS] = {{0}};
  for (int j = 0; j < ERRORS; j++) {
    result->error[j] = error->deviation[j].x * (j == ERROR_SPEED ? line->cue.speed : 1.0) /
                       (error->deviation[j].times == OFFSET ? R : 1.0);
    cue[number_of[j]][j] = result->error[j];
  }
  const carom_tangent_seeds seeds = {.directions = ERRORS, .cue = &cue[0][0]};
  shot_tangents t = {.times = allocate(times + 1, sizeof *t.times),
                     .sampled = allocate(times * balls * NUMBERS + 1, sizeof *t.sampled),
                     .incoming = allocate(events * 2 * NUMBERS, sizeof *t.incoming),
                     .outgoing = allocate(events * 2 * NUMBERS, sizeof *t.outgoing),
                     .final = allocate(balls * NUMBERS, sizeof *t.final),
                     .time = allocate(events * ERRORS, sizeof *t.time),
                     .states = allocate(times * balls + 1, sizeof *t.states)};
  for (size_t k = 0; k < times; k++)
    t.times[k] = shot->time * ((double)k + 0.5) / (double)times;
  carom_tangent tangent = {.final = t.final,
                           .time = t.time,
                           .before = t.incoming,
                           .after = t.outgoing,
                           .at = t.sampled,
                           .times = t.times,
                           .times_count = (int64_t)times,
                           .reach = result->reach};
  carom_status status = carom_shot_tangent(&line->table->table, line->ball, line->count, &line->cue,
                                           options, shot, &seeds, &tangent);
  if (status == CAROM_OK && bands)
    status = carom_shot_frames(line->ball, line->count, shot, t.times, times, NULL, t.states, NULL);
  result->flags = tangent.all_flags;
  for (int k = 0; k < line->count && status == CAROM_OK; k++) {
    add_covariance(t.final + k * NUMBERS, result->final[k]);
    if (bands)
      make_band(result, &t, line, shot, k);
  }
  result->together = together(result->reach);
  if (status == CAROM_OK && result->together < 1.0)
    status = find_until(line, shot, options, &seeds, &t, &result->end);
  free_tangents(&t);
  if (status != CAROM_OK)
    spread_free(result);
  result->status = status;
}

void spread_free(spread *s) {
  for (int k = 0; k < CAROM_BALLS_MOST; k++)
    free(s->band[k]);
  *s = (spread){0};
}

spread_axes axes_of(const double c[3]) {
  const double middle = 0.5 * (c[0] + c[2]), half = hypot(0.5 * (c[0] - c[2]), c[1]);
  return (spread_axes){.along = sqrt(middle + half),
                       .across = sqrt(fmax(middle - half, 0.0)),
                       .degrees = 0.5 * atan2(2.0 * c[1], c[0] - c[2]) / degree};
}

/* ---- In words and as JSON */

void spread_tell_ball(FILE *out, const spread *s, int ball) {
  if (s->status < 0)
    return;
  const spread_axes axes = axes_of(s->final[ball]);
  if (axes.along > spread_most)
    fprintf(out, "       standard deviation above %g m: derivatives say nothing about this place\n",
            spread_most);
  else
    fprintf(out, "       standard deviation %.2g m at %.0f degrees, %.2g m across\n", axes.along,
            axes.degrees, axes.across);
}

void spread_tell(FILE *out, const spread *s, const shot_line *line) {
  static const char *const named[ERRORS] = {"the speed", "the aim", "the tip to the right",
                                            "the tip above"};
  if (s->status < 0) {
    fprintf(out, "spread not known: %s\n", carom_status_string(s->status));
    return;
  }
  bool cut = false;
  int least = 0;
  for (int j = 1; j < ERRORS; j++)
    least = s->reach[j] < s->reach[least] ? j : least;
  for (int k = 0; k < line->count; k++)
    cut = cut || s->cut[k];
  const double speed = line->cue.speed;
  fprintf(out,
          "spread by standard deviations: speed %.3g %%, aim %.3g degrees, tip %.3g R right, %.3g "
          "R above\n",
          speed > 0.0 ? 100.0 * s->error[ERROR_SPEED] / speed : 0.0, s->error[ERROR_AIM],
          s->error[ERROR_RIGHT], s->error[ERROR_ABOVE]);
  if (s->together == INFINITY)
    fputs("       reach: no error was found that changes a ball's events\n", out);
  else
    fprintf(out,
            "       reach: %.2g standard deviations of %s, %.2g of all together, change a ball's "
            "events\n",
            s->reach[least], named[least], s->together);
  if (s->end < INFINITY)
    fprintf(out, "       beyond reach from %.2f s on (dashed)\n", s->end);
  if (cut)
    fprintf(out,
            "       bands end where the standard deviation is above %g m: derivatives say nothing "
            "there\n",
            spread_most);
  if ((s->flags & (CAROM_TANGENT_SIMULTANEOUS | CAROM_TANGENT_KINK)) != 0)
    fputs("       some contacts have no derivative, or one to one side only\n", out);
}

json_t *spread_json(const spread *s, const shot_line *line) {
  static const char *const keys[ERRORS] = {"V0", "phi", "a", "b"};
  if (s->status < 0)
    return json_null();
  json_t *error = json_object(), *reach = json_object(), *balls = json_object();
  for (int j = 0; j < ERRORS; j++) {
    const double most = s->reach[j] * s->error[j];
    json_object_set_new(error, keys[j], json_real(s->error[j]));
    json_object_set_new(reach, keys[j],
                        isfinite(most) && s->error[j] > 0.0 ? json_real(most) : json_null());
  }
  for (int k = 0; k < line->count; k++)
    json_object_set_new(balls, line->name[k],
                        json_pack("[f, f, f]", s->final[k][0], s->final[k][1], s->final[k][2]));
  return json_pack("{s: o, s: o, s: o, s: o, s: i, s: o}", "error", error, "reach", reach,
                   "together", isfinite(s->together) ? json_real(s->together) : json_null(),
                   "until", isfinite(s->end) ? json_real(s->end) : json_null(), "flags",
                   (int)s->flags, "covariance", balls);
}
