#!/usr/bin/env bash
# on.sh DEVICE BIN COMMAND...: runs it on lavapipe-128, lavapipe-256 (bits), swiftshader, or on hardware. BIN is the
# folder of the programs. Exit code 77: this machine has no such device.
set -u
device=$1 bin=$2
shift 2

none() {
  echo "$device: $1"
  exit 77
}
use() {  # ICD file
  export VK_ICD_FILENAMES=$1 VK_DRIVER_FILES=$1
}
first_of() {
  for file in "$@"; do
    [[ -f $file ]] && echo "$file" && return
  done
}
case $device in
  lavapipe-*)
    icd=$(first_of /usr/share/vulkan/icd.d/lvp_icd*.json /etc/vulkan/icd.d/lvp_icd*.json)
    [[ -n $icd ]] || none "there is no lavapipe (Debian package mesa-vulkan-drivers)"
    use "$icd"
    export LP_NATIVE_VECTOR_WIDTH=${device#lavapipe-}
    ;;
  swiftshader)
    icd=$(first_of /usr/lib/chromium/vk_swiftshader_icd.json /usr/lib/chromium-browser/vk_swiftshader_icd.json)
    [[ -n $icd ]] || none "there is no SwiftShader (Debian package chromium)"
    use "$icd"
    ;;
  hardware)
    "$bin/afterglow" info | grep -q 'uniform loads (GPU)' || none "there is no GPU"
    ;;
  *)
    echo "there is no device '$device'" >&2
    exit 2
    ;;
esac
exec "$@"
