/* The best shot of a layout, by playing many.
 *
 * 1. Pots: every direct pot whose chance is above 3 %, with six speeds and five places of the
 *    tip. The aim is solved by shots of two balls that stop at the contact: three fixed-point
 *    steps for throw, the squirt once for each tip.
 * 2. Scan: strokes in all directions. One that meets a ball first that is not on is stopped
 *    there. The others are candidates: banks, kicks, combinations, caroms, safeties, breaks.
 * 3. Each candidate is played once without errors. Its worth is 1 for a win, 0 for a loss, else
 *    the value of the layout that it leaves, to whoever plays next.
 * 4. Sequential halving (Z. Karnin, T. Koren, O. Somekh, ICML 2013): four rounds with equal
 *    shares of the shots. In each, the candidates that are left are played with errors, the same
 *    errors for all; a quarter of them stays.
 *
 * A shot is a row, whose errors are a function of seed, round and number. Rows are computed by
 * threads and added up in their order, so no bit of a sum depends on threads. */
#include "plan/plan.h"
#include "platform/elementary.h"
#include "platform/threads.h"
#include "shot/sim.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

static const double degree = 3.14159265358979323846 / 180.0;

enum {
  ROUNDS = 4,
  TIPS = 5,
  POT_SPEEDS = 6,
  SCAN_SPEEDS = 5,
  STROKES = TIPS * POT_SPEEDS,
  PLACES = 60,       /* of a cue ball in hand, of which */
  PLACES_PLANNED = 6 /* are planned from */
};
/* m/s and radii, from the prototype */
static const double pot_speed[POT_SPEEDS] = {0.8, 1.2, 1.7, 2.4, 3.4, 4.8};
static const double pot_tip[TIPS][2] = {
    {0.0, 0.0}, {0.0, 0.35}, {0.0, -0.35}, {0.3, 0.0}, {-0.3, 0.0}};
static const double scan_speed[SCAN_SPEEDS] = {1.0, 1.8, 3.0, 5.0, 7.5};
static const double scan_tip[TIPS][2] = {
    {0.0, 0.0}, {0.0, 0.3}, {0.0, -0.3}, {0.25, 0.0}, {-0.25, 0.0}};

/* Stages of draws. */
enum { DRAW_STROKES = 1, DRAW_SCAN, DRAW_PLACES, DRAW_ROUND = 16 };

typedef struct candidate {
  double speed, phi, theta, a, b;
  double sum, squares; /* of its worth, over `seen` shots with errors; at first of the one
                          without */
  int64_t seen;
  int64_t keep, foul, lose; /* how often */
  int32_t kind, ball, pocket, cushions, order, round;
} candidate;

/* Of a row. */
typedef struct outcome {
  double worth;
  int8_t is, foul, ball, pocket;
  int16_t cushions;
  int8_t first, unused;
} outcome;

enum { UNIT = 4 }; /* rows worth a thread */

/* What a shot tells. */
typedef struct told {
  carom_facts facts;
  carom_ball_state final[CAROM_BALLS_MOST];
} told;

/* A direct pot that is a candidate. */
typedef struct pot {
  carom_way way;
  int ball, pocket;
} pot;

/* A place of a cue ball in hand, and the value of the layout with it. */
typedef struct place_in_hand {
  double r[2], value;
} place_in_hand;

/* All of a plan. It is in the caller's memory, since shots need most of a small stack. */
typedef struct plan {
  carom_crew *crew;   /* the threads that play its shots */
  carom_plan_job job; /* with shot and options of its own */
  carom_shot_options shot;
  carom_plan_options options;
  carom_features features; /* of the table, prepared for the balls */
  carom_view view;
  carom_player player;
  uint32_t in_play, on, may, pockets;
  bool first_decides;                       /* a shot ends at a wrong first ball */
  double foul_value;                        /* of a foul at the first contact */
  int32_t left;                             /* balls before the shot */
  candidate *found;                         /* all candidates, the best first after a round */
  outcome *outcome;                         /* of the rows of a stage */
  int64_t count, most;                      /* of candidates */
  int64_t room;                             /* of outcomes */
  carom_ball_state state[CAROM_BALLS_MOST]; /* of the layout */
  carom_shot_ball hand[CAROM_BALLS_MOST];   /* the layout with the cue ball in hand */
  /* the balls in play, which alone take part in shots: which they are, and their set in shots
   * of the balls that are on, where the first contact decides */
  carom_shot_ball played[CAROM_BALLS_MOST];
  int32_t plays, which[CAROM_BALLS_MOST], cue_ball;
  pot pot[CAROM_BALLS_MOST * CAROM_POCKETS_MOST];
  place_in_hand best_place[PLACES_PLANNED + 1]; /* the best first */
  const carom_cue *cues;                        /* that the caller gave, `tries` of them, */
  carom_choice *choices;                        /* and where he wants what they are worth */
  int places, tries;
} plan;

/* A stage: rows k of candidates first + k / each, with the errors of k % each; or without
 * errors. */
typedef struct stage {
  const plan *of;
  int64_t first, each;
  uint32_t draws; /* 0: without errors */
} stage;

/* ---- A row */

static double within(double x, double least, double most) {
  return x < least ? least : x > most ? most : x;
}

