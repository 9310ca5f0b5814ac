/* A shot as moments of its balls, from its events.
 *
 * Contacts of one instant, as in a rack that breaks, change a ball at the first of them alone, so
 * the others are left out; contacts with one ball within SAME_CONTACT are one. A ball passes
 * another where the gap between them has a minimum below a radius and they never meet: found by
 * samples and the golden section. */
#include "shots/shot_story.h"

#include "program/program.h"
#include "rows/number.h"
#include "rows/quantities.h"

#include <ctype.h>

enum { SAMPLES = 1024, REFINEMENTS = 40 };
/* where more balls move, all but that of the cue are told shortly */
enum { MOST_TOLD = 4 };
enum { MOST_MOMENTS = 512 };
/* m: lower hops are not told */
static const double hop_least = 1e-3;

typedef enum moment_kind {
  MOMENT_LEAVES, /* the ball of the cue, struck */
  MOMENT_MEETS,  /* another ball; value: the cut, degrees, NaN where that ball moves */
  MOMENT_RAIL,   /* a cushion; value: where, in diamonds */
  MOMENT_JAW,    /* the cut of a pocket, or its jaw */
  MOMENT_ROLLS,  /* it rolls from here on */
  MOMENT_FLIES,  /* it leaves the cloth; value: how high it rises above it, m */
  MOMENT_LANDS,  /* on the slate; value: how far it flew, m */
  MOMENT_PASSES, /* another ball, without contact; value: the gap, m */
  MOMENT_FALLS,  /* into a pocket */
  MOMENT_OFF,    /* it leaves the table */
  MOMENT_RESTS,
  MOMENT_MOVES /* still, at the end */
} moment_kind;

typedef struct moment {
  moment_kind kind;
  int with; /* a ball, a rail or a pocket; -1 */
  double time, x, y, value;
  double speed, direction; /* just after, m/s and degrees counterclockwise from +x; NaN at rest */
} moment;

/* The moments of a ball, in their order. */
typedef struct story {
  int count;
  moment moment[MOST_MOMENTS];
} story;

static bool has_ball(const carom_event *e, int ball) {
  return shot_event_side(e, ball) >= 0;
}

/* ---- What counts */

static double length_of(const carom_rail *r) {
  return plane_distance(r->q, r->p);
}

bool is_cushion(const carom_table *t, int rail) {
  double longest = 0.0;
  for (int r = 0; r < t->rails; r++)
    longest = fmax(longest, length_of(&t->rail[r]));
  return length_of(&t->rail[rail]) > 0.2 * longest;
}

bool counts_as_rail(const shot_line *line, const carom_shot *shot, int64_t k, int ball) {
  const carom_event *e = &shot->events[k];
  const carom_table *t = &line->table->table;
  bool counts = e->type == CAROM_EVENT_RAIL && e->a == ball && is_cushion(t, (int)e->b);
  for (int64_t earlier = k - 1;
       earlier >= 0 && counts && e->time - shot->events[earlier].time < SAME_CONTACT; earlier--)
    counts = !(shot->events[earlier].type == e->type && shot->events[earlier].a == ball &&
               shot->events[earlier].b == e->b);
  return counts;
}

bool ball_moved(const carom_shot *shot, int ball) {
  for (int64_t k = 0; k < shot_events_kept(shot); k++)
    if (has_ball(&shot->events[k], ball))
      return true;
  return false;
}

/* ---- Places in words */

const char *rail_words(const named_table *t, int rail, char text[WHERE_TEXT]) {
  const char *name = carom_rail_name(&t->table, rail);
  if (name != NULL)
    snprintf(text, WHERE_TEXT, "the %.40s rail", name);
  else
    snprintf(text, WHERE_TEXT, "rail %.40s", t->rail[rail]);
  return text;
}

