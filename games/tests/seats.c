/* Matches of more than two seats: whose turn it is, what each may send, what a stroke may be, sets,
 * handicaps, and the shot that a match owns. */
#include "match_support.h"

#include <math.h>

static carom_match_setup setup;
static carom_seating seating;

static void begin_seats(carom_rules_kind kind, int seats) {
  carom_table_make((carom_table_kind)carom_rules_about_of(kind)->table, &table);
  expect_ok(carom_seating_make(kind, seats, &seating));
  setup = (carom_match_setup){.rules = kind, .table = &table, .seed = 3, .seating = &seating};
}

static void begin_match(void) {
  ck_assert_msg(carom_match_begin_with(&match, &setup) == CAROM_OK, "%s", match.fault);
  file_size = 0;
  keep();
}

/* Puts a cue ball in hand in the middle of its bounds, and plays. */
static carom_status play(double phi, double speed) {
  if (match.phase == CAROM_MATCH_PLACE) {
    const carom_bounds *b = &match.bounds;
    expect_ok(carom_match_place(&match, match.seat, 0.5 * (b->low[0] + b->high[0]),
                                b->low[1] + 0.9 * (b->high[1] - b->low[1])));
    keep();
  }
  carom_cue cue = match.cue;
  cue.phi = phi;
  cue.speed = speed;
  cue.b = -0.2;
  const carom_status status = carom_match_stroke(&match, match.seat, &cue, NULL, NULL);
  keep();
  return status;
}

/* ---- Turns */

TEST(partners_play_in_turn) {
  static const struct {
    int64_t alternate;
    int seats[5]; /* who plays strokes that all miss */
  } cases[] = {{0, {0, 1, 2, 3, 0}}, {1, {0, 1, 2, 3, 0}}};
  for (size_t k = 0; k < 2; k++) {
    begin_seats(CAROM_RULES_NINEBALL, 4);
    seating.alternate = cases[k].alternate;
    begin_match();
    for (int n = 0; n < 5; n++) { /* three fouls of a side in a row would lose */
      ck_assert_int_eq(match.seat, cases[k].seats[n]);
      ck_assert_int_eq(match.rules.state.seat, match.seat);
      ck_assert_int_eq(match.record.side, match.seat % 2);
      expect_ok(play(200.0, 0.3));
    }
    check_recording("partners");
  }

  /* a stroke that keeps the table: the same seat continues by visits, the partner by strokes */
  for (int64_t alternate = 0; alternate < 2; alternate++) {
    begin_seats(CAROM_RULES_POTTING, 4);
    seating.alternate = alternate;
    carom_shot_ball lie[3];
    for (int b = 0; b < 3; b++)
      lie[b].kind = carom_ball_kind_of(CAROM_GAME_POOL);
    const double R = lie[0].kind.radius;
    static const double places[3][2] = {{0.3, 0.3}, {0.1, 0.1}, {0.9, 2.0}};
    for (int b = 0; b < 3; b++)
      lie[b].state =
          (carom_ball_state){.r = {places[b][0], places[b][1], R}, .label = CAROM_BALL_STATIONARY};
    setup.balls = lie;
    setup.count = 3;
    begin_match();
    expect_ok(play(225.0, 0.9));
    ck_assert_int_eq(match.ruling.turn.outcome, CAROM_TURN_KEEP);
    ck_assert_int_eq(match.seat, 2 * alternate);
    check_recording("a pot of partners");
  }
}

/* ---- Own rules of seats that play each for itself: who misses loses a life */

