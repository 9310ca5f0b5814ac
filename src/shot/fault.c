/* What is at fault in a shot that is refused: of which part, and which of its numbers. */
#include "carom_shot.h"
#include "platform/arithmetic.h"

#include <stdbool.h>

/* The value of element k of a number. */
static double value_of(const carom_number *n, const void *object, int k) {
  const char *at = (const char *)object + n->offset;
  return n->type == CAROM_TYPE_INT32    ? ((const int32_t *)(const void *)at)[k]
         : n->type == CAROM_TYPE_INT64  ? (double)((const int64_t *)(const void *)at)[k]
         : n->type == CAROM_TYPE_UINT64 ? (double)((const uint64_t *)(const void *)at)[k]
                                        : ((const double *)(const void *)at)[k];
}

/* The status of the numbers that a status is about, beside others. */
static carom_status status_of_numbers(carom_status status) {
  const bool place = status == CAROM_ERROR_OVERLAP || status == CAROM_ERROR_OFF_TABLE;
  return place                                 ? CAROM_ERROR_POSITION
         : status == CAROM_ERROR_VERTICAL      ? CAROM_ERROR_VELOCITY
         : status == CAROM_ERROR_RADII_DIFFER  ? CAROM_ERROR_RADIUS
         : status == CAROM_ERROR_MASSES_DIFFER ? CAROM_ERROR_MASS
         : status == CAROM_ERROR_CUE_BALL_OUT  ? CAROM_ERROR_CUE_BALL
                                               : status;
}

/* Blames the first number of a part that has the status of the fault and is outside its range; or
 * with `within` is in it, so that it is at fault beside others. */
static bool blame(carom_fault *f, carom_part_kind part, int index, const void *object,
                  bool within) {
  const carom_status status = within ? status_of_numbers(f->status) : f->status;
  const carom_number *n;
  for (int k = 0; (n = carom_number_of(part, k)) != NULL; k++)
    for (int j = 0; j < n->count && n->error == status; j++) {
      const double x = value_of(n, object, j);
      if (within != ((x >= n->low && x <= n->high) || x == n->other))
        continue;
      *f = (carom_fault){f->status, {part, index}, within && n->count > 1 ? -1 : j, n, x};
      return true;
    }
  return false;
}

carom_status carom_shot_fault(const carom_table *t, const carom_shot_ball *balls, int count,
                              const carom_cue *cue, const carom_shot_options *opt,
                              carom_fault *fault, char *text, size_t room) {
  int at;
  if (fault == NULL)
    return CAROM_ERROR_NULL;
  carom_number_range(NULL, text, room); /* no text yet */
  *fault = (carom_fault){.status = carom_shot_check(t, balls, count, cue, opt, &at)};
  if (fault->status >= 0 || fault->status == CAROM_ERROR_NULL)
    return fault->status;

  /* a number outside its range: of what comes once, and of the part or the ball at the place */
  const bool rail = at >= 0 && at < CAROM_RAILS_MOST && at < t->rails,
             jaw = at >= 0 && at < CAROM_JAWS_MOST && at < t->jaws,
             pocket = at >= 0 && at < CAROM_POCKETS_MOST && at < t->pockets,
             ball = at >= 0 && at < count;
  if ((opt != NULL && blame(fault, CAROM_PART_OPTIONS, 0, opt, false)) ||
      blame(fault, CAROM_PART_TABLE, 0, t, false) ||
      (rail && blame(fault, CAROM_PART_RAIL, at, &t->rail[at], false)) ||
      (jaw && blame(fault, CAROM_PART_JAW, at, &t->jaw[at], false)) ||
      (pocket && blame(fault, CAROM_PART_POCKET, at, &t->pocket[at], false)) ||
      (ball && blame(fault, CAROM_PART_BALL, at, &balls[at].kind, false)) ||
      (ball && blame(fault, CAROM_PART_STATE, at, &balls[at].state, false)) ||
      (cue != NULL && blame(fault, CAROM_PART_CUE, 0, cue, false))) {
    carom_number_range(fault->row, text, room);
    return fault->status;
  }

  /* one beside others: of a ball, whose conditions have texts, of the cue, or of a state */
  const carom_number *n = ball ? carom_ball_fault(&balls[at].kind, text, room) : NULL;
  if (n != NULL)
    *fault = (carom_fault){n->error, {CAROM_PART_BALL, at}, 0, n, value_of(n, &balls[at].kind, 0)};
  else if (!(cue != NULL && blame(fault, CAROM_PART_CUE, 0, cue, true)) && ball &&
           fault->status != CAROM_ERROR_TABLE && fault->status != CAROM_ERROR_NOSE_HEIGHT &&
           !blame(fault, CAROM_PART_STATE, at, &balls[at].state, true) &&
           !blame(fault, CAROM_PART_BALL, at, &balls[at].kind, true))
    fault->part = (carom_part){CAROM_PART_BALL, at};
  return fault->status;
}