const char *pocket_words(const named_table *t, int pocket, char text[WHERE_TEXT]) {
  const char *name = carom_pocket_name(&t->table, pocket);
  if (name != NULL)
    snprintf(text, WHERE_TEXT, "the %.40s pocket", name);
  else
    snprintf(text, WHERE_TEXT, "pocket %.40s", t->pocket[pocket]);
  return text;
}

/* "the left rail": the rail beyond which a place lies. */
static const char *side_words(const named_table *t, double x, double y) {
  static const char *const sides[] = {"the left rail", "the right rail", "the head rail",
                                      "the foot rail"};
  const double beyond[4] = {-x, x - t->table.width, -y, y - t->table.length};
  int side = 0;
  for (int k = 1; k < 4; k++)
    if (beyond[k] > beyond[side])
      side = k;
  return sides[side];
}

static int nearest_pocket(const carom_table *t, const double r[2]) {
  int nearest = -1;
  double least = (double)INFINITY;
  for (int k = 0; k < t->pockets; k++) {
    const double d = plane_distance(t->pocket[k].centre, r);
    if (d < least) {
      nearest = k;
      least = d;
    }
  }
  return nearest;
}

double diamonds_at(const carom_table *t, int rail, const double r[2]) {
  const char *name = carom_rail_name(t, rail);
  if (name == NULL)
    return (double)NAN;
  const bool is_long = name[0] == 'l' || name[0] == 'r'; /* left, right */
  return is_long ? 8.0 * r[1] / t->length : 4.0 * r[0] / t->width;
}

/* ---- Moments */

/* Degrees from 0 to 360, counterclockwise from +x; NaN of a ball at rest. */
static double direction_of(const double v[3]) {
  if (!(plane_size(v) > 0.0))
    return (double)NAN;
  const double turn = atan2(v[1], v[0]) / degree;
  return turn < 0.0 ? turn + 360.0 : turn;
}

static moment moment_at(moment_kind kind, double time, const carom_ball_state *s) {
  return (moment){.kind = kind,
                  .with = -1,
                  .time = time,
                  .x = s->r[0],
                  .y = s->r[1],
                  .value = (double)NAN,
                  .speed = plane_size(s->v),
                  .direction = direction_of(s->v)};
}

/* The cut of a ball on another one at rest, degrees; NaN where the other one moves. */
static double cut_of(const carom_ball_state *mover, const carom_ball_state *target) {
  const double along[2] = {target->r[0] - mover->r[0], target->r[1] - mover->r[1]};
  if (plane_size(target->v) != 0.0 || !(plane_size(mover->v) > 0.0))
    return (double)NAN;
  return fabs(angle_between(mover->v, along));
}

/* Whether a contact is part of a push, while the tip is on the ball of the cue: the motion before
 * it is not known, as that ball has the motion after the push. */
static bool is_push(const carom_shot *shot, const carom_event *e) {
  const carom_event *first = &shot->events[0];
  return e->cluster > 0 && first->type == CAROM_EVENT_STRIKE && e->time == first->time;
}

/* The moment of an event, if it is one that is told. */
static bool moment_of(const shot_line *line, const carom_shot *shot, int64_t k, int ball,
                      moment *m) {
  const carom_event *e = &shot->events[k];
  const carom_table *t = &line->table->table;
  const int side = e->a == ball ? 0 : 1;
  *m = moment_at(MOMENT_LEAVES, e->time, &e->after[side]);
  switch (e->type) {
  case CAROM_EVENT_STRIKE:
    return true;
  case CAROM_EVENT_BALL_BALL:
    m->kind = MOMENT_MEETS;
    m->with = (int)(side == 0 ? e->b : e->a);
    if (!is_push(shot, e))
      m->value = cut_of(&e->before[side], &e->before[1 - side]);
    return true;
  case CAROM_EVENT_RAIL:
  case CAROM_EVENT_JAW:
    m->kind = MOMENT_JAW;
    m->with = nearest_pocket(t, e->after[0].r);
    if (e->type == CAROM_EVENT_RAIL && is_cushion(t, (int)e->b)) {
      m->kind = MOMENT_RAIL;
      m->with = (int)e->b;
      m->value = diamonds_at(t, m->with, e->after[0].r);
      return counts_as_rail(line, shot, k, ball);
    }
    return true;
  case CAROM_EVENT_SLIDING_ROLLING:
    m->kind = MOMENT_ROLLS;
    return true;
  case CAROM_EVENT_POCKET:
    m->kind = MOMENT_FALLS;
    m->with = (int)e->b;
    return true;
  case CAROM_EVENT_LEFT_TABLE:
    m->kind = MOMENT_OFF;
    return true;
  default:
    return false;
  }
}

