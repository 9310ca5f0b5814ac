/* Jumps of whole shots as one number. Each layout of core/reference/recipes.h is a stroke, of which
 * one number moves over a wide range in STEPS steps. The steepest STEEPEST steps are halved
 * (core/reference/sweep.h). What is left between two neighbouring doubles, and is not what an event
 * makes, such as a ball that just falls (core/reference/jumps.h), is a jump. It counts above 1 mm/s
 * or 1 mm, as its states are 5 ms behind the event at which the two shots part. */
#include "continuity.h"
#include "program/message.h"
#include "random.h"
#include "sweep.h"

#include "platform/threads.h"

#include <math.h>
#include <pthread.h>
#include <string.h>

enum { STEPS = 32, STEEPEST = 2, FAMILIES_MOST = 16 };
static const double MOST_SPEED = 1e-3, MOST_PLACE = 1e-3; /* m/s, m */

/* The strokes of a family, and their jumps: all of them, those above 1 mm/s, those above 1 mm. */
typedef struct tally {
  long strokes, jumps, fast, far;
  double speed, place; /* the greatest */
} tally;

/* A run. */
typedef struct continuity {
  uint64_t seed, layouts;
  tally family[FAMILIES_MOST];
} continuity;

/* A step of a number: the shots at its ends, and by how much they differ. */
typedef struct step {
  double low, high, change;
} step;

/* Halves a step, and counts the jump that is left. */
static void look(const recipe *drawn, const recipe_number *number, const step *where, tally *sum) {
  static _Thread_local played low, high;
  char name[JUMP_NAME];
  double time;
  recipe r = *drawn, a = *drawn, b = *drawn;
  if (!sweep_play(&r, number, where->low, &low) || !sweep_play(&r, number, where->high, &high))
    return;
  if (!sweep_halve(&r, number, &low, &high))
    return;
  memcpy((char *)&a + number->offset, &low.x, sizeof low.x);
  memcpy((char *)&b + number->offset, &high.x, sizeof high.x);
  if (name_jump(&a, &b, &low, &high, name, &time) != NAMED)
    return;
  const difference size = sweep_size(&a, &b, time);
  if (!isfinite(size.speed) || !isfinite(size.place))
    return;
  sum->jumps++;
  sum->fast += size.speed > MOST_SPEED;
  sum->far += size.place > MOST_PLACE;
  sum->speed = fmax(sum->speed, size.speed);
  sum->place = fmax(sum->place, size.place);
}

/* The steps of a number, the steepest first. Returns how many of them could be played. */
static int find_steps(const recipe *drawn, const recipe_number *number, step steps[STEPS]) {
  static _Thread_local played p[2];
  recipe r = *drawn;
  int count = 0;
  bool good = sweep_play(&r, number, number->low, &p[0]);
  for (int k = 1; k <= STEPS; k++) {
    const double x = number->low + (number->high - number->low) * k / STEPS;
    const bool next = sweep_play(&r, number, x, &p[k % 2]);
    if (good && next) {
      const step found = {p[(k + 1) % 2].x, x, change_of(&r, &p[0], &p[1])};
      int place = count++;
      for (; place > 0 && found.change > steps[place - 1].change; place--)
        steps[place] = steps[place - 1];
      steps[place] = found;
    }
    good = next;
  }
  return count;
}

/* A thread's layouts; each has its own draws. */
static size_t run_layouts(const void *job, size_t start, size_t end) {
  static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
  static uint64_t done;
  continuity *total = *(continuity *const *)job;
  const int families = recipe_families();
  for (size_t index = start; index < end; index++) {
    const int family = (int)(index % (size_t)families);
    lab_random random = {total->seed + index};
    recipe_number numbers[RECIPE_NUMBERS];
    step steps[STEPS];
    tally sum = {.strokes = 1};
    recipe r;
    recipe_make_of(family, total->seed, index, &r);
    const int count = recipe_numbers(&r, numbers);
    const recipe_number *number = &numbers[lab_whole(&random, 0, count - 1)];
    const int found = find_steps(&r, number, steps);
    for (int k = 0; k < found && k < STEEPEST; k++)
      look(&r, number, &steps[k], &sum);

    pthread_mutex_lock(&lock);
    tally *whole = &total->family[family];
    whole->strokes += sum.strokes;
    whole->jumps += sum.jumps;
    whole->fast += sum.fast;
    whole->far += sum.far;
    whole->speed = fmax(whole->speed, sum.speed);
    whole->place = fmax(whole->place, sum.place);
    progress_show("strokes", (double)++done, (double)total->layouts);
    pthread_mutex_unlock(&lock);
  }
  return end;
}

static void print_row(FILE *out, const char *name, const tally *t) {
  const double thousands = fmax((double)t->strokes, 1.0) / 1000.0;
  fprintf(out, "%-20s %8ld  %6ld  %7.1f  %7.1f  %8.1e  %8.1e\n", name, t->strokes, t->jumps,
          (double)t->fast / thousands, (double)t->far / thousands, t->speed, t->place);
}

void continuity_print(uint64_t seed, uint64_t layouts, int threads, FILE *out) {
  static continuity run;
  run = (continuity){.seed = seed, .layouts = layouts};
  const continuity *job = &run;
  carom_in_threads(run_layouts, &job, (size_t)layouts, threads, 1);
  progress_clear();
  fprintf(out,
          "continuity, %llu strokes drawn with seed %llu; one number of each in %d steps, of which "
          "the steepest %d are halved\n"
          "jumps above 1 mm/s and above 1 mm: for each 1000 strokes, 5 ms after the event\n\n"
          "%-20s %8s  %6s  %7s  %7s  %8s  %8s\n",
          (unsigned long long)layouts, (unsigned long long)seed, STEPS, STEEPEST, "family",
          "strokes", "jumps", "> 1mm/s", "> 1mm", "m/s", "m");
  tally sum = {0};
  for (int family = 0; family < recipe_families(); family++) {
    const tally *t = &run.family[family];
    print_row(out, recipe_family(family), t);
    sum.strokes += t->strokes;
    sum.jumps += t->jumps;
    sum.fast += t->fast;
    sum.far += t->far;
    sum.speed = fmax(sum.speed, t->speed);
    sum.place = fmax(sum.place, t->place);
  }
  print_row(out, "all", &sum);
}
