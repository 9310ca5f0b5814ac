/* What every shot must satisfy whatever the models compute. */
#ifndef CAROM_TESTS_INVARIANTS_H
#define CAROM_TESTS_INVARIANTS_H

#include "carom_shot.h"

typedef struct shot_measures {
  double overlap;   /* deepest of two balls, m, beyond `start` */
  double start;     /* deepest of two balls as a cluster or a push has moved one of them, m; it only
                       falls from there */
  double again;     /* deepest of these that do not part, or meet before they have parted, m */
  double intrusion; /* deepest of a ball into a rail or a jaw, m */
  double depth;     /* deepest of a flying ball into the cloth, m */
  double gain;      /* greatest rise of energy, over the greatest energy of the shot */
  double momentum;  /* greatest change of the momentum of two balls in their collision, over what
                       the cloth may take away and, where one flies or their radii differ,
                       1e-13 N s + 1e-9 m/s of both masses; > 1 is wrong */
  double impulse;   /* greatest difference of an event's impulse from the change of momentum of its
                       balls, over 1e-12 of it, in a cluster over 0.04; > 1 is wrong */
  double jump;      /* greatest difference of a state before an event from that which motion since
                   the ball's last event gives: m, m/s, and R times rad/s; or way of a ball in
                       an event by itself, or of the centre of mass in a cluster, m */
  int restless;     /* balls that are neither at rest nor pocketed at the end of a shot with status
                   CAROM_OK */
  const char *worst_at; /* kind of the last event before the worst overlap or intrusion */
} shot_measures;

/* Follows a shot through all its events with its own evaluation of the motion, but for balls
 * with drag, with `samples` places between two events. The shot has room for all events. */
shot_measures shot_measure(const carom_table *table, const carom_shot_ball *balls, int count,
                           const carom_shot *shot, carom_status status, int samples);

/* That a shot is sound, with positions and states within so much. */
#define EXPECT_SOUND(m, within, name, number)                                                      \
  ck_assert_msg(                                                                                   \
      (m).overlap <= (within) && (m).start <= 3e-3 && (m).again <= 5e-4 &&                         \
          (m).intrusion <= (within) && (m).depth <= 1e-12 && (m).gain <= 1e-12 &&                  \
          (m).momentum <= 1.0 && (m).impulse <= 1.0 && (m).jump <= (within) && (m).restless == 0,  \
      "%s %d: overlap %g, start %g, again %g, intrusion %g after %s, depth %g, gain %g, momentum " \
      "%g, impulse "                                                                               \
      "%g, jump %g, %d restless",                                                                  \
      name, (int)(number), (m).overlap, (m).start, (m).again, (m).intrusion, (m).worst_at,         \
      (m).depth, (m).gain, (m).momentum, (m).impulse, (m).jump, (m).restless)

#endif
