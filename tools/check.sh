#!/usr/bin/env bash
# What a change should pass before it is sent: format, warnings, every test under the address and undefined-behaviour
# sanitizers, the job system and the game under the thread sanitizer. --tidy adds clang-tidy (slow).
set -euo pipefail
cd "$(dirname "$0")/.."
command -v clang-format >/dev/null || { echo "afterglow: clang-format is missing (Debian package clang-format)" >&2; exit 2; }
git ls-files -co --exclude-standard | grep -E '\.(h|cpp)$' | xargs clang-format --dry-run -Werror

cmake -G Ninja -S . -B build-asan -DCMAKE_BUILD_TYPE=RelWithDebInfo -DAFTERGLOW_ASAN=ON
cmake --build build-asan
ctest --test-dir build-asan --output-on-failure -j "$(nproc)"

cmake -G Ninja -S . -B build-tsan -DCMAKE_BUILD_TYPE=RelWithDebInfo -DAFTERGLOW_TSAN=ON
cmake --build build-tsan --target test_ecs test_game
build-tsan/bin/test_ecs
build-tsan/bin/test_game

if [[ ${1:-} == --tidy ]]; then
  git ls-files '*.cpp' | grep -v '^tests/' | xargs -P "$(nproc)" -n 4 clang-tidy -quiet -p build-asan
fi
echo "afterglow: all checks passed"
