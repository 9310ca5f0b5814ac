/* `carom record`, `replay` and `verify`: recordings of shots that verify themselves, by
 * carom_record.h. docs/reference/files.md has the format. */
#include "carom_record.h"

#include "game/judge_match.h"
#include "program/program.h"
#include "rows/number.h"
#include "shots/shoot_flags.h"
#include "shots/shot_file.h"
#include "shots/strokes.h"
#include "subcommands.h"

#include <errno.h>
#include <inttypes.h>

enum { FIRST_ROOM = 512 }; /* for events */

typedef struct record_job {
  shared_options shared; /* --output, and models of shots */
  int events;
} record_job;

OPTION(record_job, option_events, "events", events, "none|brief|full", set_choice, 0,
       "what to record of events: nothing; time, type and balls; or the states too. `carom "
       "verify` then reports the first event whose bits differ",
       .usual = "none");

/* ---- Playing, with room for all events ------------------------------------------------------- */

typedef struct player {
  carom_record game;
  carom_shot shot; /* with the events of the last shot */
  size_t room;     /* of shot.events */
  int64_t first;   /* of its events: the first one of its last part */
} player;

static carom_status play(player *p, carom_record_kind kind) {
  static carom_record previous;
  previous = p->game;
  p->first = 0;
  if (kind == CAROM_RECORD_CONTINUE)
    p->first = p->game.played.events;
  if (p->room == 0)
    p->shot.events = grow(p->shot.events, &p->room, FIRST_ROOM, sizeof *p->shot.events);
  for (;;) {
    p->shot.room = (int64_t)p->room;
    const carom_status status = carom_record_play(&p->game, kind, &p->shot);
    if (p->shot.count <= p->shot.room)
      return status;
    /* once more, with room for all */
    p->shot.events = grow(p->shot.events, &p->room, (size_t)p->shot.count, sizeof *p->shot.events);
    p->game = previous;
  }
}

static void player_free(player *p) {
  free(p->shot.events);
  free(p);
}

/* ---- carom record ---------------------------------------------------------------------------- */

static void put(FILE *out, carom_record *game, carom_record_kind kind) {
  static char text[CAROM_RECORD_TEXT];
  fwrite(text, 1, carom_record_write(game, kind, text, sizeof text), out);
}

/* The events of the shot that was just written. */
static void put_events(FILE *out, player *p, int events) {
  for (int64_t k = 0; events != EVENTS_NONE && k < p->shot.count; k++) {
    p->game.event = p->shot.events[k];
    p->game.before = p->game.after = 0;
    if (events == EVENTS_FULL)
      p->game.before = p->game.after = 1 + (p->game.event.type == CAROM_EVENT_BALL_BALL);
    put(out, &p->game, CAROM_RECORD_EVENT);
  }
}

/* Plays a shot of a file and writes it, with its table and its layout where they are others than
 * those of the shot before. */
static bool record_shot(FILE *out, player *p, const shot_line *line, const char *file, int events) {
  carom_record *game = &p->game;
  const carom_table *table = &line->table->table;
  char what[40] = "";
  int where;
  const carom_status failure =
      carom_shot_check(table, line->ball, line->count, &line->cue, &game->options, &where);
  if (failure < 0) {
    if (where >= 0)
      snprintf(what, sizeof what, "ball or part %d: ", where);
    complain("%s:%zu: %s%s", file, line->number, what, carom_status_string(failure));
    return false;
  }
  if (memcmp(&game->table, table, sizeof *table) != 0) {
    game->table = *table;
    put(out, game, CAROM_RECORD_TABLE);
  }
  carom_record_settle(game);
  if (game->count != line->count ||
      memcmp(game->balls, line->ball, (size_t)line->count * sizeof *line->ball) != 0) {
    game->count = line->count;
    memcpy(game->balls, line->ball, sizeof line->ball);
    put(out, game, CAROM_RECORD_BALLS);
  }
  game->cue = line->cue;
  const carom_status status = play(p, CAROM_RECORD_SHOT);
  put(out, game, CAROM_RECORD_SHOT);
  put_events(out, p, events);
  if (status < 0)
    complain("%s:%zu: after %g s: %s", file, line->number, game->played.time,
             carom_status_string(status));
  return status >= 0;
}

