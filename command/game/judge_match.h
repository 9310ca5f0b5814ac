/* The lines of a match, judged by its rules. without_plan.c refuses where there is no planner. */
#ifndef CAROM_CLI_GAME_JUDGE_MATCH_H
#define CAROM_CLI_GAME_JUDGE_MATCH_H

#include <stdbool.h>
#include <stddef.h>

enum { JUDGED_TEXT = 300 };

/* Judges one more line, in their order. False where it is not by the rules: *why becomes the line
 * and the rule. */
bool judge_line(const char *line, size_t size, char why[JUDGED_TEXT]);

/* What the lines came to, such as "player 1 has won". False where a line is missing. */
bool judge_end(char what[JUDGED_TEXT]);

#endif
