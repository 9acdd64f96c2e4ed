# SPDX-License-Identifier: GPL-3.0-or-later
# Sourced by the scripts beside it.

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

# Runs a command and shows its output only if it fails.
quietly() {
  local log status=0
  log=$(mktemp)
  "$@" >"$log" 2>&1 || status=$?
  if [[ $status != 0 ]]; then cat "$log" >&2; fi
  rm -f "$log"
  return "$status"
}

# As many compilers at once as there are cores, and no more than one for each 2 GB of free memory.
jobs_at_once() {
  local cores memory
  cores=$(nproc 2>/dev/null || echo 1)
  memory=$(awk '/^MemAvailable/ { print int($2 / 2000000) }' /proc/meminfo 2>/dev/null || true)
  if [[ -n $memory && $memory -lt $cores ]]; then cores=$((memory < 1 ? 1 : memory)); fi
  echo "$cores"
}

# Configures a preset, with Ninja where it is installed. A build folder keeps the generator it began with.
configure() {
  if [[ -z ${CMAKE_GENERATOR:-} ]] && command -v ninja >/dev/null; then export CMAKE_GENERATOR=Ninja; fi
  (cd "$root" && cmake --preset "$@")
}

# build PRESET [TARGET]
build() {
  (cd "$root" && cmake --build --preset "$1" --parallel "$(jobs_at_once)" ${2:+--target "$2"})
}

# Prints the comment at the head of the script, and ends it, if one of its arguments asks for help.
answer_help() {
  local argument
  for argument in "$@"; do
    if [[ $argument == -h || $argument == --help ]]; then
      sed -n -e '/^#!/d' -e '/^# SPDX/d' -e '/^#/!q' -e 's/^# \{0,1\}//p' "$0"
      exit 0
    fi
  done
}
