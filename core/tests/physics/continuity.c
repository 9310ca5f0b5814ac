/* No jump without a law. Layouts of few balls (core/reference/recipes.h); a number of each moves
 * over a wide range in STEPS steps. The states of all balls shortly after are compared, whether the
 * events are the same or not.
 *
 * Each step is halved towards the greater change (core/reference/sweep.h). What remains between two
 * neighbouring doubles is a jump.
 *
 * The first event at which the two shots part gives the jump its kind (core/reference/jumps.c),
 * unless it explains the jump. Every kind that may jump is a row of jumps.txt. Any other is an
 * error, as is a jump beyond the bound of its kind. The size of a jump is its greatest change of a
 * speed, R w too, `shortly` after that event; places may jump as far as that speed goes by then.
 *
 * CAROM_SHOW="tip alone" prints all jumps of a kind. ./test --release has CAROM_TEST_DRAWS=10000,
 * where a row that does not occur is an error too. */
#include "jumps.h"
#include "random.h"
#include "row_file.h"
#include "support.h"
#include "sweep.h"

enum {
  LAYOUTS = 30,
  LAYOUTS_OF_RELEASE = 300,
  LONG = 10000,
  SWEEPS = 3,
  STEPS = 48,
  SHOWN = 30,
  KINDS = 100
};
static const double later = 1.31; /* of the time, where the stop hides what is before it */

/* ---- What was found */

/* A kind of jump. One that is known may jump by `share` of the speed of the cue or of the ball that
 * moves, and by `fixed` m/s, by a law in words. */
static struct {
  char name[JUMP_NAME], law[100];
  double share_most, fixed_most;
  int count, beyond;
  double share, speed, place; /* the greatest */
} found[KINDS];
static int known, kinds, jumps, explained, red;

/* The known kinds: a row of jumps.txt has share, m/s, the name, a colon and the law. */
static void read_kinds(void) {
  open_rows(CAROM_TEST_DATA "/../core/tests/physics/jumps.txt");
  for (; next_line(); kinds++)
    if (sscanf(row_file.line, "%lf %lf %59[^:]: %99[^\n]", &found[kinds].share_most,
               &found[kinds].fixed_most, found[kinds].name, found[kinds].law) != 4)
      reject("a row of jumps.txt has a share, m/s, a name, a colon and a law");
  known = kinds;
}

static void print_layout(const recipe *r) {
  recipe_layout l;
  recipe_lay(r, &l);
  if (r->speed > 0.0)
    printf("    cue: speed %.17g phi %.17g theta %.17g a %.17g b %.17g follow %.17g mass %.17g\n",
           l.cue.speed, l.cue.phi, l.cue.theta, l.cue.a, l.cue.b, l.cue.follow, l.cue.mass);
  for (int k = 0; k < l.count; k++) {
    const carom_ball_state *s = &l.ball[k].state;
    printf("    ball %d: r %.17g %.17g %.17g v %.17g %.17g %.17g w %.17g %.17g %.17g\n", k, s->r[0],
           s->r[1], s->r[2], s->v[0], s->v[1], s->v[2], s->w[0], s->w[1], s->w[2]);
  }
}

static int kind_of(const char *name) {
  for (int k = 0; k < kinds; k++)
    if (strcmp(found[k].name, name) == 0)
      return k;
  ck_assert_int_lt(kinds, KINDS);
  snprintf(found[kinds].name, JUMP_NAME, "%s", name);
  return kinds++;
}

