/* Promises of comments about numbers inside the library, checked if CAROM_CHECKED is defined: in
 * builds without optimisation and with sanitizers. There a program stops at a promise that is
 * broken; in all others nothing is left of it. Promises are of the library's own doing: what a
 * caller gives is checked, and rejected by a status. So sources that are read once more for
 * derivatives promise nothing there: they follow events that a caller may have damaged. Numbers may
 * overflow if the caller's are extreme, so promises about them hold for NaN. */
#ifndef CAROM_SRC_PLATFORM_PROMISE_H
#define CAROM_SRC_PLATFORM_PROMISE_H

#ifdef CAROM_CHECKED
#define CAROM_PROMISE(holds) ((holds) ? (void)0 : __builtin_trap())
#else
#define CAROM_PROMISE(holds) ((void)0)
#endif

#endif
