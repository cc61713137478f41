#!/usr/bin/env bash
# Exit codes, sentences and files of the command-line programs.
source "$(dirname "${BASH_SOURCE[0]}")/expect.sh"

expect 0 "Vulkan" "$bin/afterglow" info
expect 0 "val_clustering.count" "$bin/afterglow" render --list-settings
expect 2 "there is no sub-command 'rendr'; did you mean 'render'?" "$bin/afterglow" rendr cornell
expect 2 "did you mean 'cornell'" "$bin/afterglow" render cornel -o "$work/a.png"
expect 2 "did you mean 'afterglow'" "$bin/afterglow" render cornell -o "$work/a.png" --preset afterglw
expect 2 "did you mean 'albedo'" "$bin/afterglow" render cornell -o "$work/a.png" --layer albeddo
expect 2 "there is no setting 'composite.exposre'; did you mean 'composite.exposure'" "$bin/afterglow" render cornell \
  -o "$work/a.png" --set engine.skip=off composite.exposre=1
completed() {  # WORDS: what bash offers for the last of them
  bash -c 'source <("$0" completion); COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _afterglow; echo "${COMPREPLY[*]}"' \
    "$bin/afterglow" "$@"
}
[[ $(completed afterglow ren) == render ]] || fail "completion of ren gives: $(completed afterglow ren)"
[[ $(completed afterglow render --preset hi) == high ]] || fail "completion of --preset hi gives: $(completed afterglow render --preset hi)"
[[ $(completed afterglow render corn) == "cornell corner" ]] || fail "completion of corn gives: $(completed afterglow render corn)"
[[ $(completed afterglow render --list) == --list-settings ]] || fail "completion of --list gives: $(completed afterglow render --list)"
expect 2 "there is no layer 'colour'" "$bin/afterglow" render cornell -o "$work/a.png" --layer colour
expect 2 "must end in .exr" "$bin/afterglow" render cornell -o "$work/a.jpg"
expect 2 "does not exist" "$bin/afterglow" render /no/such.glb -o "$work/a.png"
expect 2 "16..1024" "$bin/afterglow" render cornell -o "$work/a.png" --set val_clustering.count=3
expect 2 "a size is WxH" "$bin/afterglow" render cornell -o "$work/a.png" --size 10
expect 2 "--sun takes" "$bin/afterglow" render cornell -o "$work/a.png" --sun 1,2
expect 2 "there is no term 'shadow' (there are: all, direct, emissive" "$bin/afterglow" bench --term shadow
expect 2 "--sky takes a colour" "$bin/afterglow" render cornell -o "$work/a.png" --sky 1,2
expect 2 "turbidity 2 to 10" "$bin/afterglow" render cornell -o "$work/a.png" --sky 0,-1,0,99
expect 2 "--sky takes COLOUR" "$bin/afterglow" render cornell -o "$work/a.png" --sky nan
expect 2 "the file does not exist" "$bin/afterglow" render cornell -o "$work/a.png" --sky "$work/none.hdr"
printf 'PF\n2 2\n-1.0\n%048d' 0 >"$work/square.pfm"
expect 2 "is not twice as wide as high" "$bin/afterglow" render cornell -o "$work/a.png" --sky "$work/square.pfm"
printf '#?RADIANCE\n' >"$work/broken.hdr"
expect 2 "is not a readable HDR image" "$bin/afterglow" render cornell -o "$work/a.png" --sky "$work/broken.hdr"
rm "$work/square.pfm" "$work/broken.hdr"
expect 2 "no camera 'nose'" "$bin/afterglow" render cornell -o "$work/a.png" --camera nose
expect 2 "negative intensity" "$bin/afterglow" render cornell -o "$work/a.png" --point 0,0,0,-3
expect 2 "--walk takes DX,DY,DZ" "$bin/afterglow" render cornell -o "$work/a.png" --times --walk 1,2
expect 2 "100000" "$bin/afterglow" render cornell -o "$work/a.png" --lamps 100001
expect 2 "there is no preset 'best' (there are: none, rsm-brute" "$bin/afterglow" render cornell -o "$work/a.png" --preset best
expect 2 "there is no built-in scene" "$bin/afterglow" scene nowhere -o "$work/a.glb"
expect 2 "not a replay" "$bin/afterglow-demo" --headless --replay "$0"
head -n 50 "$(dirname "$0")/../../game/level/walkthrough.replay" >"$work/cut.replay"
expect 2 "cut.replay: the replay ends before its last line" "$bin/afterglow-demo" --headless --replay "$work/cut.replay"
rm "$work/cut.replay"
# A recording says what it was made with; played, whether it leads where it led.
"$bin/afterglow-demo" --headless --frames 4 --size 32x18 --record "$work/own.replay" >/dev/null 2>&1
replay() { "$bin/afterglow-demo" --headless --size 32x18 --replay "$work/own.replay" "$@"; }
expect 0 "the world is the recording's" replay
sed -i 's/^note world .*/note world 0/' "$work/own.replay"
expect 0 "the world is not the recording's; it was made with frame 1 ticks, here 2 ticks" replay --ticks-per-frame 2
expect 0 "all that is noted of it the same" replay
sed -i 's/^note level .*/note level 0/' "$work/own.replay"
expect 2 "own.replay: it was recorded in another level" replay
rm "$work/own.replay"
expect 2 "a quality is low, medium, high, ultra or auto, not 'best'" "$bin/afterglow-demo" --headless --quality best
expect 2 "save.txt: the file does not exist" "$bin/afterglow-demo" --headless --continue --user "$work"
expect 2 "a recording starts with the level" "$bin/afterglow-demo" --headless --continue --record "$work/r.replay"
[[ -z $(ls "$work" | grep -v -E '^(out|err)$') ]] || fail "a refused command left a file behind"

