/* Complete shots with inputs made of the bytes of a fuzzer (draws.h): tables of any shape, layouts
 * on the cloth and in the air, cues, options. Aborts where the contract of carom_shot.h or
 * carom_tangent.h is broken: an end that is not finite; a batch with other bits than single
 * shots; a shot in parts with other bits than the whole; bytes written outside the results; and,
 * where all numbers are those of play, balls that overlap, that leave the table or are in a cushion
 * without an event, derivatives that are not finite. Crashes, hangs and undefined behaviour are for
 * the fuzzer and the sanitizers to see. */
#include "carom_tangent.h"
#include "draws.h"

/* Of the library's own sources: the seal that the bytes of a state must have to be looked at. */
void carom_state_seal(carom_shot_state *state);

enum { EVENTS = 120, SHOTS = 3, MOST = CAROM_BALLS_MOST, DIRECTIONS = 3 };

/* What is played, and how. */
static carom_table table;
static carom_shot_ball balls[SHOTS * MOST]; /* a layout for each shot */
static int count;
static carom_cue cues[SHOTS];
static carom_shot_options options;

/* ---- Inputs */

/* Mostly n, sometimes a number that names nothing. */
static int mostly(int n) {
  return choice(20) == 0 && !tame ? choice(256) - 128 : n;
}

/* A polygon about a point, from 2 rails to 8, of which some have jaws at their ends, and a
 * pocket or none. */
static void make_polygon(void) {
  memset(&table, 0, sizeof table);
  table.width = table.length = 2;
  table.rails = 2 + choice(7);
  const double radius = number(0.3, 1.2), turn = number(0, 6.3), height = number(0.03, 0.045),
               jaw = number(0, 0.02);
  const bool jaws = choice(2), reversed = choice(8) == 0;
  double at[9][2] = {{0}};
  for (int k = 0; k < table.rails; k++) {
    const double angle =
        turn + 6.283185307179586 * (k + (choice(4) == 0 ? 0.4 : 0)) / (double)table.rails;
    at[k][0] = 1 + radius * cos(angle);
    at[k][1] = 1 + radius * sin(angle);
  }
  memcpy(at[table.rails], at[0], sizeof at[0]);
  for (int k = 0; k < table.rails; k++) {
    table.rail[k] = (carom_rail){.height = height, .side = reversed ? 0 : 1};
    memcpy(table.rail[k].p, at[k], sizeof at[k]);
    memcpy(table.rail[k].q, at[k + 1], sizeof at[k]);
    if (jaws) {
      table.jaw[k] = (carom_jaw){.radius = jaw, .height = height};
      memcpy(table.jaw[k].centre, at[k], sizeof at[k]);
    }
  }
  table.jaws = jaws ? table.rails : 0;
  if (choice(2) == 0) {
    table.pockets = 1;
    memcpy(table.pocket[0].centre, at[0], sizeof at[0]);
    table.pocket[0].radius = number(0.02, 0.1);
    table.pocket[0].depth = number(0, 0.1);
  }
}

static void make_table(void) {
  if (choice(4) == 0)
    make_polygon();
  else
    carom_table_make((carom_table_kind)choice(6), &table);
  if (choice(10) == 0)
    table.rail[choice(4)].height = number(0.025, 0.05);
  if (choice(20) == 0 && !tame)
    table.rails = choice(40) - 2;
  if (choice(20) == 0)
    table.rail[choice(8)].p[choice(2)] += number(-0.1, 0.1);
  if (choice(10) == 0) {
    double *const rail = &table.rail[choice(4)].mu_cushion;
    rail[0] = number(0, 1);
    rail[1] = number(0, 1);
  }
  if (choice(10) == 0) {
    double *const space = &table.ball_radius;
    space[choice(3)] = number(0, 0.2);
  }
}

/* Balls anywhere, at rest or not, on the cloth or above it, often at the very place where they
 * touch the one before. */
