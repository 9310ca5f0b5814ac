/* What a stroke was: the kind of a pot by the order of precedence, the marks of a stroke, and the
 * terms. The shots are lists of events; complete shots are in ways.c and facts.c. */
#include "pot_kind.h"
#include "plan_support.h"

enum { CUE, BALL, EVENTS_MOST = 8, POCKET = 2 };

/* A ball by its letter; -1: none. */
static int ball_of(char letter) {
  static const char letters[] = "cbot";
  const char *const found = strchr(letters, letter);
  return found == NULL ? -1 : (int)(found - letters);
}

/* A contact of two balls, or a fall into the pocket, ".", or into the next one, ",". */
static carom_brief_event event_of(double time, const char *word) {
  carom_brief_event event = {.time = time, .type = CAROM_EVENT_BALL_BALL, .a = ball_of(word[0])};
  event.b = ball_of(word[1]);
  if (event.b < 0) {
    event.type = CAROM_EVENT_POCKET;
    event.b = POCKET + (word[1] == ',');
  }
  ck_assert_msg(event.a >= 0, "no event: %s", word);
  return event;
}

/* The kind of a shot of these events, one a second; = is at the instant of the one before. What
 * the facts say of cushions is in front: K a kick, R rail first, B the ball is banked. */
static int kind_of(const char *list) {
  carom_brief_event brief[EVENTS_MOST];
  carom_event events[EVENTS_MOST];
  carom_facts facts = {0};
  int count = 0;
  double time = 0.0;
  memset(events, 0, sizeof events);
  for (const char *word = list; *word != '\0'; word += strcspn(word, " "), word += *word == ' ') {
    if (*word == 'B')
      facts.banked = 1U << BALL;
    if (*word == 'K' || *word == 'R')
      facts.approach = *word == 'K' ? CAROM_APPROACH_KICK : CAROM_APPROACH_RAIL_FIRST;
    if (strchr("BKR", *word) != NULL)
      continue;
    const bool at_once = *word == '=';
    word += at_once;
    time += at_once ? 0.0 : 1.0;
    const carom_brief_event event = brief[count] = event_of(time, word);
    events[count].time = event.time;
    events[count].type = event.type;
    events[count].a = event.a;
    events[count++].b = event.b;
  }
  const carom_shot shot = {.brief = brief, .room = EVENTS_MOST, .count = count, .facts = &facts};
  const carom_shot with_states = {
      .events = events, .room = EVENTS_MOST, .count = count, .facts = &facts};
  const int kind = carom_pot_kind(&shot, CUE, BALL, POCKET);
  ck_assert_int_eq(carom_pot_kind(&with_states, CUE, BALL, POCKET), kind);
  return kind;
}

TEST(kinds_of_pots) {
  static const struct {
    const char *what_counts;
    const char *kind; /* "": none */
    const char *shot;
  } shots[] = {{"one departure", "pot", "cb b."},
               {"one departure", "bank", "B cb b."},
               {"one departure", "kick", "K cb b."},
               {"one departure", "rail first", "R cb b."},
               {"one departure", "kiss", "cb ob b."},
               {"one departure", "carom", "co cb b."},
               {"one departure", "combination", "co ob b."},
               {"before all", "combination", "K B ct co ob bt b."},
               {"before a kiss", "carom", "K B co cb bt b."},
               {"before a kick", "kiss", "K B cb bt b."},
               {"before a bank", "kick", "K B cb b."},
               {"before a bank", "rail first", "R B cb b."},
               {"the cue ball once more, and what it meets after the ball", "pot", "cb cb co b."},
               {"of one instant the cue ball's contact drives", "kiss", "ob =cb b."},
               {"what the ball meets after its fall", "pot", "cb b. bo"},
               {"not met", "", "b."},
               {"not fallen", "", "cb"},
               {"another pocket", "", "cb b,"}};
  for (size_t k = 0; k < COUNT_OF(shots); k++) {
    const char *name = carom_word_text(CAROM_WORDS_PLAN_KIND, kind_of(shots[k].shot));
    if (name == NULL) /* there is no pot */
      name = "";
    ck_assert_msg(strcmp(name, shots[k].kind) == 0, "%s: %s is a %s", shots[k].what_counts,
                  shots[k].shot, name);
  }
}

TEST(what_is_no_shot) {
  carom_facts facts = {0};
  const carom_shot without_events = {.facts = &facts};
  carom_brief_event event = {0};
  const carom_shot without_facts = {.brief = &event, .room = 1};
  ck_assert_int_eq(carom_pot_kind(&without_events, CUE, BALL, POCKET), -1);
  ck_assert_int_eq(carom_pot_kind(&without_facts, CUE, BALL, POCKET), -1);
  ck_assert_int_eq(carom_pot_kind(NULL, CUE, BALL, POCKET), -1);
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

/* Each kind has its own word, and each term beyond them a meaning. */
TEST(terms_have_words) {
  int terms = 0;
  for (const carom_term *t; (t = carom_term_of(terms)) != NULL; terms++) {
    ck_assert(t->name != NULL && t->name[0] != '\0' && t->meaning != NULL);
    for (int k = 0; k < terms; k++)
      ck_assert_str_ne(carom_term_of(k)->name, t->name);
    if (terms < CAROM_PLAN_KINDS)
      ck_assert_str_eq(carom_word_text(CAROM_WORDS_PLAN_KIND, terms), t->name);
    else
      ck_assert(t->meaning[0] != '\0');
  }
  ck_assert(terms > CAROM_PLAN_KINDS + 2 && carom_term_of(-1) == NULL);
  ck_assert_ptr_null(carom_word_text(CAROM_WORDS_PLAN_KIND, -1));
  ck_assert_ptr_null(carom_word_text(CAROM_WORDS_PLAN_KIND, CAROM_PLAN_KINDS));
}
