/* The search of `carom ways`, by the library. */
#include "game/ways.h"
#include "program/memory.h"
#include "program/message.h"

const char *way_name(const ways_search *s, const way *w) {
  if (s->job.goal == CAROM_WAY_POT)
    return carom_word_text(CAROM_WORDS_PLAN_KIND, w->kind);
  return s->job.goal == CAROM_WAY_SCORE ? "point" : "place";
}

bool player_of(const given_player *options, carom_player *player) {
  if (options->rated && options->errs) {
    complain("--player is a rating, --errors are errors: give only one of them");
    return false;
  }
  if (options->rated)
    *player = carom_player_fargo(options->rating);
  if (options->filmed) {
    player->speed = 0.0;
    player->speed_share = options->speed_share;
    player->phi = options->phi;
    player->theta = options->theta;
    player->a = options->a;
    player->b = options->b;
    player->growth = options->growth;
  }
  if (!options->rated)
    *player = carom_player_of(options->errs ? options->scale : 1.0);

  if (options->eye != 0.0)
    player->eye = options->eye;

  /* a player who is advised thinks of all strokes */
  player->only_pots = player->shots = 0.0;
  return true;
}

void without_bounds(carom_player *player) {
  player->speed_least = 0.01;
  player->speed_most = 1000.0;
  player->tip_most = 1.0;
}

static void show_progress(void *context, const char *stage, double done, double total) {
  (void)context;
  progress_show(stage, done, total);
}

void ways_begin(ways_search *s, const carom_cue *cues, int strokes, int room) {
  s->job.table = &s->line->table->table;
  s->job.balls = s->line->ball;
  s->job.count = s->line->count;
  s->job.cues = cues;
  s->job.strokes = strokes;
  s->job.player = &s->player;
  s->job.shot = &s->options;
  s->job.progress = show_progress;
  s->job.memory_size = carom_ways_memory(room);
  s->job.memory = allocate(1, s->job.memory_size);
}

static bool is_played(carom_status status) {
  if (status < 0)
    complain("the strokes cannot be played: %s", carom_status_string(status));
  return status >= 0;
}

bool ways_chance(const ways_search *s, way *w) {
  return is_played(carom_way_chance(&s->job, w));
}

bool ways_find(ways_search *s) {
  const carom_status status = carom_ways(&s->job, s->way, MOST_WAYS, &s->result);
  progress_clear();
  if (status >= 0 && s->result.left_out > 0)
    complain("%lld strokes are left out: there is room for %d ways, %d rails and balls of a point "
             "and %d events of a shot",
             (long long)s->result.left_out, MOST_WAYS, CAROM_WAY_PARTS, CAROM_WAY_EVENTS);
  return is_played(status);
}
