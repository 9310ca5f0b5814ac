/* driver: runs one kernel of one module of the ladder, so that callgrind can count what was
 * timed.
 *
 *     driver MODULE.so                        what the module is: compiler, version, flags, and the
 *                                             fingerprint, as `carom-lab bench` notes them
 *     driver MODULE.so KERNEL STEPS < cases   one case a line: the 26 numbers of carom_impact in
 *                                             the order of the struct
 *
 * The sum of the results is printed, so that two runs can be compared.
 */
#include "fingerprint.h"
#include "module.h"

#include <dlfcn.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool read_ball(carom_ball *ball) {
  double *field[] = {&ball->r[0], &ball->r[1],   &ball->r[2], &ball->v[0],
                     &ball->v[1], &ball->v[2],   &ball->w[0], &ball->w[1],
                     &ball->w[2], &ball->radius, &ball->mass, &ball->mu_slide};
  for (size_t k = 0; k < sizeof field / sizeof *field; k++)
    if (scanf("%lf", field[k]) != 1)
      return false;
  return true;
}

static double run_all(carom_rung *run, int steps) {
  carom_impact in;
  double sum = 0.0;
  while (read_ball(&in.a) && read_ball(&in.b) &&
         scanf("%lf %lf", &in.mu_ball, &in.restitution) == 2) {
    const carom_frame frame = carom_frame_of(&in);
    carom_local state = carom_to_frame(&frame, &in, CAROM_SLIP_POOLTOOL);
    run(&state, steps);
    sum += state.v_ix + state.v_jy + state.w_iz;
  }
  return sum;
}

int main(int argc, char **argv) {
  void *module = argc > 1 ? dlopen(argv[1], RTLD_NOW) : NULL;
  ladder_contents_of *contents_of = NULL;
  if (module != NULL)
    *(void **)&contents_of = dlsym(module, LADDER_SYMBOL);
  if (contents_of == NULL || (argc != 2 && argc != 4)) {
    fprintf(stderr, "driver: %s\n",
            argc > 1 && contents_of == NULL ? dlerror()
                                            : "usage: driver MODULE.so [KERNEL STEPS < cases]");
    return 2;
  }
  const ladder_contents *contents = contents_of();
  char fingerprint[FINGERPRINT_SIZE];
  if (!file_fingerprint(argv[1], fingerprint)) {
    fprintf(stderr, "driver: cannot read %s\n", argv[1]);
    return 2;
  }
  if (argc == 2)
    printf("%s-%s: %s, %s, %s\nmodule %s-%s: %s\n", contents->compiler, contents->config,
           contents->compiler, contents->version, contents->flags, contents->compiler,
           contents->config, fingerprint);
  for (size_t k = 0; argc == 4 && k < contents->count; k++)
    if (strcmp(contents->rung[k].name, argv[2]) == 0)
      printf("%.17g\n", run_all(contents->rung[k].run, atoi(argv[3])));
  return 0;
}