static void make_balls(void) {
  count = 1 + choice(5);
  const carom_game game = (carom_game)choice(3);
  for (int k = 0; k < count; k++) {
    carom_ball_state *const s = &balls[k].state;
    balls[k].kind = carom_ball_kind_of(choice(16) == 0 ? (carom_game)choice(3) : game);
    if (choice(16) == 0)
      balls[k].kind.radius *= number(0.8, 1.2);
    s->r[0] = number(0.06, table.width - 0.06);
    s->r[1] = number(0.06, table.length - 0.06);
    s->r[2] = balls[k].kind.radius;
    if (k > 0 && choice(4) == 0) {
      const double angle = choice(2) ? 1.5707963267948966 * choice(4) : number(0, 6.3);
      const double away = balls[k].kind.radius + balls[k - 1].kind.radius;
      s->r[0] = balls[k - 1].state.r[0] + away * (isfinite(angle) ? cos(angle) : 1);
      s->r[1] = balls[k - 1].state.r[1] + away * (isfinite(angle) ? sin(angle) : 0);
    }
    if (choice(3) == 0) {
      vector(s->v, 5, 0);
      vector(s->w, 200, number(-200, 200));
    }
    if (choice(4) == 0) { /* it flies */
      s->r[2] += number(0, 0.4);
      s->v[2] = number(-5, 5);
      s->label = choice(tame ? CAROM_BALL_OFF + 1 : CAROM_BALL_OFF + 2);
    }
  }
}

static void make_options(void) {
  options = (carom_shot_options){.world = (carom_world)mostly(choice(4) == 0)};
  options.ball_model = (carom_ball_model)mostly(choice(2) == 0 ? choice(5) : 0);
  options.cushion_model =
      (carom_shot_cushion)mostly(choice(2) == 0 ? choice(CAROM_SHOT_CUSHION_SMOOTH + 2) : 0);
  options.friction = (carom_ball_friction)choice(2);
  options.space = (carom_space)mostly(choice(4) == 0);
  options.steps = 1 + choice(100);
  options.events_most = 1 + choice(EVENTS);
  options.time_most = choice(3) == 0 ? number(0, 10) : 0;
  options.fast = choice(2);
  if (choice(3) == 0)
    options.stop_at = !tame && choice(4) == 0 ? (uint64_t)choice(256) << choice(64)
                                              : CAROM_STOP_AT(choice(CAROM_EVENT_LEFT_TABLE + 1));
  RESERVE(options);
}

static bool make_inputs(void) {
  memset(balls, 0, sizeof balls);
  make_table();
  if (choice(3) == 0) {
    const carom_rack_kind rack = (carom_rack_kind)choice(6);
    const double gap = choice(4) == 0 ? 0 : number(0, 1e-3);
    count = carom_rack_size(rack);
    if (carom_rack(rack, &table, gap, byte(), balls, MOST) != CAROM_OK)
      return false;
  } else
    make_balls();
  if (choice(3) == 0) { /* one constant of one ball, or of all */
    const int changed = choice(MOST),
              field = choice((int)(sizeof(carom_ball_kind) / sizeof(double)));
    const double value = number(0, 1);
    for (int k = 0; k < count; k++)
      if (changed >= count || k == changed)
        ((double *)&balls[k].kind)[field] = value;
  }
  for (int k = 0; k < SHOTS; k++) {
    cues[k] = carom_cue_of((carom_game)choice(3));
    cues[k].speed = number(0, 8);
    cues[k].phi = number(0, 360);
    cues[k].theta = choice(4) == 0 ? number(0, 90) : 0;
    cues[k].a = number(-0.6, 0.6);
    cues[k].b = number(-0.6, 0.6);
    const int struck = choice(10) == 0 ? choice(count) : 0;
    cues[k].ball = mostly(struck);
    cues[k].tip_restitution = choice(3) == 0 ? number(0, 1) : cues[k].tip_restitution;
    cues[k].tip_time = choice(3) == 0 ? number(0, 0.01) : choice(2) - 1.0;
    const double least_miscue = tame ? 0.9 : 0;
    cues[k].miscue = choice(10) == 0 ? number(least_miscue, 1) : 0;
    cues[k].follow = choice(3) == 0 ? number(0, 1) : cues[k].follow;
  }
  make_options();
  /* the other layouts: with another cue ball */
  for (int k = 1; k < SHOTS; k++) {
    memcpy(&balls[k * count], balls, (size_t)count * sizeof *balls);
    balls[k * count].state.r[k - 1] += number(-0.1, 0.1);
  }
  return true;
}

