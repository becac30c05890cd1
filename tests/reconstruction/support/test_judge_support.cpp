#include <doctest/doctest.h>

#include "reconstruction/synthetic_views.hpp"
#include "reference/plain_equilibrium.hpp"
#include "support/scene_count.hpp"
#include "vantage/raycore/solids.hpp"
#include "vantage/reconstruction/support.hpp"

namespace vantage::test {
namespace {

TypePtr solid_type(TriangleMesh mesh) {
  ObjectType type{.name = "solid"};
  type.mesh = std::make_shared<TriangleMesh>(std::move(mesh));
  return std::make_shared<ObjectType>(type);
}

ReconstructedObject box_at(const Eigen::Vector3d& size, const Eigen::Vector3d& centre,
                           double yaw = 0) {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  return {.type = solid_type(box_solid(size)), .T_world_object = Pose::from_rotation(turn, centre)};
}

const Eigen::Vector3d kCube(0.05, 0.05, 0.05);

SpaceState all_empty(const Eigen::Vector3d&) {
  return SpaceState::empty;
}

std::vector<SupportVerdict> verdicts_of(const std::vector<ReconstructedObject>& objects,
                                        const std::vector<KnownObject>& structures = {},
                                        const SpaceProbe& space = all_empty,
                                        const SupportOptions& options = {}) {
  std::vector<SupportVerdict> verdicts;
  for (const ObjectSupport& support : judge_support(objects, structures, space, options)) {
    verdicts.push_back(support.verdict);
  }
  return verdicts;
}

using Verdicts = std::vector<SupportVerdict>;
constexpr auto kStands = SupportVerdict::stands, kFloats = SupportVerdict::floats,
               kTips = SupportVerdict::tips, kUnseen = SupportVerdict::unseen;

}  // namespace

TEST_CASE("boxes on the floor and on each other stand, and say what holds them") {
  const std::vector<ReconstructedObject> tower{box_at(kCube, {0, 0, 0.025}),
                                               box_at(kCube, {0.01, 0, 0.075}, 0.7),
                                               box_at(kCube, {0.3, 0, 0.025}, 0.2)};
  const auto support = judge_support(tower, {}, all_empty);
  for (const ObjectSupport& one : support) {
    CHECK(one.verdict == kStands);
    CHECK(one.reason.empty());
    CHECK_FALSE(one.unseen_region);
  }
  CHECK(support[0].supported_by == std::vector<Supporter>{{SupporterKind::floor, 0}});
  CHECK(support[1].supported_by == std::vector<Supporter>{{SupporterKind::object, 0}});
}

TEST_CASE("what touches nothing floats, and so does what stands on it") {
  const std::vector<ReconstructedObject> objects{box_at(kCube, {0, 0, 0.075}),
                                                 box_at(kCube, {0, 0, 0.125})};
  CHECK(verdicts_of(objects) == Verdicts{kFloats, kFloats});
  const KnownObject shelf{"shelf", std::make_shared<TriangleMesh>(box_solid({0.2, 0.2, 0.02})),
                          Pose::from_translation({0, 0, 0.04})};
  CHECK(verdicts_of(objects, {shelf}) == Verdicts{kStands, kStands});
  CHECK(judge_support(objects, std::vector{shelf})[0].supported_by ==
        std::vector<Supporter>{{SupporterKind::structure, 0}});
}

TEST_CASE("without cameras that see below, something unseen may hold what floats") {
  const std::vector<ReconstructedObject> objects{box_at(kCube, {0, 0, 0.095})};
  const auto support = judge_support(objects, {});
  REQUIRE(support[0].verdict == kUnseen);
  CHECK(support[0].supported_by == std::vector<Supporter>{{SupporterKind::unseen, 0}});
  REQUIRE(support[0].unseen_region);
  CHECK(support[0].unseen_region->min().z() == doctest::Approx(0).scale(1));
  CHECK(support[0].unseen_region->max().z() == doctest::Approx(0.07));
  // Seen to be empty under one half: what is left cannot hold it, as it does not reach the middle.
  const auto half = [](const Eigen::Vector3d& p) {
    return p.x() < 0.012 ? SpaceState::empty : SpaceState::unseen;
  };
  CHECK(verdicts_of(objects, {}, half) == Verdicts{kFloats});
  const auto measured = [](const Eigen::Vector3d&) { return SpaceState::occupied; };
  const auto on_something = judge_support(objects, {}, measured);
  CHECK(on_something[0].verdict == kUnseen);
  CHECK(on_something[0].supported_by == std::vector<Supporter>{{SupporterKind::measured, 0}});
}

TEST_CASE("what hangs over tips, unless something lies on its other end") {
  std::vector<ReconstructedObject> objects{box_at(kCube, {0, 0, 0.025}),
                                           box_at({0.2, 0.04, 0.02}, {0.06, 0, 0.06})};
  CHECK(verdicts_of(objects) == Verdicts{kStands, kTips});
  // A weight of the cube on the end that lies on the cube.
  objects.push_back(box_at({0.05, 0.05, 0.08}, {-0.02, 0, 0.11}));
  CHECK(verdicts_of(objects) == Verdicts{kStands, kStands, kStands});
}

TEST_CASE("a plank over a gap stands on both of its pillars, and not on one") {
  std::vector<ReconstructedObject> objects{box_at(kCube, {-0.08, 0, 0.025}),
                                           box_at({0.25, 0.04, 0.02}, {0, 0, 0.06}),
                                           box_at(kCube, {0.08, 0, 0.025})};
  CHECK(verdicts_of(objects) == Verdicts{kStands, kStands, kStands});
  objects.pop_back();
  CHECK(verdicts_of(objects) == Verdicts{kStands, kTips});
}

TEST_CASE("friction holds a cube on a gentle slope and not on a steep one") {
  for (const auto& [degrees, stands] : {std::pair(15.0, true), std::pair(42.0, false)}) {
    const double angle = degrees * EIGEN_PI / 180;
    const Eigen::Matrix3d turn =
        Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitY()).toRotationMatrix();
    const KnownObject slope{"slope", std::make_shared<TriangleMesh>(box_solid({0.5, 0.5, 0.02})),
                            Pose::from_rotation(turn, {0, 0, 0.3})};
    const std::vector<ReconstructedObject> objects{
        {.type = solid_type(box_solid(kCube)),
         .T_world_object =
             Pose::from_rotation(turn, Eigen::Vector3d(0, 0, 0.3) + turn.col(2) * 0.035)}};
    CHECK((verdicts_of(objects, {slope})[0] == kStands) == stands);
  }
}