static uint32_t any_ball(const carom_rules_state *state, uint32_t in_play) {
  (void)state;
  return in_play & ~UINT32_C(1);
}
static void count_left(const carom_rules_state *state, uint32_t in_play, int32_t left[2]) {
  (void)state, (void)in_play;
  left[0] = left[1] = 1;
}
static double even(const carom_rules_state *state, const carom_ball_state *layout, int count,
                   int in_hand) {
  (void)state, (void)layout, (void)count, (void)in_hand;
  return 0.5;
}
static int judged;
static carom_turn lose_a_life(carom_rules_state *state, uint32_t in_play, int cue_ball,
                              const carom_facts *facts, carom_call call) {
  (void)in_play, (void)call;
  int alive = 0, last = 0;
  ++*(int *)(uintptr_t)state->context; /* of the caller's object */
  if ((facts->down & ~(UINT32_C(1) << cue_ball)) == 0)
    state->user[state->seat]--;
  for (int k = 0; k < CAROM_SEATS_MOST; k++)
    if (state->user[k] != 0) {
      alive++;
      last = k;
    }
  do
    state->seat = (state->seat + 1) % CAROM_SEATS_MOST;
  while (state->user[state->seat] == 0);
  if (alive == 1) {
    state->seat = last;
    return (carom_turn){.outcome = CAROM_TURN_WIN};
  }
  carom_turn turn = {.outcome = CAROM_TURN_PASS};
  if ((facts->down >> cue_ball & 1) != 0)
    turn.leave = CAROM_LEAVE_ANYWHERE;
  return turn;
}

static const carom_plan_rules lives = {.on = any_ball,
                                       .judge = lose_a_life,
                                       .left = count_left,
                                       .value = even,
                                       .race = CAROM_RACE_SEATS};

static void begin_lives(int seats, carom_plan_rules *own, carom_shot_ball *lie) {
  begin_seats(CAROM_RULES_POTTING, seats);
  for (int k = 0; k < seats; k++)
    seating.seat[k].side = k;
  carom_rack(CAROM_RACK_NINEBALL, &table, 1e-4, 1, lie, CAROM_BALLS_MOST);
  *own = lives;
  own->state.context = (uint64_t)(uintptr_t)&judged;
  for (int k = 0; k < seats; k++)
    own->state.user[k] = 1 + (uint64_t)(k == 1);
  setup.rules = (carom_rules_kind)100;
  setup.of = own;
  setup.balls = lie;
  setup.count = 10;
}

TEST(own_rules_of_three_seats) {
  carom_plan_rules own;
  carom_shot_ball lie[CAROM_BALLS_MOST];
  begin_lives(3, &own, lie);
  begin_match();
  judged = 0;
  static const int seats[] = {0, 1, 2, 1};
  for (int n = 0; n < 3; n++) { /* seats 0 and 2 lose their life, 1 one of two */
    ck_assert_int_eq(match.seat, seats[n]);
    expect_ok(play(180.0, 0.4));
  }
  ck_assert_int_eq(judged, 3);
  ck_assert(match.phase == CAROM_MATCH_OVER && match.winner == 1 + 1);
  carom_standing standing;
  expect_ok(carom_match_standing(&match, &standing));
  ck_assert(standing.sides == 3 && standing.points[0] == 0 && standing.points[1] == 1);

  /* the reader has the same rules */
  memset(&reader, 0, sizeof reader);
  reader.rules = own;
  for (const char *line = file; line < file + file_size;) {
    const char *end = strchr(line, '\n') + 1;
    ck_assert_msg(carom_match_read(&reader, &scratch, line, (size_t)(end - line)) == CAROM_OK, "%s",
                  reader.fault);
    line = end;
  }
  ck_assert(reader.winner == match.winner && reader.record.hash == match.record.hash);
  ck_assert_uint_eq(reader.rules.state.context, own.state.context);

  /* a seat leaves: the next one plays, and the last one wins */
  begin_match();
  expect_ok(carom_match_concede(&match, 0));
  ck_assert(match.phase != CAROM_MATCH_OVER && match.seat == 1);
  ck_assert_int_eq(carom_match_concede(&match, 0), CAROM_ERROR_ACT);
  expect_ok(carom_match_concede(&match, 2));
  ck_assert(match.phase == CAROM_MATCH_OVER && match.winner == 1 + 1);
}

/* ---- Senders: each kind of cheat is rejected in words, with nothing changed */

