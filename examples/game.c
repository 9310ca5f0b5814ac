/* A game of eight-ball between two programs, and the same game once more from its record.
 *
 * The core of a game, without pictures: the state between shots, and the record. The rules and
 * both players are those of carom_plan.h: a plan finds the stroke, and the player errs by his
 * rating. A record is the seed of the rack and a few doubles a shot: where the cue ball was put,
 * the cue, and the call. Played again it gives the same bits on every machine
 * that has the same carom_physics_revision(). So two machines that send each other these doubles
 * play in lockstep; it is the doubles that count, not what is printed of them. */
#include "carom_plan.h"

#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { BALLS = 16, MOST_SHOTS = 150 };

/* ---- The state, and what goes over the wire */

typedef struct game {
  carom_table table;
  carom_shot_ball balls[BALLS];
  carom_plan_rules rules; /* with the state of the player at the table */
  int player, winner;     /* winner: -1 while nobody has won */
  bool in_hand;
} game;

typedef struct move {
  double place[2]; /* of the cue ball, where it is in hand */
  carom_cue cue;
  carom_call call;
} move;

static const carom_shot_options options;

static void begin(game *g, uint64_t seed) {
  memset(g, 0, sizeof *g);
  carom_table_make(CAROM_TABLE_POOL_9FT, &g->table);
  carom_rack(CAROM_RACK_EIGHTBALL, &g->table, 1e-4, seed, g->balls, BALLS);
  g->rules = carom_plan_rules_of(CAROM_RULES_EIGHTBALL);
  g->rules.state.opening = 1; /* before the break */
  g->winner = -1;
}

/* ---- A shot */

/* Plays a move and applies the rules. False where the move cannot be played. */
static bool play(game *g, const move *m) {
  if (g->in_hand &&
      carom_place_ball(&g->table, g->balls, BALLS, 0, m->place[0], m->place[1], NULL) != CAROM_OK)
    return false;
  carom_facts facts;
  carom_ball_state final[BALLS];
  carom_shot shot = {.final = final, .facts = &facts};
  if (carom_shoot(&g->table, g->balls, BALLS, &m->cue, &options, &shot) != CAROM_OK)
    return false;

  /* whose turn it is, and with which layout */
  static carom_ruling ruling;
  if (carom_referee(&g->rules, &g->table, g->balls, BALLS, 0, &shot, m->call, &ruling) != CAROM_OK)
    return false;
  g->rules.state = ruling.state;
  memcpy(g->balls, ruling.balls, sizeof g->balls);
  g->in_hand = ruling.hand;
  if (ruling.winner >= 0)
    g->winner = ruling.winner == 0 ? g->player : 1 - g->player;
  else if (ruling.next == 1)
    g->player = 1 - g->player;
  return true;
}

/* ---- The players */

/* The best stroke that a plan finds, with the errors of the player. */
static bool choose(const game *g, const carom_player players[2], int number, void *memory,
                   size_t size, move *m) {
  const carom_cue cue = carom_cue_of(CAROM_GAME_POOL);
  const carom_plan_options wanted = {
      .shots = 300, .seed = (uint64_t)number, .opponent = &players[1 - g->player]};
  const carom_plan_job job = {.table = &g->table,
                              .balls = g->balls,
                              .count = BALLS,
                              .cue = &cue,
                              .player = &players[g->player],
                              .rules = &g->rules,
                              .shot = &options,
                              .options = &wanted,
                              .memory = memory,
                              .memory_size = size};
  carom_choice best;
  int found;
  const carom_status status = g->in_hand ? carom_plan_hand(&job, NULL, NULL, &best, 1, &found)
                                         : carom_plan(&job, &best, 1, &found);
  if (status != CAROM_OK)
    return false;
  *m = (move){
      .place = {best.place[0], best.place[1]}, .cue = best.cue, .call = {best.ball, best.pocket}};
  carom_player_strike(&players[g->player], 1, (uint64_t)number, &m->cue);
  return true;
}

/* ---- The game, and its record */

int main(void) {
  static game first, again;
  static move record[MOST_SHOTS];
  const uint64_t seed = 7;
  const carom_player players[2] = {carom_player_fargo(500.0), carom_player_fargo(600.0)};
  const carom_plan_options wanted = {.shots = 300};
  const size_t size = carom_plan_memory(&wanted);
  void *memory = malloc(size);
  begin(&first, seed);
  int count = 0;
  for (; memory != NULL && first.winner < 0 && count < MOST_SHOTS; count++)
    if (!choose(&first, players, count, memory, size, &record[count]) ||
        !play(&first, &record[count])) {
      fprintf(stderr, "shot %d cannot be played\n", count + 1);
      return 1;
    }
  free(memory);
  printf("physics %d, rack %d: player %d wins after %d shots\n", carom_physics_revision(),
         (int)seed, first.winner + 1, count);

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
