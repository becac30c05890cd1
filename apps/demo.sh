#!/usr/bin/env bash
# From a fresh checkout to a picture of the next best view: installs what is missing, builds, and
# runs `vantage demo` into out/demo. Arguments go to `vantage demo`.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

"$root/apps/setup.sh"
"$root/apps/build.sh" release vantage
"$root/build/release/apps/vantage" demo -o "$root/out/demo" "$@"
