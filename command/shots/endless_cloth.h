/* A cloth without an end, for motion that no cushion stops. */
#ifndef CAROM_CLI_ENDLESS_CLOTH_H
#define CAROM_CLI_ENDLESS_CLOTH_H

#include "carom_shot.h"

/* A table whose cushions no ball reaches, with the origin in its middle. */
carom_table endless_cloth(double radius);

#endif
