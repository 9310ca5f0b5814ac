/* Ways of a mirror: banks, kicks and combinations, which are steered before they are played.
 *
 * A ball leaves a cushion about as light leaves a mirror. So a bank is a pot into the image of the
 * pocket, and a kick one by the image of the cue ball. In a combination the first ball has to reach
 * the ghost of the second one, which is a window for it. Each of these ways has the chance of a
 * direct pot of pots.c; the likeliest are tried. */
#include "mirrors.h"
#include "random_draws.h"

#include "platform/elementary.h"
#include "view.h"

#include <math.h>

typedef carom_candidate candidate;

/* A way: the ball that is met first and that which falls into a pocket, the direction of the cue
 * ball, rad, and the contacts of the ball that falls before its last piece. */
typedef struct mirror_way {
  double chance, phi;
  int ball, pocket, contacts;
  bool kicks;  /* by a cushion: */
  int first;   /* the ball that the cue ball meets, */
  double miss; /* and by how much it misses its centre, as in miss.c */
} mirror_way;

enum { WAYS_MOST = 16, WALLS = 4 };
typedef struct mirror_list {
  mirror_way way[WAYS_MOST];
  int count;
} mirror_list;

/* Sorts a way in, the likeliest first. */
static void insert(mirror_list *list, const mirror_way *w) {
  static const double least = 0.05;
  if (w->chance < least ||
      (list->count == WAYS_MOST && w->chance <= list->way[WAYS_MOST - 1].chance))
    return;
  if (list->count < WAYS_MOST)
    list->count++;
  int index = list->count - 1;
  for (; index > 0 && list->way[index - 1].chance < w->chance; index--)
    list->way[index] = list->way[index - 1];
  list->way[index] = *w;
}

/* The image of a point in a wall, for the centre of a ball: left, right, head, foot. */
static void reflect(const carom_search *search, int wall, double radius, double p[2]) {
  const double size[2] = {search->view.width, search->view.length};
  const int axis = wall / 2;
  const double line = wall % 2 == 0 ? radius : size[axis] - radius;
  p[axis] = 2.0 * line - p[axis];
}

/* Where the line from p to an image q meets its wall. */
static void crossing(const carom_search *search, int wall, double radius, const double p[2],
                     const double q[2], double at[2]) {
  const double size[2] = {search->view.width, search->view.length};
  const int axis = wall / 2;
  const double line = wall % 2 == 0 ? radius : size[axis] - radius;
  const double share = (line - p[axis]) / (q[axis] - p[axis]);
  for (int x = 0; x < 2; x++)
    at[x] = p[x] + share * (q[x] - p[x]);
}

/* Adds the ways to ball k, met first, by which it goes through a window: direct, or by one cushion
 * of the cue ball. w has the ball that falls, its pocket and contacts. */
static void add_hits(const carom_search *search, int k, const carom_window *window, bool direct,
                     mirror_way w, mirror_list *list) {
  const carom_view *view = &search->view;
  const double *c = search->state[view->cue_ball].r, *o = search->state[k].r;
  const double R = view->radius[view->cue_ball];
  carom_hit hit;
  if (direct && carom_way_into(view, o, view->radius[k], c, window, 0, &hit) &&
      carom_is_free_way(view, search->state, search->in_play, c, hit.ghost, view->cue_ball, k, R)) {
    w.chance = hit.chance;
    w.phi = carom_angle_of(hit.ghost[0] - c[0], hit.ghost[1] - c[1]);
    insert(list, &w);
  }
  for (int wall = 0; wall < WALLS; wall++) {
    double image[2] = {c[0], c[1]}, at[2], ghost[2];
    reflect(search, wall, R, image);
    if (!carom_way_into(view, o, view->radius[k], image, window, 0, &hit))
      continue;
    ghost[0] = hit.ghost[0];
    ghost[1] = hit.ghost[1];
    crossing(search, wall, R, ghost, image, at);
    if (!carom_is_free_way(view, search->state, search->in_play, c, at, view->cue_ball, k, R) ||
        !carom_is_free_way(view, search->state, search->in_play, at, ghost, view->cue_ball, k, R))
      continue;
    const double x = ghost[0] - at[0], y = ghost[1] - at[1];
    const double across = (o[0] - at[0]) * y - (o[1] - at[1]) * x;
    w.chance = hit.chance;
    w.phi = carom_angle_of(at[0] - c[0], at[1] - c[1]);
    w.kicks = true;
    w.first = k;
    w.miss = across / sqrt(x * x + y * y) / (R + view->radius[k]);
    insert(list, &w);
  }
}

