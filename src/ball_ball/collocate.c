/* The exact limit by collocation steps: of one collision, all nodes of a step in a register (CAROM_LANES_ONE), or a step of
 * many collisions, one in each lane. plan.h has the steps, and decides for both; batch.c sorts collisions by the step that they
 * need next. */
#include "ball_ball/kernels.h"
#include "ball_ball/plan.h"

#ifdef CAROM_LANES_ONE

/* Right-hand sides of a step of a kind, at most. */
static const int evaluations_of[STEP_KINDS] = {
    [EASY] = EASY_NODES * (EASY_MOST + 1),          [FULL] = FULL_NODES * (FULL_MOST + 1),
    [FULL_GRADED] = MOST_NODES * (GRADED_MOST + 1), [STICK] = STICK_NODES * (STICK_MOST + 1),
    [PART] = MOST_NODES * (GRADED_MOST + 1),        [TURN] = MOST_NODES * (TURN_MOST + 1)};

/* From a state that is not easy at first, to the end. Returns the number of right-hand sides evaluated, 0 if it did not get
 * there. */
always int take_steps(const problem *a, collision c, vreal inverse, solution *out) {
  int evaluations = 0;
  for (int attempt = 1; attempt <= MOST_ATTEMPTS; attempt++) {
    prediction ahead;
    const enum step_kind kind =
        (enum step_kind)next_kind(a, &c.s, &c.g, c.to_end, inverse, c.tried.careful, attempt == 1, &ahead);
    vmask last, impossible;
    const vmask accepted = take_step(kind, a, &ahead, &c, &last, &impossible, out);
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
  if (easy && take_impulse_step(EASY_NODES, EASY_MOST, &a, &g, &s, length_to_end(&a, &g, to_end), NULL, v_all(), NULL,
                                &answer) < a.tolerance) {
    put_solution(&answer, out);
    return evaluations_of[EASY];
  }
  const collision c = {.s = s, .to_end = to_end, .g = g, .tried = {.share = 1, .careful = easy}};
  const int evaluations = take_steps(&a, c, inverse, &answer);
  put_solution(&answer, out);
  return evaluations;
}

#else

_Static_assert(LANE_STATE + (int)STATE_COLUMNS == LANE_RESTITUTION, "the columns of a state come first");

static state load_state(lane_state at) {
  state s;
  lanes_unrolled for (int c = 0; c < STATE_COLUMNS; c++) s.column[c] = v_load(at[LANE_STATE + c]);
  s.restitution = v_less(v_splat(0), v_load(at[LANE_RESTITUTION]));
  return s;
}

static void store_state(const state *s, lane_state at) {
  lanes_unrolled for (int c = 0; c < STATE_COLUMNS; c++) v_store(at[LANE_STATE + c], s->column[c]);
  v_store(at[LANE_RESTITUTION], v_select(s->restitution, v_splat(1), v_splat(0)));
}

static void store_kinds(vreal kind, lanes_by_step next) {
  lanes_unrolled for (int k = 0; k < STEP_ENDS; k++) next[k] = v_bits(v_equal(kind, v_splat((float)k)));
}

/* Of the lanes of a register, as many as may be put off. */
enum { MOST_UNCONVERGED = LANES / 8 };

void KERNEL(carom_first_step)(step_inputs in, uint32_t good, float spin, float tolerance, step_outputs out,
                              lanes_by_step next) {
  const problem a = problem_of(in, spin, tolerance);
  const state s = state_of(&a, in);
  const vreal to_end = 1 + a.e;
  const prediction g = predict(&a, &s, to_end);
  const vreal inverse = inverse_rho_ahead(&a, &s, &g, to_end);
  const vmask easy = v_from_bits(good) & is_easy(&a, &g, to_end, inverse);
  solution answer;
  impulse_step step;
  start_step(EASY_NODES, &a, &g, &s, length_to_end(&a, &g, to_end), NULL, &step);
  step.f.going = easy;
  for (int i = 0; i < EASY_MOST && v_more(step.f.going, MOST_UNCONVERGED); i++)
    iterate_directions(EASY_NODES, false, &gauss_4, &step);
  const vreal error = end_step(EASY_NODES, false, &step, v_all(), NULL, &answer);
  const vmask solved = easy & v_not(step.f.going) & v_less(error, a.tolerance);
  put_solution(&answer, out);
  memset(next, 0, sizeof(lanes_by_step));
  next[SOLVED] = v_bits(solved);
  if (next[SOLVED] == good)
    return;
  prediction ahead;
  const vreal then = next_kind(&a, &s, &g, to_end, inverse, v_not(v_all()), true, &ahead);
  store_kinds(choose_kind(solved, SOLVED, choose_kind(easy, EASY, then)), next);
}

void KERNEL(carom_next_step)(enum step_kind kind, int fresh, step_inputs in, float spin, float tolerance, lane_state at,
                             step_outputs out, lanes_by_step next) {
  const problem a = problem_of(in, spin, tolerance);
  collision c = {.tried = {.share = v_splat(1), .careful = v_not(v_all())}};
  vreal attempts = v_splat(kind == EASY ? 0 : 1); /* an easy step from the start is not counted */
  if (fresh) {
    c.s = state_of(&a, in);
    c.to_end = 1 + a.e;
  } else {
    c.s = load_state(at);
    c.to_end = impulse_to_end(&a, &c.s);
    c.tried.share = v_load(at[LANE_SHARE]);
    c.tried.careful = v_less(v_splat(0), v_load(at[LANE_CAREFUL]));
    attempts = v_load(at[LANE_ATTEMPTS]) + 1;
  }
  c.g = predict(&a, &c.s, c.to_end);
  solution answer;
  vmask last, impossible;
  prediction ahead = kind == EASY ? c.g : predict_ahead(&a, &c.s, &c.g, c.to_end);
  const vmask solved = take_step(kind, &a, &ahead, &c, &last, &impossible, &answer) & last;
  if (kind != PART)
    put_solution(&answer, out);
  memset(next, 0, sizeof(lanes_by_step));
  next[SOLVED] = v_bits(solved);
  if (!v_any(v_not(solved)))
    return;
  const vmask spent = v_less_equal(v_splat(MOST_ATTEMPTS), attempts) | impossible;
  const vreal inverse = inverse_rho_ahead(&a, &c.s, &c.g, c.to_end);
  const vreal then = next_kind(&a, &c.s, &c.g, c.to_end, inverse, c.tried.careful, false, &ahead);
  store_kinds(choose_kind(solved, SOLVED, choose_kind(spent, REFUSED, then)), next);
  store_state(&c.s, at);
  v_store(at[LANE_SHARE], c.tried.share);
  v_store(at[LANE_CAREFUL], v_select(c.tried.careful, v_splat(1), v_splat(0)));
  v_store(at[LANE_ATTEMPTS], attempts);
}

#endif
