/* random_matches GAMES SEED ACTS RULED: matches of all games by random acts. ACTS has the first
 * lines of each match and its acts, RULED what came of each act, and the recording of each match.
 * The random_matches and RandomMatches of other languages read ACTS, and write the same RULED. */
#include <carom_match.h>

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { ACTS = 60, TRIES = 40 };

static carom_match match, reader;
static carom_record scratch;
static FILE *acts, *ruled;
static uint64_t random_state;
static char recording[1 << 22];
static int adds;               /* whether the last act is one of which the match has lines */
static size_t written, undone; /* bytes of the recording; with the acts that were undone, or 0 */

static double between(double low, double high) {
  random_state = random_state * 6364136223846793005u + 1442695040888963407u;
  return low + (high - low) * (double)(random_state >> 11) * 0x1p-53;
}

static int one_of(int count) {
  return (int)between(0.0, count - 1e-9);
}

/* A ball of a set; 0 of an empty one. */
static int member_of(uint32_t set) {
  if (set == 0)
    return 0;
  int ball = one_of(CAROM_BALLS_MOST);
  while ((set >> ball & 1) == 0)
    ball = (ball + 1) % CAROM_BALLS_MOST;
  return ball;
}

/* Any state that the game can have. */
static void shuffle_state(carom_rules_kind kind, carom_rules_state *state) {
  const size_t members = offsetof(carom_rules_state, user) / sizeof(int32_t);
  const char *range;
  for (size_t k = 0; k < members; k++) {
    int32_t values[sizeof *state / sizeof(int32_t)];
    carom_rules_state other;
    memcpy(values, state, sizeof *state);
    values[k] = one_of(between(0.0, 1.0) < 0.5 ? 3 : 30);
    memcpy(&other, values, sizeof other);
    if (carom_rules_fault(kind, &other, &range) == NULL)
      *state = other;
  }

  /* few points are made at random: games that know equal innings have them, to one point */
  carom_rules_state equal = *state;
  equal.innings = 1 + one_of(3);
  equal.target = 1;
  equal.score[0] = 0;
  if (carom_rules_fault(kind, &equal, &range) == NULL)
    *state = equal;
}

/* Any seats that the game can have, and a set of some matches. */
static void seat_players(carom_rules_kind kind, carom_match_setup *setup) {
  static carom_seating seating;
  static carom_set set;
  const int seats = 2 + one_of(CAROM_SEATS_MOST - 1);
  if (between(0.0, 1.0) < 0.5 || carom_seating_make(kind, seats, &seating) != CAROM_OK)
    return;
  seating.alternate = one_of(2);
  snprintf(seating.seat[1].name, CAROM_SEAT_NAME, "Zo\xc3\xab %d", seats);
  setup->seating = &seating;
  set = (carom_set){.race = 1 + one_of(3), .order = one_of(3), .extensions = 1, .timeouts = 1};
  if (setup->balls == NULL && between(0.0, 1.0) < 0.7)
    setup->set = &set;
}

/* Begins with the rack, or with some of its balls anywhere in any state. */
static void begin(carom_rules_kind kind, uint64_t seed) {
  const carom_rules_about *about = carom_rules_about_of(kind);
  static carom_table table;
  carom_shot_ball balls[CAROM_BALLS_MOST];
  carom_table_make((carom_table_kind)about->table, &table);
  const int count = carom_rack_size((carom_rack_kind)about->rack);
  carom_rack((carom_rack_kind)about->rack, &table, 1e-4, seed, balls, CAROM_BALLS_MOST);
  for (int tries = 0; (seed & 3) != 0 && tries < TRIES; tries++) {
    carom_plan_rules rules = carom_plan_rules_of(kind);
    shuffle_state(kind, &rules.state);
    for (int k = 0; k < count; k++) {
      carom_ball_state *s = &balls[k].state;
      const double R = balls[k].kind.radius;
      const int gone = k > 0 && count > 4 && between(0.0, 1.0) < 0.4;
      *s = (carom_ball_state){.label = gone ? CAROM_BALL_POCKETED : CAROM_BALL_STATIONARY};
      s->r[0] = between(R, table.width - R);
      s->r[1] = between(R, table.length - R);
      s->r[2] = gone ? -2.0 * R : R;
    }
    carom_match_setup setup = {.rules = kind,
                               .of = &rules,
                               .table = &table,
                               .balls = balls,
                               .count = count,
                               .side = (int64_t)(seed & 1)};
    seat_players(kind, &setup);
    if (carom_match_begin_with(&match, &setup) == CAROM_OK)
      return;
  }
  carom_match_setup setup = {
      .rules = kind, .table = &table, .seed = seed, .side = (int64_t)(seed & 1)};
  seat_players(kind, &setup);
  if (carom_match_begin_with(&match, &setup) != CAROM_OK) {
    fprintf(stderr, "%s: %s\n", about->name, match.fault);
    exit(1);
  }
}

