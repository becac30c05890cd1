// Folders of BOP models as knowledge bases. tests/apps has the way there and back.
#include <doctest/doctest.h>

#include <string>

#include "support/expect_error.hpp"
#include "support/test_data.hpp"
#include "vantage/raycore/mesh_io.hpp"
#include "vantage/raycore/solids.hpp"
#include "vantage/reconstruction/knowledge_base.hpp"

namespace vantage::test {
namespace {

namespace fs = std::filesystem;

/// Models are boxes of 100 x 200 x 300 mm.
class ModelFolder {
 public:
  explicit ModelFolder(std::string_view info, std::initializer_list<int> models = {1}) {
    folder_.write("models_info.json", info);
    for (const int id : models) {
      write_ply(folder_ / ("obj_00000" + std::to_string(id) + ".ply"), box_solid({100, 200, 300}));
    }
  }
  const fs::path& path() const { return folder_.path(); }
  FileKnowledgeBase read() const { return FileKnowledgeBase({folder_.path()}); }

 private:
  TemporaryFolder folder_;
};

void expect_info_refused(const std::string& info, std::string_view where,
                         std::initializer_list<std::string_view> parts) {
  CAPTURE(info);
  const ModelFolder folder(info);
  expect_refused([&] { folder.read(); }, where, parts);
}

std::string with_discrete(const std::string& matrix) {
  return R"({"1": {"symmetries_discrete": [)" + matrix + "]}}";
}

std::string with_continuous(const std::string& line) {
  return R"({"1": {"symmetries_continuous": [)" + line + "]}}";
}

}  // namespace

TEST_CASE("a folder of BOP models gives types in metres, in the order of their ids") {
  const ModelFolder folder(R"({
    "9": {"diameter": 374.2},
    "3": {"diameter": 374.2,
          "symmetries_discrete": [[0, -1, 0, 20,  1, 0, 0, -40,  0, 0, 1, 0,  0, 0, 0, 1]],
          "symmetries_continuous": [{"axis": [0, 0, 2], "offset": [10, 0, 5]},
                                    {"axis": [1, 0, 0]}]}})",
                           {3, 9});
  const FileKnowledgeBase base = folder.read();
  REQUIRE(base.types().size() == 2);
  const ObjectType& type = *base.types()[0];
  CHECK(type.name == "obj_000003");
  CHECK(type.bop_id == 3);
  CHECK(base.types()[1]->name == "obj_000009");
  CHECK(base.files() == std::vector{folder.path() / "models_info.json",
                                    folder.path() / "obj_000003.ply",
                                    folder.path() / "obj_000009.ply"});
  Eigen::AlignedBox3d bounds;
  for (const Eigen::Vector3f& p : type.mesh->vertices()) bounds.extend(p.cast<double>());
  CHECK(bounds.max().isApprox(Eigen::Vector3d(0.05, 0.1, 0.15), 1e-6));
  REQUIRE(type.symmetries.discrete.size() == 1);
  const Pose& quarter_turn = type.symmetries.discrete[0];
  CHECK(
      (quarter_turn * Eigen::Vector3d(0.01, 0.02, 0.03) - Eigen::Vector3d(0, -0.03, 0.03)).norm() <
      1e-12);
  REQUIRE(type.symmetries.continuous.size() == 2);
  CHECK(type.symmetries.continuous[0].axis == Eigen::Vector3d::UnitZ());
  CHECK((type.symmetries.continuous[0].offset_m - Eigen::Vector3d(0.01, 0, 0.005)).norm() < 1e-15);
  CHECK(type.symmetries.continuous[1].offset_m.norm() == 0);
  CHECK(base.types()[1]->symmetries.none());
}

TEST_CASE("a BOP model is recognised by its pose") {
  const ModelFolder folder(R"({"1": {}})");
  const FileKnowledgeBase base = folder.read();
  const auto& found = base.with_feature({"pose", "obj_000001"});
  REQUIRE(found.size() == 1);
  const ObjectFeature& feature = found[0].type->features[found[0].index];
  const auto* pose = std::get_if<FeaturePose>(&feature.geometry);
  REQUIRE(pose != nullptr);
  CHECK(pose->T_object_feature.rotation() == Eigen::Matrix3d::Identity());
  CHECK(pose->T_object_feature.translation().norm() == 0);
}

