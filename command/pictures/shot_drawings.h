/* What `carom shoot` draws: a picture, a page with the film. They are kept in
 * memory until the shots are written: one file at a time is written whole. */
#ifndef CAROM_CLI_SHOT_DRAWINGS_H
#define CAROM_CLI_SHOT_DRAWINGS_H

#include "pictures/shot_picture.h"

enum { PICTURE, FILM, DRAWINGS };

typedef struct drawings {
  const char *path[DRAWINGS]; /* NULL: not asked for */
  char *text[DRAWINGS];       /* NULL: not drawn yet */
  size_t size[DRAWINGS];
} drawings;

bool drawings_asked(const drawings *d);
bool drawings_made(const drawings *d);

/* Whether they could be written; complains where not. */
bool drawings_possible(const drawings *d);

/* Draws those that are asked for and not drawn yet; `footer` as of shots_draw(). */
void drawings_draw(drawings *d, const played *shots, int count, const char *footer);

/* Writes them and frees them; false after a complaint. */
bool drawings_write(drawings *d);

#endif
