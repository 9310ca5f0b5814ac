/* One step of a high order for an ordinary differential equation y' = f(y) whose right-hand side is a chain of dependent
 * operations: the explicit midpoint rule, extrapolated, with its sequences abreast.
 *
 * METHOD. With n substeps of H = h/n, n even,
 *
 *     y_1 = y_0 + H f(y_0)        y_(m+1) = y_(m-1) + 2 H f(y_m)
 *
 * the error of y_n has an expansion in H^2 (Gragg). The results of n = 2, 4, ..., 2 K are combined so that its first K - 1
 * terms vanish: order 2 K. E6 and E5 are what the combination moves if the coarsest, and then the next to that, is left out;
 * the errors of the orders 2 K - 2 and 2 K - 4.
 *
 * LANES. The sequences do not depend on each other. The longest has a lane of its own; in each of the others n = 2 (K - l) is
 * followed by n = 2 l, so (K + 1)/2 lanes take 2 K - 1 right-hand sides one after another, all filled: seven sequences cost the
 * time of 13 right-hand sides, since a processor can do other lanes while it waits for the results of one.
 *
 * The caller's right-hand side is inlined: it takes two lanes of each unknown, and a factor for the result.
 *
 * Source: E. Hairer, S. P. Norsett, G. Wanner, Solving Ordinary Differential Equations I, 2nd ed. (1993), section II.9. */
#ifndef CAROM_SRC_PLATFORM_EXTRAPOLATE_H
#define CAROM_SRC_PLATFORM_EXTRAPOLATE_H

typedef double carom_pair __attribute__((vector_size(16)));

enum { CAROM_EXTRAPOLATE_MOST_COLUMNS = 7, CAROM_EXTRAPOLATE_MOST = 8 /* unknowns */ };

/* prod n_i^2 / (n_i^2 - n_j^2) over the sequences: all; without the first; without the first two */
typedef struct carom_extrapolation {
  double all[CAROM_EXTRAPOLATE_MOST_COLUMNS], but_one[CAROM_EXTRAPOLATE_MOST_COLUMNS], but_two[CAROM_EXTRAPOLATE_MOST_COLUMNS];
} carom_extrapolation;
static const carom_extrapolation carom_extrapolation_7 = {
    {1.0 / 14515200, -32.0 / 42525, 19683.0 / 179200, -1048576.0 / 467775, 244140625.0 / 19160064, -629856.0 / 25025,
     13841287201.0 / 889574400},
    {0, -8.0 / 14175, 2187.0 / 22400, -65536.0 / 31185, 9765625.0 / 798336, -17496.0 / 715, 282475249.0 / 18532800},
    {0, 0, 243.0 / 4480, -16384.0 / 10395, 390625.0 / 38016, -15552.0 / 715, 5764801.0 / 411840}};
static const carom_extrapolation carom_extrapolation_3 = {{1.0 / 24, -16.0 / 15, 81.0 / 40}, {0, -4.0 / 5, 9.0 / 5}, {0, 0, 1}};

/* scale * f(y), for two lanes */
typedef void carom_lane_slope(const void *model, const carom_pair *y, carom_pair scale, carom_pair *f);

/* What a step gives for one unknown. */
typedef struct carom_extrapolated {
  double y, e_6, e_5; /* behind the step; see above */
} carom_extrapolated;

/* A step of length h from y_0, where f(y_0) = f_0, with `size` unknowns and K = `columns` sequences, 3 or 7. */
static inline __attribute__((always_inline)) void carom_extrapolate(int columns, int size, carom_lane_slope *slope,
                                                                    const void *model, const double *y_0, const double *f_0,
                                                                    double h, carom_extrapolated *out) {
  enum { MOST = CAROM_EXTRAPOLATE_MOST_COLUMNS, MOST_PAIRS = (MOST + 1) / 4 };
  const carom_extrapolation *weight = columns == MOST ? &carom_extrapolation_7 : &carom_extrapolation_3;
  const int pairs = (columns + 1) / 4;
  double end[CAROM_EXTRAPOLATE_MOST][MOST]; /* change of each unknown by each sequence */
  carom_pair y[MOST_PAIRS][CAROM_EXTRAPOLATE_MOST], before[MOST_PAIRS][CAROM_EXTRAPOLATE_MOST], twice[MOST_PAIRS];
  for (int q = 0; q < pairs; q++) {
    const carom_pair H = {h / (2 * (columns - 2 * q)), h / (2 * (columns - 2 * q - 1))};
    twice[q] = 2 * H;
    for (int i = 0; i < size; i++) {
      before[q][i] = y_0[i] + (carom_pair){0, 0};
      y[q][i] = before[q][i] + H * f_0[i];
    }
  }
#pragma GCC unroll 16
  for (int m = 1; m < 2 * columns; m++)
#pragma GCC unroll 2
    for (int q = 0; q < pairs; q++) {
      carom_pair f[CAROM_EXTRAPOLATE_MOST];
      slope(model, y[q], twice[q], f);
      for (int i = 0; i < size; i++) {
        const carom_pair next = before[q][i] + f[i];
        before[q][i] = y[q][i];
        y[q][i] = next;
      }
      /* lanes whose sequence has come to its end */
#pragma GCC unroll 2
      for (int l = 0; l < 2; l++) {
        const int lane = 2 * q + l;
        if (m + 1 == 2 * (columns - lane)) {
          const double H = lane > 0 ? h / (2 * lane) : 0;
          twice[q][l] = 2 * H;
          for (int i = 0; i < size; i++) {
            end[i][columns - lane - 1] = y[q][i][l] - y_0[i];
            before[q][i][l] = y_0[i];
            y[q][i][l] = y_0[i] + H * f_0[i];
          }
        } else if (lane > 0 && m == 2 * columns - 2)
          for (int i = 0; i < size; i++)
            end[i][lane - 1] = y[q][i][l] - y_0[i];
      }
    }
  for (int i = 0; i < size; i++) {
    double sum = 0, sum_6 = 0, sum_5 = 0;
    for (int k = 0; k < columns; k++) {
      sum += weight->all[k] * end[i][k];
      sum_6 += (weight->all[k] - weight->but_one[k]) * end[i][k];
      sum_5 += (weight->but_one[k] - weight->but_two[k]) * end[i][k];
    }
    out[i] = (carom_extrapolated){y_0[i] + sum, sum_6, sum_5};
  }
}

#endif
