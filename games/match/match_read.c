/* Lines of a match, read back and judged: those of a file, in order, and those of a peer, in any.
 *
 * The line of an act is done again, as a call by the player would be: the rules refuse it, or make
 * its line and the lines of the ruling, in match->text. The line read must equal the first of them,
 * byte for byte.
 *
 * In a file the lines of the ruling must follow: match->text has those that are still due. A peer
 * need not send them, because the match has them already; a line that equals one of match->text is
 * known and changes nothing. A peer's act is done on a copy of the match, which replaces the match
 * only where the whole line is right. So whatever a peer sends, a refused line leaves the match as
 * it was.
 *
 * A note is no act: a file may have it between any two lines, also between an act and its ruling,
 * and it is read into the record without a change of the lines that are due. */
#include "match.h"
#include "rules.h"
#include "seats.h"

#include <stddef.h>
#include <stdio.h>
#include <string.h>

/* What the next line must be, of those that the last act made. */
static size_t line_due(const carom_match *match) {
  const char *end = memchr(match->text, '\n', (size_t)match->due);
  if (end == NULL)
    return 0;
  return (size_t)(end - match->text) + 1;
}

/* The line that was due was read. */
static void take_line(carom_match *match, size_t length) {
  match->size = match->due -= (int64_t)length;
  memmove(match->text, match->text + length, (size_t)match->size);
}

/* Without blanks at its ends. */
static const char *trimmed(const char *line, size_t *size) {
  while (*size > 0 && (line[*size - 1] == '\n' || line[*size - 1] == '\r' ||
                       line[*size - 1] == ' ' || line[*size - 1] == '\t'))
    --*size;
  while (*size > 0 && (*line == ' ' || *line == '\t')) {
    line++;
    --*size;
  }
  return line;
}

/* Whether a line is of a kind, such as "event". */
static bool is_kind(const char *line, size_t size, const char *kind) {
  const size_t length = strlen(kind);
  size_t line_start = 1; /* of the quote behind the brace */
  while (line_start < size && (line[line_start] == ' ' || line[line_start] == '\t'))
    line_start++;
  return size > line_start + length + 2 && line[0] == '{' && line[line_start] == '"' &&
         memcmp(line + line_start + 1, kind, length) == 0 && line[line_start + 1 + length] == '"';
}

/* A line that is not by the rules: what is due, and why. Nothing is read behind it. */
static carom_status refuse_line(carom_match *match, int64_t line, const char *what) {
  char act[40], right[300], pending[64] = "";
  const int length = (int)line_due(match);
  if (length > 0)
    snprintf(pending, sizeof pending, "; due is %.*s...", (int)carom_min(length - 1, 40),
             match->text);
  snprintf(act, sizeof act, "line %lld", (long long)line);
  snprintf(right, sizeof right, "%s%s", what, pending);
  match->record.kind = CAROM_RECORD_WRONG;
  return carom_match_refuse(match, CAROM_REFUSED_LINE, act, right);
}

/* The first lines, up to the first "game", are read into the record itself. */
static carom_status read_beginning(carom_match *match, const char *line, size_t size) {
  carom_record *record = &match->record;
  const carom_status status = carom_record_read(record, line, size);
  if (status != CAROM_OK) {
    snprintf(match->fault, sizeof match->fault, "line %lld: %s", (long long)record->line,
             record->fault);
    return status;
  }
  const int64_t kind = record->kind;
  if (kind == CAROM_RECORD_SHOT || kind == CAROM_RECORD_CONTINUE || kind == CAROM_RECORD_ACT ||
      kind == CAROM_RECORD_END)
    return refuse_line(match, record->line, "a line \"game\" must precede it");
  if (kind == CAROM_RECORD_HEAD && record->match != 1)
    return refuse_line(match, record->line,
                       "this is a recording of format 2, not a match; replay it");
  if (kind != CAROM_RECORD_GAME)
    return CAROM_OK;

  /* how the game stands at its beginning */
  record->actor = -1;
  const char *range = "";
  if (match->rules.judge == NULL) {
    if (carom_rules_about_of((carom_rules_kind)record->rules) == NULL)
      return refuse_line(match, record->line, "game.rules must be a carom_rules_kind");
    match->rules = carom_plan_rules_of((carom_rules_kind)record->rules);
    const char *wrong =
        carom_rules_fault((carom_rules_kind)record->rules, &record->standing, &range);
    if (wrong != NULL) {
      char what[128];
      snprintf(what, sizeof what, "game.%s must be %s", wrong, range);
      return refuse_line(match, record->line, what);
    }
  }
  const uint64_t context = match->rules.state.context;
  match->rules.state = record->standing;
  match->rules.state.context = context;
  carom_seating_make((carom_rules_kind)record->rules, 0, &match->seating);
  if (record->seating.count > 0)
    match->seating = record->seating;
  const char *fault =
      carom_seats_fault(&match->rules, (carom_rules_kind)record->rules, &match->seating);
  if (fault == NULL && record->side >= carom_sides_of(&match->seating))
    fault = "game.player must be a side";
  if (fault != NULL)
    return refuse_line(match, record->line, fault);
  carom_take_seat(match);
  match->leave = 0;
  if (record->hand != 0) {
    match->leave = CAROM_LEAVE_ANYWHERE;
    if (record->bounds != 0)
      match->leave = (int32_t)record->bounds;
    carom_hand_bounds((carom_leave)match->leave, &record->table,
                      record->balls[carom_match_cue_ball(match)].kind.radius, &match->bounds);
  }
  carom_match_look(match);
  return CAROM_OK;
}

