/* Messages to the user on stderr. */
#ifndef CAROM_CLI_MESSAGE_H
#define CAROM_CLI_MESSAGE_H

/* Prints "carom: ", the message and a newline on stderr, clear of a progress line that may stand there. */
__attribute__((format(printf, 1, 2))) void complain(const char *format, ...);

/* After getopt_long() has complained about an option of `command`: says where help is, returns EXIT_USAGE. */
int usage_hint(const char *command);

#endif
