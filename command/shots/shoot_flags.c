/* The options of a shot: their rows, which of them exclude or need each other, and what they are by
 * default.
 *
 * Right is positive for english here; in the lines, which keep pooltool's format, a > 0 is left. */
#include "shots/shoot_flags.h"

#include "program/program.h"
#include "shots/shot_table.h"

#include <limits.h>

static OPTION_SET(set_table) {
  struct chosen_table *table = field;
  char list[MOST_WORDS], name[MOST_WORDS];
  json_fault fault;
  if (strstr(text, ".json") != NULL) {
    return refuse_value(row, text, "a file, not a table; try --with for a fit or a calibration");
  }
  text = table_spelt(text);
  snprintf(name, sizeof name, "%.*s", (int)strcspn(text, ","), text);
  if (!set_place(row, name, words_of(row->words, true, list), &table->kind))
    return false;
  table->kind++;
  table->text = text;
  named_table *built_in = built_in_table(text, &fault);
  if (built_in == NULL)
    return refuse_value(row, text, "%s", fault.text);
  free_table(built_in);
  return true;
}

#define ROW(row, name, member, argument, set, least, ...) \
  OPTION_ROW(shoot_flags, ANY_KIND, row, name, member, argument, set, least, __VA_ARGS__)

const option_row option_table = {
    .name = "table",
    .help = "the table; x runs across it, y along it. Measures change it, 9ft,corner=4.25in "
            "(`carom models` lists them)",
    .else_usual = "the rack's table, or 9ft",
    .set = set_table,
    .field = offsetof(shoot_flags, table),
    .words = CAROM_WORDS_TABLE,
    .noun = "table"};
ROW(option_cue, "cue", cue, "X,Y", set_places, MEASURE_PLACE,
    "position of the cue ball: 0.6,0.8 in m; 2,3ft; 2,3d, in diamonds from the left and head "
    "rails; left,4d, at a rail; frozen-1,90, touching ball 1 in this direction, degrees, or "
    "frozen-1,90,0.5in, with a gap; or " PLACES ". white=0.6,0.8 names the ball",
    .else_usual = "head-spot, or the rack's", .is_list = true);
const option_row option_balls = {
    .name = "balls",
    .argument = "X,Y:...",
    .help = "positions of the other balls, written as for --cue, with colons between: "
            "0.6,1.5:foot-spot. They are named 1, 2, ..., or after spots of snooker, or as in "
            "8=0.6,1.5. Or a rack, or a game that has one; straight:1=3d,5.5d adds a break ball",
    .set = set_places,
    .field = offsetof(shoot_flags, balls),
    .least = MEASURE_PLACE,
    .words = CAROM_WORDS_RACK,
    .example = "0.8,1.9"};
const option_row option_cue_ball = {
    .name = "cue-ball",
    .argument = "NAME=X,...",
    .help = "parameters of the cue ball only, as for --with: mass=6.5oz,radius=30mm",
    .set = set_numbers,
    .field = offsetof(shoot_flags, cue_numbers),
    .part = CAROM_PART_BALL,
    .is_physics = true,
    .example = "mass=6.5oz"};
ROW(option_aim, "aim", aim, "DEGREES", set_values, MEASURE_ANGLE,
    "direction of the cue, counterclockwise from +x; 90 is along the table", .usual = "90",
    .is_list = true);
ROW(option_to, "to", target, "X,Y", set_places, MEASURE_PLACE,
    "instead of --aim: send the cue ball towards this position, corrected for squirt; several with "
    "colons");
ROW(option_at_ball, "at-ball", at_ball, "NAME", set_text, 0,
    "aim so that the cue ball meets this ball first and at --cut, corrected for squirt, swerve and "
    "hops",
    .example = "1");
ROW(option_pocket, "pocket", pocket, "BALL:POCKET", set_text, 0,
    "aim so that this ball falls into this pocket, corrected for squirt and throw: 1:foot-left, "
    "or with its id, 1:lt. Pockets are head-, side- and foot-left and -right. carom reports "
    "margins, directions and speeds",
    .example = "1:foot-left");
