/* Candidates: direct pots, with six speeds and five positions of the tip, aimed by shots of two
 * balls that stop at the contact; and strokes in all directions, of which those stay that meet a
 * ball first that is on. */
#include "candidates.h"

#include "miss.h"
#include "places.h"
#include "platform/elementary.h"
#include "platform/promise.h"
#include "random_draws.h"
#include "ranking.h"
#include "rows.h"
#include "stick.h"
#include "table/marks.h"

#include <math.h>

typedef carom_candidate candidate;
typedef carom_outcome outcome;

enum { TIPS = 5, POT_SPEEDS = 6, SCAN_SPEEDS = 5, STROKES = TIPS * POT_SPEEDS };
/* m/s of a cue whose tip loses nothing, and radii, from the prototype */
static const double pot_speed[POT_SPEEDS] = {0.8, 1.2, 1.7, 2.4, 3.4, 4.8};
static const double pot_tip[TIPS][2] = {
    {0.0, 0.0}, {0.0, 0.35}, {0.0, -0.35}, {0.3, 0.0}, {-0.3, 0.0}};
static const double scan_speed[SCAN_SPEEDS] = {1.0, 1.8, 3.0, 5.0, 7.5};
static const double scan_tip[TIPS][2] = {
    {0.0, 0.0}, {0.0, 0.3}, {0.0, -0.3}, {0.25, 0.0}, {-0.25, 0.0}};

/* Keeps a stroke within what the player can do. */
static void bound(const carom_search *search, candidate *c) {
  const carom_player *player = &search->player;
  double most = player->speed_most;
  if (player->growth > 0.0 && !search->breaks) /* a player with larger errors of speed strikes
                                                  calmly */
    most *= 0.5;
  c->speed = carom_within(c->speed, player->speed_least, fmax(most, player->speed_least));
  c->a = carom_within(c->a, -player->tip_most, player->tip_most);
  c->b = carom_within(c->b, -player->tip_most, player->tip_most);
}

/* The least elevation of a candidate's stick, or none by a level cue, degrees. */
static double raised(const carom_search *search, const candidate *c) {
  const carom_cue cue = {.phi = c->phi, .a = c->a, .b = c->b, .ball = search->cue_ball};
  if (search->options.level)
    return 0.0;
  return carom_least_elevation(search->job.table, search->played, (int)search->plays, &cue);
}

/* To raise a stick and to aim take as long as so many events of a shot. */
enum { RAISE_COST = 4, AIM_COST = 4 };

/* The elevation is the least of the stick, but where the caller gave it, or an aim did. A gentle
 * stroke is added whatever that is. */
void carom_search_add(carom_search *search, candidate c) {
  const double *r = search->played[search->cue_ball].state.r;
  c.r[0] = r[0];
  c.r[1] = r[1];
  const bool is_fixed = c.kind == CAROM_PLAN_GIVEN || c.kind == CAROM_PLAN_PASS;
  if (!is_fixed)
    bound(search, &c);
  if (!is_fixed && c.kind != CAROM_PLAN_POT) {
    c.theta = raised(search, &c);
    carom_search_spend(search, RAISE_COST);
  }
  const bool played = is_fixed || c.kind == CAROM_PLAN_FOUL || c.theta <= STICK_MOST;
  if (search->count < search->most && played) {
    c.order = (int32_t)search->count;
    search->found[search->count++] = c;
  }
}

/* The direction, degrees, in which a ball leaves that is struck in the direction 0. */
static double squirt_of(const carom_cue *cue, const carom_ball_kind *kind) {
  carom_cue along = *cue;
  carom_motion motion;
  along.phi = 0.0;
  if (carom_strike(&along, kind, &motion) < 0)
    return 0.0;
  return carom_angle_of(motion.v[0], motion.v[1]) / degree;
}

/* Turns a candidate until the ball that it aims at, hit by the cue ball, goes in its direction phi,
 * degrees, with the cue raised as it has to be. False where it cannot be hit. */
