/* See play.h. Exact models are vectors of double, which cannot be dual numbers; no shot of the test asks for them. */
#include "dual/play.h"

#include "ball_ball/euler.h"
#include "cushion/models.h"
#include "platform/threads.h"
#include "shot/sim.h"

static_assert(sizeof(dual_number) == sizeof(dual), "numbers of the test are those of the sources");
static_assert(sizeof(carom_ball_kind) == DUAL_KIND * sizeof(dual), "all numbers of a ball have a direction");
static_assert(sizeof(carom_cushion_impact) == DUAL_IMPACT * sizeof(dual), "all numbers of an impact have a direction");

static void put_state(const carom_ball_state &s, dual_number to[DUAL_STATE]) {
  memcpy(to, s.r, sizeof s.r);
  memcpy(to + 3, s.v, sizeof s.v);
  memcpy(to + 6, s.w, sizeof s.w);
}

/* Noses rise, and cushions change, together. */
template <class part> static void change_nose(part &p, const dual_number nose[3]) {
  p.height.d = nose[0].d;
  p.mu_cushion = dual(nose[1].x, nose[1].d);
  p.restitution = dual(nose[2].x, nose[2].d);
}

void dual_play(dual_shot *shot) {
  static carom_table table;
  static carom_shot_ball balls[DUAL_BALLS];
  static carom_event events[DUAL_EVENTS];
  carom_table_make((carom_table_kind)shot->table, &table);
  for (int k = 0; k < table.rails; k++)
    change_nose(table.rail[k], shot->nose);
  for (int k = 0; k < table.jaws; k++)
    change_nose(table.jaw[k], shot->nose);
  for (int i = 0; i < shot->count; i++) {
    memcpy(&balls[i].kind, shot->kind[i], sizeof balls[i].kind);
    memcpy(balls[i].state.r, shot->state[i], sizeof balls[i].state.r);
    memcpy(balls[i].state.v, shot->state[i] + 3, sizeof balls[i].state.v);
    memcpy(balls[i].state.w, shot->state[i] + 6, sizeof balls[i].state.w);
    balls[i].state.label = 0;
  }
  carom_cue cue = {};
  memcpy(&cue, shot->cue, DUAL_CUE * sizeof(dual)); /* they stand first */
  carom_shot_options options = {};
  options.ball_model = (carom_ball_model)shot->ball_model;
  options.cushion_model = (carom_shot_cushion)shot->cushion_model;
  options.friction = (carom_ball_friction)shot->friction;
  options.space = (carom_space)shot->space;
  carom_ball_state final[DUAL_BALLS];
  carom_shot played = {};
  played.events = events;
  played.room = DUAL_EVENTS;
  played.final = final;
  shot->status = carom_shoot(&table, balls, shot->count, &cue, &options, &played);
  shot->events = (int)played.count;
  for (int k = 0; k < shot->events && k < DUAL_EVENTS; k++) {
    dual_event *event = &shot->event[k];
    event->type = events[k].type;
    event->a = events[k].a;
    event->b = events[k].b;
    event->time = {events[k].time.x, events[k].time.d};
    for (int side = 0; side < 2; side++) {
      put_state(events[k].before[side], event->before[side]);
      put_state(events[k].after[side], event->after[side]);
    }
  }
  for (int i = 0; i < shot->count; i++)
    put_state(final[i], shot->final[i]);
}

int dual_cushion(const dual_number in[DUAL_IMPACT], int model, int law, dual_number out[DUAL_MOTION]) {
  carom_cushion_impact impact;
  carom_motion motion;
  carom_cushion_options options = {};
  options.model = (carom_cushion_model)model;
  options.law = (carom_cushion_law)law;
  memcpy(&impact, in, sizeof impact);
  const carom_status status = carom_cushion(&impact, &options, &motion);
  memcpy(out, &motion, sizeof motion);
  return status;
}

/* ---- What is not of dual numbers ---- */

carom_speed_law carom_alciatore(void) {
  real law[3];
  dual_usual_law(law);
  return {law[0], law[1], law[2]};
}

carom_status carom_collide(const carom_impact *, const carom_options *, carom_result *) {
  abort();
}
carom_status carom_euler(carom_local *, int, int64_t, carom_euler_run *) {
  abort();
}
carom_status carom_mathavan(carom_contact *, int) {
  abort();
}
carom_status carom_cushion_euler(carom_contact *, int, double, int, int64_t, carom_cushion_run *) {
  abort();
}
size_t carom_in_threads(carom_part_worker *, const void *, size_t, int, size_t) {
  abort();
}
