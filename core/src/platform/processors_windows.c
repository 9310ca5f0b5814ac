/* How many processors this process may use, on Windows. */
#include "platform/processors.h"
#include "platform/win32.h"

int carom_processors(void) {
  const unsigned long count = GetActiveProcessorCount(0xffff); /* of all groups */
  return count > 1 ? (int)count : 1;
}
