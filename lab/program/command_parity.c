/* `carom-lab parity`: shots that pooltool recorded, beside carom.
 *
 * A flat shot is played anew by pooltool's rules and models. It agrees if its first events, up
 * to where pooltool's own histories part when the start is moved by 1e-13, have the same types
 * and balls in the same order, and times and states are within 1e-12 + 5e-13 times the recorded
 * amplification.
 *
 * Shots in space (engine "space") differ by design, since the rules of some events differ
 * (docs/using/shots.md). So carom begins anew at each event of the record: with the states that
 * pooltool had after the event before, what happens next, and when; and with the state before
 * the event, what is the state after it. Each model is compared as it is, and again with
 * pooltool's rule in the place of carom's, by means of the public interface:
 *
 *   STRIKE. Squirt turns pooltool's ball about the vertical, and so keeps v_z.
 *   SLATE. carom's v' = sqrt(e^2 v_n^2 - s^2) is pooltool's e v_n for
 *     e' = sqrt(e^2 v_n^2 + s^2) / v_n, up to the most that a ball may have. Where a ball sticks,
 *     pooltool multiplies w_z by 2/7; else it keeps w_z, as carom does where nothing slows
 *     turning on the spot. A rebound below 5 mm becomes 0.
 *   SPHERES. Friction mu e v_n / 2 is carom's mu' (1 + e) v_n / 2 for mu' = 2 e mu / (1 + e).
 *   RAIL. pooltool moves the ball until its gap to the nose is 1 um; carom's ball is larger by
 *     that, and has the same R w. */
#include "command.h"
#include "memory.h"
#include "message.h"
#include "options.h"
#include "recorded.h"
#include "shot_file.h"
#include "subcommands.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* One row of a table: a family of flat shots, or what is compared in space. */
typedef struct row {
  char *name;
  size_t shots, events, agreed, whole;
  double time, state; /* largest differences over the allowed */
} row;

/* What is compared at each event in space, and what is allowed where pooltool's rule is taken. */
enum { STRIKE, MOTION, NEXT, SLATE, SPHERES, RAIL, STAGES };
static const struct {
  const char *name;
  double allowed;
} stages[STAGES] = {
    {"strike", 1e-12}, {"motion", 1e-11},    {"next event", 1e-11},
    {"slate", 1e-12},  {"two balls", 1e-12}, {"rail", 1e-9},
};
static const double hop_loss = 0.02, restitution_most = 0.98, least_height = 0.005, spacer = 1e-6,
                    near_cloth = 1e-3;
static const double rounding = 1e-9; /* above that two models differ as they are */

typedef struct stage_tally {
  long compared, left_out, apart; /* apart: the models differ by more than rounding as they are */
  double as_is, by_rule;          /* largest differences, the second one with pooltool's rule in
                                     the place of carom's */
} stage_tally;

typedef struct parity_job {
  shared_options shared;
  bool all; /* every difference is told */
  row *each;
  size_t count, room;
  long in_space, bad, events, ended; /* shots in space; no such record; pooltool ended by an
                                        error */
  stage_tally stage[STAGES];
} parity_job;

OPTION(parity_job, option_verbose, "verbose", all, 'v', NULL, set_flag, 0,
       "print the first difference of each shot that disagrees, and other next events in space");

/* ---- The record */

static int type_of(const char *name) {
  for (int type = CAROM_EVENT_STRIKE; type <= CAROM_EVENT_LEFT_TABLE; type++)
    if (name != NULL && strcmp(name, shot_event_name(type)) == 0)
      return type;
  return 0;
}

static int ball_of(const shot_line *line, const json_t *id) {
  for (int i = 0; i < line->count; i++)
    if (json_is_string(id) && strcmp(json_string_value(id), line->name[i]) == 0)
      return i;
  return -1;
}

static bool read_state(const json_t *v, carom_ball_state *s) {
  for (size_t k = 0; k < 9; k++) {
    const json_t *number = json_array_get(v, k + 1);
    if (!json_is_number(number))
      return false;
    (k < 3 ? s->r : k < 6 ? s->v : s->w)[k % 3] = json_number_value(number);
  }
  s->label = (int64_t)json_number_value(json_array_get(v, 0));
  return true;
}

