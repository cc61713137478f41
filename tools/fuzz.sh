#!/usr/bin/env bash
# Looks for input that breaks a reader: all targets of tests/fuzz share the seconds given (600 without); a second number is
# the seed, so that a run can be had again. What is found lies in build-fuzz/found; a file of it put into tests/fuzz/corpus
# is tested from then on.
set -euo pipefail
cd "$(dirname "$0")/.."
command -v clang++ >/dev/null || { echo "afterglow: fuzzing needs clang++ (Debian package clang)" >&2; exit 77; }
targets=(gltf image replay save settings)
share=$((${1:-600} / ${#targets[@]}))

mkdir -p build-fuzz/found
cmake -G Ninja -S . -B build-fuzz -DCMAKE_BUILD_TYPE=RelWithDebInfo -DCMAKE_C_COMPILER=clang \
  -DCMAKE_CXX_COMPILER=clang++ -DAFTERGLOW_FUZZ=ON >build-fuzz/configure.log || { cat build-fuzz/configure.log >&2; exit 2; }
cmake --build build-fuzz --target fuzz
broken=0
for target in "${targets[@]}"; do
  mkdir -p "build-fuzz/corpus/$target"
  echo "fuzz $target, $share s"
  build-fuzz/bin/"fuzz_$target" -max_total_time="$share" ${2:+-seed="$2"} -rss_limit_mb=4096 -timeout=20 -max_len=65536 -verbosity=0 \
    -print_final_stats=1 -artifact_prefix="build-fuzz/found/$target-" \
    "build-fuzz/corpus/$target" "tests/fuzz/corpus/$target" || broken=1
done
exit $broken