static carom_status choose(void) {
  const int allowed = match.may != 0 && between(0.0, 1.0) < 0.8;
  const int bit = allowed ? member_of((uint32_t)match.may) : one_of(8);
  fprintf(acts, "choose %d\n", bit);
  return carom_match_choose(&match, match.seat, (carom_choice)(1 << bit));
}

static carom_status place(void) {
  const carom_bounds *b = &match.bounds;
  const double x = between(b->low[0], b->high[0]), y = between(b->low[1], b->high[1] + 0.05);
  fprintf(acts, "place %.17g %.17g\n", x, y);
  return carom_match_place(&match, match.seat, x, y);
}

static carom_status call(void) {
  carom_call of = {member_of(match.on), one_of(7) - 1};
  if (between(0.0, 1.0) < 0.2)
    of = (carom_call){one_of(24) - 1, -1};
  fprintf(acts, "call %d %d\n", of.ball, of.pocket);
  return carom_match_call(&match, match.seat, of);
}

/* Half of the strokes go about towards a ball that is on. */
static carom_status stroke(void) {
  carom_cue cue = carom_cue_of(CAROM_GAME_POOL);
  cue.ball = match.cue_ball;
  if (match.rules.any_cue_ball != 0 && between(0.0, 1.0) < 0.7)
    cue.ball = member_of(match.on);
  const double *from = match.record.balls[cue.ball].state.r;
  const double *to = match.record.balls[member_of(match.on)].state.r;
  cue.phi = between(0.0, 360.0);
  if (between(0.0, 1.0) < 0.8)
    cue.phi = atan2(to[1] - from[1], to[0] - from[0]) * 57.29577951308232 + between(-1.0, 1.0);
  cue.speed = between(0.3, 8.0);
  cue.theta = between(0.0, 1.0) < 0.1 ? between(0.0, 40.0) : 0.0;
  cue.a = between(-0.3, 0.3);
  cue.b = between(-0.3, 0.3);
  fprintf(acts, "stroke %d %.17g %.17g %.17g %.17g %.17g\n", (int)cue.ball, cue.speed, cue.phi,
          cue.theta, cue.a, cue.b);
  return carom_match_stroke(&match, match.seat, &cue, NULL, NULL);
}

/* Reads so many bytes of the recording into a match. */
static int read_to(carom_match *to, size_t size) {
  memset(to, 0, sizeof *to);
  for (size_t at = 0; at < size;) {
    const char *end = memchr(recording + at, '\n', size - at);
    const size_t line = (size_t)(end - (recording + at)) + 1;
    if (carom_match_read(to, &scratch, recording + at, line) < 0)
      return 0;
    at += line;
  }
  return 1;
}

/* Takes the last act back, or does it again; or reads all lines, and plays the last shot again. */
static carom_status undo(void) {
  adds = 0;
  fputs("undo\n", acts);
  const size_t size = carom_match_undone(recording, written);
  if (size == written)
    return CAROM_OK;
  undone = written;
  written = size;
  return read_to(&match, written) ? CAROM_OK : CAROM_ERROR_ACT;
}
static carom_status redo(void) {
  adds = 0;
  fputs("redo\n", acts);
  if (undone == 0)
    return CAROM_OK;
  fwrite(recording + written, 1, undone - written, ruled);
  written = undone;
  undone = 0;
  return read_to(&match, written) ? CAROM_OK : CAROM_ERROR_ACT;
}
static carom_status read_again(void) {
  static carom_event events[4096];
  carom_shot shot = {.events = events, .room = 4096};
  adds = 0;
  fputs("again\n", acts);
  undone = 0;
  if (!read_to(&match, written))
    return CAROM_ERROR_ACT;
  if (match.stroke.mass > 0.0)
    carom_match_replay(&match, &shot);
  fprintf(ruled, "%d events\n", (int)shot.count);
  return CAROM_OK;
}

static carom_status act(void) {
  const double what = between(0.0, 1.0);
  const int player = match.seat;
  adds = 1;
  if (match.phase == CAROM_MATCH_OVER) {
    fputs("next\n", acts);
    return carom_match_next(&match);
  }
  if (what < 0.01) {
    fputs("clock\n", acts);
    return carom_match_clock(&match, player);
  }
  if (what < 0.015) {
    fprintf(acts, "concede %d\n", player);
    return carom_match_concede(&match, player);
  }
  if (what < 0.02) {
    fputs("extend\n", acts);
    return carom_match_extend(&match, player);
  }
  if (what < 0.025) {
    fputs("timeout\n", acts);
    return carom_match_timeout(&match, player);
  }
  if (what < 0.045)
    return undo();
  if (what < 0.06)
    return redo();
  if (what < 0.07)
    return read_again();
  if (what < (match.may != 0 ? 0.4 : 0.1))
    return choose();
  if (match.phase == CAROM_MATCH_PLACE && what < 0.9)
    return place();
  if (match.on != 0 && what < (match.rules.calls != 0 ? 0.6 : 0.15))
    return call();
  return stroke();
}

