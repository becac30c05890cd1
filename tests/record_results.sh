#!/usr/bin/env bash
# Records what the command computes, without times, so that two versions can be compared to the byte:
# plans of the bundled workcells and of the recordings by every method, `evaluate planning` and
# `evaluate shadow-filters`, reconstructions, replays, and hashes of all grids, meshes and pictures.
#
#   tests/record_results.sh BUILD_FOLDER OUT [DATA]      then: diff -r OUT_BEFORE OUT_AFTER
#
#   DATA   the folder of the recordings; without it they are left out
set -euo pipefail
build=$(realpath "${1:?usage: tests/record_results.sh BUILD_FOLDER OUT [DATA]}")
out=$(realpath -m "${2:?usage: tests/record_results.sh BUILD_FOLDER OUT [DATA]}")
data=${3:+$(realpath "$3")}
assets=$(cd "$(dirname "${BASH_SOURCE[0]}")/../assets" && pwd)
mkdir -p "$out"
[[ -z $(ls -A "$out") ]] || { echo "tests/record_results.sh: $out is not empty" >&2; exit 2; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
cp -r "$assets/workcells" "$assets/knowledge" .
vantage() { "$build/apps/vantage" "$@"; }

# Keeps JSON without times, hashes of all else.
keep() {
  python3 - "$1" "$out/$2" <<'END'
import hashlib, json, pathlib, sys

def without_times(value):
    if isinstance(value, dict):
        return {k: without_times(v) for k, v in value.items() if not k.startswith("timing")}
    return [without_times(v) for v in value] if isinstance(value, list) else value

source, target = map(pathlib.Path, sys.argv[1:])
target.mkdir(parents=True)
hashes = []
for path in sorted(p for p in source.rglob("*") if p.is_file()):
    name = path.relative_to(source)
    if path.suffix == ".json":
        (target / str(name).replace("/", "_")).write_text(
            json.dumps(without_times(json.loads(path.read_text())), indent=1) + "\n")
    elif name.name not in ("planning.html",) and not (name.suffix == ".svg" and "planning" in name.name):
        hashes.append(f"{hashlib.sha256(path.read_bytes()).hexdigest()}  {name}\n")
(target / "hashes.txt").write_text("".join(hashes))
END
  rm -rf "$1"
}

step() { echo "$*" >&2; }

for cell in workcells/*.yaml; do
  name=$(basename "$cell" .yaml)
  [[ $name != charuco ]] || continue
  step "plan $name"
  vantage simulate "$cell" --samples 4 --seed 3 -o data_$name >/dev/null 2>&1
  for method in voxel shadow light mesh; do
    vantage plan data_$name --workcell data_$name/workcell.yaml --voxel-size 0.01 --method $method \
      --servo 2 -o plan $([[ $method != mesh ]] || echo --save-grid --save-surface --save-scene) \
      >/dev/null 2>&1 || true  # exit 4: nothing to see; said in plan.json
    keep plan "plan_${name}_$method"
  done
done
for name in castle clutter; do
  step "reconstruct $name"
  for method in svd pnp voting; do
    vantage reconstruct data_$name --workcell data_$name/workcell.yaml --method $method \
      --cameras board -o world >/dev/null 2>&1 || true
    [[ ! -d world ]] || keep world "world_${name}_$method"
  done
  vantage evaluate reconstruction data_$name --workcell data_$name/workcell.yaml --sizes 1-2 \
    -o evaluation >/dev/null
  keep evaluation "evaluate_reconstruction_$name"
done
keep data_bin simulated_bin
step "evaluate planning"
(cd workcells && vantage evaluate planning wall.yaml:side two_pillars.yaml corridor.yaml:left,right \
  foreign_objects.yaml+ideal --voxel-size 0.02 --servo 2 --no-pictures -o ../evaluation >/dev/null 2>&1)
keep evaluation evaluate_planning
step "evaluate shadow-filters"
(cd workcells && vantage evaluate shadow-filters wall.yaml:side two_pillars.yaml --voxel-size 0.01 --json >../filters.json)
mkdir evaluation && mv filters.json evaluation
keep evaluation evaluate_shadow_filters
if [[ -n $data ]]; then
  for scene in osd_learn0 osd_learn12 osd_learn33; do
    step "plan $scene"
    ln -s "$data/$scene" $scene
    vantage plan $scene --work-area -0.4 -0.25 0.005 0.4 0.4 0.13 --voxel-size 0.01 --candidates full \
      --servo 1 -o plan --save-grid --save-surface --pictures --picture-width 320 >/dev/null 2>&1
    keep plan "plan_$scene"
  done
  step "replay"
  ln -s "$data/kitchen" kitchen
  vantage evaluate replay kitchen --work-area -0.7 -0.75 0 1.1 0.65 0.35 --voxel-size 0.03 --pairs 3 \
    -o evaluation >/dev/null 2>&1
  keep evaluation replay
  step "reconstruct charuco"
  ln -s "$data/charuco" charuco
  vantage reconstruct charuco --workcell workcells/charuco.yaml --calibration charuco/camera.yml \
    -o world >/dev/null 2>&1
  keep world charuco
fi
echo "$(find "$out" -type f | wc -l) files recorded, with $(cat "$out"/*/hashes.txt | wc -l) hashes" >&2
