/* Texts of the help that several subcommands share. A line is one paragraph; the help wraps it. */
#ifndef CAROM_CLI_HELP_H
#define CAROM_CLI_HELP_H

#include "rows/kind.h"

#define COLLISION_COLUMNS_HELP                                                                     \
  "columns of CSV for collisions of two balls, in SI units and any order (others are ignored):\n"  \
  "  id                   optional; the number of the row if absent\n"                             \
  "  r1x r1y r1z          centre of ball 1, m; likewise r2x ... for ball 2\n"                      \
  "  v1x v1y v1z          velocity, m/s; v1z must be 0\n"                                          \
  "  w1x w1y w1z          angular velocity, rad/s\n"                                               \
  "  R M                  radius, m, and mass, kg (or R1 and R2, which must be equal, and M1 and " \
  "M2)\n"                                                                                          \
  "  u_s1 u_s2            friction of each ball with the cloth, 0 to 1 (or u_s for both)\n"        \
  "  u_b e_b              friction between the balls, and restitution, 0 to 1\n"                   \
  "An array IN.npy has the shape (n, 26). A row holds the numbers of carom_impact in their "       \
  "order: r1, v1, w1, R, M, u_s1, the same of ball 2, u_b, e_b.\n"

#define IMPACT_COLUMNS_HELP                                                                        \
  "columns of CSV for impacts on a cushion, with --cushion:\n"                                     \
  "  id                   optional; the number of the row if absent\n"                             \
  "  vx vy vz wx wy wz    velocity, m/s (vz must be 0), and angular velocity, rad/s\n"             \
  "  nx ny                horizontal direction into the cushion, of any length; default: 0 1\n"    \
  "  R M h                radius, m, mass, kg, and height of the nose above the cloth, m\n"        \
  "  mu_s mu_w e          friction with the cloth and with the cushion, and restitution, 0 to 1\n" \
  "  rho                  radius of a jaw, m; default: 0, a straight rail\n"                       \
  "An array IN.npy has the shape (n, 15). A row holds the numbers of carom_cushion_impact in "     \
  "their order: v, w, nx, ny, h, R, M, mu_s, mu_w, e, rho.\n"

#define RESOLVE_ABOUT                                                                             \
  "Reads a collision from each row and writes the motion after it. IN is a CSV file, - for CSV "  \
  "on standard input, or a NumPy array IN.npy of float64 or float32. OUT is CSV; or an array in " \
  "the chosen precision if its name ends in .npy, with NaN in rows with errors.\n"

#define RESULTS_HELP                                                                              \
  "columns written: id," RESULT_COLUMNS ",status\n"                                               \
  "  status is ok, separating (the balls do not approach; their state is unchanged) or the name " \
  "of an error, with nan for the numbers. Each number reads back to the same double.\n"

#define RESOLVE_EXIT_HELP                                                                          \
  "exit code: 0 if every row is ok or separating; 1 if some rows have errors; 2 for bad usage or " \
  "unreadable input. Standard error names at most a thousand rows with errors; the other rows "    \
  "are resolved.\n"

#endif
