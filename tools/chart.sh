#!/usr/bin/env bash
# Measures every technique on the built-in scenes, ours and those nearest to it on light through openings and on
# architecture (of the scene library, where that is there), and writes the charts and the tables of the documentation. Takes
# some three quarters of an hour on two cores once the references are there, which are kept from run to run, as rows are while
# the program is the same. What is given goes to every bench: `--size 640x360` takes four times as long.
targets=(afterglow)
source "$(dirname "${BASH_SOURCE[0]}")/setup.sh"
library=${AFTERGLOW_SCENES:-../shared/scenes}
# join_there NAME...: those of the library's views whose scene is there, each after a comma.
join_there() {
  local view
  for view in "$@"; do
    [[ -e $library/${view%%[:+]*} ]] && printf ',%s' "$view"
  done
  return 0
}
[[ " $* " == *" --size"* ]] || set -- --size 320x180 "$@"
bench=("$build/bin/afterglow" bench)
"${bench[@]}" --scenes cornell,occluder,corridor --plot docs/images/error_time.svg --markdown out/bench_table.md \
  --json out/bench.json --csv out/bench.csv "$@"
"${bench[@]}" --scenes "window,shell,ledges,nave$(join_there sponza sponza:1 sibenik living_room zdm2)" \
  --techniques none,stochastic,ism,rsmc,acrsm,afterglow,low,high --plain --no-flicker --plot docs/images/openings_error_time.svg \
  --markdown out/openings_table.md --json out/openings.json --csv out/openings.csv "$@"
"${bench[@]}" --scenes "lamps:80,lamps:1024$(join_there sponza+80)" --techniques lights-reference,lightcluster,afterglow-lights \
  --no-flicker --no-path-tracing --plot docs/images/lamps_error_time.svg --markdown out/lamps_table.md "$@"
{
  printf '# Time against error\n\nWritten by `tools/chart.sh`. How it is measured: docs/techniques/measuring.md.\n\n'
  printf '![Chart of time against error](images/error_time.svg)\n\n'
  cat out/bench_table.md
  printf '\n# Light through openings, and architecture\n\n![Chart of time against error](images/openings_error_time.svg)\n\n'
  cat out/openings_table.md
  printf '\n# Many lamps\n\n![Chart of time against error](images/lamps_error_time.svg)\n\n'
  cat out/lamps_table.md
} >docs/bench.md
printf 'docs/bench.md and its charts in docs/images are written\n'
