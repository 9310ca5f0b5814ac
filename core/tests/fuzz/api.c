/* The library's collisions, and impacts on cushions, with inputs made of the bytes of a fuzzer
 * (draws.h), options too. Aborts where the contract of a header is broken: a result that is not
 * finite with a status that is not an error, or is with one that is; a batch with other bits than
 * calls; bytes written outside the results; a trace or a derivative that does not fit. Crashes,
 * hangs and undefined behaviour are for the fuzzer and the sanitizers to see. */
#include "ball_ball/kernels.h"
#include "carom_tangent.h"
#include "cushion/list.h"
#include "draws.h"
#include "schema/numbers.h"
#include "shot/sim.h"

static carom_ball make_ball(void) {
  carom_ball b = {.radius = 0.028575};
  vector(b.v, 10, 0);
  vector(b.w, 300, number(-300, 300));
  b.mass = number(0.1, 0.25);
  b.mu_slide = number(0, 0.5);
  return b;
}

enum { ROWS = 40, POINTS = 12, DIRECTIONS = 3 };

/* Twice the energy of a ball at one height. */
static double energy(double mass, double radius, const double v[3], const double w[3]) {
  double sum = 0;
  for (int k = 0; k < 3; k++)
    sum += mass * (v[k] * v[k] + 0.4 * radius * radius * w[k] * w[k]);
  return sum;
}

/* Seeds for derivatives in up to DIRECTIONS directions, and how many: rarely a number that is
 * rejected. */
static int64_t make_seeds(double *seeds, int numbers) {
  const int64_t m = directions(DIRECTIONS);
  memset(seeds, 0, (size_t)numbers * DIRECTIONS * sizeof *seeds);
  for (int k = 0; k < 4; k++) {
    const int place = choice(numbers * DIRECTIONS);
    seeds[place] = number(-1, 1);
  }
  return m;
}

/* The contract of derivatives of one contact: those of a result of n numbers with the status
 * `solved`, of an input
 * and seeds within the range of play if `plays`. */
static void check_tangent(const double *tangent, int n, int64_t m, carom_status status,
                          carom_status solved, bool plays) {
  if (m < 1 || m > CAROM_DIRECTIONS_MOST) {
    if (status >= 0)
      fail("a number of directions is not refused");
    m = 0;
  } else if (status != solved && status != CAROM_ERROR_TANGENT && (plays || status >= 0))
    fail("the status of a derivative is not that of the call");
  else if (status < 0 || plays)
    expect(tangent, (size_t)n * (size_t)m, status >= 0, "a derivative");
  unwritten(tangent + n * m, (size_t)(n * (DIRECTIONS + 1 - m)) * sizeof *tangent,
            "a derivative writes beside its place");
}

/* A row of a batch, among others, is a call: finite where it has a result, of the same bits, with
 * nothing written outside it. A batch whose options are rejected writes no status; the call in
 * single precision is an inner one, and takes all options for good. */
static void check_batch(carom_precision precision, const void *in, const carom_options *o) {
  const bool single = precision == CAROM_F32;
  const size_t row = single ? sizeof(carom_impact_f32) : sizeof(carom_impact),
               result = single ? sizeof(carom_result_f32) : sizeof(carom_result);
  carom_impact rows[ROWS];
  carom_result many[ROWS + 1], out;
  int8_t statuses[ROWS + 1];
  const int n = 1 + choice(ROWS), at = choice(n);
  for (int k = 0; k < n; k++) {
    char *to = (char *)rows + (size_t)k * row;
    memcpy(to, in, row);
    if (k != at && single)
      ((carom_impact_f32 *)to)->a.v[k % 2] += 0.01F * (float)k;
    else if (k != at)
      ((carom_impact *)to)->a.v[k % 2] += 0.01 * k;
  }
  memset(&out, 0xFF, sizeof out); /* NaN, as in rows in error */
  FILL(many);
  FILL(statuses);
  const carom_status status = carom_collide_one(precision, in, o, &out);
  for (int k = 0; k < 12; k++)
    if (isfinite(single ? (double)((float *)&out)[k] : ((double *)&out)[k]) != (status >= 0))
      fail("a call's result does not fit its status");
  const carom_status returned = single
                                    ? carom_collide_batch_f32((carom_impact_f32 *)rows, (size_t)n,
                                                              o, (carom_result_f32 *)many, statuses)
                                    : carom_collide_batch(rows, (size_t)n, o, many, statuses);
  const bool refused = statuses[at] == GUARD;
  if (refused ? returned >= 0 || (!single && status >= 0)
              : statuses[at] != status ||
                    (status >= 0 && memcmp((char *)many + (size_t)at * result, &out, result) != 0))
    fail("a batch differs from a call");
  unwritten((char *)many + (size_t)n * result, result, "a batch writes beside its results");
  UNWRITTEN(statuses, n, "a batch writes beside its statuses");
}

