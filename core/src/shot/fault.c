/* What is at fault in a shot that is rejected: of which part, and which of its numbers. */
#include "carom_shot.h"
#include "platform/arithmetic.h"
#include "table/table.h"

#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* The value of element k of a number. */
static double value_of(const carom_number *n, const void *object, int k) {
  const void *value = (const char *)object + n->offset;
  switch (n->type) {
  case CAROM_TYPE_INT32:
    return ((const int32_t *)value)[k];
  case CAROM_TYPE_INT64:
    return (double)((const int64_t *)value)[k];
  case CAROM_TYPE_UINT64:
    return (double)((const uint64_t *)value)[k];
  default:
    return ((const double *)value)[k];
  }
}

/* The status of the numbers that a status is about, combined with others. */
static carom_status status_of_numbers(carom_status status) {
  static const struct {
    carom_status beside_others, of_numbers;
  } rows[] = {
      {CAROM_ERROR_OVERLAP, CAROM_ERROR_POSITION},
      {CAROM_ERROR_OFF_TABLE, CAROM_ERROR_POSITION},
      {CAROM_ERROR_VERTICAL, CAROM_ERROR_VELOCITY},
      {CAROM_ERROR_RADII_DIFFER, CAROM_ERROR_RADIUS},
      {CAROM_ERROR_MASSES_DIFFER, CAROM_ERROR_MASS},
      {CAROM_ERROR_CUE_BALL_OUT, CAROM_ERROR_CUE_BALL},
  };
  for (size_t index = 0; index < sizeof rows / sizeof rows[0]; index++)
    if (rows[index].beside_others == status)
      return rows[index].of_numbers;
  return status;
}

/* Blames the first number of a part that has the status of the fault and is outside its range; or
 * with `within` is in it, so that it is at fault together with others. */
static bool blame(carom_fault *f, carom_part_kind part, int index, const void *object,
                  bool within) {
  carom_status status = f->status;
  if (within)
    status = status_of_numbers(f->status);
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

/* A part of a shot that may be at fault. */
typedef struct suspect {
  carom_part_kind part;
  int index;
  const void *object;
} suspect;

enum { SUSPECTS_MOST = 8 };

/* Lists what occurs once in a shot, and the parts and the ball at the index `index` of the fault,
 * in the order of blame; returns how many there are. */
static int list_suspects(const carom_table *t, const carom_shot_ball *ball, int index,
                         const carom_cue *cue, const carom_shot_options *opt,
                         suspect suspects[SUSPECTS_MOST]) {
  int count = 0;
  if (opt != NULL)
    suspects[count++] = (suspect){CAROM_PART_OPTIONS, 0, opt};
  suspects[count++] = (suspect){CAROM_PART_TABLE, 0, t};

  if (index >= 0 && index < CAROM_RAILS_MOST && index < t->rails)
    suspects[count++] = (suspect){CAROM_PART_RAIL, index, &t->rail[index]};
  if (index >= 0 && index < CAROM_JAWS_MOST && index < t->jaws)
    suspects[count++] = (suspect){CAROM_PART_JAW, index, &t->jaw[index]};
  if (index >= 0 && index < CAROM_POCKETS_MOST && index < t->pockets)
    suspects[count++] = (suspect){CAROM_PART_POCKET, index, &t->pocket[index]};

  if (ball != NULL) {
    suspects[count++] = (suspect){CAROM_PART_BALL, index, &ball->kind};
    suspects[count++] = (suspect){CAROM_PART_STATE, index, &ball->state};
  }
  if (cue != NULL)
    suspects[count++] = (suspect){CAROM_PART_CUE, 0, cue};
  return count;
}

/* Blames a number that is in its range, but invalid together with others: of the cue, or of the
 * ball at the index; if no number of that ball is to blame, the ball itself. */
static void blame_beside_others(carom_fault *f, const carom_shot_ball *ball, int index,
                                const carom_cue *cue) {
  if (cue != NULL && blame(f, CAROM_PART_CUE, 0, cue, true))
    return;
  const bool about_table = f->status == CAROM_ERROR_TABLE || f->status == CAROM_ERROR_NOSE_HEIGHT;
  if (ball == NULL || about_table)
    return;
  if (blame(f, CAROM_PART_STATE, index, &ball->state, true))
    return;
  if (blame(f, CAROM_PART_BALL, index, &ball->kind, true))
    return;
  f->part = (carom_part){CAROM_PART_BALL, index};
}

/* A slope in its range, but too steep for a ball: the greater of its numbers. */
static void blame_slope(carom_fault *f, const carom_table *t) {
  const carom_number *n;
  for (int k = 0; (n = carom_number_of(CAROM_PART_TABLE, k)) != NULL; k++) {
    const double x = value_of(n, t, 0);
    if (n->error == CAROM_ERROR_SLOPE && fabs(x) >= fabs(f->value))
      *f = (carom_fault){f->status, {CAROM_PART_TABLE, 0}, 0, n, x};
  }
}

carom_status carom_shot_fault(const carom_table *t, const carom_shot_ball *balls, int count,
                              const carom_cue *cue, const carom_shot_options *opt,
                              carom_fault *fault, char *text, size_t room) {
  int index;
  if (fault == NULL)
    return CAROM_ERROR_NULL;
  carom_number_range(NULL, text, room); /* no text yet */
  *fault = (carom_fault){.status = carom_shot_check(t, balls, count, cue, opt, &index)};
  if (fault->status >= 0 || fault->status == CAROM_ERROR_NULL)
    return fault->status;

  if (carom_surplus_of(fault->status) != CAROM_PART_NONE) {
    fault->part = (carom_part){carom_surplus_of(fault->status), index};
    return fault->status;
  }

  /* A number outside its range has the range as its text. */
  const carom_shot_ball *ball = NULL;
  if (index >= 0 && index < count)
    ball = &balls[index];
  suspect suspects[SUSPECTS_MOST];
  const int suspect_count = list_suspects(t, ball, index, cue, opt, suspects);
  for (int k = 0; k < suspect_count; k++)
    if (blame(fault, suspects[k].part, suspects[k].index, suspects[k].object, false)) {
      carom_number_range(fault->row, text, room);
      return fault->status;
    }

  /* Among the numbers that depend on others, a ball's have conditions with their own texts. */
  const carom_number *n = NULL;
  if (ball != NULL)
    n = carom_ball_fault(&ball->kind, text, room);
  if (n != NULL)
    *fault = (carom_fault){n->error, {CAROM_PART_BALL, index}, 0, n, value_of(n, &ball->kind, 0)};
  else if (fault->status == CAROM_ERROR_SLOPE)
    blame_slope(fault, t);
  else
    blame_beside_others(fault, ball, index, cue);
  return fault->status;
}