ROW(option_via, "via", via, "BALL|RAIL,...", set_text, 0,
    "with --pocket: the rails and balls on the path, in order. left: a bank off this rail; 2: a "
    "combination with ball 2; 2,left: both; head,1: a kick at ball 1, the ball of --pocket. Rails "
    "are head, foot, left and right",
    .example = "left");
ROW(option_shot_cut, "cut", cut, "full|three-quarter|half|quarter|thin|DEGREES", set_values,
    MEASURE_CUT, "cut angle; above 0 the object ball goes left. In a rack it is the ball in front",
    .usual = "0", .else_usual = "only with --at-ball", .is_list = true);
ROW(option_shot_speed, "speed", speed, SPEED_WORDS "|V", set_values, MEASURE_SPEED,
    "speed of the cue, m/s, mph, km/h, ft/s or in/s; or of the ball after the strike: " SPEEDS,
    .usual = "2", .else_usual = "with --pocket the lowest of 2, 3, 4.5 and 6.5 that pots it",
    .is_list = true);
ROW(option_ball_speed, "ball-speed", ball_speed, "V", set_values, MEASURE_SPEED,
    "instead of --speed: of the cue ball after a level strike");
ROW(option_tip, "tip", tip, "RIGHT,ABOVE", set_places, MEASURE_TIP,
    "where the tip hits the ball, right of and above its centre: radii, or 1,0.5tip, "
    "12mm,0, 50%,0 of english; or centre, left, right, high, low, low-left, at 0.5 R. Several with "
    "colons, or ranges: 0,-0.4:0.4:0.2",
    .usual = "0,0.25", .is_list = true);
ROW(option_elevation, "elevation", elevation, "DEGREES", set_values, MEASURE_ELEVATION,
    "elevation of the butt of the cue", .usual = "0", .is_list = true);
ROW(option_tip_time, "tip-time", cue_numbers, "SECONDS", set_cue_number, 0,
    "how long the tip of a raised cue presses the ball onto the slate, at most 0.01: 0.001 for "
    "leather; 0.0008 for hard resin, which makes balls jump; -1 for no time",
    .else_usual = "0.001", .is_physics = true);
ROW(option_tip_restitution, "tip-restitution", cue_numbers, "E", set_cue_number, 0,
    "restitution of the tip and the ball, above 0 to 1; the ball's speed is proportional to 1 + E. "
    "Leather has 0.73, phenolic resin 0.85, pooltool 1",
    .else_usual = "0.73", .is_physics = true);
ROW(option_json, "json", json, NULL, set_flag, 0,
    "print the shot as a line of JSON, without playing it");

#define GAP_HELP "gap between balls of a rack; 0: frozen", .usual = "0.1mm", .is_list = true
#define SEED_HELP "seed of the gaps and the order of a rack", .usual = "1", .is_list = true
ROW(option_gap, "gap", gap, "G", set_values, MEASURE_LENGTH, GAP_HELP);
ROW(option_seed, "seed", seed, "N", set_values, MEASURE_NUMBER, SEED_HELP);
/* Where the balls lie once, or a seed is that of the first rack of many. */
static OPTION_SET(set_single) {
  values *list = field;
  if (!set_values(row, text, list))
    return false;
  if (list->count == 1)
    return true;
  return refuse_value(row, text, "it takes one value; try %s, or `carom shoot`, which takes a list",
                      list->item[0].name);
}
ROW(option_one_gap, "gap", gap, "G", set_single, MEASURE_LENGTH, GAP_HELP);
ROW(option_one_seed, "seed", seed, "N", set_single, MEASURE_NUMBER, SEED_HELP);

/* Whether one of the lists is given, or looks like a number with a decimal comma. */
static bool any_list(const shoot_flags *f, bool comma) {
  const values *const lists[] = {&f->speed,     &f->ball_speed, &f->aim, &f->cut,
                                 &f->elevation, &f->gap,        &f->seed};
  bool any = false;
  for (size_t k = 0; k < COUNT_OF(lists); k++)
    any |= comma ? lists[k]->comma : lists[k]->count > 0;
  return any;
}

