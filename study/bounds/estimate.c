/* estimate: how many bits of this processor's estimate of 1/sqrt are correct.
 *
 * The estimate repeats with every factor of 4 in its argument x, so the floats from 1 up to 4 are
 * all cases. The relative error of an estimate y is |y sqrt(x) - 1|, in double precision; the
 * number of correct bits is -log2 of the largest error.
 *
 * Output: CSV, `error,bits`.
 */
#include <math.h>
#include <stdio.h>

#if defined(__x86_64__)
#include <xmmintrin.h>

int main(void) {
  double largest = 0.0;
  for (float x = 1.0F; x < 4.0F; x = nextafterf(x, 4.0F)) {
    const float estimate = _mm_cvtss_f32(_mm_rsqrt_ss(_mm_set_ss(x)));
    largest = fmax(largest, fabs((double)estimate * sqrt((double)x) - 1.0));
  }
  printf("error,bits\n%.6g,%.3f\n", largest, -log2(largest));
  return 0;
}

#else

int main(void) {
  fprintf(stderr, "skipped: the estimate is an instruction of x86-64\n");
  return 77;
}

#endif
