/* Shots from words.
 *
 * Right is positive for english here; in the lines, which keep pooltool's format, a > 0 is left. */
#include "shots/shoot_flags.h"

#include "program/program.h"
#include "rows/doubts.h"
#include "rows/number.h"
#include "rows/quantities.h"
#include "shots/places.h"
#include "shots/shot_fault.h"

#include <limits.h>

enum { MOST_TEXT = 1024 };

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

bool with_fits_file(const given_numbers *with) {
  if (with->lists > 0)
    complain("--with: several values of a number are for shots by options, not for a file");
  else if (with->slope[0] != 0.0 || with->slope[1] != 0.0)
    complain("--with: the fit has a slope, which a table of the file takes: slope_x %g, slope_y %g",
             with->slope[0], with->slope[1]);
  else
    return true;
  return false;
}

/* layout_moment */
static bool set_layout(const option_row *row, char *text, void *field) {
  int place;
  if (!set_place(row, text, row->argument, &place))
    return false;
  *(int *)field = (int)LAYOUT_START + place;
  return true;
}

const option_row option_layout = {
    .name = "from",
    .argument = "start|final",
    .help = "with a file of shots: take the balls as they lay before each shot, or its final "
            "states, in which they came to rest",
    .else_usual = "start where carom plays shots again; else a line with final states is an error",
    .set = set_layout,
    .field = offsetof(shared_options, layout)};

layout_moment played_again(const shared_options *shared) {
  return shared->layout == LAYOUT_FINAL ? LAYOUT_FINAL : LAYOUT_START;
}

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

/* Names of the balls of a rack, by carom_rack()'s order. */
static void name_rack(layout *l, carom_rack_kind kind) {
  static const struct {
    carom_rack_kind rack;
    const char *names[4];
  } named[] = {{CAROM_RACK_THREECUSHION, {"white", "yellow", "red"}},
               {CAROM_RACK_FOURBALL, {"white", "yellow", "red1", "red2"}},
               {CAROM_RACK_COWBOY, {"cue", "1", "3", "5"}},
               {CAROM_RACK_BILLIARDS, {"white", "yellow", "red"}}};
  for (size_t n = 0; n < COUNT_OF(named); n++)
    if (named[n].rack == kind) {
      for (int k = 0; k < l->count; k++)
        snprintf(l->name[k], PLACE_NAME, "%s", named[n].names[k]);
      return;
    }
  for (int k = 0; k < l->count; k++)
    if (kind == CAROM_RACK_SNOOKER && k > 15)
      snprintf(l->name[k], PLACE_NAME, "%s", colours_of_snooker[k - 16]);
    else
      snprintf(l->name[k], PLACE_NAME, kind == CAROM_RACK_SNOOKER ? "red%d" : "%d", k);
  snprintf(l->name[0], PLACE_NAME, "%s", kind == CAROM_RACK_SNOOKER ? "white" : "cue");
}

/* Of RAILS; -1: no rail. */
static int rail_of(const char *name) {
  return word_among(RAILS, name, strlen(name));
}

/* The place of a ball of radius R that touches a rail, or with R = 0 of a point of its nose; false
 * where the place is at none. */
static bool place_at_rail(const layout *l, const given_place *request, double R, double place[2]) {
  enum { HEAD, FOOT, LEFT, RIGHT };
  const double width = l->table.width, length = l->table.length;
  const int rail = rail_of(request->touches);
  if (request->touches[0] == '\0' || rail < 0)
    return false;
  if (rail == HEAD || rail == FOOT) {
    place[0] = place_along(&request->x, 0.25 * width);
    place[1] = rail == HEAD ? R : length - R;
    return true;
  }
  place[0] = rail == LEFT ? R : width - R;
  place[1] = place_along(&request->x, 0.125 * length);
  return true;
}

/* A ball that is put on the line of the noses touches the rail. */
static double off_nose(double x, double room, double R) {
  if (x == 0.0)
    return R;
  return x == room ? room - R : x;
}

/* Puts ball k at rest at a place, which may touch one of the first `laid` balls; false after a
 * complaint. */
