/* How many processors this process may use, on Windows. */
#include "platform/processors.h"

#include <windows.h>

int carom_processors(void) {
  const DWORD count = GetActiveProcessorCount(ALL_PROCESSOR_GROUPS);
  return count > 1 ? (int)count : 1;
}
