/* What shots are on, as BibTeX: one row an entry, with the models that use it. The command, the
 * Python package and CITATION.cff have their references from here. */
#include "carom_shot.h"
#include "platform/arithmetic.h"

#include "cushion/list.h"
#include "friction/laws.h"
#include "schema/project.h"
#include "shot/rules.h"

#define TEXT_OF(x) #x
#define TEXT(x) TEXT_OF(x)
#define VERSION \
  TEXT(CAROM_VERSION_MAJOR) "." TEXT(CAROM_VERSION_MINOR) "." TEXT(CAROM_VERSION_PATCH)

static const struct {
  unsigned source; /* schema/sources.h */
  const char *text;
} entries[] = {
    {CAROM_BY_CAROM,
     "@software{carom,\n"
     "  title = {carom: billiards, computed},\n"
     "  author = {" PROJECT_AUTHORS "},\n" PROJECT_CITED "  version = {" VERSION "}\n"
     "}\n"},
    {CAROM_BY_MARLOW1995, "@book{marlow1995,\n"
                          "  author = {Marlow, Wayland C.},\n"
                          "  title = {The Physics of Pocket Billiards},\n"
                          "  publisher = {MAST},\n"
                          "  year = {1995},\n"
                          "  isbn = {0-9645370-0-1}\n"
                          "}\n"},
    {CAROM_BY_ALCIATORE_SQUIRT,
     "@misc{alciatore-squirt,\n"
     "  author = {Alciatore, David G.},\n"
     "  title = {{TP} {A.30}: The effect of cue tip offset, cue weight, and cue speed on "
     "cue ball speed and spin; {TP} {A.31}: The physics of squirt},\n"
     "  url = {https://billiards.colostate.edu/technical-proofs/}\n"
     "}\n"},
    {CAROM_BY_ALCIATORE_THROW,
     "@misc{alciatore-throw,\n"
     "  author = {Alciatore, David G.},\n"
     "  title = {{TP} {A.14}: The effects of cut angle, speed, and spin on object ball "
     "throw},\n"
     "  url = {https://billiards.colostate.edu/technical-proofs/}\n"
     "}\n"},
    {CAROM_BY_BANNERMAN2014,
     "@article{bannerman2014,\n"
     "  author = {Bannerman, M. N. and Strobl, S. and Formella, A. and P{\\\"o}schel, "
     "T.},\n"
     "  title = {Stable algorithm for event detection in event-driven particle "
     "dynamics},\n"
     "  journal = {Computational Particle Mechanics},\n"
     "  volume = {1},\n"
     "  number = {2},\n"
     "  pages = {191--198},\n"
     "  year = {2014},\n"
     "  doi = {10.1007/s40571-014-0021-8}\n"
     "}\n"},
    {CAROM_BY_MATHAVAN2014,
     "@article{mathavan2014,\n"
     "  author = {Mathavan, S. and Jackson, M. R. and Parkin, R. M.},\n"
     "  title = {Numerical simulations of the frictional collisions of solid balls on "
     "a rough surface},\n"
     "  journal = {Sports Engineering},\n"
     "  volume = {17},\n"
     "  pages = {227--237},\n"
     "  year = {2014},\n"
     "  doi = {10.1007/s12283-014-0158-y}\n"
     "}\n"},
    {CAROM_BY_JORIS_ACCELERATING,
     "@misc{joris-accelerating,\n"
     "  author = {Joris and G{\\\"u}l and Wilton},\n"
     "  title = {Accelerating {M}athavan's billiard ball collision algorithm},\n"
     "  note = {the text at hand gives neither surnames nor year nor venue}\n"
     "}\n"},
    {CAROM_BY_MATHAVAN2010,
     "@article{mathavan2010,\n"
     "  author = {Mathavan, S. and Jackson, M. R. and Parkin, R. M.},\n"
     "  title = {A theoretical analysis of billiard ball dynamics under cushion "
     "impacts},\n"
     "  journal = {Proceedings of the Institution of Mechanical Engineers, Part C},\n"
     "  volume = {224},\n"
     "  pages = {1863--1873},\n"
     "  year = {2010},\n"
     "  doi = {10.1243/09544062JMES1964}\n"
     "}\n"},
    {CAROM_BY_HAN2005, "@article{han2005,\n"
                       "  author = {Han, Inhwan},\n"
                       "  title = {Dynamics in carom and three cushion billiards},\n"
                       "  journal = {Journal of Mechanical Science and Technology},\n"
                       "  volume = {19},\n"
                       "  number = {4},\n"
                       "  pages = {976--984},\n"
                       "  year = {2005},\n"
                       "  doi = {10.1007/BF02919180}\n"
                       "}\n"},
    {CAROM_BY_THREECUSHIONTOOL,
     "@misc{threecushiontool,\n"
     "  author = {erdo100},\n"
     "  title = {3cushiontool: recorded shots of three-cushion billiards},\n"
     "  url = {https://github.com/erdo100/3cushiontool},\n"
     "  note = {commit 76b202bf}\n"
     "}\n"},
    {CAROM_BY_STRONGE2000, "@book{stronge2000,\n"
                           "  author = {Stronge, W. J.},\n"
                           "  title = {Impact Mechanics},\n"
                           "  publisher = {Cambridge University Press},\n"
                           "  year = {2000}\n"
                           "}\n"},
    {CAROM_BY_HERTZ1882,
     "@article{hertz1882,\n"
     "  author = {Hertz, Heinrich},\n"
     "  title = {{\\\"U}ber die Ber{\\\"u}hrung fester elastischer K{\\\"o}rper},\n"
     "  journal = {Journal f{\\\"u}r die reine und angewandte Mathematik},\n"
     "  volume = {92},\n"
     "  pages = {156--171},\n"
     "  year = {1882}\n"
     "}\n"},
    {CAROM_BY_KIEFL2024,
     "@article{kiefl2024,\n"
     "  author = {Kiefl, Evan},\n"
     "  title = {Pooltool: A Python package for realistic billiards simulation},\n"
     "  journal = {Journal of Open Source Software},\n"
     "  volume = {9},\n"
     "  number = {101},\n"
     "  pages = {7301},\n"
     "  year = {2024},\n"
     "  doi = {10.21105/joss.07301}\n"
     "}\n"},
};

