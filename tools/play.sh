#!/usr/bin/env bash
# Installs what is missing, builds, starts the demo level in a window; without a display it plays the level headless
# and leaves a picture and a frame report in out/.
source "$(dirname "${BASH_SOURCE[0]}")/setup.sh"
if [[ -n ${DISPLAY:-} ]]; then
  exec "$build/bin/afterglow-demo" "$@"
fi
mkdir -p out
"$build/bin/afterglow-demo" --headless --frames 120 --screenshot out/gallery.png --report out/frame_report.txt "$@"
echo "afterglow: no display; picture in out/gallery.png, frame report in out/frame_report.txt"