static bool lay(layout *l, int k, const given_place *request, int laid) {
  const double width = l->table.width, length = l->table.length, R = l->ball[k].kind.radius;
  double place[2] = {off_nose(place_along(&request->x, 0.25 * width), width, R),
                     off_nose(place_along(&request->y, 0.125 * length), length, R)};
  if (!place_at_rail(l, request, R, place) && request->touches[0] != '\0') {
    int neighbor = laid - 1;
    while (neighbor >= 0 && !same_text(l->name[neighbor], request->touches))
      neighbor--;
    if (neighbor < 0 || neighbor == k) {
      char names[NAMES_TEXT] = "";
      for (int ball = 0; ball < laid; ball++)
        snprintf(names + strlen(names), NAMES_TEXT - strlen(names), "%s|", l->name[ball]);
      complain("frozen-%s: it is a rail, " RAILS ", or a ball that lies already: cue, or one that "
               "stands before it; there are %s",
               request->touches, names_there(names));
      return false;
    }
    const carom_shot_ball *ball = &l->ball[neighbor];
    const double apart = R + ball->kind.radius + request->y.x;
    place[0] = ball->state.r[0] + apart * cos(request->x.x * degree);
    place[1] = ball->state.r[1] + apart * sin(request->x.x * degree);
  }
  l->ball[k].state = (carom_ball_state){.r = {place[0], place[1], R}};
  return true;
}

/* The numbers of the balls and the cue in a combination: of --with, and of shoot_flags.own. */
typedef struct chosen_numbers {
  given_numbers every_ball, cue_ball;
} chosen_numbers;

/* The table that an option or the rack says, else that of pool. */
static carom_table_kind table_kind_of(const shoot_flags *f) {
  if (f->table.kind != 0)
    return (carom_table_kind)(f->table.kind - 1);
  if (f->balls.rack > 0)
    return table_of_rack((carom_rack_kind)(f->balls.rack - 1));
  return CAROM_TABLE_POOL_9FT;
}

static void lay_table(const shoot_flags *f, layout *l) {
  const carom_table_kind kind = table_kind_of(f);
  l->table_name = f->table.text != NULL ? f->table.text : carom_table_name(kind);
  const double *slope = f->shared.with.slope;
  if (slope[0] != 0.0 || slope[1] != 0.0) {
    char x[NUMBER_TEXT], y[NUMBER_TEXT];
    snprintf(l->sloped, sizeof l->sloped, "%.100s,slope_x=%s,slope_y=%s", l->table_name,
             number_text(slope[0], x), number_text(slope[1], y));
    l->table_name = l->sloped;
  }
  named_table *t = built_in_table(l->table_name, &(json_fault){{0}});
  l->table = t->table;
  free_table(t);
  l->game = carom_game_of_table(kind);
}

/* The cue ball at its usual place, and the balls of a rack, number `shot` of those that gaps and
 * seeds ask for. */
static void lay_rack(const shoot_flags *f, layout *l, int shot) {
  const carom_rack_kind rack = (carom_rack_kind)(f->balls.rack - 1);
  snprintf(l->name[0], PLACE_NAME, "cue");
  carom_marks marks;
  carom_table_marks(&l->table, &marks);
  l->ball[0].state = (carom_ball_state){.r = {marks.head_spot[0], marks.head_spot[1]}};
  l->count = 1 + f->balls.count;
  if (f->balls.rack == 0)
    return;
  l->count = carom_rack_size(rack);
  carom_rack(rack, &l->table, f->gap.item[shot % f->gap.count].x,
             (uint64_t)f->seed.item[shot / f->gap.count].x, l->ball, CAROM_BALLS_MOST);
  name_rack(l, rack);
}

/* All balls are of one kind, but for what the cue ball has alone. */
static void choose_balls(layout *l, carom_shot_cushion cushion, const chosen_numbers *numbers) {
  carom_ball_kind ball;
  kind_of_game(l->game, cushion, &ball);
  give_ball(&numbers->every_ball, &ball);
  for (int k = 0; k < l->count; k++) {
    l->ball[k].kind = ball;
    if (k == 0)
      give_ball(&numbers->cue_ball, &l->ball[k].kind);
    l->ball[k].state.r[2] = l->ball[k].kind.radius;
  }
}

/* The ball of a rack that has a place beside it, or the cue ball after a complaint. With `opens`
 * the ball in front takes its place in the rack. */