bool has_flags(const shoot_flags *f) {
  return f->table.kind != 0 || f->at_ball != NULL || f->pocket != NULL || f->via != NULL ||
         f->json || f->cue.count > 0 || f->target.count > 0 || f->balls.count > 0 ||
         f->balls.rack > 0 || f->tip.count > 0 || f->cue_numbers.of_balls != 0 ||
         f->cue_numbers.of_cue != 0 || f->cue_numbers.lists > 0 || any_list(f, false);
}

/* Complains of options that exclude or need each other; returns whether there are none. */
static bool options_agree(shoot_flags *f) {
  /* --at-ball may name the ball of --pocket once more */
  const size_t named = f->at_ball != NULL ? strlen(f->at_ball) : 0;
  const bool of_pocket = f->pocket != NULL && named > 0 && f->pocket[named] == ':' &&
                         strncmp(f->pocket, f->at_ball, named) == 0;
  if (of_pocket && f->via == NULL)
    f->at_ball = NULL;
  const bool aim = f->aim.count > 0, at_ball = f->cut.count > 0 || f->at_ball != NULL;
  const struct {
    bool broken;
    const char *why;
  } rules[] = {
      {aim && at_ball, "--aim is a direction, --at-ball and --cut aim at a ball; give one of them"},
      {f->pocket != NULL && (aim || at_ball),
       "--pocket sets the direction, and so do --aim, --at-ball and --cut; give one of them"},
      {f->target.count > 0 && (aim || at_ball || f->pocket != NULL),
       "--to sets the direction, and so do --aim, --at-ball, --cut and --pocket; give one of them"},
      {f->via != NULL && f->pocket == NULL,
       "--via is the path of a ball to its pocket; give --pocket too"},
      {f->speed.count > 0 && f->ball_speed.count > 0,
       "--speed is the cue's speed, --ball-speed the ball's; give one of them"},
      {(f->gap.count > 0 || f->seed.count > 0) && f->balls.rack == 0,
       "--gap and --seed need a rack; give --balls nineball, or 1=frozen-cue,90,0.5in for a ball "
       "half an inch from the cue ball"},
      {f->cue.count > 1, "--cue takes one position; give the other balls with --balls"}};
  for (size_t k = 0; k < COUNT_OF(rules); k++)
    if (rules[k].broken) {
      complain("%s", rules[k].why);
      return false;
    }
  return true;
}

/* Fills in what is not given: carom_cue_of() says the same. */
static void fill_defaults(shoot_flags *f) {
  if (f->at_ball != NULL && f->cut.count == 0)
    fill_usual(f, &option_shot_cut);
  if (f->aim.count == 0 && f->cut.count == 0)
    fill_usual(f, &option_aim);
  if (f->speed.count == 0)
    fill_usual(f, &option_shot_speed);
  if (f->gap.count == 0)
    fill_usual(f, &option_gap);
  if (f->seed.count == 0)
    fill_usual(f, &option_seed);
  if (f->elevation.count == 0)
    fill_usual(f, &option_elevation);
  if (f->tip.count == 0)
    fill_usual(f, &option_tip);
}

static bool gap_is_valid(double gap) {
  return gap >= 0.0 && gap <= GAP_MOST;
}

static bool seed_is_valid(double seed) {
  return seed >= 1.0 && seed <= INT_MAX && seed == floor(seed);
}

/* Whether every gap and seed is in its bounds; false after a complaint. */
static bool racks_are_valid(const shoot_flags *f) {
  bool valid = true;
  for (int k = 0; k < f->gap.count; k++)
    valid &= gap_is_valid(f->gap.item[k].x);
  for (int k = 0; k < f->seed.count; k++)
    valid &= seed_is_valid(f->seed.item[k].x);
  if (!valid)
    complain("--gap or --seed is out of range; give a gap of 0 to %g m, a whole seed of 1 to %d",
             GAP_MOST, INT_MAX);
  return valid;
}

bool flags_complete(shoot_flags *f) {
  if (!options_agree(f))
    return false;
  fill_defaults(f);
  if (!racks_are_valid(f))
    return false;
  /* A decimal comma was warned of when its list was read. */
  return !(f->shared.strict && any_list(f, true));
}