static const command_form record_form = {
    .name = "record",
    .usual = (const option_usual[]){{.name = "from", .usual = "start"}, {0}},
    .usage = "[OPTIONS] IN.jsonl",
    .about = "Plays the shots of a file as `carom shoot` does, and writes a recording: the table, "
             "the balls, each stroke, and a hash of the bits of its final states. IN may be -.\n",
    .options = (const option_row *const[]){&options_of_motion, &option_layout, &option_events,
                                           &option_output, NULL},
    .details =
        "exit code: 0 if all shots were recorded to rest; 1 if some have errors, which carom "
        "names; 2 for bad usage or unreadable input\n",
    .example = "carom record -o game.jsonl shots.jsonl",
    .files = ONE_FILE,
};

int command_record(int argc, char **argv) {
  static record_job job;
  const char *path;
  job = (record_job){0};
  int code = parse_arguments(&record_form, argc, argv, &job, &path);
  if (code >= 0)
    return code;
  shot_file *file = shot_file_open(path, CAROM_SHOT_CUSHION_DEFAULT, played_again(&job.shared));
  FILE *out = NULL;
  if (file != NULL)
    out = output_open(job.shared.output);
  bool good = true;
  shot_read what = SHOT_FAILED;
  if (out != NULL) {
    player *p = allocate(1, sizeof *p);
    p->game.options = job.shared.shot;
    put(out, &p->game, CAROM_RECORD_HEAD);
    put(out, &p->game, CAROM_RECORD_OPTIONS);
    shot_line line;
    while ((what = shot_file_next_shot(file, &line)) == SHOT_SHOT) {
      if (line.error != NULL) {
        complain("%s:%zu: %s", path, line.number, line.error);
        good = false;
      } else {
        good &= record_shot(out, p, &line, path, job.events);
      }
      shot_line_free(&line);
    }
    put(out, &p->game, CAROM_RECORD_END);
    player_free(p);
  }
  if (file != NULL)
    shot_file_close(file);
  if (out != NULL && what == SHOT_FAILED)
    output_abandon();
  else if (out != NULL && !output_commit())
    what = SHOT_FAILED;
  if (what == SHOT_FAILED)
    return EXIT_USAGE;
  return exit_of(good);
}

/* ---- Recordings, line by line ---------------------------------------------------------------- */

typedef struct recording {
  const char *path;
  FILE *in;
  char *text;
  size_t space, size; /* bytes of text, and of the line in it */
  int64_t shots;      /* of the matches of a set that are over */
  bool stands;        /* a line told how a game stands */
  bool open; /* a shot ended otherwise, and is told: hashes of lines behind it differ too */
} recording;

static bool recording_open(recording *r, const char *path) {
  *r = (recording){.path = input_name(path), .in = input_open(path)};
  return r->in != NULL;
}

static void recording_close(recording *r) {
  free(r->text);
  if (r->in != stdin)
    fclose(r->in);
}

/* Behind the end of a match of a set its next match begins, in the same file. */
static void begin_next_match(recording *r, carom_record *game) {
  const bool begins = strncmp(r->text, "{\"recording\"", 12) == 0;
  if (game->kind != CAROM_RECORD_END || game->set.race == 0 || !begins)
    return;
  const int64_t line = game->line;
  r->shots += game->shots;
  *game = (carom_record){.line = line};
}

