#!/usr/bin/env bash
# Measures every technique on the built-in scenes (and on sponza where the scene library is there) and writes
# the chart and the table of the documentation. Takes some minutes; references are kept from run to run.
source "$(dirname "${BASH_SOURCE[0]}")/setup.sh"
scenes=cornell,occluder,corridor
[[ -e ${AFTERGLOW_SCENES:-../shared/scenes}/sponza ]] && scenes+=,sponza
"$build/bin/afterglow" bench --scenes "$scenes" --plot docs/images/error_time.svg --markdown out/bench_table.md \
  --json out/bench.json --csv out/bench.csv "$@"
{
  printf '# Time against error\n\nWritten by `tools/chart.sh`. How it is measured: docs/techniques.md.\n\n'
  printf '![Chart of time against error](images/error_time.svg)\n\n'
  cat out/bench_table.md
} >docs/bench.md
printf 'docs/bench.md and docs/images/error_time.svg are written\n'
