#!/usr/bin/env bash
# Configures and builds one preset; says little unless something fails.
#
#   apps/build.sh PRESET [TARGET...]
#
# $VANTAGE_WERROR=ON makes warnings errors.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
preset=${1:?usage: apps/build.sh PRESET [TARGET...]}
shift

log=$(mktemp)
trap 'rm -f "$log"' EXIT
if ! cmake --preset "$preset" ${VANTAGE_WERROR:+-DVANTAGE_WERROR="$VANTAGE_WERROR"} >"$log" 2>&1; then
  cat "$log" >&2
  exit 1
fi
cmake --build --preset "$preset" --parallel "$(nproc)" ${1:+--target "$@"}
