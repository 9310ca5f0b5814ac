#include "cushion/models.h"
carom_status carom_mathavan(carom_contact *c) {
  (void)c;
  return CAROM_ERROR_UNRESOLVED;
}