TEST_CASE("a board that leans against a wall stands by friction on the floor") {
  // Its lower edge on the floor, its upper edge at a wall: at 30 degrees from the vertical.
  const double lean = EIGEN_PI / 6, length = 0.2;
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(-lean, Eigen::Vector3d::UnitY()).toRotationMatrix();
  const double thickness = 0.01;
  const Eigen::Vector3d centre(0, 0, (length * std::cos(lean) + thickness * std::sin(lean)) / 2);
  const double reach = (length * std::sin(lean) + thickness * std::cos(lean)) / 2;
  const KnownObject wall{"wall", std::make_shared<TriangleMesh>(box_solid({0.02, 0.5, 0.5})),
                         Pose::from_translation({-reach - 0.01, 0, 0.25})};
  const std::vector<ReconstructedObject> objects{
      {.type = solid_type(box_solid({thickness, 0.1, length})),
       .T_world_object = Pose::from_rotation(turn, centre)}};
  CHECK(verdicts_of(objects, {wall}) == Verdicts{kStands});
  CHECK(verdicts_of(objects) == Verdicts{kTips});
}

TEST_CASE("solids of other shapes stand where they are at rest") {
  const Eigen::Matrix3d lying =
      Eigen::AngleAxisd(EIGEN_PI / 2, Eigen::Vector3d::UnitX()).toRotationMatrix();
  const TypePtr tin = solid_type(cylinder_solid(0.03, 0.06)), ball = solid_type(sphere_solid(0.03));
  const std::vector<ReconstructedObject> objects{
      {.type = tin, .T_world_object = Pose::from_translation({0, 0, 0.03})},
      {.type = tin, .T_world_object = Pose::from_rotation(lying, {0.2, 0, 0.03})},
      {.type = ball, .T_world_object = Pose::from_translation({0.4, 0, 0.03})}};
  CHECK(verdicts_of(objects) == Verdicts{kStands, kStands, kStands});
}

