#!/usr/bin/env bash
# A long run of the game without a window: FRAMES frames (10000 without) of ten ticks, with validation. Memory must stay
# flat after the first quarter, no message may come; the rate and its p99 are printed.
set -euo pipefail
cd "$(dirname "$0")/.."
report=$("${AFTERGLOW_BUILD:-build}/bin/afterglow-demo" --headless --validate --size 160x90 --quality low \
  --frames "${1:-10000}" --ticks-per-frame 10 2>/dev/null) || { echo "afterglow: the soak run failed: $report" >&2; exit 1; }
grep -E "^device|frames of|world hash" <<<"$report"
awk -v most=16 '/ a quarter in / { seen = 1; if ($12 - $6 > most) { print "afterglow: memory grew by " $12 - $6 " MiB"; exit 1 } }
  END { exit !seen }' <<<"$report"
