/* The rows of situations.txt, which says what they mean: a state of a game and what a stroke did,
 * beside the ruling and the state that must follow. */
#include "game_support.h"

#include <stddef.h>

/* What a row says: before the bar the state and the stroke, behind it the ruling and the state. */
typedef struct situation {
  carom_rules_state state;
  int32_t first[2], cushions_before[2], cushions_after, touches;
  uint32_t in_play, together, order_set, driven, down[6], off, pushed, frozen, barred, jumped, past,
      beyond;
  uint32_t head;
  uint32_t banked;
  int32_t call[2], choice;
  int32_t turn, leave, foul, points;
  uint32_t spot, lie, out, targets;
  int32_t racked, front;
  const char *put, *place;
} situation;

/* Words in place of numbers: a choice is the negative of its carom_call, a right a bit of
 * carom_choice. */
static const char *const choices[] = {"",           "",     "push", "pass", "rack",
                                      "other_rack", "stay", "spot", NULL};
static const char *const rights[] = {"pass",       "push", "free_ball", "place", "rack",
                                     "other_rack", "stay", "spot",      NULL};
static const char *const turns[] = {"keep", "pass", "win", "lose", "draw", NULL};
static const char *const leaves[] = {"after", "before", "hand", "kitchen", "d", "baulk", NULL};
static const char *const fouls[] = {"none",  "cue_ball", "no_ball", "first",      "off",  "cushion",
                                    "break", "other",    "pot",     "double_hit", "jump", NULL};

typedef enum form { NUMBER, PAIR, SET, WORDS_FORM } form;
typedef struct member {
  const char *name;
  size_t offset;
  form form;
  const char *const *words;
} member;

#define AT(of) offsetof(situation, of)
static const member members[] = {
    {"opening", AT(state.opening), NUMBER, NULL},
    {"group", AT(state.group), NUMBER, NULL},
    {"fouls", AT(state.fouls), PAIR, NULL},
    {"score", AT(state.score), PAIR, NULL},
    {"lost", AT(state.lost), PAIR, NULL},
    {"pockets", AT(state.pocket), PAIR, NULL},
    {"may", AT(state.may), SET, rights},
    {"on", AT(state.on), NUMBER, NULL},
    {"free", AT(state.free_ball), NUMBER, NULL},
    {"target", AT(state.target), NUMBER, NULL},
    {"innings", AT(state.innings), NUMBER, NULL},
    {"in_play", AT(in_play), SET, NULL},
    {"first", AT(first), PAIR, NULL},
    {"together", AT(together), SET, NULL},
    {"met", AT(order_set), SET, NULL},
    {"before", AT(cushions_before), PAIR, NULL},
    {"after", AT(cushions_after), NUMBER, NULL},
    {"driven", AT(driven), SET, NULL},
    {"down", AT(down[2]), SET, NULL},
    {"down0", AT(down[0]), SET, NULL},
    {"down1", AT(down[1]), SET, NULL},
    {"down3", AT(down[3]), SET, NULL},
    {"down4", AT(down[4]), SET, NULL},
    {"down5", AT(down[5]), SET, NULL},
    {"off", AT(off), SET, NULL},
    {"pushed", AT(pushed), SET, NULL},
    {"frozen", AT(frozen), SET, NULL},
    {"barred", AT(barred), SET, NULL},
    {"jumped", AT(jumped), SET, NULL},
    {"past", AT(past), SET, NULL},
    {"beyond", AT(beyond), SET, NULL},
    {"head", AT(head), SET, NULL},
    {"banked", AT(banked), SET, NULL},
    {"touches", AT(touches), NUMBER, NULL},
    {"call", AT(call), PAIR, NULL},
    {"choice", AT(choice), NUMBER, choices},
    {"turn", AT(turn), NUMBER, turns},
    {"leave", AT(leave), NUMBER, leaves},
    {"foul", AT(foul), NUMBER, fouls},
    {"points", AT(points), NUMBER, NULL},
    {"spot", AT(spot), SET, NULL},
    {"lie", AT(lie), SET, NULL},
    {"put", AT(put), WORDS_FORM, NULL},
    {"at", AT(place), WORDS_FORM, NULL},
    {"out", AT(out), SET, NULL},
    {"targets", AT(targets), SET, NULL},
    {"racked", AT(racked), NUMBER, NULL},
    {"front", AT(front), NUMBER, NULL},
};
enum { MEMBERS = sizeof members / sizeof members[0] };

