/* What a stroke was: the kind of a pot by the order of precedence, the marks of a stroke, and the
 * terms. The shots are lists of events of texts.txt. */
#include "pot_kind.h"
#include "plan_support.h"

enum { CUE, BALL, EVENTS_MOST = 8 };
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

/* A ball by its letter; -1: a rail, or a fall. */
static int ball_of(char letter) {
  static const char letters[] = "cbot";
  const char *const found = strchr(letters, letter);
  return found == NULL ? -1 : (int)(found - letters);
}

/* The part that a ball meets: another ball, a rail, or a pocket. */
static carom_brief_event event_of(double time, const char *word) {
  const struct {
    char sign;
    int32_t type, part;
  } parts[] = {{'R', CAROM_EVENT_RAIL, right_rail}, {'L', CAROM_EVENT_RAIL, left_rail},
               {'F', CAROM_EVENT_RAIL, foot_rail},  {'x', CAROM_EVENT_RAIL, cut},
               {'.', CAROM_EVENT_POCKET, pocket},   {',', CAROM_EVENT_POCKET, pocket + 1}};
  carom_brief_event event = {.time = time, .type = CAROM_EVENT_BALL_BALL, .a = ball_of(word[0])};
  event.b = ball_of(word[1]);
  for (size_t k = 0; k < COUNT_OF(parts) && event.b < 0; k++)
    if (parts[k].sign == word[1]) {
      event.type = parts[k].type;
      event.b = parts[k].part;
      return event;
    }
  ck_assert_msg(event.a >= 0 && event.b >= 0, "no event: %s", word);
  return event;
}

/* The kind of a shot of these events, one a second; = is at the instant of the one before. */
static int kind_of(const char *list) {
  carom_brief_event brief[EVENTS_MOST];
  carom_event events[EVENTS_MOST];
  int count = 0;
  double time = 0.0;
  memset(events, 0, sizeof events);
  for (const char *word = list; *word != '\0'; word += strcspn(word, " "), word += *word == ' ') {
    const bool at_once = *word == '=';
    word += at_once;
    time += at_once ? 0.0 : 1.0;
    const carom_brief_event event = brief[count] = event_of(time, word);
    events[count].time = event.time;
    events[count].type = event.type;
    events[count].a = event.a;
    events[count++].b = event.b;
  }
  const carom_shot shot = {.brief = brief, .room = EVENTS_MOST, .count = count};
  const carom_shot with_states = {.events = events, .room = EVENTS_MOST, .count = count};
  const int kind = carom_pot_kind(&table, &shot, CUE, BALL, pocket);
  ck_assert_int_eq(carom_pot_kind(&table, &with_states, CUE, BALL, pocket), kind);
  return kind;
}

TEST(kinds_of_pots) {
  static char rows[20][3][TEXT];
  make_table();
  const int count = read_texts("pot_kind", 3, rows[0]);
  for (int k = 0; k < count; k++) {
    if (cut < 0 && strchr(rows[k][2], 'x') != NULL)
      continue;
    const int kind = kind_of(rows[k][2]);
    ck_assert_msg(strcmp(carom_plan_kind_name((carom_plan_kind)kind), rows[k][1]) == 0,
                  "%s: %s is a %s", rows[k][0], rows[k][2],
                  carom_plan_kind_name((carom_plan_kind)kind));
  }
}

TEST(what_is_no_shot) {
  make_table();
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
