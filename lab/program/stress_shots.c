/* `carom-lab stress --shots`: random whole shots of every kind, and the invariants that they keep.
 *
 * In the world carom a shot must end in status ok; no ball may be deeper than 1e-9 m in another, in a rail, in a jaw or in the
 * cloth at any place that is sampled; energy may rise by rounding only; momentum may change in a collision by the friction of
 * the cloth only; each state before an event must be what the motion since the ball's last event gives; and all must end at
 * rest or pocketed or off the table. */
#include "stress_shots.h"

#include "command.h"
#include "invariants.h"
#include "memory.h"
#include "message.h"
#include "random_shots.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { SAMPLES = 3, MOST_KINDS = 24, TOLD = 10 };
static const double deepest = 1e-9, rounding = 1e-12, jump_most = 1e-11;

typedef struct kind_tally {
  long shots, failed, too_many;
  double events;
  int64_t most_events;
  shot_measures worst;
} kind_tally;

static void take_worst(shot_measures *worst, const shot_measures *m) {
  worst->overlap = fmax(worst->overlap, m->overlap);
  worst->intrusion = fmax(fmax(worst->intrusion, m->intrusion), m->depth);
  worst->gain = fmax(worst->gain, m->gain);
  worst->momentum = fmax(worst->momentum, m->momentum);
  worst->jump = fmax(worst->jump, m->jump);
  worst->restless += m->restless;
}

static bool good(const shot_measures *m, carom_status status) {
  return status == CAROM_OK && m->overlap <= deepest && m->intrusion <= deepest && m->depth <= deepest && m->gain <= rounding &&
         m->momentum <= 1.0 && m->jump <= jump_most && m->restless == 0;
}

/* Plays one, with room for all of its events. */
static carom_status play(const random_shot *s, const carom_shot_options *options, carom_shot *shot) {
  carom_status status = carom_shoot(&s->table, s->ball, s->count, &s->cue, options, shot);
  if (shot->count > shot->room) {
    free(shot->events);
    shot->room = 2 * shot->count;
    shot->events = allocate((size_t)shot->room, sizeof *shot->events);
    status = carom_shoot(&s->table, s->ball, s->count, &s->cue, options, shot);
  }
  return status;
}

static void print(FILE *out, const char *name, const kind_tally *t) {
  fprintf(out, "%-16s %8ld %7ld %8ld %8.1f %7lld %9.2g %9.2g %9.2g %9.2g %9.2g %6d\n", name, t->shots, t->failed, t->too_many,
          t->events / (double)t->shots, (long long)t->most_events, t->worst.overlap, t->worst.intrusion, t->worst.gain,
          t->worst.momentum, t->worst.jump, t->worst.restless);
}

int stress_shots(FILE *out, int shots, uint64_t seed, int world, int cushion_model, bool elevated) {
  const carom_shot_options options = {.world = (carom_world)world, .cushion_model = (carom_shot_cushion)cushion_model};
  const int kinds = world == CAROM_WORLD_CAROM ? random_shot_kinds_in_space() : random_shot_kinds();
  kind_tally tally[MOST_KINDS] = {{0}}, all = {0};
  carom_shot shot = {.room = 1024};
  shot.events = allocate((size_t)shot.room, sizeof *shot.events);
  static random_shot s;
  int told = 0;
  for (int n = 0; n < shots; n++) {
    const int kind = n % kinds;
    random_shot_make(kind, seed, (uint64_t)(n / kinds), &s);
    if (elevated) {
      lab_random r = {seed + (uint64_t)n};
      s.cue.theta = lab_uniform(&r, 2.0, 80.0);
    }
    const carom_status status = play(&s, &options, &shot);
    const shot_measures m = shot_measure(&s.table, s.ball, s.count, &shot, status, SAMPLES);
    kind_tally *t = &tally[kind];
    t->shots++;
    t->events += (double)shot.count;
    t->most_events = shot.count > t->most_events ? shot.count : t->most_events;
    t->too_many += status == CAROM_ERROR_TOO_MANY_EVENTS;
    take_worst(&t->worst, &m);
    if (!good(&m, status)) {
      t->failed++;
      if (told++ < TOLD)
        complain("shot %d of seed %llu, %s: %s, %lld events in %g s; overlap %.2g, intrusion %.2g (after %s), gain %.2g, "
                 "momentum %.2g, jump %.2g, %d restless",
                 n + 1, (unsigned long long)seed, s.kind, carom_status_name(status), (long long)shot.count, shot.time,
                 m.overlap, m.intrusion, m.worst_at, m.gain, m.momentum, m.jump, m.restless);
    }
    progress_show("shots", n, shots);
  }
  progress_clear();
  free(shot.events);
  fprintf(out, "%d random shots, seed %llu, %d places sampled between events%s\n\n", shots, (unsigned long long)seed, SAMPLES,
          elevated ? ", all cues elevated" : "");
  fprintf(out, "%-16s %8s %7s %8s %8s %7s %9s %9s %9s %9s %9s %6s\n", "kind", "shots", "failed", "too_many", "events", "most",
          "overlap", "intrusion", "gain", "momentum", "jump", "moving");
  for (int k = 0; k < kinds && tally[k].shots > 0; k++) {
    print(out, random_shot_kind(k), &tally[k]);
    all.shots += tally[k].shots;
    all.failed += tally[k].failed;
    all.too_many += tally[k].too_many;
    all.events += tally[k].events;
    all.most_events = tally[k].most_events > all.most_events ? tally[k].most_events : all.most_events;
    take_worst(&all.worst, &tally[k].worst);
  }
  print(out, "all", &all);
  return all.failed == 0 ? EXIT_GOOD : EXIT_SOME;
}
