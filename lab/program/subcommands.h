/* The subcommands of `carom-lab`, a file each: command_NAME.c. */
#ifndef CAROM_LAB_SUBCOMMANDS_H
#define CAROM_LAB_SUBCOMMANDS_H

int command_kernels(int argc, char **argv);
int command_resolve(int argc, char **argv);
int command_trace(int argc, char **argv);
int command_verify(int argc, char **argv);
int command_bench(int argc, char **argv);
int command_experiments(int argc, char **argv);
int command_learn(int argc, char **argv);
int command_parity(int argc, char **argv);
int command_plan(int argc, char **argv);
int command_published(int argc, char **argv);
int command_stress(int argc, char **argv);

#endif
