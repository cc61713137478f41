#!/usr/bin/env bash
# A device with less: at the least of each limit that is needed the picture is the same, and below it there is a
# sentence that names the limit. So there is for another width of lavapipe's, and for what wants more than the device has.
source "$(dirname "${BASH_SOURCE[0]}")/expect.sh"

render() { "$bin/afterglow" render "$@" --size 64x36 --frames 3 --preset afterglow-bounces --set texel_rays.enabled=off --validate; }

mapfile -t limits < <("$bin/afterglow" info | awk '$1 == "limit" {print $2, $3}')
((${#limits[@]} >= 15)) || fail "info lists ${#limits[@]} limits"
lowered=()
for row in "${limits[@]}"; do
  read -r name least <<<"$row"
  expect 2 "lacks $name of $least (it has $((least - 1)))" "$bin/afterglow" info --without "$name=$((least - 1))"
  lowered+=(--without "$name=$least")
done
expect 2 "lacks maxImageDimension2D of 4096" "$bin/afterglow-demo" --headless --frames 1 --without maxImageDimension2D=100
expect 2 "there is no feature or limit 'maxPower=3'" "$bin/afterglow" info --without maxPower=3
expect 2 "gives the limit no whole number" "$bin/afterglow" info --without maxImageArrayLayers=few

# All of them at once: smaller maps, storage buffers instead of texel buffers, and the same light.
render cornell -o "$work/whole.pfm" 2>"$work/err" || fail "render: $(cat "$work/err")"
render cornell -o "$work/least.pfm" "${lowered[@]}" 2>"$work/err" || fail "render with the least of each limit: $(cat "$work/err")"
expect 0 '"rel_rmse"' "$bin/afterglow" compare "$work/whole.pfm" "$work/least.pfm" --max-rel-rmse 1e-3

# More than the device has, wanted by a size or by settings.
expect 3 "more than this device's maxImageDimension2D of 4096" "$bin/afterglow" render cornell -o "$work/a.png" --size 4100x8 \
  --frames 1 --preset none --without maxImageDimension2D=4096
# Rays to texels are left out where a shader may not have so many buffers.
at_rest() { "$bin/afterglow" render cornell --size 64x36 --frames 48 --preset afterglow "$@" 2>"$work/err" || fail "render: $(cat "$work/err")"; }
at_rest -o "$work/rays.pfm"
at_rest -o "$work/area_lights.pfm" --set texel_rays.enabled=off
at_rest -o "$work/few.pfm" --without maxTexelBufferElements=65536 --without maxPerStageDescriptorStorageBuffers=10
expect 0 '"rel_rmse"' "$bin/afterglow" compare "$work/area_lights.pfm" "$work/few.pfm" --max-rel-rmse 1e-3
expect 1 "" "$bin/afterglow" compare "$work/area_lights.pfm" "$work/rays.pfm" --max-rel-rmse 1e-3
render cornell -o "$work/a.png" --set shadow_maps.resolution=4096 --set punctual_shadows.atlas_size=16384 \
  --without maxImageDimension2D=4096 2>"$work/err" || fail "maps larger than the device's images: $(cat "$work/err")"

# Widths that lavapipe cannot draw with are refused, and code of one width is not run at another.
if "$bin/afterglow" info | grep -q llvmpipe; then
  LP_NATIVE_VECTOR_WIDTH=512 expect 2 "LP_NATIVE_VECTOR_WIDTH may be 128 or 256" "$bin/afterglow" info
  export MESA_SHADER_CACHE_DIR=$work/cache
  for width in 256 128 256; do
    LP_NATIVE_VECTOR_WIDTH=$width render cornell -o "$work/$width.pfm" 2>"$work/err" || fail "width $width: $(cat "$work/err")"
  done
  [[ $(ls "$work/cache") == $'lanes-128\nlanes-256' ]] || fail "caches of two widths: $(ls "$work/cache")"
  expect 0 '"rel_rmse"' "$bin/afterglow" compare "$work/128.pfm" "$work/256.pfm" --max-rel-rmse 0.05
fi
exit $((failures > 0))
