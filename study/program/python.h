/* Subcommands that are programs in Python: study/paper.py, study/lab/published.py, ... */
#ifndef CAROM_STUDY_PYTHON_H
#define CAROM_STUDY_PYTHON_H

/* Runs `tools/python -m MODULE WORDS...` of the source tree, whose Python has the modules `needs`
 * ("jinja2 pycparser"), and writes what it prints to `output`, as output_open() names it. `words`
 * ends with NULL; each may hold any character. Returns the exit code of the subcommand. */
int python_command(const char *needs, const char *module, const char *const words[],
                   const char *output);

/* Appends an option and its value to words that end with NULL, unless the value is NULL. */
void python_option(const char *words[], const char *option, const char *value);

#endif
