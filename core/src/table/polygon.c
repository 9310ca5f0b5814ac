/* A table of any closed shape, from its corners.
 *
 * At a corner with the angle beta inside, c = cos(beta/2) and s = sin(beta/2); the frame has x
 * from the corner along the bisector into the table. A corner with a mouth m has a pocket. Its
 * rails end at the distance t from the corner, in jaws of radius r that are tangent to them, and
 * m is the distance of the surfaces of the jaws:
 *
 *     jaws      (t c - r s, +-(t s + r c))      t = (m/2 + r (1 - c)) / s
 *     pocket    (t c - r s - d, 0), radius m/2
 *
 *                       / rail
 *                  .-. /
 *                 ( r |          jaw, tangent to the rail where it ends: t from the corner,
 *       .-'''-.    '-'           in which both rails would meet
 *      /       \    |
 *     |   m/2   |   | m          ---> x, the bisector, into the table
 *      \       /    |
 *       '-...-'    .-.
 *       pocket    ( r |
 *                  '-' \
 *                       \ rail
 *
 * The circle touches the line between the centres of the jaws for d = m/2. A ball of radius R
 * cannot pass between it and a jaw for d^2 < (m/2 + r + R)^2 - (m/2 + r)^2, so that d is at most
 * 0.9 of that. Corners that are not clearly convex have a jaw of radius 0: there balls meet the
 * corner itself. */
#include "table/table.h"

#include <math.h>
#include <string.h>

static const double FARTHEST = 1e6;  /* m: of a corner, a mouth or a jaw; farther ones lose bits */
static const double STRAIGHT = 1e-9; /* of the sum of two directions at a straight corner */
static const double POCKET_DEPTH = 0.08; /* m: where balls lie in drawings */
static const double CLEARLY = 0.17;      /* sine of the turn at a corner where rails need no jaw */
static const double SAFE = 0.9;          /* fraction of the greatest d */

/* A corner: where it is, the directions to the next and the one before, and where rails end. */
typedef struct corner_joint {
  double corner[2], next[2], previous[2], turn, mouth, cut;
} corner_joint;

static double direction(const double start[2], const double end[2], double way[2]) {
  const double x = end[0] - start[0], y = end[1] - start[1], size = sqrt(x * x + y * y);
  way[0] = x / size;
  way[1] = y / size;
  return size;
}

/* The table is to the left of a rail from p to q, which a line of zeros means. */
static void add_rail(carom_table *table, double nose, const double p[2], const double q[2]) {
  carom_rail *rail = &table->rail[table->rails++];
  *rail = (carom_rail){.p = {p[0], p[1]}, .q = {q[0], q[1]}, .height = nose, .side = 1};
}

static void add_jaw(carom_table *table, double nose, double radius, double x, double y) {
  table->jaw[table->jaws++] = (carom_jaw){.centre = {x, y}, .radius = radius, .height = nose};
}

/* The pocket of a corner, and the jaws at the ends of its rails. */
static void add_pocket(carom_table *table, const corner_joint *joint, double nose,
                       double jaw_radius, double ball_radius) {
  const double half = 0.5 * joint->mouth,
               out = sqrt((half + jaw_radius + ball_radius) * (half + jaw_radius + ball_radius) -
                          (half + jaw_radius) * (half + jaw_radius));
  const double back = carom_lesser(half, SAFE * out);

  /* the bisector: into the table, also where the corner points into it */
  double bisector[2] = {joint->next[0] + joint->previous[0], joint->next[1] + joint->previous[1]};
  double size = carom_plane_size(bisector);
  if (size < STRAIGHT) { /* a straight corner */
    bisector[0] = -joint->next[1];
    bisector[1] = joint->next[0];
    size = 1.0;
  } else if (joint->turn < 0.0) {
    size = -size;
  }
  for (int axis = 0; axis < 2; axis++)
    bisector[axis] /= size;

  /* the jaws, outside of each rail's end */
  const double first[2] = {
      joint->corner[0] + joint->cut * joint->previous[0] + jaw_radius * -joint->previous[1],
      joint->corner[1] + joint->cut * joint->previous[1] + jaw_radius * joint->previous[0]};
  const double last[2] = {
      joint->corner[0] + joint->cut * joint->next[0] + jaw_radius * joint->next[1],
      joint->corner[1] + joint->cut * joint->next[1] - jaw_radius * joint->next[0]};
  add_jaw(table, nose, jaw_radius, first[0], first[1]);
  add_jaw(table, nose, jaw_radius, last[0], last[1]);
  table->pocket[table->pockets++] =
      (carom_pocket){.centre = {0.5 * (first[0] + last[0]) - back * bisector[0],
                                0.5 * (first[1] + last[1]) - back * bisector[1]},
                     .radius = half,
                     .depth = POCKET_DEPTH};
}