/* ---- Balls that pass */

static double gap_at(const shot_line *line, const carom_shot *shot, int a, int b, double time) {
  carom_ball_state s[CAROM_BALLS_MOST];
  carom_shot_at(line->ball, line->count, shot, time, s);
  if (s[a].label == CAROM_BALL_POCKETED || s[b].label == CAROM_BALL_POCKETED)
    return (double)INFINITY;
  const double d[3] = {s[a].r[0] - s[b].r[0], s[a].r[1] - s[b].r[1], s[a].r[2] - s[b].r[2]};
  return sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]) - line->ball[a].kind.radius -
         line->ball[b].kind.radius;
}

static bool ever_meet(const carom_shot *shot, int a, int b) {
  for (int64_t k = 0; k < shot_events_kept(shot); k++)
    if (shot->events[k].type == CAROM_EVENT_BALL_BALL && has_ball(&shot->events[k], a) &&
        has_ball(&shot->events[k], b))
      return true;
  return false;
}

/* The least gap of two balls on the way, where it is below a radius, as a moment of `ball`. */
static bool passes(const shot_line *line, const carom_shot *shot, int ball, int passed, moment *m) {
  double gap[SAMPLES + 1];
  int least = 0;
  for (int k = 0; k <= SAMPLES; k++) {
    gap[k] = gap_at(line, shot, ball, passed, shot->time * k / SAMPLES);
    if (gap[k] < gap[least])
      least = k;
  }
  /* at the ends they only begin or rest side by side */
  if (least == 0 || gap[least] >= gap[SAMPLES])
    return false;
  double early = shot->time * (least - 1) / SAMPLES, late = shot->time * (least + 1) / SAMPLES;
  for (int k = 0; k < REFINEMENTS; k++) {
    const double first = early + 0.382 * (late - early);
    const double second = early + 0.618 * (late - early);
    if (gap_at(line, shot, ball, passed, first) < gap_at(line, shot, ball, passed, second))
      late = second;
    else
      early = first;
  }
  carom_ball_state s[CAROM_BALLS_MOST];
  const double time = 0.5 * (early + late);
  carom_shot_at(line->ball, line->count, shot, time, s);
  *m = moment_at(MOMENT_PASSES, time, &s[ball]);
  m->with = passed;
  m->value = gap_at(line, shot, ball, passed, time);
  if (m->value > line->ball[ball].kind.radius)
    return false;
  /* of two that move the faster one passes */
  const double speed = plane_size(s[ball].v), passed_speed = plane_size(s[passed].v);
  return speed > passed_speed || (speed == passed_speed && ball < passed);
}

/* ---- The story of a ball */

/* Adds a contact with another ball; `last_contact` is the time of the previous contact. Of contacts
 * at one instant the first counts. A ball that is pushed along is met once, and left when it is met
 * last: its start to roll between the two is left out. */
static void add_contact(story *s, const moment *m, double *last_contact) {
  int last = s->count - 1;
  if (last >= 0 && s->moment[last].kind == MOMENT_MEETS && s->moment[last].time == m->time)
    return;
  const bool is_soon = m->time - *last_contact < SAME_CONTACT;
  *last_contact = m->time;
  if (last > 0 && s->moment[last].kind == MOMENT_ROLLS)
    last--;
  if (last >= 0 && s->moment[last].kind == MOMENT_MEETS && s->moment[last].with == m->with &&
      is_soon) {
    s->moment[last].speed = m->speed;
    s->moment[last].direction = m->direction;
    s->count = last + 1;
  } else
    s->moment[s->count++] = *m;
}

