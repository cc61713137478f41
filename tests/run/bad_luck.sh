#!/usr/bin/env bash
# What the programs do when the world fails them: full disks, no memory, nonsense on the command line, files that never
# end. A sentence, an exit code, and what was there before is there still.
source "$(dirname "${BASH_SOURCE[0]}")/expect.sh"

# Counts are bounded before anything is made.
expect 2 "scene lamps takes a number up to 100000, not 4294967295" "$bin/afterglow" render lamps --param 4294967295 -o "$work/a.png"
expect 2 "scene crowd takes a number up to 500000, not 1000000000" "$bin/afterglow" scene crowd --param 1000000000 -o "$work/a.glb"

# Numbers are numbers, and in their range.
expect 2 "'nan' is not a number from 0.1" "$bin/afterglow" render cornell -o "$work/a.png" --budget-ms nan
expect 2 "'nan' is not a number from 0.1" "$bin/afterglow-demo" --headless --budget-ms nan
expect 2 "'nan' is not a number from 0.1" "$bin/afterglow" bench --budget-ms nan
expect 2 "'nan' is not a number" "$bin/afterglow" reference cornell -o "$work/a.exr" --max-error nan
expect 2 "'-nan' is not a number" "$bin/afterglow" compare a.exr b.exr --max-rel-rmse -nan
expect 2 "--view takes" "$bin/afterglow" render cornell -o "$work/a.png" --view 1e300,0,0,0,0,0
expect 2 "a size is WxH" "$bin/afterglow-demo" --headless --size -1x5
expect 2 "it is not a folder" "$bin/afterglow-demo" --headless --user "$0"

# A view of the scene library is a number that it has.
mkdir -p "$work/library/box"
"$bin/afterglow" scene cornell -o "$work/library/box/box.glb" >/dev/null || fail "scene cornell"
echo '{"scenes": [{"file": "box/box.glb", "views": [{"position": [0, 1, 4], "target": [0, 1, 0]}]}]}' >"$work/library/scenes.json"
export AFTERGLOW_SCENES=$work/library
for view in zz -1 1 0.5 ""; do
  expect 2 "no view '$view'" "$bin/afterglow" render "box:$view" -o "$work/a.png" --size 32x18
done
"$bin/afterglow" render box:0 -o "$work/a.png" --size 32x18 --frames 1 2>/dev/null || fail "render box:0"

# A layer that a technique does not make is no black picture.
expect 2 "preset high makes no layer bounce2" "$bin/afterglow" render cornell -o "$work/a.exr" --preset high --layer bounce2 --size 32x18
expect 2 "preset none makes no layer bounce1" "$bin/afterglow" render cornell -o "$work/a.png" --preset none --layer bounce1 --size 32x18
expect 2 "preset rsm-400 makes no layer ism" "$bin/afterglow" render cornell -o "$work/a.png" --preset rsm-400 --layer ism --size 32x18
expect 2 "no light that bounces" "$bin/afterglow" render cornell -o "$work/a.png" --no-scene-lights --layer clusters --size 32x18
expect 2 "is no irradiance" "$bin/afterglow" render cornell -o "$work/a.exr" --layer depth:radiance --size 32x18

# What cannot be read without waiting or without end.
mkfifo "$work/pipe.pfm" "$work/pipe.glb" "$work/pipe.replay"
ln -s /dev/zero "$work/zero.exr"
expect 2 "pipe.pfm: it is not a file" "$bin/afterglow" compare "$work/pipe.pfm" "$work/pipe.pfm"
expect 2 "zero.exr: it is not a file" "$bin/afterglow" compare "$work/zero.exr" "$work/zero.exr"
expect 2 "pipe.glb: it is not a file" "$bin/afterglow" render "$work/pipe.glb" -o "$work/a.png"
expect 2 "pipe.replay: it is not a file" "$bin/afterglow-demo" --headless --replay "$work/pipe.replay"

# Outputs that cannot be written are refused before the work: a render of this size would take minutes.
for option in "-o /no/such/a.exr" "-o /no/such/b.pfm" "-o /proc/none/a.png"; do
  expect 2 "cannot write" "$bin/afterglow" render cornell --size 8192x8192 --frames 100000 $option
done
expect 2 "cannot write" "$bin/afterglow" reference cornell --size 8192x8192 --spp 1000000 -o /no/such/a.exr
for option in --json --csv --plot --markdown; do
  expect 2 "cannot make the folder" "$bin/afterglow" bench $option /proc/none/a.json
done
expect 2 "cannot make the folder" "$bin/afterglow" skipping --plot /proc/none/a.svg
for option in --record --screenshot --moments --report; do
  expect 2 "cannot write" "$bin/afterglow-demo" --headless $option /no/such/file
done

# A full disk leaves what was there, whole: files of 16 KiB at most are one.
full() { (trap '' XFSZ; ulimit -f 16; AFTERGLOW_CACHE_DIR=/proc/none MESA_SHADER_CACHE_DISABLE=true "$@"); }
kept() {  # FILE COMMAND...: FILE is what the command would replace
  local file=$1
  shift
  echo old >"$file"
  expect 2 "cannot write" full "$@"
  [[ $(cat "$file") == old ]] || fail "$* damaged $file"
  [[ $(find "$(dirname "$file")" -name '*.part' | wc -l) == 0 ]] || fail "$* left a temporary file"
}
kept "$work/g.glb" "$bin/afterglow" scene gallery -o "$work/g.glb"
for kind in exr pfm png; do
  kept "$work/r.$kind" "$bin/afterglow" reference cornell --spp 2 --size 160x90 -o "$work/r.$kind"
done

# Too little memory, at every size of it: never a crash. The address sanitizer itself needs more than is given here.
[[ -n ${AFTERGLOW_SANITIZED:-} ]] && exit $((failures > 0))
for mib in 80 150 250 330 420 520 640 800 900 920 940; do
  (ulimit -v $((mib * 1024)); exec "$bin/afterglow" render cornell --size 64x36 --frames 2 -o "$work/m.png") >"$work/out" 2>"$work/err"
  got=$?
  [[ $got == 0 || $got == 127 && $mib -lt 100 ]] && continue  # 127: the program itself found no room
  [[ $got == 3 && $(grep -c "out of memory" "$work/err") == 1 ]] || fail "render in $mib MiB exited with $got: $(head -c 300 "$work/err")"
done
for mib in 100 200 400; do
  (ulimit -v $((mib * 1024)); exec "$bin/afterglow" scene crowd --param 500000 -o "$work/m.glb") >"$work/out" 2>"$work/err"
  got=$?
  [[ $got == 3 && $(grep -c "out of memory" "$work/err") == 1 ]] || fail "scene in $mib MiB exited with $got: $(head -c 300 "$work/err")"
done
exit $((failures > 0))
