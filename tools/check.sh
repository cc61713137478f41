#!/usr/bin/env bash
# What a change should pass before it is sent: format, warnings, every test under the address and undefined-behaviour
# sanitizers; the job system, the game, sound, culling, capture, and the threads of the viewer and the reference under the
# thread sanitizer.
# --tidy adds clang-tidy (slow); --all adds that, the whole stress table, 100,000 ticks of the game, ten minutes of fuzzing
# and the long device suite (hours); --devices is that suite alone (tools/devices.sh).
set -euo pipefail
cd "$(dirname "$0")/.."
if [[ ${1:-} == --devices ]]; then
  cmake -G Ninja -S . -B build -DCMAKE_BUILD_TYPE=Release
  cmake --build build
  exec tools/devices.sh
fi
command -v clang-format >/dev/null || { echo "afterglow: clang-format is missing (Debian package clang-format)" >&2; exit 2; }
git ls-files -co --exclude-standard | grep -E '\.(h|cpp)$' | xargs clang-format --dry-run -Werror

cmake -G Ninja -S . -B build-asan -DCMAKE_BUILD_TYPE=RelWithDebInfo -DAFTERGLOW_ASAN=ON
cmake --build build-asan
export ASAN_OPTIONS=quarantine_size_mb=16  # what is freed shall not look like growth to the long runs
ctest --test-dir build-asan --output-on-failure -j "$(nproc)"

cmake -G Ninja -S . -B build-tsan -DCMAKE_BUILD_TYPE=RelWithDebInfo -DAFTERGLOW_TSAN=ON
threaded=(test_ecs test_game test_sound test_viewer test_reference test_gi test_capture)
cmake --build build-tsan --target "${threaded[@]}"
export TSAN_OPTIONS=ignore_noninstrumented_modules=1  # Embree's own threads are not seen to wait for one another
for program in "${threaded[@]}"; do
  build-tsan/bin/"$program"
done
unset TSAN_OPTIONS

if [[ ${1:-} == --tidy || ${1:-} == --all ]]; then
  git ls-files '*.cpp' | grep -v '^tests/' | xargs -P "$(nproc)" -n 4 clang-tidy -quiet -p build-asan
fi
if [[ ${1:-} == --all ]]; then
  [[ -f build/build.ninja ]] || cmake -G Ninja -S . -B build -DCMAKE_BUILD_TYPE=Release
  cmake --build build
  export VK_LAYER_ENABLES=VALIDATION_CHECK_ENABLE_SYNCHRONIZATION_VALIDATION_QUEUE_SUBMIT
  build/bin/afterglow stress --validate
  tools/soak.sh
  tools/fuzz.sh 600
  tools/devices.sh
fi
echo "afterglow: all checks passed"