/* How high a ball that leaves a place so rises above the cloth, m. */
static double height_of(const carom_ball_kind *kind, const carom_ball_state *s) {
  const double up = fmax(s->v[2], 0.0);
  return s->r[2] - kind->radius + up * up / (2.0 * kind->gravity);
}

/* Adds the flight of a ball that begins with event k and ends with the next one of the ball. */
static void add_flight(const shot_line *line, const carom_shot *shot, int64_t k, int ball,
                       story *s) {
  const carom_ball_state *start = &shot->events[k].after[shot_event_side(&shot->events[k], ball)];
  const double height = height_of(&line->ball[ball].kind, start);
  const int64_t count = shot_events_kept(shot);
  int64_t next = k + 1;
  while (next < count && !has_ball(&shot->events[next], ball))
    next++;

  /* of contacts at one instant the last one sends it off */
  const bool ends = next < count;
  const bool repeats = ends && shot->events[next].time == shot->events[k].time;
  if (start->label != CAROM_BALL_AIRBORNE || height < hop_least || repeats)
    return;
  moment flies = moment_at(MOMENT_FLIES, shot->events[k].time, start);
  flies.value = height;
  s->moment[s->count++] = flies;
  if (!ends || shot->events[next].type != CAROM_EVENT_SLATE)
    return;
  moment lands = moment_at(MOMENT_LANDS, shot->events[next].time, &shot->events[next].after[0]);
  lands.value = hypot(lands.x - flies.x, lands.y - flies.y);
  s->moment[s->count++] = lands;
}

/* Adds the moments of the events of a ball; returns the time of the last event. */
static double add_events(const shot_line *line, const carom_shot *shot, int ball, story *s) {
  const int most = MOST_MOMENTS - 2 * CAROM_BALLS_MOST; /* with room for its end and those passed */
  double last = 0.0, last_contact = -INFINITY;
  for (int64_t k = 0; k < shot_events_kept(shot) && s->count < most; k++) {
    moment m;
    if (!has_ball(&shot->events[k], ball))
      continue;
    last = shot->events[k].time;
    if (moment_of(line, shot, k, ball, &m)) {
      if (m.kind == MOMENT_MEETS)
        add_contact(s, &m, &last_contact);
      else
        s->moment[s->count++] = m;
    }
    add_flight(line, shot, k, ball, s);
  }
  return last;
}

/* Adds where a ball that stays on the table ends; `last` is the time of its last event. */
static void add_end(const carom_shot *shot, int ball, double last, story *s) {
  const carom_ball_state *final = &shot->final[ball];
  if (final->label == CAROM_BALL_STATIONARY)
    s->moment[s->count++] = moment_at(MOMENT_RESTS, last, final);
  else if (final->label != CAROM_BALL_POCKETED && final->label != CAROM_BALL_OFF)
    s->moment[s->count++] = moment_at(MOMENT_MOVES, shot->time, final);
}

/* Adds the balls that it passes without contact, each at its time. */
static void add_passes(const shot_line *line, const carom_shot *shot, int ball, story *s) {
  for (int passed = 0; passed < line->count; passed++) {
    moment m;
    if (passed == ball || ever_meet(shot, ball, passed) || !passes(line, shot, ball, passed, &m))
      continue;
    int index = s->count++;
    for (; index > 0 && s->moment[index - 1].time > m.time; index--)
      s->moment[index] = s->moment[index - 1];
    s->moment[index] = m;
  }
}

static void story_of(const shot_line *line, const carom_shot *shot, int ball, story *s) {
  s->count = 0;
  const double last = add_events(line, shot, ball, s);
  add_end(shot, ball, last, s);
  add_passes(line, shot, ball, s);
}

