#!/usr/bin/env bash
# Looks for input that breaks a reader: all targets of tests/fuzz share the seconds given (600 without); a second number is
# the seed, so that a run can be had again. Executions and coverage are printed a target. What is found lies in
# build-fuzz/found; a file of it put into tests/fuzz/corpus is tested from then on.
set -euo pipefail
cd "$(dirname "$0")/.."
# Debian's default, clang 14, cannot compile the ECS with libstdc++ 12.
command -v clang++-16 >/dev/null || { echo "afterglow: fuzzing needs clang++-16 (Debian packages clang-16 and libclang-rt-16-dev)" >&2; exit 2; }
targets=(gltf image replay row save settings table user world)
share=$((${1:-600} / ${#targets[@]}))
((share > 0)) || share=1  # none would be for ever

mkdir -p build-fuzz/found
fresh=()
[[ -f build-fuzz/CMakeCache.txt ]] && ! grep -q clang++-16 build-fuzz/CMakeCache.txt && fresh=(--fresh)  # of another compiler
cmake "${fresh[@]}" -G Ninja -S . -B build-fuzz -DCMAKE_BUILD_TYPE=RelWithDebInfo -DCMAKE_C_COMPILER=clang-16 \
  -DCMAKE_CXX_COMPILER=clang++-16 -DCMAKE_CXX_FLAGS_RELWITHDEBINFO="-O1 -gline-tables-only" -DAFTERGLOW_FUZZ=ON >build-fuzz/configure.log || { cat build-fuzz/configure.log >&2; exit 2; }
cmake --build build-fuzz --target fuzz
broken=0
for target in "${targets[@]}"; do
  mkdir -p "build-fuzz/corpus/$target"
  log=build-fuzz/$target.log
  if build-fuzz/bin/"fuzz_$target" -max_total_time="$share" ${2:+-seed="$2"} -rss_limit_mb=4096 -timeout=20 -max_len=65536 \
    -print_final_stats=1 -artifact_prefix="build-fuzz/found/$target-" \
    "build-fuzz/corpus/$target" "tests/fuzz/corpus/$target" 2>"$log"; then
    awk -v target="$target" '/DONE/ { for (i = 1; i < NF; ++i) if ($i == "cov:") covered = $(i + 1) }
      /number_of_executed_units/ { runs = $2 } END { print "fuzz " target ": " runs " executions, " covered " branches reached" }' "$log"
  else
    cat "$log" >&2
    broken=1
  fi
done
exit $broken