static bool aim(const carom_search *search, candidate *c) {
  enum { STEPS = 3 };
  const carom_shot_ball *balls = search->job.balls;
  carom_shot_ball pair[2] = {search->played[search->cue_ball], balls[c->aimed_ball]};
  carom_ball_state final[2];
  carom_shot_options options = search->shot;
  options.stop_at = CAROM_STOP_AT_CONTACT;
  options.first_of = 0;
  carom_cue alone = *search->job.cue;
  alone.ball = 0;
  alone.theta = 0.0;
  alone.speed = c->speed;
  alone.a = c->a;
  alone.b = c->b;
  const double both = pair[0].kind.radius + pair[1].kind.radius, *r = pair[0].state.r,
               *o = pair[1].state.r;
  const double squirt = squirt_of(&alone, &pair[0].kind), psi = c->phi * degree;
  double direction = psi;
  for (int step = 0; step < STEPS; step++) {
    double sine, cosine;
    carom_sincos(direction, &sine, &cosine);
    alone.phi =
        carom_angle_of(o[0] - both * cosine - r[0], o[1] - both * sine - r[1]) / degree - squirt;
    c->phi = alone.phi;
    c->theta = alone.theta = raised(search, c);
    if (c->theta > STICK_MOST)
      return false;

    /* throw turns the ball away from the line of centres */
    carom_shot played = {.final = final};
    if (carom_shoot(search->job.table, pair, 2, &alone, &options, &played) !=
        CAROM_STOPPED_AT_EVENT)
      return false;
    const double *v = final[1].v;
    if (!(v[0] * v[0] + v[1] * v[1] > 4e-4))
      return false;
    double off = psi - carom_angle_of(v[0], v[1]);
    double back = 0.0;
    if (off > 180.0 * degree)
      back = -360.0 * degree;
    else if (off < -180.0 * degree)
      back = 360.0 * degree;
    off += back;
    direction += off;
  }
  c->phi = carom_turned(c->phi);
  return true;
}

/* Aims the candidates; whether that can be done is their outcome. */
static size_t aim_rows(const void *context, size_t first, size_t end) {
  const carom_search *search = context;
  for (size_t k = first; k < end; k++) {
    const int64_t row = search->stage.done + (int64_t)k;
    if (row > 0 && carom_is_stopped(search))
      return k;
    const int turn = aim(search, &search->found[search->stage.first + row]);
    search->outcome[row] = (outcome){.turn = (int8_t)turn, .events = AIM_COST};
  }
  return end;
}

/* Changes one number of a stroke, to more or to less: the speed, a position of the tip, or the
 * direction by one of two steps. */
static void step_aside(candidate *c, int number, bool more) {
  enum { SPEED, SIDE, HEIGHT, DIRECTION };
  static const double faster = 1.2, farther = 0.15; /* radii */
  static const double turned[2] = {0.4, 0.13};      /* degrees */
  double sign = -1.0;
  if (more)
    sign = 1.0;
  if (number == SPEED && more)
    c->speed *= faster;
  else if (number == SPEED)
    c->speed /= faster;
  else if (number == SIDE)
    c->a += sign * farther;
  else if (number == HEIGHT)
    c->b += sign * farther;
  else
    c->phi = carom_turned(c->phi + sign * turned[number - DIRECTION]);
}

/* Moves the cue ball in hand to one of four sides. */
static void move_aside(candidate *c, int side) {
  static const double offset[4][2] = {{-0.03, 0.0}, {0.03, 0.0}, {0.0, -0.03}, {0.0, 0.03}}; /* m */
  c->r[0] += offset[side][0];
  c->r[1] += offset[side][1];
}

/* Whether a stroke that is steered is next to one that was. */
static bool is_known(const carom_search *search, const candidate *c) {
  static const double apart = 0.3; /* degrees */
  for (int64_t k = 0; k < search->count; k++) {
    const candidate *other = &search->found[k];
    if (other->miss.slope != 0.0f && other->speed == c->speed && other->a == c->a &&
        other->b == c->b && fabs(other->phi - c->phi) < apart)
      return true;
  }
  return false;
}

/* Strokes near the best `parents` ones, between those of the grid: one of speed, both positions of
 * the tip and, where nothing is aimed, the direction changed at a time, and pots aimed anew.
 * carom-lab plan --racks 1000 --shots 1000 runs out 761 racks with them, 740 without; half of these
 * steps, and 1.5 times them, could not be distinguished from them. */
