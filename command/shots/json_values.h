/* Values out of JSON objects, with the key that is at fault where one is not what it should be. */
#ifndef CAROM_CLI_JSON_VALUES_H
#define CAROM_CLI_JSON_VALUES_H

#include "carom_shot.h"

#include <jansson.h>
#include <stdbool.h>
#include <stdio.h>

typedef struct json_fault {
  char text[512];
} json_fault;

/* Has Jansson take its memory as the command does, so that no value is missing for want of it. It
 * is called before any value is made. */
void json_use_memory(void);

/* A number as the shortest text that reads back the same says it: 2, not 2.0. */
json_t *json_short(double x);

/* Writes a value with such numbers. */
void json_write_short(FILE *out, const json_t *value);

/* Says what is wrong; returns false. */
__attribute__((format(printf, 2, 3))) bool json_wrong(json_fault *f, const char *format, ...);

/* The doubles of a struct by the keys of its numbers, which stay as they are where there is no such
 * key. `where` stands before the key in what is said. */
bool json_get_part(const json_t *object, const char *where, carom_part_kind part, void *target,
                   json_fault *f);

/* All its keys, with a blank between them, behind others. */
enum { JSON_KEYS = 700 };
const char *json_keys_of(carom_part_kind part, const char *besides, char text[JSON_KEYS]);

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