/* A recorded event as one of carom, but for the index of what a ball met. */
static bool read_event(const shot_line *line, const json_t *json, carom_event *e) {
  *e = (carom_event){.time = json_number_value(json_array_get(json, 0)),
                     .type = type_of(json_string_value(json_array_get(json, 1)))};
  const json_t *ids = json_array_get(json, 2);
  const size_t first = e->type == CAROM_EVENT_STRIKE ? 1 : 0,
               sides = e->type == CAROM_EVENT_BALL_BALL ? 2 : 1;
  e->a = ball_of(line, json_array_get(ids, first));
  e->b = sides == 2 ? ball_of(line, json_array_get(ids, 1)) : -1;
  for (size_t k = 0; k < sides; k++)
    if (!read_state(json_array_get(json_array_get(json, 3), k), &e->before[k]) ||
        !read_state(json_array_get(json_array_get(json, 4), k), &e->after[k]))
      return false;
  return e->type != 0 && e->a >= 0 && (sides == 1 || e->b >= 0);
}

/* ---- Flat shots, played again */

static row *family_of(parity_job *job, const char *name) {
  for (size_t k = 0; k < job->count; k++)
    if (strcmp(job->each[k].name, name) == 0)
      return &job->each[k];
  job->each = grow(job->each, &job->room, job->count + 1, sizeof *job->each);
  row *f = &job->each[job->count++];
  *f = (row){.name = copy_text(name)};
  return f;
}

/* What is allowed where the start moved by 1e-13 moves a number by 1e-13 times so much. */
static double allowed(const json_t *sens, const char *of, size_t k) {
  return 1e-12 + 5e-13 * fmax(json_number_value(json_array_get(json_object_get(sens, of), k)), 1.0);
}

/* The largest difference of velocities, and of spins times the radius; of places too. */
static double velocities_apart(const double v[3], const double w[3], const carom_ball_state *s,
                               double R) {
  double worst = 0.0;
  for (int k = 0; k < 3; k++)
    worst = fmax(worst, fmax(fabs(v[k] - s->v[k]), R * fabs(w[k] - s->w[k])));
  return worst;
}
static double states_apart(const carom_ball_state *a, const carom_ball_state *b, double R) {
  double worst = velocities_apart(a->v, a->w, b, R);
  for (int k = 0; k < 3; k++)
    worst = fmax(worst, fabs(a->r[k] - b->r[k]));
  return worst;
}

/* Whether an event of carom is that of the record: type, balls, and the part of the table. */
static bool same_event(const shot_line *line, const carom_event *own, const carom_event *e,
                       const json_t *json) {
  if (own->type != e->type || own->a != e->a ||
      (e->type == CAROM_EVENT_BALL_BALL && own->b != e->b))
    return false;
  if (e->type < CAROM_EVENT_RAIL || e->type > CAROM_EVENT_POCKET)
    return true;
  const char *met = shot_part_name(line->table, own),
             *id = json_string_value(json_array_get(json_array_get(json, 2), 1));
  return met != NULL && id != NULL && strcmp(met, id) == 0;
}

/* Compares the events of a shot; false where they disagree, told in `why`. The record begins and
 * ends with an event of nothing.
 */
static bool compare(const shot_line *line, const carom_shot *shot, row *f, char why[200]) {
  const json_t *events = json_object_get(line->json, "events"),
               *sens = json_object_get(line->json, "sens");
  const size_t recorded = json_array_size(events);
  const size_t same = (size_t)json_integer_value(json_object_get(sens, "same_events"));
  if (recorded == 0 || sens == NULL)
    return snprintf(why, 200, "it has no recorded events") < 0;
  for (size_t k = 1; k < (same < recorded ? same : recorded - 1); k++) {
    const json_t *json = json_array_get(events, k);
    const carom_event *own = &shot->events[k - 1];
    carom_event e;
    if ((int64_t)k > shot->count)
      return snprintf(why, 200, "event %zu of %zu: there is none", k, recorded) < 0;
    if (!read_event(line, json, &e) || !same_event(line, own, &e, json))
      return snprintf(why, 200, "event %zu of %zu: %s at %.17g, not %s at %.17g", k, recorded,
                      shot_event_name(own->type), own->time,
                      json_string_value(json_array_get(json, 1)), e.time) < 0;
    const double dt = fabs(own->time - e.time) / allowed(sens, "t", k);
    double worst = 0.0; /* of the states after the event, whose amplification is recorded */
    for (int side = 0; side < (e.type == CAROM_EVENT_BALL_BALL ? 2 : 1); side++)
      worst = own->after[side].label == e.after[side].label
                  ? fmax(worst, states_apart(&own->after[side], &e.after[side], 0.03))
                  : INFINITY;
    worst /= allowed(sens, "state", k);
    f->time = fmax(f->time, dt);
    f->state = fmax(f->state, worst);
    f->events++;
    if (!(dt <= 1.0 && worst <= 1.0))
      return snprintf(why, 200, "event %zu of %zu, %s: time %.2g and state %.2g times the allowed",
                      k, recorded, shot_event_name(e.type), dt, worst) < 0;
  }
  if (same >= recorded && (size_t)shot->count + 2 != recorded)
    return snprintf(why, 200, "%lld events, not %zu", (long long)shot->count + 2, recorded) < 0;
  f->whole += same >= recorded;
  return true;
}

