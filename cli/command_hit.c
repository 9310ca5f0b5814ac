/* `carom hit`: one collision of a cue ball with a ball at rest, from speed, cut angle and spin; in words, as a row, as a
 * picture.
 *
 * The cue ball comes along +x. A cut above 0 sends the object ball to the left as seen from above.
 */
#include "command.h"
#include "derived.h"
#include "doubts.h"
#include "hit_picture.h"
#include "memory.h"
#include "message.h"
#include "number.h"
#include "output.h"
#include "shot_picture.h"
#include "subcommands.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_HITS = 16, NAME = 32 };

/* Spins or speeds as they were given. */
typedef struct name_list {
  char name[MOST_HITS][NAME];
  int count;
} name_list;

/* One of the collisions asked for: each spin at each speed. */
typedef struct one_hit {
  double speed;
  const char *spin;
  char id[2 * NAME];
} one_hit;

typedef struct hit {
  shared_options asked;
  double cut, radius, mass, cloth, restitution;
  name_list speeds, spins;
  one_hit hits[MOST_HITS];
  int count;
  const char *side;
  bool csv;
  const char *picture;
} hit;

/* The spin about the horizontal axis across the way, rad/s: above 0 for follow. NaN if the text is none. */
static double spin_of(const char *text, double rolling) {
  double value;
  switch (place_among("stun|follow|roll|draw", text, strlen(text))) {
  case 0:
    return 0.0;
  case 1:
  case 2:
    return rolling;
  case 3:
    return -rolling;
  default:
    return parse_number(text, &value) && isfinite(value) ? value : (double)NAN;
  }
}

static bool is_spin(const char *text) {
  return !isnan(spin_of(text, 1.0));
}

static bool is_speed(const char *text) {
  double value;
  return parse_number(text, &value) && value > 0.0 && isfinite(value);
}

/* Cuts a list with commas apart. */
static bool set_list(const option_row *row, char *text, name_list *list, bool (*is_one)(const char *), const char *what) {
  char *rest;
  list->count = 0;
  for (char *name = strtok_r(text, ",", &rest); name != NULL; name = strtok_r(NULL, ",", &rest)) {
    if (!is_one(name) || strlen(name) >= NAME || list->count == MOST_HITS) {
      complain("--%s is %s, or up to %d of them with commas, not '%.60s'", row->name, what, MOST_HITS, name);
      return false;
    }
    strcpy(list->name[list->count++], name);
  }
  if (list->count == 0)
    complain("--%s is %s", row->name, what);
  return list->count > 0;
}

static OPTION_SET(set_spins) {
  return set_list(row, text, field, is_spin, "stun, follow, roll, draw or a number of rad/s");
}

static OPTION_SET(set_speeds) {
  return set_list(row, text, field, is_speed, "a number of m/s above 0");
}

static OPTION_SET(set_side) {
  double value;
  *(const char **)field = text;
  if (strcmp(text, "gearing") == 0 || (parse_number(text, &value) && isfinite(value)))
    return true;
  complain("--%s is a number of rad/s or gearing, not '%s'", row->name, text);
  return false;
}

OPTION(hit, option_speed, "speed", speeds, 0, "V", set_speeds, 0,
       "speed of the cue ball at contact, m/s (default 1.5). Several with commas: several collisions, each spin at each speed");
OPTION(hit, option_cut, "cut", cut, 0, "DEGREES", set_number, 0,
       "angle from its way to the line of centres, -90 to 90; above 0 the object ball goes to the left (default 30)");
OPTION(hit, option_spin, "spin", spins, 0, "SPIN", set_spins, 0,
       "stun: none (default); follow or roll: it rolls; draw: as fast backwards; or a number, "
       "rad/s, above 0 for follow. Several with commas: several collisions");
OPTION(hit, option_side, "side", side, 0, "RAD/S", set_side, 0,
       "side spin, rad/s, above 0 for right english (counterclockwise from above), or gearing: "
       "as much as lets the balls roll on each other without slip (default 0)");
OPTION(hit, option_radius, "radius", radius, 0, "R", set_number, 0, "of the balls, m (default 0.028575, a pool ball)");
OPTION(hit, option_mass, "mass", mass, 0, "M", set_number, 0, "of the balls, kg (default 0.170097)");
OPTION(hit, option_cloth, "cloth", cloth, 0, "MU", set_number, 0, "friction with the cloth (default 0.2)");
OPTION(hit, option_restitution, "restitution", restitution, 0, "E", set_number, 0, "of the balls (default 0.95)");
OPTION(hit, option_csv, "csv", csv, 0, NULL, set_flag, 0,
       "write the collision as `carom resolve` reads it; its id is the spin, with several speeds spin-speed, such as draw-1.5");
OPTION(hit, option_plot, "plot", picture, 0, "OUT.svg", set_svg, 0, "draw the balls and their paths from above");

