/* The stick over cushions and balls: of choices, and of aims that leave the elevation to it. */
#include "stick.h"

#include "plan_support.h"

/* The point of a rail, or of the circle of a jaw, at a fraction of it. */
static void point_of_nose(const carom_rail *rail, const carom_jaw *jaw, double share,
                          double point[3]) {
  const double turn = share * 360.0 * per_degree;
  if (rail != NULL) {
    for (int k = 0; k < 2; k++)
      point[k] = rail->p[k] + share * (rail->q[k] - rail->p[k]);
    point[2] = rail->height;
  } else {
    point[0] = jaw->centre[0] + jaw->radius * cos(turn);
    point[1] = jaw->centre[1] + jaw->radius * sin(turn);
    point[2] = jaw->height;
  }
}

/* The least elevation, degrees, of a stick in the cue's direction that is `radius` and more from a
 * point: by halving the distance of the point from the axis. Below 0 for a point that is not below
 * the stick: how far it is from there. */
static double least_over(const carom_cue *c, const double point[3], double radius) {
  const double R = balls[0].kind.radius, f = c->phi * per_degree, *r = balls[0].state.r;
  const double u[2] = {cos(f), sin(f)}, h = point[2] - R;
  const double x = point[0] - r[0] + c->a * R * u[1], y = point[1] - r[1] - c->a * R * u[0];
  const double D = -x * u[0] - y * u[1], L = u[0] * y - u[1] * x;
  const double both = radius + 0.0065 + 0.0055 * D;
  const double off = fmax(fmax(-D, D - 1.47), fabs(L) - both);
  if (off >= 0.0)
    return -off;
  double low = 0.0, high = 90.0;
  for (int k = 0; k < 60; k++) {
    const double theta = 0.5 * (low + high), s = sin(theta * per_degree),
                 t = cos(theta * per_degree), below = c->b * R + D * s - h * t;
    *(copysign(sqrt(below * below + L * L), below) < both ? &low : &high) = theta;
  }
  return high < 1e-9 ? 0.0 : high;
}

/* The same over a point of a nose. */
static double over_nose(const carom_cue *c, const carom_rail *rail, const carom_jaw *jaw,
                        double share) {
  double point[3];
  point_of_nose(rail, jaw, share, point);
  return least_over(c, point, 0.0);
}

/* The same over all points of a nose: the worst of many, and of places next to that, by thirds. */
static double over_points(const carom_cue *c, const carom_rail *rail, const carom_jaw *jaw) {
  enum { POINTS = 1000 };
  double worst = -INFINITY, low = 0.0, high = 0.0;
  for (int k = 0; k <= POINTS; k++) {
    const double least = over_nose(c, rail, jaw, (double)k / POINTS);
    if (least > worst) {
      worst = least;
      low = (rail != NULL ? fmax(k - 1.0, 0.0) : k - 1.0) / POINTS;
      high = (rail != NULL ? fmin(k + 1.0, POINTS) : k + 1.0) / POINTS;
    }
  }
  for (int k = 0; k < 80; k++) {
    const double third = low + (high - low) / 3.0, two = high - (high - low) / 3.0;
    const double at_one = over_nose(c, rail, jaw, third), at_two = over_nose(c, rail, jaw, two);
    if (at_one < at_two)
      low = third;
    else
      high = two;
    worst = fmax(worst, fmax(at_one, at_two));
  }
  return worst;
}

static double least_of_all(const carom_cue *c) {
  double most = 0.0;
  for (int k = 1; k < BALLS; k++)
    if (balls[k].state.label != CAROM_BALL_POCKETED)
      most = fmax(most, least_over(c, balls[k].state.r, balls[k].kind.radius));
  for (int k = 0; k < table.rails; k++)
    most = fmax(most, over_points(c, &table.rail[k], NULL));
  for (int k = 0; k < table.jaws; k++)
    most = fmax(most, over_points(c, NULL, &table.jaw[k]));
  return most;
}

/* What a choice is called is what it does: a safety names no ball and seldom keeps the turn; a ball
 * that is named falls, without errors or in most tries, and then by the kind that is told. */
static void check_name(const carom_plan_stroke *c, const carom_shot *shot) {
  const bool falls = c->ball > 0 && shot->facts->pocket[c->ball] == c->pocket;
  ck_assert(c->kind != CAROM_PLAN_SAFETY || (c->ball < 0 && c->keep < 0.1));
  ck_assert(c->ball <= 0 || c->keep >= 0.5 || falls);
  if (falls)
    ck_assert_int_eq(c->kind, carom_pot_kind(shot, 0, c->ball, c->pocket));
}
/* The kind of a choice is that of the stroke without errors, where the ball falls in it: by its
 * facts. Where most strokes with errors pot nothing, the ball that is named falls in it. The stick
 * is over all balls and noses, also of balls before a cushion and another ball; and no choice is
 * raised more than it has to be: raised by a degree less, the stick touches. */