/* ---- What every shot keeps */

static bool between(double x, double low, double high) {
  return x >= low && x <= high;
}

/* Whether the numbers are those of balls and tables that there can be, and the models those that
 * keep what is checked here: pooltool's rules move balls, and Euler's steps, few as they are,
 * end somewhere near the end of an impact. */
static bool is_play(const carom_cue *cue) {
  bool plays = options.world == CAROM_WORLD_CAROM && options.ball_model != CAROM_BALL_MODEL_EULER &&
               options.cushion_model != CAROM_SHOT_CUSHION_EULER && between(cue->speed, 0, 20);
  for (int k = 0; k < count && plays; k++) {
    const carom_ball_kind *const kind = &balls[k].kind;
    const carom_ball_state *const s = &balls[k].state;
    plays = within((const double *)kind, sizeof *kind / sizeof(double), 1e6) &&
            between(kind->mass, 0.05, 1) && between(kind->radius, 0.01, 0.1) &&
            between(kind->gravity, 1, 20) && kind->mu_slide >= 1e-3 && kind->mu_roll >= 1e-4 &&
            kind->mu_spin >= 1e-4 &&
            (kind->nose_height == 0 || between(kind->nose_height / kind->radius, 0.5, 1.8));
    for (int part = 0; part < table.rails && plays; part++)
      plays = between(table.rail[part].height / kind->radius, 0.5, 1.8) &&
              within(&table.rail[part].mu_cushion, 2, 1e6);
    for (int c = 0; c < 3; c++)
      plays = plays && fabs(s->r[c]) < 10 && fabs(s->v[c]) < 20 && fabs(s->w[c]) < 1000;
  }
  return plays;
}

/* Whether carom_table_check() finds no hole for any of the balls. It knows of one radius: between
 * noses of different heights there may be one for a ball of another radius than the last. */
static bool is_closed(void) {
  bool alike = true;
  for (int k = 0; k < table.rails; k++)
    alike &= table.rail[k].height == table.rail[0].height;
  for (int k = 0; k < table.jaws; k++)
    alike &= table.jaw[k].height == table.rail[0].height;
  for (int k = 0; k < count; k++)
    if (carom_table_check(&table, balls[k].kind.radius, NULL) != CAROM_OK ||
        !(alike || balls[k].kind.radius == balls[count - 1].kind.radius))
      return false;
  return true;
}

/* Follows a shot of the first layout through its events, and between them, by
 * carom_shot_frames(). */
