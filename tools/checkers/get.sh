# shellcheck shell=sh
# Sourced by tools/format and tools/lint: gets the formatters and linters of fixed versions into
# build/checks, where they are not there yet. Expects the repository root as working folder.

ruff_version=0.14.6
lizard_version=1.24.3
pygments_version=2.19.2
checks=$PWD/build/checks

# get_from_pypi: ruff, lizard and Pygments in a virtual environment. Fails where no Python or no pip is here.
get_from_pypi() {
  wanted="ruff $ruff_version, lizard $lizard_version, pygments $pygments_version"
  [ "$(cat "$checks/python/versions" 2> /dev/null)" != "$wanted" ] || return 0
  for base in python3 /usr/bin/python3; do
    if "$base" -m venv --clear "$checks/python" > /dev/null 2>&1 &&
      "$checks/python/bin/python3" -m pip install --quiet --disable-pip-version-check \
        "ruff==$ruff_version" "lizard==$lizard_version" "pygments==$pygments_version" >&2; then
      echo "$wanted" > "$checks/python/versions"
      return 0
    fi
  done
  return 1
}

# get_from_npm: prettier and eslint, by the versions of package-lock.json in this folder.
get_from_npm() {
  command -v npm > /dev/null 2>&1 || return 1
  mkdir -p "$checks/npm"
  # installed.json is the lock file of what has been installed to its end.
  cmp -s tools/checkers/package-lock.json "$checks/npm/installed.json" && return 0
  cp tools/checkers/package.json tools/checkers/package-lock.json tools/checkers/.npmrc "$checks/npm/"
  (cd "$checks/npm" && npm ci --no-audit --no-fund) > "$checks/npm/log" 2>&1 || return 1
  cp tools/checkers/package-lock.json "$checks/npm/installed.json"
}

# tracked PATTERN...: the files of git that match and are still there, one a line.
tracked() {
  git ls-files --cached --others --exclude-standard -- "$@" | sort -u |
    while read -r file; do [ ! -f "$file" ] || echo "$file"; done
}

# shell_scripts: files of the shell, by their name or by their first line.
shell_scripts() {
  {
    tracked '*.sh'
    tracked '*' | grep -v '\.[a-z]*$' | while read -r file; do
      if head -n 1 "$file" | grep -qE '^#!(/bin/sh|/usr/bin/env bash)$'; then echo "$file"; fi
    done
    echo .ci/run
  } | sort -u
}

# python_sources: files of Python, by their name or by their first line, except those that bindings/
# writes.
python_sources() {
  {
    tracked '*.py' | grep -v '/_described\.py$'
    tracked 'tools/*' | grep -v '\.[a-z]*$' | while read -r file; do
      if head -n 1 "$file" | grep -q '^#!/usr/bin/env python3$'; then echo "$file"; fi
    done
  } | sort -u
}
