/* The exact limit of one collision by collocation steps, all nodes of a step in a register. plan.h has the steps; batch.c
 * computes many collisions. */
#include "ball_ball/kernels.h"
#include "ball_ball/plan.h"

/* Right-hand sides of a step of a kind, at most. */
static const int evaluations_of[STEP_KINDS] = {
    [EASY] = EASY_NODES * (EASY_MOST + 1),          [FULL] = FULL_NODES * (FULL_MOST + 1),
    [FULL_GRADED] = MOST_NODES * (GRADED_MOST + 1), [STICK] = STICK_NODES * (STICK_MOST + 1),
    [PART] = MOST_NODES * (GRADED_MOST + 1),        [TURN] = MOST_NODES * (TURN_MOST + 1)};

/* From a state that is not easy at first, to the end. Returns the number of right-hand sides evaluated, 0 if it did not get
 * there. */
always int take_steps(const problem *a, course c, vreal inverse, solution *out) {
  int evaluations = 0;
  for (int attempt = 1; attempt <= MOST_ATTEMPTS; attempt++) {
    prediction ahead;
    const enum step_kind kind =
        (enum step_kind)next_kind(a, &c.s, &c.g, c.to_end, inverse, c.so_far.careful, attempt == 1, &ahead);
    vmask last, impossible;
    const vmask accepted = take(kind, a, &ahead, &c, &last, &impossible, out);
    if (impossible)
      return 0;
    evaluations += evaluations_of[kind];
    if (accepted & last)
      return evaluations;
    inverse = inverse_rho_ahead(a, &c.s, &c.g, c.to_end);
  }
  return 0;
}

int KERNEL(carom_collocate)(const float in[IN_COLUMNS], float spin, float tolerance, float out[OUT_COLUMNS]) {
  const problem a = problem_of(in, spin, tolerance);
  const state s = state_of(&a, in);
  const vreal to_end = 1 + a.e;
  const prediction g = predict(&a, &s, to_end);
  const vreal inverse = inverse_rho_ahead(&a, &s, &g, to_end);
  const vmask easy = is_easy(&a, &g, to_end, inverse);
  solution answer;
  if (easy &&
      take_step(EASY_NODES, EASY_MOST, &a, &g, &s, length_to_end(&a, &g, to_end), NULL, v_all(), NULL, &answer) < a.tolerance) {
    put_solution(&answer, out);
    return evaluations_of[EASY];
  }
  const course c = {.s = s, .to_end = to_end, .g = g, .so_far = {.share = 1, .careful = easy}};
  const int evaluations = take_steps(&a, c, inverse, &answer);
  put_solution(&answer, out);
  return evaluations;
}
