/* Subcommands that are programs in Python: study/paper.py, lab/published.py, ... */
#ifndef CAROM_STUDY_PYTHON_H
#define CAROM_STUDY_PYTHON_H

#include <stdio.h>

/* Runs `tools/python -m MODULE WORDS...` of the source tree, whose Python has the modules `needs`
 * ("jinja2 pycparser"), and copies what it prints to `out`. `words` ends with NULL; each may hold
 * any character. Returns its exit code, or -1 if it could not be run or did not exit. */
int python_run(const char *needs, const char *module, const char *const words[], FILE *out);

#endif
