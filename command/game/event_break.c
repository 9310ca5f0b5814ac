/* The conditions of breaks at professional events, which sources of their results leave out: data/
 * measured.csv has these results, and docs/understanding/published.md compares them. */
#include "game/event_break.h"
#include "program/command.h"
#include "program/words.h"
#include "rows/quantities.h"
#include "shots/places.h"

#include <stdio.h>
#include <string.h>

enum { NUMBER_TEXT = 80 };

/* How far the cue ball is from the long string, m: nine-ball is broken from the side. */
static double offset_of(carom_rack_kind rack) {
  const bool nine = rack == CAROM_RACK_NINEBALL || rack == CAROM_RACK_NINEONSPOT;
  return nine ? 0.45 : 0.35;
}

const char event_break_help[] =
    "fill in what is not given as at professional events, tournament: fast_cloth, a ball speed of "
    "10 m/s, the cue ball on the head string 0.45 m off centre in nine-ball and 0.35 m "
    "otherwise, and eight-ball's rack with the 8 on the foot spot";

OPTION_SET(set_conditions) {
  if (!same_word(text, strlen(text), "tournament", strlen("tournament")))
    return refuse_value(row, text, "no such conditions; try tournament");
  *(bool *)field = true;
  return true;
}

void fill_event_break(shoot_flags *f, carom_rack_kind *rack) {
  char text[NUMBER_TEXT];
  if (*rack == CAROM_RACK_EIGHTBALL)
    *rack = CAROM_RACK_EIGHTONSPOT;
  if (f->shared.with.condition == NULL) {
    snprintf(text, sizeof text, "%s",
             carom_word(CAROM_WORDS_CONDITION, CAROM_CONDITION_FAST_CLOTH));
    option_with_of_shots.set(&option_with_of_shots, text, &f->shared.with);
  }
  if (f->speed.count == 0 && f->ball_speed.count == 0)
    values_default(&f->ball_speed, MEASURE_SPEED, "10");
  if (f->cue.count == 0) {
    carom_table table;
    carom_marks marks;
    carom_table_make((carom_table_kind)(f->table.kind - 1), &table);
    carom_table_marks(&table, &marks);
    snprintf(text, sizeof text, "%.4f,%.4f", marks.head_spot[0] + offset_of(*rack),
             marks.head_spot[1]);
    option_cue.set(&option_cue, text, &f->cue);
  }
}
