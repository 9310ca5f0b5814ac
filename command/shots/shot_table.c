/* Tables from JSON, and those that are built in, with the ids that pooltool gives their parts. */
#include "shots/shot_table.h"

#include "program/program.h"
#include "rows/values.h"

void free_table(named_table *t) {
  for (int k = 0; k < CAROM_RAILS_MOST; k++)
    free(t->rail[k]);
  for (int k = 0; k < CAROM_JAWS_MOST; k++)
    free(t->jaw[k]);
  for (int k = 0; k < CAROM_POCKETS_MOST; k++)
    free(t->pocket[k]);
  free(t->id);
  free(t);
}

static bool read_rail(const json_t *v, const char *where, carom_rail *rail, char **id,
                      json_fault *f) {
  double p[3], q[3];
  char key[80];
  snprintf(key, sizeof key, "%sp1", where);
  if (!json_get_numbers(json_object_get(v, "p1"), key, 3, p, f))
    return false;
  snprintf(key, sizeof key, "%sp2", where);
  if (!json_get_numbers(json_object_get(v, "p2"), key, 3, q, f))
    return false;
  *rail = (carom_rail){.p = {p[0], p[1]}, .q = {q[0], q[1]}, .height = p[2]};
  static const char *const line[] = {"lx", "ly", "l0"};
  for (int k = 0; k < 3; k++) {
    const json_t *number = json_object_get(v, line[k]);
    if (number != NULL && !json_is_number(number))
      return json_wrong(f, "%s%s must be a number", where, line[k]);
    rail->line[k] = json_number_value(number);
  }
  if (!json_get_part(v, where, CAROM_PART_RAIL, rail, f))
    return false;
  const json_t *direction = json_object_get(v, "direction");
  const double side = direction != NULL ? json_number_value(direction) : NAN;
  if (side != 0.0 && side != 1.0)
    return json_wrong(f, "%sdirection must be 0 or 1", where);
  rail->side = side == 1.0;
  return json_get_id(v, where, id, f);
}

static bool read_circle(const json_t *v, const char *where, double centre[2], double *third,
                        char **id, json_fault *f) {
  double c[3] = {0.0};
  char key[80];
  snprintf(key, sizeof key, "%scenter", where);
  const size_t numbers = json_array_size(json_object_get(v, "center")) >= 3 ? 3 : 2;
  if (!json_get_numbers(json_object_get(v, "center"), key, numbers, c, f))
    return false;
  centre[0] = c[0];
  centre[1] = c[1];
  *third = c[2];
  return json_object_get(v, "radius") == NULL ? json_wrong(f, "%sradius is missing", where)
                                              : json_get_id(v, where, id, f);
}

bool read_table(const json_t *json, named_table *t, json_fault *f) {
  const json_t *list, *v;
  size_t k;
  char where[64];
  carom_table *table = &t->table;
  if (!json_get_id(json, "", &t->id, f) || !json_get_part(json, "", CAROM_PART_TABLE, table, f) ||
      !json_get_list(json, "linear", CAROM_RAILS_MOST, &list, f))
    return false;
  json_array_foreach((json_t *)list, k, v) {
    snprintf(where, sizeof where, "linear[%zu].", k);
    if (!read_rail(v, where, &table->rail[k], &t->rail[k], f))
      return false;
    table->rails++;
  }
  if (!json_get_list(json, "circular", CAROM_JAWS_MOST, &list, f))
    return false;
  json_array_foreach((json_t *)list, k, v) {
    carom_jaw *jaw = &table->jaw[k];
    snprintf(where, sizeof where, "circular[%zu].", k);
    if (!read_circle(v, where, jaw->centre, &jaw->height, &t->jaw[k], f) ||
        !json_get_part(v, where, CAROM_PART_JAW, jaw, f))
      return false;
    table->jaws++;
  }
  if (!json_get_list(json, "pockets", CAROM_POCKETS_MOST, &list, f))
    return false;
  json_array_foreach((json_t *)list, k, v) {
    carom_pocket *pocket = &table->pocket[k];
    double unused;
    snprintf(where, sizeof where, "pockets[%zu].", k);
    pocket->depth = 0.08;
    if (!read_circle(v, where, pocket->centre, &unused, &t->pocket[k], f) ||
        !json_get_part(v, where, CAROM_PART_POCKET, pocket, f))
      return false;
    table->pockets++;
  }
  return true;
}

carom_table_kind table_of_rack(carom_rack_kind rack) {
  const char *game = carom_word(CAROM_WORDS_RACK, (int)rack), *name;
  for (int kind = 0; (name = carom_word(CAROM_WORDS_TABLE, kind)) != NULL; kind++)
    if (same_text(name, game))
      return (carom_table_kind)kind;
  return CAROM_TABLE_POOL_9FT;
}

