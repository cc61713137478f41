# Sourced by play.sh and test.sh: installs what is missing of the package lists it is given, configures and builds.
# Quick when nothing changed.
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

configure_and_build() {
  [[ -f $build/build.ninja ]] || cmake -G Ninja -S . -B "$build" -DCMAKE_BUILD_TYPE=Release || stop "cmake could not configure $build"
  cmake --build "$build" || stop "the build failed; its first error is above"
}

install_missing "${package_lists[@]:-tools/packages.txt}"
configure_and_build
