/* Three-cushion and straight rail: own cue balls, and balls that go to their spots. */
#include "carom_match.h"
#include "game_support.h"

enum { WHITE = 0, YELLOW_CUE = 1, RED = 2, SPOTS = CAROM_CHOICE_SPOT };

static void begin(carom_match *match, carom_rules_kind kind, int player) {
  carom_table_make(CAROM_TABLE_THREECUSHION, &table);
  ck_assert_int_eq(carom_match_begin(match, kind, &table, 1, player), CAROM_OK);
}

static bool lies_at(const carom_shot_ball *ball, double across, double along) {
  return ball->state.label == CAROM_BALL_STATIONARY &&
         hypot(ball->state.r[0] - across * table.width, ball->state.r[1] - along * table.length) <
             1e-3;
}

/* Who begins has the white or the yellow, beside the other cue ball, and must meet the red. */
TEST(cue_balls_of_straight_rail) {
  static carom_match match;
  for (int player = 0; player < 2; player++) {
    begin(&match, CAROM_RULES_STRAIGHTRAIL, player);
    const carom_shot_ball *lies = match.record.balls;
    ck_assert(match.cue_ball == player && match.on == 1 << RED && match.record.count == 3);
    ck_assert(lies_at(&lies[player], 0.5 + 0.1825 / 1.42, 0.25));
    ck_assert(lies_at(&lies[1 - player], 0.5, 0.25) && lies_at(&lies[RED], 0.5, 0.75));

    /* a stroke that meets none gives the table to the other cue ball, which may meet any ball */
    carom_cue cue = carom_cue_of(CAROM_GAME_BILLIARD);
    cue.ball = match.cue_ball;
    cue.phi = 0.0;
    cue.speed = 0.5;
    ck_assert_int_eq(carom_match_stroke(&match, player, &cue, NULL, NULL), CAROM_OK);
    ck_assert(match.record.player == 1 - player && match.cue_ball == 1 - player);
    ck_assert_int_eq(match.on, 7 & ~(1 << match.cue_ball));
  }
}

/* A ball off the table, and a choice to spot: in straight rail all balls lie as for the opening of
 * the next player; in three-cushion the others stay. */
TEST(balls_are_spotted) {
  static const carom_rules_kind kinds[] = {CAROM_RULES_STRAIGHTRAIL, CAROM_RULES_THREECUSHION};
  for (int k = 0; k < 8; k++) {
    const bool is_whole = k % 2 == 0, asks = k / 2 % 2 == 1, yellow = k / 4 == 1;
    carom_plan_rules game_rules = carom_plan_rules_of(kinds[k % 2]);
    const int count = lay_out(CAROM_RACK_THREECUSHION, CAROM_TABLE_THREECUSHION, 7);
    const double R = balls[0].kind.radius;
    const int struck = yellow ? YELLOW_CUE : WHITE, opponent = 1 - struck;
    game_rules.state.group = 1 + struck;
    game_rules.state.may = asks ? SPOTS : 0;
    put(struck, 0.3, 0.9);
    put(opponent, 1.1, 2.5);
    put(RED, 0.3 + 2.0 * R, 0.9);

    /* the player whose cue ball touches the red asks; or the red leaves the table */
    carom_facts facts = facts_of(NONE, 0, 0, asks ? 0 : 1 << RED);
    if (!asks)
      game_rules.state.group = 1 + opponent;
    const carom_call call = {asks ? CAROM_CALL_SPOT : NONE, -1};
    carom_turn turn = game_rules.judge(&game_rules.state, 7, struck, &facts, call);
    ck_assert_int_eq(turn.outcome, asks ? KEEP : PASS);
    carom_turn_settle(&game_rules, &game_rules.state, &table, balls, count, &turn);
    ck_assert_msg(lies_at(&balls[RED], 0.5, 0.75) && game_rules.state.may == 0, "case %d: red", k);
    if (is_whole) {
      ck_assert_msg(lies_at(&balls[struck], 0.5 + 0.1825 / 1.42, 0.25), "case %d: own", k);
      ck_assert_msg(lies_at(&balls[opponent], 0.5, 0.25), "case %d: other", k);
    } else {
      ck_assert_msg(is_at(opponent, 1.1, 2.5), "case %d: the other stays", k);
      ck_assert_msg(asks ? lies_at(&balls[struck], 0.5, 0.25) : is_at(struck, 0.3, 0.9), "case %d",
                    k);
    }
  }
}

/* A plan finds a point of straight rail that three-cushion would not count. */
TEST(a_point_is_planned) {
  const int count = lay_out(CAROM_RACK_THREECUSHION, CAROM_TABLE_THREECUSHION, 7);
  put(0, 0.5, 0.8);
  put(1, 0.7, 1.2);
  put(2, 0.8, 1.25);
  const carom_cue cue = carom_cue_of(CAROM_GAME_BILLIARD);
  const carom_player player = carom_player_of(0.5);
  const carom_plan_rules game_rules = carom_plan_rules_of(CAROM_RULES_STRAIGHTRAIL);
  const carom_plan_options options = {.shots = 1000};
  carom_plan_job job = job_of(count, &cue, &player, &game_rules, &options);
  carom_plan_stroke best;
  int found;
  ck_assert_int_eq(carom_plan(&job, &best, 1, &found), CAROM_OK);
  ck_assert_msg(best.keep > 0.9, "keeps %g", best.keep);
  free(job.memory);
}

/* ---- Equal innings */

