/* The rows of situations.txt and matches.txt, which say what they mean: a state of a game and
 * what a stroke did, then the ruling and the state that must follow; and acts of a match, each
 * with how the match must stand. */
#include "match_support.h"
#include "row_file.h"

#include <stddef.h>

/* What a row says: before the bar the state and the stroke, behind it the ruling and the state; of
 * a match, how it stands. */
typedef struct situation {
  carom_rules_state state;
  carom_facts facts;
  uint32_t in_play, together, met, driven, down[6], spot, targets, put_back;
  int32_t call[2], choice, turn, leave, foul, points;
  int32_t player, phase, cue_ball, winner, rulings;
  /* of a layout */
  uint32_t lie, out;
  int32_t racked, front;
  const char *put, *place;
} situation;

/* Words of the library instead of numbers; those of choices are positions of their bits. */
enum words {
  NO_WORDS,
  TURNS = CAROM_WORDS_TURN + 1,
  LEAVES = CAROM_WORDS_LEAVE + 1,
  FOULS = CAROM_WORDS_FOUL + 1,
  CHOICES = CAROM_WORDS_CHOICE + 1,
  PHASES = CAROM_WORDS_PHASE + 1
};

static const char *word_of(enum words words, int k) {
  return carom_word((carom_words)(words - 1), words == CHOICES ? 1 << k : k);
}

typedef enum form { NUMBER, PAIR, SET, WORDS_FORM, SEATS, SETS } form;
typedef struct member {
  const char *name;
  size_t offset;
  form form;
  enum words words;
} member;

/* A member of a situation, of its state, and of its facts: its form, and its words if it has some.
 */