/* Reads the next line; false at the end of the file, or after a complaint, which *bad says. */
static bool next_line(recording *r, carom_record *game, bool *failed) {
  const ssize_t size = getline(&r->text, &r->space, r->in);
  if (size < 0) {
    *failed = ferror(r->in) != 0 || game->kind != CAROM_RECORD_END;
    if (ferror(r->in))
      complain("cannot read %s: %s", r->path, strerror(errno));
    else if (game->line == 0)
      complain("%s: empty; a recording begins with {\"recording\": ...}", r->path);
    else if (*failed)
      complain("%s: cut off behind line %" PRId64 ": there is no line {\"end\": ...}", r->path,
               game->line);
    return false;
  }
  r->size = (size_t)size;
  begin_next_match(r, game);
  const carom_status status = carom_record_read(game, r->text, r->size);
  *failed = status < 0;
  if (status == CAROM_ERROR_REVISION)
    complain("%s: recorded with revision %" PRId64 " of the physics; this carom has revision %d, "
             "with which shots have other bits. The carom of that revision plays it",
             r->path, game->revision, carom_physics_revision());
  else if (status < 0 && !r->open)
    complain("%s:%" PRId64 ": %s", r->path, game->line, game->fault);
  return status >= 0;
}

static bool is_shot(const carom_record *game) {
  return game->pending == CAROM_PENDING_SHOT;
}

static bool same_bits(double a, double b) {
  return memcmp(&a, &b, sizeof a) == 0;
}

static bool same_end(const carom_record_end *a, const carom_record_end *b) {
  return a->hash == b->hash && a->status == b->status && a->events == b->events &&
         same_bits(a->time, b->time);
}

/* ---- carom replay ---------------------------------------------------------------------------- */

static const command_form replay_form = {
    .name = "replay",
    .usage = "[OPTIONS] GAME",
    .about = "Plays a recording again, and writes a row of CSV for each shot. GAME may be -.\n",
    .options = (const option_row *const[]){&option_output, NULL},
    .details = "columns written: shot,line,status,events,time,hash,same\n  same is 1 if the final "
               "states have the recorded bits, else 0\n"
               "exit code: 0 if all are the same; 1 if some are not; 2 for bad usage, a recording "
               "of another revision of the physics, and one that is damaged or cut off\n",
    .example = "carom replay game.jsonl",
    .files = ONE_FILE,
};

int command_replay(int argc, char **argv) {
  static record_job job;
  const char *path;
  recording r;
  job = (record_job){0};
  int code = parse_arguments(&replay_form, argc, argv, &job, &path);
  if (code >= 0)
    return code;
  if (!recording_open(&r, path))
    return EXIT_USAGE;
  FILE *out = output_open(job.shared.output);
  bool failed = true, good = true;
  if (out != NULL) {
    carom_record *game = allocate(1, sizeof *game);
    fputs("shot,line,status,events,time,hash,same\n", out);
    while (next_line(&r, game, &failed)) {
      if (!is_shot(game))
        continue;
      const carom_status status = carom_record_play(game, (carom_record_kind)game->kind, NULL);
      if ((failed = game->pending == CAROM_PENDING_SHOT)) {
        complain("%s:%" PRId64 ": %s", r.path, game->line, carom_status_string(status));
        break;
      }
      const carom_record_end *end = &game->played;
      const bool same = same_end(end, &game->recorded);
      char time[NUMBER_TEXT];
      fprintf(out, "%" PRId64 ",%" PRId64 ",%s,%" PRId64 ",%s,%016" PRIx64 ",%d\n", game->shots,
              game->line, carom_status_name(status), end->events, number_text(end->time, time),
              end->hash, same);
      good &= same;
    }
    free(game);
  }
  recording_close(&r);
  if (out != NULL && failed)
    output_abandon();
  else if (out != NULL && !output_commit())
    failed = true;
  if (failed)
    return EXIT_USAGE;
  return exit_of(good);
}

/* ---- carom verify ---------------------------------------------------------------------------- */

/* A double as a whole number, in their order. */
static int64_t place_of(double x) {
  int64_t bits;
  memcpy(&bits, &x, sizeof bits);
  if (bits < 0)
    return INT64_MIN - bits;
  return bits;
}

