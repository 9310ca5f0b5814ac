/* The best shot of a plan as a picture: without errors, some strokes with errors, and what comes of
 * many; and a run-out with its landing zones. */
#include "pictures/plan_picture.h"

#include "game/plan_words.h"
#include "pictures/picture.h"
#include "pictures/shot_picture.h"
#include "program/memory.h"

#include <stdlib.h>
#include <string.h>

/* The best shot as a picture. */
typedef struct best_shot {
  played shot;
  const char *words;
} best_shot;

static void draw(FILE *out, const void *data) {
  const best_shot *best = data;
  shots_draw(out, &best->shot, 1, best->words);
}

/* Strokes with errors, of which some are drawn. */
enum { TRIED = 500, DRAWN = 40, FOULS = CAROM_FOUL_JUMP + 1, MISS = FOULS, LOSS, WAYS };

/* How a stroke failed: the foul, a loss or a miss. */
static int failure_of(const carom_turn *turn) {
  if (turn->foul != 0)
    return turn->foul;
  return turn->outcome == CAROM_TURN_LOSE ? LOSS : MISS;
}

/* Says how often a failure came. */
static void say_failure(FILE *out, int failure, int times, bool points) {
  if (failure < FOULS)
    fprintf(out, " %d foul: %s.", times, carom_word_text(CAROM_WORDS_FOUL, failure));
  else if (failure == LOSS)
    fprintf(out, " %d lose the game.", times);
  else if (points)
    fprintf(out, " %d score nothing.", times);
  else
    fprintf(out, " %d pot nothing that counts, without a foul.", times);
}

/* Plays the best shot with the player's errors, and says how often which failure comes of it, the
 * most frequent first. The first of the shots are kept, with their events. */
static void say_failures(const planned *p, const shot_line *line, uint64_t seed,
                         carom_shot *strokes, FILE *out) {
  int times[WAYS] = {0}, good = 0;
  uint32_t in_play = 0;
  for (int k = 0; k < line->count && k < CAROM_BALLS_MOST; k++)
    in_play |= (uint32_t)(line->ball[k].state.label != CAROM_BALL_POCKETED) << k;
  for (int n = 0; n < TRIED; n++) {
    carom_facts facts;
    carom_ball_state final[CAROM_BALLS_MOST];
    carom_shot unkept = {.final = final}, *shot = n < DRAWN ? &strokes[n] : &unkept;
    shot_line stroke = *line;
    carom_player_strike(&p->player, seed, (uint64_t)n, &stroke.cue);
    shot->facts = &facts;
    if (n < DRAWN)
      shot_line_play(&stroke, NULL, shot);
    else
      carom_shoot(&line->table->table, line->ball, line->count, &stroke.cue, NULL, shot);
    shot->facts = NULL;

    /* by the rules */
    carom_rules_state state = p->rules.state;
    const carom_turn turn =
        p->rules.judge(&state, in_play, 0, &facts, (carom_call){p->best.ball, p->best.pocket});
    const bool keeps = turn.outcome == CAROM_TURN_KEEP || turn.outcome == CAROM_TURN_WIN ||
                       turn.outcome == CAROM_TURN_DRAW;
    good += keeps;
    if (!keeps)
      times[failure_of(&turn)]++;
  }

  const bool points = line->table->table.pockets == 0;
  fprintf(out, "Of %d strokes with errors %d %s.", TRIED, good, points ? "score" : "play on");
  for (int count = 0; count < 3; count++) {
    int most = 0;
    for (int k = 1; k < WAYS; k++)
      if (times[k] > times[most])
        most = k;
    if (times[most] > 0)
      say_failure(out, most, times[most], points);
    times[most] = 0;
  }
  fputc('\n', out);
}

bool plan_draw(const char *path, shot_line *line, const planned *p, uint64_t seed,
               const char *what) {
  const carom_plan_stroke *c = &p->best;
  static carom_ball_state final[DRAWN + 1][CAROM_BALLS_MOST];
  carom_shot shot = {.final = final[DRAWN]}, strokes[DRAWN] = {0};
  line->cue = c->cue;
  line->cue.speed = c->kind == CAROM_PLAN_PASS ? 0.0 : c->cue.speed;
  line->ball[0].state.r[0] = c->place[0];
  line->ball[0].state.r[1] = c->place[1];
  line->ball[0].state.r[2] = line->ball[0].kind.radius;
  line->ball[0].state.label = CAROM_BALL_STATIONARY;
  shot_line_play(line, NULL, &shot);
  char *words;
  size_t size;
  FILE *stream = open_text(&words, &size);
  fprintf(stream, "The best: %s.\n", what);
  const int drawn = c->kind == CAROM_PLAN_PASS ? 0 : DRAWN;
  for (int n = 0; n < drawn; n++)
    strokes[n].final = final[n];
  if (drawn > 0)
    say_failures(p, line, seed, strokes, stream);
  close_text(stream, &words);
  const best_shot best = {{.line = line, .shot = &shot, .others = strokes, .others_count = drawn},
                          words};
  const bool good = svg_draw(path, draw, &best);
  for (int n = 0; n < drawn; n++)
    free(strokes[n].events);
  free(shot.events);
  free(words);
  return good;
}

/* The strokes of a run-out as a picture. */
typedef struct drawn_sequence {
  played shots[CAROM_SEQUENCE_MOST];
  int count;
} drawn_sequence;

static void draw_sequence(FILE *out, const void *data) {
  const drawn_sequence *sequence = data;
  shots_draw(out, sequence->shots, sequence->count,
             "Areas: where the cue ball may land, each in the colour of its stroke.");
}

bool sequence_draw(const char *path, shot_line *layouts, const carom_sequence_stroke *strokes,
                   int n) {
  static carom_ball_state final[CAROM_SEQUENCE_MOST][CAROM_BALLS_MOST];
  static carom_shot shots[CAROM_SEQUENCE_MOST];
  static drawn_sequence sequence;
  sequence.count = n;
  for (int k = 0; k < n; k++) {
    char text[PLAN_TEXT];
    shots[k] = (carom_shot){.final = final[k]};
    shot_line_play(&layouts[k], NULL, &shots[k]);
    plan_describe(&layouts[k], &strokes[k].choice, text);
    layouts[k].title = copy_text(text); /* for the legend; the line that was copied keeps its own */
    sequence.shots[k] = (played){.line = &layouts[k],
                                 .shot = &shots[k],
                                 .zone = strokes[k].zone,
                                 .zone_corners = CAROM_ZONE_CORNERS};
  }
  const bool good = svg_draw(path, draw_sequence, &sequence);
  for (int k = 0; k < n; k++) {
    free(layouts[k].title);
    layouts[k].title = NULL;
    free(shots[k].events);
  }
  return good;
}
