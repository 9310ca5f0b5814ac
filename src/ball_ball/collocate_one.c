/* The exact limit of one collision by collocation steps, all nodes of a step in a register. plan.h has the steps; batch.c
 * computes many collisions. */
#include "ball_ball/kernels.h"
#include "ball_ball/plan.h"

/* From *s, predicted *g, with `to_end` and `inverse` rho ahead, to the end. Returns the number of right-hand sides evaluated, 0
 * if it did not get there. */
apart int take_steps(const problem *a, state s, prediction g, vreal to_end, vreal inverse, progress so_far, solution *out) {
  int evaluations = 0;
  for (int attempt = 1; attempt <= MOST_ATTEMPTS; attempt++) {
    state next;
    float error;
    int last = 1;
    enum step_kind kind = TURN;
    if (so_far.caution < 1 && attempt > 1 && is_easy(a, &g, to_end, inverse)) {
      error = take_easy_step(a, &g, to_end, &s, out);
      evaluations += EASY_NODES * (EASY_MOST + 1);
      kind = EASY;
    } else {
      const prediction ahead = look_ahead(a, &s, &g, to_end);
      const choice c = choose(a, &s, &ahead, to_end, inverse, &so_far);
      int iterations = TURN_MOST, nodes = MOST_NODES;
      if (c.full) {
        kind = c.graded ? FULL_GRADED : FULL;
        iterations = c.graded ? FULL_GRADED_MOST : FULL_MOST;
        nodes = c.graded ? MOST_NODES : FULL_NODES;
        error = (c.graded ? take_graded_step : take_full_step)(a, &ahead, to_end, &s, out);
      } else if (c.stick) {
        kind = STICK;
        iterations = STICK_MOST;
        nodes = STICK_NODES;
        error = take_stick_step(a, &ahead, &s, out);
      } else if (c.part) {
        kind = PART;
        iterations = PART_MOST;
        error = take_part(a, part_length(&ahead, to_end), &s, &next);
        last = 0;
      } else {
        vmask refused;
        const turn_plan p = plan_turn(a, &s, &ahead, to_end, &so_far, &last, &refused);
        if (refused)
          return 0;
        error = take_turn_step(a, &p, last, &s, &next, out);
      }
      evaluations += nodes * (iterations + 1);
    }
    if (!(error < a->tolerance))
      so_far = after_refusal(&so_far, kind);
    else if (last)
      return evaluations;
    else {
      s = next;
      to_end = way_to_end(a, &s);
      g = predict(a, &s, to_end);
      inverse = inverse_rho_ahead(a, &s, &g, to_end);
      so_far = (progress){.share = 1};
    }
  }
  return 0;
}

int KERNEL(carom_collocate)(const float in[IN_COLUMNS], float spin, float tolerance, float out[OUT_COLUMNS]) {
  const problem a = problem_of(in, spin, tolerance);
  const state s = state_of(&a, in);
  const vreal to_end = 1 + a.e;
  const prediction g = predict(&a, &s, to_end);
  const vreal inverse = inverse_rho_ahead(&a, &s, &g, to_end);
  progress so_far = {.share = 1};
  solution answer;
  if (is_easy(&a, &g, to_end, inverse)) {
    if (take_step(EASY_NODES, EASY_MOST, EVEN, &a, &g, &s, length_to_end(&a, &g, to_end), NULL, 1, NULL, &answer) <
        a.tolerance) {
      put_solution(&answer, out);
      return EASY_NODES * (EASY_MOST + 1);
    }
    so_far.caution = 1;
  }
  const int evaluations = take_steps(&a, s, g, to_end, inverse, so_far, &answer);
  put_solution(&answer, out);
  return evaluations;
}
