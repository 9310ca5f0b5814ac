/* Cuts, and strokes that are ruled. */
#include "coach.h"
#include "random_draws.h"
#include "rules.h"
#include "view.h"

double carom_cut_at(const carom_event *contact, int cue_ball) {
  const int side = contact->a != cue_ball;
  const carom_ball_state *striker = &contact->before[side], *object = &contact->before[1 - side];
  const double x = object->r[0] - striker->r[0], y = object->r[1] - striker->r[1];
  const double cross = striker->v[0] * y - striker->v[1] * x;
  return carom_angle_of(striker->v[0] * x + striker->v[1] * y, cross) / degree;
}

void carom_play_stroke(const carom_plan_job *job, const carom_cue *cue, carom_call call,
                       carom_stroke_room *room, carom_shot *shot, carom_ruling *ruling) {
  shot->final = room->final;
  shot->facts = &room->facts;
  const carom_shot *played = shot;
  if (carom_shoot(job->table, job->balls, (int)job->count, cue, job->shot, shot) < 0)
    played = NULL;
  carom_referee(job->rules, job->table, job->balls, (int)job->count, (int)cue->ball, played, call,
                ruling);
  ruling->turn = carom_turn_seen(job->rules, &ruling->state, ruling->turn);
}

carom_plan_job carom_job_after(const carom_plan_job *job, const carom_ruling *ruling,
                               carom_plan_rules *rules) {
  carom_plan_job next = *job;
  *rules = *job->rules;
  rules->state = ruling->state;
  next.rules = rules;
  next.balls = ruling->balls;
  next.leave = (int64_t)ruling->turn.leave;
  next.goal = NULL;
  if (ruling->turn.outcome == CAROM_TURN_PASS) {
    next.player = carom_opponent_of(job, job->options);
    next.opponent = job->player;
  }
  return next;
}
