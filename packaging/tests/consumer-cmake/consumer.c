/* The smallest program that resolves a collision, as a user of the installed library would write
 * it. */
#include <carom.h>
#include <stdio.h>

int main(void) {
  carom_impact in = {.a = {.v = {0.0, 1.0, 0.0}, .radius = 0.03, .mass = 0.17, .mu_slide = 0.2},
                     .mu_ball = 0.05,
                     .restitution = 1.0};
  carom_result out;
  in.b = in.a;
  in.b.r[1] = 0.06;
  in.b.v[1] = 0.0;
  const carom_status status = carom_collide(&in, NULL, &out);
  printf("carom %s: %s, v = %g and %g m/s\n", carom_version(), carom_status_string(status),
         out.a.v[1], out.b.v[1]);
  return status == CAROM_OK && out.b.v[1] > 0.99 && out.b.v[1] < 1.01 ? 0 : 1;
}