/* The stroke of a candidate, with the errors of a row. */
static carom_cue stroke(const plan *of, const candidate *c, uint32_t draws, int64_t row) {
  carom_cue cue = *of->job.cue;
  double z[6] = {0};
  if (draws != 0)
    carom_normals(of->options.seed, draws, (uint64_t)row, z);
  cue.speed = c->speed;
  cue.phi = c->phi;
  cue.theta = c->theta;
  cue.a = c->a;
  cue.b = c->b;
  carom_player_errs(&of->player, z, &cue);
  return cue;
}

/* The pot that a shot made, which a candidate calls: of the balls that were on, the first that
 * fell. */
static carom_call call_of(const plan *of, const carom_facts *facts) {
  carom_call call = {-1, -1};
  const uint32_t down = facts->down & of->on;
  for (int k = 0; down >> k != 0; k++)
    if ((down >> k & 1) && (of->pockets >> facts->pocket[k] & 1) &&
        (call.ball < 0 || facts->pocket_time[k] < facts->pocket_time[call.ball]))
      call = (carom_call){k, facts->pocket[k]};
  return call;
}

/* Of the balls left before the shot; rules that then have more left, or more points than balls,
 * give at most all. */
static double share(const plan *of, double points) {
  return within(points / of->left, 0.0, 1.0);
}

/* The worth of a shot for the player: its turn, and the value of the layout that it leaves.
 * `final` is changed. */
static outcome judge(const plan *of, const carom_facts *facts, carom_ball_state *final,
                     carom_status status, const candidate *c, bool errors) {
  const carom_plan_rules *rules = of->job.rules;
  facts = status < 0 ? &carom_no_facts : facts; /* an error tells nothing: a foul */
  const carom_call call = c->kind == CAROM_PLAN_PUSH ? (carom_call){CAROM_CALL_PUSH, -1}
                          : errors                   ? (carom_call){c->ball, c->pocket}
                                                     : call_of(of, facts);
  uint64_t user[8];
  memcpy(user, rules->user, sizeof user);
  const carom_turn turn = rules->judge(user, of->in_play, of->view.cue_ball, facts, call);
  outcome o = {.is = (int8_t)turn.is,
               .foul = turn.foul != 0,
               .ball = -1,
               .pocket = -1,
               .first = (int8_t)facts->first[0]};

  /* its call */
  if (call.ball == CAROM_CALL_PUSH)
    o.ball = CAROM_CALL_PUSH;
  if (call.ball >= 0 && (turn.is == CAROM_TURN_KEEP || turn.is == CAROM_TURN_WIN)) {
    o.ball = (int8_t)call.ball;
    o.pocket = (int8_t)call.pocket;
    o.cushions = (int16_t)facts->cushions[call.ball];
  }
  const bool alone = rules->race == CAROM_RACE_ALONE;
  if (turn.is == CAROM_TURN_WIN || turn.is == CAROM_TURN_LOSE) {
    o.worth = turn.is == CAROM_TURN_WIN;
    return o;
  }
  if (alone && turn.is == CAROM_TURN_PASS) {
    o.worth = share(of, turn.points);
    return o;
  }

  /* A shot that was stopped at a wrong ball, and one in error, have left no layout. */
  if (status != CAROM_OK && turn.is == CAROM_TURN_PASS) {
    o.worth = of->foul_value;
    return o;
  }
  const bool taken_back = status != CAROM_OK || turn.leave == CAROM_LEAVE_BEFORE;
  for (int k = 0; k < of->view.count; k++) {
    if (taken_back)
      final[k] = of->job.balls[k].state;
    if (turn.spot >> k & 1)
      final[k] = (carom_ball_state){
          .r = {0.5 * of->view.width, 0.75 * of->view.length, of->view.radius[k]},
          .label = CAROM_BALL_STATIONARY};
  }
  const bool in_hand = turn.leave == CAROM_LEAVE_HAND || turn.leave == CAROM_LEAVE_KITCHEN;
  const bool passes = turn.is == CAROM_TURN_PASS;
  const double value = carom_value_of(&of->view, user, final, passes, in_hand);
  o.worth = passes ? 1.0 - value : alone ? share(of, turn.points + value) : value;
  return o;
}

/* Whether a stroke of the scan met a ball first that is on. */
static bool begins_well(const plan *of, int first) {
  return first >= 0 && (of->on >> first & 1);
}

/* The balls in play of a layout become those of shots. */
static void lay_out(plan *of, const carom_shot_ball *balls) {
  of->plays = 0;
  of->shot.first_of = 0;
  for (int k = 0; k < of->view.count; k++)
    if (of->in_play >> k & 1) {
      if (of->first_decides && (of->on >> k & 1))
        of->shot.first_of |= UINT32_C(1) << of->plays;
      if (k == of->view.cue_ball)
        of->cue_ball = of->plays;
      of->played[of->plays] = balls[k];
      of->which[of->plays++] = k;
    }
}

/* From the balls of a shot to those of the layout. */
static void spread(const plan *of, told *with) {
  carom_facts *f = &with->facts;
  const carom_facts of_shot = *f;
  f->down = f->off = f->moved = 0;
  for (int n = 0; n < 2; n++)
    f->first[n] = f->first[n] < 0 ? f->first[n] : of->which[f->first[n]];
  int n = of->plays - 1;
  for (int k = of->view.count - 1; k >= 0; k--) {
    const bool plays = n >= 0 && of->which[n] == k;
    with->final[k] = plays ? with->final[n] : of->job.balls[k].state;
    f->pocket[k] = plays ? of_shot.pocket[n] : -1;
    f->pocket_time[k] = plays ? of_shot.pocket_time[n] : INFINITY;
    f->cushions[k] = plays ? of_shot.cushions[n] : 0;
    if (!plays)
      continue;
    f->down |= (of_shot.down >> n & 1) << k;
    f->off |= (of_shot.off >> n & 1) << k;
    f->moved |= (of_shot.moved >> n & 1) << k;
    n--;
  }
}

