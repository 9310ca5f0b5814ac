/* `carom --report`: what a report of a bug needs. */
#ifndef CAROM_CLI_REPORT_H
#define CAROM_CLI_REPORT_H

/* Prints it, for a program of this name; gives an exit code. */
int print_report(const char *name);

#endif
