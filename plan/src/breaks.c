/* Breaks of a rack: each has a rack of its own, and the errors of a player. */
#include "carom_coach.h"
#include "platform/ranges.h"
#include "rules.h"

#include <math.h>
#include <string.h>

enum { BLOCK = 64 };

/* The shots of a batch. */
typedef struct workspace {
  carom_shot_ball balls[BLOCK][CAROM_BALLS_MOST];
  carom_cue cue[BLOCK];
  carom_shot shot[BLOCK];
  carom_facts facts[BLOCK];
  carom_ball_state final[BLOCK][CAROM_BALLS_MOST];
} workspace;

/* The rules of a rack's game at a break: the first game that has the rack. False where that game
 * has no break. */
static bool rules_of(carom_rack_kind rack, carom_plan_rules *rules) {
  const carom_rules_about *about;
  if (rack == CAROM_RACK_NINEONSPOT)
    rack = CAROM_RACK_NINEBALL;
  for (int k = 0; (about = carom_rules_about_of((carom_rules_kind)k)) != NULL; k++)
    if (about->rack == (int32_t)rack) {
      *rules = carom_plan_rules_of((carom_rules_kind)k);
      rules->state.opening = 1;
      return rules->breaks == 1;
    }
  return false;
}

int carom_break_has_rules(carom_rack_kind rack) {
  carom_plan_rules rules;
  return rules_of(rack, &rules);
}

/* The direction from the cue ball to the ball in front, the nearest one, degrees. */
static double direction_of_front(const carom_shot_ball *balls, int64_t count) {
  const double *start = balls[0].state.r;
  int64_t front = 0;
  for (int64_t k = 1; k < count; k++)
    if (front == 0 ||
        carom_square(balls[k].state.r, start) < carom_square(balls[front].state.r, start))
      front = k;
  const double *end = balls[front].state.r;
  return carom_angle_of(end[0] - start[0], end[1] - start[1]) / degree;
}

carom_status carom_break_stroke(const carom_break_job *job, int64_t number, carom_shot_ball *balls,
                                carom_cue *cue) {
  if (job == NULL || job->table == NULL || job->balls == NULL || job->cue == NULL ||
      job->player == NULL || balls == NULL || cue == NULL)
    return CAROM_ERROR_NULL;
  if (job->count < 1 || job->count > CAROM_BALLS_MOST ||
      job->count != carom_rack_size((carom_rack_kind)job->rack))
    return CAROM_ERROR_BALLS;
  const uint64_t rack = (uint64_t)carom_max(number, 0);
  const carom_status status = carom_rack((carom_rack_kind)job->rack, job->table, job->gap,
                                         job->seed + rack, balls, (int)job->count);
  if (status != CAROM_OK)
    return status;
  for (int64_t k = 0; k < job->count; k++)
    balls[k].kind = job->balls[k].kind;
  balls[0].state = job->balls[0].state;
  *cue = *job->cue;

  /* A cut is that in the job's own rack; others have the cue as far beside the ball in front. */
  if (job->aim != CAROM_BREAK_DIRECTION)
    cue->phi = direction_of_front(balls, job->count);
  if (job->aim == CAROM_BREAK_CUT)
    cue->phi += job->cue->phi - direction_of_front(job->balls, job->count);
  if (number >= 0)
    carom_player_strike(job->player, job->seed, rack, cue);
  return CAROM_OK;
}

/* The balls that lie farthest to either side of the rack, as a set. */
static uint32_t wings_of(const carom_table *table, const carom_shot_ball *balls, int64_t count) {
  double most = 0.0;
  uint32_t wings = 0;
  for (int64_t k = 1; k < count; k++)
    most = fmax(most, fabs(balls[k].state.r[0] - 0.5 * table->width));
  for (int64_t k = 1; k < count; k++)
    if (fabs(balls[k].state.r[0] - 0.5 * table->width) > most - 0.5 * balls[k].kind.radius)
      wings |= UINT32_C(1) << k;
  return wings;
}