/* False after a complaint. */
static bool list_hits(hit *h) {
  if (h->speeds.count * h->spins.count > MOST_HITS) {
    complain("%d speeds times %d spins are too many; at most %d collisions", h->speeds.count, h->spins.count, MOST_HITS);
    return false;
  }
  for (int spin = 0; spin < h->spins.count; spin++)
    for (int speed = 0; speed < h->speeds.count; speed++) {
      one_hit *one = &h->hits[h->count++];
      one->spin = h->spins.name[spin];
      parse_number(h->speeds.name[speed], &one->speed);
      snprintf(one->id, sizeof one->id, h->speeds.count > 1 ? "%s-%s" : "%s", one->spin, h->speeds.name[speed]);
    }
  return true;
}

static carom_impact impact_of(const hit *h, const one_hit *one) {
  const double angle = h->cut * degree, rolling = one->speed / h->radius;
  carom_impact in = {.restitution = h->restitution};
  double side;
  if (!parse_number(h->side, &side)) /* gearing: the surfaces move alike along the tangent line */
    side = rolling * sin(angle);
  in.a = (carom_ball){.r = {0.0, 0.0, h->radius},
                      .v = {one->speed, 0.0, 0.0},
                      .w = {0.0, spin_of(one->spin, rolling), side},
                      .radius = h->radius,
                      .mass = h->mass,
                      .mu_cloth = h->cloth};
  in.b = (carom_ball){.r = {2.0 * h->radius * cos(angle), 2.0 * h->radius * sin(angle), h->radius},
                      .radius = h->radius,
                      .mass = h->mass,
                      .mu_cloth = h->cloth};
  in.mu_ball = carom_mu_ball(&in, h->asked.friction.law);
  return in;
}

static const char *side_of(double degrees) {
  return degrees > 0.0 ? "left" : "right";
}

/* "1.2 m/s, 30.0 degrees to the left"; angles are from the cue ball's way, which is +x. */
static const char *velocity_text(const double v[2], double scale, char text[64]) {
  const double speed = hypot(v[0], v[1]), angle = angle_between((const double[]){1.0, 0.0}, v);
  if (speed < 1e-9 * scale)
    snprintf(text, 64, "at rest");
  else {
    const int size = snprintf(text, 64, speed < 1e6 ? "%.3f m/s, " : "%.4g m/s, ", speed);
    if (fabs(angle) < 0.005 || fabs(angle) > 179.995)
      snprintf(text + size, (size_t)(64 - size), "straight %s", fabs(angle) < 90.0 ? "on" : "back");
    else
      snprintf(text + size, (size_t)(64 - size), "%.2f degrees to the %s", fabs(angle), side_of(angle));
  }
  return text;
}

static void tell_spin(FILE *out, const double w[3]) {
  const double level = hypot(w[0], w[1]), upright = fabs(w[2]) < 0.005 ? 0.0 : w[2]; /* not -0.00 */
  fprintf(out,
          fmax(fabs(w[2]), level) < 1e9
              ? "              spin after:  %.2f rad/s about the vertical, %.2f rad/s about a horizontal axis\n"
              : "              spin after:  %.4g rad/s about the vertical, %.4g rad/s about a horizontal axis\n",
          upright, level);
}

/* Says in words what came of a collision. */
static void tell_hit(FILE *out, const hit *h, const one_hit *one, const carom_impact *in, const carom_result *after) {
  const derived d = derive(in, after);
  const double energy = energy_of(in->a.mass, in->a.radius, in->a.v, in->a.w), scale = one->speed;
  char text[64];
  fprintf(out, "A cue ball at %.4g m/s meets a ball at rest: cut %.4g degrees, spin %s (%.4g rad/s), side spin %.4g rad/s.\n",
          one->speed, h->cut, one->spin, in->a.w[1], in->a.w[2]);
  fprintf(out, "Friction between the balls %.4f, with the cloth %.4g, restitution %.4g.\n", in->mu_ball, in->a.mu_cloth,
          in->restitution);
  /* The object ball, the cue ball, both together. */
  fprintf(out, "object ball   at once:     %s\n", velocity_text(after->b.v, scale, text));
  fprintf(out, "              rolling:     %s\n", velocity_text(d.rolling_2, scale, text));
  if (fabs(d.throw_deg) < 0.005)
    fputs("              throw:       none: it leaves along the line of centres\n", out);
  else
    fprintf(out, "              throw:       %.2f degrees to the %s of the line of centres\n", fabs(d.throw_deg),
            side_of(d.throw_deg));
  tell_spin(out, after->b.w);
  fprintf(out, "cue ball      at once:     %s\n", velocity_text(after->a.v, scale, text));
  fprintf(out, "              rolling:     %s\n", velocity_text(d.rolling_1, scale, text));
  tell_spin(out, after->a.w);
  if (isfinite(d.energy_lost))
    fprintf(out, "energy        lost:        %.2f %% of %.4g J\n", 100.0 * d.energy_lost, energy);
  else
    fputs("energy        lost:        cannot be told: the energies are beyond the range of numbers\n", out);
}