/* Plays a shot by what the recording was made with. */
static void play_flat(parity_job *job, const shot_line *line, const char *engine) {
  const char *name = json_string_value(json_object_get(line->json, "family"));
  carom_shot_options options = {.world = CAROM_WORLD_POOLTOOL};
  if (engine[0] != 0 && strcmp(engine, "default") != 0)
    options.ball_model = CAROM_BALL_MODEL_EULER;
  if (strcmp(engine, "mathavan_all") == 0)
    options.cushion_model = CAROM_SHOT_CUSHION_EULER;
  row *f = family_of(job, name != NULL ? name : "-");
  f->shots++;
  char why[200] = "";
  bool good = false;
  if (line->error == NULL) {
    carom_shot shot;
    const carom_status status = play_recorded(line, &options, &shot);
    good = compare(line, &shot, f, why);
    if (status < 0 && !good)
      snprintf(why + strlen(why), sizeof why - strlen(why), "; %s", carom_status_name(status));
    free(shot.events);
  }
  f->agreed += good;
  if (!good && job->all)
    complain("line %zu: shot %s: %s", line->number, line->id != NULL ? line->id : "-",
             line->error != NULL ? line->error : why);
}

/* ---- Shots in space, event by event */

static const carom_shot_options stops = {
    .stop_at = ~CAROM_STOP_AT_CONTACT & ((UINT64_C(1) << (CAROM_EVENT_LEFT_TABLE + 1)) - 1),
    .cushion_model = CAROM_SHOT_CUSHION_HAN};

/* The first event from these states on; type 0 where there is none, and -1 where carom refuses
 * them. */
static carom_event first_event(const carom_table *table, const carom_shot_ball *balls, int count,
                               const carom_cue *cue) {
  carom_event e = {0};
  carom_shot shot = {.events = &e, .room = 1};
  const carom_status status = carom_shoot(table, balls, count, cue, &stops, &shot);
  if (status < 0)
    e.type = -1;
  return e;
}

static void note(parity_job *p, int stage, double as_is, double by_rule) {
  stage_tally *s = &p->stage[stage];
  s->compared++;
  s->apart += !(as_is <= rounding);
  s->as_is = fmax(s->as_is, as_is);
  s->by_rule = fmax(s->by_rule, by_rule);
}

static void compare_strike(const shot_line *line, const carom_event *e, parity_job *p) {
  const carom_event own = first_event(&line->table->table, line->ball, line->count, &line->cue);
  const double R = line->ball[e->a].kind.radius;
  const double as_is =
      own.type == CAROM_EVENT_STRIKE ? states_apart(&own.after[0], &e->after[0], R) : INFINITY;
  carom_motion flat;
  if (carom_strike(&line->cue, &line->ball[e->a].kind, &flat) == CAROM_OK)
    flat.v[2] = -hypot(flat.v[0], flat.v[1]) * tan(line->cue.theta * acos(-1.0) / 180.0);
  note(p, STRIKE, as_is, velocities_apart(flat.v, flat.w, &e->after[0], R));
}