# Devices that lack something, fail or are lost.
expect 2 "lacks timelineSemaphore" "$bin/afterglow" info --without timelineSemaphore
for feature in multiDrawIndirect drawIndirectFirstInstance scalarBlockLayout hostQueryReset dynamicRendering synchronization2 maintenance4 "subgroup shuffle, ballot and arithmetic"; do
  expect 2 "lacks $feature" "$bin/afterglow-demo" --headless --frames 1 --without "$feature"
done
expect 2 "there is no feature or limit 'rays'" "$bin/afterglow" info --without rays
expect 0 "timestamps         none" "$bin/afterglow" info --without timestamps
expect 0 "frames of 32x18" "$bin/afterglow-demo" --headless --frames 3 --size 32x18 --without timestamps --validate
expect 2 "not 'fire:1'" "$bin/afterglow-demo" --headless --frames 1 --fault fire:1
expect 3 "the graphics device was lost (in vkQueueSubmit2)" "$bin/afterglow-demo" --headless --frames 60 --size 32x18 --record "$work/lost.replay" --fault submit:40
[[ $(tail -n 1 "$work/lost.replay") == "end "* ]] || fail "the recording of a lost device's run was lost, too"
rm -f "$work/lost.replay"
n=1
while :; do  # every allocation of a run fails once, until there are no more
  "$bin/afterglow" render cornell -o "$work/a.png" --size 32x18 --frames 2 --fault allocation:$n >"$work/out" 2>"$work/err"
  got=$?
  [[ $got == 0 ]] && break
  [[ $got == 3 && $(grep -c "out of memory" "$work/err") == 1 ]] || { fail "allocation $n failing exited with $got: $(head -c 300 "$work/err")"; break; }
  n=$((n + 1 + n / 8))
done
((n > 20)) || fail "only $n allocations were tried"
rm -f "$work/a.png"

render() { "$bin/afterglow" render "$@" --size 160x90 --frames 12 --validate 2>"$work/err" || fail "render $*: $(cat "$work/err")"; }
render cornell -o "$work/a.png"
render cornell -o "$work/b.png"
cmp "$work/a.png" "$work/b.png" || fail "the same command twice gave two pictures"
expect 0 "frames of a walk" "$bin/afterglow" render cornell -o "$work/walk.png" --size 64x36 --frames 2 --times --walk 0.01,0,0
expect 0 "" "$bin/afterglow" render cornell -o "$work/round" --size 64x36 --frames 8 --turntable 4 --validate
[[ $(ls "$work/round" | tr '\n' ' ') == "000.png 001.png 002.png 003.png " ]] || fail "a turntable left $(ls "$work/round")"
cmp -s "$work/round/000.png" "$work/round/002.png" && fail "the turntable does not turn"
"$bin/afterglow" render cornell -o "$work/still.png" --size 64x36 --frames 8 2>/dev/null
cmp -s "$work/round/000.png" "$work/still.png" || fail "the turntable does not begin with the view"
rm -r "$work/round" "$work/still.png"
expect 2 "Not a directory" "$bin/afterglow" render cornell -o "$0" --size 64x36 --turntable 4
render cornell -o "$work/a.exr"
render cornell -o "$work/a.pfm"
expect 0 '"rel_rmse": 0.0' "$bin/afterglow" compare "$work/a.exr" "$work/a.pfm" --max-rel-rmse 1e-6
render cornell -o "$work/direct.pfm" --layer direct
expect 1 '"rel_rmse"' "$bin/afterglow" compare "$work/a.pfm" "$work/direct.pfm" --max-rel-rmse 0.01
expect 2 "does not exist" "$bin/afterglow" compare "$work/none.exr" "$work/a.pfm"
expect 0 '"flip"' "$bin/afterglow" compare "$work/a.pfm" "$work/direct.pfm" --heatmap "$work/heat.png"
[[ -s $work/heat.png ]] || fail "compare left no heatmap"
expect 0 '"tone_rmse"' "$bin/afterglow" compare "$work/a.exr" "$work/a.pfm" "$work/a.pfm" --max-rel-rmse 1e-6
for name in rel_rmse_trimmed median_rel leak_pixels noise_floor; do
  grep -q "\"$name\"" "$work/out" || fail "compare says nothing of $name"
