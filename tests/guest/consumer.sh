#!/usr/bin/env bash
# A project outside the tree: the library is installed, the example built against it by find_package and by pkg-config,
# and run. Nothing installed may know of the build folder, so that it can be moved away.
set -u
build=$1
source=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failed() { echo "FAILED: $*"; exit 1; }

cmake --install "$build" --prefix "$work/prefix" >"$work/log" 2>&1 || failed "install: $(tail -3 "$work/log")"
prefix=$work/prefix
library=$(find "$prefix" -name libafterglow_gi.so)
[[ -n $library ]] || failed "no library was installed"
for name in "$build" "$source"; do
  known=$(grep -rlF "$name" "$prefix")
  [[ -z $known ]] || failed "these know of $name: $known"
done
sanitized=$(ldd "$library" | grep -c lib.san)

# What it links and shows: the C and C++ libraries, and the functions of the header.
for needed in $(objdump -p "$library" | awk '/NEEDED/ { print $2 }'); do
  case $needed in
    libstdc++.so.6 | libm.so.6 | libc.so.6 | libgcc_s.so.1 | ld-linux-*.so.* | libasan.so.* | libubsan.so.* | libtsan.so.*) ;;
    *) failed "the library links $needed" ;;
  esac
done
shown=$(nm -D --defined-only "$library" | awk '$2 == "T" { sub(/@.*/, "", $3); print $3 }' | sort)
declared=$(grep -oE '\bagi[A-Z][A-Za-z]+\(' "$prefix/include/afterglow/afterglow_gi.h" | tr -d '(' | sort -u)
[[ $shown == "$declared" ]] || failed "shown and declared differ: $(diff <(echo "$shown") <(echo "$declared"))"
[[ $(objdump -p "$library" | awk '/SONAME/ { print $2 }') == libafterglow_gi.so.1 ]] || failed "another soname"

"$build/bin/afterglow" scene corner -o "$work/room.glb" >/dev/null || failed "no room"
lights() { # program: its picture is not black
  "$1" "$work/room.glb" "$work/light.pfm" 2>"$work/err" || failed "$1: $(cat "$work/err")"
  [[ $(tail -c 200000 "$work/light.pfm" | tr -d '\0' | wc -c) -gt 10000 ]] || failed "$1 is black"
}

# find_package, with nothing but a copy of the example.
cp -r "$source/tools/examples" "$work/project"
cmake -S "$work/project" -B "$work/built" -DCMAKE_PREFIX_PATH="$prefix" >"$work/log" 2>&1 &&
  cmake --build "$work/built" >>"$work/log" 2>&1 || failed "find_package: $(tail -5 "$work/log")"
((sanitized)) || lights "$work/built/afterglow-minimal"

# pkg-config, shared and static.
export PKG_CONFIG_PATH
PKG_CONFIG_PATH=$(dirname "$(find "$prefix" -name afterglow_gi.pc)")
for stage in vert frag; do
  glslangValidator -V --quiet --target-env vulkan1.3 --vn gbuffer_$stage -o "$work/gbuffer.$stage.h" \
    "$work/project/gbuffer.$stage" >/dev/null || failed "glslangValidator"
done
read -ra flags < <(pkg-config --cflags afterglow_gi)
read -ra shared < <(pkg-config --libs afterglow_gi)
cc -std=c99 -I"$work" "${flags[@]}" -c "$work/project/minimal.c" -o "$work/minimal.o" || failed "pkg-config: the compiler"
((sanitized)) && exit 0
cc "$work/minimal.o" "${shared[@]}" -Wl,-rpath,"$(dirname "$library")" -lvulkan -lm -o "$work/with_shared" || failed "pkg-config"
lights "$work/with_shared"
cc "$work/minimal.o" "$(dirname "$library")/libafterglow_gi.a" -lstdc++ -lvulkan -lm -o "$work/with_static" || failed "static"
lights "$work/with_static"
