/* The subcommands of `carom`, a file each: command_NAME.c. */
#ifndef CAROM_CLI_SUBCOMMANDS_H
#define CAROM_CLI_SUBCOMMANDS_H

int command_resolve(int argc, char **argv);
int command_hit(int argc, char **argv);
int command_rail(int argc, char **argv);
int command_shoot(int argc, char **argv);
int command_calibrate(int argc, char **argv);
int command_models(int argc, char **argv);
int command_record(int argc, char **argv);
int command_replay(int argc, char **argv);
int command_verify(int argc, char **argv);
int command_match(int argc, char **argv);
int command_plan(int argc, char **argv);
int command_ways(int argc, char **argv);
int command_break(int argc, char **argv);

#endif