static void two_balls(void) {
  carom_impact in = {
      .a = make_ball(), .b = make_ball(), .mu_ball = number(0, 0.2), .restitution = number(0.5, 1)};
  const double angle = choice(2) == 0 ? 0 : number(-3.2, 3.2);
  in.b.r[0] = isfinite(angle) ? 2 * in.a.radius * sin(angle) : angle;
  in.b.r[1] = isfinite(angle) ? 2 * in.a.radius * cos(angle) : angle;
  if (choice(8) == 0)
    in.a.radius = in.b.radius = number(0.02, 0.04);
  if (choice(30) == 0)
    arbitrary(&in, sizeof in);
  carom_options o = {.solver = (carom_solver)(choice(16) == 0 ? choice(256) - 128 : choice(8) == 0),
                     .slip = (carom_slip)(choice(16) == 0 ? choice(256) - 128 : choice(2)),
                     .steps = choice(16) == 0 ? -choice(3) : 1 + choice(200),
                     .threads = choice(32) == 0 ? choice(5) - 2 : 0,
                     .plain = choice(16) == 0 ? choice(5) - 2 : choice(2)};
  RESERVE(o);
  carom_isa_limit((carom_isa)choice(CAROM_ISA_AVX512 + 1));
  carom_result out;
  const carom_status status = carom_collide(&in, &o, &out);
  expect((double *)&out, 12, status >= 0, "carom_collide");
  if (carom_check(&in, &o, NULL) < 0 && status >= 0)
    fail("carom_check refuses what carom_collide solves");
  /* energy: 1e-5 is what the header allows for errors of the exact solver, of the fastest of the
   * numbers */
  const bool plays = within((double *)&in, sizeof in / sizeof(double), 1e4);
  if (status == CAROM_OK && plays && o.solver == CAROM_SOLVER_EXACT && o.slip == CAROM_SLIP_PAPER) {
    const double R = in.a.radius, before = energy(in.a.mass, R, in.a.v, in.a.w) +
                                           energy(in.b.mass, R, in.b.v, in.b.w);
    if (energy(in.a.mass, R, out.a.v, out.a.w) + energy(in.b.mass, R, out.b.v, out.b.w) >
        before + 1e-4 * (before + energy(fmax(in.a.mass, in.b.mass), R, in.a.v, in.a.w) +
                         energy(fmax(in.a.mass, in.b.mass), R, in.b.v, in.b.w)))
      fail("the energy of two balls rises");
  }
  check_batch(CAROM_F64, &in, &o);
  carom_result seen;
  carom_detail detail;
  if (carom_collide_detail(&in, &o, &seen, &detail) != status ||
      (status >= 0 && memcmp(&seen, &out, sizeof out) != 0))
    fail("carom_collide_detail differs from carom_collide");
  const bool energies = moderate((double *)&in, sizeof in / sizeof(double));
  if (status == CAROM_OK && energies &&
      !(isfinite(detail.normal) && isfinite(detail.work) && isfinite(detail.work_compression)))
    fail("a detail is not finite");
  carom_trace_point points[POINTS];
  const size_t samples = (size_t)choice(POINTS + 1);
  const carom_status traced = carom_trace(&in, &o, samples, points);
  for (size_t k = 0; k < samples && samples >= 2 && energies; k++) {
    expect((double *)&points[k].state, 12, traced >= 0, "carom_trace");
    expect(&points[k].normal, 1, traced >= 0, "the impulse of carom_trace");
  }
  carom_impact_f32 narrow;
  for (int k = 0; k < 26; k++) {
    const double x = ((double *)&in)[k];
    ((float *)&narrow)[k] = fabs(x) <= (double)FLT_MAX || !isfinite(x) ? (float)x : FLT_MAX;
  }
  check_batch(CAROM_F32, &narrow, &o);
  /* derivatives */
  double seeds[26 * DIRECTIONS], tangent[12 * (DIRECTIONS + 1)];
  const int64_t m = make_seeds(seeds, 26);
  int32_t flags = 0;
  FILL(tangent);
  const carom_status derived =
      carom_collide_tangent(&in, &o, m, seeds, tangent, choice(8) == 0 ? NULL : &flags);
  check_tangent(tangent, 12, m, derived, status, plays && within(seeds, 26 * DIRECTIONS, 1e4));
  if ((flags & ~(CAROM_TANGENT_KINK | CAROM_TANGENT_DIFFERENCES)) != 0)
    fail("the flags of carom_collide_tangent");
  /* as spheres in space */
  if (choice(2) == 0)
    in.b.r[2] += number(-0.06, 0.06);
  const carom_status in_space = carom_impact3(&in, &out);
  expect((double *)&out, 12, in_space >= 0, "carom_impact3");
  if (in_space == CAROM_OK && plays) {
    const double R = in.a.radius, S = in.b.radius;
    const double before =
        energy(in.a.mass, R, in.a.v, in.a.w) + energy(in.b.mass, S, in.b.v, in.b.w);
    if (energy(in.a.mass, R, out.a.v, out.a.w) + energy(in.b.mass, S, out.b.v, out.b.w) >
        before * (1 + 1e-9))
      fail("the energy of two spheres rises");
  }
  double rolling[3];
  carom_rolling_velocity(in.a.v, in.a.w, in.a.radius, rolling);
  (void)carom_mu_ball(&in, carom_alciatore());
}

