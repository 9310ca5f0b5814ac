/* What is wrong with the arguments of a shot, in words, and which of its numbers no model reads. */
#include "shots/shot_fault.h"

#include "program/memory.h"
#include "program/message.h"

#include <math.h>
#include <stdio.h>

/* How far the tip is from the centre, R. */
double tip_off_centre(const carom_cue *cue) {
  return hypot(cue->a, cue->b);
}

/* What is wrong with the arguments of a shot, with the key. False if nothing is. */
bool shot_fault(const shot_line *line, const carom_shot_options *options, char text[FAULT_TEXT]) {
  static const char *const lists[] = {
      [CAROM_PART_RAIL] = "linear", [CAROM_PART_JAW] = "circular", [CAROM_PART_POCKET] = "pockets"};
  carom_fault f;
  char must[100];
  const carom_status bad = carom_shot_fault(&line->table->table, line->ball, line->count,
                                            &line->cue, options, &f, must, sizeof must);
  const carom_number *n = f.row;
  const char *key = n == NULL ? "" : n->key[0] != '\0' ? n->key : n->name;
  const int at = f.part.index;
  if (bad == CAROM_OK)
    return false;

  /* where it is */
  int size = 0;
  if (bad == CAROM_ERROR_TABLE || bad == CAROM_ERROR_NOSE_HEIGHT)
    size = snprintf(text, FAULT_TEXT, "table '%s': ", line->table->id);
  else if (f.part.kind == CAROM_PART_BALL || f.part.kind == CAROM_PART_STATE)
    size = snprintf(text, FAULT_TEXT, "balls[%d] ('%s'): ", at, line->name[at]);
  char *rest = text + size;
  const size_t room = (size_t)(FAULT_TEXT - size);

  /* which number it is, and what would be right */
  if (bad == CAROM_ERROR_MISCUE)
    snprintf(rest, room,
             "cue: the tip is %.4g R from the centre; it slips off the ball from %.4g R on",
             tip_off_centre(&line->cue), line->cue.miscue > 0.0 ? line->cue.miscue : 1.0);
  else if (bad == CAROM_ERROR_OFF_TABLE && at >= 0 && at < line->count) {
    const double *r = line->ball[at].state.r, R = line->ball[at].kind.radius;
    size = snprintf(rest, room, "%s", carom_status_string(bad));
    if (fabs(r[2] - R) > 1e-6)
      snprintf(rest + size, room - (size_t)size,
               ": its centre must lie at z = R = %.6g m, not at z = %.6g", R, r[2]);
    else
      snprintf(rest + size, room - (size_t)size,
               ": x = %.6g, y = %.6g m is in a cushion or a pocket, or outside%s", r[0], r[1],
               fmax(r[0], r[1]) > 10.0 ? "; are places in m?" : "");
  } else if (n == NULL || must[0] == '\0' || f.part.kind == CAROM_PART_STATE)
    snprintf(rest, room, "%s", carom_status_string(bad));
  else if (f.part.kind <= CAROM_PART_POCKET)
    snprintf(rest, room, "%s[%d].%s must be %s, not %.6g", lists[f.part.kind], at, key, must,
             f.value);
  else
    snprintf(rest, room, "%s%s must be %s, not %.6g",
             f.part.kind == CAROM_PART_BALL  ? "params."
             : f.part.kind == CAROM_PART_CUE ? "cue."
                                             : "",
             key, must, f.value);
  return true;
}

/* Gives the balls the numbers of --with, and says once for each which numbers of a file these
 * models do not read. --strict makes it an error. */
void shot_numbers(shot_line *line, const shared_options *shared, const char *file, uint64_t *told) {
  const carom_number *n;
  if (line->error != NULL)
    return;
  for (int k = 0; (n = carom_number_of(CAROM_PART_BALL, k)) != NULL; k++) {
    int i = 0;
    while (i < line->count && !carom_number_is_read(n, &line->ball[i].kind, &shared->shot))
      i++;
    const uint64_t bit = (uint64_t)1 << k;
    if ((line->given & bit) == 0 || i < line->count || (shared->with.which & bit) != 0)
      continue;
    char reader[160], text[FAULT_TEXT];
    snprintf(text, sizeof text, "params.%s has no effect; %s reads it", n->key,
             reader_of(n, "cushion", reader));
    if (shared->strict) {
      line->error = copy_text(text);
      line->table = NULL;
      return;
    }
    if ((*told & bit) == 0)
      complain("%s:%zu: %s", file, line->number, text);
    *told |= bit;
  }
  const given_numbers *with = &shared->with;
  give_cue(with, &line->cue);
  json_t *cue = json_object_get(line->json, "cue");
  for (int k = 0; cue != NULL && (n = carom_number_of(CAROM_PART_CUE, k)) != NULL; k++)
    if ((with->of_cue >> k & 1) != 0)
      json_object_set_new(
          cue, n->key,
          json_real(*(const double *)(const void *)((const char *)&with->cue + n->offset)));
  for (int k = 0; (n = carom_number_of(CAROM_PART_BALL, k)) != NULL; k++)
    if ((with->which >> k & 1) != 0)
      shot_line_give(line, n,
                     *(const double *)(const void *)((const char *)&with->kind + n->offset));
}