/* Counts a jump between two recipes. */
static void count_jump(const char *name, int layout, const recipe_number *number, const recipe *low,
                       const recipe *high, const played *a, const played *b, double time) {
  const difference d = sweep_size(low, high, time);
  const double V = fmax(low->speed, low->pace), share = d.speed / V;
  const int k = kind_of(name);
  found[k].count++;
  found[k].share = fmax(found[k].share, share);
  found[k].speed = fmax(found[k].speed, d.speed);
  found[k].place = fmax(found[k].place, d.place);
  if (k < known) {
    const double limit = found[k].share_most * V + found[k].fixed_most;
    if (d.speed <= limit && d.place <= limit * SWEEP_SHORTLY + SWEEP_LEAST)
      return;
  }
  found[k].beyond++;
  if (red++ < SHOWN || (getenv("CAROM_SHOW") != NULL && strcmp(getenv("CAROM_SHOW"), name) == 0)) {
    printf("seed %llu, layout %d, %s: %s from %.17g to %.17g: %s: %.1e m/s, %.1e m at %.17g s\n",
           (unsigned long long)test_seed(), layout, low->family, number->name, a->x, b->x, name,
           d.speed, d.place, low->time);
    printf("  table %d; before the jump\n", low->table);
    print_layout(low);
    printf("  behind it\n");
    print_layout(high);
  }
}

/* ---- The search */

static played low, high;

/* Looks at one step. Where the stop of the shot explains its jump, once more with a later stop. */
static void look(recipe *r, const recipe_number *number, int layout, const played *from,
                 const played *to) {
  char name[JUMP_NAME];
  const double time = r->time;
  low = *from;
  high = *to;
  for (int trial = 0; trial < 2 && sweep_halve(r, number, &low, &high); trial++) {
    recipe a = *r, b = *r;
    memcpy((char *)&a + number->offset, &low.x, sizeof low.x);
    memcpy((char *)&b + number->offset, &high.x, sizeof high.x);
    double at = 0.0;
    const verdict is = name_jump(&a, &b, &low, &high, name, &at);
    jumps++;
    explained += is != NAMED;
    if (is == NAMED)
      count_jump(name, layout, number, &a, &b, &low, &high, at);
    if (is != STOPPED)
      break;
    r->time *= later;
    if (!sweep_play(r, number, from->x, &low) || !sweep_play(r, number, to->x, &high))
      break;
  }
  r->time = time;
}

/* Moves one number over its range. Returns how many steps were looked at. */
static int sweep(recipe r, const recipe_number *number, int layout) {
  static played p[2];
  int looked = 0;
  bool good = sweep_play(&r, number, number->low, &p[0]);
  for (int k = 1; k <= STEPS; k++) {
    const double x = number->low + (number->high - number->low) * k / STEPS;
    const bool next = sweep_play(&r, number, x, &p[k % 2]);
    if (good && next) {
      look(&r, number, layout, &p[(k + 1) % 2], &p[k % 2]);
      looked++;
    }
    good = next;
  }
  return looked;
}

static void print_kinds(void) {
  printf("%6s %6s %9s %9s %9s  %s\n", "jumps", "red", "m/s", "of speed", "m", "kind");
  for (int k = 0; k < kinds; k++)
    printf("%6d %6d %9.1e %9.1e %9.1e  %s: %s\n", found[k].count, found[k].beyond, found[k].speed,
           found[k].share, found[k].place, found[k].name, k < known ? found[k].law : "not known");
}

TEST(no_jump_without_a_law) {
  static recipe_number numbers[RECIPE_NUMBERS];
  const int layouts = draws_of_test(LAYOUTS, LAYOUTS_OF_RELEASE);
  int looked = 0;
  read_kinds();
  for (int n = 0; n < layouts; n++) {
    lab_random random = {test_seed() + (uint64_t)n};
    recipe r;
    recipe_make(test_seed(), (uint64_t)n, &r);
    const int count = recipe_numbers(&r, numbers);
    for (int k = 0; k < SWEEPS; k++)
      looked += sweep(r, &numbers[lab_bits(&random) % (uint64_t)count], n);
  }

  printf("%d steps in %d layouts: %d jumps, %d explained by an event\n", looked, layouts, jumps,
         explained);
  print_kinds();
  fflush(stdout);
  ck_assert_int_gt(looked, layouts * SWEEPS * STEPS / 2);
  for (int k = 0; k < known; k++)
    ck_assert_msg(found[k].count > 0 || layouts < LONG, "no jump of %s: take it out of jumps.txt",
                  found[k].name);
  ck_assert_msg(red == 0, "%d jumps of no kind, or beyond what is known of their kind", red);
}