/* What the line of an act says. */
typedef struct act_of_line {
  int64_t kind; /* a carom_record_kind */
  int64_t act, actor, choice;
  carom_call call;
  double place[2];
  carom_cue cue;
  carom_shot_options options;
} act_of_line;

static act_of_line act_in(const carom_record *read) {
  return (act_of_line){.kind = read->kind,
                       .act = read->act,
                       .actor = read->actor,
                       .choice = read->choice,
                       .call = {(int32_t)read->call[0], (int32_t)read->call[1]},
                       .place = {read->place[0], read->place[1]},
                       .cue = read->cue,
                       .options = read->options};
}

/* Does what a line says, as the player would; match->text then begins with the act's own line. */
static carom_status do_act(carom_match *match, const act_of_line *line) {
  const int seat = (int)match->seat, actor = (int)line->actor;
  switch (line->kind) {
  case CAROM_RECORD_SHOT:
    return carom_match_stroke(match, seat, &line->cue, &line->options, NULL);
  case CAROM_RECORD_CONTINUE:
    return carom_match_continue(match, &line->options, NULL);
  case CAROM_RECORD_PLACE:
    return carom_match_place(match, seat, line->place[0], line->place[1]);
  case CAROM_RECORD_END:
    return carom_match_end(match);
  case CAROM_RECORD_ACT:
    break;
  default:
    return carom_match_refuse(match, CAROM_REFUSED_LINE, "line",
                              "the rules allow no line of this kind here");
  }
  switch (line->act) {
  case CAROM_ACT_CHOOSE:
    return carom_match_choose(match, actor, (carom_choice)line->choice);
  case CAROM_ACT_CALL:
    return carom_match_call(match, actor, line->call);
  case CAROM_ACT_CONCEDE:
    return carom_match_concede(match, actor);
  case CAROM_ACT_CLOCK:
    return carom_match_clock(match, actor);
  case CAROM_ACT_EXTEND:
    return carom_match_extend(match, actor);
  case CAROM_ACT_TIMEOUT:
    return carom_match_timeout(match, actor);
  default:
    return carom_match_refuse(match, CAROM_REFUSED_LINE, "act", "must be a carom_act");
  }
}

/* Whether the head of the next match of a set is due, and this line begins it. */
static bool begins_next(const carom_match *match, const char *line, size_t size) {
  return match->record.kind == CAROM_RECORD_END && is_kind(line, size, "recording");
}

/* ---- Notes */

/* Whether the match has the seat that says the last note; writes why not. */
static bool has_seat_of_note(const carom_match *match, char right[80]) {
  const int64_t by = match->record.note.by;
  snprintf(right, 80, "note.seat is %d, and the seats of the match are 0 to %d", (int)by - 1,
           (int)match->seating.count - 1);
  return by <= match->seating.count;
}

/* How many lines are due, which the record has counted already. */
static int64_t count_due(const carom_match *match) {
  int64_t lines = 0;
  for (int64_t k = 0; k < match->due; k++)
    if (match->text[k] == '\n')
      lines++;
  return lines;
}

/* A note of a file. */
static carom_status read_note(carom_match *match, const char *line, size_t size) {
  carom_record *record = &match->record;
  const int64_t number = record->line + 1 - count_due(match);
  char right[80];
  const carom_status status = carom_record_read(record, line, size);
  if (status != CAROM_OK) {
    snprintf(match->fault, sizeof match->fault, "line %lld: %s", (long long)number, record->fault);
    match->refusal = CAROM_REFUSED_LINE;
    return status;
  }
  if (!has_seat_of_note(match, right))
    return refuse_line(match, number, right);

  /* where nothing is due, the caller has the lines of the last act already */
  if (match->due == 0) {
    match->known += match->size;
    match->size = 0;
  }
  return CAROM_OK;
}

