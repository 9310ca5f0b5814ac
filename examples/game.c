/* A game of eight-ball between two programs, and the same game once more from its record.
 *
 * The core of a game, without pictures: the state between shots, the rules, a player that tries
 * shots, and the record. A record is the seed of the rack and a few doubles a shot: where the
 * cue ball was put, and the cue. Played again with options.plain it gives the same bits on every
 * machine that has the same carom_physics_revision(). So two machines that send each other these
 * doubles play in lockstep; it is the doubles that count, not what is printed of them.
 *
 * The player plays all its candidates in one batch, with brief events and final states only, and
 * takes the best outcome. It aims as people do, at the ghost ball: where the cue ball is when it
 * touches the object ball on the line to the pocket.
 *
 * Rules: the first ball hit must be of the player's group; after that a ball must fall or reach
 * a cushion; a foul gives ball in hand; who pots a ball of the group without a foul goes on; the
 * eight wins when the group is gone, else it loses. Pockets are not called. An eight that falls
 * on the break is put back. */
#include "carom_shot.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

enum { BALLS = 16, EIGHT = 8, ROOM = 400, CANDIDATES = 256, MOST_SHOTS = 150 };
enum { SOLIDS = 1, STRIPES = 2 };

/* ---- The state, and what goes over the wire */

typedef struct game {
  carom_table table;
  carom_shot_ball balls[BALLS];
  int player, group[2]; /* group: 0 while the table is open */
  int shots, winner;    /* winner: -1 while nobody has won */
  bool in_hand;
} game;

typedef struct move {
  double x, y; /* of the cue ball, where it is in hand */
  carom_cue cue;
} move;

static void begin(game *g, uint64_t seed) {
  memset(g, 0, sizeof *g);
  carom_table_make(CAROM_TABLE_POOL_9FT, &g->table);
  carom_rack(CAROM_RACK_EIGHTBALL, &g->table, 1e-4, seed, g->balls, BALLS);
  g->winner = -1;
}

static int group_of(int ball) {
  return ball == 0 || ball == EIGHT ? 0 : ball < EIGHT ? SOLIDS : STRIPES;
}

static bool is_down(const carom_ball_state *s) {
  return s->label == CAROM_BALL_POCKETED;
}

/* Balls of a group on the table. */
static int left_of(const game *g, int group) {
  int left = 0;
  for (int k = 1; k < BALLS; k++)
    left += group_of(k) == group && k != EIGHT && !is_down(&g->balls[k].state);
  return left;
}

/* ---- Rules */

typedef struct outcome {
  bool foul, eight; /* eight: it fell */
  int mine, theirs; /* balls that fell; on an open table all are mine */
  int group;        /* of the first object ball that fell, 0 if none */
} outcome;

/* What a shot amounts to. */
static outcome judge(const game *g, const carom_shot *shot, const carom_brief_event *events) {
  const int group = g->group[g->player];
  outcome o = {.foul = true};
  bool hit = false, cushion = false, fallen = false;
  for (int64_t k = 0; k < shot->count && k < shot->room; k++) {
    const carom_brief_event *e = &events[k];
    if (e->type == CAROM_EVENT_BALL_BALL && !hit) {
      /* the first ball hit, by the cue ball */
      const int first = e->a == 0 ? e->b : e->a;
      hit = true;
      o.foul = group == 0       ? first == EIGHT && g->shots > 0
               : first == EIGHT ? left_of(g, group) > 0
                                : group_of(first) != group;
    }
    cushion |= hit && (e->type == CAROM_EVENT_RAIL || e->type == CAROM_EVENT_JAW);
    if (e->type != CAROM_EVENT_POCKET)
      continue;
    fallen = true;
    o.foul |= e->a == 0;
    o.eight |= e->a == EIGHT;
    o.mine += group_of(e->a) != 0 && (group == 0 || group_of(e->a) == group);
    o.theirs += group != 0 && group_of(e->a) == 3 - group;
    o.group = o.group == 0 ? group_of(e->a) : o.group;
  }
  o.foul |= !cushion && !fallen;
  return o;
}

/* plain: the same bits on every machine. */
static const carom_shot_options options = {
    .cushion_model = CAROM_SHOT_CUSHION_HAN, .threads = CAROM_ALL_THREADS, .plain = 1};

/* Plays a move and applies the rules. False where the move cannot be played. */
static bool play(game *g, const move *m) {
  static carom_brief_event events[ROOM];
  carom_ball_state final[BALLS];
  if (g->in_hand && carom_place_ball(&g->table, g->balls, BALLS, 0, m->x, m->y, NULL) != CAROM_OK)
    return false;
  carom_shot shot = {.brief = events, .room = ROOM, .final = final};
  if (carom_shoot(&g->table, g->balls, BALLS, &m->cue, &options, &shot) != CAROM_OK ||
      shot.count > ROOM)
    return false;
  const outcome o = judge(g, &shot, events);
  const int group = g->group[g->player], rest = left_of(g, group);
  for (int k = 0; k < BALLS; k++)
    g->balls[k].state = final[k];
  if (o.eight && g->shots == 0) { /* back to the foot spot, or up the table from it */
    double y = 0.75 * g->table.length;
    while (carom_place_ball(&g->table, g->balls, BALLS, EIGHT, 0.5 * g->table.width, y, NULL) !=
           CAROM_OK)
      y += 1e-3;
  } else if (o.eight) {
    g->winner = group != 0 && rest == 0 && !o.foul ? g->player : 1 - g->player;
  } else if (group == 0 && o.group != 0 && !o.foul && g->shots > 0) {
    g->group[g->player] = o.group;
    g->group[1 - g->player] = 3 - o.group;
  }
  if (o.foul || o.mine == 0)
    g->player = 1 - g->player;
  g->in_hand = o.foul;
  g->shots++;
  return true;
}

