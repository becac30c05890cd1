// What judging whether objects can be at rest takes, and pulling them to what they stand on: N
// cubes and tins on a floor beside a table of boxes, a third of them on others. Arg: N.

#include <benchmark/benchmark.h>

#include <cmath>
#include <vector>

#include "vantage/raycore/solids.hpp"
#include "vantage/reconstruction/check_support.hpp"

namespace vantage::bench {
namespace {

TypePtr type_of(TriangleMesh mesh) {
  ObjectType type{.name = "solid"};
  type.mesh = std::make_shared<TriangleMesh>(std::move(mesh));
  return std::make_shared<ObjectType>(type);
}

/// Every third object stands on the one before.
std::vector<ReconstructedObject> objects_at_rest(int count) {
  const TypePtr cube = type_of(box_solid({0.05, 0.05, 0.05}));
  const TypePtr tin = type_of(cylinder_solid(0.03, 0.05));
  std::vector<ReconstructedObject> objects;
  const int across = int(std::ceil(std::sqrt(count)));
  Eigen::Vector3d at(0, 0, 0);
  for (int i = 0; i < count; ++i) {
    const bool on_top = i % 3 == 2;
    if (!on_top) at = {0.12 * (i % across), 0.12 * (i / across), 0};
    ReconstructedObject object;
    object.type = i % 2 == 0 ? cube : tin;
    const double turn = i;
    object.T_world_object =
        Pose::from_rotation(Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitZ()).toRotationMatrix(),
                            at + Eigen::Vector3d(0, 0, on_top ? 0.075 : 0.025));
    Matrix6d covariance = Matrix6d::Identity() * 2.5e-7;
    covariance.bottomRightCorner<3, 3>() *= 100;
    object.covariance = covariance;
    objects.push_back(object);
  }
  return objects;
}

std::vector<KnownObject> structures() {
  const auto table = std::make_shared<TriangleMesh>(box_solid({3, 3, 0.05}));
  const auto room = std::make_shared<TriangleMesh>(bin_solid({4, 4, 3}, 0.05));
  return {{"table", table, Pose::from_translation({0, 0, -0.035})},
          {"room", room, Pose::from_translation({0, 0, 1})}};
}

void judge(benchmark::State& state) {
  const std::vector<ReconstructedObject> objects = objects_at_rest(int(state.range(0)));
  const std::vector<KnownObject> fixed = structures();
  std::size_t standing = 0;
  for (auto _ : state) {
    standing = 0;
    for (const ObjectSupport& support : judge_support(objects, fixed)) {
      standing += support.verdict == SupportVerdict::stands;
    }
  }
  state.counters["standing"] = double(standing);
}

void check(benchmark::State& state) {
  const std::vector<ReconstructedObject> objects = objects_at_rest(int(state.range(0)));
  const std::vector<KnownObject> fixed = structures();
  std::size_t pulled = 0;
  for (auto _ : state) {
    std::vector<ReconstructedObject> found = objects;
    pulled = 0;
    for (const ObjectSupport& one : check_support(fixed, {}, {}, found)) pulled += one.pulled;
  }
  state.counters["pulled"] = double(pulled);
}

BENCHMARK(judge)->Arg(5)->Arg(20)->Arg(80)->Unit(benchmark::kMillisecond);
BENCHMARK(check)->Arg(5)->Arg(20)->Arg(80)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace vantage::bench

BENCHMARK_MAIN();
