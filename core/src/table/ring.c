/* The ring of a table: no way out but the pockets, and rails that are played from the right side.
 * And whether a place can be reached from a table's middle.
 *
 * To the centre of a ball of radius R, jaws are discs grown by R, pockets discs, and rails
 * segments grown by R; but detection knows of a rail only the segment at the distance R on its
 * played side, not the rounded ends, which jaws stand for. Each of these is convex, and so two
 * that overlap have no hole between them. They keep the centre in a place P exactly where a
 * closed chain of overlapping parts winds around P. So the parts are the nodes of a graph: an
 * edge goes from the middle of one part to a place in it, straight on to a place in the other,
 * and to the middle of that. Along an edge the number of times is counted that a ray from P in
 * the direction of +x is crossed, upward less downward. Over a closed chain these numbers add up
 * to how often it winds around P. A forest of the nodes, each with the sum from its root, tells
 * this for all chains at once: an edge between two nodes of one tree closes a chain.
 *
 * The ring is looked at twice. With rounded rails, which do not depend on the sides, it tells
 * holes as wide as a ball; then, when the sides are known to be right, with rails as detection
 * knows them it tells ends of rails without a jaw. Where no chain is closed, the parts are grown
 * further until one is. The edge that closed it is the hole. */
#include "platform/promise.h"
#include "table/table.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

static const double touching = 1e-6; /* m: parts so near to each other have no hole between them */

typedef struct shape {
  double p[2], q[2];    /* the segment; p = q is the centre of a disc */
  double reach, radius; /* m: as the centre of a ball sees it; of the surface */
  carom_part part;
} shape;

typedef struct ring {
  int count;
  shape shape[MOST_FEATURES];
  /* of the forest: the parent, itself for a root, and the windings from the parent here */
  int parent[MOST_FEATURES], windings[MOST_FEATURES];
} ring;

static void add_shape(ring *g, const double p[2], const double q[2], double radius, double grown,
                      carom_part part) {
  CAROM_PROMISE(g->count < MOST_FEATURES);
  g->shape[g->count++] = (shape){{p[0], p[1]}, {q[0], q[1]}, radius + grown, radius, part};
}

/* The parts, as the centre of a ball sees them that may be `overlap` in a cushion; rails with
 * round ends, or without. */
static void shapes_of(const carom_ground *ground, double overlap, bool round, ring *g) {
  const carom_table *t = ground->table;
  g->count = 0;
  for (int k = 0; k < t->rails; k++) {
    const carom_rail *rail = &t->rail[k];
    const double reach = ground->rail[k] - overlap, *n = ground->features->line[k];
    double off = reach, around = 0.0;
    if (round) {
      off = 0.0;
      around = reach;
    }
    const double p[2] = {rail->p[0] + off * n[0], rail->p[1] + off * n[1]},
                 q[2] = {rail->q[0] + off * n[0], rail->q[1] + off * n[1]};
    add_shape(g, p, q, 0.0, around, (carom_part){CAROM_PART_RAIL, k});
  }
  for (int k = 0; k < t->jaws; k++)
    add_shape(g, t->jaw[k].centre, t->jaw[k].centre, t->jaw[k].radius, ground->jaw[k] - overlap,
              (carom_part){CAROM_PART_JAW, k});
  for (int k = 0; k < t->pockets; k++)
    add_shape(g, t->pocket[k].centre, t->pocket[k].centre, t->pocket[k].radius, 0.0,
              (carom_part){CAROM_PART_POCKET, k});
}

/* The place of a segment that is nearest to r, and how far it is. */
static double nearest(const shape *s, const double r[2], double place[2]) {
  const double e[2] = {s->q[0] - s->p[0], s->q[1] - s->p[1]}, size2 = carom_plane_dot(e, e);
  double along = 0.0;
  if (size2 > 0.0)
    along = ((r[0] - s->p[0]) * e[0] + (r[1] - s->p[1]) * e[1]) / size2;
  const double t = carom_lesser(carom_greater(along, 0.0), 1.0);
  double d2 = 0.0;
  for (int k = 0; k < 2; k++) {
    place[k] = s->p[k] + t * e[k];
    d2 += (r[k] - place[k]) * (r[k] - place[k]);
  }
  return sqrt(d2);
}

