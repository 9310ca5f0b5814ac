/* Values out of JSON objects. */
#include "shots/json_values.h"

#include "program/program.h"
#include "rows/number.h"

#include <stdarg.h>

static void *json_memory(size_t size) {
  return allocate(size, 1);
}

void json_use_memory(void) {
  json_set_alloc_funcs(json_memory, free);
}

json_t *json_short(double x) {
  char text[NUMBER_TEXT];
  json_t *number = json_loads(number_text(x, text), JSON_DECODE_ANY, NULL);
  return number != NULL ? number : json_null(); /* NaN is no JSON */
}

void json_write_short(FILE *out, const json_t *value) {
  const char *separator = "", *key;
  char text[NUMBER_TEXT];
  json_t *part;
  size_t k;
  switch (json_typeof(value)) {
  case JSON_OBJECT:
    putc('{', out);
    json_object_foreach((json_t *)value, key, part) {
      fprintf(out, "%s\"%s\": ", separator, key);
      json_write_short(out, part);
      separator = ", ";
    }
    putc('}', out);
    break;
  case JSON_ARRAY:
    putc('[', out);
    json_array_foreach((json_t *)value, k, part) {
      fputs(separator, out);
      json_write_short(out, part);
      separator = ", ";
    }
    putc(']', out);
    break;
  case JSON_REAL:
    fputs(number_text(json_real_value(value), text), out);
    break;
  default:
    json_dumpf(value, out, JSON_ENCODE_ANY);
  }
}

bool json_wrong(json_fault *f, const char *format, ...) {
  va_list arguments;
  va_start(arguments, format);
  vsnprintf(f->text, sizeof f->text, format, arguments);
  va_end(arguments);
  return false;
}

bool json_get_part(const json_t *object, const char *where, carom_part_kind part, void *target,
                   json_fault *f) {
  const carom_number *n;
  for (int k = 0; (n = carom_number_of(part, k)) != NULL; k++) {
    const json_t *v = n->key[0] != '\0' ? json_object_get(object, n->key) : NULL;
    if (v != NULL && !json_is_number(v))
      return json_wrong(f, "%s%s must be a number", where, n->key);
    if (v != NULL && n->type == CAROM_TYPE_DOUBLE)
      memcpy((char *)target + n->offset, &(double){json_number_value(v)}, sizeof(double));
  }
  return true;
}

const char *json_keys_of(carom_part_kind part, const char *besides, char text[JSON_KEYS]) {
  const carom_number *n;
  int size = snprintf(text, JSON_KEYS, "%s", besides);
  for (int k = 0; (n = carom_number_of(part, k)) != NULL; k++)
    if (n->key[0] != '\0')
      size += snprintf(text + size, (size_t)(JSON_KEYS - size), " %s", n->key);
  return text;
}

bool json_only(const json_t *object, const char *where, const char *keys, json_fault *f) {
  const char *key;
  json_t *v;
  json_object_foreach((json_t *)object, key, v) {
    char hint[HINT_TEXT];
    if (place_among(keys, key, strlen(key)) < 0)
      return json_wrong(f, "%s%.40s is no key; there are %s%s", where, key, keys,
                        did_you_mean(key, keys, hint));
  }
  return true;
}

bool json_get_numbers(const json_t *array, const char *where, size_t count, double *value,
                      json_fault *f) {
  if (!json_is_array(array) || json_array_size(array) < count)
    return json_wrong(f, "%s must be an array of %zu numbers", where, count);
  for (size_t k = 0; k < count; k++) {
    const json_t *v = json_array_get(array, k);
    if (!json_is_number(v))
      return json_wrong(f, "%s[%zu] must be a number", where, k);
    value[k] = json_number_value(v);
  }
  return true;
}

bool json_get_id(const json_t *object, const char *where, char **id, json_fault *f) {
  const json_t *v = json_object_get(object, "id");
  char digits[32];
  if (json_is_integer(v)) {
    snprintf(digits, sizeof digits, "%lld", (long long)json_integer_value(v));
    *id = copy_text(digits);
  } else if (json_is_string(v)) {
    *id = copy_text(json_string_value(v));
  } else {
    return json_wrong(f, "%sid must be a text", where);
  }
  return true;
}

bool json_get_list(const json_t *object, const char *key, size_t most, const json_t **list,
                   json_fault *f) {
  *list = json_object_get(object, key);
  if (*list != NULL && !json_is_array(*list))
    return json_wrong(f, "%s must be an array", key);
  return json_array_size(*list) <= most ? true
                                        : json_wrong(f, "%s has more than %zu elements", key, most);
}