/* ---- Rows */

static void put_number(FILE *out, double x) {
  char text[NUMBER_TEXT];
  putc(',', out);
  if (!isnan(x))
    fputs(number_text(x, text), out);
}

/* The number that a moment of one kind has; NaN of another kind. */
static double value_of_kind(const moment *m, moment_kind kind) {
  return m->kind == kind ? m->value : (double)NAN;
}

/* The ball, rail, pocket or side of the table that a moment is with; "" where there is none. */
static const char *with_words(const shot_line *line, const moment *m, char text[WHERE_TEXT]) {
  switch (m->kind) {
  case MOMENT_MEETS:
  case MOMENT_PASSES:
    return line->name[m->with];
  case MOMENT_RAIL:
    return rail_words(line->table, m->with, text);
  case MOMENT_JAW:
    return m->with >= 0 ? pocket_words(line->table, m->with, text) : "";
  case MOMENT_FALLS:
    return pocket_words(line->table, m->with, text);
  case MOMENT_OFF:
    return side_words(line->table, m->x, m->y);
  default:
    return "";
  }
}

static void write_moment(FILE *out, const moment *m) {
  put_number(out, m->time);
  put_number(out, m->x);
  put_number(out, m->y);
  put_number(out, m->speed);
  put_number(out, m->direction);
  put_number(out, value_of_kind(m, MOMENT_MEETS));
  put_number(out, value_of_kind(m, MOMENT_RAIL));
  put_number(out, 1e3 * value_of_kind(m, MOMENT_PASSES));
  put_number(out, 1e3 * value_of_kind(m, MOMENT_FLIES));
  put_number(out, value_of_kind(m, MOMENT_LANDS));
  putc('\n', out);
}

void story_rows(FILE *out, int number, const shot_line *line, const carom_shot *shot) {
  static const char *const what[] = {"leaves", "meets",  "rail",  "jaw", "rolls", "flies",
                                     "lands",  "passes", "falls", "off", "rests", "moves"};
  static story s;
  for (int ball = 0; ball < line->count; ball++) {
    if (!ball_moved(shot, ball))
      continue;
    story_of(line, shot, ball, &s);
    for (int k = 0; k < s.count; k++) {
      char text[WHERE_TEXT];
      fprintf(out, "%d,\"%s\",%s,%s,%s", number, text_or(line->title, ""), line->name[ball],
              what[s.moment[k].kind], with_words(line, &s.moment[k], text));
      write_moment(out, &s.moment[k]);
    }
  }
}

/* ---- Words */

/* "rests at x = 0.637, y = 0.681 m after 6.16 s"; for a ball that has left the table, where. */
static void tell_end(FILE *out, const shot_line *line, const moment *m) {
  char text[WHERE_TEXT];
  if (m->kind == MOMENT_FALLS)
    fprintf(out, "falls into %s (%s) after %.2f s\n", pocket_words(line->table, m->with, text),
            line->table->pocket[m->with], m->time);
  else if (m->kind == MOMENT_OFF)
    fprintf(out, "leaves the table over %s after %.2f s\n", side_words(line->table, m->x, m->y),
            m->time);
  else
    fprintf(out, "%s at x = %.3f, y = %.3f m after %.2f s\n",
            m->kind == MOMENT_RESTS ? "rests" : "is", m->x, m->y, m->time);
}

/* "meets 1 after 0.32 s at a cut of 20.0 degrees" */
static void tell_contact(FILE *out, const shot_line *line, const moment *m) {
  fprintf(out, "meets %s after %.2f s", line->name[m->with], m->time);
  if (!isnan(m->value))
    fprintf(out, " at a cut of %.1f degrees", m->value);
}

static void tell_direction(FILE *out, const moment *m) {
  if (!(m->speed > 0.0))
    return;
  if (m->kind != MOMENT_LEAVES)
    fputs(", ", out);
  fprintf(out, "leaves at %.1f degrees with %.3g m/s", m->direction, m->speed);
}

