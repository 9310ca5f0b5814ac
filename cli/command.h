/* The subcommands of `carom` and the exit codes they share. */
#ifndef CAROM_CLI_COMMAND_H
#define CAROM_CLI_COMMAND_H

enum {
  EXIT_GOOD = 0,  /* all went well */
  EXIT_SOME = 1,  /* some rows in error, or a claim not met; the rest was done */
  EXIT_USAGE = 2, /* bad usage or unreadable input; nothing was written */
};

/* X(name, one line of help). Each command_NAME gets its own arguments, argv[0] being its name, and returns an exit code. */
#define COMMAND_LIST(X)                                          \
  X(resolve, "resolve the collisions of a CSV file")             \
  X(verify, "compare every kernel with the references")          \
  X(trace, "follow one collision on its way")                    \
  X(sweep, "resolve one collision, one input varied finely")     \
  X(experiments, "compare with the 2014 paper's measured shots") \
  X(bench, "time every kernel, once it is verified")             \
  X(report, "measure all, draw the figures, write the page")     \
  X(kernels, "list the kernels that resolve and verify know")

#define COMMAND_PROTOTYPE(name, text) int command_##name(int argc, char **argv);
COMMAND_LIST(COMMAND_PROTOTYPE)
#undef COMMAND_PROTOTYPE

#endif
