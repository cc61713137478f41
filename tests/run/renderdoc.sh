#!/usr/bin/env bash
# A capture with RenderDoc: its frame, replayed by RenderDoc itself, makes the same picture again; in it every pass of
# the table is a marked region, and every object has a name.
set -u
bin=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
/usr/bin/python3 -c 'import renderdoc' 2>/dev/null ||
  { echo "FAILED: RenderDoc's Python module is missing (see tools/test_packages.txt)"; exit 1; }
"$bin/afterglow" capture cornell -o "$work/seen" --size 96x64 --frames 1 --warm-up 2 --exr --renderdoc >/dev/null \
  2>"$work/err" || { echo "FAILED: capture: $(cat "$work/err")"; exit 1; }
[[ -s $work/seen/frame.rdc ]] || { echo "FAILED: no frame.rdc"; exit 1; }
/usr/bin/python3 "$(dirname "$0")/replay_rdc.py" "$work/seen" "$work/replay.pfm" || exit 1
"$bin/afterglow" compare "$work/seen/composite.display.exr" "$work/replay.pfm" --max-rel-rmse 1e-6 ||
  { echo "FAILED: the replayed picture differs"; exit 1; }
