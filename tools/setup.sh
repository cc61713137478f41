# Sourced by play.sh and test.sh: installs what is missing of the package lists it is given (`package_lists`), configures
# and builds (`targets`; all without). Quick when nothing changed.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
build=${AFTERGLOW_BUILD:-build}

stop() {
  printf 'afterglow: %s\n' "$*" >&2
  exit 2
}

install_missing() {
  command -v dpkg-query >/dev/null || stop "this script installs Debian packages; elsewhere, install what $* list and run cmake"
  local missing=()
  while read -r package; do
    [[ -z $package || $package == \#* ]] && continue
    dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q 'ok installed' || missing+=("$package")
  done < <(cat "$@")
  ((${#missing[@]} == 0)) && return
  local root=()
  if ((EUID != 0)); then
    command -v sudo >/dev/null || stop "these packages are missing and sudo is not there to install them: ${missing[*]}"
    root=(sudo)
  fi
  printf 'afterglow: installing %s\n' "${missing[*]}"
  "${root[@]}" apt-get update -q || stop "apt-get update failed"
  DEBIAN_FRONTEND=noninteractive "${root[@]}" apt-get install -y -q --no-install-recommends "${missing[@]}" ||
    stop "these packages could not be installed: ${missing[*]}"
}

# The share that is built and about how long the rest takes: on a terminal one line that goes on, elsewhere a line now
# and then. What the compiler says comes after it.
show_progress() {
  local every=15 begin="" end="\n"
  [[ -t 1 ]] && every=1 begin="\r" end="   "
  awk -v every=$every -v begin="$begin" -v end="$end" '
    /^@ / {
      split($0, word, " ")
      done = word[2] + 0; seconds = word[3] + 0
      if (seconds - shown >= every && done > 0) {
        printf begin "afterglow: building, %d %%, about %d s left" end, done, seconds * (100 - done) / done
        fflush(); shown = seconds
      }
      next
    }
    /^ninja: no work/ { next }
    { said = said $0 "\n" }
    END { if (shown && begin != "") printf "\n"; printf "%s", said }'
}

configure_and_build() {
  if [[ ! -f $build/build.ninja ]]; then
    mkdir -p "$build"
    # A unity build takes half the time. For development, configure a build without it.
    cmake -G Ninja -S . -B "$build" -DCMAKE_BUILD_TYPE=Release -DCMAKE_UNITY_BUILD=ON >"$build/configure.log" 2>&1 ||
      { cat "$build/configure.log" >&2; stop "cmake could not configure $build"; }
  fi
  NINJA_STATUS='@ %p %e ' cmake --build "$build" ${targets:+--target "${targets[@]}"} | show_progress ||
    stop "the build failed; its first error is above"
}

install_missing "${package_lists[@]:-tools/packages.txt}"
configure_and_build
