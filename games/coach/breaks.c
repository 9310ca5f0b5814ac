/* Breaks of a rack: each has its own rack, and the errors of a player. */
#include "carom_coach.h"
#include "coach.h"
#include "platform/ranges.h"
#include "player.h"
#include "random_draws.h"
#include "rules.h"
#include "stick.h"
#include "table/marks.h"

#include <math.h>

/* Candidates of a search, and those that are left of them; the number of the first break that
 * chooses nothing. */
enum { BLOCK = 64, CANDIDATES = 64, FINALISTS = CAROM_BREAK_CHOICES, FRESH = 1 << 20 };

/* The shots of a batch. */
typedef struct workspace {
  carom_shot_ball balls[BLOCK][CAROM_BALLS_MOST];
  carom_cue cue[BLOCK];
  carom_shot shot[BLOCK];
  carom_facts facts[BLOCK];
  carom_ball_state final[BLOCK][CAROM_BALLS_MOST];
  carom_ruling ruling;
  const carom_player *valued;               /* who plays on; the breaks may have fewer errors */
  carom_shot_ball placed[CAROM_BALLS_MOST]; /* the job's balls with the cue ball of a candidate */
  carom_break_choice candidate[CANDIDATES];
  carom_break_counts counts; /* of breaks without some errors */
} workspace;

/* The rules of a rack's game at a break: the first game that has the rack. False where that game
 * has no break. */
