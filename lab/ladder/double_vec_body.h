/* Their function, from `state` and N to the end. FRICTION is constants of the file, STEP(1) is a step of compression, STEP(0)
 * of restitution. */
const carom_local c = *state;
const double M = c.M_i;
const double recM = 1.0 / M;
const double C = 5.0 / (2.0 * M * c.R);

__m256d v = _mm256_setr_pd(c.v_ix, c.v_iy, c.v_jx, c.v_jy);
__m256d w = _mm256_setr_pd(c.w_ix, c.w_iy, c.w_jx, c.w_jy);
__m128d w_z = _mm_setr_pd(c.w_iz, c.w_jz);
double v_n = c.v_jy - c.v_iy;

const double DP = 0.5 * (1.0 + c.e) * M * fabs(v_n) / N;
double W = 0.0;

const __m128d R = _mm_set1_pd(c.R);
const __m256d sR = _mm256_setr_pd(c.s * c.R, -c.s *c.R, c.s *c.R, -c.s *c.R);
const __m128d mu_b_DP = _mm_set1_pd(-c.mu_b * DP);
FRICTION;
const __m256d v_of_DP = _mm256_setr_pd(0.0, -DP *recM, 0.0, DP *recM);
const __m256d v_of_DP1 = _mm256_setr_pd(recM, 0.0, -recM, 0.0);
const __m128d w_z_of_DP1 = _mm_set1_pd(-C);
const __m256d w_of_DP2 = _mm256_setr_pd(C, 0.0, C, 0.0);
const __m256d v_of_cloth = _mm256_set1_pd(recM);
const __m256d w_of_cloth = _mm256_setr_pd(C, -C, C, -C); /* of the impulse with x and y swapped */

__m128d u = slip_of_balls(v, w, w_z, R);
__m256d db = slip_on_cloth(v, w, sR);
__m128d ru = rlength(u);

while (v_n <= 0.0) {
  STEP(1);
  const double v_n_old = v_n;
  const __m128d v_ji = _mm_sub_pd(_mm256_extractf128_pd(v, 1), _mm256_castpd256_pd128(v));
  v_n = _mm_cvtsd_f64(_mm_unpackhi_pd(v_ji, v_ji));
  W -= v_n_old + v_n;
}

const double W_f = (1.0 + c.e * c.e) * W;
while (W < W_f) {
  STEP(0);
  const double v_n_old = v_n;
  const __m128d v_ji = _mm_sub_pd(_mm256_extractf128_pd(v, 1), _mm256_castpd256_pd128(v));
  v_n = _mm_cvtsd_f64(_mm_unpackhi_pd(v_ji, v_ji));
  W += v_n_old + v_n;
}
double v_of[4], w_of[4], w_z_of[2];
_mm256_storeu_pd(v_of, v);
_mm256_storeu_pd(w_of, w);
_mm_storeu_pd(w_z_of, w_z);
state->v_ix = v_of[0], state->v_iy = v_of[1], state->v_jx = v_of[2], state->v_jy = v_of[3];
state->w_ix = w_of[0], state->w_iy = w_of[1], state->w_jx = w_of[2], state->w_jy = w_of[3];
state->w_iz = w_z_of[0], state->w_jz = w_z_of[1];