static void cushion(void) {
  carom_cushion_impact in = {.radius = 0.028575, .jaw_radius = number(0, 0.03)};
  vector(in.v, 5, 0);
  vector(in.w, 300, number(-300, 300));
  in.normal[0] = number(-1, 1);
  in.normal[1] = number(-1, 1);
  in.height = choice(4) == 0 ? in.radius : in.radius * number(1.2, 1.45);
  in.mass = number(0.1, 0.25);
  in.mu_slide = number(0, 0.5);
  in.mu_cushion = number(0, 0.5);
  in.restitution = number(0.5, 1);
  if (choice(30) == 0)
    arbitrary(&in, sizeof in);
  int model = 0;
  if (choice(16) == 0)
    model = choice(256) - 128;
  else if (choice(3) == 0)
    model = choice(CAROM_CUSHION_MODEL_COUNT);
  carom_cushion_options o = {.model = (carom_cushion_model)model,
                             .convention = (carom_cushion_convention)choice(2),
                             .law = (carom_cushion_law)choice(2),
                             .steps = choice(16) == 0 ? -choice(3) : 1 + choice(200),
                             .least_step = choice(8) == 0 ? number(0, 0.001) : 0,
                             .plain = choice(2)};
#define DRAW(member, key, unit, low, high, ...) o.member = number(low, high);
  if (choice(8) == 0) {
    CAROM_NUMBERS(CAROM_NO_ROW, DRAW)
  }
#undef DRAW
  RESERVE(o);
  carom_motion out, many[4];
  int8_t statuses[4] = {1, 1, 1, GUARD};
  const carom_status status = carom_cushion(&in, &o, &out);
  expect((double *)&out, 6, status >= 0, "carom_cushion");
  if (carom_cushion_check(&in, &o, NULL) < 0 && status >= 0)
    fail("carom_cushion_check refuses what carom_cushion solves");
  const bool plays = within((double *)&in, sizeof in / sizeof(double), 1e4);
  if (status == CAROM_OK && plays && o.model != CAROM_CUSHION_EULER &&
      o.convention == CAROM_CONVENTION_PAPER &&
      energy(in.mass, in.radius, out.v, out.w) >
          energy(in.mass, in.radius, in.v, in.w) * (1 + 1e-4))
    fail("the energy of a ball at a cushion rises");
  const carom_cushion_impact rows[3] = {in, in, in};
  FILL(many);
  carom_cushion_batch(rows, 3, &o, many, statuses);
  UNWRITTEN(many, 3, "a batch of impacts on a cushion writes beside its results");
  UNWRITTEN(statuses, 3, "a batch of impacts on a cushion writes beside its statuses");
  if (status == CAROM_OK && (statuses[1] != status || memcmp(&many[1], &out, sizeof out) != 0))
    fail("a batch of impacts on a cushion differs from a call");
  carom_cushion_point points[POINTS];
  const size_t samples = (size_t)choice(POINTS + 1);
  const carom_status traced = carom_cushion_trace(&in, &o, samples, points);
  for (size_t k = 0;
       k < samples && samples >= 2 && moderate((double *)&in, sizeof in / sizeof(double)); k++) {
    expect((double *)&points[k].state, 6, traced >= 0, "carom_cushion_trace");
    expect(&points[k].normal, 1, traced >= 0, "the impulse of carom_cushion_trace");
  }
  double seeds[15 * DIRECTIONS], tangent[6 * (DIRECTIONS + 1)];
  const int64_t m = make_seeds(seeds, 15);
  int32_t flags = 0;
  FILL(tangent);
  const carom_status derived =
      carom_cushion_tangent(&in, &o, m, seeds, tangent, choice(8) == 0 ? NULL : &flags);
  check_tangent(tangent, 6, m, derived, status, plays && within(seeds, 15 * DIRECTIONS, 1e4));
  if ((flags & ~(CAROM_TANGENT_KINK | CAROM_TANGENT_EULER | CAROM_TANGENT_DIFFERENCES)) != 0)
    fail("the flags of carom_cushion_tangent");
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  begin(data, size);
  carom_isa_limit(CAROM_ISA_ANY);
  if (choice(3) == 0)
    cushion();
  else
    two_balls();
  return 0;
}
