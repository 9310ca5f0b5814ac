/* Matches: what is refused, and by which name; rulings with their sections; recordings that are
 * judged; and random matches by random acts over all games. */
#include "carom_match.h"
#include "game_support.h"

static carom_match match, reader, stood;
static carom_record scratch;
static char file[1 << 22];
static size_t length;

static void keep(void) {
  ck_assert(length + (size_t)match.size < sizeof file);
  memcpy(file + length, match.text, (size_t)match.size);
  length += (size_t)match.size;
}

static void begin(carom_rules_kind kind, uint64_t seed, int player) {
  const carom_rules_about *about = carom_rules_about_of(kind);
  carom_table_make((carom_table_kind)about->table, &table);
  length = 0;
  ck_assert_int_eq(carom_match_begin(&match, kind, &table, seed, player), CAROM_OK);
  keep();
}

/* The same to one point with equal innings, where the game knows them. */
static void begin_short(carom_rules_kind kind, uint64_t seed, int player) {
  if (!knows_equal_innings(kind)) {
    begin(kind, seed, player);
    return;
  }
  length = 0;
  begin_equal(&match, kind, seed, player, 1);
  keep();
}

static carom_cue cue_of(carom_rules_kind kind) {
  carom_cue cue = carom_cue_of((carom_game)carom_rules_about_of(kind)->balls);
  cue.ball = match.cue_ball;
  return cue;
}

/* Reads text[size] by lines; returns the first status that is no CAROM_OK. */
static carom_status read_all(const char *text, size_t size) {
  memset(&reader, 0, sizeof reader);
  for (const char *line = text; line < text + size;) {
    const char *end = memchr(line, '\n', (size_t)(text + size - line));
    const char *next = end != NULL ? end + 1 : text + size;
    const carom_status status = carom_match_read(&reader, &scratch, line, (size_t)(next - line));
    if (status != CAROM_OK)
      return status;
    line = next;
  }
  return CAROM_OK;
}

/* ---- Refusals */

/* What an act that is refused may change. */
static void forget_refusal(carom_match *target) {
  target->refusal = 0;
  target->size = target->due = 0;
  memset(target->fault, 0, sizeof target->fault);
  memset(target->text, 0, sizeof target->text);
}

static void check_refusal(carom_status status, carom_refusal why, const char *words) {
  ck_assert_int_eq(status, CAROM_ERROR_ACT);
  ck_assert_msg(match.refusal == (int32_t)why && strstr(match.fault, words) != NULL, "%s: %s",
                carom_refusal_name(match.refusal), match.fault);
  ck_assert_int_eq(match.size, 0);
  reader = match;
  forget_refusal(&stood);
  forget_refusal(&reader);
  ck_assert_msg(memcmp(&reader, &stood, sizeof reader) == 0, "%s: changed the match", match.fault);
}

#define refused(act, why, said) (stood = match, check_refusal(act, why, said))