void carom_search_near(carom_search *search, int64_t parents) {
  enum { POT_WAYS = 6, WAYS = 10, PLACE_WAYS = 4 };
  const int64_t first = search->count;
  int places = 0;
  if (search->places > 0 && !search->breaks)
    places = PLACE_WAYS;
  for (int64_t k = 0; k < parents; k++) {
    const bool pot = search->found[k].kind == CAROM_PLAN_POT;
    if (!pot && search->found[k].kind != CAROM_PLAN_SCAN)
      continue;
    const float slope = search->found[k].miss.slope;
    const bool steered = search->found[k].pots != 0 && slope != 0.0f && isfinite(slope);
    int strokes = WAYS;
    if (pot || steered)
      strokes = POT_WAYS;
    for (int way = 0; way < strokes + places; way++) {
      candidate c = search->found[k];
      c.round = 0;
      c.fresh = (carom_tally){0};
      if (way < strokes)
        step_aside(&c, way / 2, way % 2 == 1);
      else
        move_aside(&c, way - strokes);
      bound(search, &c);
      if (!carom_search_put(search, c.r))
        continue;
      if (pot) {
        c.phi = search->view.window[c.aimed_ball][c.aimed_pocket].psi / degree;
        if (!aim(search, &c))
          continue;
      }
      c.miss.miss = (float)NAN;
      c.turns = steered && !is_known(search, &c);
      if (steered && (!c.turns || search->count - first >= PATH_ROWS))
        continue;
      carom_search_add(search, c);
    }
  }
}

/* The numbers below `count` in an order that is drawn. */
static void draw_order(const carom_search *search, uint32_t stage, int *order, int count) {
  for (int n = 0; n < count; n++) {
    const int partner = (int)(carom_uniform(search->options.seed, stage, (uint64_t)n, 0) * (n + 1));
    order[n] = order[partner];
    order[partner] = n;
  }
}

/* Direct pots, the likeliest first, each with all strokes, or as many as there is room for. */
void carom_search_pots(carom_search *search, int64_t most) {
  carom_pot_found *way = search->pot;
  int ways = 0;
  int balls = search->view.count;
  if (search->only_safeties)
    balls = 0;
  for (int k = 0; k < balls; k++)
    for (int p = 0; p < search->view.pockets && (search->targets >> k & 1); p++) {
      /* ball k into pocket p, if that is likely at all */
      if (!(search->pockets >> p & 1))
        continue;
      const carom_way w =
          carom_way_of(&search->view, search->state, search->in_play, k, p, 0, false, 0.03);
      if (w.chance == 0.0)
        continue;
      int index = ways++; /* sorted in */
      for (; index > 0 && way[index - 1].way.chance < w.chance; index--)
        way[index] = way[index - 1];
      way[index] = (carom_pot_found){w, k, p};
    }

  /* The strokes in an order that is drawn, so that few of them are of all kinds. */
  int order[STROKES];
  draw_order(search, DRAW_STROKES, order, STROKES);
  const int64_t first = search->count;
  CAROM_PROMISE(ways <= CAROM_BALLS_MOST * CAROM_POCKETS_MOST);
  ways = (int)carom_min(ways, carom_max(most / STROKES, 4));
  const int64_t share = most / carom_max(ways, 1);
  const int64_t strokes = carom_max(carom_min(share, STROKES), 3);

  for (int w = 0; w < ways; w++)
    for (int n = 0; n < strokes; n++) {
      const double *tip = pot_tip[order[n] % TIPS];
      carom_search_add(
          search, (candidate){.speed = carom_tip_gain(search->job.cue) * pot_speed[order[n] / TIPS],
                              .phi = way[w].way.psi / degree,
                              .a = tip[0],
                              .b = tip[1],
                              .kind = CAROM_PLAN_POT,
                              .chance = way[w].way.chance,
                              .aimed_ball = (int16_t)way[w].ball,
                              .aimed_pocket = (int16_t)way[w].pocket});
    }
  search->stage = (carom_stage){.work = aim_rows, .first = first, .rows = search->count - first};
}

/* Those that cannot be aimed are dropped. */
void carom_search_aimed(carom_search *search) {
  const int64_t first = search->stage.first;
  search->count = first;
  for (int64_t k = 0; k < search->stage.done; k++)
    if (search->outcome[k].turn)
      carom_search_add(search, search->found[first + k]);
}

