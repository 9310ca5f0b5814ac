/* server PORT SECONDS: nine-ball between the first two who connect, with SECONDS for a stroke. */
#include <carom_match.h>
#include <netinet/in.h>
#include <poll.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

enum { CLIENTS_MOST = 64, LINE_MOST = 8192 };
static carom_match match, scratch;
static char *recording;
static size_t recorded;                         /* bytes of the recording. */
static struct pollfd sockets[CLIENTS_MOST + 1]; /* of each seat, and the one that listens. */
static char lines[CLIENTS_MOST][LINE_MOST];     /* what has come from each seat. */
static size_t sizes[CLIENTS_MOST];              /* bytes of these. */

/* Nobody waits for a client: one that does not read must leave. */
static void send_to(int seat, const char *text, size_t size) {
  if (send(sockets[seat].fd, text, size, MSG_DONTWAIT | MSG_NOSIGNAL) != (ssize_t)size)
    shutdown(sockets[seat].fd, SHUT_RDWR);
}

static void publish(void) {
  recording = realloc(recording, recorded + (size_t)match.size);
  memcpy(recording + recorded, match.text, (size_t)match.size);
  recorded += (size_t)match.size;
  for (int k = 0; k < CLIENTS_MOST; k++)
    send_to(k, match.text, (size_t)match.size);
  if (match.phase == CAROM_MATCH_OVER && carom_match_end(&match) == CAROM_OK)
    publish();
}

static void receive(int seat) {
  char *const line = lines[seat], why[300];
  const ssize_t got = read(sockets[seat].fd, line + sizes[seat], LINE_MOST - sizes[seat]);
  sizes[seat] += got > 0 ? (size_t)got : 0;
  for (char *end; (end = memchr(line, '\n', sizes[seat])) != NULL;) {
    const int64_t known = match.record.line;
    const size_t size = (size_t)(end + 1 - line);
    if (carom_match_receive(&match, &scratch, line, size, seat) < 0)
      send_to(seat, why, (size_t)snprintf(why, sizeof why, "refused %s\n", match.fault));
    else if (match.record.line != known)
      publish();
    sizes[seat] -= size;
    memmove(line, end + 1, sizes[seat]);
  }
  if (got <= 0 || sizes[seat] == LINE_MOST) {
    close(sockets[seat].fd);
    sockets[seat].fd = -1;
  }
}

/* Who connects gets the first free seat, and the recording so far. */
static void let_in(int connection) {
  int seat = 0;
  while (seat < CLIENTS_MOST - 1 && sockets[seat].fd >= 0)
    seat++;
  close(sockets[seat].fd); /* where all are taken, the last one must leave */
  sockets[seat] = (struct pollfd){.fd = connection, .events = POLLIN};
  sizes[seat] = 0;
  char text[20];
  send_to(seat, recording, recorded);
  send_to(seat, text, (size_t)snprintf(text, sizeof text, "seat %d\n", seat));
}

int main(int count, char **words) {
  if (count != 3)
    return EXIT_FAILURE;
  struct sockaddr_in address = {.sin_family = AF_INET, .sin_port = htons((uint16_t)atoi(words[1]))};
  const int listening = socket(AF_INET, SOCK_STREAM, 0);
  setsockopt(listening, SOL_SOCKET, SO_REUSEADDR, &(int){1}, sizeof(int));
  if (bind(listening, (const void *)&address, sizeof address) != 0 || listen(listening, 8) != 0)
    return EXIT_FAILURE;
  memset(sockets, -1, sizeof sockets);
  sockets[CLIENTS_MOST] = (struct pollfd){.fd = listening, .events = POLLIN};
  carom_table table;
  carom_table_make(CAROM_TABLE_POOL_9FT, &table);
  carom_match_begin(&match, CAROM_RULES_NINEBALL, &table, 5, 0);
  publish();
  for (int64_t turn = -1, due = 0; match.phase != CAROM_MATCH_OVER;) {
    poll(sockets, CLIENTS_MOST + 1, 200);
    if (sockets[CLIENTS_MOST].revents != 0)
      let_in(accept(listening, NULL, NULL));
    for (int k = 0; k < CLIENTS_MOST; k++)
      if (sockets[k].fd >= 0 && sockets[k].revents != 0)
        receive(k);
    if (turn == match.rulings && time(NULL) >= due) { /* a foul; a stopped shot goes on */
      if (carom_match_clock(&match, match.seat) < 0)
        carom_match_continue(&match, NULL, NULL);
      publish();
    }
    if (turn != match.rulings && (turn >= 0 || sockets[1].fd >= 0))
      due = time(NULL) + atoi(words[2]);
    if (due > 0)
      turn = match.rulings;
  }
  sleep(1); /* in which all read the end */
}