TEST(acts_that_are_refused) {
  carom_shot_options stop = {.time_most = 0.1};
  memset(&match, 0, sizeof match);
  refused(carom_match_place(&match, 0, 0.5, 0.5), CAROM_REFUSED_NOT_BEGUN, "not begun");
  begin(CAROM_RULES_EIGHTBALL, 1, 1);
  carom_cue cue = cue_of(CAROM_RULES_EIGHTBALL);
  cue.speed = 9.0;
  ck_assert_int_eq(match.phase, CAROM_MATCH_PLACE);
  refused(carom_match_place(&match, 0, 0.6, 0.6), CAROM_REFUSED_TURN, "player 1");
  refused(carom_match_place(&match, 1, 0.6, 1.0), CAROM_REFUSED_BOUNDS, "0.635");
  refused(carom_match_stroke(&match, 1, &cue, NULL, NULL), CAROM_REFUSED_IN_HAND, "place");
  refused(carom_match_choose(&match, 1, CAROM_CHOICE_PASS), CAROM_REFUSED_CHOICE, "none");
  ck_assert_int_eq(carom_match_place(&match, 1, 0.6, 0.6), CAROM_OK);
  ck_assert_int_eq(carom_match_place(&match, 1, 0.635, 0.6),
                   CAROM_OK); /* it may be put elsewhere */
  refused(carom_match_continue(&match, NULL, NULL), CAROM_REFUSED_AT_REST, "no ball moves");
  refused(carom_match_call(&match, 1, (carom_call){0, 1}), CAROM_REFUSED_CALL, "1, 2, 3");
  refused(carom_match_call(&match, 1, (carom_call){3, 6}), CAROM_REFUSED_CALL, "0 to 5");
  cue.ball = 3;
  refused(carom_match_stroke(&match, 1, &cue, NULL, NULL), CAROM_REFUSED_CUE_BALL, "cue_ball");
  cue.ball = 0;
  cue.theta = -1.0;
  refused(carom_match_stroke(&match, 1, &cue, NULL, NULL), CAROM_REFUSED_STROKE, "theta");
  cue.theta = 0.0;
  stop.first_of = UINT64_C(1) << 40;
  refused(carom_match_stroke(&match, 1, &cue, &stop, NULL), CAROM_REFUSED_STROKE, "first_of");
  stop.first_of = 0;

  /* while balls move */
  ck_assert_int_eq(carom_match_stroke(&match, 1, &cue, &stop, NULL), CAROM_STOPPED_AT_TIME);
  ck_assert_int_eq(match.phase, CAROM_MATCH_MOVING);
  refused(carom_match_stroke(&match, 1, &cue, NULL, NULL), CAROM_REFUSED_MOVING, "continue");
  refused(carom_match_call(&match, 1, (carom_call){1, 1}), CAROM_REFUSED_MOVING, "continue");
  ck_assert_int_eq(match.rulings, 0);
  ck_assert_int_eq(carom_match_continue(&match, NULL, NULL), CAROM_OK);
  ck_assert_int_eq(match.rulings, 1);

  /* the end */
  ck_assert_int_eq(carom_match_concede(&match, 0), CAROM_OK);
  ck_assert(match.phase == CAROM_MATCH_OVER && match.winner == 2);
  refused(carom_match_stroke(&match, 1, &cue, NULL, NULL), CAROM_REFUSED_OVER, "over");
}

/* A free ball is named by a call, and a cue ball in hand is placed: neither is a choice. */
TEST(what_is_no_choice) {
  const int count = lay_out(CAROM_RACK_SNOOKER, CAROM_TABLE_SNOOKER, ALL);
  carom_plan_rules rules = carom_plan_rules_of(CAROM_RULES_SNOOKER);
  rules.state.may = CAROM_CHOICE_PASS | CAROM_CHOICE_FREE_BALL | CAROM_CHOICE_PLACE;
  ck_assert_int_eq(carom_match_begin_at(&match, CAROM_RULES_SNOOKER, &rules, &table, balls, count,
                                        NULL, CAROM_LEAVE_D, 0),
                   CAROM_OK);
  static const carom_choice none[] = {CAROM_CHOICE_FREE_BALL, CAROM_CHOICE_PLACE,
                                      CAROM_CHOICE_RACK};
  for (size_t k = 0; k < sizeof none / sizeof none[0]; k++)
    refused(carom_match_choose(&match, 0, none[k]), CAROM_REFUSED_CHOICE,
            "choices are: pass; a free ball is named by a call");
}

/* A cue ball that was placed lies no longer where it lay, so it cannot stay there. */
TEST(a_place_before_the_choice_to_stay) {
  carom_table_make(CAROM_TABLE_POOL_9FT, &table);
  ck_assert_int_eq(carom_rack(CAROM_RACK_EIGHTBALL, &table, 1e-4, 1, balls, 16), CAROM_OK);
  balls[0].state.r[1] = 1.2;
  carom_plan_rules rules = carom_plan_rules_of(CAROM_RULES_EIGHTBALL);
  rules.state.may = CAROM_CHOICE_RACK | CAROM_CHOICE_STAY;
  ck_assert_int_eq(carom_match_begin_at(&match, CAROM_RULES_EIGHTBALL, &rules, &table, balls, 16,
                                        NULL, CAROM_LEAVE_KITCHEN, 0),
                   CAROM_OK);
  const carom_match begun = match;
  ck_assert_int_eq(carom_match_place(&match, 0, 0.9, 0.2), CAROM_OK);
  ck_assert_int_eq(match.may, CAROM_CHOICE_RACK);
  refused(carom_match_choose(&match, 0, CAROM_CHOICE_STAY), CAROM_REFUSED_CHOICE,
          "choices are: rack");

  match = begun;
  ck_assert_int_eq(carom_match_choose(&match, 0, CAROM_CHOICE_STAY), CAROM_OK);
  ck_assert(match.phase == CAROM_MATCH_STROKE && match.record.balls[0].state.r[1] == 1.2);
}

