/* A build without C++ has no derivatives: each call says so. */
#include "tangent/work.h"

#ifndef CAROM_WITH_TANGENTS

void carom_tangent_begin(carom_tangent_work *w, int i) {
  (void)w;
  (void)i;
}

carom_status carom_tangent_follow(carom_tangent_work *w, const carom_event *event) {
  (void)w;
  (void)event;
  return CAROM_ERROR_NO_TANGENTS;
}

carom_status carom_tangent_follow_cluster(carom_tangent_work *w, const carom_event *events,
                                          int count, int64_t at) {
  (void)w;
  (void)events;
  (void)count;
  (void)at;
  return CAROM_ERROR_NO_TANGENTS;
}

void carom_tangent_at(const carom_tangent_work *w, int i, double time, carom_tangent_rows d) {
  (void)w;
  (void)i;
  (void)time;
  (void)d;
}

carom_status carom_tangent_of_balls(const carom_impact *in, const carom_options *opt,
                                    const carom_tangent_pass *pass, const double *seeds,
                                    double *tangent, carom_tangent_note *note) {
  (void)in;
  (void)opt;
  (void)pass;
  (void)seeds;
  (void)tangent;
  (void)note;
  return CAROM_ERROR_NO_TANGENTS;
}

carom_status carom_tangent_of_cushion(const carom_cushion_impact *in,
                                      const carom_cushion_options *opt,
                                      const carom_tangent_pass *pass, const double *seeds,
                                      double *tangent, carom_tangent_note *note) {
  (void)in;
  (void)opt;
  (void)pass;
  (void)seeds;
  (void)tangent;
  (void)note;
  return CAROM_ERROR_NO_TANGENTS;
}

#endif