/* Adds the results of a break, by rules, or NULL. */
static void count_break(const carom_break_job *job, const carom_plan_rules *rules,
                        const carom_facts *facts, const carom_ball_state *final, uint32_t wings,
                        carom_break_counts *counts) {
  int potted = 0;
  for (int k = 0; facts->down >> k != 0; k++)
    if ((facts->down >> k & 1) != 0) {
      potted += k > 0;
      counts->fell[k][facts->pocket[k]]++;
    }
  counts->breaks++;
  counts->balls += potted;
  counts->makes += potted > 0;
  counts->scratches += (carom_stroke_marks(facts, 0) & CAROM_MARK_SCRATCH) != 0;
  counts->off += facts->off != 0;
  counts->wing += (facts->down & wings) != 0;
  if (rules != NULL) {
    carom_rules_state state = rules->state; /* rules change it as they judge */
    const uint32_t in_play = (uint32_t)((UINT64_C(1) << job->count) - 1);
    const carom_turn turn = rules->judge(&state, in_play, 0, facts, (carom_call){-1, -1});
    counts->plays_on += turn.outcome == CAROM_TURN_KEEP || turn.outcome == CAROM_TURN_WIN;
    counts->fouls += turn.foul != 0;
  }
  if (((facts->down | facts->off) & 1) == 0) {
    const double *r = final[0].r;
    counts->stays++;
    counts->x += r[0];
    counts->y += r[1];
    counts->squares += r[0] * r[0] + r[1] * r[1];
  }
}

size_t carom_break_memory(void) {
  return sizeof(workspace);
}

/* Plays a batch of breaks, and adds their results. */
static carom_status play(const carom_break_job *job, int64_t first, int n,
                         carom_break_counts *counts) {
  workspace *w = job->memory;
  for (int k = 0; k < n; k++) {
    const carom_status status = carom_break_stroke(job, first + k, w->balls[k], &w->cue[k]);
    if (status != CAROM_OK)
      return status;
    w->shot[k] = (carom_shot){.facts = &w->facts[k], .final = w->final[k]};
  }
  const carom_shot_job shots = {.table = job->table,
                                .balls = w->balls[0],
                                .cues = w->cue,
                                .count = job->count,
                                .ball_stride = CAROM_BALLS_MOST,
                                .cue_stride = 1,
                                .n = (uint64_t)n,
                                .options = job->shot,
                                .shots = w->shot};
  const carom_status status = carom_shoot_batch(&shots);
  if (status < 0)
    return status;

  /* the seed draws which balls lie at the wings */
  carom_plan_rules game, *rules = NULL;
  if (rules_of((carom_rack_kind)job->rack, &game))
    rules = &game;
  for (int k = 0; k < n; k++)
    count_break(job, rules, &w->facts[k], w->final[k],
                wings_of(job->table, w->balls[k], job->count), counts);
  return CAROM_OK;
}

carom_status carom_break_play(const carom_break_job *job, int64_t first, int64_t n,
                              carom_break_counts *counts) {
  if (job == NULL || counts == NULL || job->memory == NULL || job->memory_size < sizeof(workspace))
    return CAROM_ERROR_NULL;
  if (first < 0 || n < 0 || (uint32_t)job->aim > CAROM_BREAK_CUT)
    return CAROM_ERROR_OPTIONS;
  if (job->player != NULL && !carom_player_is_good(job->player))
    return CAROM_ERROR_OPTIONS;
  carom_status status = CAROM_OK;
  for (int64_t done = 0; done < n && status == CAROM_OK; done += BLOCK)
    status = play(job, first + done, (int)carom_min(n - done, BLOCK), counts);
  return status;
}

double carom_break_spread(const carom_break_counts *counts, double place[2]) {
  if (counts == NULL || place == NULL)
    return (double)NAN;
  const double n = (double)counts->stays;
  place[0] = counts->x / n;
  place[1] = counts->y / n;
  if (counts->stays == 0)
    return (double)NAN;
  return sqrt(fmax(counts->squares / n - place[0] * place[0] - place[1] * place[1], 0.0));
}
