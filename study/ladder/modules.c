/* Loads the modules of the ladder, and refuses those that may not run here. */
#include "cpu.h"
#include "fingerprint.h"
#include "ladder.h"
#include "module.h"

#include <dlfcn.h>

enum {
  RUNGS = 0
#define RUNG(name, parent, precision, isa, width, bound, paper, over_1e3, over_1e2, idea) +1
#include "kernels.def"
#undef RUNG
};

typedef struct slot {
  const char *compiler, *config, *name;
  bool loaded;
  char fingerprint[FINGERPRINT_SIZE];
  ladder_module module;
  carom_rung *run[RUNGS];
} slot;

static slot slots[] = {
#define MODULE(cc, setting) {.compiler = cc, .config = setting, .name = cc "-" setting},
#include "ladder_modules.def"
#undef MODULE
    {.name = NULL},
};

const char *ladder_module_name(size_t k) {
  return k < sizeof slots / sizeof slots[0] ? slots[k].name : NULL;
}

/* False, with the reason in `why`, if the module is not one of these sources or not for this
 * processor. */
static bool may_run(const ladder_contents *contents, const char *path, char why[LADDER_WHY_SIZE]) {
  char cpu[LADDER_CPU_SIZE];
  ladder_cpu(cpu);
  bool same = contents->state_size == sizeof(carom_local) && contents->count == RUNGS;
  for (size_t k = 0; same && k < RUNGS; k++)
    same = strcmp(contents->rung[k].name, ladder_rung_at(k)->name) == 0;
  if (!same)
    snprintf(why, LADDER_WHY_SIZE, "%s was built from other sources; build again", path);
  else if (strcmp(contents->cpu, cpu) != 0)
    snprintf(why, LADDER_WHY_SIZE,
             "%s was built for another processor, %s; this is %s: build again on this machine",
             path, contents->cpu, cpu);
  return same && strcmp(contents->cpu, cpu) == 0;
}

static bool load(slot *entry, char why[LADDER_WHY_SIZE]) {
  char path[sizeof LADDER_MODULE_DIR + 64];
  snprintf(path, sizeof path, "%s/ladder-%s.so", LADDER_MODULE_DIR, entry->name);
  if (!file_fingerprint(path, entry->fingerprint))
    strcpy(entry->fingerprint, "unknown");
  void *library = dlopen(path, RTLD_NOW | RTLD_LOCAL);
  ladder_contents_of *contents_of = NULL;
  if (library != NULL)
    *(void **)&contents_of = dlsym(library, LADDER_SYMBOL);
  if (contents_of == NULL) {
    snprintf(why, LADDER_WHY_SIZE, "cannot load %s (%s); build again", path, dlerror());
    return false;
  }
  const ladder_contents *contents = contents_of();
  if (!may_run(contents, path, why)) {
    dlclose(library);
    return false;
  }
  for (size_t k = 0; k < RUNGS; k++)
    entry->run[k] = contents->rung[k].run;
  entry->module = (ladder_module){
      .name = entry->name,
      .compiler = contents->compiler,
      .version = contents->version,
      .config = contents->config,
      .flags = contents->flags,
      .fingerprint = entry->fingerprint,
      .run = entry->run,
  };
  entry->loaded = true;
  return true;
}

const ladder_module *ladder_module_find(const char *name, char why[LADDER_WHY_SIZE]) {
  for (slot *entry = slots; entry->name != NULL; entry++)
    if (strcmp(entry->name, name) == 0 || strcmp(entry->config, name) == 0)
      return entry->loaded || load(entry, why) ? &entry->module : NULL;
  size_t length = (size_t)snprintf(why, LADDER_WHY_SIZE, "no configuration '%s'; there are", name);
  for (const slot *entry = slots; entry->name != NULL; entry++)
    if (length < LADDER_WHY_SIZE)
      length += (size_t)snprintf(why + length, LADDER_WHY_SIZE - length, " %s", entry->name);
  if (slots[0].name == NULL)
    snprintf(why, LADDER_WHY_SIZE, "this build has no kernels of the ladder: " LADDER_ABSENT);
  return NULL;
}
