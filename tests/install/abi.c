/* Prints the binary interface as the compiler sees it: sizes, alignments, offsets of every field, values of every enumerator.
 * The script `abi` compares it with abi.expected. */
#include "carom.h"

#include <stdio.h>

#define TYPE(type) printf("%s: %zu bytes, aligned to %zu\n", #type, sizeof(type), _Alignof(type))
#define FIELD(type, member) printf("  %3zu %s: %zu\n", offsetof(type, member), #member, sizeof(((type *)0)->member))
#define VALUE(name) printf("%s = %d\n", #name, (int)name)

static void print_types(void) {
  TYPE(carom_ball);
  FIELD(carom_ball, r);
  FIELD(carom_ball, v);
  FIELD(carom_ball, w);
  FIELD(carom_ball, radius);
  FIELD(carom_ball, mass);
  FIELD(carom_ball, mu_cloth);
  TYPE(carom_impact);
  FIELD(carom_impact, a);
  FIELD(carom_impact, b);
  FIELD(carom_impact, mu_ball);
  FIELD(carom_impact, restitution);
  TYPE(carom_motion);
  FIELD(carom_motion, v);
  FIELD(carom_motion, w);
  TYPE(carom_result);
  FIELD(carom_result, a);
  FIELD(carom_result, b);
  TYPE(carom_ball_f32);
  FIELD(carom_ball_f32, r);
  FIELD(carom_ball_f32, v);
  FIELD(carom_ball_f32, w);
  FIELD(carom_ball_f32, radius);
  FIELD(carom_ball_f32, mass);
  FIELD(carom_ball_f32, mu_cloth);
  TYPE(carom_impact_f32);
  FIELD(carom_impact_f32, a);
  FIELD(carom_impact_f32, b);
  FIELD(carom_impact_f32, mu_ball);
  FIELD(carom_impact_f32, restitution);
  TYPE(carom_motion_f32);
  FIELD(carom_motion_f32, v);
  FIELD(carom_motion_f32, w);
  TYPE(carom_result_f32);
  FIELD(carom_result_f32, a);
  FIELD(carom_result_f32, b);
  TYPE(carom_options);
  FIELD(carom_options, solver);
  FIELD(carom_options, slip);
  FIELD(carom_options, steps);
  FIELD(carom_options, threads);
  FIELD(carom_options, reserved);
  TYPE(carom_speed_law);
  FIELD(carom_speed_law, a);
  FIELD(carom_speed_law, b);
  FIELD(carom_speed_law, c);
  TYPE(carom_detail);
  FIELD(carom_detail, steps);
  FIELD(carom_detail, evaluations);
  FIELD(carom_detail, normal);
  FIELD(carom_detail, friction);
  FIELD(carom_detail, cloth_a);
  FIELD(carom_detail, cloth_b);
  FIELD(carom_detail, work_compression);
  FIELD(carom_detail, work);
  FIELD(carom_detail, stick);
  FIELD(carom_detail, stick_normal);
  FIELD(carom_detail, reserved);
  TYPE(carom_trace_point);
  FIELD(carom_trace_point, normal);
  FIELD(carom_trace_point, work);
  FIELD(carom_trace_point, phase);
  FIELD(carom_trace_point, sticks);
  FIELD(carom_trace_point, v_n);
  FIELD(carom_trace_point, u_x);
  FIELD(carom_trace_point, u_z);
  FIELD(carom_trace_point, d_x);
  FIELD(carom_trace_point, d_y);
  FIELD(carom_trace_point, b_x);
  FIELD(carom_trace_point, b_y);
  FIELD(carom_trace_point, state);
  FIELD(carom_trace_point, reserved);
  TYPE(carom_status);
  TYPE(carom_solver);
  TYPE(carom_slip);
  TYPE(carom_isa);
  TYPE(carom_stick);
  TYPE(carom_phase);
}

int main(void) {
  print_types();
/* enumerators.h is made by the script: a line VALUE(NAME); for every enumerator that is spelt out in the header. */
#include "enumerators.h"
  return 0;
}