/* Where the clock runs out before the cue ball is placed, it lies nowhere, so it cannot stay. */
TEST(a_clock_before_the_place) {
  for (int kind = 0; carom_rules_about_of((carom_rules_kind)kind) != NULL; kind++) {
    begin((carom_rules_kind)kind, 1, 0);
    if (match.phase != CAROM_MATCH_PLACE)
      continue;
    ck_assert_int_eq(carom_match_clock(&match, 0), CAROM_OK);
    if (match.rules.any_cue_ball != 0)
      ck_assert_int_eq(match.record.balls[0].state.label, CAROM_BALL_STATIONARY);
    else
      ck_assert_int_eq(match.phase, CAROM_MATCH_PLACE);
    refused(carom_match_choose(&match, (int)match.record.player, CAROM_CHOICE_STAY),
            CAROM_REFUSED_CHOICE, "the choices are");
  }
}

/* ---- Breaks */

/* A break so soft that it fails, in each game that has a rule for that: what the other may do. He
 * breaks a new rack himself, or has the player do so. */
TEST(breaks_that_fail) {
  enum { RACK = CAROM_CHOICE_RACK, BOTH = CAROM_CHOICE_RACK | CAROM_CHOICE_OTHER_RACK };
  static const struct {
    carom_rules_kind kind;
    int32_t options, phase, leave;
  } cases[] = {
      {CAROM_RULES_EIGHTBALL, BOTH, CAROM_MATCH_STROKE, CAROM_LEAVE_AFTER},
      {CAROM_RULES_HEYBALL, BOTH, CAROM_MATCH_STROKE, CAROM_LEAVE_AFTER},
      {CAROM_RULES_NINEBALL, 0, CAROM_MATCH_PLACE, CAROM_LEAVE_ANYWHERE},
      {CAROM_RULES_TENBALL, 0, CAROM_MATCH_PLACE, CAROM_LEAVE_ANYWHERE},
      {CAROM_RULES_STRAIGHT, CAROM_CHOICE_PASS, CAROM_MATCH_STROKE, CAROM_LEAVE_AFTER},
      {CAROM_RULES_BANK, CAROM_CHOICE_PASS, CAROM_MATCH_STROKE, CAROM_LEAVE_AFTER},
      {CAROM_RULES_BLACKBALL, RACK | CAROM_CHOICE_STAY, CAROM_MATCH_PLACE, CAROM_LEAVE_BAULK},
      {CAROM_RULES_ROTATION, RACK, CAROM_MATCH_PLACE, CAROM_LEAVE_KITCHEN},
      {CAROM_RULES_PYRAMID, RACK, CAROM_MATCH_STROKE, CAROM_LEAVE_AFTER},
  };
  for (size_t k = 0; k < sizeof cases / sizeof cases[0]; k++)
    for (int choice = 0; choice < 3; choice++) {
      static const int32_t choices[] = {0, CAROM_CHOICE_RACK, CAROM_CHOICE_OTHER_RACK};
      begin(cases[k].kind, 1, 0);
      const double y = match.bounds.high[1];
      ck_assert_int_eq(carom_match_place(&match, 0, 0.5 * table.width, y), CAROM_OK);
      carom_cue cue = cue_of(cases[k].kind);
      cue.phi = 90.0;
      cue.speed = 0.24 * table.length;
      ck_assert_int_eq(carom_match_stroke(&match, 0, &cue, NULL, NULL), CAROM_OK);
      ck_assert_msg(match.record.player == 1 && match.may == cases[k].options &&
                        match.phase == cases[k].phase && match.leave == cases[k].leave,
                    "%s: player %d, may %d, phase %d, leave %d, foul %d",
                    carom_rules_about_of(cases[k].kind)->name, (int)match.record.player, match.may,
                    match.phase, match.leave, match.ruling.turn.foul);
      if ((cases[k].options & choices[choice]) == 0)
        continue;
      ck_assert_int_eq(carom_match_choose(&match, 1, (carom_choice)choices[choice]), CAROM_OK);
      ck_assert(match.phase == CAROM_MATCH_PLACE && match.rules.state.opening == 1 &&
                match.record.player == (choices[choice] == CAROM_CHOICE_RACK));
      ck_assert(fabs(match.record.balls[1].state.r[1] - 0.75 * table.length) < 0.3);
    }
}