#define MEMBER(key, ...) \
  { .name = #key, .offset = offsetof(situation, key), .form = __VA_ARGS__ }
#define OF_STATE(key, ...) \
  { .name = #key, .offset = offsetof(situation, state.key), .form = __VA_ARGS__ }
#define OF_FACTS(key, ...) \
  { .name = #key, .offset = offsetof(situation, facts.key), .form = __VA_ARGS__ }
static const member members[] = {
    OF_STATE(opening, NUMBER),
    OF_STATE(group, NUMBER),
    OF_STATE(fouls, PAIR),
    OF_STATE(score, PAIR),
    OF_STATE(lost, PAIR),
    OF_STATE(pocket, PAIR),
    OF_STATE(may, SET, CHOICES),
    OF_STATE(on, NUMBER),
    OF_STATE(free_ball, NUMBER),
    OF_STATE(target, NUMBER),
    OF_STATE(innings, NUMBER),
    OF_STATE(seat, NUMBER),
    OF_STATE(user, SEATS),
    {.name = "sets", .offset = offsetof(situation, state.user), .form = SETS},
    OF_FACTS(first, PAIR),
    OF_FACTS(cushions_before, PAIR),
    OF_FACTS(cushions_after, NUMBER),
    OF_FACTS(touches, NUMBER),
    OF_FACTS(down, SET),
    OF_FACTS(off, SET),
    OF_FACTS(pushed, SET),
    OF_FACTS(frozen, SET),
    OF_FACTS(barred, SET),
    OF_FACTS(jumped, SET),
    OF_FACTS(past_middle, SET),
    OF_FACTS(beyond_middle, SET),
    OF_FACTS(at_head, SET),
    OF_FACTS(banked, SET),
    OF_FACTS(approach, NUMBER),
    MEMBER(in_play, SET),
    MEMBER(together, SET),
    MEMBER(met, SET),
    MEMBER(driven, SET),
    MEMBER(down[0], SET),
    MEMBER(down[1], SET),
    MEMBER(down[2], SET),
    MEMBER(down[3], SET),
    MEMBER(down[4], SET),
    MEMBER(down[5], SET),
    MEMBER(call, PAIR),
    MEMBER(choice, NUMBER, CHOICES),
    MEMBER(turn, NUMBER, TURNS),
    MEMBER(leave, NUMBER, LEAVES),
    MEMBER(foul, NUMBER, FOULS),
    MEMBER(points, NUMBER),
    MEMBER(spot, SET),
    MEMBER(lie, SET),
    MEMBER(put, WORDS_FORM),
    MEMBER(place, WORDS_FORM),
    MEMBER(out, SET),
    MEMBER(targets, SET),
    MEMBER(put_back, SET),
    MEMBER(racked, NUMBER),
    MEMBER(front, NUMBER),
    MEMBER(player, NUMBER),
    MEMBER(phase, NUMBER, PHASES),
    MEMBER(cue_ball, NUMBER),
    MEMBER(winner, NUMBER),
    MEMBER(rulings, NUMBER),
};
enum { MEMBERS = sizeof members / sizeof members[0] };

/* A number, or the place of a word; *text goes behind it. */
static int number_at(const char **text, enum words words) {
  const size_t length = strcspn(*text, ",- ");
  const char *begin = *text;
  char *end;
  const int number = (int)strtol(begin, &end, 10);
  *text = end > begin ? end : begin + length;
  for (int k = 0; words != NO_WORDS && word_of(words, k) != NULL; k++)
    if (strlen(word_of(words, k)) == length && strncmp(word_of(words, k), begin, length) == 0)
      return k;
  ck_assert_msg(end > begin, "no word of situations: %s", begin);
  return number;
}

/* Words of the seats, between them ";": a number each, or a set of balls. */
static void read_seats(const member *m, const char *text, uint64_t word[CAROM_SEATS_MOST]) {
  memset(word, 0, CAROM_SEATS_MOST * sizeof *word);
  for (int seat = 0; *text != '\0'; text += *text != '\0') {
    const int low = number_at(&text, NO_WORDS);
    int high = low;
    if (*text == '-') {
      text++;
      high = number_at(&text, NO_WORDS);
    }
    for (int bit = low; m->form == SETS && bit <= high && low > 0; bit++)
      word[seat] |= UINT64_C(1) << bit;
    if (m->form == SEATS)
      word[seat] = (uint64_t)low;
    seat += *text == ';';
  }
}

/* The numbers of a list, in which a-b represents a to b: into `value`, or as bits of *value. */
static void read_value(const member *m, const char *text, int32_t *value) {
  if (m->form == SET)
    *value = 0;
  for (int k = 0; *text != '\0'; k++) {
    const int low = number_at(&text, m->words);
    int high = low;
    if (*text == '-') {
      text++;
      high = number_at(&text, m->words);
    }
    if (m->form != SET)
      value[k] = low;
    for (int bit = low; m->form == SET && bit <= high; bit++)
      *value |= INT32_C(1) << bit;
    text += *text == ',';
  }
}

static void read_situation(char *text, situation *into) {
  for (char *word = strtok(text, " \n"); word != NULL; word = strtok(NULL, " \n")) {
    char *value = strchr(word, '=');
    int k = 0;
    if (value != NULL)
      *value++ = '\0';
    while (k < MEMBERS && strcmp(members[k].name, word) != 0)
      k++;
    if (k < MEMBERS && value != NULL && members[k].form == WORDS_FORM)
      memcpy((char *)into + members[k].offset, &value, sizeof value);
    else if (k < MEMBERS && value != NULL && members[k].form >= SEATS)
      read_seats(&members[k], value, (uint64_t *)((char *)into + members[k].offset));
    else if (k < MEMBERS && value != NULL)
      read_value(&members[k], value, (int32_t *)((char *)into + members[k].offset));
    else
      ck_assert_msg(strcmp(word, "-") == 0, "no member of situations: %s", word);
  }
}

static carom_facts facts_in(const situation *s) {
  carom_facts f = s->facts;
  f.second_time = f.touches > 1 ? 0.01 : INFINITY;
  f.first_set = f.first[0] >= 0 ? UINT32_C(1) << f.first[0] | s->together : 0;
  for (int k = 0; k < CAROM_BALLS_MOST; k++) {
    f.order[k] = f.pocket[k] = -1;
    f.cushions[k] = s->driven >> k & 1;
    for (int pocket = 0; pocket < 6; pocket++)
      if (s->down[pocket] >> k & 1) {
        f.down |= UINT32_C(1) << k;
        f.pocket[k] = pocket;
      }
  }

  /* the balls that were met, the first two in their order */
  int count = 0;
  for (int i = 0; i < 2; i++)
    if (f.first[i] >= 0)
      f.order[count++] = f.first[i];
  for (int k = 0; k < CAROM_BALLS_MOST; k++)
    if (((s->met | f.first_set) >> k & 1) && k != f.first[0] && k != f.first[1])
      f.order[count++] = k;
  return f;
}

/* Whether a turn and the state are as they must be. */
static void check_turn(const char *title, const carom_plan_rules *game_rules,
                       const carom_turn *turn, const situation *expected) {
  ck_assert_msg((int)turn->outcome == expected->turn && (int)turn->leave == expected->leave &&
                    turn->foul == expected->foul && turn->spot == expected->spot &&
                    turn->points == (double)expected->points,
                "%s: turn %s, leave %s, foul %s, spot %x, points %g", title,
                word_of(TURNS, (int)turn->outcome), word_of(LEAVES, (int)turn->leave),
                word_of(FOULS, turn->foul), turn->spot, turn->points);
  for (int k = 0; k < MEMBERS && members[k].offset < sizeof game_rules->state; k++) {
    const int32_t *is = (const int32_t *)((const char *)&game_rules->state + members[k].offset);
    const int32_t *must = (const int32_t *)((const char *)&expected->state + members[k].offset);
    size_t size = members[k].form == PAIR ? 2 * sizeof *is : sizeof *is;
    if (members[k].form >= SEATS)
      size = sizeof expected->state.user;
    ck_assert_msg(memcmp(is, must, size) == 0,
                  "%s: %s is %d, not %d (or the second number differs)", title, members[k].name,
                  *is, *must);
  }
}

static void check_row(const char *title, carom_plan_rules *game_rules, const situation *row,
                      const situation *expected) {
  const carom_facts facts = facts_in(row);
  static const int calls[] = {
      CAROM_CALL_PASS,       CAROM_CALL_PUSH, NONE,           NONE, CAROM_CALL_RACK,
      CAROM_CALL_OTHER_RACK, CAROM_CALL_STAY, CAROM_CALL_SPOT};
  const carom_call call = {row->choice < 0 ? row->call[0] : calls[row->choice], row->call[1]};
  const carom_turn turn = game_rules->judge(&game_rules->state, row->in_play, 0, &facts, call);
  check_turn(title, game_rules, &turn, expected);
}

/* A ball and its position, with how far y may be from it. Returns the text of the next ball, or
 * NULL. */
static const char *read_place(carom_rack_kind rack, const char *text, int *ball, double place[3]) {
  int spot, size = 0;
  double origin[2] = {0.0, 0.0};
  place[2] = 1e-9;
  if (sscanf(text, "%d@%lf,%lf%n", ball, &place[0], &place[1], &size) < 3) {
    const int read = sscanf(text, "%d#%d,%lf,%lf%n", ball, &spot, &place[0], &place[1], &size);
    ck_assert_msg(read == 4, "no place: %s", text);
    expect_ok(carom_spot_of(rack, &table, spot, origin));
  }
  place[0] += origin[0];
  place[1] += origin[1];
  text += size;
  if (*text == '~')
    place[2] = strtod(text + 1, (char **)&text);
  return *text == ';' ? text + 1 : NULL;
}

/* The balls that stand as a rack, close together at the foot, and those of them in front. */
static void count_racked(int count, int *racked, int *front) {
  const double foot = 0.75 * table.length;
  for (int k = 1; k < count; k++) {
    const double *r = balls[k].state.r, across = r[0] - 0.5 * table.width;
    const bool is_on_table = balls[k].state.label == CAROM_BALL_STATIONARY;
    *front += is_on_table && fabs(r[1] - foot) < 1e-9;
    *racked += is_on_table && r[1] > foot - 1e-9 && r[1] < foot + 0.22 && fabs(across) < 0.13;
  }
}

/* Lays out a row: the balls that are not down, some at positions of their own. Returns how many the
 * game has. */
static int lay_out_row(const carom_rules_about *about, const situation *row) {
  const carom_rack_kind rack = (carom_rack_kind)about->rack;
  const int count = lay_out(rack, (carom_table_kind)about->table, row->lie);
  int ball;
  double place[3];
  for (const char *text = row->put; text != NULL;) {
    text = read_place(rack, text, &ball, place);
    put(ball, place[0], place[1]);
  }
  return count;
}

/* Where balls lie, which are out of play, and how many stand as a rack. */
static void check_layout(const char *title, const carom_rules_about *about, int count,
                         const situation *expected) {
  int ball, racked = 0, front = 0;
  double place[3];
  for (const char *text = expected->place; text != NULL;) {
    text = read_place((carom_rack_kind)about->rack, text, &ball, place);
    const carom_ball_state *lies = &balls[ball].state;
    ck_assert_msg(lies->label == CAROM_BALL_STATIONARY && fabs(lies->r[0] - place[0]) < 1e-9 &&
                      fabs(lies->r[1] - place[1]) <= place[2],
                  "%s: ball %d lies at %.9g, %.9g", title, ball, lies->r[0], lies->r[1]);
  }
  for (int k = 0; k < count; k++)
    if (expected->out >> k & 1)
      ck_assert_msg(balls[k].state.label == CAROM_BALL_POCKETED, "%s: ball %d lies", title, k);
  if (expected->racked == 0)
    return;
  count_racked(count, &racked, &front);
  ck_assert_msg(racked == expected->racked && front == expected->front,
                "%s: %d racked, %d in front", title, racked, front);
  if (balls[0].state.label == CAROM_BALL_STATIONARY)
    expect_ok(carom_shot_check(&table, balls, count, NULL, NULL, NULL));
}

/* Settles a turn on a layout: the turn and the state, and how balls lie then. */
static void check_settling(const char *title, const carom_rules_about *about,
                           carom_plan_rules *game_rules, const situation *row,
                           const situation *expected) {
  const int count = lay_out_row(about, row);
  carom_turn turn = {(carom_turn_outcome)row->turn, (carom_leave)row->leave, row->foul, row->spot,
                     0.0};
  expect_ok(carom_turn_settle(game_rules, &game_rules->state, &table, balls, count, &turn));
  check_turn(title, game_rules, &turn, expected);
  check_layout(title, about, count, expected);
}

/* How the section that a title names was read: 0 where it names none, 1 for its text, and so on, as
 * the head of situations.txt says. */
static int source_of(const char *title, const char *column) {
  static const char *const names[] = {"WPA",        "WPBSA",     "BCA",     "UMB",
                                      "one-pocket", "blackball", "heyball", "pyramid",
                                      "four-ball",  "killer",    NULL};
  static const char *const sources[] = {"", "text", "title", "club", "none", NULL};
  bool names_text = false;
  for (int k = 0; names[k] != NULL; k++)
    names_text |= strncmp(title, names[k], strlen(names[k])) == 0;
  int source = 0;
  while (column != NULL && sources[source] != NULL && strcmp(sources[source], column) != 0)
    source++;
  ck_assert_msg(names_text == (source > 0) && sources[source] != NULL,
                "a title that names a text has text, title, club or none in its fifth column: %s",
                title);
  return source;
}

/* The game of this name. */
static carom_rules_kind rules_of(const char *name) {
  for (int kind = 0; carom_rules_about_of((carom_rules_kind)kind) != NULL; kind++)
    if (strcmp(carom_rules_about_of((carom_rules_kind)kind)->name, name) == 0)
      return (carom_rules_kind)kind;
  ck_abort_msg("no game: %s", name);
}

/* Splits a text at its bars; returns the number of its columns. */
static int split(char *text, char *column[], int most) {
  int columns = 0;
  for (; text != NULL && columns < most; columns++) {
    column[columns] = text;
    text = strstr(text, " | ");
    if (text != NULL) {
      *text = '\0';
      text += 3;
    }
  }
  return columns;
}

TEST(situations) {
  char *column[5];
  int of_source[5] = {0};
  open_rows(CAROM_TEST_SITUATIONS);
  while (next_line()) {
    column[4] = NULL;
    if (split(row_file.line, column, 5) < 4)
      reject("a row of situations.txt has four columns");
    of_source[source_of(column[1], column[4])]++;

    /* both sides begin with the state at the beginning of the game */
    const carom_rules_about *about = carom_rules_about_of(rules_of(column[0]));
    carom_plan_rules game_rules = carom_plan_rules_of(rules_of(column[0]));
    situation row = {.state = game_rules.state,
                     .in_play = (UINT32_C(1) << carom_rack_size((carom_rack_kind)about->rack)) - 1,
                     .facts.first = {-1, -1},
                     .call = {-1, -1},
                     .choice = -1};
    situation expected = {.state = game_rules.state, .turn = -1};
    read_situation(column[2], &row);
    read_situation(column[3], &expected);
    game_rules.state = row.state;
    if (expected.targets != 0)
      ck_assert_msg(game_rules.on(&game_rules.state, row.in_play) == expected.targets, "%s",
                    column[1]);
    else if (row.lie != 0)
      check_settling(column[1], about, &game_rules, &row, &expected);
    else
      check_row(column[1], &game_rules, &row, &expected);
  }
  printf("%d rows: %d by a text, %d by its titles, %d by clubs, %d from memory\n",
         row_file.rows_begun, of_source[1], of_source[2], of_source[3], of_source[4]);
  ck_assert_int_ge(row_file.rows_begun, 430);
  ck_assert_int_ge(of_source[1], 60);
}

/* ---- Matches */

/* A number of an act, such as " phi=90"; if it has none, another. */
static double number_of(const char *act, const char *name, double otherwise) {
  const char *place = strstr(act, name);
  return place == NULL ? otherwise : strtod(place + strlen(name), NULL);
}

static carom_status stroke(const char *act, int player) {
  const carom_rules_about *about = carom_rules_about_of((carom_rules_kind)match.record.rules);
  carom_cue cue = carom_cue_of((carom_game)about->balls);
  carom_shot_options stop = {.time_most = number_of(act, " stop=", 0.0)};
  const double first_of = number_of(act, " first_of=", -1.0);
  if (first_of >= 0.0)
    stop.first_of = UINT64_C(1) << (int)first_of;
  cue.ball = (int64_t)number_of(act, " ball=", match.cue_ball);
  cue.phi = number_of(act, " phi=", cue.phi);
  cue.speed = number_of(act, " speed=", cue.speed);
  cue.theta = number_of(act, " theta=", cue.theta);
  cue.b = number_of(act, " b=", cue.b);
  return carom_match_stroke(&match, player, &cue, &stop, NULL);
}

/* Does an act, which begins with the player and a verb. */
static carom_status do_act(const char *act) {
  char *verb;
  const int player = (int)strtol(act, &verb, 10);
  const carom_call call = {(int)number_of(act, " ball=", -1.0),
                           (int)number_of(act, " pocket=", -1.0)};
  const char *choice = act + strlen("0 choose ");
  if (strncmp(verb, " place", 6) == 0)
    return carom_match_place(&match, player, number_of(act, " x=", 0.0),
                             number_of(act, " y=", 0.0));
  if (strncmp(verb, " stroke", 7) == 0)
    return stroke(act, player);
  if (strncmp(verb, " choose", 7) == 0)
    return carom_match_choose(&match, player, (carom_choice)(1 << number_at(&choice, CHOICES)));
  if (strncmp(verb, " call", 5) == 0)
    return carom_match_call(&match, player, call);
  if (strncmp(verb, " continue", 9) == 0)
    return carom_match_continue(&match, NULL, NULL);
  ck_assert_msg(strncmp(verb, " concede", 8) == 0, "no act: %s", act);
  return carom_match_concede(&match, player);
}

/* The state of the match. */
static situation standing(void) {
  const carom_turn *turn = &match.ruling.turn;
  situation s = {.state = match.rules.state,
                 .facts = match.ruling.facts,
                 .turn = (int32_t)turn->outcome,
                 .foul = turn->foul,
                 .points = (int32_t)turn->points,
                 .put_back = match.ruling.put,
                 .leave = match.leave,
                 .targets = match.on,
                 .player = (int32_t)match.record.player,
                 .phase = match.phase,
                 .cue_ball = match.cue_ball,
                 .winner = match.winner,
                 .rulings = (int32_t)match.rulings};
  s.state.may = match.may;
  return s;
}

/* Checks the members that a text names. */
static void check_standing(const char *title, char *text) {
  const situation s = standing();
  situation expected = s;
  read_situation(text, &expected);
  for (int k = 0; k < MEMBERS; k++) {
    const int32_t *number = (const int32_t *)((const char *)&s + members[k].offset);
    const size_t size = (members[k].form == PAIR ? 2 : 1) * sizeof *number;
    ck_assert_msg(members[k].offset >= offsetof(situation, lie) ||
                      memcmp(number, (const char *)&expected + members[k].offset, size) == 0,
                  "%s: %s is %x", title, members[k].name, (unsigned)*number);
  }
  memcpy(balls, match.record.balls, sizeof balls);
  check_layout(title, carom_rules_about_of((carom_rules_kind)match.record.rules),
               (int)match.record.count, &expected);
}

/* Begins a match by a row: with a layout, with equal innings, or with the rack. */
static void begin_row(carom_rules_kind kind, char *text) {
  const carom_rules_about *about = carom_rules_about_of(kind);
  carom_plan_rules game_rules = carom_plan_rules_of(kind);
  situation row = {.state = game_rules.state};
  read_situation(text, &row);
  game_rules.state = row.state;
  if (row.lie == 0) {
    begin(kind, 1, row.player, row.state.innings > 0 ? row.state.target : 0);
    return;
  }
  const int count = lay_out_row(about, &row);
  expect_ok(carom_match_begin_at(&match, kind, &game_rules, &table, balls, count, NULL,
                                 (carom_leave)row.leave, row.player));
  file_size = 0;
  keep();
}

/* Does the act of a column, and checks what it says behind the colon: why the act is rejected, with
 * its words; or the state of the match, and the names of the ruling. */
static void check_act(const char *title, char *column) {
  char *expected = strstr(column, ": "), *words = strchr(column, '"'), ruled[200];
  ck_assert_msg(expected != NULL, "%s: no colon in %s", title, column);
  if (words != NULL) {
    *words++ = '\0';
    words[strcspn(words, "\"")] = '\0';
  }
  *expected = '\0';
  expected += 2;
  before = match;
  const carom_status status = expected > column + 2 ? do_act(column) : CAROM_OK;
  if (strncmp(expected, "refused ", 8) == 0) {
    expected[8 + strcspn(expected + 8, " ")] = '\0';
    check_refusal(title, status, expected + 8, words);
    return;
  }
  ck_assert_msg(status >= CAROM_OK, "%s: %s: %s", title, column, match.fault);
  if (expected > column + 2)
    keep();
  carom_ruling_string(&match.ruling, ruled, sizeof ruled);
  ck_assert_msg(words == NULL || strcmp(words, ruled) == 0, "%s: %s", title, ruled);
  check_standing(title, expected);
}

TEST(matches) {
  enum { ACTS = 24 };
  char *column[ACTS];
  open_rows(CAROM_TEST_DATA "/../games/tests/matches.txt");
  while (next_line()) {
    const int columns = split(row_file.line, column, ACTS);
    ck_assert_int_ge(columns, 4);
    begin_row(rules_of(column[0]), column[2]);
    for (int k = 3; k < columns; k++)
      check_act(column[1], column[k]);
    check_recording(column[1]);
  }
}

/* WPA 1.4: a spotted ball is frozen to the one before it, not to the cue ball; in snooker it
 * touches none. */
TEST(spotted_balls_touch) {
  static const struct {
    carom_rack_kind rack;
    int ball, is_present;
    bool frozen;
  } cases[] = {{CAROM_RACK_EIGHTBALL, 3, 5, true},
               {CAROM_RACK_EIGHTBALL, 3, 0, false},
               {CAROM_RACK_SNOOKER, 1, 5, false}};
  for (int k = 0; k < 3; k++)
    for (int n = -20; n <= 20; n++) {
      const bool snooker = cases[k].rack == CAROM_RACK_SNOOKER;
      const int count =
          lay_out(cases[k].rack, snooker ? CAROM_TABLE_SNOOKER : CAROM_TABLE_POOL_9FT, 0);
      double place[2];
      carom_spot_of(cases[k].rack, &table, cases[k].ball, place);
      put(cases[k].is_present, place[0] + 0.001 * n, place[1] + 0.0004 * n);
      expect_ok(carom_spot_ball_of(cases[k].rack, &table, balls, count, cases[k].ball));
      const double *a = balls[cases[k].ball].state.r, *b = balls[cases[k].is_present].state.r;
      const double gap = distance(a, b) - balls[0].kind.radius * 2.0;
      ck_assert_msg(cases[k].frozen ? gap >= 0.0 && gap < 1e-12
                                    : gap > CAROM_RULES_TOUCH && gap < 4.0 * CAROM_RULES_TOUCH,
                    "%d, %d: %g m", k, n, gap);
    }
}

/* What a shot tells: the balls met in order, those of the first instant, where the cue ball was and
 * how far it came; and a ball that lies 0.05 mm from it touches it. */
TEST(facts_of_a_split_hit) {
  const int count = lay_out(CAROM_RACK_EIGHTBALL, CAROM_TABLE_POOL_9FT, 0);
  const double R = balls[0].kind.radius, x = 0.5 * table.width;
  put(0, x, 0.8);
  put(9, x - 1.2 * R, 1.2);
  put(1, x + 1.2 * R, 1.2);
  put(4, x, 0.8 - 2.0 * R - 0.5 * CAROM_RULES_TOUCH);
  carom_cue cue = carom_cue_of(CAROM_GAME_POOL);
  cue.phi = 90.0;
  cue.speed = 2.0;
  carom_facts facts;
  carom_shot shot = {.facts = &facts};
  expect_ok(carom_shoot(&table, balls, count, &cue, NULL, &shot));
  ck_assert_uint_eq(facts.first_set, 1U << 1 | 1U << 9);
  ck_assert_uint_eq(facts.frozen, 1U << 4);
  ck_assert((facts.order[0] == 1 && facts.order[1] == 9) ||
            (facts.order[0] == 9 && facts.order[1] == 1));
  const double y = 1.2 - sqrt(4.0 * R * R - 1.44 * R * R);
  ck_assert_double_eq_tol(facts.first_place[1], y, 1e-6);
  ck_assert_double_eq_tol(facts.first_low[1], 0.8, 1e-9);
  ck_assert_double_eq_tol(facts.first_high[1], y, 1e-6);
}

/* Whether any of many directions from the cue ball meets ball k before the others in play. */
static bool is_met_somewhere(int count, int k) {
  enum { STEPS = 5000 };
  const double reach = 2.0 * balls[0].kind.radius, *c = balls[0].state.r;
  const double x = balls[k].state.r[0] - c[0], y = balls[k].state.r[1] - c[1];
  const double half = asin(fmin(reach / hypot(x, y), 1.0));
  for (int n = 1; n < STEPS; n++) {
    const double phi = atan2(y, x) + half * (2.0 * n / STEPS - 1.0);
    int nearest = 0;
    double least = INFINITY;
    for (int i = 1; i < count; i++) {
      const double offset[2] = {balls[i].state.r[0] - c[0], balls[i].state.r[1] - c[1]};
      const double along = offset[0] * cos(phi) + offset[1] * sin(phi);
      const double across = offset[0] * sin(phi) - offset[1] * cos(phi);
      const double square = reach * reach - across * across;
      if (balls[i].state.label != CAROM_BALL_STATIONARY || along <= 0.0 || square < 0.0)
        continue;
      const double length = along - sqrt(square);
      if (length < least) {
        least = length;
        nearest = i;
      }
    }
    if (nearest == k)
      return true;
  }
  return false;
}

/* Puts a ball beyond the cue ball: so far along y, m, and up to as much and `wide` across. */
static void put_somewhere(random_source *r, int count, int ball, double far, double wide) {
  carom_status status = CAROM_ERROR_OVERLAP;
  while (status != CAROM_OK) {
    const double x = balls[0].state.r[0] + random_between(r, -wide, wide);
    const double y = balls[0].state.r[1] + far + random_between(r, 0.0, wide);
    status = carom_place_ball(&table, balls, count, ball, x, y, NULL);
  }
}

/* Blackball, 5g: a player is snookered where no part of a ball that is on can be hit in a straight
 * line. Two balls are on, and three others lie near the cue ball. */
TEST(snookered_in_blackball) {
  enum { DRAWS = 300 };
  random_source r = {test_seed()};
  int snookered = 0;
  for (int n = 0; n < DRAWS; n++) {
    const int count = lay_out(CAROM_RACK_BLACKBALL, CAROM_TABLE_BLACKBALL, 0);
    put(0, 0.4 * table.width, 0.4 * table.length);
    put(8, 0.1, 0.1);
    put_somewhere(&r, count, 1, 0.5, 0.3);
    put_somewhere(&r, count, 2, 0.5, 0.3);
    for (int k = 9; k <= 11; k++)
      put_somewhere(&r, count, k, 0.06, 0.15);

    /* the other, who has the stripes, plays safe */
    carom_plan_rules game_rules = carom_plan_rules_of(CAROM_RULES_BLACKBALL);
    game_rules.state.group = 2;
    carom_ball_state final[CAROM_BALLS_MOST];
    for (int k = 0; k < count; k++)
      final[k] = balls[k].state;
    carom_facts facts = facts_of(9, 1, 0, 0);
    const carom_shot shot = {.facts = &facts, .final = final};
    carom_ruling ruling;
    expect_ok(
        carom_referee(&game_rules, &table, balls, count, 0, &shot, (carom_call){-1, -1}, &ruling));
    const bool seen = is_met_somewhere(count, 1) || is_met_somewhere(count, 2);
    ck_assert_msg(ruling.turn.outcome == CAROM_TURN_PASS && ruling.state.on == !seen,
                  "draw %d: on %d, seen %d", n, ruling.state.on, seen);
    snookered += !seen;
  }
  ck_assert_msg(snookered > DRAWS / 10 && snookered < DRAWS * 9 / 10, "%d", snookered);
}
