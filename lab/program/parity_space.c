/* Shots that pooltool recorded in space, beside carom, event by event. Whole shots differ by design, since the rules of some
 * events differ (docs/using/shots.md). So carom begins anew at each event of the record: with the states that pooltool had
 * after the event before, what happens next, and when; and with the state before the event, what is the state after it.
 *
 * Each model is compared as it is, and again with pooltool's rule in the place of carom's, by means of the public interface:
 *
 *   STRIKE. Squirt turns pooltool's ball about the vertical, and so keeps v_z.
 *   SLATE. carom's v' = sqrt(e^2 v_n^2 - s^2) is pooltool's e v_n for e' = sqrt(e^2 v_n^2 + s^2) / v_n, up to the most that a
 * ball may have. Where a ball sticks, pooltool multiplies w_z by 2/7; else it keeps w_z, as carom does where nothing slows
 * turning on the spot. A rebound below 5 mm becomes 0. SPHERES. Friction mu e v_n / 2 is carom's mu' (1 + e) v_n / 2 for mu' =
 * 2 e mu / (1 + e). RAIL. pooltool moves the ball until its gap to the nose is 1 um; carom's ball is larger by that, and has
 * the same R w. */
#include "parity_space.h"

#include "memory.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double hop_loss = 0.02, restitution_most = 0.98, least_height = 0.005, spacer = 1e-6, near_cloth = 1e-3;
static const double rounding = 1e-9; /* above that two models differ as they are */

static const struct {
  const char *name;
  double allowed;
  bool has_rule;
} stages[SPACE_STAGES] = {
    [SPACE_STRIKE] = {"strike", 1e-12, true},
    [SPACE_MOTION] = {"motion", 1e-11, false},
    [SPACE_NEXT] = {"next event", 1e-11, false},
    [SPACE_POCKET] = {"pocket: time", INFINITY, false},
    [SPACE_SLATE] = {"slate", 1e-12, true},
    [SPACE_SPHERES] = {"two balls", 1e-12, true},
    [SPACE_RAIL] = {"rail", 1e-9, true},
    [SPACE_NEAR] = {"rail, below 1 mm", INFINITY, false},
    [SPACE_LYING] = {"rail, on the cloth", INFINITY, false},
};

static void note(space_parity *p, int stage, double as_is, double by_rule) {
  space_stage *s = &p->stage[stage];
  s->compared++;
  s->apart += !(as_is <= rounding);
  s->as_is = fmax(s->as_is, as_is);
  s->by_rule = fmax(s->by_rule, by_rule);
}

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
  const size_t first = e->type == CAROM_EVENT_STRIKE ? 1 : 0, sides = e->type == CAROM_EVENT_BALL_BALL ? 2 : 1;
  e->a = ball_of(line, json_array_get(ids, first));
  e->b = sides == 2 ? ball_of(line, json_array_get(ids, 1)) : -1;
  for (size_t k = 0; k < sides; k++)
    if (!read_state(json_array_get(json_array_get(json, 3), k), &e->before[k]) ||
        !read_state(json_array_get(json_array_get(json, 4), k), &e->after[k]))
      return false;
  return e->type != 0 && e->a >= 0 && (sides == 1 || e->b >= 0);
}

/* ---- One event of carom */

static const carom_shot_options stops = {.stop_at =
                                             ~CAROM_STOP_AT_CONTACT & ((UINT64_C(1) << (CAROM_EVENT_LEFT_TABLE + 1)) - 1),
                                         .cushion_model = CAROM_SHOT_CUSHION_HAN};

/* The first event from these states on; type 0 where there is none, and -1 where carom refuses them. */
static carom_event first_event(const carom_table *table, const carom_shot_ball *balls, int count, const carom_cue *cue) {
  carom_event e = {0};
  carom_shot shot = {.events = &e, .room = 1};
  const carom_status status = carom_shoot(table, balls, count, cue, &stops, &shot);
  if (status < 0)
    e.type = -1;
  return e;
}