/* The stroke of the opening that makes a point of straight rail: found once, by trial. */
static carom_cue point_of_opening(carom_match *match) {
  static carom_match tried;
  carom_cue cue = carom_cue_of(CAROM_GAME_BILLIARD);
  cue.ball = match->cue_ball;
  cue.speed = 3.0;
  for (cue.phi = 85.0; cue.phi < 115.0; cue.phi += 0.1) {
    tried = *match;
    ck_assert_int_eq(carom_match_stroke(&tried, (int)match->record.player, &cue, NULL, NULL),
                     CAROM_OK);
    if (tried.ruling.turn.points > 0.0)
      return cue;
  }
  ck_abort_msg("no point from the opening position");
}

/* Who began has the target: the other opens from his own opening position, and draws by a point or
 * loses by a miss. The recording is read again. */
TEST(equal_innings) {
  static carom_match match, reader;
  static carom_record scratch;
  for (int k = 0; k < 4; k++) {
    const int first = k % 2, level = k / 2;
    begin_equal(&match, CAROM_RULES_STRAIGHTRAIL, 1, first, 1);
    static char file[65536];
    size_t length = (size_t)match.size;
    memcpy(file, match.text, length);
    carom_cue cue = point_of_opening(&match);
    ck_assert_int_eq(carom_match_stroke(&match, first, &cue, NULL, NULL), CAROM_OK);
    memcpy(file + length, match.text, (size_t)match.size);
    length += (size_t)match.size;

    /* the equalizing inning */
    char words[200];
    carom_ruling_string(&match.ruling, words, sizeof words);
    ck_assert_str_eq(words, "the other has the equalizing inning");
    const carom_shot_ball *lies = match.record.balls;
    ck_assert(match.phase == CAROM_MATCH_STROKE && match.record.player == 1 - first);
    ck_assert(match.cue_ball == 1 - first && match.on == 1 << RED && match.winner == 0);
    ck_assert(lies_at(&lies[1 - first], 0.5 + 0.1825 / 1.42, 0.25));
    ck_assert(lies_at(&lies[first], 0.5, 0.25) && lies_at(&lies[RED], 0.5, 0.75));
    cue = point_of_opening(&match);
    if (!level)
      cue.phi = 0.0;
    ck_assert_int_eq(carom_match_stroke(&match, 1 - first, &cue, NULL, NULL), CAROM_OK);
    memcpy(file + length, match.text, (size_t)match.size);
    length += (size_t)match.size;
    ck_assert_int_eq(match.phase, CAROM_MATCH_OVER);
    ck_assert_int_eq(match.winner, level ? CAROM_DRAWN : 1 + first);
    ck_assert_int_eq(match.ruling.turn.outcome, level ? CAROM_TURN_DRAW : CAROM_TURN_LOSE);

    memset(&reader, 0, sizeof reader);
    for (char *line = file, *end; line < file + length; line = end + 1) {
      end = memchr(line, '\n', (size_t)(file + length - line));
      ck_assert_msg(carom_match_read(&reader, &scratch, line, (size_t)(end - line)) == CAROM_OK,
                    "%s", reader.fault);
    }
    ck_assert(reader.winner == match.winner && reader.record.hash == match.record.hash);
  }
}

/* Other games have no equal innings, and some no target. */
TEST(games_without_equal_innings) {
  static carom_match match;
  for (int kind = 0; carom_rules_about_of((carom_rules_kind)kind) != NULL; kind++) {
    carom_table_make((carom_table_kind)carom_rules_about_of((carom_rules_kind)kind)->table, &table);
    const carom_status status =
        carom_match_begin_to(&match, (carom_rules_kind)kind, 0, 1, &table, 1, 0);
    if (kind == CAROM_RULES_THREECUSHION || kind == CAROM_RULES_STRAIGHTRAIL) {
      ck_assert_int_eq(status, CAROM_OK);
      continue;
    }
    ck_assert_int_eq(status, CAROM_ERROR_ACT);
    ck_assert_str_eq(match.fault, "begin: innings must be 0, as the game has none");
  }
  carom_table_make(CAROM_TABLE_POOL_9FT, &table);
  ck_assert_int_eq(carom_match_begin_to(&match, CAROM_RULES_EIGHTBALL, 5, 0, &table, 1, 0),
                   CAROM_ERROR_ACT);
  ck_assert_str_eq(match.fault, "begin: target must be 0, as the game has none");
}

/* Plans know the last points: the one of who began, who then plays no more, and those of the
 * equalizing inning, whose misses lose the game. */
TEST(plans_of_equal_innings) {
  const carom_cue cue = carom_cue_of(CAROM_GAME_BILLIARD);
  const carom_player player = carom_player_of(4.0);
  const carom_plan_options options = {.shots = 1000};
  carom_plan_stroke best[4];
  for (int innings = 0; innings <= 3; innings++) {
    const int count = lay_out(CAROM_RACK_THREECUSHION, CAROM_TABLE_THREECUSHION, 7);
    put(0, 0.5, 0.8);
    put(1, 0.7, 1.2);
    put(2, 0.8, 1.25);
    carom_plan_rules game_rules = carom_plan_rules_of(CAROM_RULES_STRAIGHTRAIL);
    game_rules.state.score[0] = game_rules.state.target - 1;
    game_rules.state.innings = innings;
    carom_plan_job job = job_of(count, &cue, &player, &game_rules, &options);
    int found;
    ck_assert_int_eq(carom_plan(&job, &best[innings], 1, &found), CAROM_OK);
    free(job.memory);
    const carom_plan_stroke *c = &best[innings];
    ck_assert_msg(c->ball >= 0 && c->kind != CAROM_PLAN_SAFETY, "innings %d", innings);
    ck_assert(c->value == best[0].value && c->keep == best[0].keep);
  }
  ck_assert_msg(best[0].keep > 0.3 && best[0].keep < 1.0, "keeps %g", best[0].keep);
}