TEST(what_another_seat_sends) {
  static carom_match peer, room;
  static const char *const what[] = {"place", "stroke", "concede", "clock", "call", "extend"};
  begin_seats(CAROM_RULES_EIGHTBALL, 4);
  setup.set = &(carom_set){.race = 2, .extensions = 1};
  for (size_t k = 0; k < COUNT_OF(what); k++)
    for (int seat = 0; seat < 4; seat++) {
      begin_match();
      if (k > 0)
        expect_ok(carom_match_place(&match, 0, 0.6, 0.5));
      if (k > 0)
        keep();
      ck_assert_msg(read_all(file, file_size) == CAROM_OK, "%s", reader.fault);
      peer = match;
      carom_cue cue = peer.cue;
      cue.speed = 5.0;
      carom_status status = CAROM_OK;
      if (k == 0)
        status = carom_match_place(&peer, 0, 0.6, 0.5);
      if (k == 1)
        status = carom_match_stroke(&peer, 0, &cue, NULL, NULL);
      if (k == 2)
        status = carom_match_concede(&peer, 0);
      if (k == 3)
        status = carom_match_clock(&peer, 0);
      if (k == 4)
        status = carom_match_call(&peer, 0, (carom_call){3, 1});
      if (k == 5)
        status = carom_match_extend(&peer, 0);
      ck_assert_msg(status == CAROM_OK, "%s: %s", what[k], peer.fault);
      before = reader;
      const size_t size = (size_t)(strchr(peer.text, '\n') + 1 - peer.text);
      status = carom_match_receive(&reader, &room, peer.text, size, seat);
      if (seat == 0) {
        ck_assert_msg(status == CAROM_OK, "%s: %s", what[k], reader.fault);
        continue;
      }
      ck_assert_int_eq(status, CAROM_ERROR_ACT);
      ck_assert_msg(strstr(reader.fault, "has sent an act of seat 0") != NULL, "%s", reader.fault);
      ck_assert_int_eq(reader.refusal, CAROM_REFUSED_TURN);
      forget_refusal(&before);
      forget_refusal(&reader);
      ck_assert(memcmp(&before, &reader, sizeof before) == 0);
    }
}

TEST(what_a_stroke_may_be) {
  static const struct {
    const char *words;
    carom_cue change; /* what differs from the usual cue */
  } cases[] = {{"cue.speed must be at most 15 m/s", {.speed = 60.0}},
               {"cue.mass must be at most 1.2 kg", {.mass = 100.0}},
               {"cue.mass must be at least 0.2 kg", {.mass = 0.1}},
               {"sqrt(a^2 + b^2) must be at most 0.75 radii", {.a = 0.95}},
               {"cue.end_mass must be at least 0.001 kg", {.end_mass = 1e-9}},
               {"cue.theta must be at most 20 degrees", {.theta = 45.0}},
               {"cue.tip_restitution must be at most 0.8", {.tip_restitution = 1.0}},
               {"stick and tip must be the same as for seat 0", {.mass = 0.5}}};
  begin_seats(CAROM_RULES_EIGHTBALL, 2);
  seating.limits.theta = 20.0;
  seating.limits.tip_restitution_most = 0.8;
  seating.limits.own_cue = 1;
  begin_match();
  expect_ok(carom_match_place(&match, 0, 0.6, 0.5));
  for (size_t k = 0; k < COUNT_OF(cases); k++) {
    carom_cue cue = match.cue;
    const carom_cue *change = &cases[k].change;
    double *const to[] = {&cue.speed,    &cue.mass,  &cue.a,
                          &cue.end_mass, &cue.theta, &cue.tip_restitution};
    const double from[] = {change->speed,    change->mass,  change->a,
                           change->end_mass, change->theta, change->tip_restitution};
    for (size_t n = 0; n < COUNT_OF(to); n++)
      if (from[n] != 0.0)
        *to[n] = from[n];
    before = match;
    check_refusal(cases[k].words, carom_match_stroke(&match, 0, &cue, NULL, NULL), "limit",
                  cases[k].words);
  }
}