/* The largest difference of velocities, and of spins times the radius. */
static double velocities_apart(const double v[3], const double w[3], const carom_ball_state *s, double R) {
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

static void compare_strike(const shot_line *line, const carom_event *e, space_parity *p) {
  const carom_event own = first_event(&line->table->table, line->ball, line->count, &line->cue);
  const double R = line->ball[e->a].kind.radius;
  const double as_is = own.type == CAROM_EVENT_STRIKE ? states_apart(&own.after[0], &e->after[0], R) : INFINITY;
  carom_motion flat;
  if (carom_strike(&line->cue, &line->ball[e->a].kind, &flat) == CAROM_OK)
    flat.v[2] = -hypot(flat.v[0], flat.v[1]) * tan(line->cue.theta * acos(-1.0) / 180.0);
  note(p, SPACE_STRIKE, as_is, velocities_apart(flat.v, flat.w, &e->after[0], R));
}

static void compare_slate(const shot_line *line, const carom_event *e, space_parity *p) {
  carom_shot_ball ball = {line->ball[e->a].kind, e->before[0]};
  carom_event own = first_event(&line->table->table, &ball, 1, NULL);
  const double R = ball.kind.radius, e_t = ball.kind.restitution_table > 0.0 ? ball.kind.restitution_table : 0.5;
  const double as_is = own.type == CAROM_EVENT_SLATE ? states_apart(&own.after[0], &e->after[0], R) : INFINITY;
  const double v_n = -e->before[0].v[2], up = e_t * v_n;
  /* pooltool's rules */
  ball.kind.restitution_table = sqrt(up * up + hop_loss * hop_loss) / v_n;
  ball.kind.mu_spin = 1e-300;
  if (own.type < 0 || !(ball.kind.restitution_table <= restitution_most)) {
    p->stage[SPACE_SLATE].left_out++;
    return;
  }
  own = first_event(&line->table->table, &ball, 1, NULL);
  carom_ball_state *s = &own.after[0];
  const double slip = hypot(e->before[0].v[0] - R * e->before[0].w[1], e->before[0].v[1] + R * e->before[0].w[0]);
  if (2.0 / 7.0 * slip <= ball.kind.mu_slide * (v_n + up)) {
    s->w[2] *= 2.0 / 7.0;
    p->stick++;
  }
  if (up * up < 2.0 * ball.kind.gravity * least_height) {
    s->v[2] = 0.0;
    p->stay++;
  }
  note(p, SPACE_SLATE, as_is, own.type == CAROM_EVENT_SLATE ? states_apart(s, &e->after[0], R) : INFINITY);
}

/* The size of the slip between two balls. */
static double slip_of(const carom_impact *in) {
  double n[3], v[3], W[3], size = 0.0, v_n = 0.0, slip = 0.0;
  for (int k = 0; k < 3; k++) {
    n[k] = in->b.r[k] - in->a.r[k];
    size += n[k] * n[k];
    v[k] = in->a.v[k] - in->b.v[k];
    W[k] = in->a.radius * in->a.w[k] + in->b.radius * in->b.w[k];
  }
  for (int k = 0; k < 3; k++) {
    n[k] /= sqrt(size);
    v_n += v[k] * n[k];
  }
  for (int k = 0; k < 3; k++) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    const double u = v[k] - v_n * n[k] + W[i] * n[j] - W[j] * n[i];
    slip += u * u;
  }
  return sqrt(slip);
}

/* Whether pooltool exchanges a tenth of the velocity after the collision: both move alike, and part slowly. */
static bool exchanges(const carom_impact *in, const carom_result *out) {
  double n = 0.0, apart = 0.0, dot = 0.0, v_a = 0.0, v_b = 0.0;
  for (int k = 0; k < 3; k++) {
    const double d = in->b.r[k] - in->a.r[k];
    n += d * d;
    apart += d * (out->b.v[k] - out->a.v[k]);
    dot += out->a.v[k] * out->b.v[k];
    v_a += out->a.v[k] * out->a.v[k];
    v_b += out->b.v[k] * out->b.v[k];
  }
  return fabs(apart) < 0.01 * sqrt(n) && dot > 0.9 * sqrt(v_a * v_b);
}

static void compare_spheres(const shot_line *line, const carom_event *e, space_parity *p) {
  carom_impact in = {.restitution = 0.5 * (line->ball[e->a].kind.restitution + line->ball[e->b].kind.restitution)};
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
    in.mu_ball = (law.a + law.b * exp(-law.c * slip_of(&in))) * (rule ? 2.0 * in.restitution / (1.0 + in.restitution) : 1.0);
    apart[rule] = INFINITY;
    if (carom_impact3(&in, &out) == CAROM_OK)
      apart[rule] =
          fmax(velocities_apart(out.a.v, out.a.w, &e->after[0], R), velocities_apart(out.b.v, out.b.w, &e->after[1], R));
  }
  if (exchanges(&in, &out))
    p->stage[SPACE_SPHERES].left_out++;
  else
    note(p, SPACE_SPHERES, apart[0], apart[1]);
}

