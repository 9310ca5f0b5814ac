#ifndef CAROM_CLI_EVENT_BREAK_H
#define CAROM_CLI_EVENT_BREAK_H

#include "program/options.h"
#include "shots/shoot_flags.h"

extern const char event_break_help[];

/* Reads the name of conditions, `tournament`, into a bool. */
OPTION_SET(set_conditions);

/* Fills in what is not given of a break as at professional events: the cloth, the speed, the
 * position of the cue ball, and eight-ball's rack. */
void fill_event_break(shoot_flags *f, carom_rack_kind *rack);

#endif