/* ---- A file */

/* The line of an act, or the head of the next match of a set: it is done again, and its lines are
 * due. */
static carom_status read_act(carom_match *match, carom_record *scratch, const char *line,
                             size_t size) {
  carom_record *record = &match->record;
  const int64_t number = record->line + 1;
  carom_status status;
  if (begins_next(match, line, size))
    status = carom_match_next(match);
  else {
    *scratch = *record;
    status = carom_record_read(scratch, line, size);
    if (status != CAROM_OK) {
      snprintf(match->fault, sizeof match->fault, "line %lld: %s", (long long)number,
               scratch->fault);
      match->refusal = CAROM_REFUSED_LINE;
      record->kind = CAROM_RECORD_WRONG;
      return status;
    }
    const act_of_line act = act_in(scratch);
    status = do_act(match, &act);
  }
  if (status < 0) {
    char why[200];
    snprintf(why, sizeof why, "%.199s", match->fault);
    return refuse_line(match, number, why);
  }
  match->due = match->size;
  return CAROM_OK;
}

carom_status carom_match_read(carom_match *match, carom_record *scratch, const char *line,
                              size_t size) {
  if (match == NULL || scratch == NULL || line == NULL)
    return CAROM_ERROR_NULL;
  line = trimmed(line, &size);
  carom_record *record = &match->record;
  if (size == 0)
    return CAROM_OK;
  if (match->phase == CAROM_MATCH_NONE) {
    match->size = match->due = 0;
    return read_beginning(match, line, size);
  }
  if (is_kind(line, size, "event") && record->kind != CAROM_RECORD_WRONG)
    return CAROM_OK; /* the shot reports its events */
  if (is_kind(line, size, "note") && record->kind != CAROM_RECORD_WRONG)
    return read_note(match, line, size);

  /* a line that the rules have made already, or an act */
  const int64_t number = record->line + 1;
  if (line_due(match) == 0) {
    const carom_status status = read_act(match, scratch, line, size);
    if (status != CAROM_OK)
      return status;
  }
  const size_t pending = line_due(match);
  if (pending != size + 1 || memcmp(line, match->text, size) != 0) {
    char words[200] = "the line has other values";
    carom_ruling_string(&match->ruling, words, sizeof words);
    return refuse_line(match, number, words);
  }
  take_line(match, pending);
  return CAROM_OK;
}

/* ---- A peer */

/* Everything of a match but the part of its text that has no lines. */
static void copy_match(carom_match *target, const carom_match *source) {
  memcpy(target, source, offsetof(carom_match, text) + (size_t)(source->size + source->known));
}

/* Whether match->text has this line: the act was taken before, or the line is of its ruling, or
 * it is the last note. */
static bool is_known(const carom_match *match, const char *line, size_t size) {
  const char *start = match->text, *const end = match->text + match->size + match->known;
  while (start < end) {
    const char *next = memchr(start, '\n', (size_t)(end - start));
    if (next == NULL)
      return false;
    if ((size_t)(next - start) == size && memcmp(start, line, size) == 0)
      return true;
    start = next + 1;
  }
  return false;
}

/* What refuses the line of a peer: which line, and why. */
static carom_status refuse_peer(carom_match *match, carom_refusal refusal, int64_t line,
                                const char *why) {
  char act[40];
  snprintf(act, sizeof act, "line %lld", (long long)line);
  return carom_match_refuse(match, refusal, act, why);
}

/* Whether `seat` may send this act. A shot that was stopped may be continued by any seat, and the
 * recording may be ended by any seat once the match is over. */
static bool may_send(const carom_match *match, const act_of_line *line, int seat, char right[80]) {
  int64_t acts = match->seat;
  switch (line->kind) {
  case CAROM_RECORD_CONTINUE:
    return true;
  case CAROM_RECORD_END:
    snprintf(right, 80, "seat %d has sent the end, but the match is not over", seat);
    return match->phase == CAROM_MATCH_OVER;
  case CAROM_RECORD_ACT:
    acts = line->actor;
    break;
  default:
    break;
  }
  snprintf(right, 80, "seat %d has sent an act of seat %d", seat, (int)acts);
  return seat == acts;
}

