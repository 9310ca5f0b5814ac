/* The kind of a stroke, and its name: pot_kind.h has the order of precedence. */
#include "pot_kind.h"
#include "platform/arithmetic.h"

#include <math.h>
#include <stddef.h>

/* Contacts with two balls so near in time are a split hit, s: a film of 1000 pictures a second
 * does not show which ball was met first. */
static const double SPLIT = 1e-3;

/* ---- The terms */

/* The terms beyond the kinds. */
enum { SCRATCH = CAROM_PLAN_KINDS, DOUBLE_HIT, SPLIT_HIT, LEGAL_BREAK, FIRST_BALL, TERMS };

static const carom_term terms[TERMS] = {
    /* the kinds of a stroke that pots a ball, in their order of precedence */
    [CAROM_PLAN_COMBINATION] = {"combination",
                                "Another object ball drives the ball into the pocket."},
    [CAROM_PLAN_CAROM] = {"carom", "The cue ball glances off another ball before it drives the "
                                   "ball into the pocket. On a table without pockets, the cue "
                                   "ball meets two balls."},
    [CAROM_PLAN_KISS] = {"kiss", "The cue ball drives the ball, which glances off another ball "
                                 "before it falls."},
    [CAROM_PLAN_KICK] = {"kick", "The cue ball meets a cushion before it meets any ball."},
    [CAROM_PLAN_RAIL_FIRST] = {"rail first",
                               "The cue ball meets the cushion next to its first ball, and then "
                               "that ball. Between the two there is no room for the cue ball."},
    [CAROM_PLAN_BANK] = {"bank",
                         "The cue ball drives the ball, which meets a cushion before it "
                         "falls. A cushion next to the pocket does not count, nor does one that "
                         "the ball touches from the start."},
    [CAROM_PLAN_POT] = {"pot", "The ball falls. As the kind of a stroke, the pot is direct: the "
                               "cue ball meets the ball first, and the ball meets nothing else on "
                               "its way except a cushion next to the pocket."},

    /* the other kinds of a stroke */
    [CAROM_PLAN_SAFETY] = {"safety", "A stroke that names no ball to pot, and leaves the opponent "
                                     "a hard layout."},
    [CAROM_PLAN_BREAK] = {"break", "The first stroke of a rack. In snooker, also "
                                   "the points that a player scores in one visit."},
    [CAROM_PLAN_PUSH] = {"push-out", "A stroke after the break of nine-ball and ten-ball that may "
                                     "meet any ball or none. The opponent then chooses who plays."},
    [CAROM_PLAN_PASS] = {"pass", "The player leaves the stroke to the opponent, where the rules "
                                 "allow it."},
    [CAROM_PLAN_FOUL] = {"foul", "A stroke that breaks a rule. It ends the visit, and the rules of "
                                 "the game state the penalty."},

    /* values of a plan that are no terms of the game */
    [CAROM_PLAN_SCAN] = {"scan", ""},
    [CAROM_PLAN_GIVEN] = {"given", ""},

    /* what else a stroke can be */
    [SCRATCH] = {"scratch", "The cue ball falls into a pocket."},
    [DOUBLE_HIT] = {"double hit",
                    "The tip touches the cue ball twice, or the cue ball meets a ball that was not "
                    "frozen to it while the tip is still on it."},
    [SPLIT_HIT] = {"split hit", "The cue ball meets two balls first, less than 1 ms apart."},
    [LEGAL_BREAK] = {"legal break",
                     "A break that pots a ball, or drives at least four object balls to cushions."},
    [FIRST_BALL] = {"first ball",
                    "The ball that the cue ball meets first. Most games name the balls that it may "
                    "be."},
};

const carom_term *carom_term_of(int k) {
  if (k < 0 || k >= TERMS)
    return NULL;
  return &terms[k];
}

/* ---- What a shot shows in addition to its pots */

bool carom_is_double_hit(const carom_facts *facts) {
  const bool is_repeated = facts->touches > 1 && (facts->pushed == 0 || facts->second_time > 0.0);
  return is_repeated || (facts->pushed & ~facts->frozen) != 0;
}

int carom_driven(const carom_facts *facts, int cue_ball) {
  int driven = 0;
  for (int k = 0; k < CAROM_BALLS_MOST; k++) {
    const bool gone = ((facts->down | facts->off) >> k & 1) != 0;
    if (k != cue_ball && (facts->cushions[k] > 0 || gone))
      driven++;
  }
  return driven;
}

