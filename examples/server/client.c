/* client ADDRESS PORT: plays a seat of a server by plans, or looks on, and prints the match. */
#include <arpa/inet.h>
#include <carom_match.h>
#include <netinet/in.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static carom_match match, mine, scratch;
static const carom_plan_options options = {.shots = 100};
static carom_plan_job job = {.options = &options};
static char awaited[CAROM_RECORD_TEXT]; /* the last line that was sent, until it comes back. */

static void expect(carom_status status, const carom_match *judge) {
  if (status >= 0)
    return;
  fprintf(stderr, "%s: %s\n", carom_status_string(status), judge->fault);
  exit(EXIT_FAILURE);
}

/* Sends the lines of an act. */
static void send_act(FILE *server, carom_status status) {
  expect(status, &mine);
  if (mine.size == 0)
    return;
  fwrite(mine.text, 1, (size_t)mine.size, server);
  const char *last = mine.text + mine.size - 1, *const end = last + 1;
  while (last > mine.text && last[-1] != '\n')
    last--;
  snprintf(awaited, sizeof awaited, "%.*s", (int)(end - last), last);
}

/* Plays the best stroke on a copy: the match changes when the lines come back. */
static void act(FILE *server) {
  carom_plan_stroke best;
  int found;
  mine = match;
  expect(carom_match_plan(&mine, &job, &best, 1, &found), &mine);
  send_act(server, carom_match_prepare(&mine, mine.seat, &best));
  if (best.kind != CAROM_PLAN_PASS)
    send_act(server, carom_match_stroke(&mine, mine.seat, &best.cue, NULL, NULL));
  fflush(server);
}

int main(int count, char **arguments) {
  if (count != 3)
    return EXIT_FAILURE;
  struct sockaddr_in address = {.sin_family = AF_INET,
                                .sin_port = htons((uint16_t)atoi(arguments[2]))};
  const int connection = socket(AF_INET, SOCK_STREAM, 0);
  if (inet_pton(AF_INET, arguments[1], &address.sin_addr) != 1 ||
      connect(connection, (const void *)&address, sizeof address) != 0)
    return EXIT_FAILURE;
  FILE *input = fdopen(connection, "r"), *server = fdopen(dup(connection), "w");
  const carom_player player = carom_player_rated(600.0, CAROM_RULES_NINEBALL);
  job.player = &player;
  job.memory_size = carom_plan_memory(&options);
  job.memory = malloc(job.memory_size);
  char *line = NULL;
  size_t room = 0;
  int seat = -1;
  while (match.record.kind != CAROM_RECORD_END && getline(&line, &room, input) > 0) {
    if (line[0] == '{') {
      expect(carom_match_receive(&match, &scratch, line, strlen(line), -1), &match);
      fputs(line, stdout);
    } else if (sscanf(line, "seat %d", &seat) != 1)
      fputs(line, stderr); /* such as an act that came after its time */
    if (line[0] == 'r' || strcmp(line, awaited) == 0)
      awaited[0] = '\0';
    const int acts = match.phase == CAROM_MATCH_STROKE || match.phase == CAROM_MATCH_PLACE;
    if (acts && line[0] != 'r' && match.seat == seat && awaited[0] == '\0')
      act(server);
  }
  return match.record.kind != CAROM_RECORD_END;
}
