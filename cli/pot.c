/* An aim at a pocket is the library's; here its shot is played, since other balls, the jaws and
 * the cloth decide too. The window of speeds is found by shots in the same direction: steps of a
 * tenth away from the speed of the cue, until one misses, then halvings. */
#include "pot.h"

#include "carom_plan.h"
#include "derived.h"
#include "memory.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>

enum { ROOM = 4096, HALVINGS = 20 };
static const double speed_most = 15.0, speed_least = 0.05; /* m/s, of the cue */

static bool has(const carom_event *e, int64_t ball) {
  return e->type == CAROM_EVENT_BALL_BALL && (e->a == ball || e->b == ball);
}

typedef struct attempt {
  const carom_table *table;
  const carom_shot_ball *balls;
  int count, ball, pocket;
  carom_shot_options options;
  carom_event *events;
} attempt;

/* What comes of a cue; *found gets its cut and margins, or the obstacle. */
static pot_result play(const attempt *t, const carom_cue *cue, const double window[2], pot *found) {
  carom_shot shot = {.events = t->events, .room = ROOM};
  carom_shoot(t->table, t->balls, t->count, cue, &t->options, &shot);
  const int64_t count = shot.count < shot.room ? shot.count : shot.room;
  const carom_event *met = NULL;
  bool cushions = false; /* whether the ball has met one */
  *found = (pot){0};
  for (int64_t k = 0; k < count; k++) {
    const carom_event *e = &t->events[k];
    const bool by_cue = e->a == cue->ball && e->type >= CAROM_EVENT_RAIL &&
                        (e->type <= CAROM_EVENT_POCKET || e->type == CAROM_EVENT_LEFT_TABLE);
    /* up to the contact of the two */
    if (met == NULL && (by_cue || has(e, cue->ball))) {
      found->obstacle = *e;
      if (by_cue || !has(e, t->ball))
        return POT_BARRED;
      const int own = e->a == cue->ball ? 0 : 1;
      const double *from = e->before[own].r, *to = e->before[1 - own].r;
      met = e;
      found->cut =
          angle_between(e->before[own].v, (const double[]){to[0] - from[0], to[1] - from[1]});
      const double *v = e->after[1 - own].v, way = atan2(v[1], v[0]) / degree;
      found->right = remainder(way - window[0], 360.0);
      found->left = remainder(window[1] - way, 360.0);
    } else if (met != NULL && e->type == CAROM_EVENT_POCKET && e->a == t->ball)
      return e->b == t->pocket ? POT_FOUND : POT_REJECTED;
    else if (met != NULL && has(e, t->ball) && !has(e, cue->ball)) {
      found->obstacle = *e;
      return POT_MET;
    } else if (met != NULL && e->a == t->ball &&
               (e->type == CAROM_EVENT_ROLLING_STATIONARY ||
                e->type == CAROM_EVENT_ROLLING_SPINNING) &&
               !cushions)
      return POT_SHORT;
    else if (met != NULL && e->a == t->ball &&
             (e->type == CAROM_EVENT_RAIL || e->type == CAROM_EVENT_JAW))
      cushions = true;
  }
  return met != NULL ? POT_REJECTED : POT_BARRED;
}

/* The last speed from that of the cue on, by steps of a factor, with which the ball falls. */
static double last_speed(const attempt *t, carom_cue cue, double factor, const double window[2]) {
  double good = cue.speed, bad = good;
  pot unused;
  do {
    good = bad;
    cue.speed = bad = good * factor;
    if (bad > speed_most || bad < speed_least)
      return good;
  } while (play(t, &cue, window, &unused) == POT_FOUND);
  for (int k = 0; k < HALVINGS; k++) {
    cue.speed = 0.5 * (good + bad);
    *(play(t, &cue, window, &unused) == POT_FOUND ? &good : &bad) = cue.speed;
  }
  return good;
}

pot_result pot_aim(const carom_table *table, const carom_shot_ball *balls, int count,
                   const carom_shot_options *options, int ball, int pocket, carom_cue *cue,
                   pot *found) {
  double window[2];
  *found = (pot){0};
  if (carom_plan_aim(table, balls, count, ball, pocket, options, cue, window) != CAROM_OK)
    return POT_NO_CUT;
  attempt t = {.table = table,
               .balls = balls,
               .count = count,
               .ball = ball,
               .pocket = pocket,
               .options = *options,
               .events = allocate(ROOM, sizeof *t.events)};
  const pot_result result = play(&t, cue, window, found);
  if (result == POT_FOUND) {
    found->least = last_speed(&t, *cue, 1.0 / 1.1, window);
    found->most = last_speed(&t, *cue, 1.1, window);
  }
  free(t.events);
  return result;
}