static bool rules_of(carom_rack_kind rack, carom_plan_rules *rules) {
  const carom_rules_about *about;
  if (rack == CAROM_RACK_NINEONSPOT)
    rack = CAROM_RACK_NINEBALL;
  if (rack == CAROM_RACK_EIGHTONSPOT)
    rack = CAROM_RACK_EIGHTBALL;
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

  /* A cut is that in the job's own rack; others have the cue as far off the ball in front. */
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

/* Adds the result of break k of a batch by the rules of its game, and its value. */
static void count_ruling(const carom_break_job *job, const carom_plan_rules *rules, int k,
                         carom_break_counts *counts) {
  workspace *w = job->memory;
  const carom_plan_job plan = {.table = job->table,
                               .balls = w->balls[k],
                               .count = job->count,
                               .cue = &w->cue[k],
                               .player = w->valued,
                               .rules = rules,
                               .shot = job->shot,
                               .opponent = job->opponent};
  carom_referee(rules, job->table, w->balls[k], (int)job->count, 0, &w->shot[k],
                (carom_call){-1, -1}, &w->ruling);
  const carom_turn *turn = &w->ruling.turn;
  const double worth = carom_worth_left(&plan, &w->ruling);
  counts->plays_on += turn->outcome == CAROM_TURN_KEEP || turn->outcome == CAROM_TURN_WIN;
  counts->fouls += turn->foul != 0;
  counts->wins += worth;
  counts->win_squares += worth * worth;
}

/* Adds the results of break k of a batch, by rules, or NULL. */
static void count_break(const carom_break_job *job, const carom_plan_rules *rules, int k,
                        carom_break_counts *counts) {
  workspace *w = job->memory;
  const carom_facts *facts = &w->facts[k];
  /* the seed draws which balls lie at the wings */
  const uint32_t wings = wings_of(job->table, w->balls[k], job->count);
  int potted = 0;
  for (int ball = 0; facts->down >> ball != 0; ball++)
    if ((facts->down >> ball & 1) != 0) {
      potted += ball > 0;
      counts->fell[ball][facts->pocket[ball]]++;
    }
  counts->breaks++;
  counts->balls += potted;
  counts->makes += potted > 0;
  counts->scratches += (carom_stroke_marks(facts, 0) & CAROM_MARK_SCRATCH) != 0;
  counts->off += facts->off != 0;
  counts->wing += (facts->down & wings) != 0;
  if (rules != NULL)
    count_ruling(job, rules, k, counts);
  if (((facts->down | facts->off) & 1) == 0) {
    const double *r = w->final[k][0].r;
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

  carom_plan_rules game, *rules = NULL;
  if (rules_of((carom_rack_kind)job->rack, &game))
    rules = &game;
  for (int k = 0; k < n; k++)
    count_break(job, rules, k, counts);
  return CAROM_OK;
}

/* The same breaks, with the errors of job->player, for another player who plays on. */
static carom_status play_all(const carom_break_job *job, const carom_player *valued, int64_t first,
                             int64_t n, carom_break_counts *counts) {
  if (job == NULL || counts == NULL || job->memory == NULL || job->memory_size < sizeof(workspace))
    return CAROM_ERROR_NULL;
  if (first < 0 || n < 0 || (uint32_t)job->aim > CAROM_BREAK_CUT)
    return CAROM_ERROR_OPTIONS;
  const carom_player *const players[] = {job->player, job->opponent};
  for (int k = 0; k < 2; k++)
    if (players[k] != NULL && !carom_player_is_good(players[k]))
      return CAROM_ERROR_OPTIONS;
  ((workspace *)job->memory)->valued = valued;
  carom_status status = CAROM_OK;
  for (int64_t done = 0; done < n && status == CAROM_OK; done += BLOCK)
    status = play(job, first + done, (int)carom_min(n - done, BLOCK), counts);
  return status;
}

carom_status carom_break_play(const carom_break_job *job, int64_t first, int64_t n,
                              carom_break_counts *counts) {
  return play_all(job, job != NULL ? job->player : NULL, first, n, counts);
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

/* ---- The break that wins most */

/* Number k of a sequence that fills the unit cube of five dimensions evenly (M. Roberts, "The
 * unreasonable effectiveness of quasirandom sequences", 2018). */
static double even_number(int k, int dimension) {
  static const double root = 1.1347241384015194; /* x^6 = x + 1 */
  double step = 1.0;
  for (int n = 0; n <= dimension; n++)
    step /= root;
  const double x = 0.5 + (k + 1) * step;
  return x - floor(x);
}

/* The job's balls, with the cue ball on the position of a choice. */
static const carom_shot_ball *place_balls(const carom_break_job *job,
                                          const carom_break_choice *choice) {
  carom_shot_ball *balls = ((workspace *)job->memory)->placed;
  for (int64_t k = 0; k < job->count; k++)
    balls[k] = job->balls[k];
  balls[0].state.r[0] = choice->place[0];
  balls[0].state.r[1] = choice->place[1];
  return balls;
}

/* Candidate k: a position behind the head string, a speed and a height of the tip; every other one
 * cuts the ball in front. The first candidate is the stroke of the job. Apart, so that shots have
 * its stack. */
__attribute__((noinline)) static void make_candidate(const carom_break_job *job, int k,
                                                     carom_break_choice *choice) {
  const carom_ball_state *ball = &job->balls[0].state;
  *choice =
      (carom_break_choice){.cue = *job->cue, .place = {ball->r[0], ball->r[1]}, .aim = job->aim};
  if (k == 0)
    return;
  const double radius = job->balls[0].kind.radius;
  const carom_marks marks = carom_marks_of(job->table->width, job->table->length);
  choice->place[0] = radius + (job->table->width - 2.0 * radius) * even_number(k, 0);
  choice->place[1] = radius + (marks.head_spot[1] - radius) * even_number(k, 1);
  choice->cue.speed = job->cue->speed * (0.4 + 0.6 * even_number(k, 2));
  choice->cue.b = 0.5 * even_number(k, 3) - 0.2;
  const carom_shot_ball *balls = place_balls(job, choice);
  choice->cue.phi = direction_of_front(balls, job->count);
  choice->aim = CAROM_BREAK_FULL;
  if (k % 2 == 1) {
    /* off the middle of the ball by up to a radius, a length of a table's half away */
    const double most_beside = carom_asin(2.0 * radius / job->table->length) / degree;
    choice->cue.phi += most_beside * (2.0 * even_number(k, 4) - 1.0);
    choice->aim = CAROM_BREAK_CUT;
  }
  choice->cue.theta = carom_least_elevation(job->table, balls, (int)job->count, &choice->cue);
}

/* Plays breaks of a candidate by a player, and adds their results. */
static carom_status play_choice(const carom_break_job *job, const carom_player *player,
                                const carom_break_choice *choice, int64_t first, int64_t n,
                                carom_break_counts *counts) {
  carom_break_job placed = *job;
  placed.balls = place_balls(job, choice);
  placed.cue = &choice->cue;
  placed.player = player;
  placed.aim = choice->aim;
  return play_all(&placed, job->player, first, n, counts);
}

static double mean_of(const carom_break_counts *counts) {
  return counts->wins / (double)carom_max(counts->breaks, 1);
}

/* Sorts candidates by their means, the best first. */
static void sort_choices(carom_break_choice *choice, int count) {
  for (int k = 1; k < count; k++)
    for (int n = k; n > 0 && mean_of(&choice[n].counts) > mean_of(&choice[n - 1].counts); n--) {
      const carom_break_choice moved = choice[n];
      choice[n] = choice[n - 1];
      choice[n - 1] = moved;
    }
}

/* What the errors of a choice cost: the same breaks without some of them, or without all. */
static carom_status find_cost(const carom_break_job *job, carom_break_choice *choice,
                              int64_t breaks) {
  carom_player without[4] = {*job->player, *job->player, *job->player, *job->player};
  double *const cost[4] = {&choice->speed_cost, &choice->aim_cost, &choice->tip_cost,
                           &choice->cost};
  carom_break_counts *counts = &((workspace *)job->memory)->counts;
  carom_status status = CAROM_OK;
  for (int k = 0; k < 4 && status == CAROM_OK; k++) {
    if (k == 0 || k == 3)
      without[k].speed = without[k].speed_share = 0.0;
    if (k == 1 || k == 3)
      without[k].phi = without[k].theta = 0.0;
    if (k == 2 || k == 3)
      without[k].a = without[k].b = 0.0;
    *counts = (carom_break_counts){0};
    status = play_choice(job, &without[k], choice, FRESH, breaks, counts);
    *cost[k] = mean_of(counts) - mean_of(&choice->counts);
  }
  return status;
}

/* Apart, so that shots have the stack of the counts. */
__attribute__((noinline)) static carom_status check_job(const carom_break_job *job) {
  return carom_break_play(job, 0, 0, &(carom_break_counts){0});
}

carom_status carom_break_best(const carom_break_job *job, int64_t breaks,
                              carom_break_choice *choices, int room) {
  if (job == NULL || choices == NULL || job->player == NULL || job->cue == NULL ||
      job->balls == NULL || job->table == NULL)
    return CAROM_ERROR_NULL;
  if (breaks < 16 || room < 1 || room > FINALISTS ||
      !carom_break_has_rules((carom_rack_kind)job->rack))
    return CAROM_ERROR_OPTIONS;
  carom_status status = check_job(job);
  if (status != CAROM_OK)
    return status;
  carom_break_choice *candidate = ((workspace *)job->memory)->candidate;
  for (int k = 0; k < CANDIDATES; k++)
    make_candidate(job, k, &candidate[k]);

  /* each round leaves the better half, whose further breaks are twice as many */
  int64_t played = 0;
  for (int count = CANDIDATES; count >= FINALISTS; count /= 2) {
    const int64_t more = breaks * FINALISTS / (2 * count);
    for (int k = 0; k < count && status == CAROM_OK; k++)
      status = play_choice(job, job->player, &candidate[k], played, more, &candidate[k].counts);
    played += more;
    sort_choices(candidate, count);
  }

  /* the breaks that choose are partly lucky for the best: others are reported */
  for (int k = 0; k < room && status == CAROM_OK; k++) {
    choices[k] = candidate[k];
    choices[k].counts = (carom_break_counts){0};
    choices[k].speed_cost = choices[k].aim_cost = choices[k].tip_cost = choices[k].cost = NAN;
    status = play_choice(job, job->player, &choices[k], FRESH, breaks, &choices[k].counts);
  }
  if (status == CAROM_OK) {
    sort_choices(choices, room);
    status = find_cost(job, &choices[0], breaks);
  }
  return status;
}
