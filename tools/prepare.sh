# shellcheck shell=sh
# Sourced by run and test: what the machine needs, and how a preset is built. Expects the repository root as working folder.

# print_usage SCRIPT: the comment at the head of a script.
print_usage() {
  sed -n '2,/^[^#]/s/^# \{0,1\}//p' "$1"
}

say() { printf '%s\n' "$*" >&2; }
fail() {
  say "carom: $*"
  exit 1
}

# there PROGRAM-OR-FILE: is it? A file may be a pattern.
there() {
  case $1 in
    /*)
      for found in $1; do [ -e "$found" ] && return 0; done
      return 1
      ;;
    *) command -v "$1" > /dev/null 2>&1 ;;
  esac
}

# need PROGRAM-OR-FILE PACKAGE WHY: notes a package without which nothing goes.
missing='' reasons=''
need() {
  there "$1" && return 0
  missing="$missing $2"
  reasons="$reasons
  $2: $3"
}

# want PROGRAM-OR-FILE PACKAGE WHY: notes a package that is installed where that can be done, and that carom does without.
# What could not be had is asked for once a day, not at every run.
wanted='' wanted_reasons='' asked=build/not-installed
[ -z "$(find "$asked" -mmin +1440 2> /dev/null)" ] || rm -f "$asked"
want() {
  there "$1" && return 0
  grep -qsx "$2" "$asked" && return 0
  wanted="$wanted $2"
  wanted_reasons="$wanted_reasons
  $2: $3"
}

# need_python WHY MODULE..., want_python WHY MODULE...: the same for modules of Python, which tools/python finds or gets by itself
# where it can; Debian's packages otherwise.
need_python() { python_modules need "$@"; }
want_python() { python_modules want "$@"; }
python_modules() {
  note=$1 why=$2
  shift 2
  CAROM_PYTHON_MODULES="$*" tools/python -c '' 2> /dev/null && return 0
  for module; do
    "$note" "/usr/lib/python3/dist-packages/$module" "python3-$module" "$why"
  done
}

# want_python_package: what the tests of the package python/ are skipped without, unless the Python on the path has it already.
want_python_package() {
  python3 -c 'import os, sysconfig, venv, ensurepip
assert os.path.exists(os.path.join(sysconfig.get_path("include"), "Python.h"))' 2> /dev/null && return 0
  want '/usr/lib/python3*/ensurepip' python3-venv "virtual environments, for the tests of the Python package"
  want '/usr/include/python3*/Python.h' python3-dev "headers of Python, for the tests of the Python package"
}

# Installs what need() and want() have noted. Fails, and says what to install, where something needed cannot be had.
install_missing() {
  [ -n "$missing$wanted" ] || return 0
  [ -z "$missing" ] || say "carom needs packages that are not installed:$reasons"
  [ -z "$wanted" ] || say "carom can do more with packages that are not installed:$wanted_reasons"
  as_root=
  if ! command -v apt-get > /dev/null 2>&1; then
    obstacle="no apt-get here; install these, or your system's like, and run again:$missing"
  elif [ "$(id -u)" = 0 ]; then
    obstacle=
  elif command -v sudo > /dev/null 2>&1 && sudo -n true 2> /dev/null; then
    as_root=sudo obstacle=
  else
    obstacle="installing needs root; please run: sudo apt-get install$missing"
  fi
  if [ -z "$obstacle" ]; then
    install_with_apt
  elif [ -n "$missing" ]; then
    fail "$obstacle"
  else
    say "going on without them: installing needs apt-get, and root"
  fi
  missing='' wanted=''
}

install_with_apt() {
  say "installing:$missing$wanted"
  log=$(mktemp)
  keep_saying "installing" "$log"
  saying=$!
  $as_root apt-get update > "$log" 2>&1 || say "apt-get update failed; going on with the lists that are here"
  # One call installs everything, because apt-get needs seconds to resolve each call. If a package is not available, each
  # one is tried alone.
  failed='' newest=''
  for package in $wanted; do
    found=$(newest_of "$package")
    newest="$newest ${found:-$package}"
  done
  # shellcheck disable=SC2086
  if ! apt_install $missing $newest; then
    if [ -n "$missing" ] && ! apt_install $missing; then
      kill "$saying" 2> /dev/null
      tail -n 20 "$log" >&2
      rm -f "$log"
      fail "apt-get could not install:$missing"
    fi
    for package in $wanted; do
      apt_install "$(newest_of "$package")" || failed="$failed $package"
    done
  fi
  kill "$saying" 2> /dev/null
  wait "$saying" 2> /dev/null || true
  rm -f "$log"
  [ -n "$failed" ] || return 0
  say "could not be installed, going on without:$failed"
  mkdir -p build
  # shellcheck disable=SC2086
  printf '%s\n' $failed >> "$asked"
}

apt_install() {
  $as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends "$@" >> "$log" 2>&1
}

# clang-newest is the newest clang that there is a package of, and so on; other names are themselves.
newest_of() {
  case $1 in
    *-newest) apt-cache search --names-only "^${1%newest}[0-9]+\$" | cut -d" " -f1 | sort -t - -k 2 -n | tail -n 1 ;;
    *) echo "$1" ;;
  esac
}

need_to_build() {
  need cc gcc "C compiler"
  need '/usr/include/stdio.h' libc6-dev "headers of the C library"
  need cmake cmake "build system"
  need ninja ninja-build "build system"
  need '/usr/include/csv.h' libcsv-dev "CSV reading in the programs"
  need '/usr/include/jansson.h' libjansson-dev "JSON reading in the programs"
  want '/usr/bin/clang-1[5-9] /usr/bin/clang-[2-9][0-9]' clang-newest "a second compiler for the seed paper's kernels, and its first choice"
}

# keep_saying WHAT LOG: says each minute, in the background, that WHAT goes on, with the last line of its log; to be killed, by $!.
keep_saying() {
  while sleep 60 > /dev/null 2>&1 && kill -0 $$ 2> /dev/null; do say "still $1: $(tail -n 1 "$2" | cut -c 1-90)"; done &
}

# note_stage WHAT SECONDS: keeps the seconds of a stage for the end of a run.
stage_seconds=''
note_stage() {
  stage_seconds="$stage_seconds${stage_seconds:+
}  $2 $1"
}

# stage WHAT COMMAND...: runs the command and prints one line about it, with its time; quiet but for a line a minute. What it said is in
# $log, for the caller to show and to remove. Returns the command's exit code.
stage() {
  what=$1
  shift
  log=$(mktemp)
  printf '%s ... ' "$what" >&2
  keep_saying "$what" "$log"
  saying=$! begun=$(date +%s) ended=0
  "$@" > "$log" 2>&1 || ended=$?
  kill "$saying" 2> /dev/null
  wait "$saying" 2> /dev/null || true
  printf '%s s' $(($(date +%s) - begun)) >&2
  note_stage "$what" $(($(date +%s) - begun))
  return $ended
}

# build PRESET [CMAKE-OPTIONS]: configures and builds all, or the $targets, a line for both.
targets=
build() {
  if stage "building ($1)" configure_and_build "$@"; then
    say
  else
    say ", failed"
    tail -n 60 "$log" >&2
    rm -f "$log"
    fail "the build ($1) failed"
  fi
  rm -f "$log"
}

configure_and_build() { cmake --preset "$@" && cmake --build --preset "$1" ${targets:+--target $targets}; }