static size_t play_rows(const void *context, size_t first, size_t end) {
  const stage *s = context;
  const plan *of = s->of;
  told what;
  carom_shot shot = {.final = what.final, .facts = &what.facts};
  for (size_t k = first; k < end; k++) {
    const int64_t row = (int64_t)k;
    const candidate *c = &of->found[s->first + row / s->each];
    carom_cue cue = stroke(of, c, s->draws, row % s->each);
    cue.ball = of->cue_ball;
    const carom_status status =
        carom_shoot_prepared(of->job.table, &of->features, carom_layout_of(of->played), of->plays,
                             &cue, &of->shot, &shot); /* in error it is a foul */
    if (of->plays < of->view.count)
      spread(of, &what);
    const int met = status < 0 ? -1 : what.facts.first[0];
    const bool dropped = s->draws == 0 && c->kind == CAROM_PLAN_SCAN && !begins_well(of, met);
    of->outcome[k] = dropped ? (outcome){.first = (int8_t)met}
                             : judge(of, shot.facts, shot.final, status, c, s->draws != 0);
  }
  return end;
}

static void play(plan *of, int64_t first, int64_t candidates, int64_t each, uint32_t draws) {
  const stage s = {of, first, each, draws};
  carom_crew_work(of->crew, play_rows, &s, (size_t)(candidates * each), UNIT);
}

static bool is_stopped(const plan *of) {
  return of->options.stop != NULL && *of->options.stop != 0;
}

/* ---- Candidates */

static void add(plan *of, candidate c) {
  if (of->count < of->most) {
    c.order = (int32_t)of->count;
    of->found[of->count++] = c;
  }
}

/* The direction, degrees, in which a ball leaves that is struck in the direction 0. */
static double squirt_of(const carom_cue *cue, const carom_ball_kind *kind) {
  carom_cue along = *cue;
  carom_motion motion;
  along.phi = 0.0;
  return carom_strike(&along, kind, &motion) < 0
             ? 0.0
             : carom_angle_of(motion.v[0], motion.v[1]) / degree;
}

/* Turns cue->phi until ball k, hit by the cue ball, goes in the direction psi, rad. False where
 * it cannot be hit. */
static bool aim(const carom_table *table, const carom_shot_ball *balls, int k, double psi,
                const carom_shot_options *shot, carom_cue *cue) {
  enum { STEPS = 3 };
  carom_shot_ball pair[2] = {balls[cue->ball], balls[k]};
  carom_ball_state final[2];
  carom_shot_options options = *shot;
  options.stop_at = CAROM_STOP_AT_CONTACT;
  options.first_of = 0;
  carom_cue alone = *cue;
  alone.ball = 0;
  const double both = pair[0].kind.radius + pair[1].kind.radius, *c = pair[0].state.r,
               *o = pair[1].state.r;
  const double squirt = squirt_of(&alone, &pair[0].kind);
  double to = psi;
  for (int step = 0; step < STEPS; step++) {
    double sine, cosine;
    carom_sincos(to, &sine, &cosine);
    alone.phi =
        carom_angle_of(o[0] - both * cosine - c[0], o[1] - both * sine - c[1]) / degree - squirt;

    /* throw turns the ball away from the line of centres */
    carom_shot played = {.final = final};
    if (carom_shoot(table, pair, 2, &alone, &options, &played) != CAROM_STOPPED_AT_EVENT)
      return false;
    const double *v = final[1].v;
    if (!(v[0] * v[0] + v[1] * v[1] > 4e-4))
      return false;
    double off = psi - carom_angle_of(v[0], v[1]);
    off += off > 180.0 * degree ? -360.0 * degree : off < -180.0 * degree ? 360.0 * degree : 0.0;
    to += off;
  }
  cue->phi = alone.phi < 0.0 ? alone.phi + 360.0 : alone.phi;
  return true;
}

/* Aims the candidates: from the direction of the ball that falls to that of the stroke; whether
 * that can be done is their outcome. */
static size_t aim_rows(const void *context, size_t first, size_t end) {
  const plan *of = context;
  for (size_t k = first; k < end; k++) {
    candidate *c = &of->found[k];
    carom_cue cue = *of->job.cue;
    cue.theta = 0.0;
    cue.speed = c->speed;
    cue.a = c->a;
    cue.b = c->b;
    of->outcome[k] =
        (outcome){.is = aim(of->job.table, of->job.balls, c->ball, c->phi, &of->shot, &cue)};
    c->phi = cue.phi;
  }
  return end;
}

