/* One collocation step of many collisions, one in each lane. plan.h has the steps; batch.c sorts collisions by the step that
 * they need next. The decisions are those of collocate_one.c. */
#include "ball_ball/kernels.h"
#include "ball_ball/plan.h"

#define PASTE_(a, b) a##b
#define PASTE(a, b) PASTE_(a, b)
#define apart static __attribute__((noinline)) /* the inlined text of a step is long */

apart vreal take_easy_step(const problem *a, const prediction *g, vreal to_end, const state *s, vmask going, int patience,
                           solution *out) {
  return end_step(EASY_NODES, EASY_MOST, EVEN, a, g, s, to_end, going, patience, out);
}
apart vreal take_full_step(const problem *a, const prediction *g, vreal to_end, const state *s, solution *out) {
  return end_step(FULL_NODES, FULL_MOST, EVEN, a, g, s, to_end, v_all(), 0, out);
}
apart vreal take_graded_step(const problem *a, const prediction *g, vreal to_end, const state *s, solution *out) {
  return end_step(8, FULL_GRADED_MOST, GRADED, a, g, s, to_end, v_all(), 0, out);
}
apart vreal take_stick_step(const problem *a, const prediction *g, const state *s, solution *out) {
  return stick_step(a, g, s, out);
}
apart vreal take_part(const problem *a, vreal length, const state *s, state *next) {
  const prediction g = predict(a, s, length);
  return impulse_step(8, PART_MOST, GRADED, a, &g, length, NULL, v_all(), 0, v_not(v_all()), s, next, NULL);
}
apart vreal take_turn_step(const problem *a, const turn_plan *p, vmask last, const state *s, state *next, solution *out) {
  const prediction g = predict(a, s, p->length);
  const vreal length = v_select(last, p->length * v_fma(p->mean_f, 1 + p->mean_f, v_splat(1)), p->length);
  return impulse_step(8, TURN_MOST, TURNED, a, &g, length, p, v_all(), 0, last, s, next, out);
}

static state load_state(carom_moving moving) {
  return (state){.u_x = v_load(moving[MOVING_U_X]),
                 .u_z = v_load(moving[MOVING_U_Z]),
                 .d_x = v_load(moving[MOVING_D_X]),
                 .d_y = v_load(moving[MOVING_D_Y]),
                 .v = v_load(moving[MOVING_V]),
                 .K = v_load(moving[MOVING_K]),
                 .K_c = v_load(moving[MOVING_K_C]),
                 .c_0 = v_load(moving[MOVING_C_0]),
                 .z_0 = v_load(moving[MOVING_Z_0]),
                 .J_c = v_load(moving[MOVING_J_C]),
                 .J_z = v_load(moving[MOVING_J_Z]),
                 .I_x = v_load(moving[MOVING_I_X]),
                 .I_y = v_load(moving[MOVING_I_Y]),
                 .restitution = v_less(v_splat(0), v_load(moving[MOVING_RESTITUTION]))};
}

static void store_state(const state *s, carom_moving moving) {
  v_store(moving[MOVING_U_X], s->u_x);
  v_store(moving[MOVING_U_Z], s->u_z);
  v_store(moving[MOVING_D_X], s->d_x);
  v_store(moving[MOVING_D_Y], s->d_y);
  v_store(moving[MOVING_V], s->v);
  v_store(moving[MOVING_K], s->K);
  v_store(moving[MOVING_K_C], s->K_c);
  v_store(moving[MOVING_C_0], s->c_0);
  v_store(moving[MOVING_Z_0], s->z_0);
  v_store(moving[MOVING_J_C], s->J_c);
  v_store(moving[MOVING_J_Z], s->J_z);
  v_store(moving[MOVING_I_X], s->I_x);
  v_store(moving[MOVING_I_Y], s->I_y);
  v_store(moving[MOVING_RESTITUTION], v_select(s->restitution, v_splat(1), v_splat(0)));
}

static state choose_state(vmask m, const state *yes, const state *no) {
  return (state){.u_x = v_select(m, yes->u_x, no->u_x),
                 .u_z = v_select(m, yes->u_z, no->u_z),
                 .d_x = v_select(m, yes->d_x, no->d_x),
                 .d_y = v_select(m, yes->d_y, no->d_y),
                 .v = v_select(m, yes->v, no->v),
                 .K = v_select(m, yes->K, no->K),
                 .K_c = v_select(m, yes->K_c, no->K_c),
                 .c_0 = no->c_0,
                 .z_0 = no->z_0,
                 .J_c = v_select(m, yes->J_c, no->J_c),
                 .J_z = v_select(m, yes->J_z, no->J_z),
                 .I_x = v_select(m, yes->I_x, no->I_x),
                 .I_y = v_select(m, yes->I_y, no->I_y),
                 .restitution = (m & yes->restitution) | (v_not(m) & no->restitution)};
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

void PASTE(carom_first_step_, CAROM_LANES_SUFFIX)(carom_in in, uint32_t good, float spin, float tolerance, carom_out out,
                                                  carom_next next) {
  const problem a = problem_of(in, spin, tolerance);
  const state s = state_of(&a, in);
  const vreal to_end = 1 + a.e;
  const prediction g = predict(&a, &s, to_end);
  const vreal inverse = inverse_rho_ahead(&a, &s, &g, to_end);
  const vmask easy = v_from_bits(good) & is_easy(&a, &g, to_end, inverse);
  solution answer;
  const vreal error = take_easy_step(&a, &g, to_end, &s, easy, PATIENCE, &answer);
  const vmask solved = easy & v_less(error, a.tolerance);
  put_solution(&answer, out);
  memset(next, 0, sizeof(carom_next));
  next[SOLVED] = v_bits(solved);
  if (next[SOLVED] == good)
    return;
  const progress so_far = {.share = v_splat(1), .caution = v_splat(0)};
  store_kinds(mark(solved, SOLVED, mark(easy, EASY, next_kind(&a, &s, to_end, &g, inverse, &so_far, true))), next);
}

void PASTE(carom_next_step_, CAROM_LANES_SUFFIX)(enum step_kind kind, int fresh, carom_in in, float spin, float tolerance,
                                                 carom_moving moving, carom_out out, carom_next next) {
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
    error = take_easy_step(&a, &g, to_end, &s, v_all(), 0, &answer);
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
