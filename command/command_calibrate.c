/* `carom calibrate`: the cushion of a player's table, by three banks: how to play them, what the
 * readings tell, a picture, and a file for --with. */
#include "pictures/colours.h"
#include "pictures/palette.h"
#include "pictures/picture.h"
#include "program/program.h"
#include "shots/shot_table.h"
#include "subcommands.h"

#include <jansson.h>

typedef struct calibrate_job {
  shared_options shared;
  int table; /* among `tables` */
  double reading[CAROM_BANKS];
  bool read;
  const char *picture;
} calibrate_job;

static const carom_table_kind tables[] = {CAROM_TABLE_POOL_9FT, CAROM_TABLE_POOL_8FT,
                                          CAROM_TABLE_POOL_7FT};

/* Three numbers with commas between them. */
static OPTION_SET(set_readings) {
  double *reading = field;
  calibrate_job *job = (calibrate_job *)(void *)((char *)field - row->field);
  char rest;
  job->read = sscanf(text, "%lf,%lf,%lf%c", &reading[0], &reading[1], &reading[2], &rest) == 3;
  return job->read || refuse_value(row, text, "not three sights with commas; try 4.8,5.8,5.6");
}

OPTION(calibrate_job, calibrate_table, "table", table, "9ft|8ft|7ft", set_choice, 0, "the table",
       .usual = "9ft", .noun = "table of pool");
OPTION(calibrate_job, calibrate_read, "read", reading, "A,B,C", set_readings, 0,
       "where the three banks returned, in sights from their corner, to a tenth: 4.8 is just "
       "before the fifth sight");
OPTION(calibrate_job, calibrate_plot, "plot", picture, "OUT", set_picture, 0,
       "draw the three banks. OUT.svg, OUT.png or OUT.pdf");

static const command_form form = {
    .name = "calibrate",
    .usual = (const option_usual[]){{.name = "output", .else_usual = "none"}, {0}},
    .usage = "[OPTIONS]",
    .about =
        "Finds the restitution and the friction of a pool table's cushions from three banks that "
        "you play. Without --read, carom describes these banks, and where they return on a usual "
        "table. With --read it reports both constants with their standard deviations, and -o "
        "writes them to a file for --with of `carom shoot`, `plan`, `ways` and `break`.\n"
        "Put the cue ball near the corner, on the line from the corner through a sight of the "
        "opposite long rail. Play it along that line without english, and read the sight at which "
        "it touches the first long rail again.\n",
    .options = (const option_row *const[]){&calibrate_table, &calibrate_read, &calibrate_plot,
                                           &option_output, NULL},
    .details = "exit code: 0; 1 if the readings contradict each other; 2 for bad usage\n",
    .example = "carom calibrate --read 4.8,5.8,5.6 -o my.json",
    .files = NO_FILES,
};

/* How the stroke of a bank is said. */
static const char *stroke_of(const carom_bank *bank) {
  return bank->roll > 0.5 ? "soft, so that it rolls" : "hard, at its centre";
}

static void tell(FILE *out, const calibrate_job *job, const carom_calibration *usual,
                 const carom_calibration *found) {
  for (int k = 0; k < CAROM_BANKS; k++) {
    carom_bank bank;
    carom_bank_of(k, &bank);
    fprintf(out, "bank %d  from the corner through sight %.1f, %s (%.1f m/s): usually back at %.1f",
            k + 1, bank.aim, stroke_of(&bank), bank.speed, usual->comes_back[k]);
    if (job->read)
      fprintf(out, ", read %.1f, by these numbers %.1f", job->reading[k], found->comes_back[k]);
    putc('\n', out);
  }
  if (!job->read)
    return;
  fprintf(out, "restitution  %.3f +- %.3f; usually %.2f\n", found->restitution,
          found->restitution_error, usual->restitution);
  fprintf(out, "friction     %.3f +- %.3f; usually %.2f\n", found->friction, found->friction_error,
          usual->friction);
}

/* The two numbers as the file of a fit has them. */
static bool write_preset(const char *path, const carom_ball_kind *kind,
                         const carom_calibration *found) {
  FILE *out = output_open(path);
  if (out == NULL)
    return false;
  json_t *preset =
      json_pack("{s:s,s:f,s:{s:f,s:f},s:{s:f,s:f}}", "cushion_model", "smooth", "radius",
                kind->radius, "constants", "restitution_cushion", found->restitution, "mu_cushion",
                found->friction, "spread", "restitution_cushion", found->restitution_error,
                "mu_cushion", found->friction_error);
  json_dumpf(preset, out, JSON_INDENT(1) | JSON_REAL_PRECISION(6));
  putc('\n', out);
  json_decref(preset);
  return output_commit();
}

/* ---- The picture */

