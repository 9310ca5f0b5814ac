/* Names and texts of the public enumerations, from the lists in carom.h. */
#include "carom.h"

#define TEXT_OF(x) #x
#define TEXT(x) TEXT_OF(x)

const char *carom_version(void) {
  return TEXT(CAROM_VERSION_MAJOR) "." TEXT(CAROM_VERSION_MINOR) "." TEXT(CAROM_VERSION_PATCH);
}

const char *carom_status_name(carom_status status) {
  switch (status) {
#define CASE(NAME, value, name, text) \
  case CAROM_##NAME:                  \
    return name;
    CAROM_STATUS_LIST(CASE)
#undef CASE
  }
  return "unknown";
}

const char *carom_status_string(carom_status status) {
  switch (status) {
#define CASE(NAME, value, name, text) \
  case CAROM_##NAME:                  \
    return text;
    CAROM_STATUS_LIST(CASE)
#undef CASE
  }
  return "not a status of this library";
}

const char *carom_solver_name(carom_solver solver) {
  static const char *const names[] = {
#define NAME_OF(NAME, name, text) [CAROM_SOLVER_##NAME] = name,
      CAROM_SOLVER_LIST(NAME_OF)
#undef NAME_OF
  };
  return (int)solver >= 0 && solver < CAROM_SOLVER_COUNT ? names[solver] : NULL;
}

const char *carom_slip_name(carom_slip slip) {
  static const char *const names[] = {
#define NAME_OF(NAME, name, text) [CAROM_SLIP_##NAME] = name,
      CAROM_SLIP_LIST(NAME_OF)
#undef NAME_OF
  };
  return (int)slip >= 0 && slip < CAROM_SLIP_COUNT ? names[slip] : NULL;
}

const char *carom_field_name(int field) {
#define BALL(ball)                                                                                                        \
#ball ".r[0]", #ball ".r[1]", #ball ".r[2]", #ball ".v[0]", #ball ".v[1]", #ball ".v[2]", #ball ".w[0]", #ball ".w[1]", \
      #ball ".w[2]", #ball ".radius", #ball ".mass", #ball ".mu_cloth"
  static const char *const names[] = {BALL(a), BALL(b), "mu_ball", "restitution"};
#undef BALL
  return field >= 0 && field < (int)(sizeof names / sizeof names[0]) ? names[field] : NULL;
}