/* Where two segments cross; false if they do not. */
static bool cross_at(const shape *a, const shape *b, double place[2]) {
  const double u[2] = {a->q[0] - a->p[0], a->q[1] - a->p[1]},
               v[2] = {b->q[0] - b->p[0], b->q[1] - b->p[1]};
  const double d[2] = {b->p[0] - a->p[0], b->p[1] - a->p[1]}, area = u[0] * v[1] - u[1] * v[0];
  const double s = (d[0] * v[1] - d[1] * v[0]) / area, t = (d[0] * u[1] - d[1] * u[0]) / area;
  for (int k = 0; k < 2; k++)
    place[k] = a->p[k] + s * u[k];
  return s >= 0.0 && s <= 1.0 && t >= 0.0 && t <= 1.0;
}

/* Edge `edge_index` of the five between two parts, its places in them, and its length: where they
 * cross, or from an end of one to the other. More than the shortest are wanted only to find
 * holes: between parallel rails there is one at each end. */
enum { EDGES = 5 };
static double edge(const shape *a, const shape *b, int edge_index, double in_a[2], double in_b[2]) {
  if (edge_index == 0) {
    const bool they_do = cross_at(a, b, in_a);
    in_b[0] = in_a[0];
    in_b[1] = in_a[1];
    if (!they_do)
      return INFINITY;
    return 0.0;
  }
  const double *const ends[4] = {a->p, a->q, b->p, b->q};
  const double *end = ends[edge_index - 1];
  if (edge_index <= 2) {
    memcpy(in_a, end, 2 * sizeof *end);
    return nearest(b, end, in_b);
  }
  memcpy(in_b, end, 2 * sizeof *end);
  return nearest(a, end, in_a);
}

/* Whether boxes around two parts are farther apart than `grown`. */
static bool far_apart(const shape *a, const shape *b, double grown) {
  const double room = a->reach + b->reach + grown;
  for (int k = 0; k < 2; k++)
    if (carom_lesser(a->p[k], a->q[k]) - carom_greater(b->p[k], b->q[k]) > room ||
        carom_lesser(b->p[k], b->q[k]) - carom_greater(a->p[k], a->q[k]) > room)
      return true;
  return false;
}

/* How a ray from P along +x is crossed on the way from a to b: 1 upward, -1 downward. */
static int crossing(const double a[2], const double b[2], const double P[2]) {
  if ((a[1] > P[1]) == (b[1] > P[1]))
    return 0;
  const double x = a[0] + (P[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0]);
  if (x <= P[0])
    return 0;
  if (b[1] > a[1])
    return 1;
  return -1;
}

/* The windings of an edge. */
static int windings_of(const shape *a, const shape *b, const double in_a[2], const double in_b[2],
                       const double P[2]) {
  const double start[2] = {0.5 * (a->p[0] + a->q[0]), 0.5 * (a->p[1] + a->q[1])},
               end[2] = {0.5 * (b->p[0] + b->q[0]), 0.5 * (b->p[1] + b->q[1])};
  return crossing(start, in_a, P) + crossing(in_a, in_b, P) + crossing(in_b, end, P);
}

/* The root of a node, and the windings from there. */
static int root_of(const ring *g, int i, int *windings) {
  for (*windings = 0; g->parent[i] != i; i = g->parent[i])
    *windings += g->windings[i];
  return i;
}

/* A hole: between which parts, by which edge. */
typedef struct hole {
  int a, b, edge_index;
} hole;

/* Whether a chain of parts that are at most `grown` apart winds around P, and around P otherwise
 * than around Q unless Q is NULL. Edges of up to `first` are taken before the others; *closing
 * is the edge that closed a chain. */