/* Direct pots, the likeliest first, each with all strokes, or as many as there is room for. */
static void add_pots(plan *of, int64_t most) {
  pot *way = of->pot;
  int ways = 0;
  for (int k = 0; k < of->view.count; k++)
    of->state[k] = of->job.balls[k].state;
  for (int k = 0; k < of->view.count; k++)
    for (int p = 0; p < of->view.pockets && (of->on >> k & 1); p++) {
      if (!(of->pockets >> p & 1))
        continue;
      const carom_way w = carom_way_of(&of->view, of->state, of->in_play, k, p, 0, false, 0.03);
      if (w.chance == 0.0)
        continue;
      int at = ways++; /* sorted in */
      for (; at > 0 && way[at - 1].way.chance < w.chance; at--)
        way[at] = way[at - 1];
      way[at].way = w;
      way[at].ball = k;
      way[at].pocket = p;
    }

  /* The strokes in an order that is drawn, so that few of them are of all kinds. */
  int order[STROKES];
  for (int n = 0; n < STROKES; n++) {
    const int other =
        (int)(carom_uniform(of->options.seed, DRAW_STROKES, (uint64_t)n, 0) * (n + 1));
    order[n] = order[other];
    order[other] = n;
  }
  const int64_t fit = most / STROKES > 4 ? most / STROKES : 4;
  ways = ways > fit ? (int)fit : ways;
  const int64_t share = ways > 0 ? most / ways : 0, strokes = share > STROKES ? STROKES
                                                              : share < 3     ? 3
                                                                              : share;
  for (int w = 0; w < ways; w++)
    for (int n = 0; n < strokes; n++) {
      const double *tip = pot_tip[order[n] % TIPS];
      const double speed = pot_speed[order[n] / TIPS];
      add(of, (candidate){.speed = within(speed, of->player.speed_least, of->player.speed_most),
                          .phi = way[w].way.psi,
                          .a = within(tip[0], -of->player.tip_most, of->player.tip_most),
                          .b = within(tip[1], -of->player.tip_most, of->player.tip_most),
                          .kind = CAROM_PLAN_POT,
                          .ball = way[w].ball});
    }

  /* those that cannot be aimed are dropped */
  carom_crew_work(of->crew, aim_rows, of, (size_t)of->count, UNIT);
  const int64_t added = of->count;
  of->count = 0;
  for (int64_t k = 0; k < added; k++)
    if (of->outcome[k].is)
      add(of, of->found[k]);
}

/* What a shot without errors says of a candidate. */
static void take(candidate *c, const outcome *o) {
  c->sum = o->worth;
  c->seen = 1;
  c->ball = o->ball;
  c->pocket = o->pocket;
  c->cushions = o->cushions;
  c->foul = o->foul;
}

/* Strokes in all directions, of which those stay that meet a ball first that is on; up to
 * `most`. The directions follow the golden ratio, so that however many are tried, they are
 * spread evenly. */
static void add_scan(plan *of, int64_t most) {
  const int64_t block = most / 2 > 16 ? most / 2 : 16, end = of->count + most;
  const int64_t tries = 4 * most;
  const double begin = carom_uniform(of->options.seed, DRAW_SCAN, 0, 0);
  for (int64_t from = 0; from < tries && of->count < end && !is_stopped(of); from += block) {
    const int64_t first = of->count;
    for (int64_t k = from; k < from + block && of->count < of->most; k++) {
      double turn = begin + 0.61803398874989485 * (double)k;
      turn -= floor(turn);
      const int speed =
          (int)(SCAN_SPEEDS * carom_uniform(of->options.seed, DRAW_SCAN, (uint64_t)k + 1, 0));
      const double *tip =
          scan_tip[(int)(TIPS * carom_uniform(of->options.seed, DRAW_SCAN, (uint64_t)k + 1, 1))];
      add(of, (candidate){
                  .speed = within(scan_speed[speed], of->player.speed_least, of->player.speed_most),
                  .phi = 360.0 * turn,
                  .a = within(tip[0], -of->player.tip_most, of->player.tip_most),
                  .b = within(tip[1], -of->player.tip_most, of->player.tip_most),
                  .kind = (of->may & CAROM_MAY_PUSH) && k % 2 == 1 ? CAROM_PLAN_PUSH
                                                                   : CAROM_PLAN_SCAN});
    }
    const int64_t added = of->count - first;
    play(of, first, added, 1, 0);

    /* those that begin with a foul are dropped, and those beyond `most` */
    of->count = first;
    for (int64_t k = 0; k < added && of->count < end; k++)
      if (of->found[first + k].kind == CAROM_PLAN_PUSH || begins_well(of, of->outcome[k].first)) {
        candidate c = of->found[first + k];
        take(&c, &of->outcome[k]);
        add(of, c);
      }
  }
}

/* ---- The choice */

static bool is_better(const candidate *a, const candidate *b) {
  if (a->round != b->round)
    return a->round > b->round;
  const double of_a = a->sum / (double)a->seen, of_b = b->sum / (double)b->seen;
  return of_a > of_b || (of_a == of_b && a->order < b->order);
}

/* Shell's method, without memory. The order is total, so that it does not matter how it is
 * found. */
static void sort(candidate *c, int64_t n) {
  for (int64_t gap = n / 2; gap > 0; gap = gap == 2 ? 1 : (gap * 5) / 11)
    for (int64_t k = gap; k < n; k++) {
      const candidate moved = c[k];
      int64_t at = k;
      for (; at >= gap && is_better(&moved, &c[at - gap]); at -= gap)
        c[at] = c[at - gap];
      c[at] = moved;
    }
}

/* Plays the first n candidates `each` times with the errors of a round, and adds up what they
 * are worth. */
