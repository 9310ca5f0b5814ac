/* --sequence of `carom plan`: the run-out as one answer. */
#ifndef CAROM_CLI_PLAN_SEQUENCE_H
#define CAROM_CLI_PLAN_SEQUENCE_H

#include "shots/shot_file.h"

#include "carom_coach.h"

#include <stdbool.h>

/* What is asked. */
typedef struct sequence_question {
  bool hand, json;
  int plays; /* run-outs that are played for the chance of the whole */
} sequence_question;

/* Plans the run-out of a request, whose memory is not used, and writes it. Returns what the library
 * refused, or CAROM_OK. */
carom_status plan_sequence(FILE *out, const carom_plan_job *request, const shot_line *line,
                           const sequence_question *question);

/* Draws the run-out that was planned last, with its landing zones; false after a complaint. */
bool plan_sequence_draw(const char *path);

#endif
