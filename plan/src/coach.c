/* Cuts, strokes that are ruled, and what they are worth. */
#include "coach.h"
#include "rules.h"

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

double carom_worth_left(const carom_plan_job *job, const carom_ruling *ruling) {
  const carom_turn *turn = &ruling->turn;
  if (turn->outcome == CAROM_TURN_DRAW)
    return 0.5;
  if (turn->outcome > CAROM_TURN_PASS)
    return turn->outcome == CAROM_TURN_WIN;
  carom_plan_rules rules;
  const carom_plan_job next = carom_job_after(job, ruling, &rules);
  double value = 0.0;
  carom_plan_value(&next, ruling->hand, &value);
  if (turn->outcome == CAROM_TURN_PASS)
    return 1.0 - value;
  return value;
}
