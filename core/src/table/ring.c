/* The ring of a table: no way out but the pockets, and rails that are played from the right side.
 * And whether a position can be reached from a table's middle.
 *
 * To the centre of a ball of radius R, jaws are discs grown by R, pockets discs, and rails segments
 * grown by R; but detection knows of a rail only the segment at the distance R on its played side,
 * not the rounded ends, which jaws represent. Each of these is convex, and so two that overlap have
 * no hole between them. They keep the centre in a position P exactly where a closed chain of
 * overlapping parts winds around P. So the parts are the nodes of a graph: an edge goes from the
 * middle of one part to a position in it, straight on to a position in the other, and to the middle
 * of that. Along an edge the number of times is counted that a ray from P in the direction of +x is
 * crossed, upward less downward. Over a closed chain these numbers add up to how often it winds
 * around P. A forest of the nodes, each with the sum from its root, determines this for all chains
 * at once: an edge between two nodes of one tree closes a chain.
 *
 *      o======rail======o jaw
 *      |                 |
 *     ( )      P    ray  ( )      A chain of parts that overlap, closed around P: the ray is
 *    pocket    o- - - - - |- ->   crossed once more upward than downward.
 *      |                 |
 *      o======rail======o
 *
 * The ring is looked at twice. With rounded rails, which do not depend on the sides, it finds holes
 * as wide as a ball; then, when the sides are known to be right, with rails as detection uses them,
 * it finds ends of rails without a jaw. Where no chain is closed, the parts are grown further until
 * one is. The edge that closed it is the hole. */
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

typedef struct part_ring {
  int count;
  shape shape[MOST_FEATURES];
  /* of the forest: the parent, itself for a root, and the windings from the parent here */
  int parent[MOST_FEATURES], windings[MOST_FEATURES];
} part_ring;

static void add_shape(part_ring *ring, const double p[2], const double q[2], double radius,
                      double grown, carom_part part) {
  CAROM_PROMISE(ring->count < MOST_FEATURES);
  ring->shape[ring->count++] = (shape){{p[0], p[1]}, {q[0], q[1]}, radius + grown, radius, part};
}

/* The parts, as the centre of a ball sees them that may be `overlap` in a cushion; rails with
 * round ends, or without. */
static void shapes_of(const carom_ground *ground, double overlap, bool round, part_ring *ring) {
  const carom_table *table = ground->table;
  ring->count = 0;
  for (int index = 0; index < table->rails; index++) {
    const carom_rail *rail = &table->rail[index];
    const double reach = ground->rail[index] - overlap, *n = ground->features->line[index];
    double off = reach, around = 0.0;
    if (round) {
      off = 0.0;
      around = reach;
    }
    const double p[2] = {rail->p[0] + off * n[0], rail->p[1] + off * n[1]},
                 q[2] = {rail->q[0] + off * n[0], rail->q[1] + off * n[1]};
    add_shape(ring, p, q, 0.0, around, (carom_part){CAROM_PART_RAIL, index});
  }
  for (int index = 0; index < table->jaws; index++)
    add_shape(ring, table->jaw[index].centre, table->jaw[index].centre, table->jaw[index].radius,
              ground->jaw[index] - overlap, (carom_part){CAROM_PART_JAW, index});
  for (int index = 0; index < table->pockets; index++)
    add_shape(ring, table->pocket[index].centre, table->pocket[index].centre,
              table->pocket[index].radius, 0.0, (carom_part){CAROM_PART_POCKET, index});
}

/* The position of a segment that is nearest to a point, and how far it is. */
static double nearest(const shape *segment, const double point[2], double place[2]) {
  const double way[2] = {segment->q[0] - segment->p[0], segment->q[1] - segment->p[1]},
               size2 = carom_plane_dot(way, way);
  double along = 0.0;
  if (size2 > 0.0)
    along = ((point[0] - segment->p[0]) * way[0] + (point[1] - segment->p[1]) * way[1]) / size2;
  const double share = carom_lesser(carom_greater(along, 0.0), 1.0);
  double d2 = 0.0;
  for (int axis = 0; axis < 2; axis++) {
    place[axis] = segment->p[axis] + share * way[axis];
    d2 += (point[axis] - place[axis]) * (point[axis] - place[axis]);
  }
  return sqrt(d2);
}

/* Where two segments cross; false if they do not. */
static bool cross_at(const shape *a, const shape *b, double place[2]) {
  const double along_a[2] = {a->q[0] - a->p[0], a->q[1] - a->p[1]},
               along_b[2] = {b->q[0] - b->p[0], b->q[1] - b->p[1]};
  const double apart[2] = {b->p[0] - a->p[0], b->p[1] - a->p[1]},
               area = along_a[0] * along_b[1] - along_a[1] * along_b[0];
  const double share_a = (apart[0] * along_b[1] - apart[1] * along_b[0]) / area,
               share_b = (apart[0] * along_a[1] - apart[1] * along_a[0]) / area;
  for (int axis = 0; axis < 2; axis++)
    place[axis] = a->p[axis] + share_a * along_a[axis];
  return share_a >= 0.0 && share_a <= 1.0 && share_b >= 0.0 && share_b <= 1.0;
}

