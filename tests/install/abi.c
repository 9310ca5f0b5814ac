/* Prints the binary interface as the compiler sees it: sizes, alignments, offsets of every field, values of every enumerator.
 * The script `abi` compares it with abi.expected. */
#include "carom_shot.h"

#include <stdio.h>

#define TYPE(type) printf("%s: %zu bytes, aligned to %zu\n", #type, sizeof(type), _Alignof(type))
#define FIELD(type, member) printf("  %3zu %s: %zu\n", offsetof(type, member), #member, sizeof(((type *)0)->member))
#define VALUE(name) printf("%s = %d\n", #name, (int)name)

static void print_shot_types(void) {
  TYPE(carom_cushion_impact);
  FIELD(carom_cushion_impact, v);
  FIELD(carom_cushion_impact, w);
  FIELD(carom_cushion_impact, normal);
  FIELD(carom_cushion_impact, height);
  FIELD(carom_cushion_impact, radius);
  FIELD(carom_cushion_impact, mass);
  FIELD(carom_cushion_impact, mu_cloth);
  FIELD(carom_cushion_impact, mu_cushion);
  FIELD(carom_cushion_impact, restitution);
  FIELD(carom_cushion_impact, jaw_radius);
  TYPE(carom_cushion_options);
  FIELD(carom_cushion_options, model);
  FIELD(carom_cushion_options, convention);
  FIELD(carom_cushion_options, law);
  FIELD(carom_cushion_options, steps);
  FIELD(carom_cushion_options, threads);
  FIELD(carom_cushion_options, unused);
  FIELD(carom_cushion_options, least_step);
  FIELD(carom_cushion_options, omega_ratio);
  FIELD(carom_cushion_options, reserved);
  TYPE(carom_ball_kind);
  FIELD(carom_ball_kind, mass);
  FIELD(carom_ball_kind, radius);
  FIELD(carom_ball_kind, mu_slide);
  FIELD(carom_ball_kind, mu_roll);
  FIELD(carom_ball_kind, mu_spin);
  FIELD(carom_ball_kind, mu_ball);
  FIELD(carom_ball_kind, restitution);
  FIELD(carom_ball_kind, mu_cushion);
  FIELD(carom_ball_kind, restitution_cushion);
  FIELD(carom_ball_kind, gravity);
  TYPE(carom_ball_state);
  FIELD(carom_ball_state, r);
  FIELD(carom_ball_state, v);
  FIELD(carom_ball_state, w);
  FIELD(carom_ball_state, label);
  TYPE(carom_shot_ball);
  FIELD(carom_shot_ball, kind);
  FIELD(carom_shot_ball, state);
  TYPE(carom_rail);
  FIELD(carom_rail, p);
  FIELD(carom_rail, q);
  FIELD(carom_rail, height);
  FIELD(carom_rail, line);
  FIELD(carom_rail, side);
  TYPE(carom_jaw);
  FIELD(carom_jaw, centre);
  FIELD(carom_jaw, radius);
  FIELD(carom_jaw, height);
  TYPE(carom_pocket);
  FIELD(carom_pocket, centre);
  FIELD(carom_pocket, radius);
  FIELD(carom_pocket, depth);
  TYPE(carom_table);
  FIELD(carom_table, width);
  FIELD(carom_table, length);
  FIELD(carom_table, rails);
  FIELD(carom_table, jaws);
  FIELD(carom_table, pockets);
  FIELD(carom_table, rail);
  FIELD(carom_table, jaw);
  FIELD(carom_table, pocket);
  TYPE(carom_cue);
  FIELD(carom_cue, speed);
  FIELD(carom_cue, phi);
  FIELD(carom_cue, theta);
  FIELD(carom_cue, a);
  FIELD(carom_cue, b);
  FIELD(carom_cue, mass);
  FIELD(carom_cue, end_mass);
  FIELD(carom_cue, tip_radius);
  FIELD(carom_cue, ball);
  TYPE(carom_shot_options);
  FIELD(carom_shot_options, world);
  FIELD(carom_shot_options, ball_model);
  FIELD(carom_shot_options, cushion_model);
  FIELD(carom_shot_options, friction);
  FIELD(carom_shot_options, steps);
  FIELD(carom_shot_options, events_most);
  FIELD(carom_shot_options, threads);
  FIELD(carom_shot_options, unused);
  FIELD(carom_shot_options, time_most);
  FIELD(carom_shot_options, reserved);
  TYPE(carom_event);
  FIELD(carom_event, time);
  FIELD(carom_event, type);
  FIELD(carom_event, a);
  FIELD(carom_event, b);
  FIELD(carom_event, reserved);
  FIELD(carom_event, before);
  FIELD(carom_event, after);
  TYPE(carom_shot);
  FIELD(carom_shot, events);
  FIELD(carom_shot, room);
  FIELD(carom_shot, count);
  FIELD(carom_shot, final);
  FIELD(carom_shot, time);
  FIELD(carom_shot, reserved);
}

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
  print_shot_types();
/* enumerators.h is made by the script: a line VALUE(NAME); for every enumerator that is spelt out in the header. */
#include "enumerators.h"
  return 0;
}
