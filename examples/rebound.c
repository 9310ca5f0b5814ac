/* Rebound: the angle at which a rolling ball leaves a cushion, by four models of the cushion.
 *
 * The angles are those of the velocity from the normal of the cushion, just after the impact. A
 * mirror keeps the tangent of the angle over e. A cushion with friction takes speed along it, and
 * turns the forward roll into a part of the rebound. With an argument the curves are drawn there:
 *
 *     rebound rebound.svg
 */
#include <carom_shot.h>
#include <math.h>
#include <stdio.h>

static const double degree = 57.29577951308232;

/* The angle after, for a ball that rolls at 2 m/s at an angle from the normal, degrees. */
static double leaves_at(carom_cushion_model model, double angle) {
  const carom_ball_kind ball = carom_ball_kind_of(CAROM_GAME_POOL);
  const double x = 2.0 * sin(angle / degree), y = 2.0 * cos(angle / degree), R = ball.radius;
  const carom_cushion_impact in = {.v = {x, y, 0.0},
                                   .w = {-y / R, x / R, 0.0},
                                   .normal = {0.0, 1.0},
                                   .height = 1.28 * R,
                                   .radius = R,
                                   .mass = ball.mass,
                                   .mu_slide = ball.mu_slide,
                                   .mu_cushion = ball.mu_cushion,
                                   .restitution = ball.restitution_cushion};
  carom_motion out;
  const carom_status status = carom_cushion(&in, &(carom_cushion_options){.model = model}, &out);
  return status == CAROM_OK ? degree * atan2(out.v[0], -out.v[1]) : NAN;
}

int main(int argc, char **argv) {
  static const carom_cushion_model models[] = {CAROM_CUSHION_MATHAVAN, CAROM_CUSHION_HAN,
                                               CAROM_CUSHION_STRONGE, CAROM_CUSHION_MIRROR};
  static const char *const colours[] = {"black", "#0072b2", "#d55e00", "#009e73"};
  FILE *picture = argc > 1 ? fopen(argv[1], "w") : NULL;
  if (argc > 1 && picture == NULL)
    return fprintf(stderr, "%s cannot be written\n", argv[1]);
  if (picture != NULL)
    fprintf(picture,
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"-15 -95 150 110\" "
            "font-size=\"4\">\n<rect x=\"-15\" y=\"-95\" width=\"150\" height=\"110\" "
            "fill=\"white\"/>\n<path d=\"M0 -90V0H85\" fill=\"none\" stroke=\"grey\" "
            "stroke-width=\"0.3\"/>\n<text x=\"30\" y=\"10\">angle before, degrees</text>\n"
            "<text x=\"2\" y=\"-88\">angle after, degrees</text>\n");
  for (int mark = 20; picture != NULL && mark <= 80; mark += 20)
    fprintf(picture, "<text x=\"%d\" y=\"5\">%d</text>\n<text x=\"-7\" y=\"%d\">%d</text>\n",
            mark - 2, mark, 1 - mark, mark);
  int bad = 0;
  for (int m = 0; m < 4; m++) {
    const char *name = carom_word(CAROM_WORDS_CUSHION_MODEL, (int)models[m]);
    if (picture != NULL)
      fprintf(picture,
              "<text x=\"95\" y=\"%d\" font-size=\"5\" fill=\"%s\">%s</text>\n<polyline "
              "fill=\"none\" stroke=\"%s\" stroke-width=\"0.6\" stroke-dasharray=\"%s\" points=\"",
              -90 + 7 * m, colours[m], name, colours[m], m == 2 ? "2" : "none");
    for (int angle = 0; angle <= 80; angle += 2) {
      const double after = leaves_at(models[m], angle);
      bad += !(after >= -1e-9 && after < 90.0);
      if (angle % 20 == 0)
        printf("%-9s in at %2d, out at %5.2f degrees\n", name, angle, after);
      if (picture != NULL)
        fprintf(picture, "%d,%.2f ", angle, -after);
    }
    if (picture != NULL)
      fprintf(picture, "\"/>\n");
  }
  if (picture != NULL && (fprintf(picture, "</svg>\n") < 0 || fclose(picture) != 0))
    return 1;
  /* a mirror changes the normal speed alone: tan(out) = tan(in)/e */
  const double e = carom_ball_kind_of(CAROM_GAME_POOL).restitution_cushion;
  const double mirrored = degree * atan(tan(40.0 / degree) / e);
  return bad != 0 || fabs(leaves_at(CAROM_CUSHION_MIRROR, 40.0) - mirrored) > 1e-9;
}
