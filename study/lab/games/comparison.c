/* Chances compared with their results. */
#include "comparison.h"

#include <math.h>

void lab_compare(lab_comparison *row, double chance, double came) {
  row->predicted += chance;
  row->came += came;
  row->off += came - chance;
  row->strokes++;
}

void lab_compare_end(lab_comparison *rows, int count) {
  for (int k = 0; k < count; k++) {
    rows[k].variance += rows[k].off * rows[k].off;
    rows[k].off = 0.0;
  }
}

double lab_compare_error(const lab_comparison *row) {
  return sqrt(row->variance) / (double)row->strokes;
}