static void check_play(const carom_shot *shot) {
  enum { LOOKS = 2 * EVENTS + 2 };
  static carom_ball_state states[LOOKS * MOST];
  static double times[LOOKS];
  int looks = 0;
  double now = 0;
  for (int64_t k = 0; k < shot->count; k++) {
    const double then = shot->events[k].time;
    if (then > now)
      times[looks++] = 0.5 * (now + then);
    times[looks++] = now = then;
  }
  times[looks++] = shot->time;
  if (carom_shot_frames(balls, count, shot, times, (size_t)looks, NULL, states, NULL) != CAROM_OK)
    fail("carom_shot_frames does not know a shot all of whose events were kept");

  /* What is on the cloth at any time is a layout that may be played: nothing is in a cushion,
   * in a pocket or outside. Balls that leave a cluster may overlap for a moment: two of a rack
   * that part at 3 mm/s did so, by 61 um, after 39 ms. */
  const int look = choice(looks);
  for (int64_t k = 0; k < shot->count; k++)
    if (shot->events[k].cluster > 0 && fabs(times[look] - shot->events[k].time) < 0.1)
      return;
  static carom_shot_ball there[MOST];
  memcpy(there, balls, (size_t)count * sizeof *there);
  for (int k = 0; k < count; k++) {
    there[k].state = states[look * count + k];
    if (there[k].state.label == CAROM_BALL_AIRBORNE)
      there[k].state.label = CAROM_BALL_OFF; /* it may be beyond the table and not have fallen
                                                yet */
  }
  carom_shot_options o = options;
  o.time_most = 0;
  if (carom_shot_check(&table, there, count, NULL, &o, NULL) != CAROM_OK && is_closed())
    fail("the state at some time of a shot is no layout");
  static carom_ball_state one[MOST];
  if (carom_shot_at(balls, count, shot, times[look], one) != CAROM_OK ||
      memcmp(one, &states[look * count], (size_t)count * sizeof *one) != 0)
    fail("carom_shot_frames differs from carom_shot_at");

  /* Drawn, pocketed balls are in their pockets, and the others where they are. */
  static carom_ball_state drawn[MOST];
  if (carom_shot_drawn(&table, balls, count, shot, &times[look], 1, drawn) != CAROM_OK)
    fail("carom_shot_drawn does not know a shot all of whose events were kept");
  for (int k = 0; k < count; k++)
    if (one[k].label != CAROM_BALL_POCKETED ? memcmp(&drawn[k], &one[k], sizeof one[k]) != 0
                                            : !(drawn[k].r[2] >= one[k].r[2] - 1e-9))
      fail("a ball is drawn where it is not");
}

/* ---- Derivatives */

static double final_of[SHOTS + 1][MOST * CAROM_STATE_NUMBERS * DIRECTIONS],
    reach_of[SHOTS + 1][DIRECTIONS];
static double time_of[EVENTS * DIRECTIONS + 1],
    at_of[2 * MOST * CAROM_STATE_NUMBERS * DIRECTIONS + 1];
static double before_of[EVENTS * 2 * CAROM_STATE_NUMBERS * DIRECTIONS + 1],
    after_of[EVENTS * 2 * CAROM_STATE_NUMBERS * DIRECTIONS + 1];

static double cue_seed[CAROM_CUE_NUMBERS * DIRECTIONS],
    state_seed[MOST * CAROM_STATE_NUMBERS * DIRECTIONS],
    kind_seed[MOST * (sizeof(carom_ball_kind) / sizeof(double)) * DIRECTIONS],
    nose_seed[CAROM_NOSE_NUMBERS * DIRECTIONS], slope_seed[2 * DIRECTIONS];

/* A few seeds that are not 0; `wild` becomes whether one of them is beyond 1e4. */
static carom_tangent_seeds make_tangent_seeds(bool *wild) {
  const int64_t m = directions(DIRECTIONS);
  struct {
    double *seeds;
    int size;
  } const groups[] = {{cue_seed, CAROM_CUE_NUMBERS * DIRECTIONS},
                      {state_seed, count * CAROM_STATE_NUMBERS * DIRECTIONS},
                      {kind_seed, count * CAROM_KIND_NUMBERS * DIRECTIONS},
                      {nose_seed, CAROM_NOSE_NUMBERS * DIRECTIONS},
                      {slope_seed, 2 * DIRECTIONS}};
  enum { GROUPS = sizeof groups / sizeof *groups };
  *wild = false;
  for (int g = 0; g < GROUPS; g++)
    memset(groups[g].seeds, 0, (size_t)groups[g].size * sizeof(double));
  for (int k = 0; k < 4; k++) {
    const int g = choice(GROUPS), high = choice(256),
              place = (256 * high + choice(256)) % groups[g].size;
    const double seed = groups[g].seeds[place] = number(-1, 1);
    *wild |= !within(&seed, 1, 1e4);
  }
  carom_tangent_seeds seeds = {m, cue_seed, kind_seed, state_seed, nose_seed, slope_seed, {0}};
  const double **const parts[] = {&seeds.cue, &seeds.kind, &seeds.state, &seeds.table,
                                  &seeds.slope};
  const int without = choice(16);
  if (without < GROUPS)
    *parts[without] = NULL;
  RESERVE(seeds);
  return seeds;
}

