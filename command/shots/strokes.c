/* The strokes of a subcommand: of a file of shots, or by its options. */
#include "shots/strokes.h"

#include "program/program.h"
#include "shots/given_shots.h"
#include "shots/shot_fault.h"

bool with_fits_file(const given_numbers *with) {
  if (with->lists > 0)
    complain("--with: several values of a parameter need a shot by options; give one for a file");
  else if (with->slope[0] != 0.0 || with->slope[1] != 0.0)
    complain("--with: the fit has a slope; give slope_x %g, slope_y %g to a table of the file",
             with->slope[0], with->slope[1]);
  else
    return true;
  return false;
}

/* layout_moment */
static bool set_layout(const option_row *row, char *text, void *field) {
  int place;
  if (!set_place(row, text, row->argument, &place))
    return false;
  *(int *)field = (int)LAYOUT_START + place;
  return true;
}

const option_row option_layout = {
    .name = "from",
    .argument = "start|final",
    .help = "with a file of shots: start from the balls before each shot, or from its recorded "
            "final states",
    .else_usual = "start, but a line with final states is an error",
    .set = set_layout,
    .field = offsetof(shared_options, layout)};

layout_moment played_again(const shared_options *shared) {
  return shared->layout == LAYOUT_FINAL ? LAYOUT_FINAL : LAYOUT_START;
}

shot_file *layout_open(shoot_flags *f, const char *path, const carom_shot_options *options,
                       int most) {
  const bool by_options = has_flags(f);
  if (by_options && path != NULL)
    complain("'%.80s': a file has its own balls; give either it or --cue and --balls",
             name_of_file(path));
  else if (!by_options && path == NULL)
    complain("there are no balls; give a file of shots, or --cue 0.6,0.8 --balls 0.5,1.6:0.9,1.2");
  else if (by_options)
    return flags_open(f, options, most);
  else if (with_fits_file(&f->shared.with))
    return shot_file_open(path, options->cushion_model, (layout_moment)f->shared.layout);
  return NULL;
}

/* Whether the balls of two shots are the same ones in the same places. */
static bool same_balls(const shot_line *a, const shot_line *b) {
  if (a->count != b->count || a->cue.ball != b->cue.ball)
    return false;
  for (int k = 0; k < a->count; k++)
    if (memcmp(&a->ball[k], &b->ball[k], sizeof a->ball[k]) != 0)
      return false;
  return true;
}

/* Why a shot cannot be the next stroke after `strokes` others, of which `first` is the first; ""
 * where the reader has complained already, and NULL where it can. */
static const char *stroke_fault(shot_read outcome, const shot_line *shot, const shot_line *first,
                                int strokes, int most, char text[FAULT_TEXT]) {
  if (outcome == SHOT_FAILED)
    return "";
  if (shot->error != NULL)
    return shot->error;
  if (strokes == most) {
    snprintf(text, FAULT_TEXT, "there are more strokes than %d, the most that are read", most);
    return text;
  }
  if (strokes > 0 && !same_balls(shot, first))
    return "the balls must be those of the first shot; `carom shoot` plays layouts that differ";
  return NULL;
}

int strokes_read(shot_file *file, const shared_options *shared, shot_line *line, carom_cue *cues,
                 int most) {
  shot_line next;
  char text[FAULT_TEXT];
  uint64_t warned = 0;
  int strokes = 0;
  while (strokes == 0 || most > 1) {
    const shot_read outcome = shot_file_next_shot(file, &next);
    if (outcome == SHOT_END)
      break;
    if (outcome == SHOT_SHOT)
      shot_numbers(&next, shared, shot_file_name(file), &warned);
    const char *fault = stroke_fault(outcome, &next, line, strokes, most, text);
    if (fault != NULL && fault[0] != '\0')
      complain("%s:%zu: %s", shot_file_name(file), next.number, fault);
    if (fault == NULL)
      cues[strokes++] = next.cue;

    /* The first shot stays as *line. */
    if (fault == NULL && strokes == 1)
      *line = next;
    else if (outcome == SHOT_SHOT)
      shot_line_free(&next);
    if (fault != NULL) {
      if (strokes > 0)
        shot_line_free(line);
      return 0;
    }
  }
  if (strokes == 0)
    complain("%s: there is no shot", shot_file_name(file));
  return strokes;
}
