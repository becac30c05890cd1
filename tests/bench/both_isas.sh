#!/usr/bin/env bash
# Runs a benchmark as most machines would (AVX2) and as this one can, one after the other.
#
#   tests/bench/both_isas.sh build/release/tests/bench/bench_raycore [its options]
set -euo pipefail
(( $# )) || { sed -n '2,4p' "${BASH_SOURCE[0]}" | sed 's/^# \{0,1\}//' >&2; exit 2; }
for isa in avx2 avx512; do
  echo "== VANTAGE_MAX_ISA=$isa"
  VANTAGE_MAX_ISA=$isa "$@"
done
