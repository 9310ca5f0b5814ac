/* What stands for the planner's commands and options in a build without it (-DCAROM_PLAN=OFF), of
 * `carom` and of `carom-lab`: each says that there is no planner. */
#include "game/judge_match.h"
#include "game/position.h"
#include "program/command.h"
#include "program/message.h"
#include "subcommands.h"

#include <stdio.h>

static bool refuse(const char *what) {
  complain("%s: this build has no planner; it was configured with -DCAROM_PLAN=OFF", what);
  return false;
}

static int refuse_command(char **argv) {
  refuse(argv[0]);
  return EXIT_USAGE;
}

#define COMMAND(name)               \
  int name(int argc, char **argv);  \
  int name(int argc, char **argv) { \
    (void)argc;                     \
    return refuse_command(argv);    \
  }
COMMAND(command_plan)
COMMAND(command_ways)
COMMAND(command_break)
COMMAND(command_match)
COMMAND(command_odds)
COMMAND(command_practice)
COMMAND(command_rating)
COMMAND(command_learn)

OPTION_SET(set_leave) {
  (void)row, (void)text, (void)field;
  return refuse("--leave");
}

bool leave_choose(const leave *to, shoot_flags *f, const carom_shot_options *options,
                  char report[LEFT_TEXT]) {
  (void)to, (void)f, (void)options, (void)report;
  return refuse("--leave");
}

bool aim_at_ball(const char *name, const layout *l, const carom_shot_options *options, double cut,
                 carom_cue *cue) {
  (void)name, (void)l, (void)options, (void)cut, (void)cue;
  return refuse("--at-ball, --cut");
}

bool aim_at_pocket(const char *pocket, const char *via, const layout *l,
                   const carom_shot_options *options, carom_cue *cue, char report[AIMED_TEXT]) {
  (void)pocket, (void)via, (void)l, (void)options, (void)cue, (void)report;
  return refuse("--pocket");
}

int rack_of_game(const char *text) {
  (void)text;
  return 0;
}

bool judge_line(const char *line, size_t size, char why[JUDGED_TEXT]) {
  (void)line, (void)size;
  snprintf(why, JUDGED_TEXT, "this build has no planner, which judges matches");
  return false;
}

bool judge_end(char what[JUDGED_TEXT]) {
  what[0] = '\0';
  return false;
}