/* Tells where two numbers differ; false where they do not. */
static bool tell_number(const char *what, double played, double recorded, const char *unit) {
  char recorded_text[NUMBER_TEXT], played_text[NUMBER_TEXT];
  if (same_bits(played, recorded))
    return false;
  const int64_t a = place_of(played), b = place_of(recorded);
  uint64_t apart = (uint64_t)a - (uint64_t)b;
  if (a < b)
    apart = -apart;
  printf("%s is %s%s, recorded %s%s: they differ by %.3g%s, %" PRIu64
         " units in the last place, from bit %d on\n",
         what, number_text(played, recorded_text), unit, number_text(recorded, played_text), unit,
         played - recorded, unit, apart, 63 - __builtin_clzll((unsigned long long)(a ^ b)));
  return true;
}

static bool tell_whole(const char *what, int64_t played, int64_t recorded) {
  if (played == recorded)
    return false;
  printf("%s is %" PRId64 ", recorded %" PRId64 "\n", what, played, recorded);
  return true;
}

static bool tell_state(const char *when, int ball, const carom_ball_state *played,
                       const carom_ball_state *recorded) {
  static const char *const names[] = {"r[0]", "r[1]", "r[2]", "v[0]", "v[1]",
                                      "v[2]", "w[0]", "w[1]", "w[2]"};
  static const char *const units[3] = {" m", " m/s", " rad/s"};
  char what[60];
  for (int k = 0; k < 9; k++) {
    snprintf(what, sizeof what, "%s of ball %d %s", names[k], ball, when);
    if (tell_number(what, played->r[k], recorded->r[k], units[k / 3]))
      return true;
  }
  snprintf(what, sizeof what, "the label of ball %d %s", ball, when);
  return tell_whole(what, played->label, recorded->label);
}

static bool same_event(const carom_event *played, const carom_record *game) {
  const carom_event *recorded = &game->event;
  const size_t states = (size_t)game->before * sizeof *played->before;
  return same_bits(played->time, recorded->time) && played->type == recorded->type &&
         played->a == recorded->a && played->b == recorded->b &&
         played->cluster == recorded->cluster &&
         memcmp(played->before, recorded->before, states) == 0 &&
         memcmp(played->after, recorded->after, states) == 0;
}

/* Tells the first difference of an event. */
static void tell_event(const carom_event *played, const carom_record *game) {
  const carom_event *recorded = &game->event;
  if (tell_number("its time", played->time, recorded->time, " s") ||
      tell_whole("its type", played->type, recorded->type) ||
      tell_whole("a", played->a, recorded->a) || tell_whole("b", played->b, recorded->b) ||
      tell_whole("cluster", played->cluster, recorded->cluster))
    return;
  const int32_t ball[2] = {played->a, played->b};
  for (int k = 0; k < game->before; k++)
    if (tell_state("before it", ball[k], &played->before[k], &recorded->before[k]))
      return;
  for (int k = 0; k < game->before; k++)
    if (tell_state("after it", ball[k], &played->after[k], &recorded->after[k]))
      return;
}

/* The words before a difference. */
static void tell_shot(const recording *r, const carom_record *game, int64_t line) {
  printf("%s: shot %" PRId64 " (line %" PRId64 ")", r->path, game->shots, line);
}

/* Tells how the end of a shot differs of which every recorded event agrees. */
static void tell_end(const recording *r, const player *p, int64_t line, int64_t compared) {
  const carom_record_end *played = &p->game.played, *recorded = &p->game.recorded;
  tell_shot(r, &p->game, line);
  if (compared > 0)
    printf(", behind its %" PRId64 " recorded events, which agree", compared);
  printf(": ");
  if (!tell_whole("the status", played->status, recorded->status) &&
      !tell_whole("the number of events", played->events, recorded->events) &&
      !tell_number("the time of its end", played->time, recorded->time, " s"))
    printf("the final states have other bits, or a line up to this one was changed: the hash is "
           "%016" PRIx64 ", recorded %016" PRIx64 "\n",
           played->hash, recorded->hash);
}