/* Edge `edge_index` of the five between two parts, its positions in them, and its length: where
 * they cross, or from an end of one to the other. More than the shortest are wanted only to find
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
  for (int axis = 0; axis < 2; axis++)
    if (carom_lesser(a->p[axis], a->q[axis]) - carom_greater(b->p[axis], b->q[axis]) > room ||
        carom_lesser(b->p[axis], b->q[axis]) - carom_greater(a->p[axis], a->q[axis]) > room)
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
static int root_of(const part_ring *ring, int node, int *windings) {
  for (*windings = 0; ring->parent[node] != node; node = ring->parent[node])
    *windings += ring->windings[node];
  return node;
}

/* A hole: between which parts, by which edge. */
typedef struct hole {
  int a, b, edge_index;
} hole;

/* Whether a chain of parts that are at most `grown` apart winds around P, and around P otherwise
 * than around Q unless Q is NULL. Edges of up to `first` are taken before the others; *closing
 * is the edge that closed a chain. */
static bool wind_around(part_ring *ring, double first, double grown, const double P[2],
                        const double *Q, hole *closing) {
  for (int i = 0; i < ring->count; i++) {
    ring->parent[i] = i;
    ring->windings[i] = 0;
  }

  /* edges between neighbours: those that are short first */
  for (int pass = 0; pass < (first < grown ? 2 : 1); pass++)
    for (int i = 0; i < ring->count; i++)
      for (int j = i + 1; j < ring->count; j++)
        for (int edge_index = 0; edge_index < EDGES && !far_apart(&ring->shape[i], &ring->shape[j],
                                                                  pass == 0 ? first : grown);
             edge_index++) {
          const shape *a = &ring->shape[i], *b = &ring->shape[j];
          double in_a[2], in_b[2];
          /* an edge that is not too long for this pass */
          const double apart = edge(a, b, edge_index, in_a, in_b) - a->reach - b->reach;
          if (!(apart <= (pass == 0 ? first : grown) && apart < INFINITY))
            continue;
          const int turns =
              windings_of(a, b, in_a, in_b, P) - (Q != NULL ? windings_of(a, b, in_a, in_b, Q) : 0);
          /* it joins two trees, or closes a chain, of which the windings are known then */
          int to_i, to_j;
          const int root_i = root_of(ring, i, &to_i), root_j = root_of(ring, j, &to_j);
          if (root_i != root_j) {
            ring->parent[root_j] = root_i;
            ring->windings[root_j] = to_i + turns - to_j;
          } else if (to_i + turns != to_j) {
            *closing = (hole){i, j, edge_index};
            return true;
          }
        }
  return false;
}

/* Whether the centre of a ball can be at a point. */
static bool is_free(const part_ring *ring, const double point[2]) {
  double place[2];
  for (int index = 0; index < ring->count; index++)
    if (nearest(&ring->shape[index], point, place) < ring->shape[index].reach)
      return false;
  return true;
}

/* A free position near the middle of the box around a table: in rings of positions around it. */
static bool find_middle(const part_ring *ring, const carom_table *table, double P[2]) {
  enum { HALF = 4 };
  for (int far = 0; far <= HALF; far++)
    for (int column = -far; column <= far; column++)
      for (int row = -far; row <= far; row++) {
        if (column != far && column != -far && row != far && row != -far)
          continue;
        P[0] = table->width * (0.5 + 0.1 * column);
        P[1] = table->length * (0.5 + 0.1 * row);
        if (is_free(ring, P))
          return true;
      }
  return false;
}

bool carom_beside_longest(const carom_table *table, const carom_features *features, double radius,
                          double place[2]) {
  double most = 0.0;
  for (int rail = 0; rail < features->rails; rail++) {
    const double *p = table->rail[rail].p, *q = table->rail[rail].q, e_x = q[0] - p[0],
                 e_y = q[1] - p[1];
    if (e_x * e_x + e_y * e_y <= most)
      continue;
    most = e_x * e_x + e_y * e_y;
    for (int axis = 0; axis < 2; axis++)
      place[axis] = 0.5 * (p[axis] + q[axis]) + 2.0 * radius * features->line[rail][axis];
  }
  return most > 0.0;
}

/* A position for a ball on the table: near its middle; or next to the longest rail, where a ring of
 * parts that are at most `grown` apart is closed around that and not around the middle, as in the
 * shape of a U. False if there is none. */
