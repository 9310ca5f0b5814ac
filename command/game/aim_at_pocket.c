/* Aims at pockets from words: the planner's, and why there is none. */
#include "carom_plan.h"
#include "program/message.h"
#include "program/words.h"
#include "shots/places.h"
#include "shots/shot_story.h"

#include <math.h>
#include <string.h>

/* A way in words: " by a kick off the head rail" for rails before the first ball, " by ball 2", "
 * off the left rail". */
static void say_way(const layout *l, const carom_pot *pot, char words[AIMED_TEXT]) {
  int first = 0;
  while (first < pot->vias && pot->via[first].kind == CAROM_PART_RAIL)
    first++;
  words[0] = '\0';
  for (int k = 0; k < pot->vias; k++) {
    const carom_part *part = &pot->via[k];
    char *end = words + strlen(words);
    const size_t room = (size_t)(words + AIMED_TEXT - end);
    const char *link = " off";
    if (k > 0 && part[-1].kind == CAROM_PART_RAIL)
      link = ",";
    else if (k < first && first < pot->vias)
      link = " by a kick off";
    if (part->kind == CAROM_PART_RAIL)
      snprintf(end, room, "%s the %s rail", link, carom_rail_name(&l->table, part->index));
    else if (part->index != pot->ball)
      snprintf(end, room, " by ball %s", l->name[part->index]);
  }
}

/* Complains of one part of --via, which has `count` good parts before it. */
static void complain_of_via(const char *via, const char *wrong, const char *names, int count) {
  char list[HINT_TEXT];
  if (count == CAROM_VIA_MOST)
    complain("--via '%.40s': too many; try at most %d rails and balls", via, CAROM_VIA_MOST);
  else if (place_among(names, wrong, strlen(wrong)) >= 0)
    complain("--via '%.40s': %s cannot come there; try each ball once, that of --pocket last", via,
             wrong);
  else
    complain("--via '%.40s': no ball or rail '%s'; try %s", via, wrong,
             words_to_try(wrong, names, list));
}

/* The way of --via; false after a complaint. */
static bool read_via(const layout *l, const char *via, carom_pot *pot) {
  char names[NAMES_TEXT], wrong[PLACE_NAME] = "";
  const char *way = via;
  bool named = false, good = true;
  for (size_t size; via != NULL && good; via = via[size] != '\0' ? via + size + 1 : NULL) {
    size = strcspn(via, ",");
    carom_part part = {.index = ball_named(l, via, size, names)};
    part.kind = part.index >= 0 ? CAROM_PART_BALL : CAROM_PART_NONE;
    for (int rail = 0; rail < l->table.rails; rail++) {
      const char *name = carom_rail_name(&l->table, rail);
      if (part.kind == CAROM_PART_NONE && name != NULL && same_word(via, size, name, strlen(name)))
        part = (carom_part){CAROM_PART_RAIL, rail};
    }
    snprintf(wrong, sizeof wrong, "%.*s", (int)(size < sizeof wrong ? size : sizeof wrong - 1),
             via);
    good = part.kind != CAROM_PART_NONE && pot->vias < CAROM_VIA_MOST &&
           !(named && part.kind == CAROM_PART_BALL);
    for (int k = 0; k < pot->vias; k++) /* a ball is met once */
      good &= part.kind != CAROM_PART_BALL || pot->via[k].kind != part.kind ||
              pot->via[k].index != part.index;
    if (!good)
      break;
    named |= part.kind == CAROM_PART_BALL && part.index == pot->ball;
    pot->via[pot->vias++] = part;
  }
  if (good)
    return true;
  snprintf(names + strlen(names), NAMES_TEXT - strlen(names), RAILS);
  complain_of_via(way, wrong, names, pot->vias);
  return false;
}