TEST(kinds_and_sticks) {
  enum { KINDS = CAROM_PLAN_RAIL_FIRST + 1 };
  int of_kind[KINDS] = {0}, raised = 0, seldom = 0;
  for (int k = 0; k < 24; k++) {
    carom_plan_stroke best[5];
    make_layout((uint64_t)k + 1, 10);
    if (k % 2 == 0)
      rules = carom_plan_rules_of(CAROM_RULES_NINEBALL);
    if (k % 3 == 0)
      place_ball(0, 0.4, 0.03);
    if (k % 3 == 1)
      place_ball(7, balls[0].state.r[0] + 0.07, balls[0].state.r[1] - 0.04);
    const int found = plan(false, best, 5);
    for (int n = 0; n < found; n++) {
      const carom_plan_stroke *c = &best[n];
      carom_facts facts;
      carom_brief_event events[64];
      carom_shot shot = {.brief = events, .room = 64, .facts = &facts};
      carom_shoot(&table, balls, BALLS, &c->cue, &shot_options, &shot);
      of_kind[c->kind]++;
      check_name(c, &shot);
      seldom += c->ball > 0 && c->keep < 0.5;
      ck_assert(c->cue.theta >= 0.0 && c->cue.theta <= 60.0);
      const double least = least_of_all(&c->cue);
      ck_assert_msg(c->cue.theta > least - 1e-3 && c->cue.theta < least + 1.0,
                    "layout %d, choice %d: raised by %g, not %g", k, n, c->cue.theta, least);
      raised += c->cue.theta > 5.0;
    }
  }
  for (int kind = 0; kind < KINDS; kind++)
    printf("kind %d: %d\n", kind, of_kind[kind]);
  printf("%d pot in less than half of the strokes\n", seldom);
  ck_assert_msg(raised > 10 && seldom > 3 && of_kind[CAROM_PLAN_POT] > 10 &&
                    of_kind[CAROM_PLAN_BANK] > 0 && of_kind[CAROM_PLAN_KICK] > 0 &&
                    of_kind[CAROM_PLAN_SAFETY] > 10,
                "%d raised, %d seldom, %d banks, %d kicks", raised, seldom,
                of_kind[CAROM_PLAN_BANK], of_kind[CAROM_PLAN_KICK]);
}

/* By a level cue each choice is level, where the stick had to be raised. */
TEST(a_level_cue) {
  int raised = 0;
  for (int k = 0; k < 8; k++) {
    carom_plan_stroke best[5];
    make_layout((uint64_t)k + 1, 10);
    place_ball(0, 0.4, 0.03);
    for (options.level = 0; options.level < 2; options.level++) {
      const int found = plan(false, best, 5);
      ck_assert_int_gt(found, 0);
      for (int n = 0; n < found; n++) {
        raised += best[n].cue.theta > 1.0;
        ck_assert(best[n].cue.theta == 0.0 || !options.level);
      }
    }
    options.level = 0;
  }
  ck_assert_int_gt(raised, 10);
}

/* Whether an elevation is that of the reference in the cue's direction, or next to it, where the
 * reference jumps. */
static bool is_least(double elevation, carom_cue c) {
  bool good = false;
  const double phi = c.phi;
  for (int side = -1; side <= 1; side++) {
    c.phi = phi + 1e-6 * side;
    good |= fabs(elevation - least_of_all(&c)) < 1e-3;
  }
  return good;
}

static void aim(carom_pot *pot, carom_cue *aimed) {
  expect_ok(carom_aim(&table, balls, BALLS, &shot_options, pot, aimed));
}

/* Aims the eight at a pocket with a cue that is left to the stick. Where it falls, the cue is
 * raised by the least elevation that the reference has, or by more where that jumps; and the stroke
 * pots. A level cue and one that is raised as far by the caller keep their elevation, and are told
 * the same; but a very thin cut may slip through the directions that are tried. Returns whether the
 * stroke falls. */
static bool aims_raised(int pocket, carom_cue *c) {
  carom_pot pot = {.ball = 8, .pocket = pocket}, request = pot;
  carom_cue same;
  carom_facts facts;
  carom_shot shot = {.facts = &facts};
  c->theta = (double)NAN;
  aim(&pot, c);
  if (pot.outcome != CAROM_POT_FALLS)
    return false;
  ck_assert(is_least(pot.elevation, *c));
  ck_assert(c->theta >= pot.elevation && c->theta <= 60.0);
  carom_shoot(&table, balls, BALLS, c, &shot_options, &shot);
  ck_assert_int_eq(facts.pocket[8], pocket);
  for (int level = 0; level < 2; level++) {
    same = *c;
    same.theta = level ? 0.0 : c->theta;
    aim(&request, &same);
    ck_assert(same.theta == (level ? 0.0 : c->theta));
    if (!level && request.outcome == CAROM_POT_NO_WAY && fabs(pot.cut) > 80.0)
      continue;
    ck_assert(level || (request.outcome == CAROM_POT_FALLS && fabs(same.phi - c->phi) < 1e-3));
    if (request.outcome == CAROM_POT_FALLS)
      ck_assert(is_least(request.elevation, same));
  }
  return true;
}