static void add_up(plan *of, int64_t n, int64_t each, uint32_t draws) {
  play(of, 0, n, each, draws);
  for (int64_t k = 0; k < n; k++) {
    candidate *c = &of->found[k];
    if (c->round == 0) { /* the shot without errors is forgotten */
      c->sum = c->squares = 0.0;
      c->seen = c->foul = 0;
    }
    for (int64_t j = 0; j < each; j++) {
      const outcome *o = &of->outcome[k * each + j];
      c->sum += o->worth;
      c->squares += o->worth * o->worth;
      c->keep += o->is == CAROM_TURN_KEEP || o->is == CAROM_TURN_WIN;
      c->lose += o->is == CAROM_TURN_LOSE;
      c->foul += o->foul;
    }
    c->seen += each;
    c->round++;
  }
}

/* The candidates of the first round: the best `keep`, of which pots come first, and a third of
 * `keep` of the scan. */
static int64_t first_round(plan *of, int64_t keep) {
  const int64_t n = of->count < keep ? of->count : keep;
  int64_t scanned = 0, good = 0;
  for (int64_t k = 0; k < n; k++) {
    candidate *c = &of->found[k];
    const bool stays = c->kind == CAROM_PLAN_POT || scanned++ < (keep / 3 > 3 ? keep / 3 : 3);
    if (stays) {
      const candidate kept = *c;
      for (int64_t at = k; at > good; at--)
        of->found[at] = of->found[at - 1];
      of->found[good++] = kept;
    }
  }
  return good;
}

static void halve(plan *of, int64_t shots) {
  sort(of->found, of->count);
  const int64_t keep = shots / 25 > 6 ? shots / 25 : 6,
                left = shots - of->count > 0 ? shots - of->count : 0;
  for (int round = 0; round < ROUNDS && !is_stopped(of); round++) {
    int64_t n = keep >> (2 * round);
    n = n < 2 ? 2 : n;
    n = round == 0 ? first_round(of, n) : n < of->count ? n : of->count;
    int64_t each = left / ROUNDS / n;
    each = each < 2 ? 2 : each;
    if (each * n > of->room)
      each = of->room / n;
    add_up(of, n, each, DRAW_ROUND + (uint32_t)round);
    sort(of->found, of->count);
  }
}

/* A gentle stroke towards the nearest ball that is on: nothing better is known. */
static candidate gentle(const plan *of) {
  const double *c = of->job.balls[of->view.cue_ball].state.r;
  double least = INFINITY, phi = 0.0;
  for (int k = 0; k < of->view.count; k++) {
    const double x = of->job.balls[k].state.r[0] - c[0], y = of->job.balls[k].state.r[1] - c[1];
    if ((of->on >> k & 1) && x * x + y * y < least) {
      least = x * x + y * y;
      phi = carom_angle_of(x, y) / degree;
    }
  }
  return (candidate){.speed = of->player.speed_least,
                     .phi = phi < 0.0 ? phi + 360.0 : phi,
                     .kind = CAROM_PLAN_FOUL,
                     .ball = -1,
                     .pocket = -1};
}

static carom_choice choice_of(const plan *of, const candidate *c) {
  const double n = (double)c->seen, mean = c->sum / n, variance = c->squares / n - mean * mean;
  const double *place = of->job.balls[of->view.cue_ball].state.r;
  carom_choice made = {.cue = *of->job.cue,
                       .place = {place[0], place[1]},
                       .kind = c->kind,
                       .ball = c->ball,
                       .pocket = c->pocket,
                       .cushions = c->cushions,
                       .value = mean,
                       .error = c->seen > 1 && variance > 0.0 ? sqrt(variance / (n - 1.0)) : 0.0,
                       .keep = (double)c->keep / n,
                       .foul = (double)c->foul / n,
                       .lose = (double)c->lose / n,
                       .seen = c->round > 0 && c->kind != CAROM_PLAN_PASS ? c->seen : 0};
  made.cue.speed = c->speed;
  made.cue.phi = c->phi;
  made.cue.theta = c->theta;
  made.cue.a = c->a;
  made.cue.b = c->b;
  return made;
}

/* ---- Arguments */

static const carom_plan_options no_options = {0};
static const carom_shot_options no_shot = {0};
enum { SHOTS_USUAL = 2000, SHOTS_LEAST = 100, SHOTS_MOST = 1000000, SPARE = 160 };
enum { PLAYER_MOST = 1000 }; /* of each number of a player */

static bool good_options(const carom_plan_options *o) {
  bool reserved = o->unused != 0;
  for (size_t k = 0; k < sizeof o->reserved / sizeof o->reserved[0]; k++)
    reserved |= o->reserved[k] != 0;
  return !reserved && (o->shots == 0 || (o->shots >= SHOTS_LEAST && o->shots <= SHOTS_MOST)) &&
         o->scan <= 0.9 && (o->threads >= 0 || o->threads == CAROM_ALL_THREADS) &&
         o->chance_me >= 0.0 && o->chance_me <= 1.0 && o->chance_opponent >= 0.0 &&
         o->chance_opponent <= 1.0;
}

static bool good_player(const carom_player *p) {
  const double numbers[] = {p->speed, p->speed_share, p->phi,        p->theta,   p->a,
                            p->b,     p->speed_least, p->speed_most, p->tip_most};
  bool good = p->tip_most <= 1.0 && (p->speed_most == 0.0 || p->speed_most >= p->speed_least);
  for (size_t k = 0; k < sizeof numbers / sizeof numbers[0]; k++)
    good &= numbers[k] >= 0.0 && numbers[k] <= PLAYER_MOST;
  for (size_t k = 0; k < sizeof p->reserved / sizeof p->reserved[0]; k++)
    good &= p->reserved[k] == 0.0;
  return good;
}