static int take_from_rack(layout *l, const char *name, bool opens) {
  char names[NAMES_TEXT];
  const int ball = ball_named(l, name, strlen(name), names);
  if (ball < 0) {
    complain("--balls: %s is no ball of this rack: %s", name, names_there(names));
    return 0;
  }
  int front = ball;
  for (int k = 1; k < l->count && opens; k++)
    if (l->ball[k].state.r[1] < l->ball[front].state.r[1])
      front = k;
  l->ball[front].state = l->ball[ball].state;
  return ball;
}

/* Puts the balls that have a place there, by their names; false after a complaint. */
static bool lay_balls(const shoot_flags *f, layout *l) {
  char name[PLACE_NAME];
  for (int k = 1; k <= f->balls.count; k++) {
    const given_place *request = &f->balls.place[k - 1];
    int ball = k, laid = k;
    if (request->name[0] != '\0')
      snprintf(name, PLACE_NAME, "%s", request->name);
    else
      snprintf(name, PLACE_NAME, "%d", k);
    if (f->balls.rack > 0) {
      /* the break ball of straight pool, whose rack is that of eight-ball */
      const bool breaks = k == 1 && f->balls.rack == 1 + (int)CAROM_RACK_EIGHTBALL;
      ball = take_from_rack(l, name, breaks);
      laid = l->count;
    }
    if (f->balls.rack == 0)
      memcpy(l->name[ball], name, PLACE_NAME);
    if (ball == 0 || !lay(l, ball, request, laid))
      return false;
  }
  return true;
}

/* The layout with rack number `shot` of those that gaps and seeds ask for; false after a
 * complaint. */
static bool lay_out(const shoot_flags *f, layout *l, carom_shot_cushion cushion,
                    const chosen_numbers *numbers, int shot) {
  lay_table(f, l);
  if (!condition_fits(&numbers->every_ball, l->game))
    return false;
  lay_rack(f, l, shot);
  choose_balls(l, cushion, numbers);

  /* The places given. A cue ball that touches a ball is put there after it. */
  const given_place *cue = f->cue.count > 0 ? &f->cue.place[0] : NULL;
  if (cue != NULL && cue->name[0] != '\0')
    snprintf(l->name[0], PLACE_NAME, "%s", cue->name);
  const bool last = cue != NULL && cue->touches[0] != '\0' && rail_of(cue->touches) < 0;
  if (cue != NULL && !last && !lay(l, 0, cue, 0))
    return false;
  if (!lay_balls(f, l))
    return false;
  return !last || lay(l, 0, cue, l->count);
}

static double tip_of(const value *v, double radius) {
  return v->times == OFFSET ? v->x / radius : v->x;
}

/* What differs between shots, as text. */
static void name_value(char *id, const char *what, const values *list, int k) {
  if (list->count > 1)
    snprintf(id + strlen(id), MOST_TEXT - strlen(id), "%s%s %s", text_if(id[0] != '\0', ", "), what,
             list->item[k].name);
}

/* Gives a cue the speed with which a level one would give its ball `speed`. The ball's speed is in
 * proportion to the cue's. Along x, and by a root, it has the same bits in other languages. */
static void strike_to(double speed, const carom_ball_kind *kind, carom_cue *cue) {
  carom_cue level = *cue;
  carom_motion motion;
  level.speed = 1.0;
  level.theta = 0.0;
  if (carom_strike(&level, kind, &motion) == CAROM_OK)
    cue->speed = speed / sqrt(motion.v[0] * motion.v[0] + motion.v[1] * motion.v[1]);
}

/* Turns a cue so that its ball leaves towards a place; false after a complaint. */
static bool aim_to(const given_place *target, const layout *l, carom_cue *cue) {
  const double *start = l->ball[0].state.r;
  double place[2] = {place_along(&target->x, 0.25 * l->table.width),
                     place_along(&target->y, 0.125 * l->table.length)};
  const bool at_rail = place_at_rail(l, target, 0.0, place);
  const double ahead[2] = {place[0] - start[0], place[1] - start[1]};
  carom_motion motion;
  if ((target->touches[0] != '\0' && !at_rail) || plane_size(ahead) < l->ball[0].kind.radius) {
    complain(
        "--to is a place away from the cue ball: X,Y, or of a rail right,3d, or one that has a "
        "name");
    return false;
  }
  cue->phi = 0.0;
  if (carom_strike(cue, &l->ball[0].kind, &motion) == CAROM_OK)
    cue->phi = (atan2(ahead[1], ahead[0]) - atan2(motion.v[1], motion.v[0])) / degree;
  return true;
}