/* A number, or the place of a word; *text goes behind it. */
static int number_at(const char **text, const char *const *words) {
  const size_t length = strcspn(*text, ",-");
  const char *begin = *text;
  char *end;
  const int number = (int)strtol(begin, &end, 10);
  *text = end > begin ? end : begin + length;
  for (int k = 0; words != NULL && words[k] != NULL; k++)
    if (strlen(words[k]) == length && strncmp(words[k], begin, length) == 0)
      return k;
  ck_assert_msg(end > begin, "no word of situations: %s", begin);
  return number;
}

/* The numbers of a list, in which a-b stands for a to b: into `value`, or as bits of *value. */
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
    else if (k < MEMBERS && value != NULL)
      read_value(&members[k], value, (int32_t *)((char *)into + members[k].offset));
    else
      ck_assert_msg(strcmp(word, "-") == 0, "no member of situations: %s", word);
  }
}

static carom_facts facts_in(const situation *s) {
  carom_facts f = {.first = {s->first[0], s->first[1]},
                   .cushions_before = {s->cushions_before[0], s->cushions_before[1]},
                   .cushions_after = s->cushions_after,
                   .off = s->off,
                   .pushed = s->pushed,
                   .frozen = s->frozen,
                   .barred = s->barred,
                   .jumped = s->jumped,
                   .touches = s->touches,
                   .banked = s->banked,
                   .past_middle = s->past,
                   .beyond_middle = s->beyond,
                   .at_head = s->head,
                   .second_time = s->touches > 1 ? 0.01 : INFINITY};
  f.first_set = s->first[0] >= 0 ? UINT32_C(1) << s->first[0] | s->together : 0;
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
    if (s->first[i] >= 0)
      f.order[count++] = s->first[i];
  for (int k = 0; k < CAROM_BALLS_MOST; k++)
    if (((s->order_set | f.first_set) >> k & 1) && k != s->first[0] && k != s->first[1])
      f.order[count++] = k;
  return f;
}

/* Whether a turn and the state are as they must be. */
static void check_turn(const char *title, const carom_plan_rules *game_rules,
                       const carom_turn *turn, const situation *expected) {
  ck_assert_msg((int)turn->outcome == expected->turn && (int)turn->leave == expected->leave &&
                    turn->foul == expected->foul && turn->spot == expected->spot &&
                    turn->points == (double)expected->points,
                "%s: turn %s, leave %s, foul %s, spot %x, points %g", title, turns[turn->outcome],
                leaves[turn->leave], fouls[turn->foul], turn->spot, turn->points);
  for (int k = 0; k < MEMBERS && members[k].offset < sizeof game_rules->state; k++) {
    const int32_t *is = (const int32_t *)((const char *)&game_rules->state + members[k].offset);
    const int32_t *must = (const int32_t *)((const char *)&expected->state + members[k].offset);
    const size_t size = members[k].form == PAIR ? 2 * sizeof *is : sizeof *is;
    ck_assert_msg(memcmp(is, must, size) == 0,
                  "%s: %s is %d, not %d (or the second number differs)", title, members[k].name,
                  *is, *must);
  }
}

static void check_row(const char *title, carom_plan_rules *game_rules, const situation *row,
                      const situation *expected) {
  const carom_facts facts = facts_in(row);
  const carom_call call =
      row->choice > 0 ? (carom_call){-row->choice, -1} : (carom_call){row->call[0], row->call[1]};
  const carom_turn turn = game_rules->judge(&game_rules->state, row->in_play, 0, &facts, call);
  check_turn(title, game_rules, &turn, expected);
}

/* A ball and its place, with how far y may be from it. Returns the text of the next ball, or
 * NULL. */
