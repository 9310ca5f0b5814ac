/* `carom kernels`: the table of kernels. */
#include "command.h"
#include "kernel.h"
#include "message.h"

#include <getopt.h>
#include <stdio.h>

static const char help[] =
    "usage: carom kernels\n\n"
    "Lists the kernels that `resolve --kernel` takes and `verify` checks; the first is the default. Those of the ladder, the\n"
    "seed paper's kernels, exist once per compiler and configuration: --config names both (gcc-o3) or the configuration alone\n"
    "(o3: the first compiler listed).\n";

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
  printf("%-15s %-10s %s\n", "kernel", "precision", "what it is");
  const kernel *one;
  for (size_t k = 0; (one = kernel_at(k)) != NULL; k++)
    if (!one->is_rung || ladder_rung_runs(ladder_rung_find(one->name)))
      printf("%-15s %-10s %s%s\n", one->name, one->precision, one->is_rung ? "ladder: " : "", one->text);
  printf("\nconfigurations of the ladder:");
  const char *module;
  for (size_t k = 0; (module = ladder_module_name(k)) != NULL; k++)
    printf(" %s", module);
  puts(ladder_module_name(0) == NULL ? " none here" : "");
  return EXIT_GOOD;
}
