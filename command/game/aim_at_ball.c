/* Aims at a ball by its cut, for `carom shoot --at-ball`. */
#include "carom_plan.h"
#include "program/program.h"
#include "shots/shoot_aim.h"

/* Says why there is no such aim. */
static void complain_of(const char *name, const layout *l, const carom_pot *pot) {
  char text[BALL_TEXT];
  switch (pot->outcome) {
  case CAROM_POT_BARRED: {
    const int met = pot->met.a == 0 ? pot->met.b : pot->met.a;
    complain("--at-ball %s: at a cut of %.4g degrees %s is in the way", name, pot->cut,
             obstacle(l, pot->met.type, met, text));
    break;
  }
  case CAROM_POT_SHORT:
    complain("--at-ball %s: at a cut of %.4g degrees the cue ball comes to rest before it; give a "
             "higher --speed",
             name, pot->cut);
    break;
  default:
    complain("--at-ball %s: no direction of this cue makes the cue ball meet it first at a cut of "
             "%.4g degrees",
             name, pot->cut);
  }
}

bool aim_at_ball(const char *name, const layout *l, const carom_shot_options *options, double cut,
                 carom_cue *cue) {
  char names[NAMES_TEXT], hint[HINT_TEXT];
  carom_pot pot = {
      .ball = ball_named(l, name, strlen(name), names), .pocket = CAROM_POT_NO_POCKET, .cut = cut};
  if (pot.ball < 0 && names[0] == '\0')
    complain("--at-ball '%s': there is no ball to aim at; try --balls 0.6,1.5 with --at-ball 1",
             name);
  else if (pot.ball < 0)
    complain("--at-ball '%s': no such ball; try %s, of --balls", name,
             words_to_try(name, names, hint));
  else if (!(fabs(cut) < 90.0))
    complain("--cut '%g': no contact; try an angle between -90 and 90 degrees", cut);
  else if (carom_aim(&l->table, l->ball, l->count, options, &pot, cue) != CAROM_OK)
    return true; /* which is told when it is played */
  else if (pot.outcome == CAROM_POT_FALLS)
    return true;
  else {
    *l->missed = true;
    if (!l->quiet)
      complain_of(name, l, &pot);
  }
  return false;
}