/* The stick over noses and jaws at any angle; by a large ball and a high tip its growth counts. */
TEST(noses_under_the_stick) {
  random_source r = {test_seed()};
  int raised = 0;
  for (int k = 0; k < 400; k++) {
    make_stroke(&r, test_seed() + (uint64_t)k);
    carom_table_make(k % 2 ? CAROM_TABLE_SNOOKER : CAROM_TABLE_POOL_9FT, &table);
    const bool large = k % 4 > 1;
    balls[0].kind.radius = random_between(&r, large ? 0.03 : 0.015, large ? 0.035 : 0.03);
    place_ball(0, random_between(&r, 0.05, 0.6), random_between(&r, 0.04, 0.4));
    balls[2].state.label = balls[8].state.label = CAROM_BALL_POCKETED;
    carom_cue stroke = cue;
    stroke.phi = random_between(&r, 3.0, 177.0);
    stroke.a = random_between(&r, -0.6, 0.6);
    stroke.b = large ? random_between(&r, 0.25, 0.5) : random_between(&r, -0.6, 0.5);
    const double least = carom_least_elevation(&table, balls, BALLS, &stroke);
    ck_assert_msg(least > 60.0 || fabs(least - least_of_all(&stroke)) < 1e-4,
                  "raised by %.12g degrees, not %.12g", least, least_of_all(&stroke));
    raised += least > 1.0 && least < 60.0;
  }
  ck_assert_int_gt(raised, 100);
}

/* The elevation where it begins: balls next to a level stick, which they just touch or do not, and
 * the end of the stick over a cushion. Below the middle it jumps there. */
TEST(where_the_stick_begins_to_touch) {
  enum { PLACES = 120, STRIDE = 47 }; /* without a common factor, so that few are all over them */
  int jumps = 0, held = 0;
  for (int n = 0; n < draws_of_test(PLACES / 2, PLACES); n++) {
    const int k = n * STRIDE % PLACES;
    make_layout(1, 2);
    place_ball(8, 0.4, 2.2);
    place_ball(0, 0.62, k % 3 == 0 ? 1.6 : 1.7861 + 1e-5 * k);
    const double R = balls[0].kind.radius, D = 0.1 + 0.002 * k;
    carom_cue stroke = cue;
    stroke.speed = 2.5;
    stroke.a = k % 3 == 0 ? 0.0 : 0.3;
    stroke.b = k % 2 == 0 ? -0.2 : 0.1;
    ck_assert(aims_raised(2, &stroke));
    held += stroke.theta > least_of_all(&stroke) + 0.1;
    if (k % 3 != 0)
      continue;

    /* the cue ball is too far from the head cushion; then a ball next to the stick */
    ck_assert(stroke.theta == 0.0);
    const carom_cue level = stroke;
    for (int inside = 0; inside < 2; inside++) {
      const double f = level.phi * per_degree,
                   L = R + 0.0065 + 0.0055 * D + (inside ? -1e-9 : 1e-9);
      place_ball(2, balls[0].state.r[0] - D * cos(f) - L * sin(f),
                 balls[0].state.r[1] - D * sin(f) + L * cos(f));
      carom_pot pot = {.ball = 8, .pocket = 2};
      stroke = level;
      aim(&pot, &stroke);
      ck_assert(pot.outcome == CAROM_POT_FALLS && stroke.phi == level.phi);
      ck_assert(inside == (pot.elevation > 0.0) || (inside && stroke.b > 0.0));
      jumps += pot.elevation > 0.5;
      ck_assert(aims_raised(2, &stroke));
    }
  }
  printf("%d jumps, held %d times\n", jumps, held);
  ck_assert(jumps > 0 && held > 0);
}

/* A ball that touches the cue ball behind it: a tip far below the middle would need more than 60
 * degrees, which is told with the elevation. */
TEST(no_stick_reaches) {
  make_layout(1, 2);
  place_ball(8, 0.4, 2.2);
  place_ball(0, 0.62, 1.6);
  carom_pot pot = {.ball = 8, .pocket = 2};
  const double R = balls[0].kind.radius;
  for (int k = 0; k < 3; k++) {
    carom_cue stroke = cue;
    stroke.speed = k == 2 ? 8.0 : 2.5;
    stroke.a = 0.0;
    stroke.b = k == 0 ? 0.1 : -0.5;
    ck_assert(aims_raised(2, &stroke));
    place_ball(2, balls[0].state.r[0] - 2.0 * R * cos(stroke.phi * per_degree),
               balls[0].state.r[1] - 2.0 * R * sin(stroke.phi * per_degree));
    stroke.theta = (double)NAN;
    aim(&pot, &stroke);
    const double least = asin((R + 0.0065 + 0.011 * R - stroke.b * R) / (2.0 * R)) / per_degree;
    ck_assert_msg(pot.outcome == (k == 0 ? CAROM_POT_FALLS : CAROM_POT_STICK), "%d: %d", k,
                  pot.outcome);
    ck_assert_double_eq_tol(pot.elevation, least, 1.0);
    place_ball(2, 1.1, 0.2);
  }
}
