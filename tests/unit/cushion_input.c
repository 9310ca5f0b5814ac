/* Bad input of the cushion: each number and each option at fault gets its own status, and hangs
 * nothing. */
#include "cushion/models.h"
#include "schema/numbers.h"
#include "support.h"

#include <math.h>
#include <stddef.h>

static carom_cushion_impact good(void) {
  return (carom_cushion_impact){.v = {0.7, 1.3, 0},
                                .w = {-20, 15, 30},
                                .normal = {0, 1},
                                .height = 0.036,
                                .radius = 0.028575,
                                .mass = 0.17,
                                .mu_slide = 0.2,
                                .mu_cushion = 0.2,
                                .restitution = 0.85,
                                .jaw_radius = 0.02};
}

static void expect(const carom_cushion_impact *in, const carom_cushion_options *options,
                   carom_status status, int field) {
  carom_motion out = {{1, 1, 1}, {1, 1, 1}};
  int blamed;
  const carom_status got = carom_cushion(in, options, &out);
  ck_assert_msg(got == status, "field %d: %s, not %s", field, carom_status_name(got),
                carom_status_name(status));
  for (int c = 0; c < 6 && status < 0; c++)
    ck_assert(isnan(((double *)&out)[c]));
  ck_assert_int_eq(carom_cushion_check(in, options, &blamed), status);
  ck_assert_int_eq(blamed, field);
}

TEST(each_field_is_named) {
  static const carom_status not_finite[15] = {
      CAROM_ERROR_VELOCITY,    CAROM_ERROR_VELOCITY,    CAROM_ERROR_VELOCITY,  CAROM_ERROR_SPIN,
      CAROM_ERROR_SPIN,        CAROM_ERROR_SPIN,        CAROM_ERROR_NORMAL,    CAROM_ERROR_NORMAL,
      CAROM_ERROR_NOSE_HEIGHT, CAROM_ERROR_RADIUS,      CAROM_ERROR_MASS,      CAROM_ERROR_MU_SLIDE,
      CAROM_ERROR_MU_CUSHION,  CAROM_ERROR_RESTITUTION, CAROM_ERROR_JAW_RADIUS};
  for (int field = 0; field < 15; field++)
    for (int k = 0; k < 3; k++) {
      carom_cushion_impact in = good();
      static const double wrong[3] = {NAN, INFINITY, -INFINITY};
      ((double *)&in)[field] = wrong[k];
      expect(&in, NULL, not_finite[field], field);
    }
  static const struct {
    int field;
    double value;
    carom_status status;
  } cases[] = {{2, 0.1, CAROM_ERROR_VERTICAL},      {8, 0, CAROM_ERROR_NOSE_HEIGHT},
               {8, -0.01, CAROM_ERROR_NOSE_HEIGHT}, {8, 0.05715, CAROM_ERROR_NOSE_HEIGHT},
               {9, 0, CAROM_ERROR_RADIUS},          {9, -1, CAROM_ERROR_RADIUS},
               {10, 0, CAROM_ERROR_MASS},           {10, -1, CAROM_ERROR_MASS},
               {11, -1e-9, CAROM_ERROR_MU_SLIDE},   {11, 1.1, CAROM_ERROR_MU_SLIDE},
               {12, -0.1, CAROM_ERROR_MU_CUSHION},  {12, 1.00001, CAROM_ERROR_MU_CUSHION},
               {13, -1, CAROM_ERROR_RESTITUTION},   {13, 1.01, CAROM_ERROR_RESTITUTION},
               {14, -0.1, CAROM_ERROR_JAW_RADIUS}};
  for (size_t k = 0; k < sizeof cases / sizeof cases[0]; k++) {
    carom_cushion_impact in = good();
    ((double *)&in)[cases[k].field] = cases[k].value;
    expect(&in, NULL, cases[k].status, cases[k].field);
  }
  carom_cushion_impact in = good();
  in.normal[1] = 0;
  expect(&in, NULL, CAROM_ERROR_NORMAL, 6);
}

enum { LAST_RESERVED = sizeof((carom_cushion_options *)NULL)->reserved / sizeof(uint64_t) - 1 };

TEST(each_option_is_checked) {
  const carom_cushion_impact in = good();
  carom_cushion_options options = {.reserved[LAST_RESERVED] = 1};
  expect(&in, &options, CAROM_ERROR_OPTIONS, -1);
  const carom_number *n;
  for (int k = 0; (n = carom_number_of(CAROM_PART_CUSHION_OPTIONS, k)) != NULL; k++)
    for (int way = 0; options = (carom_cushion_options){0}, set_bad(&options, n, way); way++) {
      carom_motion out;
      int8_t status = 77;
      expect(&in, &options, n->error, -1);
      ck_assert_int_eq(carom_cushion_batch(&in, 1, &options, &out, &status), n->error);
      ck_assert_int_eq(status, 77);
    }
}

/* Too thin; some of the numbers without the others. */
TEST(smooth_numbers_go_together) {
  const carom_cushion_impact in = good();
  const carom_cushion_options bad[] = {{.smooth_q = 1e-13, .smooth_x = 1, .smooth_t = 1},
                                       {.smooth_k = 0.1},
                                       {.smooth_q = 0.3, .smooth_t = 1},
                                       {.smooth_q = 0.3, .smooth_x = 1}};
  for (int k = 0; k < 4; k++)
    expect(&in, &bad[k], CAROM_ERROR_SMOOTH, -1);
}

TEST(pointers_and_traces) {
  const carom_cushion_impact in = good();
  const carom_cushion_options closed = {.model = CAROM_CUSHION_HAN};
  carom_cushion_point point[2];
  carom_motion out;
  ck_assert_int_eq(carom_cushion(NULL, NULL, &out), CAROM_ERROR_NULL);
  ck_assert_int_eq(carom_cushion(&in, NULL, NULL), CAROM_ERROR_NULL);
  ck_assert_int_eq(carom_cushion_batch(NULL, 1, NULL, &out, NULL), CAROM_ERROR_NULL);
  ck_assert_int_eq(carom_cushion_batch(NULL, 0, NULL, NULL, NULL), CAROM_OK);
  ck_assert_int_eq(carom_cushion_check(NULL, NULL, NULL), CAROM_ERROR_NULL);
  ck_assert_int_eq(carom_cushion_trace(&in, NULL, 1, point), CAROM_ERROR_POINTS);
  ck_assert_int_eq(carom_cushion_trace(NULL, NULL, 2, point), CAROM_ERROR_NULL);
  ck_assert_int_eq(carom_cushion_trace(&in, &closed, 2, point), CAROM_ERROR_CUSHION_MODEL);
  ck_assert(isnan(point[1].work));
  ck_assert_str_eq(carom_cushion_field_name(8), "height");
  ck_assert_ptr_null(carom_cushion_field_name(15));
  ck_assert_ptr_null(carom_cushion_field_name(-1));
  ck_assert_str_eq(carom_cushion_model_name(CAROM_CUSHION_STRONGE), "stronge");
  ck_assert_ptr_null(carom_cushion_model_name((carom_cushion_model)9));
}
