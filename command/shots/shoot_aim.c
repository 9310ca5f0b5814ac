/* Balls and pockets by their names, as aims have them. */
#include "shots/shoot_aim.h"

#include "program/program.h"
#include "rows/quantities.h"

int ball_named(const layout *l, const char *name, size_t size, char names[NAMES_TEXT]) {
  int found = -1;
  names[0] = '\0';
  for (int k = 1; k < l->count; k++) {
    snprintf(names + strlen(names), NAMES_TEXT - strlen(names), "%s|", l->name[k]);
    if (strlen(l->name[k]) == size && strncmp(l->name[k], name, size) == 0)
      found = k;
  }
  return found;
}

const char *names_there(char names[NAMES_TEXT]) {
  char text[NAMES_TEXT];
  size_t size = 0;
  for (const char *letter = names; *letter != '\0' && size + 3 < sizeof text; letter++) {
    const bool is_bar = *letter == '|';
    if (!is_bar)
      text[size++] = *letter;
    else if (letter[1] != '\0')
      size += (size_t)snprintf(text + size, sizeof text - size, ", ");
  }
  text[size] = '\0';
  snprintf(names, NAMES_TEXT, "%s", size > 0 ? text : "none");
  return names;
}

const char *named_ball(const char *name, char text[BALL_TEXT]) {
  const size_t letters = strspn(name, "abcdefghijklmnopqrstuvwxyz");
  const char *article = "";
  if (letters < 2)
    article = "ball ";
  else if (name[letters] == '\0')
    article = "the ";
  snprintf(text, BALL_TEXT, "%s%s", article, name);
  return text;
}

const char *ball_words(const layout *l, int ball, char text[BALL_TEXT]) {
  return ball == 0 ? "the cue ball" : named_ball(l->name[ball], text);
}

const char *obstacle(const layout *l, int type, int index, char text[BALL_TEXT]) {
  switch (type) {
  case CAROM_EVENT_BALL_BALL:
    return ball_words(l, index, text);
  case CAROM_EVENT_POCKET:
    return "a pocket";
  case CAROM_EVENT_LEFT_TABLE:
    return "the end of the table";
  case CAROM_EVENT_JAW:
    return "the jaw of a pocket";
  default:
    return "a cushion";
  }
}

int ball_in_front(const carom_shot_ball *ball, int count) {
  const double *start = ball[0].state.r;
  double nearest = INFINITY;
  int front = 0;
  for (int k = 1; k < count; k++) {
    const double away = plane_distance(ball[k].state.r, start);
    if (away < nearest) {
      nearest = away;
      front = k;
    }
  }
  return front;
}

int pocket_named(const carom_table *t, char *const id[], const char *name, char names[NAMES_TEXT]) {
  int found = -1;
  for (int p = 0; p < t->pockets; p++) {
    const char *pocket = carom_pocket_name(t, p) != NULL ? carom_pocket_name(t, p) : id[p];
    snprintf(names + strlen(names), NAMES_TEXT - strlen(names), "%s%s", text_if(p > 0, "|"),
             pocket);
    if (same_word(name, strlen(name), pocket, strlen(pocket)) || same_text(id[p], name))
      found = p;
  }
  return found;
}