/* ---- The player */

/* The direction, in degrees, in which the cue ball meets the ball as if it were to go to the
 * pocket; false where the cut is too thin. */
static bool aim(const double cue[2], const double ball[2], const double pocket[2], double R,
                double *phi) {
  const double d[2] = {pocket[0] - ball[0], pocket[1] - ball[1]}, size = hypot(d[0], d[1]);
  const double ghost[2] = {ball[0] - 2.0 * R * d[0] / size, ball[1] - 2.0 * R * d[1] / size};
  const double way[2] = {ghost[0] - cue[0], ghost[1] - cue[1]};
  *phi = atan2(way[1], way[0]) * 57.29577951308232;
  return (way[0] * d[0] + way[1] * d[1]) / (hypot(way[0], way[1]) * size) > 0.25;
}

static double worth(const outcome *o, const game *g) {
  const int group = g->group[g->player];
  if (o->eight)
    return group != 0 && left_of(g, group) == 0 && !o->foul ? 100.0 : -100.0;
  return 3.0 * o->mine - o->theirs - (o->foul ? 10.0 : 0.0);
}

/* The best of many shots by their outcome. */
static move choose(const game *given) {
  static carom_brief_event events[CANDIDATES][ROOM];
  static carom_ball_state final[CANDIDATES][BALLS];
  static carom_shot shots[CANDIDATES];
  static carom_cue cues[CANDIDATES];
  static int8_t status[CANDIDATES];
  game g = *given;
  move m = {.cue = carom_cue_of(CAROM_GAME_POOL)};
  m.cue.b = 0.0;
  /* ball in hand: the first free place of a row along the table */
  if (g.in_hand) {
    m.x = 0.5 * g.table.width;
    m.y = 0.25 * g.table.length;
    while (carom_place_ball(&g.table, g.balls, BALLS, 0, m.x, m.y, NULL) != CAROM_OK)
      m.y += 0.01;
  }
  if (g.shots == 0) {
    m.cue.speed = 9.0;
    return m;
  }
  /* each ball that may be hit, to each pocket, at two speeds; then shots all around */
  const double *cue = g.balls[0].state.r, R = g.balls[0].kind.radius;
  const int group = g.group[g.player];
  int n = 0;
  for (int k = 1; k < BALLS; k++) {
    const bool allowed =
        k == EIGHT ? group != 0 && left_of(&g, group) == 0 : group == 0 || group_of(k) == group;
    for (int p = 0; p < g.table.pockets && allowed && !is_down(&g.balls[k].state); p++) {
      double phi;
      if (n + 2 <= CANDIDATES && aim(cue, g.balls[k].state.r, g.table.pocket[p].centre, R, &phi))
        for (int speed = 0; speed < 2; speed++) {
          cues[n] = m.cue;
          cues[n].phi = phi;
          cues[n++].speed = speed == 0 ? 1.8 : 3.5;
        }
    }
  }
  for (int k = 0; n < CANDIDATES; k++, n++) {
    cues[n] = m.cue;
    cues[n].phi = 137.50776405003785 * k;
    cues[n].speed = 3.0;
  }
  /* one layout, a cue for each shot */
  for (int k = 0; k < n; k++)
    shots[k] = (carom_shot){.brief = events[k], .room = ROOM, .final = final[k]};
  const carom_shot_job job = {.table = &g.table,
                              .balls = g.balls,
                              .cues = cues,
                              .count = BALLS,
                              .cue_stride = 1,
                              .n = (uint64_t)n,
                              .options = &options,
                              .shots = shots,
                              .status = status};
  carom_shoot_batch(&job); /* a shot in error costs itself */
  double best = -INFINITY;
  for (int k = 0; k < n; k++) {
    const outcome o = judge(&g, &shots[k], events[k]);
    if (status[k] == CAROM_OK && shots[k].count <= ROOM && worth(&o, &g) > best) {
      best = worth(&o, &g);
      m.cue = cues[k];
    }
  }
  return m;
}

/* ---- The game, and its record */

int main(void) {
  static game first, again;
  static move record[MOST_SHOTS];
  const uint64_t seed = 7;
  begin(&first, seed);
  int count = 0;
  for (; first.winner < 0 && count < MOST_SHOTS; count++) {
    record[count] = choose(&first);
    if (!play(&first, &record[count])) {
      fprintf(stderr, "shot %d cannot be played\n", count + 1);
      return 1;
    }
  }
  printf("physics %d, rack %d: player %d wins after %d shots; %d and %d balls of the groups are "
         "left\n",
         carom_physics_revision(), (int)seed, first.winner + 1, count, left_of(&first, SOLIDS),
         left_of(&first, STRIPES));

  /* the record alone gives every state again, to the bit */
  begin(&again, seed);
  for (int k = 0; k < count; k++)
    if (!play(&again, &record[k]))
      return 1;
  const bool same =
      memcmp(first.balls, again.balls, sizeof first.balls) == 0 && first.winner == again.winner;
  printf("played again from its record: %s\n", same ? "the same, to the last bit" : "ANOTHER GAME");
  return !same || first.winner < 0;
}
