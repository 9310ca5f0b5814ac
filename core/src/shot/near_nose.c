/* The nose of a cushion near a ball, as a plane: the nearest of all rails and jaws.
 *
 * On the cloth its normal is level, and the gap is between ball and wall; in flight it points
 * from the nose to the centre, table/nose.c. A jaw is taken for the plane that touches it. */
#include "cluster/cluster.h"
#include "platform/vectors.h"
#include "shot/clusters.h"
#include "table/table.h"

#include <math.h>
#include <string.h>

static const double farthest = 0.05; /* m: a ball that is farther away is at no nose in a push */

/* The plane of a nose at the height `height`, from which the centre of the ball is `across`, along
 * the level unit vector (x, y) out of the wall. */
static void take_plane(const carom_sim *sim, const carom_ball_state *ball, double height, double x,
                       double y, double across, carom_push_nose *nose) {
  const carom_ball_kind *kind = sim->layout->kind[sim->struck];
  const double reference = sim->features->reference;
  nose->normal[0] = x;
  nose->normal[1] = y;
  nose->normal[2] = 0.0;
  nose->gap = across - carom_reach_on_cloth(kind, height, reference);
  if (!carom_flies(ball))
    return;
  const double nose_height = carom_nose_height(kind, height);
  const double level = across - carom_nose_shift(nose_height, reference),
               up = ball->r[2] - nose_height, size = sqrt(level * level + up * up);
  nose->normal[0] = x * level / size;
  nose->normal[1] = y * level / size;
  nose->normal[2] = up / size;
  nose->gap = size - kind->radius;
}

static void take_rail(carom_sim *sim, const carom_ball_state *ball, int index,
                      carom_push_nose *nose) {
  const double *line = sim->features->line[index];
  nose->event = (carom_due){sim->time, CAROM_EVENT_RAIL, sim->struck, index};
  take_plane(sim, ball, sim->table->rail[index].height, line[0], line[1],
             carom_plane_dot(line, ball->r) + line[2], nose);
}

static void take_jaw(carom_sim *sim, const carom_ball_state *ball, int index,
                     carom_push_nose *nose) {
  const carom_jaw *jaw = &sim->table->jaw[index];
  const double out[2] = {ball->r[0] - jaw->centre[0], ball->r[1] - jaw->centre[1]};
  const double distance = carom_plane_size(out);
  nose->event = (carom_due){sim->time, CAROM_EVENT_JAW, sim->struck, index};
  take_plane(sim, ball, jaw->height, out[0] / distance, out[1] / distance, distance - jaw->radius,
             nose);
}

void carom_nose_of_part(carom_sim *sim, const carom_ball_state *ball, const carom_due *event,
                        carom_push_nose *nose) {
  if (event->type == CAROM_EVENT_RAIL)
    take_rail(sim, ball, event->b, nose);
  else
    take_jaw(sim, ball, event->b, nose);
}

bool carom_find_nose(carom_sim *sim, const carom_ball_state *ball, carom_push_nose *nose) {
  const carom_features *features = sim->features;
  carom_push_nose found = {.sim = sim};
  nose->gap = farthest;
  for (int index = 0; index < features->rails; index++) {
    const double *along = features->along[index];
    const double place = carom_plane_dot(along, ball->r) + along[2];
    take_rail(sim, ball, index, &found);
    if (place >= 0.0 && place <= 1.0 && fabs(found.gap) < nose->gap)
      *nose = found;
  }
  for (int index = 0; index < features->jaws; index++) {
    take_jaw(sim, ball, index, &found);
    if (fabs(found.gap) < nose->gap)
      *nose = found;
  }
  return nose->gap < farthest;
}

void carom_nose_now(carom_sim *sim, const carom_ball_state *ball, const carom_due *event,
                    carom_push_nose *nose) {
  memset(nose, 0, sizeof *nose);
  nose->sim = sim;
  carom_nose_of_part(sim, ball, event, nose);
  nose->gap = 0.0;
  nose->touches = true;
}