/* WPA 3.3(e) and (f): an eight that falls on the break comes back, and who has the table may have a
 * new rack; with the cue ball in the pocket too, that is the other, from behind the head string. */
TEST(the_eight_on_the_break) {
  for (int falls = 0; falls < 2; falls++)
    for (int racks = 0; racks < 2; racks++) {
      const carom_rules_kind kind = CAROM_RULES_EIGHTBALL;
      const int count = lay_out(CAROM_RACK_EIGHTBALL, CAROM_TABLE_POOL_9FT, 0xffff);
      carom_plan_rules game_rules = carom_plan_rules_of(kind);
      game_rules.state.opening = 1;
      put(8, 0.04, 0.04);
      put(0, 0.3, 0.3);
      ck_assert_int_eq(carom_match_begin_at(&match, kind, &game_rules, &table, balls, count, NULL,
                                            CAROM_LEAVE_AFTER, 0),
                       CAROM_OK);
      carom_cue cue = cue_of(kind);
      cue.phi = 225.0;
      cue.speed = 2.0;
      cue.b = falls ? 0.4 : -0.3;
      ck_assert_int_eq(carom_match_stroke(&match, 0, &cue, NULL, NULL), CAROM_OK);
      const uint32_t down = match.ruling.facts.down;
      ck_assert_msg(down == (falls ? 0x101U : 0x100U), "down %x", down);
      ck_assert_int_eq(match.record.player, falls);
      ck_assert_int_eq(match.phase, falls ? CAROM_MATCH_PLACE : CAROM_MATCH_STROKE);
      ck_assert_int_eq(match.may, CAROM_CHOICE_RACK);
      ck_assert_int_eq(match.record.balls[8].state.label, CAROM_BALL_STATIONARY);
      if (falls)
        ck_assert_double_eq(match.bounds.high[1], 0.25 * table.length);
      if (racks == 0)
        continue;
      ck_assert_int_eq(carom_match_choose(&match, falls, CAROM_CHOICE_RACK), CAROM_OK);
      ck_assert(match.rules.state.opening == 1 && match.record.player == falls &&
                match.phase == CAROM_MATCH_PLACE);
    }
}

/* WPA 1.5: the cue ball falls, and comes in hand behind the head string, at y = 0.635 m. Where all
 * balls that are on lie behind it too, the player may have the nearest one spotted, and of those
 * that are equally near the one that was named, else the lowest. */