/* Reports which corner is at fault, and together with which other; -1: none. */
static carom_status blame(carom_table_fault *fault, int corner, int second, carom_status status) {
  fault->part = (carom_part){CAROM_PART_CORNER, corner};
  if (second >= 0)
    fault->other = (carom_part){CAROM_PART_CORNER, second};
  return status;
}

/* Checks each corner by itself and with the next one. */
static carom_status check_corners(const carom_corner *corner, int count, carom_table_fault *fault) {
  int pockets = 0;
  for (int index = 0; index < count; index++) {
    const carom_corner *start = &corner[index], *end = &corner[(index + 1) % count];
    if (!(fabs(start->x) < FARTHEST && fabs(start->y) < FARTHEST && start->mouth >= 0.0 &&
          start->mouth < FARTHEST))
      return blame(fault, index, -1, CAROM_ERROR_CORNER);
    if (start->x == end->x && start->y == end->y)
      return blame(fault, index, (index + 1) % count, CAROM_ERROR_CORNERS_MEET);
    pockets += start->mouth > 0.0;
    if (pockets > CAROM_POCKETS_MOST)
      return blame(fault, index, -1, CAROM_ERROR_POCKETS);
  }
  return CAROM_OK;
}

/* Moves the corners so that the least x and y are 0. */
static void move_to_origin(const carom_corner *start, int count, carom_corner *end) {
  double x = start[0].x, y = start[0].y;
  for (int index = 1; index < count; index++) {
    x = carom_lesser(x, start[index].x);
    y = carom_lesser(y, start[index].y);
  }
  for (int index = 0; index < count; index++)
    end[index] = (carom_corner){start[index].x - x, start[index].y - y, start[index].mouth};
}

/* Twice the area, above 0 where the corners go round with the table to the left. */
static double twice_area_of(const carom_corner *corner, int count) {
  double area = 0.0;
  for (int index = 0; index < count; index++) {
    const carom_corner *start = &corner[index], *end = &corner[(index + 1) % count];
    area += start->x * end->y - end->x * start->y;
  }
  return area;
}

/* The corners in the order that has the table to the left. */
static carom_status joints_of(const carom_corner *corner, int count, double jaw_radius, double area,
                              corner_joint *joint, carom_table_fault *fault) {
  int jaws = 0;

  /* each corner with the directions to its neighbours */
  for (int number = 0; number < count; number++) {
    int step = 1, index = number;
    if (!(area > 0.0)) {
      step = count - 1;
      index = count - 1 - number;
    }
    const carom_corner *vertex = &corner[index], *following = &corner[(index + step) % count],
                       *preceding = &corner[(index + count - step) % count];
    joint[number].corner[0] = vertex->x;
    joint[number].corner[1] = vertex->y;
    direction(joint[number].corner, (double[2]){following->x, following->y}, joint[number].next);
    direction(joint[number].corner, (double[2]){preceding->x, preceding->y},
              joint[number].previous);

    /* beta by its half: the turn is sin(beta), above 0 where the corner is convex */
    joint[number].turn = joint[number].next[0] * joint[number].previous[1] -
                         joint[number].next[1] * joint[number].previous[0];
    const double cosine = carom_plane_dot(joint[number].next, joint[number].previous);
    const double half_sine = sqrt(carom_greater(0.5 - 0.5 * cosine, 0.0)),
                 half_cosine =
                     copysign(sqrt(carom_greater(0.5 + 0.5 * cosine, 0.0)), joint[number].turn);
    joint[number].mouth = vertex->mouth;
    joint[number].cut = 0.0;
    if (vertex->mouth > 0.0) {
      joint[number].cut = (0.5 * vertex->mouth + jaw_radius * (1.0 - half_cosine)) / half_sine;
      jaws += 2;
    } else {
      jaws += joint[number].turn < CLEARLY;
    }
    if (jaws > CAROM_JAWS_MOST)
      return blame(fault, index, -1, CAROM_ERROR_JAWS);
  }
  return CAROM_OK;
}

/* On which side of the line from a to b a corner is, by the sign. */
static double side_of(const carom_corner *a, const carom_corner *b, const carom_corner *axis) {
  return (b->x - a->x) * (axis->y - a->y) - (b->y - a->y) * (axis->x - a->x);
}

/* Whether all corners lie on one line. */
static bool are_in_line(const carom_corner *corner, int count) {
  for (int index = 2; index < count; index++)
    if (side_of(&corner[0], &corner[1], &corner[index]) != 0.0)
      return false;
  return true;
}

