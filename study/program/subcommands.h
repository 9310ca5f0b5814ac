/* The study's subcommands of `carom-lab`, a file each: command_NAME.c. */
#ifndef CAROM_STUDY_SUBCOMMANDS_H
#define CAROM_STUDY_SUBCOMMANDS_H

int command_bench(int argc, char **argv);
int command_bounds(int argc, char **argv);
int command_experiments(int argc, char **argv);
int command_kernels(int argc, char **argv);
int command_paper(int argc, char **argv);
int command_resolve(int argc, char **argv);
int command_trace(int argc, char **argv);
int command_verify(int argc, char **argv);

#endif
