/* The law of an impact with two frictional contacts, as numbers.
 *
 * A ball is struck at a DRIVING contact, where another ball or a cushion pushes it, and slips at
 * that contact and on the CLOTH. p is the normal impulse of the driving contact over the mass of
 * the ball; the prime is the derivative by p. Both tangent planes have the axes x (horizontal)
 * and y. With
 *
 *               ___
 *             /     \  driving contact: p pushes the ball off, f acts along its tangent plane,
 *            |   o   |                  the slip is a, y points up
 *             \_ _ _/
 *     __________|__________  cloth: it bears the load g, F acts along it, the slip is b
 *
 *     a   the slip at the driving contact       f   its friction on the ball, per unit of p
 *     b   the slip on the cloth                 F   its friction on the ball, per unit of p
 *     v   the speed of approach                 g   the load that the cloth bears, per unit of p
 *
 * the impact obeys
 *
 *     a_x' =       K_x f_x + C_x F_x       b_x' =       L_x f_x + H F_x
 *     g = max(0, g_0 + g_1 f_y)
 *     a_y' = A_0 + K_y f_y + C_y F_y       b_y' = B_0 + L_y f_y + H F_y
 *     v' = V_0 + V_f f_y + V_F F_y
 *
 * and Coulomb's law: f = -mu a/|a| and F = -mu_c g b/|b| where there is slip; where there is
 * none |f| <= mu and |F| <= mu_c g. Compression ends at v = 0. With W = int v dp and W_c its
 * value there, the impact ends where W = (1 - e^2) W_c.
 *
 *     name          cushion, theta the angle of the nose       two balls, kappa = 1 + M / M_other
 *     A_0           sin cos                                    0
 *     K_x, K_y      7/2, 5/2 + sin^2                           7/2 kappa, 5/2 kappa
 *     C_x, C_y      1 - 5/2 sin, 5/2 - sin                     1, 5/2
 *     B_0           -cos                                       -1
 *     L_x, L_y      1 - 5/2 sin, 5/2 - sin                     1, -5/2 s
 *     H             7/2                                        1 - 5/2 s
 *     g_0, g_1      sin, -cos                                  0, -1
 *     V_0, V_f, V_F -cos, -sin, 1                              -kappa, 0, 1
 *
 * s is -1 for the slip of the 2014 paper and +1 for that of pooltool. All speeds are over the
 * speed of approach, so v starts at 1. Derivation: docs/understanding/method.md. */
#ifndef CAROM_SRC_CONTACT_LAW_LAW_H
#define CAROM_SRC_CONTACT_LAW_LAW_H

typedef struct carom_law {
  double A_0, K_x, K_y, C_x, C_y;
  double B_0, L_x, L_y, H;
  double g_0, g_1, V_0, V_f, V_F;
  double mu, mu_c; /* friction of the driving contact and of the cloth */
  double e;        /* restitution */
} carom_law;

#endif
