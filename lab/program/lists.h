/* Lists that options grow: names and whole numbers with commas between; repeating the option adds to them. */
#ifndef CAROM_LAB_LISTS_H
#define CAROM_LAB_LISTS_H

#include "options.h"

/* Names point into the argument vector, whose commas become ends. */
typedef struct name_list {
  const char **name;
  size_t count, room;
} name_list;

typedef struct count_list {
  int *value;
  size_t count, room;
} count_list;

void add_count(count_list *list, int value);

OPTION_SET(set_names);  /* name_list */
OPTION_SET(set_counts); /* count_list: each from row->least */

#endif
