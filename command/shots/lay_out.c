/* Where the balls lie: the table, a rack, and the places that options name. */
#include "shots/lay_out.h"

#include "program/program.h"
#include "rows/number.h"
#include "rows/quantities.h"

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

bool place_at_rail(const layout *l, const given_place *request, double R, double place[2]) {
  const double width = l->table.width, length = l->table.length;
  const rail_name rail = rail_named(request->touches, strlen(request->touches));
  if (rail == RAIL_NONE)
    return false;
  if (rail == RAIL_HEAD || rail == RAIL_FOOT) {
    place[0] = place_along(&request->x, 0.25 * width);
    place[1] = rail == RAIL_HEAD ? R : length - R;
    return true;
  }
  place[0] = rail == RAIL_LEFT ? R : width - R;
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

/* The table that an option or the rack says, else that of pool. */
static carom_table_kind table_kind_of(const shoot_flags *f) {
  if (f->table.kind != 0)
    return (carom_table_kind)(f->table.kind - 1);
  if (f->balls.rack > 0)
    return table_of_rack((carom_rack_kind)(f->balls.rack - 1));
  return CAROM_TABLE_POOL_9FT;
}

/* Chooses the table, with the slope of a fit; false after a complaint. */
static bool lay_table(const shoot_flags *f, shot_file *file, layout *l) {
  const carom_table_kind kind = table_kind_of(f);
  const char *name =
      f->table.text != NULL ? f->table.text : carom_word(CAROM_WORDS_TABLE, (int)kind);
  const double *slope = f->shared.with.slope;
  char sloped[200];
  if (slope[0] != 0.0 || slope[1] != 0.0) {
    char x[NUMBER_TEXT], y[NUMBER_TEXT];
    snprintf(sloped, sizeof sloped, "%.100s,slope_x=%s,slope_y=%s", name, number_text(slope[0], x),
             number_text(slope[1], y));
    name = sloped;
  }
  json_fault fault;
  l->game = carom_game_of_table(kind);
  l->named = shot_file_table(file, name, &fault);
  if (l->named == NULL)
    complain("--table %.80s: %s", name, fault.text);
  else
    l->table = l->named->table;
  return l->named != NULL;
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
  carom_ball_kind of_game;
  kind_of_game(l->game, cushion, &of_game);
  l->own_numbers = 0;
  for (int k = 0; k < l->count; k++) {
    carom_ball_kind *kind = &l->ball[k].kind;
    *kind = of_game;
    give_ball(&numbers->every_ball, kind);
    if (k == 0)
      give_ball(&numbers->cue_ball, kind);
    l->own_numbers |= numbers_that_differ(kind, &of_game);
    l->ball[k].state.r[2] = kind->radius;
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

bool lay_out(const shoot_flags *f, shot_file *file, carom_shot_cushion cushion,
             const chosen_numbers *numbers, int shot, layout *l) {
  if (!lay_table(f, file, l) || !condition_fits(&numbers->every_ball, l->game))
    return false;
  lay_rack(f, l, shot);
  choose_balls(l, cushion, numbers);

  /* The places given. A cue ball that touches a ball is put there after it. */
  const given_place *cue = f->cue.count > 0 ? &f->cue.place[0] : NULL;
  if (cue != NULL && cue->name[0] != '\0')
    snprintf(l->name[0], PLACE_NAME, "%s", cue->name);
  const bool last = cue != NULL && cue->touches[0] != '\0' &&
                    rail_named(cue->touches, strlen(cue->touches)) == RAIL_NONE;
  if (cue != NULL && !last && !lay(l, 0, cue, 0))
    return false;
  if (!lay_balls(f, l))
    return false;
  return !last || lay(l, 0, cue, l->count);
}