/* A moment; the start of a roll stands in the line of the contact before it. */
static void tell_moment(FILE *out, const shot_line *line, const moment *m, bool first) {
  char text[WHERE_TEXT];
  if (m->kind == MOMENT_ROLLS && !first) {
    fprintf(out, ",\n         rolls after %.2f s from x = %.3f, y = %.3f m at %.1f degrees",
            m->time, m->x, m->y, m->direction);
    return;
  }
  if (!first)
    fputs("\n       ", out);
  switch (m->kind) {
  case MOMENT_MEETS:
    tell_contact(out, line, m);
    tell_direction(out, m);
    break;
  case MOMENT_RAIL:
    fprintf(out, "meets %s", rail_words(line->table, m->with, text));
    if (!isnan(m->value))
      fprintf(out, " at diamond %.2f", m->value);
    fprintf(out, " after %.2f s", m->time);
    tell_direction(out, m);
    break;
  case MOMENT_JAW:
    fprintf(out, "meets the jaw of %s after %.2f s",
            m->with >= 0 ? pocket_words(line->table, m->with, text) : "a pocket", m->time);
    tell_direction(out, m);
    break;
  case MOMENT_ROLLS:
    fprintf(out, "rolls after %.2f s at %.1f degrees", m->time, m->direction);
    break;
  case MOMENT_FLIES:
    fprintf(out, "flies %.1f mm high from x = %.3f, y = %.3f m after %.2f s", 1e3 * m->value, m->x,
            m->y, m->time);
    break;
  case MOMENT_LANDS:
    fprintf(out, "lands %.3f m on at x = %.3f, y = %.3f m after %.2f s", m->value, m->x, m->y,
            m->time);
    break;
  case MOMENT_PASSES:
    fprintf(out, "passes %s by %.0f mm after %.2f s", line->name[m->with], 1e3 * m->value, m->time);
    break;
  case MOMENT_LEAVES:
    tell_direction(out, m);
    break;
  default:
    tell_end(out, line, m);
  }
}

/* What the ball of the cue meets first, the cushions of a ball in one line, with the times of the
 * first of them, and its end. */
static void tell_shortly(FILE *out, const shot_line *line, const story *s) {
  enum { MOST_TIMES = 5 };
  int contacts = 0, rails = 0;
  while (contacts < s->count && s->moment[contacts].kind != MOMENT_MEETS)
    contacts++;
  if (s->moment[0].kind == MOMENT_LEAVES && contacts < s->count) {
    tell_contact(out, line, &s->moment[contacts]);
    fputs("; ", out);
  }
  double height = 0.0, far = 0.0; /* of the highest flight */
  for (int k = 0; k < s->count; k++) {
    const moment *m = &s->moment[k];
    rails += m->kind == MOMENT_RAIL;
    if (m->kind == MOMENT_LANDS && m[-1].value == height)
      far = m->value;
    if (m->kind == MOMENT_FLIES && m->value > height) {
      height = m->value;
      far = 0.0;
    }
  }
  fprintf(out, rails == 1 ? "%d rail" : "%d rails", rails);
  const char *separator = " after ";
  for (int k = 0, times = 0; k < s->count && times < MOST_TIMES; k++)
    if (s->moment[k].kind == MOMENT_RAIL) {
      fprintf(out, "%s%.2f", separator, s->moment[k].time);
      separator = ", ";
      times++;
    }
  if (rails > MOST_TIMES)
    fputs(", ...", out);
  fputs(rails > 0 ? " s; " : "; ", out);
  if (height > 0.0)
    fprintf(out, "flies %.1f mm high", 1e3 * height);
  if (far > 0.0)
    fprintf(out, ", %.3f m far", far);
  fputs(text_if(height > 0.0, "; "), out);
  tell_end(out, line, &s->moment[s->count - 1]);
}

