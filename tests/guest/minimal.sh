#!/usr/bin/env bash
# The example in C99: a room from a file, its bounced light against a path tracer that knows nothing of the library.
set -u
bin=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failed() { echo "FAILED: $*"; exit 1; }

"$bin/afterglow" scene cornell -o "$work/room.glb" >/dev/null || failed "no room"
"$bin/afterglow" reference "$work/room.glb" -o "$work/truth.pfm" --layer indirect --bounces 32 --size 320x180 --spp 128 \
  >/dev/null 2>&1 || failed "no truth"
said=$("$bin/afterglow-minimal" "$work/room.glb" "$work/light.pfm" "$work/truth.pfm" 2>"$work/err") || failed "$(cat "$work/err")"
echo "$said"
# Of the error some 0.075 is the truth's own noise.
read -r ratio error < <(sed -E 's/mean ratio ([0-9.]+), relative RMSE ([0-9.]+)/\1 \2/' <<<"$said")
awk -v r="$ratio" -v e="$error" 'BEGIN { exit !(r > 0.97 && r < 1.03 && e > 0 && e < 0.13) }' ||
  failed "the light is not the path tracer's"

# Bad luck is one sentence and a code.
for bad in "" "$work/room.glb" "$work/none.glb $work/x.pfm" "$work/truth.pfm $work/x.pfm"; do
  # shellcheck disable=SC2086
  "$bin/afterglow-minimal" $bad >"$work/out" 2>"$work/err" && failed "'$bad' was taken"
  [[ $(wc -l <"$work/err") == 1 ]] || failed "'$bad': $(cat "$work/err")"
done
