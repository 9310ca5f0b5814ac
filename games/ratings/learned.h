/* The numbers of chances.c, fitted to games that were played: `carom-lab learn` plays them and
 * prints the rows. */
#ifndef CAROM_PLAN_LEARNED_H
#define CAROM_PLAN_LEARNED_H

#include "view.h"

typedef struct learned {
  double next[NEXT_NUMBERS], later[LATER_NUMBERS], first[FIRST_NUMBERS];
  double mean;    /* of x[2] */
  double width;   /* of the table of these racks, m */
  double stretch; /* of the log-odds of a value: carom-lab plan --games prints it. It is about
                     the */
  double edge;    /* difference of the players, of which this share counts: --against shows it */
} learned;

/* For the games that were played for it; the others use a game with the same race. */
static const learned learned_of[] = {
    [CAROM_RULES_EIGHTBALL] =
        {/* of 23001 strokes: carom-lab learn --rules eightball --racks 6144 --shots 200 --seed 0 */
         /* log-likelihood of a stroke -0.2723; of one number for all, -0.4124 */
         .next = {-0.351, -0.922, 1.072, 2.570, 0.239, 0.008, 0.371},
         /* log-likelihood of a stroke -0.2919; of one number for all, -0.3579 */
         .later = {1.838, -1.253, -0.193, 0.792},
         /* log-likelihood of a stroke -0.5535; of one number for all, -0.6161 */
         .first = {2.520, -1.370, -1.846},
         .mean = 0.624,
         .width = 0.9906,
         .stretch = 0.9,
         .edge = 0.85},
    [CAROM_RULES_NINEBALL] =
        {/* of 19183 strokes: carom-lab learn --rules nineball --racks 6144 --shots 200 --seed 0 */
         /* log-likelihood of a stroke -0.2877; of one number for all, -0.4606 */
         .next = {-0.023, -1.126, 1.574, 1.574, 0.000, -0.023, 0.000},
         /* log-likelihood of a stroke -0.2096; of one number for all, -0.2677 */
         .later = {1.769, -1.507, 1.047, 0.210},
         /* log-likelihood of a stroke -0.5699; of one number for all, -0.6717 */
         .first = {1.141, -1.421, 2.196},
         .mean = 0.738,
         .width = 0.9906,
         .stretch = 1.5,
         .edge = 0.8},
    [CAROM_RULES_ONEPOCKET] =
        {/* of 17534 strokes: carom-lab learn --rules onepocket --racks 6144 --shots 200 --seed 0 */
         /* log-likelihood of a stroke -0.3248; of one number for all, -0.5642 */
         .next = {-0.883, -0.723, 0.965, 4.184, -0.345, -0.805, -2.275},
         /* log-likelihood of a stroke -0.3481; of one number for all, -0.4123 */
         .later = {1.709, -1.237, -0.877, 0.757},
         /* log-likelihood of a stroke -0.6616; of one number for all, -0.6888 */
         .first = {0.211, -0.555, -0.329},
         .mean = 0.155,
         .width = 1.27,
         .stretch = 1.6,
         .edge = 1.0},
    [CAROM_RULES_STRAIGHT] =
        {/* of 19836 strokes: carom-lab learn --rules straight --racks 2048 --shots 200 --seed 0 */
         /* log-likelihood of a stroke -0.1891; of one number for all, -0.2654 */
         .next = {0.077, -1.013, 0.616, 1.777, 1.510, 0.000, -0.604},
         /* log-likelihood of a stroke -0.1639; of one number for all, -0.1947 */
         .later = {2.676, -1.522, 0.657, -0.455},
         /* log-likelihood of a stroke -0.4254; of one number for all, -0.4976 */
         .first = {3.305, -1.726, -2.164},
         .mean = 0.455,
         .width = 1.27,
         .stretch = 1.0,
         .edge = 1.0},
    [CAROM_RULES_SNOOKER] =
        {/* of 5484 strokes: carom-lab learn --rules snooker --racks 1792 --shots 200 --seed 0 */
         /* log-likelihood of a stroke -0.3135; of one number for all, -0.6076 */
         .next = {-1.520, -1.009, 1.989, 4.098, -0.347, -0.115, 0.000},
         /* log-likelihood of a stroke -0.3062; of one number for all, -0.3269 */
         .later = {0.766, -1.312, -0.134, 0.389},
         /* log-likelihood of a stroke -0.4624; of one number for all, -0.6190 */
         .first = {-0.530, -1.434, -0.500},
         .mean = 0.260,
         .width = 1.778,
         .stretch = 1.0,
         .edge = 1.0},
    [CAROM_RULES_BANK] =
        {/* of 16870 strokes: carom-lab learn --rules bank --racks 12288 --shots 200 --seed 0 */
         /* log-likelihood of a stroke -0.5355; of one number for all, -0.6068 */
         .next = {-2.034, -0.732, 0.211, 0.999, -0.070, -0.137, 0.889},
         /* log-likelihood of a stroke -0.6286; of one number for all, -0.6621 */
         .later = {-1.047, -0.721, 0.019, 0.005},
         /* log-likelihood of a stroke -0.4736; of one number for all, -0.5398 */
         .first = {-1.255, -0.903, 0.168},
         .mean = 0.433,
         .width = 1.27,
         .stretch = 1.0,
         .edge = 1.0},
    [CAROM_RULES_PYRAMID] =
        {/* of 10849 strokes: carom-lab learn --rules pyramid --racks 256 --shots 200 --seed 0 */
         /* log-likelihood of a stroke -0.3373; of one number for all, -0.5443 */
         .next = {-1.878, -0.772, -0.196, 4.276, 1.462, 0.000, -1.878},
         /* log-likelihood of a stroke -0.5426; of one number for all, -0.6871 */
         .later = {0.256, -0.880, -4.707, 3.030},
         /* log-likelihood of a stroke -0.3801; of one number for all, -0.4423 */
         .first = {-0.098, -1.478, -1.065},
         .mean = 0.177,
         .width = 1.775,
         .stretch = 1.0,
         .edge = 1.0},
};

#endif
