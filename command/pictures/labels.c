/* Labels: each is tried in directions from its place, by its left end, middle and right end,
 * ever farther away, until its box is free; a line ties it to its place from afar. */
#include "pictures/labels.h"

#include "pictures/palette.h"
#include "pictures/picture.h"
#include "rows/quantities.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

enum { MOST_CHARACTERS = 200, TURNS = 16, ANCHORS = 3 };
/* widest letter and height, over the size */
static const double letter = 7.6 / 13.0, line = 16.0 / 13.0;
static const double farthest = 900.0; /* pixels */

void keep_free(labels *l, double left, double top, double right, double bottom) {
  if (l->boxes < MOST_BOXES)
    memcpy(l->box[l->boxes++], (double[4]){left, top, right, bottom}, sizeof l->box[0]);
}

void keep_line(labels *l, double x0, double y0, double x1, double y1) {
  const int pieces = 1 + (int)fmin(hypot(x1 - x0, y1 - y0) / 12.0, 200.0);
  const double *last = l->boxes > 0 ? l->box[l->boxes - 1] : NULL;
  /* hundreds of short pieces of a ball that is pushed along need no box each */
  if (last != NULL && fmax(fabs(x1 - last[0] - 3.0), fabs(y1 - last[1] - 3.0)) < 1.0)
    return;
  for (int k = 0; k <= pieces; k++) {
    const double x = x0 + (x1 - x0) * k / pieces, y = y0 + (y1 - y0) * k / pieces;
    keep_free(l, x - 3.0, y - 3.0, x + 3.0, y + 3.0);
  }
}

static bool is_free(const labels *l, const double box[4]) {
  bool good = box[0] > 2.0 && box[2] < l->width - 2.0 && box[1] > 2.0 && box[3] < l->height - 2.0;
  for (int k = 0; k < l->boxes; k++)
    good &= box[2] < l->box[k][0] || box[0] > l->box[k][2] || box[3] < l->box[k][1] ||
            box[1] > l->box[k][3];
  return good;
}

void put_label(labels *l, double x, double y, const char *text) {
  const double width = letter * l->size * (double)strlen(text), height = line * l->size;
  double box[4] = {0};
  bool found = false;
  for (double far = 4.0; far < farthest && !found; far += 8.0)
    for (int turn = 0; turn < TURNS * ANCHORS && !found; turn++) {
      const double angle = 360.0 / TURNS * (turn / ANCHORS) * degree,
                   anchor = turn % ANCHORS * width / (ANCHORS - 1);
      const double left = x + far * cos(angle) - anchor, base = y + far * sin(angle) + 0.5 * height;
      memcpy(box, (double[]){left, base - height, left + width, base}, sizeof box);
      found = is_free(l, box);
    }
  if (!found)
    return;
  keep_free(l, box[0], box[1], box[2], box[3]);
  /* a label that stands away is tied to its place */
  const double nearest[2] = {fmin(fmax(x, box[0]), box[2]), fmin(fmax(y, box[1]), box[3])};
  if (hypot(nearest[0] - x, nearest[1] - y) > 1.5 * l->size)
    fprintf(l->out,
            "<path class=\"tie\" d=\"M%.1f %.1fL%.1f %.1f\" stroke=\"" PALETTE_MARK "\" "
            "stroke-width=\"1\"/>\n",
            x, y, nearest[0], nearest[1]);
  svg_text(l->out, box[0], box[3] - 0.25 * height, text, MOST_CHARACTERS,
           "font-size=\"%.1f\" fill=\"" PALETTE_TEXT "\" stroke=\"" PALETTE_NOSE
           "\" stroke-width=\"3\" "
           "paint-order=\"stroke\"",
           l->size);
}
