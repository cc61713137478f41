#!/usr/bin/env bash
# The demo in a real window on a virtual display: the menu, walking, picking up a crate, panels, a photo, a capture, another size, hidden and
# shown again, left for another window, quit from the menu; validation is silent, and the recording played again without
# a window ends where the player did.
source "$(dirname "${BASH_SOURCE[0]}")/display.sh"

start_demo() {
  "$bin/afterglow-demo" --size 320x180 --quality low --validate --user "$work/user" "$@" >"$work/log" 2>&1 &
  demo=$!
  await_window || { echo "FAILED: no window: $(cat "$work/log")"; exit 1; }
  xdotool mousemove --window "$window" 300 170  # keys go to the window under the pointer; off the menu's lines
  sleep 0.3
}

turn() {  # COUNT DX DY
  for _ in $(seq "$1"); do
    xdotool mousemove_relative -- "$2" "$3"
    sleep 0.1
  done
}

keys() {
  for key in "$@"; do
    xdotool key "$key"
    sleep 0.25
  done
}

await_end() {  # WHAT [CODE]
  for _ in $(seq 300); do
    kill -0 "$demo" 2>/dev/null || break
    sleep 0.2
  done
  if kill -0 "$demo" 2>/dev/null; then
    kill "$demo"
    echo "FAILED: $1 did not end the demo"
    exit 1
  fi
  wait "$demo"
  local code=$?
  [[ $code == "${2:-0}" ]] || { echo "FAILED: the demo exited with $code: $(tail -5 "$work/log")"; exit 1; }
}

start_demo --record "$work/run.replay" --capture-frames 2
sleep 2  # what follows is played in real time: shaders are compiled in the first frames
keys Return  # New game
turn 5 -52 0
turn 5 0 50
xdotool keydown w
sleep 0.4
xdotool keyup w
keys e  # picks the crate up
sleep 0.5
xdotool keydown s
sleep 1
xdotool keyup s
keys F9 F10  # the profiler; frames of this very view
keys F1 F2 F3 F4 8 9 1 F1 F2 F3 F4 F9
keys F8 Up Left Return H Escape  # the photo mode, a photo of it, and back
xdotool windowsize "$window" 400 240
sleep 1
xdotool windowunmap "$window"  # minimised
sleep 1
xdotool windowmap "$window"
sleep 1
xdotool mousemove --window "$window" 380 230
keys Escape     # the menu, wherever the focus went before
keys Escape     # and back, or the menu now
sleep 0.5
kill -0 "$demo" 2>/dev/null || { echo "FAILED: the demo ended early: $(tail -5 "$work/log")"; exit 1; }
xdotool keydown d
sleep 1
xdotool keyup d
xdotool windowsize "$window" 320 180
sleep 0.5
xdotool mousemove --window "$window" 300 170
# To the menu's main page whatever is open, then up from the first line to the last: Quit.
keys Escape
[[ -s $work/user/save.txt ]] || { echo "FAILED: the menu saved nothing"; exit 1; }
keys Up Return
if kill -0 "$demo" 2>/dev/null; then keys Escape Up Return; fi
await_end "Quit"
# A machine without a sound device is told of in one sentence, not by the sound systems' own lines.
noise=$(grep -ciE 'sound|alsa|pulse|openal' "$work/log")
((noise <= 1)) || { echo "FAILED: $noise lines about sound: $(cat "$work/log")"; exit 1; }
for file in report.html passes.csv trace.json schedule.svg composite.display.png; do
  [[ -s $(echo "$work"/user/captures/*/"$file") ]] || { echo "FAILED: F10 left no $file: $(tail -5 "$work/log")"; exit 1; }
done
for file in photo-001.png photo-001.exr; do
  [[ -s $work/user/photos/$file ]] || { echo "FAILED: the photo mode left no $file: $(tail -5 "$work/log")"; exit 1; }
done
grep -q '"walkPlayer"' "$work"/user/captures/*/trace.json || { echo "FAILED: the captured ticks have no systems"; exit 1; }

walked=$(awk 'NR > 1 && $2 > 0 { n += $1 } END { print n + 0 }' "$work/run.replay")
looked=$(awk 'NR > 1 && $4 != 0' "$work/run.replay" | wc -l)
echo "ticks walked: $walked, ticks looked: $looked"
# Played again without a window, the recording ends where the walk did: not where it began, with the crate.
start=$("$bin/afterglow-demo" --headless --frames 1 --size 32x18 2>/dev/null | grep 'player at')
end=$("$bin/afterglow-demo" --headless --replay "$work/run.replay" --ticks-per-frame 30 --size 32x18 2>/dev/null | grep 'player at')
echo "start: $start, end: $end"
[[ -n $end && $start != "$end" ]] || { echo "FAILED: the player did not move"; exit 1; }
((walked > 5 && looked > 0)) || { echo "FAILED: the keys or the mouse did not reach the game"; exit 1; }
[[ $end == *crate* ]] || { echo "FAILED: no crate was picked up"; exit 1; }

# Going on with the saved game: it starts where that one ended.
start_demo --continue --frames 12 --screenshot "$work/on.png" --set sound.volume=0
await_end "--frames"
grep -qi sound "$work/log" && { echo "FAILED: a volume of 0 looked for a sound device"; exit 1; }
[[ -s $work/on.png ]] || { echo "FAILED: going on left no picture"; exit 1; }
# Where one goes on with a saved game a recording ends, and is kept.
start_demo --record "$work/ended.replay"
keys Down Return  # a new game
sleep 2           # that is seen
keys Escape Down Down Return Escape Up Return  # the saved one; Quit
await_end "Quit"
[[ -s $work/ended.replay && $(tail -n 1 "$work/ended.replay") != "end 0" ]] ||
  { echo "FAILED: going on with the saved game lost the recording: $(cat "$work/log")"; exit 1; }
cp "$work/user/save.txt" "$work/kept.txt"
head -c 100 "$work/kept.txt" >"$work/user/save.txt"
"$bin/afterglow-demo" --headless --continue --frames 1 --size 32x18 --user "$work/user" >/dev/null 2>"$work/err"
[[ $? == 2 && $(grep -c . "$work/err") == 1 ]] || { echo "FAILED: a cut save was not refused with a sentence"; exit 1; }
[[ $(stat -c %s "$work/user/save.txt") == 100 ]] || { echo "FAILED: the broken save was not kept"; exit 1; }

# A swapchain that no longer fits and a lost surface are made anew; a lost device ends the game with all that was won.
rm -f "$work/user/save.txt"
for fault in out_of_date:3 surface_lost:3; do
  start_demo --frames 12 --screenshot "$work/$fault.png" --fault "$fault"
  await_end "$fault"
  [[ -s $work/$fault.png ]] || { echo "FAILED: $fault left no picture"; exit 1; }
done
cp "$work/kept.txt" "$work/user/save.txt"
start_demo --fault submit:150
xdotool key Down Return  # past Continue, New game
await_end "a lost device" 3
grep -q "the graphics device was lost" "$work/log" || { echo "FAILED: a lost device said nothing: $(cat "$work/log")"; exit 1; }
[[ $(tail -n 1 "$work/user/save.txt") == end ]] || { echo "FAILED: a lost device lost the game"; exit 1; }
cmp -s "$work/kept.txt" "$work/user/save.txt.before" || { echo "FAILED: a new game lost the one before it"; exit 1; }
exit 0