/* Changes measures by "corner=4.25in,side_cut=104", which it cuts up. */
static bool give_measures(char *keys, carom_measures *m, json_fault *f) {
  char known[JSON_KEYS], hint[HINT_TEXT], range[100], *rest = NULL;
  for (char *key = strtok_r(keys, ",", &rest); key != NULL; key = strtok_r(NULL, ",", &rest)) {
    char *text = key + strcspn(key, "=");
    const carom_number *n;
    value v;
    int k = 0;
    if (*text != '\0')
      *text++ = '\0';
    while ((n = carom_number_of(CAROM_PART_MEASURES, k)) != NULL && !same_text(n->key, key))
      k++;
    json_keys_of(CAROM_PART_MEASURES, "", known);
    if (n == NULL)
      return json_wrong(f, "no measure '%.40s'; try %s, as `carom models` lists them", key,
                        words_to_try(key, known + 1, hint));
    carom_number_range(n, range, sizeof range);
    const int measure = measure_of_unit(n->unit);
    if (!value_of(measure, text, &v))
      return json_wrong(f, "%s '%.40s' must be %s; try %s", key, text, range,
                        measure == MEASURE_LENGTH ? "0.1 or 4.25in" : "a number in this range");
    memcpy((char *)m + n->offset, &v.x, sizeof v.x);
  }
  return true;
}

/* Says what is wrong with measures. */
static bool tell_measures(carom_status status, const carom_table_fault *fault, json_fault *f) {
  char range[100];
  if (fault->part.kind != CAROM_PART_MEASURES && fault->gap > 0.0)
    return json_wrong(f, "%s; %.3g m are open at x = %.4g, y = %.4g m", carom_status_string(status),
                      fault->gap, fault->place[0], fault->place[1]);
  if (fault->part.kind != CAROM_PART_MEASURES)
    return json_wrong(f, "%s", carom_status_string(status));
  const carom_number *n = carom_number_of(CAROM_PART_MEASURES, fault->part.index);
  carom_number_range(n, range, sizeof range);
  if (fault->other.kind != CAROM_PART_MEASURES)
    return json_wrong(f, "%s must be %s", n->key, range);
  return json_wrong(f, "%s must be below %.4g m with this %s", n->key, fault->gap,
                    carom_number_of(CAROM_PART_MEASURES, fault->other.index)->key);
}

char *table_spelt(char *text) {
  const size_t size = strcspn(text, ",");
  const char *word;
  for (int k = 0; (word = carom_word(CAROM_WORDS_TABLE, k)) != NULL; k++) {
    if (strlen(word) == size && strncmp(text, word, size) == 0)
      return text;
    if (same_word(text, size, word, strlen(word))) {
      const size_t room = strlen(word) + strlen(text + size) + 1;
      char *spelt = allocate(room, 1); /* kept, as arguments are */
      snprintf(spelt, room, "%s%s", word, text + size);
      return spelt;
    }
  }
  return text;
}

/* Tables that need no line, by the name of carom_table_make()'s kinds, and measures behind it. */
named_table *built_in_table(const char *id, json_fault *f) {
  static const char *const rails[] = {"3",  "6", "15", "12", "18", "9",  "5",  "4",  "13",
                                      "14", "1", "2",  "8",  "7",  "11", "10", "16", "17"};
  static const char *const plain[] = {"3", "12", "9", "18"};
  static const char *const jaws[] = {"1t",  "2t",  "4t",  "5t",  "7t",  "8t",
                                     "10t", "11t", "13t", "14t", "16t", "17t"};
  static const char *const pockets[] = {"lb", "lc", "lt", "rb", "rc", "rt"};
  const char *name;
  const size_t size = strcspn(id, ",");
  int kind = 0;
  f->text[0] = '\0';
  while ((name = carom_word(CAROM_WORDS_TABLE, kind)) != NULL &&
         (strlen(name) != size || strncmp(id, name, size) != 0))
    kind++;
  if (name == NULL)
    return NULL;
  named_table *t = allocate(1, sizeof *t);
  t->id = copy_text(id);
  carom_table_make((carom_table_kind)kind, &t->table);
  if (id[size] != '\0') {
    carom_measures m;
    carom_table_fault fault;
    char *keys = copy_text(id + size);
    carom_table_measures((carom_table_kind)kind, &m);
    bool good = give_measures(keys, &m, f);
    free(keys);
    if (good) {
      const double R = carom_ball_kind_of(carom_game_of_table((carom_table_kind)kind)).radius;
      const carom_status status = carom_table_measured(&m, R, &t->table, &fault);
      good = status == CAROM_OK || tell_measures(status, &fault, f);
    }
    if (!good) {
      free_table(t);
      return NULL;
    }
  }
  for (int k = 0; k < t->table.rails; k++)
    t->rail[k] = copy_text(t->table.rails == 4 ? plain[k] : rails[k]);
  for (int k = 0; k < t->table.jaws; k++)
    t->jaw[k] = copy_text(jaws[k]);
  for (int k = 0; k < t->table.pockets; k++)
    t->pocket[k] = copy_text(pockets[k]);
  return t;
}