typedef struct banks_picture {
  const carom_table *table;
  const carom_calibration *usual;
} banks_picture;

/* The table lies: sights run along the picture, and the corner is on the left below. */
static void draw(FILE *out, const void *data) {
  static const double scale = 300.0, edge = 70.0, sight = 0.094; /* pixels a meter, pixels, m */
  const banks_picture *p = data;
  const double length = p->table->length * scale, width = p->table->width * scale,
               diamond = length / 8.0;
  const table_colours colours = colours_of(p->table);
  const double letters = svg_letters(length + 2.0 * edge);
  char frame[64];
  snprintf(frame, sizeof frame, "rx=\"%.0f\" fill=\"%s\"", scale * PALETTE_SIZE_CORNER,
           colours.wood);
  svg_begin(out, length + 2.0 * edge, width + 2.0 * edge + 60.0, frame);
  fprintf(out,
          "<rect x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\" fill=\"%s\" "
          "stroke=\"" PALETTE_NOSE "\" stroke-width=\"%.1f\"/>\n",
          edge, edge, length, width, colours.cloth, scale * PALETTE_SIZE_NOSE);

  /* sights, and their numbers */
  const double below = edge + width + sight * scale, above = edge - sight * scale;
  for (int k = 1; k < 8; k++) {
    char name[12];
    snprintf(name, sizeof name, "%d", k);
    svg_circle(out, edge + k * diamond, below, 3.0, "fill=\"" PALETTE_MARK "\"");
    svg_circle(out, edge + k * diamond, above, 3.0, "fill=\"" PALETTE_MARK "\"");
    svg_text(out, edge + k * diamond + 8.0, below + 5.0, name, 4,
             "font-size=\"%.1f\" fill=\"" PALETTE_MARK "\"", letters);
    svg_text(out, edge + k * diamond + 8.0, above + 5.0, name, 4,
             "font-size=\"%.1f\" fill=\"" PALETTE_MARK "\"", letters);
  }

  /* the line of aim to its sight, and the way back from where it meets the rail */
  for (int k = 0; k < CAROM_BANKS; k++) {
    carom_bank bank;
    carom_bank_of(k, &bank);
    const double share = (p->table->width + sight) / (p->table->width + 2.0 * sight);
    const double rail_point = edge - sight * scale + share * (bank.aim * diamond + sight * scale);
    const double back = edge + p->usual->comes_back[k] * diamond;
    fprintf(out,
            "<path d=\"M%.1f %.1fL%.1f %.1fL%.1f %.1f\" fill=\"none\" stroke=\"%s\" "
            "stroke-width=\"2.2\"/>\n",
            edge, edge + width, rail_point, edge, back, edge + width, line_colour(k + 1));
    char words[100];
    snprintf(words, sizeof words, "%d: through %.1f, %s: back at %.1f", k + 1, bank.aim,
             stroke_of(&bank), p->usual->comes_back[k]);
    svg_text(out, edge, below + 35.0 + 20.0 * k, words, 60, "font-size=\"%.1f\" fill=\"%s\"",
             letters, line_colour(k + 1));
  }
  fputs("</svg>\n", out);
}

int command_calibrate(int argc, char **argv) {
  calibrate_job job = {.shared = {.options = COMMAND_OPTIONS}};
  const int code = parse_arguments(&form, argc, argv, &job, NULL);
  if (code >= 0)
    return code;
  carom_table table;
  carom_table_make(tables[job.table], &table);
  const carom_ball_kind kind = carom_ball_kind_of(carom_game_of_table(tables[job.table]));

  /* the usual table, and this one */
  carom_calibration usual, found;
  carom_calibrate(&table, &kind, NULL, &usual);
  found = usual;
  if (job.read) {
    const carom_status status = carom_calibrate(&table, &kind, job.reading, &found);
    if (status != CAROM_OK) {
      complain("--read: no bank returns there, between the sights 0 and 8; try about "
               "%.1f,%.1f,%.1f",
               usual.comes_back[0], usual.comes_back[1], usual.comes_back[2]);
      return EXIT_USAGE;
    }
  } else if (job.shared.output != NULL) {
    complain("--output: there is nothing to write; give --read with the three readings");
    return EXIT_USAGE;
  }
  tell(stdout, &job, &usual, &found);
  const banks_picture picture = {&table, &usual};
  if ((job.picture != NULL && !svg_draw(job.picture, draw, &picture)) ||
      (job.shared.output != NULL && !write_preset(job.shared.output, &kind, &found)))
    return EXIT_USAGE;
  if (found.misfit <= 2.0)
    return EXIT_GOOD;
  complain("the readings fit no cushion, by %.1f cm; read again, and mind the speeds",
           2.5 * found.misfit);
  return EXIT_SOME;
}