static int64_t shots_of(const carom_plan_options *o) {
  return o->shots > 0 ? o->shots : SHOTS_USUAL;
}
static double scan_of(const carom_plan_options *o) {
  return o->scan == 0.0 ? 0.5 : o->scan > 0.0 ? o->scan : 0.0;
}

/* Pots, the shots that the scan keeps, half as many again that it tries, and room for small
 * numbers. */
static int64_t most_candidates(int64_t shots, double scan) {
  return (int64_t)((1.0 - scan) * (double)shots / 4.0) + (int64_t)(1.5 * scan * (double)shots) +
         SPARE;
}

/* Rows of the largest stage. */
static int64_t most_rows(int64_t shots, double scan) {
  return shots + most_candidates(shots, scan);
}

static size_t bytes_of(int64_t shots, double scan) {
  const size_t rows = (size_t)most_rows(shots, scan);
  return sizeof(plan) + (size_t)most_candidates(shots, scan) * sizeof(candidate) +
         rows * sizeof(outcome);
}

size_t carom_plan_memory(const carom_plan_options *options) {
  const carom_plan_options *o = options != NULL ? options : &no_options;
  return good_options(o) ? bytes_of(shots_of(o), scan_of(o)) : 0;
}

/* Where a plan is in the caller's memory; NULL where there is too little of it, or nothing to
 * plan. */
static plan *place(const carom_plan_job *job) {
  const bool room =
      job != NULL && job->memory != NULL && job->memory_size >= carom_plan_memory(job->options);
  return room ? job->memory : NULL;
}

/* Checks the cue of a job with the stroke of another one. A speed of 0 is raised later by the
 * bounds of the player, so the rest of the cue counts. */
static carom_status check_stroke(const carom_plan_job *job, const carom_cue *stroke) {
  carom_cue cue = *job->cue;
  cue.speed = stroke->speed == 0.0 ? 1.0 : stroke->speed;
  cue.phi = stroke->phi;
  cue.theta = stroke->theta;
  cue.a = stroke->a;
  cue.b = stroke->b;
  return carom_check_strike(carom_layout_of(job->balls), (int)job->count, &cue);
}

/* Whether all balls are at rest or out of play, but the one in hand (-1: none). */
static bool is_at_rest(const plan *of, const carom_shot_ball *balls, int in_hand) {
  bool rests = true;
  for (int k = 0; k < (int)of->job.count; k++) {
    carom_ball_state s = balls[k].state;
    const int64_t label = carom_label_of_layout(&s, balls[k].kind.radius);
    rests &= k == in_hand || label == CAROM_BALL_STATIONARY || carom_is_out(label);
  }
  return rests;
}

/* Once for all shots of a plan; with_cue: and its cue, whose stroke is not looked at. */
static carom_status check_layout(plan *of, const carom_shot_ball *balls, bool with_cue) {
  int where;
  const int count = (int)of->job.count;
  const carom_status bad = carom_check_layout(of->job.table, &of->features, carom_layout_of(balls),
                                              count, &of->shot, &where);
  if (bad != CAROM_OK || !with_cue)
    return bad;
  const carom_plan_job job = {.balls = balls, .count = count, .cue = of->job.cue};
  return check_stroke(&job, &(carom_cue){0});
}

