/* What every subcommand uses: the parts of this room, and the headers of C that they need. Files
 * of this room include each other one by one. */
#ifndef CAROM_CLI_PROGRAM_H
#define CAROM_CLI_PROGRAM_H

#include "program/command.h"
#include "program/memory.h"
#include "program/message.h"
#include "program/monotonic.h"
#include "program/options.h"
#include "program/output.h"
#include "program/place.h"
#include "program/words.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#endif