static const command_form verify_form = {
    .name = "verify",
    .usage = "GAME",
    .about = "Plays a recording again and compares every bit, and judges a match by its rules. "
             "Reports the first shot that differs, and if events were recorded the first event and "
             "number, with the difference; or the first line of a match that breaks the rules. "
             "GAME may be -.\n",
    .options = (const option_row *const[]){NULL},
    .details =
        "exit code: 0 if everything agrees; 1 if a bit or a ruling differs; 2 for bad usage, a "
        "recording of another revision of the physics, and one that is damaged or cut off\n",
    .example = "carom verify game.jsonl",
    .files = ONE_FILE,
};

/* Compares the event of the last line with that of the shot; tells the first difference. */
static bool compare_event(const recording *r, const player *p, int64_t line, int64_t compared) {
  const carom_record *game = &p->game;
  const int64_t k = p->first + compared;
  if (k < p->shot.count && same_event(&p->shot.events[k], game))
    return true;
  tell_shot(r, game, line);
  printf(", event %" PRId64 " (line %" PRId64 "): ", k + 1, game->line);
  if (k < p->shot.count)
    tell_event(&p->shot.events[k], game);
  else
    printf("it was recorded, and does not happen\n");
  return false;
}

/* Judges the last line of a match by its rules. */
static bool judge(const recording *r, const carom_record *game) {
  char why[JUDGED_TEXT];
  if (game->match != 1 || r->open || judge_line(r->text, r->size, why))
    return true;
  printf("%s: not by the rules: %s\n", r->path, why);
  return false;
}

/* Tells that all lines agree; an exit code. */
static int tell_good(const recording *r, const carom_record *game) {
  char what[JUDGED_TEXT] = "";
  const bool whole = game->match != 1 || judge_end(what);
  if (game->match != 1 && r->stands)
    snprintf(what, sizeof what, "its rulings are not judged, as it is no match (format 3)");
  printf("%s: %" PRId64 " shots, every bit agrees (revision %" PRId64 " of the physics)%s%s\n",
         r->path, r->shots + game->shots, game->revision, text_if(what[0] != '\0', "; "), what);
  if (!whole)
    printf("%s: cut off: lines of the last ruling are missing\n", r->path);
  return exit_of(whole);
}

/* Reads, compares and judges all lines; an exit code. */
static int verify(recording *r, player *p) {
  carom_record *game = &p->game;
  bool failed; /* r->open: a shot ended otherwise; its events will tell where it began */
  int64_t line = 0, compared = 0;
  while (next_line(r, game, &failed)) {
    r->stands |= game->kind == CAROM_RECORD_GAME;
    if (game->kind == CAROM_RECORD_EVENT) {
      if (!compare_event(r, p, line, compared))
        return EXIT_SOME;
      compared++;
      continue;
    }
    if (r->open) {
      game->shots -= is_shot(game); /* the one before is told */
      tell_end(r, p, line, compared);
      return EXIT_SOME;
    }
    if (is_shot(game)) {
      line = game->line;
      compared = 0;
      const carom_status status = play(p, (carom_record_kind)game->kind);
      if (game->pending == CAROM_PENDING_SHOT) {
        tell_shot(r, game, line);
        printf(" cannot be played: %s\n", carom_status_string(status));
        return EXIT_SOME;
      }
      r->open = !same_end(&game->played, &game->recorded);
    }
    if (!judge(r, game))
      return EXIT_SOME;
  }
  if (r->open) {
    tell_end(r, p, line, compared);
    return EXIT_SOME;
  }
  if (failed)
    return EXIT_USAGE;
  return tell_good(r, game);
}

int command_verify(int argc, char **argv) {
  static record_job job;
  const char *path;
  recording r;
  int code = parse_arguments(&verify_form, argc, argv, &job, &path);
  if (code >= 0)
    return code;
  if (!recording_open(&r, path))
    return EXIT_USAGE;
  player *p = allocate(1, sizeof *p);
  code = verify(&r, p);
  player_free(p);
  recording_close(&r);
  return code;
}