/* Checks the arguments, and makes all of a plan but its candidates. */
static carom_status begin(plan *of, const carom_plan_job *job, bool in_hand) {
  if (job == NULL || job->table == NULL || job->balls == NULL || job->cue == NULL ||
      job->player == NULL || job->rules == NULL)
    return CAROM_ERROR_NULL;
  const carom_plan_options *options = job->options != NULL ? job->options : &no_options;
  const carom_plan_rules *rules = job->rules;
  bool good = good_options(options) && good_player(job->player) &&
              (options->opponent == NULL || good_player(options->opponent)) && rules->on != NULL &&
              rules->judge != NULL && rules->left != NULL && rules->unused == 0 &&
              (uint32_t)rules->race <= CAROM_RACE_ALONE;
  for (size_t k = 0; k < sizeof job->reserved / sizeof job->reserved[0]; k++)
    good &= job->reserved[k] == 0;
  if (!good)
    return CAROM_ERROR_OPTIONS;
  if (job->count < 2 || job->count > CAROM_BALLS_MOST)
    return CAROM_ERROR_BALLS;

  /* The options of its shots are not those of when to stop. */
  of->job = *job;
  of->options = *options;
  of->player = carom_player_bounded(job->player);
  of->shot = job->shot != NULL ? *job->shot : no_shot;
  of->shot.threads = 0;
  of->shot.stop_at = 0;
  of->shot.first_of = 0;
  of->shot.time_most = 0.0;
  int where;
  carom_status bad = carom_check_common(job->table, job->count, &of->shot, &where);
  of->features.radius = 0.0;
  if (bad == CAROM_OK)
    bad = check_layout(of, job->balls, !in_hand); /* in hand its ball may be down */
  if (bad != CAROM_OK || job->cue->ball < 0 || job->cue->ball >= job->count)
    return bad != CAROM_OK ? bad : CAROM_ERROR_CUE_BALL;
  if (!is_at_rest(of, job->balls, in_hand ? (int)job->cue->ball : -1))
    return CAROM_ERROR_IN_MOTION;
  of->count = 0;
  of->most = most_candidates(shots_of(options), scan_of(options));
  of->room = most_rows(shots_of(options), scan_of(options));
  of->found = (candidate *)(of + 1);
  of->outcome = (outcome *)(of->found + of->most);

  /* The layout by the rules. */
  carom_view_make(&of->view, &of->job, options);
  for (int k = 0; k < job->count; k++)
    of->state[k] = job->balls[k].state;
  const int cue_ball = of->view.cue_ball;
  of->in_play = carom_in_play(of->state, of->view.count) | (in_hand ? UINT32_C(1) << cue_ball : 0);
  of->on = rules->on(rules->user, of->in_play) & of->in_play & ~(UINT32_C(1) << cue_ball);
  of->may = rules->may != NULL ? rules->may(rules->user) : 0;
  of->pockets = rules->pockets != NULL ? rules->pockets(rules->user) : ~UINT32_C(0);
  of->first_decides = rules->first_decides && !(of->may & CAROM_MAY_PUSH);
  lay_out(of, job->balls);
  int32_t left[2];
  rules->left(rules->user, of->in_play, left);
  of->left = left[0] > 1 ? left[0] : 1;

  /* A foul at the first contact leaves about the layout that there is. */
  uint64_t user[8];
  memcpy(user, rules->user, sizeof user);
  const carom_turn turn =
      rules->judge(user, of->in_play, cue_ball, &carom_no_facts, (carom_call){-1, -1});
  const bool hand = turn.leave == CAROM_LEAVE_HAND || turn.leave == CAROM_LEAVE_KITCHEN;
  of->foul_value = turn.is == CAROM_TURN_LOSE        ? 0.0
                   : rules->race == CAROM_RACE_ALONE ? 0.0
                   : turn.is == CAROM_TURN_KEEP
                       ? carom_value_of(&of->view, user, of->state, 0, hand)
                       : 1.0 - carom_value_of(&of->view, user, of->state, 1, hand);
  return CAROM_OK;
}

/* All stages with so many shots; the best candidate is the first. */
static void search(plan *of, int64_t shots) {
  of->count = 0;
  const double scan = scan_of(&of->options);
  add_pots(of, (int64_t)((1.0 - scan) * (double)shots / 4.0));
  play(of, 0, of->count, 1, 0);
  for (int64_t k = 0; k < of->count; k++)
    take(&of->found[k], &of->outcome[k]);
  if (scan > 0.0)
    add_scan(of, (int64_t)(scan * (double)shots));
  if (of->count == 0) {
    add(of, gentle(of));
    add_up(of, 1, shots / 10, DRAW_ROUND);
    return;
  }
  halve(of, shots);
}

/* Not to play, as one more candidate: its worth is that of the layout to the other. */
static void add_pass(plan *of) {
  uint64_t user[8];
  memcpy(user, of->job.rules->user, sizeof user);
  for (int k = 0; k < of->view.count; k++)
    of->state[k] = of->job.balls[k].state;
  const carom_call call = {CAROM_CALL_PASS, -1};
  of->job.rules->judge(user, of->in_play, of->view.cue_ball, &carom_no_facts, call);
  const double value = 1.0 - carom_value_of(&of->view, user, of->state, 1, false);
  add(of, (candidate){.sum = value,
                      .squares = value * value,
                      .seen = 1,
                      .kind = CAROM_PLAN_PASS,
                      .ball = CAROM_CALL_PASS,
                      .pocket = -1,
                      .round = of->found[0].round});
  of->found[of->count - 1].order = -1; /* of shots that are worth as much, none is played */
  sort(of->found, of->count);
}

/* ---- What callers have */

/* Does a part of a plan with the threads that the options ask for. */
typedef void plan_part(plan *of);
typedef struct part_of_plan {
  plan_part *part;
  plan *of;
} part_of_plan;

static void do_part(void *context, carom_crew *crew) {
  const part_of_plan *part = context;
  part->of->crew = crew;
  part->part(part->of);
}

static void with_crew(plan *of, plan_part *part) {
  part_of_plan context = {part, of};
  carom_with_crew(do_part, &context, of->options.threads, (size_t)of->room / UNIT);
}

static void plan_here(plan *of) {
  search(of, shots_of(&of->options));
  if (of->may & CAROM_MAY_PASS)
    add_pass(of);
}

/* Puts the cue ball in hand on the place k of those that are planned from. */
static void put(plan *of, int k) {
  const double *r = of->best_place[k].r;
  carom_place_ball(of->job.table, of->hand, (int)of->job.count, of->view.cue_ball, r[0], r[1],
                   NULL);
  lay_out(of, of->hand);
}

/* A small plan from each place, then one with half of the shots from the best. */
static void plan_places(plan *of) {
  const int64_t shots = shots_of(&of->options),
                small = shots / (2 * PLACES_PLANNED) > 100 ? shots / (2 * PLACES_PLANNED) : 100;
  const int64_t rest = shots - of->places * small;
  int chosen = 0;
  double most = -1.0;
  for (int k = 0; k <= of->places && !(k > 0 && is_stopped(of)); k++) {
    put(of, k < of->places ? k : chosen);
    search(of, k < of->places || rest < small ? small : rest);
    const candidate *c = &of->found[0];
    if (k < of->places && c->sum / (double)c->seen > most) {
      most = c->sum / (double)c->seen;
      chosen = k;
    }
  }
}

