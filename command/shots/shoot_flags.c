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
    complain("--%s is the name of a table, not a file: --with %.80s takes what `carom calibrate` "
             "or a fit wrote",
             row->name, text);
    return false;
  }
  text = table_spelt(text);
  snprintf(name, sizeof name, "%.*s", (int)strcspn(text, ","), text);
  if (!set_place(row, name, words_of(row->words, true, list), &table->kind))
    return false;
  table->kind++;
  table->text = text;
  named_table *built_in = built_in_table(text, &fault);
  if (built_in == NULL)
    complain("--%s %.80s: %s", row->name, text, fault.text);
  else
    free_table(built_in);
  return built_in != NULL;
}

#define ROW(row, name, member, argument, set, least, ...) \
  OPTION_ROW(shoot_flags, ANY_KIND, row, name, member, argument, set, least, __VA_ARGS__)

const option_row option_table = {
    .name = "table",
    .help = "play one shot on this table, instead of those of a file. x runs across the "
            "table, y along it. Measures change it: 9ft,corner=4.25in,side_cut=104; `carom "
            "models` lists them. 10ft is threecushion, 12ft is snooker. A table of your own "
            "stands in a file of shots",
    .else_usual = "that of the rack, or 9ft",
    .set = set_table,
    .field = offsetof(shoot_flags, table),
    .words = CAROM_WORDS_TABLE};
ROW(option_cue, "cue", cue, "X,Y", set_places, MEASURE_PLACE,
    "place of the cue ball, m, or with a unit: 2,3ft, or 2,3d in diamonds from the left and the "
    "head; or a place: " PLACES
    ". At left,4d, and at corners and sides, the ball touches the rail; at frozen-1,90 "
    "it touches ball 1 in that direction, degrees, and at frozen-1,90,0.5in it lies that far from "
    "it; with a name, white=0.6,0.8",
    .else_usual = "head-spot, or the place in the rack", .is_list = true);
const option_row option_balls = {
    .name = "balls",
    .argument = "X,Y:...",
    .help = "places of the other balls, as in --cue, with colons between them: 0.6,1.5:foot-spot. "
            "Their names are 1, 2, ..., those of their spots of snooker, or given, as in "
            "8=0.6,1.5. A word is a rack, or a game that has one; straight:1=3d,5.5d is a break "
            "ball beside it",
    .set = set_places,
    .field = offsetof(shoot_flags, balls),
    .least = MEASURE_PLACE,
    .words = CAROM_WORDS_RACK};
const option_row option_cue_ball = {
    .name = "cue-ball",
    .argument = "NAME=X,...",
    .help = "numbers of the cue ball alone, as in --with: mass=6.5oz,radius=30mm. Several values "
            "give several shots of `carom shoot`",
    .set = set_numbers,
    .field = offsetof(shoot_flags, cue_numbers),
    .part = CAROM_PART_BALL};
ROW(option_aim, "aim", aim, "DEGREES", set_values, MEASURE_ANGLE,
    "direction of the cue, counterclockwise from +x; 90 is along the table. With side spin the "
    "ball leaves a little beside it, because of squirt",
    .usual = "90", .is_list = true);
ROW(option_to, "to", target, "X,Y", set_places, MEASURE_PLACE,
    "instead of --aim: the cue ball leaves towards this place, because carom corrects for squirt. "
    "The place is written as in --cue, 4d,6d or foot-right; several with colons, 4d,6d:4d,7d. Spin "
    "may bend the path after that");
ROW(option_at_ball, "at-ball", at_ball, "NAME", set_text, 0,
    "aim at this ball instead, so that the cue ball meets it first and at --cut, whatever squirt, "
    "swerve and hops do; an error where no direction does");
ROW(option_pocket, "pocket", pocket, "BALL:POCKET", set_text, 0,
    "aim so that this ball falls into this pocket: 1:foot-left, 1:side-right, or with the id of "
    "the pocket, 1:lt. carom corrects for squirt and throw. It reports the cut, how far the path "
    "of the ball may turn to either jaw, and with which directions and speeds of the cue the ball "
    "falls; or why there is no such aim");
ROW(option_via, "via", via, "BALL|RAIL,...", set_text, 0,
    "with --pocket: the rails and balls on the way, in their order. left: a bank of the ball off "
    "this rail; 2: a combination with ball 2; 2,left: both; head,1: a kick of the cue ball off "
    "this rail at ball 1, the ball of --pocket. Rails are head, foot, left and right");
