/* The shots that options describe: one for each combination of their values.
 *
 * Right is positive for english in the options; in a carom_cue, as in pooltool's format, a > 0 is
 * left. */
#include "shots/given_shots.h"

#include "program/program.h"
#include "rows/doubts.h"
#include "rows/quantities.h"
#include "shots/lay_out.h"

enum { MOST_TEXT = 1024 };

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
    complain("--to: the position is at the cue ball, or touches a ball; give one away from it, as "
             "in 0.6,1.5 or right,3d");
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
    complain("--%s '%s': nothing moves; give a speed above 0",
             f->ball_speed.count > 0 ? "ball-speed" : "speed", c->speeds->item[c->speed].name);
    return false;
  }
  if (least && f->pocket == NULL) {
    complain("--elevation least: there is no pot to aim; give --pocket");
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

/* Makes 0 of -0, whose sign would appear in results: a tip in the centre is not to the right. */
static void drop_signs_of_zeros(carom_cue *cue) {
  const carom_number *n;
  for (int k = 0; (n = carom_number_of(CAROM_PART_CUE, k)) != NULL; k++) {
    double x;
    if (n->type != CAROM_TYPE_DOUBLE)
      continue;
    memcpy(&x, (const char *)cue + n->offset, sizeof x);
    x += 0.0;
    memcpy((char *)cue + n->offset, &x, sizeof x);
  }
}

/* Adds the shot of a layout to those of the file. */
static void add_shot(shot_file *file, const layout *l, const chosen_numbers *numbers,
                     const char *id, const carom_cue *cue) {
  const given_numbers *every_ball = &numbers->every_ball, *cue_ball = &numbers->cue_ball;
  json_t *title = json_string(id[0] != '\0' ? id : "shot");
  shot_line line = {.table = l->named, .count = l->count, .own_numbers = l->own_numbers};
  line.title = copy_text(json_string_value(title));
  line.id = json_dumps(title, JSON_ENCODE_ANY);
  json_decref(title);
  memcpy(line.ball, l->ball, (size_t)l->count * sizeof *l->ball);
  for (int k = 0; k < l->count; k++)
    line.name[k] = copy_text(l->name[k]);
  line.cue = *cue;
  line.cue.ball = 0;
  drop_signs_of_zeros(&line.cue);
  line.given = (given_keys){.by_options = true,
                            .game = l->game,
                            .of_balls = every_ball->of_balls,
                            .of_cue_ball = every_ball->of_balls | cue_ball->of_balls,
                            .of_cue = every_ball->of_cue | cue_ball->of_cue};
  shot_file_add(file, &line);
}

/* Adds one of the combinations to the shots of the file; false after a complaint. */
static bool make_shot(shoot_flags *f, const layout *l, const carom_shot_options *options,
                      const chosen_numbers *numbers, const combination *c, shot_file *file) {
  carom_cue cue;
  char id[MOST_TEXT];
  if (!strike_of(f, l, c, numbers, &cue) || !aim_of(f, l, options, c, &cue))
    return false;
  name_shot(f, c, id);
  add_shot(file, l, numbers, id, &cue);
  return true;
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
    complain("%.0f layouts are given, and a plan takes one; `carom shoot --json` writes them as a "
             "file of shots",
             total);
  else
    complain("%.0f shots are too many; give at most %d to describe and draw, or %d with --csv",
             total, MOST_SHOTS, MOST_ROWS);
  return 0;
}

/* Makes `count` combinations. Of several shots, those that cannot be aimed are left out, and only
 * the first of them is complained of. */
static bool make_shots(shoot_flags *f, const carom_shot_options *options, int count, bool quiet,
                       shot_file *file) {
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
    if (!lay_out(f, file, cushion, &numbers, c.rack, &l))
      return false;
    l.quiet = quiet || f->tries || k > f->written;
    const bool made = make_shot(f, &l, options, &numbers, &c, file);
    if (!made && (!cannot_be_aimed || !may_leave_out))
      return quiet && cannot_be_aimed;
    f->written += made;
  }
  return true;
}

/* The same without a speed that was given: a ball that does not reach its pocket at the default
 * speed gets the least of some others at which it does. */
static bool make_shots_fast_enough(shoot_flags *f, const carom_shot_options *options, int count,
                                   shot_file *file) {
  static const char *const speeds[] = {"2", "3", "4.5", "6.5"};
  f->fell_short = true;
  for (size_t k = 0; k < COUNT_OF(speeds) && f->fell_short; k++) {
    values_default(&f->speed, MEASURE_SPEED, speeds[k]);
    f->written = 0;
    shot_file_clear(file);
    if (!make_shots(f, options, count, true, file))
      return false;
    if (f->written > 0)
      return true;
  }
  values_default(&f->speed, MEASURE_SPEED, speeds[0]);
  f->written = 0;
  shot_file_clear(file);
  return make_shots(f, options, count, false, file);
}

shot_file *flags_open(shoot_flags *f, const carom_shot_options *options, int most) {
  const bool any_speed = f->speed.count == 0 && f->ball_speed.count == 0;
  f->written = 0;
  f->left_out = 0;
  if (!flags_complete(f))
    return NULL;
  const int count = combinations_of(f, most);
  if (count == 0)
    return NULL;

  shot_file *file = shot_file_given(SHOTS_GIVEN);
  bool good;
  if (any_speed && f->pocket != NULL && !f->tries)
    good = make_shots_fast_enough(f, options, count, file);
  else
    good = make_shots(f, options, count, false, file);
  f->left_out = count - f->written;
  f->shared.with.in_lines = true;
  if (good && !f->tries) {
    if (f->written > 0 && f->left_out > 0)
      complain("%d of %d shots are left out: they cannot be aimed", f->left_out, count);
    good = f->written > 0;
  }
  if (good)
    return file;
  shot_file_close(file);
  return NULL;
}
