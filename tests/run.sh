#!/usr/bin/env bash
# Installs what is missing, builds, and runs every test of a preset.
#
#   tests/run.sh [PRESET] [ctest's options]
#
#   PRESET   release (default), no-unity, debug, asan, tsan
#
# $VANTAGE_WERROR=ON makes warnings errors; $VANTAGE_DATA names the folder of the recordings;
# $VANTAGE_MAX_ISA (sse4.2, avx, avx2, avx512) limits the instruction set that is tested.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
preset=${1:-release}
shift $(( $# > 0 ))

apps/setup.sh --test
case $preset in
  asan | tsan) targets=(unit_tests) ;;  # whole commands would take hours
  *) targets=() ;;
esac
VANTAGE_WERROR=${VANTAGE_WERROR:-OFF} apps/build.sh "$preset" "${targets[@]}"
ctest --preset "$preset" "$@"
