/* Values out of JSON objects, with the key that is at fault where one is not what it should be. */
#ifndef CAROM_CLI_JSON_VALUES_H
#define CAROM_CLI_JSON_VALUES_H

#include <jansson.h>
#include <stdbool.h>

typedef struct json_fault {
  char text[512];
} json_fault;

/* Says what is wrong; returns false. */
__attribute__((format(printf, 2, 3))) bool json_wrong(json_fault *f, const char *format, ...);

/* The numbers of an object by their keys, with a blank between them, into doubles in the same
 * order, which stay as they are where there is no such key. `where` stands before the key in
 * what is said. */
bool json_get_doubles(const json_t *object, const char *where, const char *keys, double *to,
                      json_fault *f);

/* Whether an object has no key but these. */
bool json_only(const json_t *object, const char *where, const char *keys, json_fault *f);

/* The first `count` numbers of an array. */
bool json_get_numbers(const json_t *array, const char *where, size_t count, double *value,
                      json_fault *f);

/* object.id, a text or a whole number, as a new text. */
bool json_get_id(const json_t *object, const char *where, char **id, json_fault *f);

/* The array object[key] with at most `most` elements, or NULL where there is none. */
bool json_get_list(const json_t *object, const char *key, size_t most, const json_t **list,
                   json_fault *f);

#endif
