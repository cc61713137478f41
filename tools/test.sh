#!/usr/bin/env bash
# Installs what is missing, builds, runs every test; ctest's summary comes last. `test.sh quick`: all without a device and
# some cases of each part with one, in about a minute. Further words go to ctest.
package_lists=(tools/packages.txt tools/test_packages.txt)
source "$(dirname "${BASH_SOURCE[0]}")/setup.sh"
which=()
if [[ ${1:-} == quick ]]; then
  which=(-C Quick -L 'unit|quick')
  shift
fi
# Tests share the cores; those that measure how long something takes run alone.
ctest --test-dir "$build" --output-on-failure -j "$(nproc)" "${which[@]}" "$@"