/* ---- The shot that a match owns */

enum { ROOM = 2000 };
static carom_event played[ROOM], again[ROOM];

static void check_replay(carom_match *of, const carom_shot *shot) {
  carom_ball_state final[CAROM_BALLS_MOST];
  carom_facts facts;
  carom_shot replay = {.events = again, .room = ROOM, .final = final, .facts = &facts};
  ck_assert_int_ge(carom_match_replay(of, &replay), 0);
  ck_assert_int_eq(replay.count, shot->count);
  ck_assert(replay.time == shot->time);
  ck_assert_mem_eq(again, played, (size_t)shot->count * sizeof *again);
  ck_assert_mem_eq(&facts, &of->record.facts, sizeof facts);
}

/* A shot that was played in parts, one that was read, and one that was read while it moves and goes
 * on with all its events. */
TEST(the_last_shot_again) {
  carom_match_begin(&match, CAROM_RULES_NINEBALL,
                    (carom_table_make(CAROM_TABLE_POOL_9FT, &table), &table), 7, 0);
  file_size = 0;
  keep();
  static carom_shot nothing;
  ck_assert_int_eq(carom_match_replay(&match, &nothing), CAROM_ERROR_STATE);
  expect_ok(carom_match_place(&match, 0, 0.635, 0.5));
  keep();
  carom_cue cue = match.cue;
  cue.speed = 8.0;
  carom_shot shot = {.events = played, .room = ROOM};
  const carom_shot_options stops[] = {{.time_most = 0.5}, {.time_most = 0.9}, {0}};
  ck_assert_int_gt(carom_match_stroke(&match, 0, &cue, &stops[0], &shot), 0);
  keep();
  check_replay(&match, &shot);
  ck_assert_int_gt(carom_match_continue(&match, &stops[1], &shot), 0);
  keep();
  check_replay(&match, &shot);
  expect_ok(read_all(file, file_size));
  check_replay(&reader, &shot);

  /* the match that was read continues, with the events of the replay */
  static carom_event more[ROOM];
  carom_shot other = {.events = more, .room = ROOM};
  ck_assert_int_ge(carom_match_replay(&reader, &other), 0);
  expect_ok(carom_match_continue(&reader, &stops[2], &other));
  expect_ok(carom_match_continue(&match, &stops[2], &shot));
  ck_assert_mem_eq(more, played, (size_t)shot.count * sizeof *more);
  ck_assert_uint_eq(reader.record.hash, match.record.hash);
  check_replay(&match, &shot);
  check_replay(&reader, &shot);
}

/* ---- Undo */

TEST(acts_are_undone) {
  begin_seats(CAROM_RULES_EIGHTBALL, 2);
  begin_match();
  const size_t begun = file_size;
  uint64_t hashes[8] = {match.record.hash};
  size_t sizes[8] = {file_size};
  int acts = 0;
  expect_ok(carom_match_place(&match, 0, 0.6, 0.5));
  for (int n = 0; n < 3; n++) {
    if (n > 0 && match.phase == CAROM_MATCH_STROKE)
      break;
    if (n == 0) {
      keep();
      hashes[++acts] = match.record.hash;
      sizes[acts] = file_size;
    }
    carom_cue cue = match.cue;
    cue.speed = 7.0;
    if (match.phase == CAROM_MATCH_STROKE) {
      carom_match_stroke(&match, match.seat, &cue, NULL, NULL);
      keep();
      hashes[++acts] = match.record.hash;
      sizes[acts] = file_size;
    }
  }
  expect_ok(carom_match_concede(&match, 1));
  keep();
  hashes[++acts] = match.record.hash;
  sizes[acts] = file_size;
  for (size_t size = file_size; acts > 0;) {
    size = carom_match_undone(file, size);
    ck_assert_uint_eq(size, sizes[--acts]);
    expect_ok(read_all(file, size));
    ck_assert_uint_eq(reader.record.hash, hashes[acts]);
  }
  ck_assert_uint_eq(carom_match_undone(file, begun), begun); /* nothing is left to be undone */
}