done
"$bin/afterglow" render cornell -o "$work/small.pfm" --size 32x18 --frames 1 2>/dev/null
expect 1 "sizes differ: 160x90 and 32x18" "$bin/afterglow" compare "$work/a.pfm" "$work/small.pfm"
printf 'PF\n1 1\n-1.0\n\x00\x00\xc0\x7f\x00\x00\x00\x00\x00\x00\x00\x00' >"$work/nan.pfm"
expect 1 "not finite" "$bin/afterglow" compare "$work/nan.pfm" "$work/nan.pfm"
echo "hello" >"$work/text.exr"
expect 2 "not a readable EXR" "$bin/afterglow" compare "$work/text.exr" "$work/a.pfm"
expect 2 "neither .exr, .hdr nor .pfm" "$bin/afterglow" compare "$0" "$work/a.pfm"
expect 2 "cannot write" "$bin/afterglow" compare "$work/a.pfm" "$work/a.pfm" --heatmap "$work/none/heat.png"

# Lamps hung in a scene: the same ones for the renderer and the reference, and none where there is no room.
render hall -o "$work/lamps.pfm" --layer direct --lamps 30 --no-scene-lights --preset lights-reference
expect 0 "0 bounces" "$bin/afterglow" reference hall -o "$work/lamps.exr" --layer direct --bounces 0 --lamps 30 \
  --no-scene-lights --size 160x90
expect 0 '"rel_rmse"' "$bin/afterglow" compare "$work/lamps.exr" "$work/lamps.pfm" --max-rel-rmse 0.1

# The reference: noise in the file, and what cannot be asked of it.
expect 0 "noise" "$bin/afterglow" reference cornell -o "$work/truth.exr" --layer bounce1 --size 32x18 --spp 64
expect 0 '"noise_floor"' "$bin/afterglow" compare "$work/truth.exr" "$work/truth.exr"
expect 0 "emitters a pixel" "$bin/afterglow" reference cornell -o "$work/vpl.exr" --layer bounce1 --size 32x18 \
  --spp 64 --method vpl
expect 0 "2 bounces" "$bin/afterglow" reference cornell -o "$work/b2.exr" --layer bounce2 --bounces 2 --size 32x18 --glossy
expect 2 "needs --bounces 3" "$bin/afterglow" reference cornell -o "$work/b3.exr" --layer bounce3 --bounces 2
expect 2 "no layer 'vals'" "$bin/afterglow" reference cornell -o "$work/b3.exr" --layer vals
expect 2 "exactly one bounce" "$bin/afterglow" reference cornell -o "$work/b3.exr" --bounces 2 --method vpl

# A small benchmark leaves all its files.
expect 0 "rsmc" "$bin/afterglow" bench --scenes cornell --techniques rsmc,none --plain --no-path-tracing --size 32x18 --flicker-size 16x9 \
  --frames 5 --reference-spp 16 --cache "$work/cache" --json "$work/b.json" --csv "$work/b.csv" \
  --plot "$work/b.svg" --markdown "$work/b.md"
for file in b.json b.csv b.svg b.md; do
  grep -q rsmc "$work/$file" || fail "bench left no rows in $file"
