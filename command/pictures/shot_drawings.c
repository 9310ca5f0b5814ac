/* What `carom shoot` draws. */
#include "pictures/shot_drawings.h"

#include "pictures/animation.h"
#include "pictures/moving_picture.h"
#include "pictures/picture.h"
#include "program/program.h"

bool drawings_asked(const drawings *d) {
  return d->path[PICTURE] != NULL || d->path[FILM] != NULL;
}

bool drawings_made(const drawings *d) {
  return d->text[PICTURE] != NULL || d->text[FILM] != NULL;
}

bool drawings_possible(const drawings *d) {
  return svg_possible(d->path[PICTURE]) && output_possible(d->path[FILM]);
}

void drawings_draw(drawings *d, const played *shots, int count, const char *footer) {
  static void (*const how[DRAWINGS])(FILE *, const played *, int, const char *) = {
      [PICTURE] = shots_draw, [FILM] = shots_animate};
  for (int k = 0; k < DRAWINGS; k++) {
    if (d->text[k] != NULL || d->path[k] == NULL)
      continue;
    FILE *out = open_text(&d->text[k], &d->size[k]);
    if (k == FILM && is_moving_picture(d->path[k]))
      shot_move(out, &shots[0]);
    else
      how[k](out, shots, count, footer);
    close_text(out, &d->text[k]);
  }
}

/* A drawing that was made. */
typedef struct written {
  const char *text;
  size_t size;
} written;

static void write_made(FILE *out, const void *data) {
  const written *m = data;
  fwrite(m->text, 1, m->size, out);
}

bool drawings_write(drawings *d) {
  bool good = true;
  for (int k = 0; k < DRAWINGS; k++) {
    const written m = {d->text[k], d->size[k]};
    if (d->text[k] != NULL && good)
      good = (k == FILM ? file_draw : svg_draw)(d->path[k], write_made, &m);
    free(d->text[k]);
    d->text[k] = NULL;
  }
  return good;
}