static void compare_rail(const shot_line *line, const carom_event *e, space_parity *p) {
  const carom_ball_kind kind = line->ball[e->a].kind;
  const double R = kind.radius, above = e->before[0].r[2] - R;
  carom_shot_ball ball = {kind, e->before[0]};
  const carom_event own = first_event(&line->table->table, &ball, 1, NULL);
  if (own.type < 0) {
    p->stage[SPACE_RAIL].left_out++;
    return;
  }
  const double as_is = own.type == e->type ? velocities_apart(own.after[0].v, own.after[0].w, &e->after[0], R) : INFINITY;
  if (e->before[0].label != CAROM_BALL_AIRBORNE || above < near_cloth) {
    const int stage = e->before[0].label == CAROM_BALL_AIRBORNE ? SPACE_NEAR : SPACE_LYING;
    note(p, stage, as_is, as_is);
    return;
  }
  const double larger = R + spacer;
  ball.kind.radius = larger;
  memcpy(ball.state.r, e->after[0].r, sizeof ball.state.r);
  for (int k = 0; k < 3; k++)
    ball.state.w[k] *= R / larger;
  carom_event moved = first_event(&line->table->table, &ball, 1, NULL);
  for (int k = 0; k < 3; k++)
    moved.after[0].w[k] *= larger / R;
  note(p, SPACE_RAIL, as_is,
       moved.type == e->type ? velocities_apart(moved.after[0].v, moved.after[0].w, &e->after[0], R) : INFINITY);
}

/* ---- The next event */

static const char *name_of(const carom_event *e) {
  return e->type < 0 ? "refused" : e->type == 0 ? "nothing" : shot_event_name(e->type);
}

static bool same(const shot_line *line, const carom_event *own, const carom_event *e, const json_t *json) {
  if (own->type != e->type || own->a != e->a)
    return false;
  if (e->type == CAROM_EVENT_BALL_BALL)
    return own->b == e->b;
  if (e->type < CAROM_EVENT_RAIL || e->type > CAROM_EVENT_POCKET)
    return true;
  const char *met = shot_part_name(line->table, own), *id = json_string_value(json_array_get(json_array_get(json, 2), 1));
  return met != NULL && id != NULL && strcmp(met, id) == 0;
}

/* What carom has next, from the states after the event before. */
static void compare_next(const shot_line *line, const carom_shot *past, const carom_event *e, const json_t *json,
                         space_parity *p) {
  carom_shot_ball balls[CAROM_BALLS_MOST];
  carom_ball_state now[CAROM_BALLS_MOST];
  const double since = past->count > 0 ? past->events[past->count - 1].time : 0.0;
  carom_shot_at(line->ball, line->count, past, since, now);
  for (int i = 0; i < line->count; i++) {
    balls[i] = (carom_shot_ball){line->ball[i].kind, now[i]};
    carom_ball_state *s = &balls[i].state;
    if (s->label == CAROM_BALL_ROLLING) { /* without what rounding leaves of the slip, since labels are derived */
      s->w[0] = -s->v[1] / balls[i].kind.radius;
      s->w[1] = s->v[0] / balls[i].kind.radius;
    }
  }
  const carom_event own = first_event(&line->table->table, balls, line->count, NULL);
  if (same(line, &own, e, json)) {
    const double d = fabs(since + own.time - e->time);
    note(p, e->type == CAROM_EVENT_POCKET ? SPACE_POCKET : SPACE_NEXT, d, d);
    return;
  }
  const char *pooltool = name_of(e), *carom = name_of(&own);
  p->stage[SPACE_NEXT].left_out++;
  for (int k = 0; k < p->others; k++)
    if (strcmp(p->other[k].pooltool, pooltool) == 0 && strcmp(p->other[k].carom, carom) == 0) {
      p->other[k].count++;
      return;
    }
  p->other[p->others++] = (space_other){pooltool, carom, 1};
}

bool space_compare(const shot_line *line, space_parity *p, char why[200]) {
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
        note(p, SPACE_MOTION, d, d);
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
  p->shots++;
  p->ended += json_object_get(line->json, "fails") != NULL;
  free(record);
  return good;
}

bool space_report(const space_parity *p) {
  bool good = p->bad == 0;
  printf("%ld shots in space, %ld events; pooltool ended %ld of the shots by an error\n\n", p->shots, p->events, p->ended);
  printf("%-20s %9s %9s %7s %10s %10s\n", "what", "compared", "left out", "apart", "as it is", "its rule");
  for (int k = 0; k < SPACE_STAGES; k++) {
    const space_stage *s = &p->stage[k];
    printf("%-20s %9ld %9ld %7ld %10.2g ", stages[k].name, s->compared, s->left_out, s->apart, s->as_is);
    if (stages[k].has_rule)
      printf("%10.2g\n", s->by_rule);
    else
      printf("%10s\n", "-");
    good = good && s->compared > 0 && s->by_rule <= stages[k].allowed;
  }
  printf("\n%ld landings stick, %ld rebounds below 5 mm become 0\n", p->stick, p->stay);
  printf("\n%-24s %-24s %6s\n", "next: pooltool", "carom", "events");
  for (int k = 0; k < p->others; k++)
    printf("%-24s %-24s %6ld\n", p->other[k].pooltool, p->other[k].carom, p->other[k].count);
  return good;
}