/* Derivatives of the played shots of a job: of the first by itself and all as a batch. */
static void check_tangents(const carom_shot_job *job, bool plays) {
  bool wild;
  const carom_tangent_seeds seeds = make_tangent_seeds(&wild);
  const int64_t m = seeds.directions;
  const size_t each = m > 0 && m <= DIRECTIONS ? (size_t)m : 0,
               finals = (size_t)count * CAROM_STATE_NUMBERS * each;

  /* The first shot by itself. */
  FILL(final_of);
  FILL(reach_of);
  int32_t flags[EVENTS];
  double times[2] = {number(0, 5), 0};
  times[1] = choice(2) ? times[0] : number(0, 5);
  const unsigned wanted = byte();
  carom_tangent tangent = {.final = final_of[SHOTS], .time = time_of, .reach = reach_of[SHOTS]};
  tangent.before = wanted & 1 ? before_of : NULL;
  tangent.after = wanted & 2 ? after_of : NULL;
  tangent.flags = wanted & 4 ? flags : NULL;
  if ((wanted & 24) == 24) {
    tangent.at = at_of;
    tangent.times = times;
    tangent.times_count = 2;
  }
  const carom_shot *const shot = &job->shots[0];
  /* a shot with more events than it had room for has no derivatives */
  const size_t events = shot->count <= shot->room ? (size_t)shot->count * each : 0,
               pairs = 2 * CAROM_STATE_NUMBERS * events;
  const struct {
    const char *what;
    double *at;
    size_t used, room; /* numbers */
  } parts[] = {
      {"the derivatives of the end of a shot", final_of[SHOTS], finals,
       sizeof final_of[SHOTS] / sizeof(double)},
      {"the derivatives of the times of events", time_of, events, sizeof time_of / sizeof(double)},
      {"derivatives before an event", before_of, tangent.before != NULL ? pairs : 0,
       sizeof before_of / sizeof(double)},
      {"derivatives after an event", after_of, tangent.after != NULL ? pairs : 0,
       sizeof after_of / sizeof(double)},
      {"derivatives at a time", at_of, tangent.at != NULL ? 2 * finals : 0,
       sizeof at_of / sizeof(double)},
  };
  enum { PARTS = sizeof parts / sizeof parts[0] };
  for (int k = 1; k < PARTS; k++)
    memset(parts[k].at, GUARD, parts[k].room * sizeof(double));
  const carom_status status =
      carom_shot_tangent(&table, job->balls, count, job->cues, &options, shot, &seeds, &tangent);
  if (status >= 0 && plays && !wild) {
    int64_t all = 0;
    for (int k = 0; k < PARTS; k++)
      expect(parts[k].at, parts[k].used, true, parts[k].what);
    for (size_t k = 0; k < each; k++)
      if (!(reach_of[SHOTS][k] >= 0))
        fail("the reach of a derivative is negative, or no number");
    for (int64_t k = 0; k < shot->count && tangent.flags != NULL; k++)
      all |= flags[k];
    if (!isfinite(tangent.error) || tangent.error < 0 ||
        (tangent.flags != NULL && all != tangent.all_flags))
      fail("the errors or flags of derivatives");
  }
  static double single[MOST * CAROM_STATE_NUMBERS * DIRECTIONS];
  memcpy(single, final_of[SHOTS], sizeof single);
  if (status < 0 && isnan(single[0]))
    expect(single, finals, false, "derivatives after an error");
  else if (status < 0)
    unwritten(single, finals * sizeof *single,
              "derivatives are written after an error of the call");

  /* Of another cue, or with an event that cannot be: a status, and nothing next to the
   * positions. */
  if (choice(8) == 0 && shot->count > 0 && shot->count <= shot->room) {
    carom_event *const event = &shot->events[choice((int)shot->count)];
    const carom_event kept = *event;
    ((unsigned char *)event)[choice((int)sizeof *event)] = (unsigned char)byte();
    carom_shot_tangent(&table, job->balls, count, choice(2) ? &cues[1] : NULL, &options, shot,
                       &seeds, &tangent);
    *event = kept;
  }
  for (int k = 0; k < PARTS; k++)
    unwritten(parts[k].at + parts[k].used, (parts[k].room - parts[k].used) * sizeof(double),
              parts[k].what);

  /* All as a batch. */
  carom_tangent tangents[SHOTS];
  int8_t statuses[SHOTS + 1];
  FILL(statuses);
  for (int k = 0; k < SHOTS; k++)
    tangents[k] = (carom_tangent){.final = final_of[k]};
  const carom_tangent_job derivatives = {
      .played = job, .seeds = &seeds, .tangents = tangents, .status = statuses};
  carom_shot_tangent_batch(&derivatives);
  UNWRITTEN(statuses, SHOTS, "a batch of derivatives writes beside its statuses");
  if (status >= 0 && job->status[0] >= 0 && tangent.at == NULL &&
      (statuses[0] != status || memcmp(final_of[0], single, finals * sizeof *single) != 0))
    fail("a batch of derivatives differs from those of one shot");
}

