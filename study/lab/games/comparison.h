/* Chances that plans report, compared with the results of their strokes. */
#ifndef CAROM_LAB_COMPARISON_H
#define CAROM_LAB_COMPARISON_H

/* A row of the comparison. `off` is the result of the strokes of one game minus the prediction.
 * They are not independent, so the variance adds up off^2 game by game. */
typedef struct lab_comparison {
  double predicted, came, variance, off;
  long strokes;
} lab_comparison;

/* Adds a chance and the result: 1, 0, or 0.5 for a draw. */
void lab_compare(lab_comparison *row, double chance, double came);
/* Ends a game of `count` rows. */
void lab_compare_end(lab_comparison *rows, int count);
/* The standard error of the result minus the prediction, for a row with strokes. */
double lab_compare_error(const lab_comparison *row);

#endif
