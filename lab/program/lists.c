/* Lists that options grow. */
#include "lists.h"

#include "memory.h"
#include "message.h"

#include <string.h>

void add_count(count_list *list, int value) {
  list->value = grow(list->value, &list->room, list->count + 1, sizeof *list->value);
  list->value[list->count++] = value;
}

OPTION_SET(set_names) {
  name_list *list = field;
  const size_t before = list->count;
  char *rest;
  for (char *name = strtok_r(text, ",", &rest); name != NULL; name = strtok_r(NULL, ",", &rest)) {
    list->name = grow(list->name, &list->room, list->count + 1, sizeof *list->name);
    list->name[list->count++] = name;
  }
  if (list->count == before)
    complain("--%s needs a name", row->name);
  return list->count > before;
}

OPTION_SET(set_counts) {
  count_list *list = field;
  const size_t before = list->count;
  int value;
  char *rest, *one;
  for (one = strtok_r(text, ",", &rest); one != NULL && set_count(row, one, &value); one = strtok_r(NULL, ",", &rest))
    add_count(list, value);
  return one == NULL && (list->count > before || set_count(row, text + strlen(text), &value));
}