static void tell_ball(FILE *out, const shot_line *line, const carom_shot *shot, int ball,
                      bool shortly) {
  static story s;
  story_of(line, shot, ball, &s);
  fprintf(out, "%-6s ", line->name[ball]);
  if (shortly)
    tell_shortly(out, line, &s);
  else
    for (int k = 0; k < s.count; k++)
      tell_moment(out, line, &s.moment[k], k == 0);
}

/* What the cue ball meets before the tip has left it. */
static void tell_push(FILE *out, const shot_line *line, const carom_facts *facts) {
  for (int k = 0; k < line->count; k++)
    if ((facts->pushed & facts->frozen) >> k & 1)
      fprintf(out, "the cue ball is frozen to ball %s and pushes it\n", line->name[k]);
    else if (facts->pushed >> k & 1)
      fprintf(out, "a double hit: ball %s is met while the tip is on the cue ball\n",
              line->name[k]);
  if (facts->touches > 1)
    fprintf(out, "the tip touches the cue ball %s, at %.2f m/s after %.2g s, at %.3f,%.3f\n",
            facts->touches > 2 ? "again and again, first" : "again", facts->second_speed,
            facts->second_time, facts->second_place[0], facts->second_place[1]);
}

/* How far the ball of a level cue leaves beside the direction of the cue, and for which length of
 * the bridge back-hand english needs no correction: that at which a cue that turns about the bridge
 * by the squirt moves its line from the centre to the tip's place. */
static void tell_squirt(FILE *out, const shot_line *line, const double v[3]) {
  const carom_cue *cue = &line->cue;
  const double turn = cue->phi * degree;
  const double squirt = angle_between((const double[]){cos(turn), sin(turn)}, v);
  if (cue->theta != 0.0 || cue->a == 0.0 || fabs(squirt) < 0.005)
    return;
  fprintf(out,
          "squirt %.2f degrees to the %s; the bridge for back-hand english is %.0f mm from the "
          "centre of the ball\n",
          fabs(squirt), left_or_right(squirt),
          1e3 * fabs(cue->a) * line->ball[cue->ball].kind.radius / sin(fabs(squirt) * degree));
}

void shot_tell(FILE *out, const shot_line *line, const carom_shot *shot, const spread *s,
               bool shortly) {
  const carom_cue *cue = &line->cue;
  const double *v = shot->events[0].after[0].v;
  const char *struck = line->name[cue->ball], *number = "";
  if (same_text(struck, "cue")) {
    struck = "cue ball";
  } else if (isdigit((unsigned char)struck[0])) {
    number = "ball ";
  }
  fprintf(out, "%s table, cue at %.4g m/s, %s%s at %.4g m/s, aim %.2f degrees", line->table->id,
          cue->speed, number, struck, plane_size(v), cue->phi);
  if (cue->theta != 0.0)
    fprintf(out, ", cue raised by %.4g degrees", cue->theta);
  if (cue->a == 0.0 && cue->b == 0.0)
    fputs(", tip at the centre\n", out);
  else
    fputs(", tip ", out);
  if (cue->a != 0.0)
    fprintf(out, "%.3g R %s%s", fabs(cue->a), left_or_right(cue->a),
            cue->b != 0.0 ? " and " : " of the centre\n");
  if (cue->b != 0.0)
    fprintf(out, "%.3g R %s the centre\n", fabs(cue->b), above_or_below(cue->b));
  tell_squirt(out, line, v);
  if (shot->facts != NULL)
    tell_push(out, line, shot->facts);
  int moved = 0;
  for (int k = 0; k < line->count; k++)
    moved += ball_moved(shot, k);
  for (int k = 0; k < line->count; k++)
    if (ball_moved(shot, k)) {
      tell_ball(out, line, shot, k, shortly || (moved > MOST_TOLD && k != cue->ball));
      if (s != NULL && shot->final[k].label != CAROM_BALL_POCKETED)
        spread_tell_ball(out, s, k);
    }
  if (s != NULL)
    spread_tell(out, s, line);
}
