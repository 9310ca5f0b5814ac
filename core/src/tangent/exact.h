/* Contacts that are not differentiated by their text: of exact models by the variational
 * equations of their impact, of Euler's steps by differences. text.h includes this file between
 * its headers and its sources.
 *
 * EXACT. An impact is the speed of approach V times a function of the slips over V, of the
 * frictions, e and a parameter of the geometry, the law, lambda: kappa, or the sine of the nose.
 * core/src/contact_law has the derivatives by these eight variables. Everything before and behind
 * is arithmetic.
 *
 * A ball that rolls is taken to continue rolling: by the slip of a ball that rolls and is pressed
 * there is no derivative. A direction that has it slide is flagged as a kink. */

/* A ball whose slip is at most this fraction of its speeds rolls; for derivatives, a rounding
 * error. */
static const real rolls = 1e-12, rounding = 1e-9;

/* A ball that is at the beginning of its path, follow.cpp, changes by 1e-200 in any case. */
static bool changes(const number &x) {
  bool any = false;
  for (int k = 0; k < CLOCK; k++)
    any |= __builtin_fabs(x.d[k]) > 1e-100;
  return any;
}

/* A law, and its derivative by lambda: a law of dual numbers whose first direction is lambda. */
CAROM_APART static void split(const carom_law *by_lambda, ::carom_law *value, ::carom_law *slope) {
  enum { TERMS = sizeof(carom_law) / sizeof(number) };
  static_assert(sizeof(::carom_law) == TERMS * sizeof(real), "a law is numbers only");
  const number *term = (const number *)by_lambda;
  for (int k = 0; k < TERMS; k++) {
    ((real *)value)[k] = term[k].x;
    ((real *)slope)[k] = term[k].d[0];
  }
}

/* The impulses of an impact in the order of carom_impulses, over V. by: the variables of the
 * impact. */
CAROM_APART static carom_status impact(const ::carom_law *law, const ::carom_law *slope,
                                       const number by[CAROM_VARIABLES], int plain, number q[5]) {
  const real slips[4] = {by[0].x, by[1].x, by[2].x, by[3].x};
  unsigned asked = 0;
  for (int k = 0; k < CAROM_VARIABLES; k++)
    asked |= (unsigned)changes(by[k]) << k;
  carom_impact_tangent t;
  const ::carom_status status = ::carom_impact_differentiate(law, slope, slips, plain, asked, &t);
  if (status != ::CAROM_OK)
    return (carom_status)status;
  watched.note.flags |=
      (t.kink ? ::CAROM_TANGENT_KINK : 0) | (t.differences ? ::CAROM_TANGENT_DIFFERENCES : 0);
  watched.note.error = __builtin_fmax(watched.note.error, t.error);
  const real value_of[5] = {t.q.p, t.q.f_x, t.q.f_y, t.q.F_x, t.q.F_y};
  for (int i = 0; i < 5; i++) {
    q[i] = value_of[i];
    for (int k = 0; k < CAROM_VARIABLES; k++)
      if (asked >> k & 1)
        q[i].d += t.d[i][k] * by[k].d;
  }
  return CAROM_OK;
}

/* The same number, with only the first direction. */
static number alone(const number &x) {
  row first = {};
  first[0] = 1;
  return {x.x, first};
}

/* Keeps the spin of a ball that rolls such that it rolls. W: R times the spin. Returns whether
 * it rolls. */
static bool keep_rolling(const number &v_x, const number &v_y, number *W_x, number *W_y) {
  const number slip_x = v_x - *W_y, slip_y = v_y + *W_x, all[4] = {v_x, v_y, *W_x, *W_y};
  real speeds = 0;
  row sizes = {};
  for (int j = 0; j < 4; j++) {
    speeds += __builtin_fabs(all[j].x);
    for (int k = 0; k < CLOCK; k++)
      sizes[k] += __builtin_fabs(all[j].d[k]);
  }
  if (!(__builtin_fabs(slip_x.x) <= rolls * speeds && __builtin_fabs(slip_y.x) <= rolls * speeds))
    return false;
  /* a direction that leaves the roll */
  for (int k = 0; k < CLOCK; k++)
    if (__builtin_fabs(slip_x.d[k]) + __builtin_fabs(slip_y.d[k]) > rounding * sizes[k])
      watched.note.flags |= ::CAROM_TANGENT_KINK;
  *W_x = -v_y;
  *W_y = v_x;
  return true;
}