static bool encloses(ring *g, double first, double grown, const double P[2], const double *Q,
                     hole *closing) {
  for (int i = 0; i < g->count; i++) {
    g->parent[i] = i;
    g->windings[i] = 0;
  }

  /* edges between neighbours: those that are short first */
  for (int pass = 0; pass < (first < grown ? 2 : 1); pass++)
    for (int i = 0; i < g->count; i++)
      for (int j = i + 1; j < g->count; j++)
        for (int edge_index = 0; edge_index < EDGES &&
                                 !far_apart(&g->shape[i], &g->shape[j], pass == 0 ? first : grown);
             edge_index++) {
          const shape *a = &g->shape[i], *b = &g->shape[j];
          double in_a[2], in_b[2];
          /* an edge that is not too long for this pass */
          const double apart = edge(a, b, edge_index, in_a, in_b) - a->reach - b->reach;
          if (!(apart <= (pass == 0 ? first : grown) && apart < INFINITY))
            continue;
          const int turns =
              windings_of(a, b, in_a, in_b, P) - (Q != NULL ? windings_of(a, b, in_a, in_b, Q) : 0);
          /* it joins two trees, or closes a chain, of which the windings are known then */
          int to_i, to_j;
          const int root_i = root_of(g, i, &to_i), root_j = root_of(g, j, &to_j);
          if (root_i != root_j) {
            g->parent[root_j] = root_i;
            g->windings[root_j] = to_i + turns - to_j;
          } else if (to_i + turns != to_j) {
            *closing = (hole){i, j, edge_index};
            return true;
          }
        }
  return false;
}

/* Whether the centre of a ball can be at r. */
static bool is_free(const ring *g, const double r[2]) {
  double place[2];
  for (int k = 0; k < g->count; k++)
    if (nearest(&g->shape[k], r, place) < g->shape[k].reach)
      return false;
  return true;
}

/* A free place near the middle of the box around a table: in rings of places around it. */
static bool find_middle(const ring *g, const carom_table *t, double P[2]) {
  enum { HALF = 4 };
  for (int far = 0; far <= HALF; far++)
    for (int k = -far; k <= far; k++)
      for (int l = -far; l <= far; l++) {
        if (k != far && k != -far && l != far && l != -far)
          continue;
        P[0] = t->width * (0.5 + 0.1 * k);
        P[1] = t->length * (0.5 + 0.1 * l);
        if (is_free(g, P))
          return true;
      }
  return false;
}

bool carom_beside_longest(const carom_table *t, const carom_features *f, double radius,
                          double place[2]) {
  double most = 0.0;
  for (int k = 0; k < f->rails; k++) {
    const double *p = t->rail[k].p, *q = t->rail[k].q, e_x = q[0] - p[0], e_y = q[1] - p[1];
    if (e_x * e_x + e_y * e_y <= most)
      continue;
    most = e_x * e_x + e_y * e_y;
    for (int c = 0; c < 2; c++)
      place[c] = 0.5 * (p[c] + q[c]) + 2.0 * radius * f->line[k][c];
  }
  return most > 0.0;
}

/* A place for a ball on the table: near its middle; or beside the longest rail, where a ring of
 * parts that are at most `grown` apart is closed around that and not around the middle, as in the
 * shape of a U. False if there is none. */
static bool find_place(ring *g, const carom_ground *ground, double grown, double P[2]) {
  hole unused;
  const bool found = find_middle(g, ground->table, P);
  if (found && encloses(g, grown, grown, P, NULL, &unused))
    return true;
  double Q[2];
  if (!carom_beside_longest(ground->table, ground->features, ground->kind->radius, Q) ||
      !is_free(g, Q) || !encloses(g, grown, grown, Q, NULL, &unused))
    return found;
  P[0] = Q[0];
  P[1] = Q[1];
  return true;
}

/* Finds the hole in a ring that is not closed, by bisection over how far the parts are grown.
 * False if there is none to be found. */
