/* Lines of a match, read back and judged.
 *
 * A line with an act of a player is executed again, like a call of the player: the rules reject it,
 * or write its line and the lines of the ruling, which wait in match->text. The lines of the file
 * must be these, byte for byte. */
#include "match.h"
#include "rules.h"
#include "seats.h"

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
  return size > length + 3 && line[0] == '{' && line[1] == '"' &&
         memcmp(line + 2, kind, length) == 0 && line[2 + length] == '"';
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

  /* how the game is at its beginning */
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
  if (fault == NULL && record->player >= carom_sides_of(&match->seating))
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

/* Executes the act of a line, like the player; its own line is then due. `read` is the record after
 * it. */
static carom_status do_line(carom_match *match, const carom_record *read) {
  const int player = (int)match->seat;
  const carom_call call = {(int32_t)read->call[0], (int32_t)read->call[1]};
  switch (read->kind) {
  case CAROM_RECORD_SHOT:
    return carom_match_stroke(match, player, &read->cue, &read->options, NULL);
  case CAROM_RECORD_CONTINUE:
    return carom_match_continue(match, &read->options, NULL);
  case CAROM_RECORD_PLACE:
    return carom_match_place(match, player, read->place[0], read->place[1]);
  case CAROM_RECORD_END:
    return carom_match_end(match);
  case CAROM_RECORD_ACT:
    break;
  default:
    return carom_match_refuse(match, CAROM_REFUSED_LINE, "line",
                              "the rules allow no line of this kind here");
  }
  switch (read->act) {
  case CAROM_ACT_CHOOSE:
    return carom_match_choose(match, (int)read->actor, (carom_choice)read->choice);
  case CAROM_ACT_CALL:
    return carom_match_call(match, (int)read->actor, call);
  case CAROM_ACT_CONCEDE:
    return carom_match_concede(match, (int)read->actor);
  case CAROM_ACT_CLOCK:
    return carom_match_clock(match, (int)read->actor);
  case CAROM_ACT_EXTEND:
    return carom_match_extend(match, (int)read->actor);
  case CAROM_ACT_TIMEOUT:
    return carom_match_timeout(match, (int)read->actor);
  default:
    return carom_match_refuse(match, CAROM_REFUSED_LINE, "act", "must be a carom_act");
  }
}

/* Whether a seat may have sent the line of an act, of which `read` is the record. */
static bool may_send(carom_match *match, const carom_record *read, int seat) {
  int64_t acts = match->seat;
  if (read->kind == CAROM_RECORD_ACT)
    acts = read->actor;
  if (seat < 0 || seat == acts || read->kind == CAROM_RECORD_END)
    return true;
  char act[40], right[80];
  snprintf(act, sizeof act, "line %lld", (long long)match->record.line + 1);
  snprintf(right, sizeof right, "seat %d has sent an act of seat %d", seat, (int)acts);
  carom_match_refuse(match, CAROM_REFUSED_TURN, act, right);
  return false;
}

/* The line of an act, or the head of the next match of a set: it is done again, and its lines are
 * due. */
static carom_status read_act(carom_match *match, carom_record *scratch, const char *line,
                             size_t size, int seat) {
  carom_record *record = &match->record;
  const int64_t number = record->line + 1;
  carom_status status;
  if (record->kind == CAROM_RECORD_END && is_kind(line, size, "recording"))
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
    if (!may_send(match, scratch, seat))
      return CAROM_ERROR_ACT;
    status = do_line(match, scratch);
  }
  if (status < 0) {
    char why[200];
    snprintf(why, sizeof why, "%.199s", match->fault);
    return refuse_line(match, number, why);
  }
  match->due = match->size;
  return CAROM_OK;
}

carom_status carom_match_read_from(carom_match *match, carom_record *scratch, const char *line,
                                   size_t size, int seat) {
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

  /* a line that the rules have made already, or an act */
  const int64_t number = record->line + 1;
  if (line_due(match) == 0) {
    const carom_status status = read_act(match, scratch, line, size, seat);
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

carom_status carom_match_read(carom_match *match, carom_record *scratch, const char *line,
                              size_t size) {
  return carom_match_read_from(match, scratch, line, size, -1);
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
