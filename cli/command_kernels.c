/* `carom kernels`: the table of kernels. */
#include "command.h"
#include "kernel.h"
#include "message.h"

#include <getopt.h>
#include <stdio.h>

static const char help[] = "usage: carom kernels\n\n"
                           "Lists the kernels that `resolve --kernel` takes and `verify` checks; the first is the default.\n";

int command_kernels(int argc, char **argv) {
  static const struct option options[] = {{"help", no_argument, NULL, 'h'}, {0}};
  int option;
  while ((option = getopt_long(argc, argv, "h", options, NULL)) != -1) {
    if (option != 'h')
      return usage_hint("kernels");
    fputs(help, stdout);
    return EXIT_GOOD;
  }
  if (optind < argc) {
    complain("kernels takes no arguments, but got '%s'", argv[optind]);
    return usage_hint("kernels");
  }
  printf("%-12s %-10s %s\n", "kernel", "precision", "what it is");
  const kernel *one;
  for (size_t k = 0; (one = kernel_at(k)) != NULL; k++)
    printf("%-12s %-10s %s\n", one->name, one->precision, one->text);
  return EXIT_GOOD;
}
