#!/usr/bin/env bash
# Measures every technique on the built-in scenes (and on sponza where the scene library is there) and writes
# the charts and the tables of the documentation. Takes some minutes; references are kept from run to run.
targets=(afterglow)
source "$(dirname "${BASH_SOURCE[0]}")/setup.sh"
scenes=cornell,occluder,corridor
[[ -e ${AFTERGLOW_SCENES:-../shared/scenes}/sponza ]] && scenes+=,sponza
"$build/bin/afterglow" bench --scenes "$scenes" --plot docs/images/error_time.svg --markdown out/bench_table.md \
  --json out/bench.json --csv out/bench.csv "$@"
lamps=lamps:80,lamps:1024
[[ -e ${AFTERGLOW_SCENES:-../shared/scenes}/sponza ]] && lamps+=,sponza+80
"$build/bin/afterglow" bench --scenes "$lamps" --techniques lights-reference,lightcluster,afterglow-lights \
  --no-flicker --no-path-tracing --plot docs/images/lamps_error_time.svg --markdown out/lamps_table.md "$@"
{
  printf '# Time against error\n\nWritten by `tools/chart.sh`. How it is measured: docs/techniques/measuring.md.\n\n'
  printf '![Chart of time against error](images/error_time.svg)\n\n'
  cat out/bench_table.md
  printf '\n# Many lamps\n\n![Chart of time against error](images/lamps_error_time.svg)\n\n'
  cat out/lamps_table.md
} >docs/bench.md
printf 'docs/bench.md and its charts in docs/images are written\n'