/* ---- Two balls ---- */

/* To the frame, and to the variables of the impact. */
CAROM_APART static void begin_balls(const carom_impact *in, carom_local *local, carom_reduced *r) {
  const carom_frame frame = carom_frame_of(in);
  *local = carom_to_frame(&frame, in, CAROM_SLIP_PAPER);
  *r = carom_reduce(local);
  /* the slip on the cloth counts of the ball that is pressed */
  bool rolling = !(r->u_z.x > 0);
  if (!rolling) {
    const number v_x = r->j_pressed ? local->v_jx : local->v_ix,
                 v_y = r->j_pressed ? local->v_jy : local->v_iy;
    number *const w_x = r->j_pressed ? &local->w_jx : &local->w_ix, *const w_y = r->j_pressed
                                                                                     ? &local->w_jy
                                                                                     : &local->w_iy;
    number W_x = local->R * *w_x, W_y = local->R * *w_y;
    rolling = keep_rolling(v_x, v_y, &W_x, &W_y);
    *w_x = W_x / local->R;
    *w_y = W_y / local->R;
    *r = carom_reduce(local);
  }
  if (rolling)
    r->d_x = r->d_y = 0;
}

CAROM_APART static void law_of_balls(const carom_reduced *r, ::carom_law *law, ::carom_law *slope) {
  carom_reduced by_kappa = *r;
  by_kappa.kappa = alone(r->kappa);
  const carom_law by_lambda = carom_law_of_balls(&by_kappa);
  split(&by_lambda, law, slope);
}

CAROM_APART static carom_status integrate_balls(const carom_reduced *r, int plain,
                                                carom_integrals *g) {
  const number V = -r->v_n;
  number by[CAROM_VARIABLES] = {r->u_x / V, r->u_z / V, r->d_x / V, r->d_y / V,
                                r->mu_b,    0,          r->e,       r->kappa},
         q[5];
  if (r->u_z.x > 0)
    by[BY_MU_C] = r->mu;
  /* the pressed ball changes with the sign of u_z */
  if (r->u_z.x < 1e-9 * V.x && changes(r->u_z))
    watched.note.flags |= ::CAROM_TANGENT_KINK;
  ::carom_law law, slope;
  law_of_balls(r, &law, &slope);
  const carom_status status = impact(&law, &slope, by, plain, q);
  number *const to[5] = {&g->p, &g->Q_1, &g->Q_2, &g->F_x, &g->F_y};
  for (int k = 0; k < 5 && status == CAROM_OK; k++)
    *to[k] = k == 1 || k == 2 ? -V * q[k] : V * q[k];
  return status;
}

CAROM_APART static void end_balls(const carom_impact *in, const carom_reduced *r,
                                  const carom_integrals *g, carom_local *local, carom_result *out) {
  const carom_frame frame = carom_frame_of(in);
  carom_restore(r, g, local);
  carom_from_frame(&frame, local, out);
}

carom_status carom_collide(const carom_impact *in, const carom_options *opt, carom_result *out) {
  carom_local local;
  carom_reduced r;
  carom_integrals g;
  begin_balls(in, &local, &r);
  if (!(r.v_n < 0.0)) {
    carom_copy_state(in, out);
    return CAROM_SEPARATING;
  }
  const carom_status status = integrate_balls(&r, opt->plain, &g);
  if (status == CAROM_OK)
    end_balls(in, &r, &g, &local, out);
  return status;
}

/* ---- A cushion ---- */

CAROM_APART static void law_of_cushion(const carom_contact *c, ::carom_law *law,
                                       ::carom_law *slope) {
  carom_contact by_sine = *c;
  by_sine.sine = alone(c->sine);
  by_sine.cosine = sqrt((1 - by_sine.sine) * (1 + by_sine.sine));
  const carom_law by_lambda = carom_mathavan_law(&by_sine);
  split(&by_lambda, law, slope);
}

