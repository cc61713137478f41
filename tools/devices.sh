#!/usr/bin/env bash
# The long device suite (hours on two cores): each preset as it is, on cornell, and on sponza where AFTERGLOW_SCENES names a
# library that has it, 160x90, on each CPU device there is and on the hardware, with validation. Prints a Markdown table of
# errors against path tracing of the same bounces, of all pixels and without the worst hundredth: edges fall otherwise on
# another rasteriser. Fails where the latter is more than a tenth, and 0.01, above the default device's. Then every test
# with a device on each of them. DEVICES names some devices, PRESETS some presets, FRAMES how many frames.
set -uo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
bin=$PWD/build/bin on=$PWD/tests/devices/on.sh
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
devices=${DEVICES:-lavapipe-256 lavapipe-128 swiftshader hardware}
presets=${PRESETS:-none rsm-brute rsm-400 irsm stochastic ism ssvp rsmc acrsm afterglow medium afterglow-bounces low high ultra
  lights-reference lightcluster afterglow-lights}
failures=0
fail() {
  echo "FAILED: $*" >&2
  failures=$((failures + 1))
}

scenes=(cornell)
"$bin/afterglow" render sponza -o "$work/s.png" --size 16x9 --frames 1 --preset none 2>/dev/null && scenes+=(sponza)
present=()
for device in $devices; do
  "$on" "$device" "$bin" true >/dev/null && present+=("$device")
done

error_of() {  # name of a number that compare prints
  sed -n "s/.*\"$1\": \([^,]*\).*/\1/p" "$work/errors"
}
layer_of() {  # what there is a truth of: the first bounce, or direct light where none bounces
  case $1 in
    none | lights-reference | lightcluster | afterglow-lights) echo direct ;;
    *) echo bounce1 ;;
  esac
}
for scene in "${scenes[@]}"; do
  for layer in direct bounce1; do
    "$bin/afterglow" reference "$scene" -o "$work/$scene.$layer.exr" --layer "$layer" --bounces 1 --size 160x90 --spp 1024 \
      >/dev/null 2>&1 || fail "the reference of $scene, $layer"
  done
done
echo "| scene | preset | $(printf '%s | ' "${present[@]}")"
echo "|---|---|$(printf -- '---|%.0s' "${present[@]}")"
for scene in "${scenes[@]}"; do
  for preset in $presets; do
    layer=$(layer_of "$preset")
    row="| $scene | $preset |"
    default=
    for device in "${present[@]}"; do
      rm -f "$work/a.pfm"
      "$on" "$device" "$bin" "$bin/afterglow" render "$scene" -o "$work/a.pfm" --layer "$layer" --preset "$preset" --size 160x90 \
        --frames "${FRAMES:-32}" --validate >/dev/null 2>"$work/err" || fail "$device, $scene, $preset: $(tail -c 400 "$work/err")"
      "$bin/afterglow" compare "$work/$scene.$layer.exr" "$work/a.pfm" >"$work/errors" 2>/dev/null
      all=$(error_of rel_rmse) error=$(error_of rel_rmse_trimmed)
      if [[ -z $error ]]; then
        row+=" – |"
        fail "$device, $scene, $preset: no picture that can be compared"
        continue
      fi
      row+=" $(printf '%.4f (%.4f)' "$all" "$error") |"
      default=${default:-$error}
      awk "BEGIN {exit !($error > 1.1 * $default + 0.01)}" && fail "$device, $scene, $preset: error $error, the default device's is $default"
    done
    echo "$row"
  done
done
for device in "${present[@]}"; do
  for program in test_frame_gpu test_gi_gpu test_parity test_guest test_capture; do
    "$on" "$device" "$bin" "$bin/$program" >"$work/log" 2>&1 || fail "$device, $program: $(grep FAILED "$work/log" | tr '\n' ' ')"
  done
done
exit $((failures > 0))
