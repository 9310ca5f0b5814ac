/* One collocation step of many collisions, one in each lane. plan.h has the steps; batch.c sorts collisions by the step that
 * they need next. The decisions are those of collocate_one.c. */
#include "ball_ball/kernels.h"
#include "ball_ball/plan.h"

_Static_assert(MOVING_STATE + (int)STATE_COLUMNS == MOVING_RESTITUTION, "the columns of a state come first");

static state load_state(carom_moving moving) {
  state s;
  lanes_unrolled for (int c = 0; c < STATE_COLUMNS; c++) s.column[c] = v_load(moving[MOVING_STATE + c]);
  s.restitution = v_less(v_splat(0), v_load(moving[MOVING_RESTITUTION]));
  return s;
}

static void store_state(const state *s, carom_moving moving) {
  lanes_unrolled for (int c = 0; c < STATE_COLUMNS; c++) v_store(moving[MOVING_STATE + c], s->column[c]);
  v_store(moving[MOVING_RESTITUTION], v_select(s->restitution, v_splat(1), v_splat(0)));
}

static state choose_state(vmask m, const state *yes, const state *no) {
  state s;
  lanes_unrolled for (int c = 0; c < STATE_COLUMNS; c++) s.column[c] = v_select(m, yes->column[c], no->column[c]);
  s.restitution = (m & yes->restitution) | (v_not(m) & no->restitution);
  return s;
}

static vreal mark(vmask m, enum step_kind kind, vreal otherwise) {
  return v_select(m, v_splat((float)kind), otherwise);
}

/* What comes next, a step_kind as a number. `fresh`: the state is that at the start, which is not easy. */
apart vreal next_kind(const problem *a, const state *s, vreal to_end, const prediction *g, vreal inverse,
                      const progress *so_far, bool fresh) {
  const prediction ahead = look_ahead(a, s, g, to_end);
  const choice c = choose(a, s, &ahead, to_end, inverse, so_far);
  vreal kind = mark(c.part, PART, v_splat((float)TURN));
  kind = mark(c.stick, STICK, kind);
  kind = mark(c.full, FULL, kind);
  kind = mark(c.full & c.graded, FULL_GRADED, kind);
  return fresh ? kind : mark(v_less(so_far->caution, v_splat(1)) & is_easy(a, g, to_end, inverse), EASY, kind);
}

static void store_kinds(vreal kind, carom_next next) {
  lanes_unrolled for (int k = 0; k < STEP_ENDS; k++) next[k] = v_bits(v_equal(kind, v_splat((float)k)));
}

/* Of the lanes of a register, as many as may be put off. */
enum { PATIENCE = LANES / 8 };

void KERNEL(carom_first_step)(carom_in in, uint32_t good, float spin, float tolerance, carom_out out, carom_next next) {
  const problem a = problem_of(in, spin, tolerance);
  const state s = state_of(&a, in);
  const vreal to_end = 1 + a.e;
  const prediction g = predict(&a, &s, to_end);
  const vreal inverse = inverse_rho_ahead(&a, &s, &g, to_end);
  const vmask easy = v_from_bits(good) & is_easy(&a, &g, to_end, inverse);
  solution answer;
  stretch step;
  begin_step(EASY_NODES, EVEN, &a, &g, &s, length_to_end(&a, &g, to_end), NULL, &step);
  step.f.going = easy;
  for (int i = 0; i < EASY_MOST && v_more(step.f.going, PATIENCE); i++)
    iterate(EASY_NODES, EVEN, &gauss_4, &step);
  const vreal error = end_step(EASY_NODES, EVEN, &step, v_all(), NULL, &answer);
  const vmask solved = easy & v_not(step.f.going) & v_less(error, a.tolerance);
  put_solution(&answer, out);
  memset(next, 0, sizeof(carom_next));
  next[SOLVED] = v_bits(solved);
  if (next[SOLVED] == good)
    return;
  const progress so_far = {.share = v_splat(1), .caution = v_splat(0)};
  store_kinds(mark(solved, SOLVED, mark(easy, EASY, next_kind(&a, &s, to_end, &g, inverse, &so_far, true))), next);
}

void KERNEL(carom_next_step)(enum step_kind kind, int fresh, carom_in in, float spin, float tolerance, carom_moving moving,
                             carom_out out, carom_next next) {
  const problem a = problem_of(in, spin, tolerance);
  const vreal zero = v_splat(0), one = v_splat(1);
  const vmask none = v_not(v_all());
  state s, after;
  progress so_far = {.share = one, .caution = zero};
  vreal attempts = kind == EASY ? zero : one, error, to_end; /* an easy step from the start is not counted */
  if (fresh) {
    s = state_of(&a, in);
    to_end = 1 + a.e;
  } else {
    s = load_state(moving);
    so_far = (progress){.share = v_load(moving[MOVING_SHARE]), .caution = v_load(moving[MOVING_CAUTION])};
    attempts = v_load(moving[MOVING_ATTEMPTS]) + 1;
    to_end = way_to_end(&a, &s);
  }
  prediction g = predict(&a, &s, to_end);
  solution answer;
  vmask last = v_all(), impossible = none;
  if (kind == EASY)
    error = take_easy_step(&a, &g, to_end, &s, &answer);
  else {
    const prediction ahead = look_ahead(&a, &s, &g, to_end);
    if (kind == FULL)
      error = take_full_step(&a, &ahead, to_end, &s, &answer);
    else if (kind == FULL_GRADED)
      error = take_graded_step(&a, &ahead, to_end, &s, &answer);
    else if (kind == STICK)
      error = take_stick_step(&a, &ahead, &s, &answer);
    else if (kind == PART) {
      error = take_part(&a, part_length(&ahead, to_end), &s, &after);
      last = none;
    } else {
      const turn_plan p = plan_turn(&a, &s, &ahead, to_end, &so_far, &last, &impossible);
      error = take_turn_step(&a, &p, last, &s, &after, &answer);
    }
  }
  const vmask accepted = v_less(error, a.tolerance) & v_not(impossible), solved = accepted & last;
  if (kind != PART)
    put_solution(&answer, out);
  memset(next, 0, sizeof(carom_next));
  next[SOLVED] = v_bits(solved);
  if (!v_any(v_not(solved)))
    return;
  if (kind == PART || kind == TURN) {
    const vmask moved_on = accepted & v_not(last);
    const progress refused = after_refusal(&so_far, kind);
    so_far.share = v_select(moved_on, one, refused.share);
    so_far.caution = v_select(moved_on, zero, refused.caution);
    s = choose_state(moved_on, &after, &s);
    to_end = way_to_end(&a, &s);
    g = predict(&a, &s, to_end);
  } else
    so_far = after_refusal(&so_far, kind);
  const vmask spent = v_less_equal(v_splat(MOST_ATTEMPTS), attempts) | impossible;
  const vreal then = next_kind(&a, &s, to_end, &g, inverse_rho_ahead(&a, &s, &g, to_end), &so_far, false);
  store_kinds(mark(solved, SOLVED, mark(spent, REFUSED, then)), next);
  store_state(&s, moving);
  v_store(moving[MOVING_SHARE], so_far.share);
  v_store(moving[MOVING_CAUTION], so_far.caution);
  v_store(moving[MOVING_ATTEMPTS], attempts);
}