/* Reads an act into a match that may be spoilt, because the caller has another. */
static carom_status receive_act(carom_match *match, const carom_match *original, const char *line,
                                size_t size, int seat) {
  const int64_t number = original->record.line + 1;
  match->size = match->known = match->due = 0;
  carom_status status;
  char right[200];
  if (begins_next(match, line, size))
    status = carom_match_next(match);
  else {
    status = carom_record_read(&match->record, line, size);
    if (status != CAROM_OK) {
      snprintf(right, sizeof right, "%.199s", match->record.fault);
      refuse_peer(match, CAROM_REFUSED_LINE, number, right);
      return status;
    }
    const act_of_line act = act_in(&match->record);
    match->record = original->record;
    if (seat >= 0 && !may_send(match, &act, seat, right))
      return refuse_peer(match, CAROM_REFUSED_TURN, number, right);
    status = do_act(match, &act);
  }
  if (status < 0) {
    snprintf(right, sizeof right, "%.199s", match->fault);
    return refuse_peer(match, CAROM_REFUSED_LINE, number, right);
  }
  const char *end = memchr(match->text, '\n', (size_t)match->size);
  if (end != NULL && (size_t)(end - match->text) == size && memcmp(line, match->text, size) == 0)
    return CAROM_OK;
  snprintf(right, sizeof right, "the line has other values; due is %.*s",
           end == NULL ? 0 : (int)carom_min(end - match->text, 120), match->text);
  return refuse_peer(match, CAROM_REFUSED_LINE, number, right);
}

/* Reads a note into a match that may be spoilt, likewise. */
static carom_status receive_note(carom_match *match, const carom_match *before, const char *line,
                                 size_t size, int seat) {
  const int64_t number = before->record.line + 1;
  char right[200];
  carom_status status = carom_record_read(&match->record, line, size);
  if (status != CAROM_OK) {
    snprintf(right, sizeof right, "%.199s", match->record.fault);
    refuse_peer(match, CAROM_REFUSED_LINE, number, right);
    return status;
  }
  const carom_note note = match->record.note;
  const int by = (int)note.by - 1;
  match->record = before->record;
  if (seat >= 0 && by != seat) {
    if (by < 0)
      snprintf(right, sizeof right, "seat %d has sent a note without its seat", seat);
    else
      snprintf(right, sizeof right, "seat %d has sent a note of seat %d", seat, by);
    return refuse_peer(match, CAROM_REFUSED_TURN, number, right);
  }
  status = carom_match_note(match, by, &note);
  if (status >= 0)
    return status;
  snprintf(right, sizeof right, "%.199s", match->fault);
  return refuse_peer(match, (carom_refusal)match->refusal, number, right);
}

carom_status carom_match_receive(carom_match *match, carom_match *scratch, const char *line,
                                 size_t size, int seat) {
  if (match == NULL || scratch == NULL || line == NULL)
    return CAROM_ERROR_NULL;
  line = trimmed(line, &size);
  const bool has_begun = match->phase != CAROM_MATCH_NONE;
  if (size == 0)
    return CAROM_OK;
  if (!has_begun && seat >= 0)
    return carom_match_refuse(match, CAROM_REFUSED_NOT_BEGUN, "line",
                              "the match has not begun, and no seat may begin it");
  if (has_begun && (is_kind(line, size, "event") || is_known(match, line, size))) {
    match->refusal = CAROM_REFUSED_NOT;
    match->fault[0] = '\0';
    return CAROM_OK;
  }
  copy_match(scratch, match);
  carom_status status;
  if (!has_begun)
    status = read_beginning(scratch, line, size);
  else if (is_kind(line, size, "note"))
    status = receive_note(scratch, match, line, size, seat);
  else
    status = receive_act(scratch, match, line, size, seat);
  if (status != CAROM_OK) {
    match->refusal = scratch->refusal;
    memcpy(match->fault, scratch->fault, sizeof match->fault);
    return status;
  }
  copy_match(match, scratch);
  return CAROM_OK;
}

/* ---- Undo */

/* Whether a line is one that a player caused: an act. A cue ball that is taken in hand is not
 * placed. */
static bool is_act(const char *line, size_t size) {
  static const char in_hand[] = "\"hand\":1";
  if (is_kind(line, size, "act") || is_kind(line, size, "shot") ||
      is_kind(line, size, "continue") || is_kind(line, size, "end"))
    return true;
  if (!is_kind(line, size, "place"))
    return false;
  for (size_t k = 0; k + sizeof in_hand - 1 <= size; k++)
    if (memcmp(line + k, in_hand, sizeof in_hand - 1) == 0)
      return false;
  return true;
}

size_t carom_match_undone(const char *lines, size_t size) {
  size_t end = size;
  while (lines != NULL && end > 0) {
    size_t begin = end - 1;
    while (begin > 0 && lines[begin - 1] != '\n')
      begin--;
    if (is_act(lines + begin, end - begin))
      return begin;
    end = begin;
  }
  return size;
}