TEST(balls_behind_the_head_string) {
  enum { SPOT = CAROM_CHOICE_SPOT };
  static const struct {
    carom_rules_kind kind;
    double y[3]; /* of the balls 1 to 3 */
    int32_t choices, named, spotted;
  } cases[] = {
      {CAROM_RULES_STRAIGHT, {0.2, 0.4, 0.6}, SPOT, NONE, 3},
      {CAROM_RULES_STRAIGHT, {0.2, 0.4, 0.635}, 0, NONE, NONE}, /* on the head string */
      {CAROM_RULES_STRAIGHT, {0.2, 0.4, 1.6}, 0, NONE, NONE},
      {CAROM_RULES_ONEPOCKET, {0.5, 0.5, 0.3}, SPOT, NONE, 1},
      {CAROM_RULES_ONEPOCKET, {0.5, 0.5, 0.3}, SPOT, 2, 2},
      {CAROM_RULES_ONEPOCKET, {0.5, 0.5, 0.3}, SPOT, 3, 1}, /* it is not among the nearest */
      {CAROM_RULES_BANK, {0.3, 0.5, 0.5}, SPOT, 3, 3},
      {CAROM_RULES_ROTATION, {0.3, 0.5, 1.6}, SPOT, NONE, 1}, /* the 1 alone is on */
      {CAROM_RULES_ROTATION, {0.7, 0.5, 0.3}, 0, NONE, NONE},
      {CAROM_RULES_EIGHTBALL, {0.2, 0.4, 0.6}, 0, NONE, NONE}, /* in hand anywhere */
  };
  for (size_t k = 0; k < sizeof cases / sizeof cases[0]; k++) {
    const carom_rules_about *about = carom_rules_about_of(cases[k].kind);
    const int count = lay_out((carom_rack_kind)about->rack, CAROM_TABLE_POOL_9FT, 0);
    carom_plan_rules game_rules = carom_plan_rules_of(cases[k].kind);
    if (cases[k].kind == CAROM_RULES_ONEPOCKET || cases[k].kind == CAROM_RULES_BANK)
      game_rules.state.score[1] = 7; /* the balls that are down */
    put(0, 1.1, 0.17);
    for (int i = 0; i < 3; i++)
      put(i + 1, 0.3 + 0.2 * i, cases[k].y[i]);
    for (int i = 4; i <= 8; i++)
      put(i, 0.1 * i, 0.1);
    ck_assert_int_eq(carom_match_begin_at(&match, cases[k].kind, &game_rules, &table, balls, count,
                                          NULL, CAROM_LEAVE_AFTER, 0),
                     CAROM_OK);
    length = 0;
    keep();
    carom_cue cue = cue_of(cases[k].kind);
    cue.phi = 315.0;
    cue.speed = 1.0;
    ck_assert_int_eq(carom_match_stroke(&match, 0, &cue, NULL, NULL), CAROM_OK);
    keep();
    ck_assert_int_eq(match.ruling.turn.foul, CAROM_FOUL_CUE_BALL);
    ck_assert_msg(match.may == cases[k].choices, "row %d: may %d", (int)k, match.may);
    if (cases[k].choices == 0) {
      refused(carom_match_choose(&match, 1, CAROM_CHOICE_SPOT), CAROM_REFUSED_CHOICE,
              "the choices");
      continue;
    }

    /* the choice; then the ball is in the way of nobody, and the cue ball is still in hand */
    if (cases[k].named > 0) {
      ck_assert_int_eq(carom_match_call(&match, 1, (carom_call){cases[k].named, 1}), CAROM_OK);
      keep();
    }
    ck_assert_int_eq(carom_match_choose(&match, 1, CAROM_CHOICE_SPOT), CAROM_OK);
    keep();
    const int ball = cases[k].spotted;
    memcpy(balls, match.record.balls, sizeof balls);
    ck_assert_msg(is_at(ball, 0.5 * table.width, 0.75 * table.length), "row %d: ball %d", (int)k,
                  ball);
    ck_assert_uint_eq(match.ruling.put, 1U << ball);
    ck_assert(match.phase == CAROM_MATCH_PLACE && match.leave == CAROM_LEAVE_KITCHEN &&
              match.record.player == 1 && match.may == 0);
    ck_assert_msg(read_all(file, length) == CAROM_OK, "row %d: %s", (int)k, reader.fault);
    ck_assert_mem_eq(reader.record.balls, match.record.balls, sizeof match.record.balls);
  }
}

/* ---- Recordings */

/* Plays random strokes until some are ruled; the file has all lines. */
static void play_some(carom_rules_kind kind, uint64_t seed, int strokes) {
  random_source r = {seed};
  begin(kind, seed, (int)(seed & 1));
  for (int k = 0; k < strokes && match.phase != CAROM_MATCH_OVER; k++) {
    const int player = (int)match.record.player;
    const carom_bounds *b = &match.bounds;
    while (match.phase == CAROM_MATCH_PLACE) {
      const double y = random_between(&r, b->low[1], b->high[1]);
      const double x = random_between(&r, b->low[0], b->high[0]);
      if (carom_match_place(&match, player, x, y) == CAROM_OK)
        keep();
    }
    carom_cue cue = cue_of(kind);
    cue.phi = random_between(&r, 0.0, 360.0);
    cue.speed = random_between(&r, 0.5, 6.0);
    ck_assert_int_eq(carom_match_stroke(&match, player, &cue, NULL, NULL), CAROM_OK);
    keep();
  }
  ck_assert_int_eq(carom_match_end(&match), CAROM_OK);
  keep();
}