TEST_CASE("folders and files make one knowledge base") {
  const ModelFolder folder(R"({"1": {}})");
  const TemporaryFolder other;
  const fs::path file = other.write("types.yaml",
                                    "object_types: [{name: a, shape: {sphere: {radius_m: 1}}}]\n"
                                    "hierarchy: {obj_000001: [box]}\n");
  const FileKnowledgeBase base({folder.path(), file});
  CHECK(base.types().size() == 2);
  CHECK(base.is_a("obj_000001", "box"));
  expect_refused(
      [&] {
        FileKnowledgeBase({folder.path(), folder.path()});
      },
      "models_info.json: \"1\"", {"\"obj_000001\"", "already used"});
}

TEST_CASE("models that are missing or damaged are refused") {
  const TemporaryFolder empty;
  expect_refused([&] { FileKnowledgeBase({empty.path()}); }, "models_info.json",
                 {"missing", "obj_000001.ply"});
  const ModelFolder without(R"({"1": {}, "2": {}})");
  expect_refused([&] { without.read(); }, "models_info.json: \"2\"", {"no obj_000002.ply"});
  const ModelFolder damaged(R"({"2": {}})", {});
  write_ply(damaged.path() / "obj_000002.ply", box_solid({1, 1, 1}));
  fs::resize_file(damaged.path() / "obj_000002.ply", 300);
  CHECK_THROWS_WITH_AS(damaged.read(), doctest::Contains("obj_000002.ply"), Error);
}

TEST_CASE("an invalid models_info.json is refused") {
  expect_info_refused("{", "models_info.json:1:2", {"invalid or truncated JSON"});
  expect_info_refused("[1]", "models_info.json", {"found [1]", "one entry per model"});
  expect_info_refused(R"({"one": {}})", "models_info.json: \"one\"", {"not a valid model id"});
  expect_info_refused(R"({"1": {}, "01": {}})", "models_info.json: \"1\"", {"model 1", "twice"});
  expect_info_refused(R"({"1": 5})", "models_info.json: \"1\"", {"found 5", "an object"});
}

TEST_CASE("invalid symmetries are refused") {
  const std::string at = "models_info.json: \"1\": symmetries_discrete";
  expect_info_refused(R"({"1": {"symmetries_discrete": 3}})", at, {"found 3", "a list"});
  expect_info_refused(with_discrete("[1, 0, 0, 0, 1, 0, 0, 0, 1]"), at + "[0]",
                      {"9 values", "16 numbers"});
  expect_info_refused(with_discrete("[2, 0, 0, 0,  0, 1, 0, 0,  0, 0, 1, 0,  0, 0, 0, 1]"),
                      at + "[0]", {"rotation"});
  expect_info_refused(with_discrete("[-1, 0, 0, 0,  0, -1, 0, 0,  0, 0, 1, 0,  5, 0, 0, 1]"),
                      at + "[0]", {"last row 5, 0, 0, 1", "row by row"});
  const std::string line = "models_info.json: \"1\": symmetries_continuous[0]";
  expect_info_refused(with_continuous("[0, 0, 1]"), line, {"[0,0,1]", "\"axis\""});
  expect_info_refused(with_continuous(R"({"offset": [0, 0, 0]})"), line, {"\"axis\""});
  expect_info_refused(with_continuous(R"({"axis": [0, 0]})"), line + ".axis", {"3 numbers"});
  expect_info_refused(with_continuous(R"({"axis": [0, 0, 0]})"), line + ".axis", {"no direction"});
  expect_info_refused(with_continuous(R"({"axis": [0, 0, 1], "offset": 3})"), line + ".offset",
                      {"found 3", "3 numbers"});
}

}  // namespace vantage::test