/* ---- Shots */

/* Continues damaged copies of a state: they are rejected by their seal; under a right one the
 * shot is rejected or ends. */
static void check_damage(const carom_shot *shot, const carom_shot_options *on) {
  static carom_shot_state damaged;
  static carom_event events[EVENTS + 1];
  enum { SEALED = 2, WORDS = 2960 }; /* of those that are sealed, without the last */
  carom_shot again = *shot;
  memcpy(&damaged, shot->state, sizeof damaged);
  FILL(events);
  again.events = events;
  again.brief = NULL;
  again.room = EVENTS;
  again.final = NULL;
  again.state = &damaged;
  const bool forged = choice(2);
  for (int k = 1 + choice(3); k > 0; k--) {
    const int high = choice(256), word = SEALED + (256 * high + choice(256)) % (WORDS - SEALED);
    if (choice(2) == 0) {
      const double x = number(-1, 1);
      memcpy(&damaged.opaque[word], &x, sizeof x);
    } else {
      damaged.opaque[word] ^= UINT64_C(1) << choice(64);
    }
  }
  if (forged)
    carom_state_seal(&damaged);
  const bool same = memcmp(&damaged, shot->state, sizeof damaged) == 0;
  const carom_status status = carom_shot_continue(&table, balls, count, on, &again);
  if (!forged && !same && status != CAROM_ERROR_STATE)
    fail("carom_shot_continue takes a damaged state");
  UNWRITTEN(events, EVENTS, "a shot with a damaged state writes beside its events");
}

static bool has_same_end(const carom_shot *a, const carom_shot *b) {
  return a->count == b->count && memcmp(&a->time, &b->time, sizeof a->time) == 0 &&
         memcmp(a->final, b->final, (size_t)count * sizeof *a->final) == 0;
}

