#!/usr/bin/env bash
# The demo in a real window on a virtual display: injected keys walk, panels open, Escape leaves; validation is silent.
set -u
bin=$1
work=$(mktemp -d)
for tool in Xvfb xdotool; do
  command -v $tool >/dev/null || { echo "FAILED: $tool is missing (see tools/packages.txt)"; exit 1; }
done
mkfifo "$work/display"
Xvfb -displayfd 3 -screen 0 1024x768x24 3>"$work/display" >/dev/null 2>&1 &
xvfb=$!
read -r number <"$work/display"
export DISPLAY=:$number
finish() {
  kill "$xvfb" 2>/dev/null
  rm -rf "$work"
}
trap finish EXIT

"$bin/afterglow-demo" --size 320x180 --validate --record "$work/run.replay" >"$work/log" 2>&1 &
demo=$!
for _ in $(seq 100); do
  window=$(xdotool search --name Afterglow 2>/dev/null | head -1)
  [[ -n $window ]] && break
  sleep 0.2
done
[[ -n ${window:-} ]] || { echo "FAILED: no window: $(cat "$work/log")"; exit 1; }
xdotool mousemove --window "$window" 160 90
sleep 2
xdotool keydown w
sleep 2
xdotool keyup w
for _ in 1 2 3 4 5; do
  xdotool mousemove_relative 20 4
  sleep 0.2
done
for key in F1 F2 F3 8 9 1 F1 F2 F3; do
  xdotool key $key
  sleep 0.3
done
xdotool windowsize "$window" 400 240
sleep 1
xdotool key Escape
sleep 0.5
xdotool key Escape
for _ in $(seq 50); do
  kill -0 "$demo" 2>/dev/null || break
  sleep 0.2
done
if kill -0 "$demo" 2>/dev/null; then
  kill "$demo"
  echo "FAILED: Escape did not end the demo"
  exit 1
fi
wait "$demo"
code=$?
[[ $code == 0 ]] || { echo "FAILED: the demo exited with $code: $(tail -5 "$work/log")"; exit 1; }
walked=$(awk 'NR > 1 && $1 > 0' "$work/run.replay" | wc -l)
looked=$(awk 'NR > 1 && $3 != 0' "$work/run.replay" | wc -l)
echo "ticks walked: $walked, ticks looked: $looked"
# Played again without a window, the recording ends where the walk did: not where it began.
start=$("$bin/afterglow-demo" --headless --frames 1 --size 32x18 2>/dev/null | grep 'player at')
end=$("$bin/afterglow-demo" --headless --replay "$work/run.replay" --size 32x18 2>/dev/null | grep 'player at')
echo "start: $start, end: $end"
[[ -n $end && $start != "$end" ]] || { echo "FAILED: the camera did not move"; exit 1; }
((walked > 20 && looked > 0)) || { echo "FAILED: the keys or the mouse did not reach the game"; exit 1; }