/* The speeds of the cue, or of the ball where those are given. */
static const values *speeds_of(const shoot_flags *f) {
  return f->ball_speed.count > 0 ? &f->ball_speed : &f->speed;
}

static int directions_of(const shoot_flags *f) {
  if (f->target.count > 0)
    return f->target.count;
  return f->cut.count > 0 ? f->cut.count : f->aim.count;
}

/* Which value of each number a combination has: the speed changes fastest. */
typedef struct combination {
  const values *speeds;
  int speed, tip, rise, way, rack;
  int number[2 * LISTS_MOST]; /* of the lists of --with, then of the own ones */
} combination;

/* List `k` of those of --with and then of the own ones; NULL: there are no more. */
static const number_list *number_list_at(const shoot_flags *f, int k) {
  const given_numbers *with = &f->shared.with;
  if (k < with->lists)
    return &with->list[k];
  return k < with->lists + f->cue_numbers.lists ? &f->cue_numbers.list[k - with->lists] : NULL;
}

/* Takes a place among `count` off the index of a combination. */
static int take(int *index, int count) {
  const int place = *index % count;
  *index /= count;
  return place;
}

static combination combination_at(const shoot_flags *f, int index) {
  combination c = {.speeds = speeds_of(f)};
  c.speed = take(&index, c.speeds->count);
  c.tip = take(&index, f->tip.count);
  c.rise = take(&index, f->elevation.count);
  const number_list *list;
  for (int k = 0; (list = number_list_at(f, k)) != NULL; k++)
    c.number[k] = take(&index, list->count);
  c.way = take(&index, directions_of(f));
  c.rack = index;
  return c;
}

static void numbers_of(const shoot_flags *f, const combination *c, chosen_numbers *chosen) {
  const number_list *list;
  *chosen = (chosen_numbers){f->shared.with, f->cue_numbers};
  for (int k = 0; (list = number_list_at(f, k)) != NULL; k++)
    give_of_list(list, c->number[k],
                 k < f->shared.with.lists ? &chosen->every_ball : &chosen->cue_ball);
}

/* The strike of a combination, towards +x; false after a complaint where there is no such one. */
static bool strike_of(const shoot_flags *f, const layout *l, const combination *c,
                      const chosen_numbers *numbers, carom_cue *cue) {
  const double R = l->ball[0].kind.radius;
  const bool least = isnan(f->elevation.item[c->rise].x);
  carom_motion motion;
  *cue = carom_cue_of(l->game);
  cue->speed = c->speeds->item[c->speed].x;
  cue->phi = 0.0;
  cue->theta = least ? 0.0 : f->elevation.item[c->rise].x;
  give_cue(&numbers->every_ball, cue);
  give_cue(&numbers->cue_ball, cue);
  cue->a = -tip_of(&f->tip.place[c->tip].x, R);
  cue->b = tip_of(&f->tip.place[c->tip].y, R);
  if (!(cue->speed > 0.0)) {
    complain("--%s is above 0", f->ball_speed.count > 0 ? "ball-speed" : "speed");
    return false;
  }
  if (least && f->pocket == NULL) {
    complain("--elevation least needs a pot to aim: give --pocket");
    return false;
  }
  const carom_status status = carom_strike(cue, &l->ball[0].kind, &motion);
  if (status == CAROM_ERROR_MISCUE)
    complain("--tip: it is %.4g R from the centre%s tip slips off beyond %g R",
             hypot(cue->a, cue->b), cue->miscue > 0.0 ? "; this" : ", beside the ball; a chalked",
             cue->miscue > 0.0 ? cue->miscue : TIP_LIMIT);
  else if (status != CAROM_OK)
    complain("no such strike: %s", carom_status_string(status));
  const bool of_ball = f->ball_speed.count > 0 || c->speeds->item[c->speed].times == OF_BALL;
  if (of_ball)
    strike_to(cue->speed, &l->ball[0].kind, cue);
  return status == CAROM_OK;
}