bool carom_is_break(const carom_facts *facts, int cue_ball) {
  return (facts->down & ~(UINT32_C(1) << cue_ball)) != 0 || carom_driven(facts, cue_ball) >= 4;
}

uint32_t carom_stroke_marks(const carom_facts *facts, int cue_ball) {
  uint32_t marks = 0;
  if (facts == NULL || cue_ball < 0 || cue_ball >= CAROM_BALLS_MOST)
    return marks;
  if ((facts->down >> cue_ball & 1) != 0)
    marks |= CAROM_MARK_SCRATCH;
  if (carom_is_double_hit(facts))
    marks |= CAROM_MARK_DOUBLE_HIT;
  if (facts->first[1] >= 0 && facts->first_time[1] - facts->first_time[0] < SPLIT)
    marks |= CAROM_MARK_SPLIT_HIT;
  if (carom_is_break(facts, cue_ball))
    marks |= CAROM_MARK_LEGAL_BREAK;
  return marks;
}

/* ---- The kind of a pot */

int32_t carom_approach_kind(const carom_facts *facts) {
  switch ((carom_approach)facts->approach) {
  case CAROM_APPROACH_KICK:
    return CAROM_PLAN_KICK;
  case CAROM_APPROACH_RAIL_FIRST:
    return CAROM_PLAN_RAIL_FIRST;
  default:
    return CAROM_PLAN_POT;
  }
}

/* Event k of a shot, from whichever of its lists is kept. */
static carom_brief_event event_of(const carom_shot *shot, int64_t k) {
  if (shot->brief != NULL)
    return shot->brief[k];
  const carom_event *e = &shot->events[k];
  return (carom_brief_event){.time = e->time, .type = e->type, .a = e->a, .b = e->b};
}

/* The ball that a ball meets in an event, or -1. */
static int met_by(const carom_brief_event *e, int ball) {
  if (e->type != CAROM_EVENT_BALL_BALL)
    return -1;
  if (e->a == ball)
    return e->b;
  if (e->b == ball)
    return e->a;
  return -1;
}

/* The index of the event in which a ball falls into a pocket, or -1. */
static int64_t fall_of(const carom_shot *shot, int ball, int pocket) {
  for (int64_t k = 0; k < shot->count && k < shot->room; k++) {
    const carom_brief_event e = event_of(shot, k);
    if (e.type == CAROM_EVENT_POCKET && e.a == ball && e.b == pocket)
      return k;
  }
  return -1;
}

/* The ball whose contact drives a ball first, or -1, and when; of one instant the cue ball. */
static int driver_of(const carom_shot *shot, int64_t end, int cue_ball, int ball, double *time) {
  int driver = -1;
  *time = INFINITY;
  for (int64_t k = 0; k < end; k++) {
    const carom_brief_event e = event_of(shot, k);
    const int partner = met_by(&e, ball);
    if (partner < 0)
      continue;
    if (driver < 0 || (e.time == *time && partner == cue_ball)) {
      driver = partner;
      *time = e.time;
    }
  }
  return driver;
}

int32_t carom_pot_kind(const carom_shot *shot, int cue_ball, int ball, int pocket) {
  if (shot == NULL || shot->facts == NULL || (shot->brief == NULL && shot->events == NULL))
    return -1;
  double time;
  const int64_t end = fall_of(shot, ball, pocket);
  const int driver = driver_of(shot, end, cue_ball, ball, &time);
  if (driver < 0)
    return -1;
  if (driver != cue_ball)
    return CAROM_PLAN_COMBINATION;

  /* other balls that the cue ball meets before the ball, and the ball on its way */
  bool kisses = false;
  for (int64_t k = 0; k < end; k++) {
    const carom_brief_event e = event_of(shot, k);
    const int by_cue = met_by(&e, cue_ball), by_ball = met_by(&e, ball);
    if (e.time <= time && by_cue >= 0 && by_cue != ball)
      return CAROM_PLAN_CAROM;
    kisses |= e.time >= time && by_ball >= 0 && by_ball != cue_ball;
  }

  const int32_t approach = carom_approach_kind(shot->facts);
  if (kisses)
    return CAROM_PLAN_KISS;
  if (approach == CAROM_PLAN_POT && (shot->facts->banked >> ball & 1) != 0)
    return CAROM_PLAN_BANK;
  return approach;
}
