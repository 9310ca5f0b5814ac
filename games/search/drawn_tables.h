/* Tables that the player does not know, drawn for a plan. */
#ifndef CAROM_PLAN_DRAWN_TABLES_H
#define CAROM_PLAN_DRAWN_TABLES_H

#include "search_state.h"

/* Draws the tables, into the caller's memory. */
void carom_search_tables(carom_search *search, carom_drawn_table *room);
/* The balls in play on the table of a row. */
carom_prepared carom_search_drawn(const carom_search *search, uint32_t draws, int64_t row);

#endif
