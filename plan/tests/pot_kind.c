/* What a stroke was: the kind of a pot by the order of precedence, the marks of a stroke, and the
 * terms. The shots are lists of events, made by hand. */
#include "pot_kind.h"
#include "plan_support.h"

enum { CUE, BALL, OTHER, THIRD, EVENTS_MOST = 8 };
/* of a 9-foot table: rails by their names, and the pocket at the end of two of them */
static int left_rail, right_rail, foot_rail, pocket, cut;

/* The first rail of a name; NULL: a cut of a pocket. */
static int rail_of(const char *name) {
  for (int k = 0; k < table.rails; k++) {
    const char *rail_name = carom_rail_name(&table, k);
    if (rail_name == NULL ? name == NULL : name != NULL && strcmp(rail_name, name) == 0)
      return k;
  }
  return -1;
}

static void make_table(void) {
  carom_table_make(CAROM_TABLE_POOL_9FT, &table);
  for (pocket = 0; strcmp(carom_pocket_name(&table, pocket), "foot-left") != 0;)
    pocket++;
  foot_rail = rail_of("foot");
  right_rail = rail_of("right");
  cut = rail_of(NULL);
  left_rail = -1;
  for (int k = 0; k < table.rails; k++) {
    const char *name = carom_rail_name(&table, k);
    if (name != NULL && strcmp(name, "left") == 0 && carom_is_beside(&table, k, pocket))
      left_rail = k;
  }
  ck_assert(left_rail >= 0 && foot_rail >= 0 && right_rail >= 0);
}

static carom_brief_event contact(double time, int a, int b) {
  return (carom_brief_event){.time = time, .type = CAROM_EVENT_BALL_BALL, .a = a, .b = b};
}

static carom_brief_event rail(double time, int ball, int rail_index) {
  return (carom_brief_event){.time = time, .type = CAROM_EVENT_RAIL, .a = ball, .b = rail_index};
}

static carom_brief_event fall(double time, int ball) {
  return (carom_brief_event){.time = time, .type = CAROM_EVENT_POCKET, .a = ball, .b = pocket};
}

/* A shot of these events, up to the first of no time. */
static int kind_of(const carom_brief_event list[EVENTS_MOST]) {
  carom_brief_event brief[EVENTS_MOST];
  carom_event events[EVENTS_MOST];
  int count = 0;
  memset(events, 0, sizeof events);
  for (; count < EVENTS_MOST && list[count].time > 0.0; count++) {
    brief[count] = list[count];
    events[count].time = list[count].time;
    events[count].type = list[count].type;
    events[count].a = list[count].a;
    events[count].b = list[count].b;
  }
  const carom_shot shot = {.brief = brief, .room = EVENTS_MOST, .count = count};
  const carom_shot with_states = {.events = events, .room = EVENTS_MOST, .count = count};
  const int kind = carom_pot_kind(&table, &shot, CUE, BALL, pocket);
  ck_assert_int_eq(carom_pot_kind(&table, &with_states, CUE, BALL, pocket), kind);
  return kind;
}

#define KIND(expected, ...) \
  ck_assert_int_eq(kind_of((const carom_brief_event[EVENTS_MOST]){__VA_ARGS__}), expected)

TEST(one_departure_names_a_pot) {
  make_table();
  KIND(CAROM_PLAN_POT, contact(1, CUE, BALL), fall(2, BALL));
  KIND(CAROM_PLAN_BANK, contact(1, CUE, BALL), rail(2, BALL, right_rail), fall(3, BALL));
  KIND(CAROM_PLAN_KICK, rail(1, CUE, right_rail), contact(2, BALL, CUE), fall(3, BALL));
  KIND(CAROM_PLAN_KISS, contact(1, CUE, BALL), contact(2, OTHER, BALL), fall(3, BALL));
  KIND(CAROM_PLAN_CAROM, contact(1, CUE, OTHER), contact(2, CUE, BALL), fall(3, BALL));
  KIND(CAROM_PLAN_COMBINATION, contact(1, CUE, OTHER), contact(2, OTHER, BALL), fall(3, BALL));
}

/* Each before the next one: combination, carom, kiss, kick, bank. */
TEST(precedence) {
  make_table();
  KIND(CAROM_PLAN_COMBINATION, contact(1, CUE, THIRD), rail(2, CUE, right_rail),
       contact(3, CUE, OTHER), contact(4, OTHER, BALL), contact(5, BALL, THIRD),
       rail(6, BALL, right_rail), fall(7, BALL));
  KIND(CAROM_PLAN_CAROM, rail(1, CUE, right_rail), contact(2, CUE, OTHER), contact(3, CUE, BALL),
       contact(4, BALL, THIRD), rail(5, BALL, right_rail), fall(6, BALL));
  KIND(CAROM_PLAN_KISS, rail(1, CUE, right_rail), contact(2, CUE, BALL), contact(3, BALL, THIRD),
       rail(4, BALL, right_rail), fall(5, BALL));
  KIND(CAROM_PLAN_KICK, rail(1, CUE, right_rail), contact(2, CUE, BALL), rail(3, BALL, right_rail),
       fall(4, BALL));
}