/* Plays the rest of a shot that was stopped, and the whole at once. */
static void check_parts(carom_shot *shot, const carom_shot *room) {
  carom_shot_options on = options;
  on.time_most = 0;
  on.stop_at = 0;
  on.events_most = EVENTS;
  carom_shot whole = *room;
  const int64_t before = shot->count;
  carom_status then = CAROM_STOPPED_AT_EVENT;
  carom_shot_options part = on;
  if (choice(2) == 0)
    check_damage(shot, &on);
  for (int k = choice(4); k >= 0 && (then > 0 || then == CAROM_ERROR_TOO_MANY_EVENTS); k--) {
    part.stop_at = k > 0 ? CAROM_STOP_AT(1 + choice(CAROM_EVENT_LEFT_TABLE)) : 0;
    then = carom_shot_continue(&table, balls, count, &part, shot);
  }
  if (then == CAROM_ERROR_STATE || shot->count < before)
    fail("carom_shot_continue refuses the state of a shot that was stopped");
  const carom_status at_once = carom_shoot(&table, balls, count, &cues[0], &on, &whole);
  if (at_once != then || !has_same_end(&whole, shot))
    fail("a shot in parts differs from the whole");
  const int64_t kept = shot->room < shot->count ? shot->room : shot->count;
  if (kept > 0 && memcmp(whole.events, shot->events, (size_t)kept * sizeof *whole.events) != 0)
    fail("the events of a shot in parts differ from those of the whole");
}

static void shots(void) {
  static carom_event events[SHOTS + 1][EVENTS + 1];
  static carom_brief_event brief[EVENTS + 1];
  static carom_ball_state final[SHOTS + 1][MOST], states[MOST];
  static carom_shot_state state;
  if (!make_inputs())
    return;

  /* One shot. */
  const int room = choice(2) ? EVENTS : choice(EVENTS + 1);
  FILL(events);
  FILL(final);
  FILL(brief);
  carom_shot one = {.events = events[SHOTS], .room = room, .final = final[SHOTS], .state = &state};
  one.brief = choice(4) == 0 ? brief : NULL;
  const carom_status status = carom_shoot(&table, balls, count, &cues[0], &options, &one);
  const bool played =
      status >= 0 || status == CAROM_ERROR_TOO_MANY_EVENTS || status == CAROM_ERROR_TOO_LONG;
  const int64_t kept = one.count < room ? one.count : room;
  for (int k = 0; k < count && played; k++)
    expect(final[SHOTS][k].r, 9, true, "the end of a shot is not finite");
  if (played && (!isfinite(one.time) || one.count < 0))
    fail("the time of a shot is not finite");
  for (int64_t k = 1; k < kept; k++)
    if (!(events[SHOTS][k].time >= events[SHOTS][k - 1].time))
      fail("events are not in order");
  if (carom_shot_check(&table, balls, count, &cues[0], &options, NULL) != CAROM_OK && one.count > 0)
    fail("carom_shot_check refuses what carom_shoot plays");
  UNWRITTEN(events[SHOTS], kept, "events beside their place");
  UNWRITTEN(final[SHOTS], count, "final states beside their place");
  UNWRITTEN(brief, kept, "brief events beside their place");
  for (int64_t k = 0; k < kept && one.brief != NULL; k++)
    if (memcmp(&brief[k], &events[SHOTS][k], offsetof(carom_brief_event, reserved)) != 0)
      fail("brief events tell something else");
  const bool plays = is_play(&cues[0]);
  if (status == CAROM_ERROR_LEFT_TABLE && plays && is_closed())
    fail("a ball on the cloth leaves a table without a hole");
  if (played && plays && one.count <= room)
    check_play(&one);

  /* Its states. */
  const double share = number(0, 1), time = choice(4) == 0 ? 10 * share : share * one.time;
  const carom_status at = carom_shot_at(balls, count, &one, time, states);
  for (int k = 0; k < count && played && at == CAROM_OK; k++)
    if (isnan(states[k].r[0]) || isnan(states[k].v[0]))
      fail("carom_shot_at is not a number");
  double turned[MOST][4];
  if (at == CAROM_OK && one.time < 100 &&
      carom_shot_frames(balls, count, &one, &one.time, 1, NULL, NULL, turned) == CAROM_OK)
    for (int k = 0; k < count; k++)
      if (!(fabs(turned[k][0]) <= 1.001))
        fail("an orientation is no rotation");

  /* A batch of it and two others. */
  carom_shot many[SHOTS];
  int8_t statuses[SHOTS + 1];
  FILL(statuses);
  for (int k = 0; k < SHOTS; k++)
    many[k] = (carom_shot){.events = events[k], .room = room, .final = final[k]};
  carom_shot_job job = {.table = &table, .balls = balls, .cues = cues, .count = count, .n = SHOTS};
  job.ball_stride = choice(2) ? (uint64_t)count : 0;
  job.cue_stride = (uint64_t)choice(2);
  job.options = &options;
  job.shots = many;
  job.status = statuses;
  carom_shoot_batch(&job);
  for (int k = 0; k < SHOTS; k++) {
    const int64_t told = many[k].count < room ? many[k].count : room;
    UNWRITTEN(events[k], told, "the events of a batch beside their place");
    UNWRITTEN(final[k], count, "the ends of a batch beside their place");
  }
  UNWRITTEN(statuses, SHOTS, "a batch of shots writes beside its statuses");
  if (played && (statuses[0] != (int8_t)status || !has_same_end(&many[0], &one) ||
                 memcmp(events[0], events[SHOTS], (size_t)kept * sizeof **events) != 0))
    fail("a batch of shots differs from a shot");

  /* Derivatives of them, and the rest of a shot that was stopped. */
  if (choice(2) == 0)
    check_tangents(&job, plays && played);
  if (status > 0 || status == CAROM_ERROR_TOO_MANY_EVENTS)
    check_parts(&one, &many[0]);
  carom_motion struck;
  if (carom_strike(&cues[0], &balls[0].kind, &struck) == CAROM_OK)
    expect((double *)&struck, 6, true, "carom_strike");
}