/* The window of a ball through the image of a pocket in a wall, if nothing is in the way. */
static bool bank_window(const carom_search *search, int ball, int pocket, int wall,
                        carom_window *window) {
  const carom_view *view = &search->view;
  const double R = view->radius[ball], *o = search->state[ball].r;
  carom_mouth mouth = view->mouth[pocket];
  double at[2];
  reflect(search, wall, R, mouth.centre);
  for (int side = 0; side < 2 && mouth.jaws; side++) {
    reflect(search, wall, R, mouth.jaw[side]);
    mouth.rail[side][wall / 2] *= -1.0;
  }
  mouth.axis = carom_wrapped((wall < 2 ? pi : 0.0) - mouth.axis);
  mouth.left = 1 - mouth.left;
  *window = carom_window_of(&mouth, o, R);
  crossing(search, wall, R, o, mouth.centre, at);
  return window->half > 0.0 && window->half < 0.5 &&
         carom_is_free_way(view, search->state, search->in_play, o, at, view->cue_ball, ball, R) &&
         carom_is_free_way(view, search->state, search->in_play, at, view->mouth[pocket].centre,
                           view->cue_ball, ball, R);
}

/* Adds the combinations in which ball `falls` goes through a window, driven by another ball that is
 * on. */
static void add_combinations(const carom_search *search, int falls, const carom_window *window,
                             const mirror_way *w, mirror_list *list) {
  const carom_view *view = &search->view;
  const double *o = search->state[falls].r;
  for (int k = 0; k < view->count; k++) {
    if (!(search->targets >> k & 1) || k == falls)
      continue;
    /* the ball that drives it, in the position of the cue ball */
    carom_hit hit;
    const double *driver = search->state[k].r;
    if (!carom_way_into(view, o, view->radius[falls], driver, window, 0, &hit) ||
        !carom_is_free_way(view, search->state, search->in_play, driver, hit.ghost, k, falls,
                           view->radius[k]))
      continue;
    carom_window to_ghost = {.psi =
                                 carom_angle_of(hit.ghost[0] - driver[0], hit.ghost[1] - driver[1]),
                             .half = hit.half};
    carom_sincos(to_ghost.psi, &to_ghost.sine, &to_ghost.cosine);
    add_hits(search, k, &to_ghost, true, *w, list);
  }
}

/* Adds the ways in which a ball falls into a pocket. */
static void add_ways(const carom_search *search, int ball, int pocket, mirror_list *list) {
  const carom_view *view = &search->view;
  const bool is_on = (search->targets >> ball & 1) != 0;
  mirror_way w = {.ball = ball, .pocket = pocket, .contacts = 1};
  const carom_window *direct = &view->window[ball][pocket];
  if (direct->half > 0.0 &&
      carom_is_free_way(view, search->state, search->in_play, search->state[ball].r,
                        view->mouth[pocket].centre, view->cue_ball, ball, view->radius[ball])) {
    if (is_on)
      add_hits(search, ball, direct, false, w, list);
    add_combinations(search, ball, direct, &w, list);
  }
  w.contacts = 2;
  for (int wall = 0; wall < WALLS && is_on; wall++) {
    carom_window window;
    if (bank_window(search, ball, pocket, wall, &window))
      add_hits(search, ball, &window, true, w, list);
  }
}

/* The ball of shots that is a ball of the layout in play. */
static int in_shot(const carom_search *search, int ball) {
  int k = 0;
  while (search->layout_ball[k] != ball)
    k++;
  return k;
}

void carom_search_mirrors(carom_search *search, int64_t most) {
  enum { SPEEDS = 3, TIPS = 3 };
  static const double speed[SPEEDS] = {1.7, 2.4, 3.4}, tip[TIPS] = {0.0, 0.3, -0.3};
  mirror_list list = {.count = 0};
  for (int k = 0; k < search->plays; k++) {
    const int ball = search->layout_ball[k];
    for (int p = 0; p < search->view.pockets && (search->deciding >> k & 1); p++)
      if (search->pockets >> p & 1)
        add_ways(search, ball, p, &list);
  }
  for (int n = 0; n < carom_min(2 * list.count, most); n++) {
    const mirror_way *w = &list.way[n % list.count];
    const int order =
        (int)(SPEEDS * TIPS * carom_uniform(search->options.seed, DRAW_MIRRORS, (uint64_t)n, 0));
    const carom_miss lead = {.miss = (float)w->miss,
                             .ball = (int8_t)search->cue_ball,
                             .target = (int8_t)in_shot(search, w->first),
                             .piece = (int16_t)w->kicks};
    carom_search_add(search,
                     (candidate){.speed = carom_tip_gain(search->job.cue) * speed[order % SPEEDS],
                                 .phi = carom_turned(w->phi / degree),
                                 .b = tip[order / SPEEDS],
                                 .kind = CAROM_PLAN_SCAN,
                                 .turns = true,
                                 .lead = lead,
                                 .miss = {.miss = (float)NAN,
                                          .ball = (int8_t)in_shot(search, w->ball),
                                          .target = (int8_t)w->pocket,
                                          .piece = (int16_t)w->contacts}});
  }
}