TEST(what_does_not_count) {
  make_table();
  /* cushions beside the pocket, unless another cushion is met too */
  KIND(CAROM_PLAN_POT, contact(1, CUE, BALL), rail(2, BALL, left_rail), rail(3, BALL, foot_rail),
       fall(4, BALL));
  KIND(CAROM_PLAN_BANK, contact(1, CUE, BALL), rail(2, BALL, left_rail), rail(3, BALL, right_rail),
       fall(4, BALL));
  /* the cut of a pocket, of which some tables have none */
  if (cut >= 0)
    KIND(CAROM_PLAN_POT, rail(1, CUE, cut), contact(2, CUE, BALL), rail(3, BALL, cut),
         fall(4, BALL));
  /* the cue ball once more, and what it meets after the ball */
  KIND(CAROM_PLAN_POT, contact(1, CUE, BALL), contact(2, CUE, BALL), contact(3, CUE, OTHER),
       rail(4, CUE, right_rail), fall(5, BALL));
  /* of two contacts of one instant the cue ball's drives */
  KIND(CAROM_PLAN_KISS, contact(1, OTHER, BALL), contact(1, CUE, BALL), fall(2, BALL));
  /* what the ball meets after its fall */
  KIND(CAROM_PLAN_POT, contact(1, CUE, BALL), fall(2, BALL), contact(3, BALL, OTHER));
  /* no pot: not met, not fallen, another pocket */
  KIND(-1, fall(1, BALL));
  KIND(-1, contact(1, CUE, BALL));
  pocket++;
  const carom_brief_event elsewhere = fall(2, BALL);
  pocket--;
  KIND(-1, contact(1, CUE, BALL), elsewhere);
  const carom_shot none = {.events = NULL};
  ck_assert_int_eq(carom_pot_kind(&table, &none, CUE, BALL, pocket), -1);
  ck_assert_int_eq(carom_pot_kind(NULL, &none, CUE, BALL, pocket), -1);
  ck_assert_int_eq(carom_pot_kind(&table, NULL, CUE, BALL, pocket), -1);
  ck_assert_int_eq(carom_is_beside(&table, (int)table.rails, pocket), 0);
  ck_assert_int_eq(carom_is_beside(&table, left_rail, -1), 0);
  ck_assert_int_eq(carom_is_beside(&table, right_rail, pocket), 0);
}

TEST(marks) {
  carom_facts f = {.first = {1, -1}, .first_time = {0.5, INFINITY}, .touches = 1};
  ck_assert_uint_eq(carom_stroke_marks(&f, 0), 0);
  ck_assert_uint_eq(carom_stroke_marks(NULL, 0), 0);
  f.down = 2;
  ck_assert_uint_eq(carom_stroke_marks(&f, 0), CAROM_MARK_LEGAL_BREAK);
  f.down = 1;
  ck_assert_uint_eq(carom_stroke_marks(&f, 0), CAROM_MARK_SCRATCH);
  ck_assert_uint_eq(carom_stroke_marks(&f, 1), CAROM_MARK_LEGAL_BREAK);
  f.down = 0;
  f.touches = 2;
  ck_assert_uint_eq(carom_stroke_marks(&f, 0), CAROM_MARK_DOUBLE_HIT);
  f.touches = 1;
  f.pushed = 2;
  ck_assert_uint_eq(carom_stroke_marks(&f, 0), CAROM_MARK_DOUBLE_HIT);
  f.frozen = 2;
  ck_assert_uint_eq(carom_stroke_marks(&f, 0), 0);
  f.first[1] = 2;
  f.first_time[1] = 0.5009;
  ck_assert_uint_eq(carom_stroke_marks(&f, 0), CAROM_MARK_SPLIT_HIT);
  f.first_time[1] = 0.5011;
  ck_assert_uint_eq(carom_stroke_marks(&f, 0), 0);
  for (int k = 0; k < 4; k++)
    f.cushions[k] = 1; /* the cue ball's is none */
  ck_assert_uint_eq(carom_stroke_marks(&f, 0), 0);
  f.cushions[4] = 2;
  ck_assert_uint_eq(carom_stroke_marks(&f, 0), CAROM_MARK_LEGAL_BREAK);
}

/* Each kind has a word of its own, and each term beyond them a meaning. */
TEST(terms_have_words) {
  int terms = 0;
  for (const carom_term *t; (t = carom_term_of(terms)) != NULL; terms++) {
    ck_assert(t->name != NULL && t->name[0] != '\0' && t->meaning != NULL);
    for (int k = 0; k < terms; k++)
      ck_assert_str_ne(carom_term_of(k)->name, t->name);
    if (terms <= CAROM_PLAN_KISS)
      ck_assert_str_eq(carom_plan_kind_name((carom_plan_kind)terms), t->name);
    else
      ck_assert(t->meaning[0] != '\0');
  }
  ck_assert(terms > CAROM_PLAN_KISS + 3 && carom_term_of(-1) == NULL);
  ck_assert_str_eq(carom_plan_kind_name((carom_plan_kind)-1), "");
  ck_assert_str_eq(carom_plan_kind_name((carom_plan_kind)(CAROM_PLAN_KISS + 1)), "");
}