done
expect 0 "each texel by itself, traced" "$bin/afterglow" bench --ladder corner --size 32x18 --reference-spp 64 \
  --clusterings 1 --cache "$work/cache" --markdown "$work/ladder.md" --json "$work/ladder.json"
grep -q tone_rmse "$work/ladder.json" && grep -q "today" "$work/ladder.md" || fail "the ladder left no tables"
expect 2 "there is no technique 'magic'" "$bin/afterglow" bench --techniques magic
expect 2 "does not exist" "$bin/afterglow" bench --scenes nowhere --techniques none

# A capture leaves all its files; what cannot be written leaves none.
expect 0 " passes, " "$bin/afterglow" capture cornell -o "$work/seen" --size 32x18 --frames 3 --warm-up 2 --schedule \
  --walk 0.01,0,0 --reference --reference-spp 4 --validate
for file in passes.csv pictures.csv trace.json frame_graph.dot frame_graph.svg schedule.dot schedule.svg report.html \
  composite.display.png gbuffer.depth.png view.clusters.png reference.png; do
  [[ -s $work/seen/$file ]] || fail "capture left no $file"
done
[[ -z $(find "$work/seen" -name ".unfinished*") ]] || fail "capture left its unfinished files"
expect 0 "no picture changed" "$bin/afterglow" capture --diff "$work/seen" "$work/seen"
expect 2 "nowhere/passes.csv: the file does not exist" "$bin/afterglow" capture --diff "$work/seen" "$work/nowhere"
expect 2 "capture needs -o DIR" "$bin/afterglow" capture cornell
expect 2 "capture needs a SCENE" "$bin/afterglow" capture -o "$work/none"
expect 2 "cannot make the folder /proc/none/seen" "$bin/afterglow" capture cornell -o /proc/none/seen
expect 2 "no pass of the frame is named 'rsm.wash'" "$bin/afterglow" capture cornell -o "$work/none" --size 32x18 --frames 1 \
  --warm-up 1 --repeat rsm.wash=3
expect 2 "--repeat takes PASS=N" "$bin/afterglow" capture cornell -o "$work/none" --repeat rsm.render
expect 2 "--schedule takes the lights of the scene's file" "$bin/afterglow" capture cornell -o "$work/none" --schedule --sun 0,-1,0
# Files of 16 KiB at most: as on a full disk.
full() { (trap '' XFSZ; ulimit -f 16; AFTERGLOW_CACHE_DIR=/proc/none "$@"); }
expect 2 "cannot write" full "$bin/afterglow" capture cornell -o "$work/none" --size 32x18 --frames 1 --warm-up 1
[[ ! -e $work/none ]] || fail "a refused capture left a folder"

expect 0 "adaptive by flux" "$bin/afterglow" sweep --frames 8 --every 4 --csv "$work/s.csv" --plot "$work/s.svg"
[[ $(wc -l <"$work/s.csv") == 3 && -s $work/s.svg ]] || fail "sweep left no table or plot"
expect 2 "cannot make the folder" "$bin/afterglow" sweep --frames 2 --csv /proc/none/s.csv

# A scene written and read again looks the same.
"$bin/afterglow" scene cornell -o "$work/cornell.glb" >/dev/null || fail "scene cornell"
render "$work/cornell.glb" -o "$work/again.pfm" --layer direct
expect 0 '"rel_rmse"' "$bin/afterglow" compare "$work/direct.pfm" "$work/again.pfm" --max-rel-rmse 1e-3

"$bin/afterglow-demo" --headless --frames 6 --size 160x90 --screenshot "$work/demo.png" --report "$work/report.txt" \
  --validate >/dev/null 2>"$work/err" || fail "the demo: $(cat "$work/err")"
[[ -s $work/demo.png && -s $work/report.txt ]] || fail "the demo left no picture or report"
# The same replay: the same world and the same picture, with any number of threads, with everything run or skipped.
play() {  # PICTURE [OPTION...]
  "$bin/afterglow-demo" --headless --frames 40 --ticks-per-frame 12 --size 64x36 --screenshot "$work/$1" "${@:2}" \
    2>/dev/null | grep hash
}
hash=$(play many.png)
[[ -n $hash ]] || fail "the demo reported no world hash"
[[ $hash == "$(play one.png --serial)" ]] || fail "the world differs between one thread and several"
[[ $hash == "$(play all.png --set engine.skip=off)" ]] || fail "the world differs with everything run"
for other in one.png all.png; do
  cmp "$work/many.png" "$work/$other" || fail "many.png and $other differ"
done

exit $((failures > 0))