/* A match that is read again is the same; one of which any line is changed, left out or doubled is
 * refused, but for a file that ends behind a line, which goes on where it was cut off. */
TEST(recordings_are_judged) {
  for (int kind = 0; carom_rules_about_of((carom_rules_kind)kind) != NULL; kind++) {
    play_some((carom_rules_kind)kind, 11, 12);
    ck_assert_msg(read_all(file, length) == CAROM_OK, "game %d: %s", kind, reader.fault);
    ck_assert_mem_eq(reader.record.balls, match.record.balls, sizeof match.record.balls);
    ck_assert_mem_eq(&reader.rules.state, &match.rules.state, sizeof match.rules.state);
    ck_assert_uint_eq(reader.record.hash, match.record.hash);
  }

  /* every line but the last left out, doubled, or with a digit changed */
  static char forged[sizeof file];
  int lines = 0, refused_lines = 0;
  for (char *line = file; line < file + length;) {
    char *end = memchr(line, '\n', (size_t)(file + length - line));
    const size_t offset = (size_t)(line - file), size_of_line = (size_t)(end + 1 - line);
    char *digit = line + strcspn(line, "123456789");
    for (int how = 0; how < 3; how++) {
      if (how == 0 && end + 1 == file + length)
        continue; /* it is cut off, which carom verify tells */
      size_t n = offset;
      memcpy(forged, file, length);
      if (how == 2 && digit < end)
        forged[digit - file] = *digit == '1' ? '2' : '1';
      if (how == 1) {
        memcpy(forged + n, line, size_of_line);
        n += size_of_line;
      }
      const char *rest = how == 0 ? end + 1 : line;
      if (how < 2) {
        memcpy(forged + n, rest, (size_t)(file + length - rest));
        n += (size_t)(file + length - rest);
      } else {
        n = length;
      }
      const bool same = how == 2 && digit >= end;
      const bool plain = lines < 3 && how == 1; /* a second line of a table or of options */
      const carom_status status = read_all(forged, n);
      ck_assert_msg(same || plain || status < 0, "line %d, %d: %.60s", lines + 1, how, line);
      refused_lines += status < 0;
    }
    lines++;
    line = end + 1;
  }
  ck_assert(lines > 20 && refused_lines > 2 * lines);
}

/* A file that was cut off behind a shot: the reader knows the ruling, has the lines that are
 * missing, and the other player goes on. */
TEST(cut_off_behind_a_shot) {
  play_some(CAROM_RULES_STRAIGHT, 3, 1);
  const char *shot = strstr(file, "{\"shot\"");
  const char *end = strchr(shot, '\n') + 1;
  ck_assert_int_eq(read_all(file, (size_t)(end - file)), CAROM_OK);
  ck_assert(reader.size > 0 && memcmp(reader.text, end, (size_t)reader.size) == 0);
  ck_assert_int_eq(reader.record.player, match.record.player);
}

/* ---- Random matches */

