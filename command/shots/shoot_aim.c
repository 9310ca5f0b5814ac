/* Aims at balls from words: ball_aim.h's, and why there is none. */
#include "shots/shoot_aim.h"

#include "program/program.h"
#include "rows/quantities.h"
#include "shots/ball_aim.h"

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

bool aim_at_ball(const char *name, const layout *l, const carom_shot_options *options, double cut,
                 carom_cue *cue) {
  char text[BALL_TEXT], names[NAMES_TEXT], hint[HINT_TEXT];
  carom_event contact;
  const int index = ball_named(l, name, strlen(name), names);
  if (index < 0 && names[0] == '\0')
    complain("--at-ball '%s': there is no ball to aim at; try --balls 0.6,1.5 with --at-ball 1",
             name);
  else if (index < 0)
    complain("--at-ball '%s': no such ball; try %s, of --balls", name,
             words_to_try(name, names, hint));
  else if (!(fabs(cut) < 90.0))
    complain("--cut '%g': no contact; try an angle between -90 and 90 degrees", cut);
  else if (carom_shot_check(&l->table, l->ball, l->count, cue, options, NULL) != CAROM_OK)
    return true; /* which is told when it is played */
  else {
    const aim_result found =
        aim_at(&l->table, l->ball, l->count, options, index, cut, cue, &contact);
    *l->missed |= found != AIM_FOUND;
    switch (l->quiet ? AIM_FOUND : found) {
    case AIM_FOUND:
      return found == AIM_FOUND;
    case AIM_BARRED:
      complain("--at-ball %s: at a cut of %.4g degrees %s is in the way", name, cut,
               obstacle(l, contact.type, contact.a == 0 ? contact.b : contact.a, text));
      break;
    case AIM_NOT_REACHED:
      complain("--at-ball %s: at a cut of %.4g degrees the cue ball comes to rest before it; give "
               "a higher --speed",
               name, cut);
      break;
    default:
      complain("--at-ball %s: no direction of this cue makes the cue ball meet it first at a cut "
               "of %.4g degrees",
               name, cut);
    }
  }
  return false;
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