/* Turns the cue as the combination says; false after a complaint. */
static bool aim_of(shoot_flags *f, const layout *l, const carom_shot_options *options,
                   const combination *c, carom_cue *cue) {
  char report[AIMED_TEXT] = "";
  if (f->pocket != NULL) {
    if (isnan(f->elevation.item[c->rise].x))
      cue->theta = (double)NAN;
    if (!aim_at_pocket(f->pocket, f->via, l, options, cue, report))
      return false;
    if (f->written < MOST_SHOTS)
      memcpy(f->aimed[f->written], report, sizeof report);
    return true;
  }
  if (f->target.count > 0)
    return aim_to(&f->target.place[c->way], l, cue);
  if (f->cut.count > 0) {
    const char *at_ball = f->balls.rack > 0 ? l->name[ball_in_front(l->ball, l->count)] : "1";
    if (f->at_ball != NULL)
      at_ball = f->at_ball;
    return aim_at_ball(at_ball, l, options, f->cut.item[c->way].x, cue);
  }
  cue->phi = f->aim.item[c->way].x;
  return true;
}

/* What differs between the shots. */
static void name_shot(const shoot_flags *f, const combination *c, char id[MOST_TEXT]) {
  id[0] = '\0';
  name_value(id, "gap", &f->gap, c->rack % f->gap.count);
  name_value(id, "seed", &f->seed, c->rack / f->gap.count);
  name_value(id, "aim", &f->aim, c->way);
  name_value(id, "cut", &f->cut, c->way);
  if (f->target.count > 1)
    snprintf(id + strlen(id), MOST_TEXT - strlen(id), "%sto %s,%s", text_if(id[0] != '\0', ", "),
             f->target.place[c->way].x.name, f->target.place[c->way].y.name);
  name_value(id, "elevation", &f->elevation, c->rise);
  const number_list *list;
  for (int k = 0; (list = number_list_at(f, k)) != NULL; k++) {
    char name[NUMBER_NAME];
    name_of_list(list, c->number[k], name);
    append(id, MOST_TEXT, ", ", "%s%s",
           text_if(k >= f->shared.with.lists && list->part == CAROM_PART_BALL, "cue ball "), name);
  }
  name_value(id, "speed", c->speeds, c->speed);
  if (f->tip.count > 1)
    snprintf(id + strlen(id), MOST_TEXT - strlen(id), "%stip %s,%s", text_if(id[0] != '\0', ", "),
             f->tip.place[c->tip].x.name, f->tip.place[c->tip].y.name);
}

/* The numbers of a cue by their keys: the stroke, and what is given or not 0 besides. */
static json_t *cue_json(const layout *l, const chosen_numbers *numbers, const carom_cue *cue) {
  const uint64_t set = numbers->every_ball.of_cue | numbers->cue_ball.of_cue;
  const carom_number *n;
  json_t *object = json_object();
  for (int k = 0; (n = carom_number_of(CAROM_PART_CUE, k)) != NULL; k++) {
    double x = 0.0;
    if (n->key[0] != '\0')
      memcpy(&x, (const char *)cue + n->offset, sizeof x);
    const bool of_stroke = n->offset <= (int32_t)offsetof(carom_cue, b);
    if (x != 0.0 || (set >> k & 1) != 0 || of_stroke)
      json_object_set_new(object, n->key, json_short(x + 0.0));
  }
  json_object_set_new(object, "ball", json_string(l->name[0]));
  return object;
}

/* A ball at rest, with the numbers that are given. */
static json_t *ball_json(const layout *l, const chosen_numbers *chosen, int ball) {
  enum { LABEL, X, Y, Z, NUMBERS = 10 };
  const double *r = l->ball[ball].state.r;
  const double state[NUMBERS] = {[X] = r[0], [Y] = r[1], [Z] = r[2]};
  const uint64_t set = chosen->every_ball.of_balls | (ball == 0 ? chosen->cue_ball.of_balls : 0);
  const carom_number *n;
  json_t *params = json_pack("{s: s}", "game", carom_word(CAROM_WORDS_GAME, (int)l->game)),
         *numbers = json_array();
  for (int k = 0; (n = carom_number_of(CAROM_PART_BALL, k)) != NULL; k++) {
    double x;
    memcpy(&x, (const char *)&l->ball[ball].kind + n->offset, sizeof x);
    if ((set >> k & 1) != 0)
      json_object_set_new(params, n->key, json_short(x));
  }
  for (int k = LABEL; k < NUMBERS; k++)
    json_array_append_new(numbers, json_short(state[k]));
  return json_pack("{s: s, s: o, s: o}", "id", l->name[ball], "params", params, "state", numbers);
}