/* ---- Sets */

/* Concedes the match for a side, and begins the next one. */
static void lose(int side) {
  expect_ok(carom_match_concede(&match, side));
  keep();
}

TEST(sets_are_played_and_read) {
  static const struct {
    int64_t order;
    int loses[4], breaks[4]; /* which side loses match n, and which breaks it */
  } cases[] = {{CAROM_BREAKS_ALTERNATE, {0, 1, 1, 0}, {1, 0, 1, 0}},
               {CAROM_BREAKS_WINNER, {0, 1, 1, 0}, {1, 1, 0, 0}},
               {CAROM_BREAKS_LOSER, {0, 1, 1, 0}, {1, 0, 1, 1}}};
  for (size_t k = 0; k < COUNT_OF(cases); k++) {
    begin_seats(CAROM_RULES_TENBALL, 2);
    snprintf(seating.seat[0].name, CAROM_SEAT_NAME, "Ann");
    setup.side = 1;
    setup.set = &(carom_set){.race = 3, .order = cases[k].order, .timeouts = 1};
    begin_match();
    for (int n = 0; n < 4; n++) {
      ck_assert_int_eq(match.record.side, cases[k].breaks[n]);
      ck_assert_int_eq(match.record.set.number, n + 1);
      lose(cases[k].loses[n]);
      if (n == 3)
        break;
      ck_assert_msg(carom_match_next(&match) == CAROM_OK, "%s", match.fault);
      keep();
    }
    carom_standing standing;
    expect_ok(carom_match_standing(&match, &standing));
    ck_assert(standing.won[0] == 2 && standing.won[1] == 2 && standing.set_winner == 0);
    expect_ok(carom_match_next(&match));
    keep();
    expect_ok(carom_match_timeout(&match, match.seat));
    keep();
    lose(1);
    expect_ok(carom_match_standing(&match, &standing));
    ck_assert_int_eq(standing.set_winner, 1);
    char words[200];
    carom_match_string(&match, words, sizeof words);
    ck_assert_str_eq(words, "Ann (seat 0) has won");
    before = match;
    check_refusal("a set that is over", carom_match_next(&match), "over", "has been won");
    expect_ok(carom_match_end(&match));
    keep();
    check_recording("a set");

    /* another rack in the second match is rejected */
    char *number = strstr(strstr(file, "{\"end\""), "\"r\":[");
    number[7] = number[7] == '5' ? '6' : '5';
    ck_assert_int_eq(read_all(file, file_size), CAROM_ERROR_ACT);
  }
}

TEST(time_is_counted) {
  begin_seats(CAROM_RULES_EIGHTBALL, 2);
  setup.set = &(carom_set){.race = 1, .clock = 30.0, .extension = 30.0, .extensions = 1};
  begin_match();
  expect_ok(carom_match_extend(&match, 0));
  keep();
  before = match;
  check_refusal("a second extension", carom_match_extend(&match, 0), "time", "none is left");
  before = match;
  check_refusal("a timeout", carom_match_timeout(&match, 0), "time", "none is left");
  before = match;
  check_refusal("of another seat", carom_match_extend(&match, 1), "turn", "seat 0");
  check_recording("an extension");
}

/* ---- Handicaps, and what cannot begin */