ROW(option_shot_cut, "cut", cut, "full|three-quarter|half|quarter|thin|DEGREES", set_values,
    MEASURE_CUT,
    "cut angle, as in `carom hit`: above 0 the ball goes to the left. Of a rack, without "
    "--at-ball, the "
    "cue ball meets the ball in front",
    .usual = "0", .else_usual = "only with --at-ball", .is_list = true);
ROW(option_shot_speed, "speed", speed, SPEED_WORDS "|V", set_values, MEASURE_SPEED,
    "speed of the cue just before the strike, m/s, or with a unit: mph, km/h, ft/s, in/s. A "
    "word is the speed of the ball after the strike: " SPEEDS,
    .usual = "2",
    .else_usual = "with --pocket the least of 2, 3, 4.5 and 6.5 with which the ball falls",
    .is_list = true);
ROW(option_ball_speed, "ball-speed", ball_speed, "V", set_values, MEASURE_SPEED,
    "instead of --speed: speed of the cue ball just after the strike of a level cue; a raised cue "
    "strikes as fast as the level one would");
ROW(option_tip, "tip", tip, "RIGHT,ABOVE", set_places, MEASURE_TIP,
    "where the tip touches, from the centre, in radii of the ball, or with a unit: 1,0.5tip, "
    "12mm,0 or 50%,0 of english; or in words: centre, left, right, high, low, low-left, at 0.5 R; "
    "several with colons, or ranges: 0,-0.4:0.4:0.2. Right is positive, as it is for "
    "english everywhere in "
    "this command. Beyond 0.5 R a chalked tip slips off the ball, and carom warns",
    .usual = "0,0.25", .is_list = true);
ROW(option_elevation, "elevation", elevation, "DEGREES", set_values, MEASURE_ELEVATION,
    "elevation of the butt of the cue. `carom shoot --pocket` also takes least: as little as the "
    "stick "
    "needs to clear the cushions and balls behind the cue ball",
    .usual = "0", .is_list = true);
ROW(option_tip_time, "tip-time", cue_numbers, "SECONDS", set_cue_number, 0,
    "how long the tip of a raised cue presses the ball on the slate, at most 0.01: 0.001 for "
    "leather, 0.0008 for hard resin, with which balls jump. -1: no time",
    .else_usual = "0.001");
ROW(option_tip_restitution, "tip-restitution", cue_numbers, "E", set_cue_number, 0,
    "restitution of the tip and the ball, above 0 to 1: the speed of the ball is proportional to 1 "
    "+ E: 0.73 for leather, 0.85 for phenolic resin, 1 in pooltool",
    .else_usual = "0.73");
ROW(option_json, "json", json, NULL, set_flag, 0,
    "print the shot as a line of JSON for a file, instead of playing it. The line has pooltool's "
    "sign: a > 0 is left");

#define GAP_HELP                                                                               \
  "gap between neighbours of a rack, m, or with a unit; 0 is a frozen rack", .usual = "0.1mm", \
                                                                             .is_list = true
#define SEED_HELP                                                                     \
  "seed of the random numbers that move and place the balls of a rack", .usual = "1", \
                                                                        .is_list = true
ROW(option_gap, "gap", gap, "G", set_values, MEASURE_LENGTH, GAP_HELP);
ROW(option_seed, "seed", seed, "N", set_values, MEASURE_NUMBER, SEED_HELP);
/* Where the balls lie once, or a seed is that of the first rack of many. */
static OPTION_SET(set_single) {
  values *list = field;
  if (!set_values(row, text, list))
    return false;
  if (list->count > 1)
    complain("--%s takes one value here, not '%s'; `carom shoot` takes a list", row->name, text);
  return list->count == 1;
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
      {aim && at_ball,
       "--aim is a direction, --at-ball and --cut aim at a ball: give only one of them"},
      {f->pocket != NULL && (aim || at_ball),
       "--pocket says the direction, and so do --aim, --at-ball and --cut: give one of them"},
      {f->target.count > 0 && (aim || at_ball || f->pocket != NULL),
       "--to says the direction, and so do --aim, --at-ball, --cut and --pocket: give one of them"},
      {f->via != NULL && f->pocket == NULL,
       "--via is the way of a ball to its pocket: give --pocket too"},
      {f->speed.count > 0 && f->ball_speed.count > 0,
       "--speed is that of the cue, --ball-speed that of the ball: give only one of them"},
      {(f->gap.count > 0 || f->seed.count > 0) && f->balls.rack == 0,
       "--gap and --seed are of a rack: give --balls nineball or the like; 1=frozen-cue,90,0.5in "
       "is "
       "a ball half an inch from the cue ball"},
      {f->cue.count > 1, "--cue is one place"}};
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
    complain("--gap is 0 to %g m, and --seed a whole number, 1 to %d", GAP_MOST, INT_MAX);
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
