#!/usr/bin/env bash
# Installs what is missing, builds, runs every test; ctest's summary comes last.
package_lists=(tools/packages.txt tools/test_packages.txt)
source "$(dirname "${BASH_SOURCE[0]}")/setup.sh"
# The quick tests share the cores; those that open a device run alone.
ctest --test-dir "$build" --output-on-failure -j "$(nproc)" "$@"
