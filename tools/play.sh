#!/usr/bin/env bash
# Installs what is missing, builds, starts the game in a window; without a display it plays the recorded walkthrough
# headless and leaves twenty moments of it, its last picture and a frame report in out/.
targets=(afterglow-demo)
source "$(dirname "${BASH_SOURCE[0]}")/setup.sh"
if [[ -n ${DISPLAY:-} ]]; then
  exec "$build/bin/afterglow-demo" "$@"
fi
mkdir -p out
"$build/bin/afterglow-demo" --headless --size 320x180 --ticks-per-frame 6 --screenshot out/gallery.png \
  --moments out/moments.png --report out/frame_report.txt "$@"
echo "afterglow: no display; twenty moments in out/moments.png, the last picture in out/gallery.png, frame report in out/frame_report.txt"
