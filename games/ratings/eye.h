/* Where balls lie for a player who sees their positions with errors. */
#ifndef CAROM_PLAN_EYE_H
#define CAROM_PLAN_EYE_H

#include "shot/shot.h"

/* Draws the positions of all balls of a layout at rest, of which ball `struck` is the cue ball, for
 * play `row` of a stage of draws. drawn[k] becomes ball k with its displacement; eye: the standard
 * deviation, m, at least 0. The draws depend only on eye, seed, stage and row, so all strokes that
 * are compared meet the same ones. */
void carom_eye_draw(const carom_prepared *layout, int struck, double eye, uint64_t seed,
                    uint32_t stage, uint64_t row, carom_ball_state *drawn);

#endif
