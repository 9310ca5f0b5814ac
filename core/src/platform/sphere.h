/* How a solid sphere of mass m and radius R, whose inertia is 2/5 m R^2, answers an impulse P that
 * acts on its surface along t, at n R from its centre; t is a unit vector across the unit vector n.
 *
 *                .--t-->.          v += P/m t
 *             .     |     .        W += 5/2 P/m n x t      W = R w, a velocity
 *            (    n |      )
 *            (      o      )       The surface moves there at v + W x n. So its part along t
 *             .           .        grows by P/m of v and by 5/2 P/m of the turn.
 *                ._____.
 */
#ifndef CAROM_SRC_PLATFORM_SPHERE_H
#define CAROM_SRC_PLATFORM_SPHERE_H

#define CAROM_SPHERE_TURN 2.5   /* 5/2: of W, for each P/m */
#define CAROM_SPHERE_SLIP 3.5   /* 1 + 5/2: of the surface's velocity, for each P/m */
#define CAROM_SPHERE_ENERGY 0.2 /* of the turn, for each m W^2: half of 2/5 */

#endif