/* ---- Tables */

/* Ball in hand on any table, and its check. */
static void tables(void) {
  static carom_shot_ball placed[MOST];
  if (!make_inputs())
    return;
  memcpy(placed, balls, sizeof placed);
  const double radius = choice(2) ? balls[0].kind.radius : number(0.01, 0.1);
  carom_table_fault fault;
  const carom_status checked = carom_table_check(&table, radius, &fault);
  if (checked != CAROM_OK && checked != CAROM_ERROR_RADIUS &&
      (!isfinite(fault.place[0]) || !isfinite(fault.place[1]) || !isfinite(fault.gap)))
    fail("the place of a fault is not finite");
  carom_part way;
  const int ball = mostly(choice(count));
  const double x = number(0, table.width), y = number(0, table.length);
  const carom_status status =
      carom_place_ball(&table, placed, count, ball, x, y, choice(8) == 0 ? NULL : &way);
  if (status != CAROM_OK) {
    if (memcmp(placed, balls, (size_t)count * sizeof *placed) != 0)
      fail("carom_place_ball refuses a place and moves a ball");
    return;
  }
  const carom_ball_state *const s = &placed[ball].state;
  if (s->r[0] != x || s->r[1] != y || s->r[2] != placed[ball].kind.radius || s->v[0] != 0 ||
      s->w[2] != 0)
    fail("carom_place_ball puts a ball elsewhere");
  memcpy(&placed[ball].state, &balls[ball].state, sizeof *s);
  if (memcmp(placed, balls, sizeof placed) != 0)
    fail("carom_place_ball changes another ball");
  /* that ball alone is a layout, where its kind can be played */
  carom_shot_ball alone = balls[ball];
  alone.state = (carom_ball_state){.r = {x, y, alone.kind.radius}};
  const carom_status layout = carom_shot_check(&table, &alone, 1, NULL, NULL, NULL);
  if (layout == CAROM_ERROR_OFF_TABLE && balls[count - 1].kind.radius == alone.kind.radius)
    fail("carom_shot_check refuses where carom_place_ball puts a ball");
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  begin(data, size);
  tame = choice(4) != 0;
  if (choice(16) == 0)
    tables();
  else
    shots();
  return 0;
}