/* Strokes that the caller gave, each with its share of the shots. */
static void try_all(plan *of) {
  const int64_t each = shots_of(&of->options) / (of->tries > 0 ? of->tries : 1);
  for (int k = 0; k < of->tries; k++) {
    const carom_cue *cue = &of->cues[k];
    of->count = 0;
    add(of, (candidate){.speed = cue->speed,
                        .phi = cue->phi,
                        .theta = cue->theta,
                        .a = cue->a,
                        .b = cue->b,
                        .kind = CAROM_PLAN_GIVEN});
    play(of, 0, 1, 1, 0);
    take(&of->found[0], &of->outcome[0]);
    add_up(of, 1, each > 10 ? each : 10, DRAW_ROUND);
    of->choices[k] = choice_of(of, &of->found[0]);
  }
}

static int give(const plan *of, carom_choice *choices, int room) {
  int n = 0;
  for (; n < room && n < of->count; n++)
    choices[n] = choice_of(of, &of->found[n]);
  return n;
}

carom_status carom_plan(const carom_plan_job *job, carom_choice *choices, int room, int *found) {
  if (choices == NULL || found == NULL || room < 1)
    return CAROM_ERROR_NULL;
  plan *of = place(job);
  const carom_status bad = of == NULL ? CAROM_ERROR_NULL : begin(of, job, false);
  if (bad != CAROM_OK)
    return bad;
  with_crew(of, plan_here);
  *found = give(of, choices, room);
  return CAROM_OK;
}

carom_status carom_plan_hand(const carom_plan_job *job, const double low[2], const double high[2],
                             carom_choice *choices, int room, int *found) {
  if (choices == NULL || found == NULL || room < 1)
    return CAROM_ERROR_NULL;
  plan *of = place(job);
  const carom_status bad = of == NULL ? CAROM_ERROR_NULL : begin(of, job, true);
  if (bad != CAROM_OK)
    return bad;

  /* Places at random, of which the best by the value of the layout are kept. */
  carom_shot_ball *balls = of->hand;
  carom_ball_state *state = of->state;
  memcpy(balls, job->balls, (size_t)job->count * sizeof *balls);
  for (int k = 0; k < job->count; k++)
    state[k] = balls[k].state;
  const int cue_ball = of->view.cue_ball;
  const double R = of->view.radius[cue_ball], size[2] = {of->view.width, of->view.length};
  int tried = 0;
  of->places = 0;
  for (uint64_t k = 0; k < 50 * PLACES && tried < PLACES; k++) {
    double r[2];
    for (int x = 0; x < 2; x++) {
      /* an empty range, and one with NaN, has no place */
      const double least = low == NULL || low[x] <= R ? R : low[x];
      const double most = high == NULL || high[x] >= size[x] - R ? size[x] - R : high[x];
      if (!(least <= most))
        return CAROM_ERROR_OFF_TABLE;
      r[x] = least + (most - least) * carom_uniform(of->options.seed, DRAW_PLACES, k, (uint32_t)x);
    }
    if (carom_place_ball(job->table, balls, (int)job->count, cue_ball, r[0], r[1], NULL) !=
        CAROM_OK)
      continue;
    tried++;
    state[cue_ball] = balls[cue_ball].state;
    const double value = carom_value_of(&of->view, job->rules->user, state, 0, false);
    int at = of->places < PLACES_PLANNED ? of->places++ : PLACES_PLANNED;
    for (; at > 0 && of->best_place[at - 1].value < value; at--)
      of->best_place[at] = of->best_place[at - 1];
    of->best_place[at] = (place_in_hand){{r[0], r[1]}, value};
  }
  if (of->places == 0)
    return CAROM_ERROR_OFF_TABLE;

  of->job.balls = balls;
  put(of, 0);
  const carom_status refused = check_layout(of, balls, true);
  if (refused != CAROM_OK)
    return refused;
  with_crew(of, plan_places);
  *found = give(of, choices, room);
  return CAROM_OK;
}

carom_status carom_plan_try(const carom_plan_job *job, const carom_cue *cues, int n,
                            carom_choice *choices) {
  enum { MOST = 1000 };
  if (choices == NULL || cues == NULL)
    return CAROM_ERROR_NULL;
  plan *of = place(job);
  const carom_status bad = of == NULL          ? CAROM_ERROR_NULL
                           : n < 0 || n > MOST ? CAROM_ERROR_OPTIONS
                                               : begin(of, job, false);
  if (bad != CAROM_OK)
    return bad;
  for (int k = 0; k < n; k++) {
    const carom_status wrong = check_stroke(&of->job, &cues[k]);
    if (wrong != CAROM_OK)
      return wrong;
  }
  of->cues = cues;
  of->choices = choices;
  of->tries = n;
  with_crew(of, try_all);
  return CAROM_OK;
}

carom_status carom_plan_value(const carom_plan_job *job, int in_hand, double *value) {
  if (value == NULL)
    return CAROM_ERROR_NULL;
  plan of;
  const carom_status bad = begin(&of, job, in_hand != 0);
  if (bad != CAROM_OK)
    return bad;
  const double found = carom_value_of(&of.view, job->rules->user, of.state, 0, in_hand != 0);
  *value =
      job->rules->race == CAROM_RACE_ALONE && job->rules->value == NULL ? share(&of, found) : found;
  return CAROM_OK;
}