/* Breaks: the nearest balls that are on, full and a little off their middle, hard, with the tip
 * at three heights. Or thin ones, which leave the other little: the balls that lie farthest to the
 * sides of the rack, on their outer side, softly, with side. Up to `most` of these strokes, in an
 * order that is drawn. */
void carom_search_breaks(carom_search *search, int64_t most) {
  enum { TARGETS = 3, SIDES = 5, SPEEDS = 3, PLACES = 3 };
  static const double side[2][SIDES] = {{0.0, 0.05, -0.05, 0.15, -0.15}, /* radii of both balls */
                                        {0.6, 0.75, 0.85, 0.92, 0.97}};
  static const double share[2][SPEEDS] = {{1.0, 0.85, 0.7}, {0.25, 0.34, 0.46}},
                      tip[2][PLACES] = {{0.0, 0.2, -0.2}, {0.0, 0.25, 0.5}};
  const bool thin = search->job.rules->breaks == 2;
  const double *c = search->played[search->cue_ball].state.r;
  const carom_marks marks = carom_marks_of(search->view.width, search->view.length);
  const double foot = carom_angle_of(marks.foot_spot[0] - c[0], marks.foot_spot[1] - c[1]);

  /* the nearest balls, or the outermost as seen from the cue ball, sorted in */
  struct {
    double key, direction, far, outer; /* direction, distance in both radii, side: 1 or -1 */
  } ball[TARGETS + 1];
  int balls = 0;
  for (int k = 0; k < search->view.count; k++) {
    const double *r = search->job.balls[k].state.r, x = r[0] - c[0], y = r[1] - c[1];
    if (!(search->targets >> k & 1))
      continue;
    const double direction = carom_angle_of(x, y), far = sqrt(x * x + y * y);
    double key = far;
    if (thin)
      key = -fabs(direction - foot);
    int index = TARGETS;
    if (balls < TARGETS)
      index = balls++;
    for (; index > 0 && ball[index - 1].key > key; index--)
      ball[index] = ball[index - 1];
    ball[index].key = key;
    ball[index].direction = direction;
    ball[index].far = far / (search->view.radius[search->view.cue_ball] + search->view.radius[k]);
    ball[index].outer = 1.0;
    if (thin && direction < foot)
      ball[index].outer = -1.0;
  }

  /* strokes in an order that is drawn: a number represents ball, side, speed and tip */
  int order[TARGETS * SIDES * SPEEDS * PLACES];
  const int strokes = balls * SIDES * SPEEDS * PLACES;
  draw_order(search, DRAW_BREAKS, order, strokes);
  for (int n = 0; n < strokes && n < most; n++) {
    const int target = order[n] % balls, stroke = order[n] / balls;
    const double sine = ball[target].outer * side[thin][stroke % SIDES] / ball[target].far;
    const double phi =
        (ball[target].direction + carom_asin(carom_within(sine, -1.0, 1.0))) / degree;
    const double off = tip[thin][stroke / SIDES / SPEEDS];
    candidate strike = {.speed = share[thin][stroke / SIDES % SPEEDS] * search->player.speed_most,
                        .phi = carom_turned(phi)};
    if (thin) {
      strike.a = -ball[target].outer * off;
      strike.kind = CAROM_PLAN_SCAN;
    } else {
      strike.b = off;
      strike.kind = CAROM_PLAN_BREAK;
    }
    carom_search_add(search, strike);
  }
}

/* A direction in which the cue ball meets a ball that is on, if nothing is between them; both are
 * drawn. */
static double towards(const carom_search *search, uint64_t row) {
  int target[CAROM_BALLS_MOST], count = 0;
  for (int n = 0; n < search->view.count; n++)
    if (search->targets >> n & 1)
      target[count++] = n;
  const int k = target[(int)(count * carom_uniform(search->options.seed, DRAW_SCAN, row, 2))];
  const double *c = search->played[search->cue_ball].state.r, *r = search->job.balls[k].state.r;
  const double x = r[0] - c[0], y = r[1] - c[1];
  const double both = search->view.radius[search->view.cue_ball] + search->view.radius[k];
  const double half = carom_asin(carom_within(both / sqrt(x * x + y * y), 0.0, 1.0));
  const double off = 2.0 * carom_uniform(search->options.seed, DRAW_SCAN, row, 3) - 1.0;
  return carom_turned((carom_angle_of(x, y) + off * half) / degree);
}

