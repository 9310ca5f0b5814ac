/* Written by tools/project.py from packaging/project.toml: authors and lines of the citation as
 * BibTeX, and for CMake where bugs are reported. */
#ifndef CAROM_PROJECT_H
#define CAROM_PROJECT_H

#define PROJECT_AUTHORS "{The developers of carom}"
#define PROJECT_CITED ""
#define PROJECT_TRACKER ""

#endif
