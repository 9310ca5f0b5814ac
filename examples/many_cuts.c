/* Many collisions in one call: a sliding cue ball without spin meets a resting ball at every cut
 * angle from 0 to
 * 89.9 degrees.
 *
 * The throw is the angle by which friction turns the object ball off the line of centres;
 * without friction it is 0. Thin cuts slip fast, and friction falls with speed; full hits stop
 * slipping before the end: the example prints where the throw is greatest.
 */
#include <carom.h>
#include <math.h>
#include <stdio.h>

enum { CUTS = 900 };

int main(void) {
  static carom_impact in[CUTS];
  static carom_result out[CUTS];
  static int8_t status[CUTS];
  const double speed = 1.5, radius = 0.02625, degree = 3.14159265358979323846 / 180.0;
  for (int k = 0; k < CUTS; k++) {
    const double cut = 0.1 * k * degree, v_x = speed * sin(cut), v_y = speed * cos(cut);
    in[k].a = (carom_ball){.v = {v_x, v_y, 0.0}, .radius = radius, .mass = 0.14, .mu_slide = 0.2};
    in[k].b = (carom_ball){
        .r = {0.0, 2.0 * radius, 0.0}, .radius = radius, .mass = 0.14, .mu_slide = 0.2};
    in[k].mu_ball = carom_mu_ball(&in[k], carom_alciatore()); /* falls with the speed of the slip */
    in[k].restitution = 0.89;
  }
  if (carom_collide_batch(in, CUTS, NULL, out, status) != CAROM_OK)
    return 1;
  int most = 0;
  for (int k = 0; k < CUTS; k++)
    if (fabs(atan2(out[k].b.v[0], out[k].b.v[1])) > fabs(atan2(out[most].b.v[0], out[most].b.v[1])))
      most = k;
  printf("%d collisions on %s: the greatest throw, %.2f degrees, is at a cut of %.1f degrees\n",
         CUTS, carom_word(CAROM_WORDS_ISA, (int)carom_isa_in_force()),
         fabs(atan2(out[most].b.v[0], out[most].b.v[1])) / degree, 0.1 * most);
  return 0;
}