TEST(handicaps) {
  static const struct {
    carom_rules_kind kind;
    int64_t handicap, points;
  } cases[] = {{CAROM_RULES_SNOOKER, 21, 21},
               {CAROM_RULES_STRAIGHT, 30, 30},
               {CAROM_RULES_THREECUSHION, 15, 15},
               {CAROM_RULES_ONEPOCKET, 2, 2},
               {CAROM_RULES_NINEBALL, 1, 0}};
  for (size_t k = 0; k < COUNT_OF(cases); k++)
    for (int64_t side = 0; side < 2; side++) {
      begin_seats(cases[k].kind, 2);
      seating.seat[1].handicap = cases[k].handicap;
      setup.side = side;
      begin_match();
      carom_standing standing;
      expect_ok(carom_match_standing(&match, &standing));
      ck_assert(standing.points[0] == 0 && standing.points[1] == cases[k].points);
      check_recording("a handicap");
    }

  /* the eight wins for who has it, and not for the other */
  for (int64_t side = 0; side < 2; side++) {
    begin_seats(CAROM_RULES_NINEBALL, 2);
    seating.seat[1].handicap = 1;
    setup.side = side;
    begin_match();
    carom_rules_state state = match.rules.state;
    state.opening = 0;
    const carom_facts facts = {
        .down = UINT32_C(1) << 8, .first = {8, -1}, .first_set = UINT32_C(1) << 8, .moved = 0x101};
    const carom_turn turn = match.rules.judge(&state, 0x301, 0, &facts, (carom_call){-1, -1});
    const carom_turn_outcome expected[] = {CAROM_TURN_KEEP, CAROM_TURN_WIN};
    ck_assert_int_eq(turn.outcome, expected[side]);
  }
}

/* ---- Points */

/* A random stroke, of a cue ball in hand from a random place. */
static void play_stroke(random_source *r, carom_rules_kind kind) {
  const int player = match.seat;
  const carom_bounds *b = &match.bounds;
  while (match.phase == CAROM_MATCH_PLACE) {
    const double x = random_between(r, b->low[0], b->high[0]);
    carom_match_place(&match, player, x, random_between(r, b->low[1], b->high[1]));
  }
  carom_cue cue = cue_of(kind);
  cue.phi = random_between(r, 0.0, 360.0);
  cue.speed = random_between(r, 1.0, 6.0);
  expect_ok(carom_match_stroke(&match, player, &cue, NULL, NULL));
}

/* Both sides lack a point or two. The points of a stroke are those of who played it, at once, and
 * at the end the winner has no fewer, also where a foul of the other ends the game. */
TEST(points_are_those_of_who_made_them) {
  static const struct {
    carom_rules_kind kind;
    int64_t handicap;
    int ends; /* of 20 games, at least */
  } rows[] = {{CAROM_RULES_PYRAMID, 5, 20},      {CAROM_RULES_BILLIARDS, 96, 20},
              {CAROM_RULES_ROTATION, 60, 15},    {CAROM_RULES_FOURBALL, 9, 1},
              {CAROM_RULES_STRAIGHTRAIL, 99, 1}, {CAROM_RULES_COWBOY, 0, 0}};
  int scored = 0;
  for (size_t k = 0; k < COUNT_OF(rows); k++) {
    int ends = 0;
    for (uint64_t seed = 1; seed <= 20; seed++) {
      random_source r = {seed};
      begin_seats(rows[k].kind, 2);
      for (int side = 0; side < 2; side++)
        seating.seat[side].handicap = rows[k].handicap;
      setup.seed = seed;
      begin_match();
      carom_standing earlier, later;
      for (int n = 0; n < 60 && match.phase != CAROM_MATCH_OVER; n++) {
        const int64_t side = match.record.side;
        expect_ok(carom_match_standing(&match, &earlier));
        play_stroke(&r, rows[k].kind);
        expect_ok(carom_match_standing(&match, &later));
        const carom_turn *turn = &match.ruling.turn;
        scored += turn->points > 0.0;
        if (turn->foul == CAROM_FOUL_NONE)
          ck_assert_msg((double)(later.points[side] - earlier.points[side]) == turn->points,
                        "game %d, seed %d: %d, then %d, by %g", (int)k, (int)seed,
                        (int)earlier.points[side], (int)later.points[side], turn->points);
      }
      if (match.phase != CAROM_MATCH_OVER)
        continue;
      ends++;
      ck_assert_msg(later.points[match.winner - 1] >= later.points[2 - match.winner],
                    "game %d, seed %d: %d has won at %d : %d", (int)k, (int)seed, (int)match.winner,
                    (int)later.points[0], (int)later.points[1]);
    }
    printf("%s: %d of 20 games ended\n", carom_rules_about_of(rows[k].kind)->name, ends);
    ck_assert(ends >= rows[k].ends);
  }
  ck_assert(scored > 20);
}

