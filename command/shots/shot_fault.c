/* What is wrong with the arguments of a shot, in words, and which of its numbers no model reads. */
#include "shots/shot_fault.h"

#include "program/program.h"
#include "rows/quantities.h"

/* How far the tip is from the centre, R. */
double tip_off_centre(const carom_cue *cue) {
  return hypot(cue->a, cue->b);
}

/* The key of a number in a file; its name where files do not have it. */
static const char *key_of(const carom_number *n) {
  return n->key[0] != '\0' ? n->key : n->name;
}

/* "cue.": the part of a shot's line that a number is in; "" of an option. */
static const char *part_words(carom_part_kind kind) {
  switch (kind) {
  case CAROM_PART_BALL:
    return "params.";
  case CAROM_PART_CUE:
    return "cue.";
  default:
    return "";
  }
}

/* Says where the fault is, "balls[1] ('2'): ", or nothing; returns the length of it. */
static int say_where(const shot_line *line, carom_status status, const carom_part *part,
                     char text[FAULT_TEXT]) {
  if (status == CAROM_ERROR_TABLE || status == CAROM_ERROR_NOSE_HEIGHT ||
      status == CAROM_ERROR_RAILS || status == CAROM_ERROR_JAWS || status == CAROM_ERROR_POCKETS)
    return snprintf(text, FAULT_TEXT, "table '%s': ", line->table->id);
  if (part->kind == CAROM_PART_BALL || part->kind == CAROM_PART_STATE)
    return snprintf(text, FAULT_TEXT, "balls[%d] ('%s'): ", part->index, line->name[part->index]);
  return 0;
}

/* Says of a ball that is not on the table where it is, and where balls are that touch the rails. */
static void say_off_table(const carom_table *table, const carom_shot_ball *ball, char *text,
                          size_t room) {
  const double *r = ball->state.r, R = ball->kind.radius;
  const char *wrong = carom_status_string(CAROM_ERROR_OFF_TABLE);
  if (fabs(r[2] - R) > 1e-6)
    snprintf(text, room, "%s: its centre must lie at z = R = %.6g m, not at z = %.6g", wrong, R,
             r[2]);
  else
    snprintf(
        text, room,
        "%s: x = %.6g, y = %.6g m is in a cushion or a pocket, or outside; from rail to rail x "
        "is %.4g to %.4g m, and y %.4g to %.4g m%s",
        wrong, r[0], r[1], R, table->width - R, R, table->length - R,
        text_if(fmax(r[0], r[1]) > 10.0, "; are places in m?"));
}

/* Says of a ball that overlaps another one which that is, and how far apart they are. */
static void say_overlap(const shot_line *line, int ball, char *text, size_t room) {
  const carom_shot_ball *first = &line->ball[ball];
  int with = ball;
  double least = INFINITY, apart = 0.0, needed = 0.0;
  for (int k = 0; k < line->count; k++) {
    const carom_shot_ball *second = &line->ball[k];
    const double both = first->kind.radius + second->kind.radius;
    const double distance = plane_distance(first->state.r, second->state.r);
    if (k == ball || is_out_of_play(&second->state) || distance - both >= least)
      continue;
    least = distance - both;
    with = k;
    apart = distance;
    needed = both;
  }
  snprintf(text, room,
           "%s: its centre is %.4g mm from that of '%s', and balls that touch are "
           "%.4g mm apart",
           carom_status_string(CAROM_ERROR_OVERLAP), 1e3 * apart, line->name[with], 1e3 * needed);
}

/* What is wrong with the arguments of a shot, with the key. False if nothing is. */
bool shot_fault(const shot_line *line, const carom_shot_options *options, char text[FAULT_TEXT]) {
  static const char *const lists[] = {
      [CAROM_PART_RAIL] = "linear", [CAROM_PART_JAW] = "circular", [CAROM_PART_POCKET] = "pockets"};
  carom_fault f;
  char must[100];
  const carom_status status = carom_shot_fault(&line->table->table, line->ball, line->count,
                                               &line->cue, options, &f, must, sizeof must);
  if (status == CAROM_OK)
    return false;

  const carom_number *n = f.row;
  const int index = f.part.index, size = say_where(line, status, &f.part, text);
  char *rest = text + size;
  const size_t room = (size_t)(FAULT_TEXT - size);

  /* which number it is, and what would be right */
  if (status == CAROM_ERROR_MISCUE)
    snprintf(rest, room,
             "cue: the tip is %.4g R from the centre; it slips off the ball from %.4g R on",
             tip_off_centre(&line->cue), line->cue.miscue > 0.0 ? line->cue.miscue : 1.0);
  else if (status == CAROM_ERROR_OFF_TABLE && index >= 0 && index < line->count)
    say_off_table(&line->table->table, &line->ball[index], rest, room);
  else if (status == CAROM_ERROR_OVERLAP && index >= 0 && index < line->count)
    say_overlap(line, index, rest, room);
  else if (n == NULL || must[0] == '\0' || f.part.kind == CAROM_PART_STATE)
    snprintf(rest, room, "%s", carom_status_string(status));
  else if (f.part.kind <= CAROM_PART_POCKET)
    snprintf(rest, room, "%s[%d].%s must be %s, not %.6g", lists[f.part.kind], index, key_of(n),
             must, f.value);
  else
    snprintf(rest, room, "%s%s must be %s, not %.6g", part_words(f.part.kind), key_of(n), must,
             f.value);
  return true;
}

/* Gives the balls the numbers of --with, and says once for each which numbers of a file these
 * models do not read. --strict makes it an error. */
void shot_numbers(shot_line *line, const shared_options *shared, const char *file,
                  uint64_t *warned) {
  const carom_number *n;
  if (line->error != NULL)
    return;
  for (int k = 0; (n = carom_number_of(CAROM_PART_BALL, k)) != NULL; k++) {
    int i = 0;
    while (i < line->count && !carom_number_is_read(n, &line->ball[i].kind, &shared->shot))
      i++;
    const uint64_t bit = (uint64_t)1 << k;
    if ((line->own_numbers & bit) == 0 || i < line->count || (shared->with.of_balls & bit) != 0)
      continue;
    char reader[160], text[FAULT_TEXT];
    snprintf(text, sizeof text, "params.%s has no effect; %s reads it", n->key,
             reader_of(n, "cushion", reader));
    if (shared->strict) {
      line->error = copy_text(text);
      line->table = NULL;
      return;
    }
    if ((*warned & bit) == 0)
      complain("%s:%zu: %s", file, line->number, text);
    *warned |= bit;
  }
  const given_numbers *with = &shared->with;
  if (with->in_lines)
    return;
  give_cue(with, &line->cue);
  json_t *cue = json_object_get(line->json, "cue");
  for (int k = 0; cue != NULL && (n = carom_number_of(CAROM_PART_CUE, k)) != NULL; k++)
    if ((with->of_cue >> k & 1) != 0)
      json_object_set_new(
          cue, n->key,
          json_real(*(const double *)(const void *)((const char *)&with->cue + n->offset)));
  for (int k = 0; (n = carom_number_of(CAROM_PART_BALL, k)) != NULL; k++)
    if ((with->of_balls >> k & 1) != 0)
      shot_line_give(line, k,
                     *(const double *)(const void *)((const char *)&with->kind + n->offset));
}
