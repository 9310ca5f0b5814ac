/* carom_detail from what the solvers know. */
#ifndef CAROM_SRC_BALL_BALL_DETAIL_H
#define CAROM_SRC_BALL_BALL_DETAIL_H

#include "ball_ball/euler.h"
#include "ball_ball/frame.h"
#include "ball_ball/kernels.h"
#include "ball_ball/precise.h"

carom_detail carom_detail_of_nothing(void);

/* Of a collision that collocation has solved, with so many right-hand sides. */
carom_detail carom_detail_of_solution(const carom_frame *frame, const carom_local *before, const float solution[OUT_COLUMNS],
                                      int evaluations);

/* Of one that the precise solver has followed to its end. */
carom_detail carom_detail_of_path(const carom_frame *frame, const carom_local *before, const carom_trajectory *path);

/* Euler's method keeps no account of its impulses; the balance of what changed gives them. */
carom_detail carom_detail_of_euler(const carom_frame *frame, const carom_local *before, const carom_local *after,
                                   const carom_euler_run *run);

#endif