carom_status carom_mathavan(carom_contact *c, int plain) {
  keep_rolling(c->v_x, c->v_y, &c->W_x, &c->W_y);
  const number V = c->v_y;
  number by[CAROM_VARIABLES] = {carom_slip_x(c) / V,
                                carom_slip_t(c) / V,
                                carom_cloth_x(c) / V,
                                carom_cloth_y(c) / V,
                                c->mu_w,
                                c->mu_s,
                                c->e,
                                c->sine};
  number q[5];
  ::carom_law law, slope;
  law_of_cushion(c, &law, &slope);
  const carom_status status = impact(&law, &slope, by, plain, q);
  const carom_impulse all = {
      .P = V * q[0], .f_x = V * q[1], .f_t = V * q[2], .F_x = V * q[3], .F_y = V * q[4]};
  if (status == CAROM_OK)
    carom_push(c, &all);
  return status;
}

/* ---- Euler's steps ---- */

/* A contact by the numbers of which its derivatives are taken: the slips on the cloth represent W_x
 * and W_y, so that the slips of a ball that rolls do not change. */
enum { EULER_INS = 9, EULER_OUTS = 5 };

static ::carom_status euler_at(const real in[EULER_INS], int steps, real least, int64_t most,
                               real out[EULER_OUTS]) {
  ::carom_contact c = {in[0], in[1], in[3] - in[1], in[0] - in[2], in[4],
                       in[5], 0,     in[6],         in[7],         in[8]};
  c.cosine = __builtin_sqrt((1 - c.sine) * (1 + c.sine));
  ::carom_cushion_run run;
  const ::carom_status status = ::carom_cushion_euler(&c, steps, least, 0, most, &run);
  const real motion[EULER_OUTS] = {c.v_x, c.v_y, c.W_x, c.W_y, c.W_z};
  memcpy(out, motion, sizeof motion);
  return status;
}

/* Central differences of order 2 by each number that changes; by a constant that is 0, forward
 * ones. */
carom_status carom_cushion_euler(carom_contact *c, int steps, number least, int, int64_t most,
                                 carom_cushion_run *) {
  keep_rolling(c->v_x, c->v_y, &c->W_x, &c->W_y);
  const number in[EULER_INS] = {
      c->v_x, c->v_y, carom_cloth_x(c), carom_cloth_y(c), c->W_z, c->sine, c->mu_s, c->mu_w, c->e};
  real at[EULER_INS], out[EULER_OUTS];
  for (int k = 0; k < EULER_INS; k++)
    at[k] = in[k].x;
  ::carom_status status = euler_at(at, steps, least.x, most, out);
  number *const to[EULER_OUTS] = {&c->v_x, &c->v_y, &c->W_x, &c->W_y, &c->W_z};
  for (int r = 0; r < EULER_OUTS; r++)
    *to[r] = out[r];
  for (int k = 0; k < EULER_INS && status == ::CAROM_OK; k++) {
    if (!changes(in[k]))
      continue;
    real more[EULER_OUTS], less[EULER_OUTS] = {0};
    const bool constant = k > 4, forward = constant && at[k] == 0;
    real h = 1e-4;
    if (!constant)
      h = 1e-3 * at[1];
    else if (!forward)
      h = __builtin_fmin(1e-4, 0.5 * __builtin_fabs(at[k]));
    const real kept = at[k];
    at[k] = kept + h;
    status = euler_at(at, steps, least.x, most, more);
    at[k] = forward ? 0 : kept - h;
    if (status == ::CAROM_OK)
      status = euler_at(at, steps, least.x, most, less);
    at[k] = kept;
    for (int r = 0; r < EULER_OUTS; r++)
      to[r]->d += (more[r] - less[r]) / (forward ? h : 2 * h) * in[k].d;
  }

  /* steps are counted in integers */
  watched.note.flags |= ::CAROM_TANGENT_EULER | ::CAROM_TANGENT_DIFFERENCES | ::CAROM_TANGENT_KINK;
  return (carom_status)status;
}