TEST(beginnings_that_are_refused) {
  static const struct {
    const char *words;
    carom_rules_kind kind;
    int seats;
    int64_t side, handicap, alternate, race;
    const char *name;
  } cases[] = {{"two sides", CAROM_RULES_NINEBALL, 3, 2, 0, 0, 0, ""},
               {"handicap is more", CAROM_RULES_EIGHTBALL, 2, 1, 1, 0, 0, ""},
               {"handicap is more", CAROM_RULES_NINEBALL, 2, 1, 9, 0, 0, ""},
               {"alternate", CAROM_RULES_NINEBALL, 2, 1, 0, 2, 0, ""},
               {"without a gap", CAROM_RULES_NINEBALL, 2, 3, 0, 0, 0, ""},
               {"side must be 0 to 7", CAROM_RULES_NINEBALL, 2, 8, 0, 0, 0, ""},
               {"name must have", CAROM_RULES_NINEBALL, 2, 1, 0, 0, 0, "a\"b"},
               {"race must be 1 to 1000", CAROM_RULES_NINEBALL, 2, 1, 0, 0, 1001, ""}};
  for (size_t k = 0; k < COUNT_OF(cases); k++) {
    begin_seats(cases[k].kind, cases[k].seats);
    carom_seat *last = &seating.seat[cases[k].seats - 1];
    last->side = cases[k].side;
    last->handicap = cases[k].handicap;
    snprintf(last->name, CAROM_SEAT_NAME, "%s", cases[k].name);
    seating.alternate = cases[k].alternate;
    const carom_set set = {.race = cases[k].race};
    if (cases[k].race > 0)
      setup.set = &set;
    ck_assert_int_eq(carom_match_begin_with(&match, &setup), CAROM_ERROR_ACT);
    ck_assert_msg(strstr(match.fault, cases[k].words) != NULL, "%s: %s", cases[k].words,
                  match.fault);
    ck_assert_int_eq(match.phase, CAROM_MATCH_NONE);
  }
}

TEST(layouts_that_the_rules_cannot_have) {
  static const struct {
    carom_rules_kind kind;
    int gone;
    const char *words;
  } cases[] = {{CAROM_RULES_EIGHTBALL, 8, "the game needs ball 8"},
               {CAROM_RULES_HEYBALL, 8, "the game needs ball 8"},
               {CAROM_RULES_BLACKBALL, 8, "the game needs ball 8"},
               {CAROM_RULES_SNOOKER, 21, "the game needs ball 21"},
               {CAROM_RULES_THREECUSHION, 2, "the game needs ball 2"},
               {CAROM_RULES_COWBOY, 3, "the game needs ball 3"},
               {CAROM_RULES_NINEBALL, -1, "no ball of the layout is on"},
               {CAROM_RULES_STRAIGHT, -1, "no ball of the layout is on"}};
  for (size_t k = 0; k < COUNT_OF(cases); k++) {
    const carom_rules_about *about = carom_rules_about_of(cases[k].kind);
    carom_shot_ball lie[CAROM_BALLS_MOST];
    carom_table_make((carom_table_kind)about->table, &table);
    const int count = carom_rack_size((carom_rack_kind)about->rack);
    expect_ok(carom_rack((carom_rack_kind)about->rack, &table, 1e-4, 1, lie, CAROM_BALLS_MOST));
    for (int b = 1; b < count; b++)
      if (b == cases[k].gone || cases[k].gone < 0)
        lie[b].state.label = CAROM_BALL_POCKETED;
    carom_match_setup layout = {
        .rules = cases[k].kind, .table = &table, .balls = lie, .count = count};
    ck_assert_int_eq(carom_match_begin_with(&match, &layout), CAROM_ERROR_ACT);
    ck_assert_msg(strstr(match.fault, cases[k].words) != NULL, "%s: %s", about->name, match.fault);
  }
}