static bool find_place(part_ring *ring, const carom_ground *ground, double grown, double P[2]) {
  hole unused;
  const bool found = find_middle(ring, ground->table, P);
  if (found && wind_around(ring, grown, grown, P, NULL, &unused))
    return true;
  double Q[2];
  if (!carom_beside_longest(ground->table, ground->features, ground->kind->radius, Q) ||
      !is_free(ring, Q) || !wind_around(ring, grown, grown, Q, NULL, &unused))
    return found;
  P[0] = Q[0];
  P[1] = Q[1];
  return true;
}

/* Finds the hole in a ring that is not closed, by bisection over how far the parts are grown.
 * False if there is none to be found. */
static bool find_hole(part_ring *ring, const double P[2], hole *found) {
  enum { BISECTIONS = 50 };                             /* to the last bit */
  static const double first_guess = 1e-3, widest = 1e6; /* m: no hole is wider */
  double low = touching, high = first_guess;
  while (high < widest && !wind_around(ring, high, high, P, NULL, found)) {
    low = high;
    high *= 2.0;
  }
  for (int bisection = 0; bisection < BISECTIONS && high < widest; bisection++) {
    const double middle = 0.5 * (low + high);
    if (wind_around(ring, middle, middle, P, NULL, found))
      high = middle;
    else
      low = middle;
  }
  return high < widest && wind_around(ring, low, high, P, NULL, found);
}

/* Whether the played side of a rail faces away from the table: nowhere along it can a ball from P
 * touch that side, and somewhere a ball is behind it. */
static bool wrong_side(part_ring *ring, const carom_rail *rail, const double normal[3],
                       double radius, const double P[2]) {
  static const double places[] = {0.5, 0.25, 0.75, 0.1, 0.9, 0.02, 0.98};
  bool at_back = false;
  for (size_t index = 0; index < sizeof places / sizeof places[0]; index++)
    for (int side = 1; side >= -1; side -= 2) {
      double Q[2];
      for (int axis = 0; axis < 2; axis++)
        Q[axis] = rail->p[axis] + places[index] * (rail->q[axis] - rail->p[axis]) +
                  side * (radius + touching) * normal[axis];
      hole unused;
      if (!is_free(ring, Q) || wind_around(ring, touching, touching, P, Q, &unused))
        continue;
      if (side > 0)
        return false;
      at_back = true;
    }
  return at_back;
}

/* Checks that the ring is closed; if it is not, *fault describes the hole. */
static bool check_closed(part_ring *ring, const double P[2], carom_table_fault *fault) {
  hole found;
  if (wind_around(ring, touching, touching, P, NULL, &found))
    return true;
  if (find_hole(ring, P, &found)) {
    const shape *a = &ring->shape[found.a], *b = &ring->shape[found.b];
    double in_a[2], in_b[2];
    fault->gap = edge(a, b, found.edge_index, in_a, in_b) - a->radius - b->radius;
    fault->part = a->part;
    fault->other = b->part;
    for (int axis = 0; axis < 2; axis++)
      fault->place[axis] = 0.5 * (in_a[axis] + in_b[axis]);
  }
  return false;
}

carom_status carom_check_ring(const carom_ground *ground, carom_table_fault *fault) {
  const carom_table *table = ground->table;
  part_ring ring;
  double P[2];

  /* with rails rounded */
  shapes_of(ground, 0.0, true, &ring);
  if (!find_place(&ring, ground, touching, P) || !check_closed(&ring, P, fault))
    return CAROM_ERROR_TABLE_OPEN;
  for (int index = 0; index < table->rails; index++)
    if (wrong_side(&ring, &table->rail[index], ground->features->line[index], ground->rail[index],
                   P)) {
      fault->part = (carom_part){CAROM_PART_RAIL, index};
      for (int axis = 0; axis < 2; axis++)
        fault->place[axis] = 0.5 * (table->rail[index].p[axis] + table->rail[index].q[axis]);
      return CAROM_ERROR_RAIL_SIDE;
    }

  /* and with rails as they are detected */
  shapes_of(ground, 0.0, false, &ring);
  return carom_ok_if(check_closed(&ring, P, fault), CAROM_ERROR_TABLE_OPEN);
}

__attribute__((noinline, cold)) bool carom_is_cut_off(const carom_ground *ground,
                                                      const double point[2]) {
  const carom_features *features = ground->features;
  const double closed = touching + 2.0 * CAROM_RING_OVERLAP;
  part_ring ring;
  hole unused;
  double P[2] = {features->eye[0], features->eye[1]};
  shapes_of(ground, CAROM_RING_OVERLAP, true, &ring);
  if (!features->has_eye && !find_place(&ring, ground, closed, P))
    return false;
  /* a ring with a hole separates no positions; there, holes of up to the width of a ball are
   * treated as closed */
  shapes_of(ground, CAROM_RING_OVERLAP, false, &ring);
  double grown = 2.0 * ground->kind->radius;
  if (wind_around(&ring, closed, closed, P, NULL, &unused))
    grown = closed;
  return wind_around(&ring, grown, grown, P, point, &unused);
}