/* Says why there is no aim. */
static void complain_of(const char *pocket, const char *via, const layout *l, const carom_pot *pot,
                        double speed) {
  const carom_brief_event *contact = &pot->met;
  char text[BALL_TEXT], more[BALL_TEXT], why[160] = "the jaws send the ball back at this speed";
  const char *what = pot->vias > 0 ? "by this way" : "there directly";
  /* of two balls that meet the one on its way comes first, unless both are */
  int first_ball = contact->b, second = contact->a;
  if (contact->a == 0 || contact->a == pot->ball) {
    first_ball = contact->a;
    second = contact->b;
  }
  bool twice = second == 0 || second == pot->ball;
  for (int k = 0; k < pot->vias; k++)
    twice |= pot->via[k].kind == CAROM_PART_BALL && pot->via[k].index == second;
  if (pot->outcome == CAROM_POT_STICK)
    snprintf(why, sizeof why,
             "the stick would be raised by %.4g degrees over what is behind the cue ball, and "
             "nobody plays above 60; give a higher --tip",
             pot->elevation);
  else if (pot->outcome == CAROM_POT_NO_WAY)
    snprintf(why, sizeof why, "no direction of the cue sends the ball %s", what);
  else if (pot->outcome == CAROM_POT_SHORT)
    snprintf(why, sizeof why,
             "%s comes to rest on its way, with the cue at %.3g m/s; give a higher --speed",
             ball_words(l, contact->a, text), speed);
  else if (pot->outcome == CAROM_POT_BARRED && contact->type == CAROM_EVENT_BALL_BALL && twice)
    snprintf(why, sizeof why, "%s and %s meet twice", ball_words(l, first_ball, text),
             ball_words(l, second, more));
  else if (pot->outcome == CAROM_POT_BARRED)
    snprintf(why, sizeof why, "%s is in the way of %s", obstacle(l, contact->type, second, text),
             ball_words(l, first_ball, more));
  complain("--pocket %s%s%s: no such aim: %s", pocket, text_if(via != NULL, " --via "),
           text_if(via != NULL, via), why);
}

bool aim_at_pocket(const char *pocket, const char *via, const layout *l,
                   const carom_shot_options *options, carom_cue *cue, char report[AIMED_TEXT]) {
  const char *colon = strchr(pocket, ':'), *name = colon != NULL ? colon + 1 : "";
  char known[NAMES_TEXT] = "", balls[NAMES_TEXT], way_words[AIMED_TEXT], hint[HINT_TEXT];
  char ball[PLACE_NAME];
  carom_pot pot = {.pocket = pocket_named(&l->table, l->named->pocket, name, known),
                   .ball =
                       ball_named(l, pocket, colon != NULL ? (size_t)(colon - pocket) : 0, balls)};
  snprintf(ball, sizeof ball, "%.*s", (int)strcspn(pocket, ":"), pocket);
  bool good = false;
  if (l->table.pockets == 0)
    complain("--pocket '%.40s': the table has no pockets; try another --table", pocket);
  else if (colon == NULL)
    complain("--pocket '%.40s': not BALL:POCKET; try 1:foot-left (see --help)", pocket);
  else if (pot.ball < 0 && balls[0] == '\0')
    complain("--pocket '%.40s': there is no ball to pot; try --balls 0.6,1.5 with it", pocket);
  else if (pot.ball < 0)
    complain("--pocket '%.40s': no such ball; try %s, of --balls", pocket,
             words_to_try(ball, balls, hint));
  else if (pot.pocket < 0)
    complain("--pocket '%.40s': no such pocket; try %s (--help lists them)", pocket,
             words_to_try(name, known, hint));
  else if (!read_via(l, via, &pot))
    return false;
  else if (carom_aim(&l->table, l->ball, l->count, options, &pot, cue) != CAROM_OK) {
    cue->theta = isnan(cue->theta) ? 0.0 : cue->theta;
    good = true; /* which is told when it is played */
  } else if (pot.outcome != CAROM_POT_FALLS) {
    *l->missed = true;
    *l->fell_short = pot.outcome == CAROM_POT_SHORT;
    if (!l->quiet)
      complain_of(pocket, via, l, &pot, cue->speed);
  } else {
    char margin[80] = "the ball touches a jaw", raise[96] = "";
    say_way(l, &pot, way_words);
    if (pot.margin > 0.0)
      snprintf(margin, sizeof margin, "the ball has %.2f degrees to either jaw", pot.margin);
    if (cue->theta < pot.elevation)
      snprintf(
          raise, sizeof raise,
          "butt   a level cue meets a cushion or a ball: raise it by %.1f degrees, or --elevation "
          "least\n",
          pot.elevation);
    good =
        snprintf(
            report, AIMED_TEXT,
            "aim    %s to the %s pocket%s: cut %.1f degrees to the %s; %s\n       falls with aims "
            "of %.2f to %.2f degrees at this speed, and with %.3g to %.3g m/s of the cue at this "
            "aim\n%s",
            l->name[pot.ball], carom_pocket_name(&l->table, pot.pocket), way_words, fabs(pot.cut),
            pot.cut < 0.0 ? "right" : "left", margin, pot.phi[0], pot.phi[1], pot.speed[0],
            pot.speed[1], raise) > 0;
  }
  return good;
}