TEST_CASE("an object that reaches into the floor sinks, one in a structure below it does not") {
  const std::vector<ReconstructedObject> objects{box_at(kCube, {0, 0, 0.01})};
  CHECK(verdicts_of(objects) == Verdicts{SupportVerdict::sinks});
  const KnownObject table{"table", std::make_shared<TriangleMesh>(box_solid({0.5, 0.5, 0.02})),
                          Pose::from_translation({0, 0, -0.025})};
  CHECK(verdicts_of(objects, {table}) == Verdicts{kStands});
}

TEST_CASE("an open mesh is not judged, and carries what stands on it") {
  const TriangleMesh whole = box_solid(kCube);
  const TriangleMesh open(whole.vertices(),
                          {whole.triangles().begin() + 1, whole.triangles().end()});
  std::vector<ReconstructedObject> objects{
      {.type = solid_type(open), .T_world_object = Pose::from_translation({0, 0, 0.06})},
      box_at(kCube, {0, 0, 0.11})};
  CHECK(verdicts_of(objects) == Verdicts{SupportVerdict::unjudged, kStands});
}

TEST_CASE("what a pose leaves open is no fault") {
  ReconstructedObject object = box_at(kCube, {0, 0, 0.035});
  CHECK(verdicts_of({object}) == Verdicts{kFloats});
  object.covariance = Matrix6d::Identity() * 1e-5;  // 3.2 mm
  CHECK(verdicts_of({object}) == Verdicts{kStands});
}

TEST_CASE("the linear programme agrees with forces that were found by trying") {
  Random random(11);
  std::uint32_t standing = 0, falling = 0, right = 0;
  const std::uint32_t scenes = scene_count(60);
  for (std::uint32_t scene = 0; scene < scenes; ++scene) {
    std::vector<StackedBox> boxes;
    std::vector<ReconstructedObject> objects;
    // Two boxes of one height side by side, one across both or on one, one on top of it.
    const double height = random.uniform(0.02, 0.06);
    const double apart = random.uniform(0.045, 0.09);
    for (const double x : {-apart, apart}) {
      boxes.push_back({{random.uniform(0.03, 0.05), random.uniform(0.03, 0.05), height},
                       {x, random.uniform(-0.01, 0.01), height / 2},
                       random.uniform(0, 1)});
    }
    double z = height;
    for (int i = 0; i < 2; ++i) {
      const Eigen::Vector3d size(random.uniform(0.05, 0.22), random.uniform(0.03, 0.06),
                                 random.uniform(0.01, 0.05));
      boxes.push_back(
          {size,
           {random.uniform(-0.08, 0.08), random.uniform(-0.015, 0.015), z + size.z() / 2},
           random.uniform(-0.2, 0.2)});
      z += size.z();
    }
    for (const StackedBox& box : boxes) objects.push_back(box_at(box.size, box.centre, box.yaw));
    constexpr double kMargin_m = 0.003, kBalanced = 5e-3;
    const bool surely = plain_unbalance(boxes, -kMargin_m) < kBalanced;
    const bool possibly = plain_unbalance(boxes, kMargin_m) < kBalanced;
    if (surely != possibly) continue;
    (surely ? standing : falling)++;
    const SupportOptions strict{.friction = 0, .slack_m = 1e-4};
    const auto verdicts = verdicts_of(objects, {}, all_empty, strict);
    const bool stands = std::ranges::all_of(verdicts, [](auto v) { return v == kStands; });
    CHECK(stands == surely);
    right += stands == surely;
  }
  MESSAGE(standing, " stand, ", falling, " fall, ", right, " are right, of ", scenes);
  CHECK(standing >= enough(10));
  CHECK(falling >= enough(10));
}

TEST_CASE("objects that cannot stand become unlikely, with a warning that says why") {
  std::vector<ReconstructedObject> objects{box_at(kCube, {0, 0, 0.025}),
                                           box_at(kCube, {0.2, 0, 0.1})};
  for (ReconstructedObject& object : objects) object.probability = 0.99;
  lower_unsupported(judge_support(objects, {}, all_empty), objects);
  CHECK(objects[0].probability == 0.99);
  CHECK(objects[0].warning.empty());
  CHECK(objects[1].probability < 0.1);
  CHECK(objects[1].warning ==
        "it cannot be at rest there: it touches nothing that could hold it: its lowest point is 75 "
        "mm above the floor, and cameras see that the space below is empty");
}

}  // namespace vantage::test