static void keep(void) {
  undone = 0;
  fwrite(match.text, 1, (size_t)match.size, ruled);
  memcpy(recording + written, match.text, (size_t)match.size);
  written += (size_t)match.size;
}

/* The reader refuses the line of an act from another seat, with nothing changed, and takes it from
 * the seat that acted. It knows the lines of the ruling then, whoever sends them. */
static int is_sent_by(int seat, size_t from) {
  static carom_match kept, room;
  const char *line = recording + from;
  while (line < recording + written) {
    const char *end = strchr(line, '\n') + 1;
    const size_t size = (size_t)(end - line);
    const int acts_here = line == recording + from && reader.phase != CAROM_MATCH_NONE &&
                          strncmp(line, "{\"continue\"", 11) != 0 &&
                          strncmp(line, "{\"end\"", 6) != 0 &&
                          strncmp(line, "{\"recording\"", 12) != 0;
    kept = reader;
    if (acts_here &&
        (carom_match_receive(&reader, &room, line, size, (seat + 1) % 8) != CAROM_ERROR_ACT ||
         reader.refusal != CAROM_REFUSED_TURN || reader.record.hash != kept.record.hash))
      return 0;
    if (carom_match_receive(&reader, &room, line, size, acts_here ? seat : -1) < 0)
      return 0;
    line = end;
  }
  return 1;
}

/* What came of an act. */
static void tell(carom_status status) {
  char words[300] = "";
  if (match.rulings > 0)
    carom_ruling_string(&match.ruling, words, sizeof words);
  if (status >= 0)
    fprintf(ruled, "taken: phase %d, seat %d, winner %d, may %d, ball %d, on %u, touching %u: %s\n",
            (int)match.phase, match.seat, (int)match.winner - 1, (int)match.may,
            (int)match.cue_ball, match.on, match.touching, words);
  else
    fprintf(ruled, "%s\n", match.fault);
}

/* Whether the recording is judged to the same end. */
static int is_read_again(void) {
  return read_to(&reader, written) && reader.record.hash == match.record.hash &&
         reader.rulings == match.rulings;
}

int main(int count, char **arguments) {
  const int games = count == 5 ? atoi(arguments[1]) : 0;
  const uint64_t seed = count == 5 ? strtoull(arguments[2], NULL, 10) : 0;
  acts = count == 5 ? fopen(arguments[3], "wb") : NULL;
  ruled = count == 5 ? fopen(arguments[4], "wb") : NULL;
  if (acts == NULL || ruled == NULL)
    return 2;
  int kinds = 0, over = 0, drawn = 0;
  long taken = 0, refused = 0, rulings = 0;
  while (carom_rules_about_of((carom_rules_kind)kinds) != NULL)
    kinds++;
  for (int game = 0; game < games; game++) {
    random_state = seed + (uint64_t)game;
    written = undone = 0;
    begin((carom_rules_kind)(game % kinds), seed + (uint64_t)(game / kinds));
    fprintf(acts, "match\n%.*s", (int)match.size, match.text);
    keep();
    read_to(&reader, written);
    for (int n = 0; n < ACTS; n++) {
      const int seat = match.seat;
      const size_t known = written;
      const carom_status status = act();
      taken += status >= 0;
      refused += status < 0;
      if (status >= 0 && adds)
        keep();
      if (!adds)
        read_to(&reader, written);
      if (status >= 0 && adds && !is_sent_by(seat, known)) {
        fprintf(stderr, "match %d, act %d: another seat may send it, or not its own: %s\n", game, n,
                reader.fault);
        return 1;
      }
      tell(status);
    }
    over += match.phase == CAROM_MATCH_OVER;
    drawn += match.winner == CAROM_DRAWN;
    rulings += match.rulings;
    if (!is_read_again()) {
      fprintf(stderr, "match %d is not judged again: %s\n", game, reader.fault);
      return 1;
    }
  }
  printf("%d matches of %d games: %ld acts taken, %ld refused, %ld rulings, %d matches over, "
         "%d of them drawn\n",
         games, kinds, taken, refused, rulings, over, drawn);
  return fclose(acts) != 0 || fclose(ruled) != 0;
}
