#!/usr/bin/env bash
# What someone sees who opens a file that says nothing of light or camera: a lit picture. Small files of one feature each,
# and the scene library's where AFTERGLOW_SCENES names its folder. FIRST_SIGHT=FRAMES WxH changes how they are looked at.
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
source "$here/display.sh"
read -r frames size <<<"${FIRST_SIGHT:-24 80x45}"
python3 "$here/feature_scenes.py" "$work" >/dev/null || { echo "FAILED: no files"; exit 1; }
shopt -s nullglob
scenes=("$work"/*.gltf)
[[ -n ${AFTERGLOW_SCENES:-} ]] && scenes+=("$AFTERGLOW_SCENES"/*/*.gltf "$AFTERGLOW_SCENES"/*/*.glb)
failed=0
for scene in "${scenes[@]}"; do
  if ! "$bin/afterglow" view "$scene" --size "$size" --frames "$frames" --screenshot "$work/seen.png" --validate >"$work/log" 2>&1; then
    echo "FAILED: $(basename "$scene"): $(tail -1 "$work/log")"
    failed=1
    continue
  fi
  python3 "$here/brightness.py" "$work/seen.png" "$(basename "$scene")" || failed=1
done
exit $failed
