/* What files are that were given for something else, by their first bytes. */
#include "formats.h"

#include <string.h>

static const char utf16[] = "UTF-16 text; save it in UTF-8", compressed[] = "compressed; unpack it first";

static const struct {
  const char *bytes;
  size_t size;
  const char *kind;
} kinds[] = {
    {"\x93NUMPY", 6, "a NumPy array; give it as a file whose name ends in .npy"},
    {"PK\x03\x04", 4, "an archive, such as .npz or .xlsx; save one array as .npy, or one sheet as CSV"},
    {"\xFF\xFE", 2, utf16},
    {"\xFE\xFF", 2, utf16},
    {"\x1F\x8B", 2, compressed},         /* gzip */
    {"\xFD\x37zXZ", 5, compressed},      /* xz */
    {"\x28\xB5\x2F\xFD", 4, compressed}, /* zstd */
    {"BZh", 3, compressed},              /* bzip2 */
};

const char *other_kind(const char *b, size_t size) {
  for (size_t k = 0; k < sizeof kinds / sizeof kinds[0]; k++)
    if (size >= kinds[k].size && memcmp(b, kinds[k].bytes, kinds[k].size) == 0)
      return kinds[k].kind;
  /* UTF-16 without its mark: every other byte of Latin letters is 0 */
  if (size >= 4 && ((b[0] != 0 && b[1] == 0 && b[2] != 0 && b[3] == 0) || (b[0] == 0 && b[1] != 0 && b[2] == 0 && b[3] != 0)))
    return utf16;
  return NULL;
}