#define OF_CUSHION(NAME, name, impact, flight, rows, start, sources, ...) \
  [CAROM_CUSHION_##NAME] = (sources),
#define OF_LAW(NAME, name, pair, numbers, one_speed, ahead, sources, ...) \
  [CAROM_LAW_##NAME] = (sources),
static const unsigned of_cushion[] = {CAROM_CUSHION_MODELS(OF_CUSHION)};
static const unsigned of_law[] = {CAROM_FRICTION_LAWS(OF_LAW)};

static unsigned sources_of(const carom_shot_options *options) {
  const carom_rules *rules = carom_rules_of(options->world);
  const carom_ball_model balls = carom_ball_model_of(options);
  unsigned sources = CAROM_BY_CAROM | CAROM_BY_MARLOW1995 | CAROM_BY_ALCIATORE_SQUIRT;
  if (options->world == CAROM_WORLD_POOLTOOL)
    sources |= CAROM_BY_KIEFL2024;
  else
    sources |= CAROM_BY_BANNERMAN2014;
  const carom_ball_kind plain = {0}, measured = {.smooth_q = 1};
  sources |= of_cushion[carom_cushion_model_of(options, &plain)] |
             of_cushion[carom_cushion_model_of(options, &measured)];

  /* two balls: the restitution of the 2014 model is energetic, as Stronge's; both solvers began as
   * answers to the question how fast its steps can become */
  if (balls == CAROM_BALL_MODEL_EXACT || balls == CAROM_BALL_MODEL_EULER)
    sources |= CAROM_BY_MATHAVAN2014 | CAROM_BY_JORIS_ACCELERATING | CAROM_BY_STRONGE2000;
  if (balls == CAROM_BALL_MODEL_INELASTIC)
    sources |= CAROM_BY_KIEFL2024;
  if (balls != CAROM_BALL_MODEL_MIRROR)
    sources |= of_law[options->friction];

  /* contacts that overlap in time */
  if (rules->clusters && options->simultaneous == CAROM_SIMULTANEOUS_CLUSTER &&
      (balls == CAROM_BALL_MODEL_EXACT || balls == CAROM_BALL_MODEL_MIRROR))
    sources |= CAROM_BY_HERTZ1882 | CAROM_BY_STRONGE2000;
  return sources;
}

size_t carom_cite(const carom_shot_options *options, char *text, size_t room) {
  const carom_shot_options *o = carom_options_or_usual(options);
  if (text == NULL)
    room = 0;
  if (room > 0)
    text[0] = '\0';
  if (carom_check_shot_options(o) != CAROM_OK)
    return 0;
  const unsigned sources = sources_of(o);
  size_t length = 0;
  for (size_t index = 0; index < sizeof entries / sizeof entries[0]; index++) {
    /* an empty line is between entries; text that does not fit is only counted */
    const char *parts[] = {"\n", entries[index].text};
    for (size_t p = length == 0; p < 2 && (entries[index].source & sources) != 0; p++)
      for (const char *c = parts[p]; *c != '\0'; c++, length++)
        if (length + 1 < room)
          text[length] = *c;
  }
  if (room > 0)
    text[length < room ? length : room - 1] = '\0';
  return length;
}