/* Strokes in all directions, of which those stay that meet a ball first that is on. The directions
 * follow the golden ratio, so that however many are tried, they are spread evenly. With ball in
 * hand, where each position has few, every second one goes to a ball that is on: of 40 layouts of
 * nine-ball, plans of 2,000 shots and a player with errors of 2, the chosen strokes were worth
 * 0.595 with it, 0.572 without. */
bool carom_search_scan(carom_search *search) {
  /* in blocks that are sooner made than a plan has to stop */
  enum { LEAST = 16, MOST = PATH_ROWS, MEASURED = 1000 };
  const double parts = (double)carom_max(search->places, 2);
  const int64_t block = (int64_t)carom_within((double)search->scan / parts, LEAST, MOST);
  if (search->tried >= 4 * search->scan || search->count >= search->scan_end ||
      carom_is_stopped(search))
    return false;
  carom_search_next_place(search);
  const bool is_caroms = carom_has_cannons(search->job.rules); /* and in-offs */
  const bool to_balls =
      search->places > 0 || is_caroms || (search->blind && search->view.pockets > 0);
  const int slowest = search->cushions == 3; /* the least speed seldom meets three cushions */
  const double begin = carom_uniform(search->options.seed, DRAW_SCAN, 0, 0);
  const int64_t first = search->count;
  const int64_t end = carom_min(search->tried + block, 4 * search->scan);
  for (; search->tried < end && search->count < search->most; search->tried++) {
    /* a direction, and a speed and a tip that are drawn */
    const uint64_t row = (uint64_t)search->tried + 1;
    double turn = begin + 0.61803398874989485 * (double)search->tried;
    turn -= floor(turn);
    const int speed = slowest + (int)((double)(SCAN_SPEEDS - slowest) *
                                      carom_uniform(search->options.seed, DRAW_SCAN, row, 0));
    const double *tip =
        scan_tip[(int)((double)TIPS * carom_uniform(search->options.seed, DRAW_SCAN, row, 1))];
    double drawn[2];
    if (search->view.pockets == 0) { /* any position, since its side decides where cushions send
                                        it */
      const double turned = 2.0 * pi * carom_uniform(search->options.seed, DRAW_SCAN, row, 2);
      const double far =
          search->player.tip_most * sqrt(carom_uniform(search->options.seed, DRAW_SCAN, row, 1));
      carom_sincos(turned, &drawn[0], &drawn[1]);
      drawn[0] *= far;
      drawn[1] *= far;
      tip = drawn;
    }
    double phi = 360.0 * turn;
    if (to_balls && search->tried % 2 == 1)
      phi = towards(search, row);
    int16_t kind = CAROM_PLAN_SCAN;
    if ((search->permissions & CAROM_CHOICE_PUSH) && search->tried % 2 == 1)
      kind = CAROM_PLAN_PUSH;
    carom_search_add(search,
                     (candidate){.speed = carom_tip_gain(search->job.cue) * scan_speed[speed],
                                 .phi = phi,
                                 .a = tip[0],
                                 .b = tip[1],
                                 .kind = kind});
  }
  search->tried = end;
  carom_search_stage(search, first, search->count - first, 1, 0);
  if (carom_search_is_steered(search) && first < MEASURED)
    search->stage.measure = carom_search_measure;
  return true;
}

/* Those that begin with a foul are dropped, and those that are more than the scan has. */
void carom_search_scanned(carom_search *search) {
  const int64_t first = search->stage.first, added = search->stage.done;
  CAROM_PROMISE(added <= search->count - first);
  search->count = first;
  for (int64_t k = 0; k < added && search->count < search->scan_end; k++)
    if (search->found[first + k].kind == CAROM_PLAN_PUSH ||
        carom_search_may_join(search, &search->outcome[k])) {
      search->found[search->count] = search->found[first + k];
      candidate *c = &search->found[search->count];
      outcome o = search->outcome[k];
      c->order = (int32_t)search->count;
      c->miss = o.miss;
      if (o.ball >= 0 && c->miss.slope != 0.0f)
        o.worth = carom_search_worth(search, c, o.worth);
      search->count++;
      carom_search_take(search, search->count - 1, &o);
    }
}
