#!/usr/bin/env bash
# Installs what is missing, builds, and runs every test of a preset.
#
#   tests/run.sh [PRESET]      PRESET: release (default), debug, asan, tsan
#
# $VANTAGE_WERROR=ON makes warnings errors; $VANTAGE_DATA names the folder of the recordings.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
preset=${1:-release}

apps/setup.sh --test
VANTAGE_WERROR=${VANTAGE_WERROR:-OFF} apps/build.sh "$preset"
ctest --preset "$preset"
