# Sourced by run and test: what the machine needs, and how a preset is built. Expects the repository root as working folder.

say() { printf '%s\n' "$*" >&2; }
fail() { say "carom: $*"; exit 1; }

# need PROGRAM-OR-FILE PACKAGE WHY: notes a package to install when the program or header is not there.
missing='' reasons=''
need() {
  case $1 in
    /*) for found in $1; do [ -e "$found" ] && return 0; done ;;
    *) command -v "$1" > /dev/null 2>&1 && return 0 ;;
  esac
  missing="$missing $2"
  reasons="$reasons
  $2: $3"
}

# want PROGRAM-OR-FILE PACKAGE WHY: says what could be had with a package that carom does without.
want() {
  case $1 in
    /*) [ -e "$1" ] && return 0 ;;
    *) command -v "$1" > /dev/null 2>&1 && return 0 ;;
  esac
  say "optional and not installed: $2: $3"
}

# Installs what need() has noted, or says what to install where that is not possible.
install_missing() {
  [ -n "$missing" ] || return 0
  say "carom needs packages that are not installed:$reasons"
  command -v apt-get > /dev/null 2>&1 || fail "no apt-get here; install these (or your system's like) and run again:$missing"
  if [ "$(id -u)" = 0 ]; then
    as_root=''
  elif command -v sudo > /dev/null 2>&1 && sudo -n true 2> /dev/null; then
    as_root='sudo'
  else
    fail "installing needs root; please run: sudo apt-get install$missing"
  fi
  say "installing:$missing"
  log=$(mktemp)
  # shellcheck disable=SC2086
  if ! { $as_root apt-get update && DEBIAN_FRONTEND=noninteractive $as_root apt-get install -y --no-install-recommends $missing; } \
    > "$log" 2>&1; then
    tail -n 20 "$log" >&2
    rm -f "$log"
    fail "apt-get could not install:$missing"
  fi
  rm -f "$log"
  missing=''
}

need_to_build() {
  need cc gcc "C compiler"
  need cmake cmake "build system"
  need ninja ninja-build "build system"
  need '/usr/include/csv.h' libcsv-dev "CSV reading in the command"
  want '/usr/include/papi.h' libpapi-dev "hardware counters in carom bench, where the machine has some"
}

# build PRESET [CMAKE-OPTIONS]: configures and builds; quiet unless it fails.
build() {
  preset=$1
  shift
  log=$(mktemp)
  say "building ($preset) ..."
  if ! { cmake --preset "$preset" "$@" && cmake --build --preset "$preset"; } > "$log" 2>&1; then
    tail -n 60 "$log" >&2
    rm -f "$log"
    fail "the build ($preset) failed"
  fi
  rm -f "$log"
}