static void compare_slate(const shot_line *line, const carom_event *e, parity_job *p) {
  carom_shot_ball ball = {line->ball[e->a].kind, e->before[0]};
  carom_event own = first_event(&line->table->table, &ball, 1, NULL);
  const double R = ball.kind.radius,
               e_t = ball.kind.restitution_table > 0.0 ? ball.kind.restitution_table : 0.5;
  const double as_is =
      own.type == CAROM_EVENT_SLATE ? states_apart(&own.after[0], &e->after[0], R) : INFINITY;
  const double v_n = -e->before[0].v[2], up = e_t * v_n;
  /* pooltool's rules */
  ball.kind.restitution_table = sqrt(up * up + hop_loss * hop_loss) / v_n;
  ball.kind.mu_spin = 1e-300;
  if (own.type < 0 || !(ball.kind.restitution_table <= restitution_most)) {
    p->stage[SLATE].left_out++;
    return;
  }
  own = first_event(&line->table->table, &ball, 1, NULL);
  carom_ball_state *s = &own.after[0];
  const double slip =
      hypot(e->before[0].v[0] - R * e->before[0].w[1], e->before[0].v[1] + R * e->before[0].w[0]);
  if (2.0 / 7.0 * slip <= ball.kind.mu_slide * (v_n + up))
    s->w[2] *= 2.0 / 7.0;
  if (up * up < 2.0 * ball.kind.gravity * least_height)
    s->v[2] = 0.0;
  note(p, SLATE, as_is,
       own.type == CAROM_EVENT_SLATE ? states_apart(s, &e->after[0], R) : INFINITY);
}