static void write_row(FILE *out, const char *id, const carom_impact *in) {
  const double pair[4] = {in->a.mu_cloth, in->b.mu_cloth, in->mu_ball, in->restitution};
  fputs(id, out);
  write_numbers(out, in->a.r, 9);
  write_numbers(out, in->b.r, 9);
  write_numbers(out, &in->a.radius, 2);
  write_numbers(out, pair, 4);
  fputc('\n', out);
}

/* Every collision is resolved before anything is written. */
static bool resolve_all(const hit *h, carom_impact *in, carom_result *out) {
  doubts found = {0};
  bool strange = false;
  for (int k = 0; k < h->count; k++) {
    int field;
    in[k] = impact_of(h, &h->hits[k]);
    const carom_status status = carom_collide(&in[k], &h->asked.options, &out[k]);
    if (status != CAROM_OK) {
      carom_check(&in[k], &h->asked.options, &field);
      complain("no such collision: %s%s%s (%s)", field >= 0 ? carom_field_name(field) : "", field >= 0 ? ": " : "",
               carom_status_string(status), carom_status_name(status));
      return false;
    }
    strange |= doubts_about(&found, &ball_kind, (const double *)&in[k]) != NULL;
  }
  doubts_report(&found, &ball_kind, "hit");
  return !(h->asked.strict && strange);
}

/* Draws the first of the hits, with what is told of it. */
static bool draw_first(const hit *h, const carom_impact *in, const carom_result *result) {
  char *text;
  size_t size;
  FILE *out = open_memstream(&text, &size);
  if (out == NULL)
    out_of_memory();
  if (h->count > 1)
    complain("%s shows the first of the %d collisions, '%s'", h->picture, h->count, h->hits[0].id);
  tell_hit(out, h, &h->hits[0], in, result);
  fclose(out);
  const bool good = hit_draw(h->picture, in, result, text);
  free(text);
  return good;
}

static bool write_hits(const hit *h, const carom_impact *in, const carom_result *result) {
  FILE *out = output_open(h->asked.output);
  if (out == NULL)
    return false;
  if (h->csv)
    fputs("id,r1x,r1y,r1z,v1x,v1y,v1z,w1x,w1y,w1z,r2x,r2y,r2z,v2x,v2y,v2z,w2x,w2y,w2z,R,M,u_s1,u_s2,u_b,e_b\n", out);
  for (int k = 0; k < h->count; k++) {
    if (h->csv)
      write_row(out, h->hits[k].id, &in[k]);
    else {
      fputs(k > 0 ? "\n" : "", out);
      tell_hit(out, h, &h->hits[k], &in[k], &result[k]);
    }
  }
  return output_commit() && (h->picture == NULL || draw_first(h, in, result));
}

static const command_form form = {
    .name = "hit",
    .usage = "[OPTIONS]",
    .about = "Hits a ball at rest with the cue ball and tells in words what becomes of both: throw, deflection, spin, speeds "
             "at once and once they roll. Angles are from the way that the cue ball came, as seen from above.\n",
    .options = (const option_row *const[]){&option_speed, &option_cut, &option_spin, &option_side, &option_friction,
                                           &option_restitution, &option_cloth, &option_radius, &option_mass, &option_solver,
                                           &option_slip, &option_steps, &option_csv, &option_plot, &option_strict,
                                           &option_output, NULL},
    .details = "friction between the balls follows --friction; default: alciatore.\n\n"
               "exit code: 0; 2 for bad usage or a collision that cannot be\n",
    .example = "carom hit --speed 1.5 --cut 30 --spin draw --plot hit.svg",
    .files = NO_FILES,
};

int command_hit(int argc, char **argv) {
  hit h = {.asked = {.options = COMMAND_OPTIONS, .friction = {.law = carom_alciatore()}, .output = "-"},
           .cut = 30.0,
           .radius = 0.028575,
           .mass = 0.170097,
           .cloth = 0.2,
           .restitution = 0.95,
           .speeds = {.name = {"1.5"}, .count = 1},
           .spins = {.name = {"stun"}, .count = 1},
           .side = "0"};
  carom_impact in[MOST_HITS];
  carom_result out[MOST_HITS];
  const int code = parse_arguments(&form, argc, argv, &h, NULL);
  if (code >= 0)
    return code;
  if (!(fabs(h.cut) < 90.0)) {
    complain("--cut is between -90 and 90 degrees; at 90 the balls do not meet");
    return EXIT_USAGE;
  }
  if (!list_hits(&h))
    return EXIT_USAGE;
  return resolve_all(&h, in, out) && write_hits(&h, in, out) ? EXIT_GOOD : EXIT_USAGE;
}