static bool find_hole(ring *g, const double P[2], hole *found) {
  double low = touching, high = 1e-3;
  while (high < 1e6 && !encloses(g, high, high, P, NULL, found)) {
    low = high;
    high *= 2.0;
  }
  for (int k = 0; k < 50 && high < 1e6; k++) {
    const double middle = 0.5 * (low + high);
    if (encloses(g, middle, middle, P, NULL, found))
      high = middle;
    else
      low = middle;
  }
  return high < 1e6 && encloses(g, low, high, P, NULL, found);
}

/* Whether the played side of a rail is turned away from the table: nowhere along it can a ball
 * that has come from P touch that side, and somewhere one is at its back. */
static bool wrong_side(ring *g, const carom_rail *rail, const double normal[3], double R,
                       const double P[2]) {
  static const double places[] = {0.5, 0.25, 0.75, 0.1, 0.9, 0.02, 0.98};
  bool at_back = false;
  for (size_t k = 0; k < sizeof places / sizeof places[0]; k++)
    for (int side = 1; side >= -1; side -= 2) {
      double Q[2];
      for (int c = 0; c < 2; c++)
        Q[c] = rail->p[c] + places[k] * (rail->q[c] - rail->p[c]) + side * (R + 1e-6) * normal[c];
      hole unused;
      if (!is_free(g, Q) || encloses(g, touching, touching, P, Q, &unused))
        continue;
      if (side > 0)
        return false;
      at_back = true;
    }
  return at_back;
}

/* Whether the ring is closed; where it is not, *fault tells the hole. */
static bool is_closed(ring *g, const double P[2], carom_table_fault *fault) {
  hole found;
  if (encloses(g, touching, touching, P, NULL, &found))
    return true;
  if (find_hole(g, P, &found)) {
    const shape *a = &g->shape[found.a], *b = &g->shape[found.b];
    double in_a[2], in_b[2];
    fault->gap = edge(a, b, found.edge_index, in_a, in_b) - a->radius - b->radius;
    fault->part = a->part;
    fault->other = b->part;
    for (int c = 0; c < 2; c++)
      fault->place[c] = 0.5 * (in_a[c] + in_b[c]);
  }
  return false;
}

carom_status carom_check_ring(const carom_ground *ground, carom_table_fault *fault) {
  const carom_table *table = ground->table;
  ring g;
  double P[2];

  /* with rails rounded */
  shapes_of(ground, 0.0, true, &g);
  if (!find_place(&g, ground, touching, P) || !is_closed(&g, P, fault))
    return CAROM_ERROR_TABLE_OPEN;
  for (int k = 0; k < table->rails; k++)
    if (wrong_side(&g, &table->rail[k], ground->features->line[k], ground->rail[k], P)) {
      fault->part = (carom_part){CAROM_PART_RAIL, k};
      for (int c = 0; c < 2; c++)
        fault->place[c] = 0.5 * (table->rail[k].p[c] + table->rail[k].q[c]);
      return CAROM_ERROR_RAIL_SIDE;
    }

  /* and with rails as they are detected */
  shapes_of(ground, 0.0, false, &g);
  return carom_ok_if(is_closed(&g, P, fault), CAROM_ERROR_TABLE_OPEN);
}

__attribute__((noinline, cold)) bool carom_is_cut_off(const carom_ground *ground,
                                                      const double r[2]) {
  const carom_features *features = ground->features;
  const double closed = touching + 2.0 * CAROM_RING_OVERLAP;
  ring g;
  hole unused;
  double P[2] = {features->eye[0], features->eye[1]};
  shapes_of(ground, CAROM_RING_OVERLAP, true, &g);
  if (!features->has_eye && !find_place(&g, ground, closed, P))
    return false;
  /* a ring with a hole keeps no place apart; there, holes of up to the width of a ball are taken
   * to be closed */
  shapes_of(ground, CAROM_RING_OVERLAP, false, &g);
  double grown = 2.0 * ground->kind->radius;
  if (encloses(&g, closed, closed, P, NULL, &unused))
    grown = closed;
  return encloses(&g, grown, grown, P, r, &unused);
}
