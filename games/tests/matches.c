/* Matches: what is rejected, and by which name; rulings with their sections; recordings that are
 * judged; and random matches by random acts over all games. */
#include "match_support.h"

/* Before the match begins no act is taken. */
TEST(not_begun) {
  memset(&match, 0, sizeof match);
  before = match;
  check_refusal("place", carom_match_place(&match, 0, 0.5, 0.5), "not_begun", "not begun");
}

/* Where the clock runs out before the cue ball is placed, it lies nowhere, so it cannot stay. */
TEST(a_clock_before_the_place) {
  for (int kind = 0; carom_rules_about_of((carom_rules_kind)kind) != NULL; kind++) {
    begin((carom_rules_kind)kind, 1, 0, 0);
    if (match.phase != CAROM_MATCH_PLACE)
      continue;
    expect_ok(carom_match_clock(&match, 0));
    if (match.rules.any_cue_ball != 0)
      ck_assert_int_eq(match.record.balls[0].state.label, CAROM_BALL_STATIONARY);
    else
      ck_assert_int_eq(match.phase, CAROM_MATCH_PLACE);
    before = match;
    check_refusal("clock", carom_match_choose(&match, (int)match.record.player, CAROM_CHOICE_STAY),
                  "choice", "the choices are");
  }
}

/* ---- Recordings */

/* Plays random strokes until some are ruled; the file has all lines. */
static void play_some(carom_rules_kind kind, uint64_t seed, int strokes) {
  random_source r = {seed};
  begin(kind, seed, (int)(seed & 1), 0);
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
    expect_ok(carom_match_stroke(&match, player, &cue, NULL, NULL));
    keep();
  }
  expect_ok(carom_match_end(&match));
  keep();
}

/* A match that is read again is the same; one of which any line is changed, left out or doubled is
 * rejected, but for a file that ends behind a line, which continues where it was cut off. */
TEST(recordings_are_judged) {
  for (int kind = 0; carom_rules_about_of((carom_rules_kind)kind) != NULL; kind++) {
    play_some((carom_rules_kind)kind, 11, 12);
    check_recording(carom_rules_about_of((carom_rules_kind)kind)->name);
  }

  /* every line but the last left out, doubled, or with a digit changed */
  static char forged[sizeof file];
  int lines = 0, refused_lines = 0;
  for (char *line = file; line < file + file_size;) {
    char *end = memchr(line, '\n', (size_t)(file + file_size - line));
    const size_t offset = (size_t)(line - file), size_of_line = (size_t)(end + 1 - line);
    char *digit = line + strcspn(line, "123456789");
    for (int how = 0; how < 3; how++) {
      if (how == 0 && end + 1 == file + file_size)
        continue; /* it is cut off, which carom verify tells */
      /* the lines before it, twice this one or its digit, and the lines behind it */
      const char *const rest = how == 1 ? line : end + 1;
      size_t n = offset + (how == 0 ? 0 : size_of_line);
      memcpy(forged, file, n);
      memcpy(forged + n, rest, (size_t)(file + file_size - rest));
      n += (size_t)(file + file_size - rest);
      if (how == 2 && digit < end)
        forged[digit - file] = *digit == '1' ? '2' : '1';
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
 * missing, and the other player continues. */
TEST(cut_off_behind_a_shot) {
  play_some(CAROM_RULES_STRAIGHT, 3, 1);
  const char *shot = strstr(file, "{\"shot\"");
  const char *end = strchr(shot, '\n') + 1;
  expect_ok(read_all(file, (size_t)(end - file)));
  ck_assert(reader.size > 0 && memcmp(reader.text, end, (size_t)reader.size) == 0);
  ck_assert_int_eq(reader.record.player, match.record.player);
}

/* ---- Random matches */

/* One random act, most of which are rejected: with a name, and with nothing changed. */
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
  const long most = draws_of_test(2000, 4000);
  long acts = 0, over = 0, refusals[CAROM_REFUSED_LINE + 1] = {0};
  printf("random matches: seed %llu\n", (unsigned long long)seed);
  static carom_match saved;
  int kinds = 0;
  while (carom_rules_about_of((carom_rules_kind)kinds) != NULL)
    kinds++;
  for (uint64_t game = 0; acts < most; game++) {
    random_source r = {seed + game};
    const carom_rules_kind kind = (carom_rules_kind)(game % (uint64_t)kinds);
    const bool is_short = game / (uint64_t)kinds % 2 != 0 && knows_equal_innings(kind);
    begin(kind, seed + game, (int)(game & 1), is_short);
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
        idle = 0;
        continue;
      }
      ck_assert_int_eq(status, CAROM_ERROR_ACT);
      ck_assert(match.refusal != CAROM_REFUSED_NOT && match.fault[0] != '\0');
      refusals[match.refusal]++;
      ck_assert_msg(match.refusal != CAROM_REFUSED_STROKE, "seed %llu: no stroke can be played: %s",
                    (unsigned long long)(seed + game), match.fault);
      ck_assert(match.record.hash == saved.record.hash && match.phase == saved.phase &&
                match.record.player == saved.record.player && match.may == saved.may);
      ck_assert_msg(++idle < 100, "seed %llu: a dead end: %s", (unsigned long long)(seed + game),
                    match.fault);
    }
    over += match.phase == CAROM_MATCH_OVER;
    check_recording(carom_rules_about_of(kind)->name);
  }
  printf("%ld acts, %ld games are over; refused:\n", acts, over);
  for (int why = 1; why <= CAROM_REFUSED_LINE; why++)
    printf("%s %ld\n", carom_word(CAROM_WORDS_REFUSAL, (int)why), refusals[why]);
}
