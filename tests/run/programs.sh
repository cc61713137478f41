#!/usr/bin/env bash
# Exit codes, sentences and files of the command-line programs.
set -u
bin=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failures=0

fail() {
  echo "FAILED: $*"
  failures=$((failures + 1))
}

# expect CODE WORDS COMMAND...: the exit code, and the words on stderr or stdout.
expect() {
  local code=$1 words=$2
  shift 2
  "$@" >"$work/out" 2>"$work/err"
  local got=$?
  [[ $got == "$code" ]] || fail "$* exited with $got instead of $code: $(head -c 300 "$work/err")"
  grep -qF -- "$words" "$work/out" "$work/err" || fail "$* did not say '$words' but: $(head -c 300 "$work/err")"
  if [[ $code == 2 && $(grep -c . "$work/err") != 1 ]]; then
    fail "$* said more than one sentence: $(head -c 600 "$work/err")"
  fi
}

expect 0 "Vulkan" "$bin/afterglow" info
expect 0 "val_clustering.count" "$bin/afterglow" render --list-settings
expect 2 "there is no layer 'colour'" "$bin/afterglow" render cornell -o "$work/a.png" --layer colour
expect 2 "must end in .exr" "$bin/afterglow" render cornell -o "$work/a.jpg"
expect 2 "does not exist" "$bin/afterglow" render /no/such.glb -o "$work/a.png"
expect 2 "16..1024" "$bin/afterglow" render cornell -o "$work/a.png" --set val_clustering.count=3
expect 2 "a size is WxH" "$bin/afterglow" render cornell -o "$work/a.png" --size 10
expect 2 "--sun takes" "$bin/afterglow" render cornell -o "$work/a.png" --sun 1,2
expect 2 "no camera 'nose'" "$bin/afterglow" render cornell -o "$work/a.png" --camera nose
expect 2 "there is no built-in scene" "$bin/afterglow" scene nowhere -o "$work/a.glb"
expect 2 "not a replay" "$bin/afterglow-demo" --headless --replay "$0"
[[ -z $(ls "$work" | grep -v -E '^(out|err)$') ]] || fail "a refused command left a file behind"

render() { "$bin/afterglow" render "$@" --size 160x90 --frames 12 --validate 2>"$work/err" || fail "render $*: $(cat "$work/err")"; }
render cornell -o "$work/a.png"
render cornell -o "$work/b.png"
cmp "$work/a.png" "$work/b.png" || fail "the same command twice gave two pictures"
render cornell -o "$work/a.exr"
render cornell -o "$work/a.pfm"
expect 0 '"rel_rmse": 0.0' "$bin/afterglow" compare "$work/a.exr" "$work/a.pfm" --max-rel-rmse 1e-6
render cornell -o "$work/direct.pfm" --layer direct
expect 1 '"rel_rmse"' "$bin/afterglow" compare "$work/a.pfm" "$work/direct.pfm" --max-rel-rmse 0.01
expect 2 "does not exist" "$bin/afterglow" compare "$work/none.exr" "$work/a.pfm"

# A scene written and read again looks the same.
"$bin/afterglow" scene cornell -o "$work/cornell.glb" >/dev/null || fail "scene cornell"
render "$work/cornell.glb" -o "$work/again.pfm"
expect 0 '"rel_rmse"' "$bin/afterglow" compare "$work/a.pfm" "$work/again.pfm" --max-rel-rmse 5e-3

"$bin/afterglow-demo" --headless --frames 6 --size 160x90 --screenshot "$work/demo.png" --report "$work/report.txt" \
  --validate >/dev/null 2>"$work/err" || fail "the demo: $(cat "$work/err")"
[[ -s $work/demo.png && -s $work/report.txt ]] || fail "the demo left no picture or report"
hash1=$("$bin/afterglow-demo" --headless --frames 40 --size 32x18 2>/dev/null | grep hash)
hash2=$("$bin/afterglow-demo" --headless --frames 40 --size 32x18 --serial 2>/dev/null | grep hash)
[[ -n $hash1 && $hash1 == "$hash2" ]] || fail "the world differs between one thread and several: $hash1, $hash2"

exit $((failures > 0))