/* The line of a shot, as a file would have it. */
static json_t *line_of(const layout *l, const chosen_numbers *numbers, const char *id,
                       const carom_cue *cue) {
  json_t *balls = json_array();
  for (int k = 0; k < l->count; k++)
    json_array_append_new(balls, ball_json(l, numbers, k));
  return shot_json(json_string(id[0] != '\0' ? id : "shot"), NULL, l->table_name,
                   cue_json(l, numbers, cue), balls);
}

/* One of the combinations; NULL after a complaint. */
static json_t *make_shot(shoot_flags *f, const layout *l, const carom_shot_options *options,
                         const chosen_numbers *numbers, const combination *c) {
  carom_cue cue;
  char id[MOST_TEXT];
  if (!strike_of(f, l, c, numbers, &cue) || !aim_of(f, l, options, c, &cue))
    return NULL;
  name_shot(f, c, id);
  return line_of(l, numbers, id, &cue);
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

/* How many combinations there are, at most `most`; 0 after a complaint where there are more. */
static int combinations_of(const shoot_flags *f, int most) {
  const values *speeds = speeds_of(f);
  /* The product may exceed an int. */
  const number_list *list;
  double total = (double)speeds->count * f->tip.count * f->elevation.count * directions_of(f) *
                 f->gap.count * f->seed.count;
  for (int k = 0; (list = number_list_at(f, k)) != NULL; k++)
    total *= list->count;
  if (total <= most)
    return (int)total;
  if (most == 1)
    complain("these are %.0f layouts, and a plan takes one; `carom shoot --json` writes them as a "
             "file of shots",
             total);
  else
    complain("these are %.0f shots; at most %d are described and drawn at once, and %d with --csv",
             total, MOST_SHOTS, MOST_ROWS);
  return 0;
}

/* Makes `count` combinations. Of several shots, those that cannot be aimed are left out, and only
 * the first of them is complained of. */
static bool make_shots(shoot_flags *f, const carom_shot_options *options, int count, bool quiet,
                       json_t *shots) {
  static layout l;
  static chosen_numbers numbers;
  const bool may_leave_out = f->tries || count > 1;
  const carom_shot_cushion cushion =
      options != NULL ? options->cushion_model : CAROM_SHOT_CUSHION_DEFAULT;
  bool cannot_be_aimed = false;
  l.missed = &cannot_be_aimed;
  l.fell_short = &f->fell_short;
  for (int k = 0; k < count; k++) {
    cannot_be_aimed = f->fell_short = false;
    const combination c = combination_at(f, k);
    numbers_of(f, &c, &numbers);
    if (!lay_out(f, &l, cushion, &numbers, c.rack))
      return false;
    l.quiet = quiet || f->tries || k > f->written;
    json_t *shot = make_shot(f, &l, options, &numbers, &c);
    if (shot == NULL && (!cannot_be_aimed || !may_leave_out))
      return quiet && cannot_be_aimed;
    if (shot != NULL) {
      json_array_append_new(shots, shot);
      f->written++;
    }
  }
  return true;
}

/* The same without a speed that was given: a ball that does not reach its pocket at the default
 * speed gets the least of some others at which it does. */
static bool make_shots_fast_enough(shoot_flags *f, const carom_shot_options *options, int count,
                                   json_t *shots) {
  static const char *const speeds[] = {"2", "3", "4.5", "6.5"};
  f->fell_short = true;
  for (size_t k = 0; k < COUNT_OF(speeds) && f->fell_short; k++) {
    values_default(&f->speed, MEASURE_SPEED, speeds[k]);
    f->written = 0;
    json_array_clear(shots);
    if (!make_shots(f, options, count, true, shots))
      return false;
    if (f->written > 0)
      return true;
  }
  values_default(&f->speed, MEASURE_SPEED, speeds[0]);
  f->written = 0;
  json_array_clear(shots);
  return make_shots(f, options, count, false, shots);
}

json_t *flags_shots(shoot_flags *f, const carom_shot_options *options, int most) {
  const bool any_speed = f->speed.count == 0 && f->ball_speed.count == 0;
  f->written = 0;
  f->left_out = 0;
  if (!options_agree(f))
    return NULL;
  fill_defaults(f);
  if (!racks_are_valid(f))
    return NULL;
  /* A decimal comma was warned of when its list was read. */
  if (f->shared.strict && any_list(f, true))
    return NULL;
  const int count = combinations_of(f, most);
  if (count == 0)
    return NULL;

  json_use_memory();
  json_t *shots = json_array();
  bool good;
  if (any_speed && f->pocket != NULL && !f->tries)
    good = make_shots_fast_enough(f, options, count, shots);
  else
    good = make_shots(f, options, count, false, shots);
  f->left_out = count - f->written;
  f->shared.with.in_lines = true;
  if (good && !f->tries) {
    if (f->written > 0 && f->left_out > 0)
      complain("%d of %d shots are left out: they cannot be aimed", f->left_out, count);
    good = f->written > 0;
  }
  if (good)
    return shots;
  json_decref(shots);
  return NULL;
}

shot_file *flags_open(shoot_flags *f, const carom_shot_options *options, int most) {
  json_t *shots = flags_shots(f, options, most);
  return shots != NULL ? shot_file_of(shots, SHOTS_GIVEN, options->cushion_model) : NULL;
}

shot_file *layout_open(shoot_flags *f, const char *path, const carom_shot_options *options,
                       int most) {
  const bool by_options = has_flags(f);
  if (by_options && path != NULL)
    complain("a file has its own balls: give it, or --cue, --balls and the like");
  else if (!by_options && path == NULL)
    complain("the balls are needed: a file of shots, or --cue 0.6,0.8 --balls 0.5,1.6:0.9,1.2");
  else if (by_options)
    return flags_open(f, options, most);
  else if (with_fits_file(&f->shared.with))
    return shot_file_open(path, options->cushion_model, (layout_moment)f->shared.layout);
  return NULL;
}

/* Whether the balls of two shots are the same ones in the same places. */
static bool same_balls(const shot_line *a, const shot_line *b) {
  if (a->count != b->count || a->cue.ball != b->cue.ball)
    return false;
  for (int k = 0; k < a->count; k++)
    if (memcmp(&a->ball[k], &b->ball[k], sizeof a->ball[k]) != 0)
      return false;
  return true;
}

/* Why a shot cannot be the next stroke after `strokes` others, of which `first` is the first; ""
 * where the reader has complained already, and NULL where it can. */
static const char *stroke_fault(shot_read outcome, const shot_line *shot, const shot_line *first,
                                int strokes, int most, char text[FAULT_TEXT]) {
  if (outcome == SHOT_FAILED)
    return "";
  if (shot->error != NULL)
    return shot->error;
  if (strokes == most) {
    snprintf(text, FAULT_TEXT, "there are more strokes than %d, the most that are read", most);
    return text;
  }
  if (strokes > 0 && !same_balls(shot, first))
    return "the balls must be those of the first shot; `carom shoot` plays layouts that differ";
  return NULL;
}

int strokes_read(shot_file *file, const shared_options *shared, shot_line *line, carom_cue *cues,
                 int most) {
  shot_line next;
  char text[FAULT_TEXT];
  uint64_t warned = 0;
  int strokes = 0;
  while (strokes == 0 || most > 1) {
    const shot_read outcome = shot_file_next_shot(file, &next);
    if (outcome == SHOT_END)
      break;
    if (outcome == SHOT_SHOT)
      shot_numbers(&next, shared, shot_file_name(file), &warned);
    const char *fault = stroke_fault(outcome, &next, line, strokes, most, text);
    if (fault != NULL && fault[0] != '\0')
      complain("%s:%zu: %s", shot_file_name(file), next.number, fault);
    if (fault == NULL)
      cues[strokes++] = next.cue;

    /* The first shot stays as *line. */
    if (fault == NULL && strokes == 1)
      *line = next;
    else if (outcome == SHOT_SHOT)
      shot_line_free(&next);
    if (fault != NULL) {
      if (strokes > 0)
        shot_line_free(line);
      return 0;
    }
  }
  if (strokes == 0)
    complain("%s: there is no shot", shot_file_name(file));
  return strokes;
}