/* Whether two sides meet that are no neighbours; *first and *second become theirs, each from its
 * corner to the next. */
static bool sides_cross(const carom_corner *corner, int count, int *first, int *second) {
  for (int side = 0; side < count; side++)
    for (int second_side = side + 2; second_side < count; second_side++) {
      const carom_corner *a = &corner[side], *b = &corner[side + 1], *c = &corner[second_side],
                         *d = &corner[(second_side + 1) % count];
      const double c_side = side_of(a, b, c), d_side = side_of(a, b, d), a_side = side_of(c, d, a),
                   b_side = side_of(c, d, b);
      /* sides on one line meet where their boxes do */
      const bool apart = carom_greater(a->x, b->x) < carom_lesser(c->x, d->x) ||
                         carom_greater(c->x, d->x) < carom_lesser(a->x, b->x) ||
                         carom_greater(a->y, b->y) < carom_lesser(c->y, d->y) ||
                         carom_greater(c->y, d->y) < carom_lesser(a->y, b->y);
      if ((side > 0 || second_side < count - 1) && !apart && c_side * d_side <= 0.0 &&
          a_side * b_side <= 0.0) {
        *first = side;
        *second = second_side;
        return true;
      }
    }
  return false;
}

/* The rails from corner to corner, cut short by their mouths and jaws, and what is at the corner
 * where each begins: a pocket, or a jaw where the corner juts into the table. */
static carom_status add_sides(const corner_joint *joint, int count, double nose_height,
                              double jaw_radius, double ball_radius, bool turned,
                              carom_table *table, carom_table_fault *fault) {
  for (int index = 0; index < count; index++) {
    const int next = (index + 1) % count;
    const corner_joint *start = &joint[index], *end = &joint[next];
    double way[2], p[2], q[2];
    if (direction(start->corner, end->corner, way) <= start->cut + end->cut) {
      if (turned)
        return blame(fault, count - 1 - next, count - 1 - index, CAROM_ERROR_MOUTHS);
      return blame(fault, index, next, CAROM_ERROR_MOUTHS);
    }
    for (int axis = 0; axis < 2; axis++) {
      p[axis] = start->corner[axis] + start->cut * way[axis];
      q[axis] = end->corner[axis] - end->cut * way[axis];
    }
    add_rail(table, nose_height, p, q);
    if (start->mouth > 0.0)
      add_pocket(table, start, nose_height, jaw_radius, ball_radius);
    else if (start->turn < CLEARLY)
      add_jaw(table, nose_height, 0.0, start->corner[0], start->corner[1]);
  }
  return CAROM_OK;
}

carom_status carom_table_polygon(const carom_corner *corners, int count, double nose_height,
                                 double jaw_radius, double ball_radius, carom_table *table,
                                 carom_table_fault *fault) {
  carom_table_fault unused;
  if (corners == NULL || table == NULL)
    return CAROM_ERROR_NULL;
  if (fault == NULL)
    fault = &unused;
  memset(fault, 0, sizeof *fault);
  memset(table, 0, sizeof *table);
  if (!carom_is_positive(ball_radius))
    return CAROM_ERROR_RADIUS;
  if (!(jaw_radius >= 0.0 && jaw_radius < FARTHEST))
    return CAROM_ERROR_JAW_RADIUS;
  if (count < 3 || count > CAROM_RAILS_MOST)
    return CAROM_ERROR_CORNERS;

  carom_status status = check_corners(corners, count, fault);
  if (status != CAROM_OK)
    return status;
  carom_corner corner[CAROM_RAILS_MOST];
  move_to_origin(corners, count, corner);
  const double area = twice_area_of(corner, count);
  if (are_in_line(corner, count))
    return blame(fault, 0, -1, CAROM_ERROR_CORNERS_IN_LINE);
  int first, second;
  if (sides_cross(corner, count, &first, &second)) {
    fault->part = (carom_part){CAROM_PART_RAIL, first};
    fault->other = (carom_part){CAROM_PART_RAIL, second};
    return CAROM_ERROR_SIDES_CROSS;
  }
  corner_joint joints[CAROM_RAILS_MOST];
  status = joints_of(corner, count, jaw_radius, area, joints, fault);
  if (status != CAROM_OK)
    return status;

  /* the playing area reaches as far as the corners */
  table->ball_radius = ball_radius;
  for (int index = 0; index < count; index++) {
    table->width = carom_greater(table->width, corner[index].x);
    table->length = carom_greater(table->length, corner[index].y);
  }
  status = add_sides(joints, count, nose_height, jaw_radius, ball_radius, area < 0.0, table, fault);
  if (status != CAROM_OK)
    return status;
  return carom_table_check(table, ball_radius, fault);
}