static double dot(const double a[3], const double b[3]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* The line of centres of two balls. */
static void line_of_centres(const carom_impact *in, double n[3]) {
  for (int k = 0; k < 3; k++)
    n[k] = in->b.r[k] - in->a.r[k];
  const double size = sqrt(dot(n, n));
  for (int k = 0; k < 3; k++)
    n[k] /= size;
}

/* The size of the slip between two balls. */
static double slip_of(const carom_impact *in) {
  double n[3], v[3], W[3], u[3];
  line_of_centres(in, n);
  for (int k = 0; k < 3; k++) {
    v[k] = in->a.v[k] - in->b.v[k];
    W[k] = in->a.radius * in->a.w[k] + in->b.radius * in->b.w[k];
  }
  for (int k = 0; k < 3; k++)
    u[k] =
        v[k] - dot(v, n) * n[k] + W[(k + 1) % 3] * n[(k + 2) % 3] - W[(k + 2) % 3] * n[(k + 1) % 3];
  return sqrt(dot(u, u));
}

/* Whether pooltool exchanges a tenth of the velocity after the collision: both move alike, and
 * part slowly. */
static bool exchanges(const carom_impact *in, const carom_result *out) {
  const double *a = out->a.v, *b = out->b.v;
  double n[3];
  line_of_centres(in, n);
  return fabs(dot(b, n) - dot(a, n)) < 0.01 && dot(a, b) > 0.9 * sqrt(dot(a, a) * dot(b, b));
}

static void compare_spheres(const shot_line *line, const carom_event *e, parity_job *p) {
  carom_impact in = {
      .restitution = 0.5 * (line->ball[e->a].kind.restitution + line->ball[e->b].kind.restitution)};
  const double R = line->ball[e->a].kind.radius;
  for (int side = 0; side < 2; side++) {
    const carom_ball_kind *kind = &line->ball[side == 0 ? e->a : e->b].kind;
    carom_ball *ball = side == 0 ? &in.a : &in.b;
    *ball = (carom_ball){.radius = kind->radius, .mass = kind->mass, .mu_cloth = kind->mu_slide};
    memcpy(ball->r, e->after[side].r, sizeof ball->r); /* where pooltool's spacer leaves it */
    memcpy(ball->v, e->before[side].v, sizeof ball->v);
    memcpy(ball->w, e->before[side].w, sizeof ball->w);
  }
  const carom_speed_law law = carom_alciatore();
  double apart[2];
  carom_result out;
  for (int rule = 0; rule < 2; rule++) {
    in.mu_ball = (law.a + law.b * exp(-law.c * slip_of(&in))) *
                 (rule ? 2.0 * in.restitution / (1.0 + in.restitution) : 1.0);
    apart[rule] = INFINITY;
    if (carom_impact3(&in, &out) == CAROM_OK)
      apart[rule] = fmax(velocities_apart(out.a.v, out.a.w, &e->after[0], R),
                         velocities_apart(out.b.v, out.b.w, &e->after[1], R));
  }
  if (exchanges(&in, &out))
    p->stage[SPHERES].left_out++;
  else
    note(p, SPHERES, apart[0], apart[1]);
}

/* On the cloth carom has the flat model, and pooltool's ball lands again below 1 mm: left out. */
static void compare_rail(const shot_line *line, const carom_event *e, parity_job *p) {
  const carom_ball_kind kind = line->ball[e->a].kind;
  const double R = kind.radius;
  carom_shot_ball ball = {kind, e->before[0]};
  const carom_event own = first_event(&line->table->table, &ball, 1, NULL);
  if (own.type < 0 || e->before[0].label != CAROM_BALL_AIRBORNE ||
      e->before[0].r[2] - R < near_cloth) {
    p->stage[RAIL].left_out++;
    return;
  }
  const double as_is = own.type == e->type
                           ? velocities_apart(own.after[0].v, own.after[0].w, &e->after[0], R)
                           : INFINITY;
  const double larger = R + spacer;
  ball.kind.radius = larger;
  memcpy(ball.state.r, e->after[0].r, sizeof ball.state.r);
  for (int k = 0; k < 3; k++)
    ball.state.w[k] *= R / larger;
  carom_event moved = first_event(&line->table->table, &ball, 1, NULL);
  for (int k = 0; k < 3; k++)
    moved.after[0].w[k] *= larger / R;
  note(p, RAIL, as_is,
       moved.type == e->type ? velocities_apart(moved.after[0].v, moved.after[0].w, &e->after[0], R)
                             : INFINITY);
}

/* What carom has next, from the states after the event before. */
static void compare_next(const shot_line *line, const carom_shot *past, const carom_event *e,
                         const json_t *json, parity_job *p) {
  carom_shot_ball balls[CAROM_BALLS_MOST];
  carom_ball_state now[CAROM_BALLS_MOST];
  const double since = past->count > 0 ? past->events[past->count - 1].time : 0.0;
  carom_shot_at(line->ball, line->count, past, since, now);
  for (int i = 0; i < line->count; i++) {
    balls[i] = (carom_shot_ball){line->ball[i].kind, now[i]};
    carom_ball_state *s = &balls[i].state;
    if (s->label == CAROM_BALL_ROLLING) { /* without what rounding leaves of the slip, since
                                             labels are derived */
      s->w[0] = -s->v[1] / balls[i].kind.radius;
      s->w[1] = s->v[0] / balls[i].kind.radius;
    }
  }
  const carom_event own = first_event(&line->table->table, balls, line->count, NULL);
  if (same_event(line, &own, e, json)) {
    const double d = fabs(since + own.time - e->time);
    note(p, NEXT, d, d);
    return;
  }
  p->stage[NEXT].left_out++;
  if (p->all)
    complain("line %zu: event %lld: pooltool has %s next, carom %s", line->number,
             (long long)past->count, e->type == 0 ? "nothing" : shot_event_name(e->type),
             own.type < 0    ? "refuses the states"
             : own.type == 0 ? "nothing"
                             : shot_event_name(own.type));
}

static bool compare_in_space(const shot_line *line, parity_job *p, char why[200]) {
  const json_t *events = json_object_get(line->json, "events");
  const size_t count = json_array_size(events);
  carom_event *record = allocate(count + 1, sizeof *record);
  carom_shot past = {.events = record, .room = (int64_t)count, .time = INFINITY};
  bool good = true;
  for (size_t k = 0; k < count && good; k++) {
    const json_t *json = json_array_get(events, k);
    carom_event *e = &record[k];
    if (!read_event(line, json, e)) {
      snprintf(why, 200, "event %zu: it is not an event of these balls with states", k);
      good = false;
      break;
    }
    /* the states before it are those after the balls' last events, moved */
    past.count = (int64_t)k;
    carom_ball_state moved[CAROM_BALLS_MOST];
    if (carom_shot_at(line->ball, line->count, &past, e->time, moved) == CAROM_OK)
      for (int side = 0; side < (e->type == CAROM_EVENT_BALL_BALL ? 2 : 1); side++) {
        const int i = side == 0 ? e->a : e->b;
        const double d = states_apart(&moved[i], &e->before[side], line->ball[i].kind.radius);
        note(p, MOTION, d, d);
      }
    if (e->type == CAROM_EVENT_STRIKE)
      compare_strike(line, e, p);
    else
      compare_next(line, &past, e, json, p);
    if (e->type == CAROM_EVENT_SLATE)
      compare_slate(line, e, p);
    else if (e->type == CAROM_EVENT_BALL_BALL)
      compare_spheres(line, e, p);
    else if (e->type == CAROM_EVENT_RAIL)
      compare_rail(line, e, p);
    p->events++;
  }
  p->ended += json_object_get(line->json, "fails") != NULL;
  free(record);
  return good;
}

/* ---- Tables. Whether all agrees. */

static bool print_space(const parity_job *p) {
  bool good = p->bad == 0;
  printf("%ld shots in space, %ld events; pooltool ended %ld of the shots by an error\n\n",
         p->in_space, p->events, p->ended);
  printf("%-20s %9s %9s %7s %10s %10s\n", "what", "compared", "left out", "apart", "as it is",
         "its rule");
  for (int k = 0; k < STAGES; k++) {
    const stage_tally *s = &p->stage[k];
    printf("%-20s %9ld %9ld %7ld %10.2g %10.2g\n", stages[k].name, s->compared, s->left_out,
           s->apart, s->as_is, s->by_rule);
    good = good && s->compared > 0 && s->by_rule <= stages[k].allowed;
  }
  return good;
}

static void print_row(const row *f) {
  printf("%-16s %5zu %7zu %6zu %6zu %10.2g %10.2g\n", f->name, f->shots, f->events, f->agreed,
         f->whole, f->time, f->state);
}

static bool print_families(const parity_job *job) {
  row all = {.name = "all"};
  printf("%-16s %5s %7s %6s %6s %10s %10s\n", "family", "shots", "events", "agreed", "whole",
         "time", "state");
  for (const row *f = job->each; f < job->each + job->count; f++) {
    print_row(f);
    all.shots += f->shots;
    all.events += f->events;
    all.agreed += f->agreed;
    all.whole += f->whole;
    all.time = fmax(all.time, f->time);
    all.state = fmax(all.state, f->state);
    free(f->name);
  }
  print_row(&all);
  return all.agreed == all.shots;
}

static const command_form form = {
    .name = "parity",
    .usage = "[OPTIONS] IN.jsonl",
    .about = "Plays recorded shots by pooltool's rules and models, and compares every event with "
             "pooltool's record, up to the first event that rounding errors can change, as the "
             "recording says.\n",
    .options = (const option_row *const[]){&option_verbose, NULL},
    .details =
        "columns: shots; events compared; shots that agree; shots that agree to their end, where "
        "the recording has no chaos; largest difference of times, and of states, over the allowed "
        "1e-12 + 5e-13 times the amplification\n\n"
        "shots recorded in space (data/shots-space.jsonl): carom begins anew at each recorded "
        "event; columns: what is compared where the rules permit it, and what not; where the "
        "results are apart; largest difference by carom's own rules and by pooltool's\n\n"
        "exit code: 0 if all agree, 1 if one does not, 2 for bad usage or unreadable input\n",
    .example = "carom-lab parity data/shots-pooltool.jsonl",
    .files = ONE_FILE,
};

int command_parity(int argc, char **argv) {
  parity_job job = {.all = false};
  const char *path, *text;
  const int code = parse_arguments(&form, argc, argv, &job, &path);
  if (code >= 0)
    return code;
  shot_file *file = shot_file_open(path);
  if (file == NULL)
    return EXIT_USAGE;
  shot_line line;
  shot_read what;
  while ((what = shot_file_next(file, &line, &text)) == SHOT_SHOT || what == SHOT_TABLE) {
    if (what == SHOT_TABLE)
      continue;
    char why[200] = "";
    if (strcmp(shot_file_engine(file), "space") != 0)
      play_flat(&job, &line, shot_file_engine(file));
    else if (job.in_space++, line.error != NULL || !compare_in_space(&line, &job, why)) {
      complain("line %zu: shot %s: %s", line.number, line.id != NULL ? line.id : "-",
               line.error != NULL ? line.error : why);
      job.bad++;
    }
    shot_line_free(&line);
  }
  shot_file_close(file);
  if (what != SHOT_END || job.count + (size_t)job.in_space == 0) {
    complain("%s has no shots", path);
    return EXIT_USAGE;
  }
  bool good = job.in_space == 0 || print_space(&job);
  if (job.count > 0)
    good &= print_families(&job);
  free(job.each);
  return good ? EXIT_GOOD : EXIT_SOME;
}