static const char *read_place(carom_rack_kind rack, const char *text, int *ball, double place[3]) {
  int spot, size = 0;
  double origin[2] = {0.0, 0.0};
  place[2] = 1e-9;
  if (sscanf(text, "%d@%lf,%lf%n", ball, &place[0], &place[1], &size) < 3) {
    const int read = sscanf(text, "%d#%d,%lf,%lf%n", ball, &spot, &place[0], &place[1], &size);
    ck_assert_msg(read == 4, "no place: %s", text);
    ck_assert_int_eq(carom_spot_of(rack, &table, spot, origin), CAROM_OK);
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

/* Settles a turn on a layout: where balls lie then, which are out of play, the turn and the
 * state. */
static void check_layout(const char *title, carom_rules_kind kind, carom_plan_rules *game_rules,
                         const situation *row, const situation *expected) {
  const carom_rules_about *about = carom_rules_about_of(kind);
  const carom_rack_kind rack = (carom_rack_kind)about->rack;
  const int count = lay_out(rack, (carom_table_kind)about->table, row->lie);
  carom_turn turn = {(carom_turn_outcome)row->turn, (carom_leave)row->leave, row->foul, row->spot,
                     0.0};
  int ball, racked = 0, front = 0;
  double place[3];
  for (const char *text = row->put; text != NULL;) {
    text = read_place(rack, text, &ball, place);
    put(ball, place[0], place[1]);
  }
  ck_assert_int_eq(carom_turn_settle(game_rules, &game_rules->state, &table, balls, count, &turn),
                   CAROM_OK);
  check_turn(title, game_rules, &turn, expected);

  for (const char *text = expected->place; text != NULL;) {
    text = read_place(rack, text, &ball, place);
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
    ck_assert_int_eq(carom_shot_check(&table, balls, count, NULL, NULL, NULL), CAROM_OK);
}

/* How the section that a title names was read: 0 where it names none, 1 for its text, and so on, as
 * the head of situations.txt says. Removes that column from the ruling. */
static int take_source(const char *title, char *ruling) {
  static const char *const names[] = {"WPA",       "WPBSA",   "BCA",     "UMB",       "one-pocket",
                                      "blackball", "heyball", "pyramid", "four-ball", NULL};
  static const char *const sources[] = {"", "text", "title", "club", "none", NULL};
  bool names_text = false;
  for (int k = 0; names[k] != NULL; k++)
    names_text |= strncmp(title, names[k], strlen(names[k])) == 0;
  char *column = strstr(ruling, " | ");
  int source = 0;
  if (column != NULL) {
    *column = '\0';
    column[3 + strcspn(column + 3, "\n")] = '\0';
    for (source = 1; sources[source] != NULL && strcmp(sources[source], column + 3) != 0;)
      source++;
  }
  ck_assert_msg(names_text == (source > 0) && sources[source] != NULL,
                "a title that names a text has text, title, club or none in its fifth column: %s",
                title);
  return source;
}

TEST(situations) {
  FILE *file = fopen(CAROM_TEST_SITUATIONS, "r");
  ck_assert_ptr_nonnull(file);
  char line[512];
  int rows = 0, of_source[5] = {0};
  while (fgets(line, sizeof line, file) != NULL) {
    if (line[0] == '#' || line[0] == '\n')
      continue;
    char *column[4] = {line};
    for (int k = 1; k < 4; k++) {
      column[k] = strstr(column[k - 1], " | ");
      ck_assert_msg(column[k] != NULL, "a row of situations.txt has four columns, not: %s", line);
      *column[k] = '\0';
      column[k] += 3;
    }

    of_source[take_source(column[1], column[3])]++;

    /* both sides begin with the state at the beginning of the game */
    int kind = 0;
    while (strcmp(carom_rules_about_of((carom_rules_kind)kind)->name, column[0]) != 0) {
      kind++;
      ck_assert_msg(carom_rules_about_of((carom_rules_kind)kind) != NULL, "no game: %s", column[0]);
    }
    carom_plan_rules game_rules = carom_plan_rules_of((carom_rules_kind)kind);
    const int rack = carom_rules_about_of((carom_rules_kind)kind)->rack;
    situation row = {.state = game_rules.state,
                     .in_play = (UINT32_C(1) << carom_rack_size((carom_rack_kind)rack)) - 1,
                     .first = {-1, -1},
                     .call = {-1, -1}};
    situation expected = {.state = game_rules.state, .turn = -1};
    read_situation(column[2], &row);
    read_situation(column[3], &expected);
    game_rules.state = row.state;
    if (expected.targets != 0)
      ck_assert_msg(game_rules.on(&game_rules.state, row.in_play) == expected.targets, "%s",
                    column[1]);
    else if (row.lie != 0)
      check_layout(column[1], (carom_rules_kind)kind, &game_rules, &row, &expected);
    else
      check_row(column[1], &game_rules, &row, &expected);
    rows++;
  }
  fclose(file);
  printf("%d rows: %d by a text, %d by its titles, %d by clubs, %d from memory\n", rows,
         of_source[1], of_source[2], of_source[3], of_source[4]);
  ck_assert_int_ge(rows, 430);
  ck_assert_int_ge(of_source[1], 60);
}

#define B(k) (UINT32_C(1) << (k))

/* BCA, cowboy: a ball whose spot is taken stays off until it is free; and all balls come back where
 * that is the 1 and the player needs the last point. */
TEST(spots_of_cowboy) {
  enum { ACE = 1, TREY = 2 };
  carom_ball_state final[CAROM_BALLS_MOST];
  carom_ruling ruling;
  double foot[2], head[2];
  const int count = lay_out(CAROM_RACK_COWBOY, CAROM_TABLE_POOL_9FT, 0xf);
  carom_spot_of(CAROM_RACK_COWBOY, &table, TREY, foot);
  carom_spot_of(CAROM_RACK_COWBOY, &table, ACE, head);
  carom_plan_rules game_rules = carom_plan_rules_of(CAROM_RULES_COWBOY);

  /* the cue ball comes to lie on the foot spot */
  carom_facts facts = facts_of(TREY, 1, B(TREY), 0);
  const carom_shot shot = {.facts = &facts, .final = final};
  put(0, foot[0] + 0.01, foot[1]);
  for (int k = 0; k < count; k++)
    final[k] = balls[k].state;
  final[TREY].label = CAROM_BALL_POCKETED;
  carom_referee(&game_rules, &table, balls, count, 0, &shot, (carom_call){-1, -1}, &ruling);
  ck_assert_int_eq(ruling.balls[TREY].state.label, CAROM_BALL_POCKETED);

  /* and leaves it */
  memcpy(balls, ruling.balls, sizeof balls);
  put(0, foot[0] + 0.3, foot[1]);
  for (int k = 0; k < count; k++)
    final[k] = balls[k].state;
  facts = facts_of(ACE, 1, 0, 0);
  carom_referee(&game_rules, &table, balls, count, 0, &shot, (carom_call){-1, -1}, &ruling);
  ck_assert(ruling.balls[TREY].state.label == CAROM_BALL_STATIONARY &&
            fabs(ruling.balls[TREY].state.r[1] - foot[1]) < 1e-9);

  /* the spot of the 1 is taken, and the other has 100 points */
  game_rules.state.score[1] = 100;
  lay_out(CAROM_RACK_COWBOY, CAROM_TABLE_POOL_9FT, 0xf);
  put(0, head[0] + 0.01, head[1]);
  put(TREY, 0.3, 0.3);
  for (int k = 0; k < count; k++)
    final[k] = balls[k].state;
  final[ACE].label = CAROM_BALL_POCKETED;
  facts = facts_of(TREY, 1, 0, B(ACE));
  carom_referee(&game_rules, &table, balls, count, 0, &shot, (carom_call){-1, -1}, &ruling);
  ck_assert(ruling.turn.leave == CAROM_LEAVE_KITCHEN && ruling.on == B(ACE));
  ck_assert(fabs(ruling.balls[TREY].state.r[1] - foot[1]) < 1e-9);
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
      ck_assert_int_eq(carom_spot_ball_of(cases[k].rack, &table, balls, count, cases[k].ball),
                       CAROM_OK);
      const double *a = balls[cases[k].ball].state.r, *b = balls[cases[k].is_present].state.r;
      const double gap = hypot(a[0] - b[0], a[1] - b[1]) - balls[0].kind.radius * 2.0;
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
  ck_assert_int_eq(carom_shoot(&table, balls, count, &cue, NULL, &shot), CAROM_OK);
  ck_assert_uint_eq(facts.first_set, B(1) | B(9));
  ck_assert_uint_eq(facts.frozen, B(4));
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
    ck_assert_int_eq(
        carom_referee(&game_rules, &table, balls, count, 0, &shot, (carom_call){-1, -1}, &ruling),
        CAROM_OK);
    const bool seen = is_met_somewhere(count, 1) || is_met_somewhere(count, 2);
    ck_assert_msg(ruling.turn.outcome == CAROM_TURN_PASS && ruling.state.on == !seen,
                  "draw %d: on %d, seen %d", n, ruling.state.on, seen);
    snookered += !seen;
  }
  ck_assert_msg(snookered > DRAWS / 10 && snookered < DRAWS * 9 / 10, "%d", snookered);
}