/* One random act, most of which are refused: with a name, and with nothing changed. */
static carom_status act(random_source *r, carom_rules_kind kind) {
  const int player = (int)match.record.player ^ (random_between(r, 0.0, 1.0) < 0.05);
  const carom_bounds *b = &match.bounds;
  const double what = random_between(r, 0.0, 1.0);
  carom_cue cue = cue_of(kind);
  const carom_shot_options stop = {.time_most = random_between(r, 0.0, 1.0) < 0.1 ? 0.3 : 0.0};
  if (match.phase == CAROM_MATCH_MOVING && what < 0.7)
    return carom_match_continue(&match, NULL, NULL);
  if (what < 0.1) {
    const int ball = (int)random_between(r, -2.0, 23.0);
    return carom_match_call(&match, player, (carom_call){ball, (int)random_between(r, -1.0, 7.0)});
  }
  if (what < 0.25)
    return carom_match_choose(&match, player,
                              (carom_choice)(1 << (int)random_between(r, 0.0, 8.999)));
  if (what < 0.255)
    return carom_match_clock(&match, player);
  if (what < 0.2552)
    return carom_match_concede(&match, player);
  if (match.phase == CAROM_MATCH_PLACE && what < 0.9) {
    const double y = random_between(r, b->low[1] - 0.1, b->high[1] + 0.1);
    return carom_match_place(&match, player, random_between(r, b->low[0], b->high[0]), y);
  }
  if (match.rules.any_cue_ball != 0 && what < 0.7)
    cue.ball = (int)random_between(r, -0.999, 16.999);
  cue.phi = random_between(r, 0.0, 360.0);
  cue.speed = random_between(r, 0.2, 9.0);
  cue.theta = random_between(r, 0.0, 1.0) < 0.1 ? 30.0 : 0.0;
  return carom_match_stroke(&match, player, &cue, &stop, NULL);
}

/* Over all games: no dead end, no standing that a game cannot have, every refusal with a name and
 * nothing changed, every file that is read again. CAROM_TEST_DRAWS: how many acts. */
TEST(random_matches) {
  const uint64_t seed = test_seed();
  const long most = draws_of_each(4000);
  long acts = 0, accepted = 0, over = 0, drawn = 0, games = 0,
       refusals[CAROM_REFUSED_LINE + 1] = {0};
  printf("random matches: seed %llu\n", (unsigned long long)seed);
  static carom_match saved;
  int kinds = 0;
  while (carom_rules_about_of((carom_rules_kind)kinds) != NULL)
    kinds++;
  for (uint64_t game = 0; acts < most; game++) {
    random_source r = {seed + game};
    const carom_rules_kind kind = (carom_rules_kind)(game % (uint64_t)kinds);
    if (game / (uint64_t)kinds % 2 == 0)
      begin(kind, seed + game, (int)(game & 1));
    else
      begin_short(kind, seed + game, (int)(game & 1));
    games++;
    int idle = 0;
    for (int n = 0; n < 120 && match.phase != CAROM_MATCH_OVER; n++, acts++) {
      saved = match;
      const carom_status status = act(&r, kind);
      if (status >= 0) {
        const char *range = "", *wrong = carom_rules_fault(kind, &match.rules.state, &range);
        ck_assert_msg(wrong == NULL, "seed %llu: %s must be %s", (unsigned long long)(seed + game),
                      wrong, range);
        ck_assert_msg(match.size > 0, "seed %llu: no line", (unsigned long long)(seed + game));
        ck_assert(match.phase == CAROM_MATCH_OVER || match.on != 0);
        keep();
        accepted++;
        idle = 0;
        continue;
      }
      ck_assert_int_eq(status, CAROM_ERROR_ACT);
      ck_assert(carom_refusal_name(match.refusal)[0] != '\0' && match.fault[0] != '\0');
      refusals[match.refusal]++;
      ck_assert_msg(match.refusal != CAROM_REFUSED_STROKE, "seed %llu: no stroke can be played: %s",
                    (unsigned long long)(seed + game), match.fault);
      ck_assert(match.record.hash == saved.record.hash && match.phase == saved.phase &&
                match.record.player == saved.record.player && match.may == saved.may);
      ck_assert_msg(++idle < 100, "seed %llu: a dead end: %s", (unsigned long long)(seed + game),
                    match.fault);
    }
    over += match.phase == CAROM_MATCH_OVER;
    drawn += match.winner == CAROM_DRAWN;
    ck_assert_msg(read_all(file, length) == CAROM_OK, "seed %llu, game %d: %s",
                  (unsigned long long)(seed + game), (int)kind, reader.fault);
    ck_assert_int_eq(reader.size, 0);
    ck_assert_uint_eq(reader.record.hash, match.record.hash);
  }
  printf("%ld acts, %ld taken, %ld games, %ld of them over, %ld drawn; refused:\n", acts, accepted,
         games, over, drawn);
  for (int why = 1; why <= CAROM_REFUSED_LINE; why++)
    printf("%s %ld\n", carom_refusal_name(why), refusals[why]);
}
