#include "vantage/reconstruction/bop_scene.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>

#include "reconstruction/scene_folder.hpp"
#include "support/expect_error.hpp"
#include "vantage/reconstruction/color_image.hpp"

namespace vantage::test {
namespace {

void expect_entry_refused(const std::string& members, const std::string& key,
                          std::initializer_list<std::string_view> parts) {
  CAPTURE(members);
  SceneFolder scene;
  scene.entry(members).depth();
  expect_refused([&] { load_bop_scene(scene.path()); },
                 "scene_camera.json: \"7\"" + (key.empty() ? "" : ": " + key), parts);
}

void expect_json_refused(std::string_view text, std::string_view where_end,
                         std::initializer_list<std::string_view> parts) {
  CAPTURE(text.substr(0, 100));
  SceneFolder scene;
  scene.json(text).depth();
  expect_refused([&] { load_bop_scene(scene.path()); }, where_end, parts);
}

}  // namespace

TEST_CASE("a BOP scene becomes cameras with depth in metres") {
  SceneFolder folder;
  folder.good_entry().depth().color();
  const BopScene scene = load_bop_scene(folder.path(), {0.2, 5});
  REQUIRE(scene.images.size() == 1);
  const BopImage& image = scene.images[0];
  CHECK(image.id == 7);
  CHECK(image.intrinsics == Intrinsics{8, 6, 50, 60, 4, 3});
  CHECK(image.camera().range() == DepthRange{0.2, 5});
  // The inverse of (R, t/1000): the centre is -Rᵀt, the optical axis is R's last row.
  CHECK((image.camera().centre() - Eigen::Vector3d(0.1, 0.2, 2)).norm() < 1e-12);
  CHECK((image.camera().T_world_cam().rotation().col(2) + Eigen::Vector3d::UnitZ()).norm() < 1e-12);
  CHECK((image.camera().unproject(4, 3, 2) - Eigen::Vector3d(0.1, 0.2, 0)).norm() < 1e-12);
  REQUIRE(image.depth);
  CHECK(image.depth->at(5, 2) == 1.0f);  // 2000 counts of 0.5 mm
  CHECK(image.color == folder.path() / "rgb/000007.png");
  CHECK(scene.folder == folder.path());
  CHECK(scene.files == std::vector{folder.path() / "scene_camera.json",
                                   folder.path() / "depth/000007.png",
                                   folder.path() / "rgb/000007.png"});
}

TEST_CASE("a BOP scene without depth has cameras of its colour images' size") {
  SceneFolder folder;
  folder.entry(kCamK + ", " + kPose).color(10, 7);
  const BopScene scene = load_bop_scene(folder.path());
  REQUIRE(scene.images.size() == 1);
  CHECK(scene.images[0].depth == nullptr);
  CHECK(scene.images[0].intrinsics == Intrinsics{10, 7, 50, 60, 4, 3});
}

TEST_CASE("a BOP scene without images takes the size from width and height") {
  SceneFolder folder;
  folder.entry(kCamK + ", " + kPose + R"(, "width": 12, "height": 9)");
  const BopScene scene = load_bop_scene(folder.path());
  CHECK(scene.images.at(0).intrinsics == Intrinsics{12, 9, 50, 60, 4, 3});
  CHECK(scene.images.at(0).color.empty());
}

TEST_CASE("a BOP scene's images are ordered by number, not by text, and can be picked") {
  SceneFolder folder;
  const std::string entry = "{" + kGoodEntry + "}";
  folder.json(R"({"100": )" + entry + R"(, "20": )" + entry + R"(, "3": )" + entry + "}");
  folder.depth("000003.png").depth("000020.png").depth("000100.png");
  const auto ids = [](const BopScene& scene) {
    std::vector<int> all;
    for (const BopImage& image : scene.images) all.push_back(image.id);
    return all;
  };
  CHECK(ids(load_bop_scene(folder.path())) == std::vector{3, 20, 100});
  const BopScene two = load_bop_scene(folder.path(), {}, std::array{100, 3});
  CHECK(ids(two) == std::vector{3, 100});
  CHECK(two.files.size() == 3);
  expect_refused(
      [&] {
        load_bop_scene(folder.path(), {}, std::array{3, 21});
      },
      "scene_camera.json", {"image 21", "3 images", "from 3 to 100"});
}

TEST_CASE("a BOP scene that is missing is refused") {
  SceneFolder folder;
  expect_refused([&] { load_bop_scene(folder.path() / "nowhere"); }, "nowhere",
                 {"no such folder", "scene_camera.json"});
  expect_refused([&] { load_bop_scene(folder.path()); }, "scene_camera.json", {"missing"});
  folder.good_entry();
  folder.write("depth/readme.txt", "no depth here");
  expect_refused([&] { load_bop_scene(folder.path()); }, "depth/000007.png",
                 {"missing", "\"7\"", "depth folder"});
}

TEST_CASE("a scene_camera.json that is damaged is refused") {
  expect_json_refused("", "scene_camera.json", {"empty"});
  expect_json_refused("{}", "scene_camera.json", {"found {}", "one entry per image"});
  expect_json_refused("[1, 2]", "scene_camera.json", {"found [1,2]"});
  expect_json_refused("{\n \"7\": {\"cam_K\": [1,", "scene_camera.json:2:20", {"truncated"});
  expect_json_refused("{\"7\": {\"depth_scale\": NaN}}", "scene_camera.json:1:23",
                      {"invalid or truncated JSON"});
  expect_json_refused("{\"7\": {\"depth_scale\": 1e999}}", "scene_camera.json:1:27", {"1e999"});
  expect_json_refused("{\"7\": 3}", "scene_camera.json: \"7\"", {"found 3", "cam_K"});
  expect_json_refused("{\"seven\": {}}", "scene_camera.json: \"seven\"", {"not a valid image id"});
  expect_json_refused("{\"-7\": {}}", "scene_camera.json: \"-7\"", {"not a valid image id"});
  expect_json_refused("{\"99999999999\": {}}", "scene_camera.json: \"99999999999\"",
                      {"not a valid image id"});
}

TEST_CASE("a duplicate image is refused") {
  expect_json_refused("{\"7\": {}, \"7\": {}}", "scene_camera.json:1:13",
                      {"\"7\"", "twice", "remove one"});
  expect_json_refused("{\"7\": {}, \"007\": {}}", "scene_camera.json: \"7\"", {"image 7", "twice"});
  // The same key in two objects is fine; this one gets as far as image 8's missing depth.
  const std::string entry = "{" + kCamK + ", " + kScale + "}";
  expect_json_refused("{\"7\": " + entry + ", \"8\": " + entry + "}", "000008.png", {"missing"});
}

TEST_CASE("a million nested arrays are refused before they overflow the stack") {
  expect_json_refused(std::string(1'000'000, '['), "scene_camera.json:1:65", {"deeper than 64"});
  expect_json_refused("{\"a\":\n" + std::string(64, '['), "scene_camera.json:2:64",
                      {"deeper than 64"});
  // Brackets in a string are text.
  expect_json_refused("{\"\\\"" + std::string(100, '[') + "\": 1}", "\"", {"not a valid image id"});
}

TEST_CASE("an entry without what it needs is refused") {
  const std::string good = kCamK + ", " + kScale;
  expect_entry_refused(kScale + ", " + kPose, "cam_K", {"missing"});
  expect_entry_refused(kCamK + ", " + kPose, "depth_scale", {"missing"});
  expect_entry_refused(good + R"(, "cam_t_w2c": [1, 2, 3])", "cam_R_w2c", {"missing"});
  expect_entry_refused(good + R"(, "cam_R_w2c": [1, 0, 0, 0, 1, 0, 0, 0, 1])", "cam_t_w2c",
                       {"missing"});
}

TEST_CASE("a camera without a pose has to be located first") {
  SceneFolder folder;
  const BopScene scene = load_bop_scene(folder.entry(kCamK + ", " + kScale).depth().path());
  REQUIRE(scene.images.size() == 1);
  CHECK(!scene.images[0].T_world_cam);
  CHECK(scene.images[0].intrinsics == Intrinsics{8, 6, 50, 60, 4, 3});
  expect_refused([&] { scene.images[0].camera(); }, "\"7\": cam_R_w2c", {"missing", "markers"});
}

TEST_CASE("photographs are taken in the order of their names") {
  TemporaryFolder folder;
  const Intrinsics k{8, 6, 50, 60, 4, 3};
  expect_refused([&] { load_photographs(folder.path(), k); }, "", {"neither", "pictures"});
  write_png(folder.path() / "b.png", ColorImage(8, 6, 90));
  write_png(folder.path() / "a.png", ColorImage(8, 6, 90));
  folder.write("notes.txt", "no picture");
  const BopScene scene = load_photographs(folder.path(), k);
  REQUIRE(scene.images.size() == 2);
  CHECK(scene.images[0].color == folder.path() / "a.png");
  CHECK(scene.images[1].id == 1);
  CHECK(scene.files.size() == 2);
  CHECK(!scene.images[0].T_world_cam);
  write_png(folder.path() / "c.png", ColorImage(6, 8, 90));
  expect_refused([&] { load_photographs(folder.path(), k); }, "c.png", {"6 x 8", "8 x 6"});
}

TEST_CASE("an entry of the wrong type or length is refused") {
  const auto with = [](const std::string& k, const std::string& scale, const std::string& pose) {
    return k + ", " + scale + ", " + pose;
  };
  expect_entry_refused(with(R"("cam_K": [1, 2, 3])", kScale, kPose), "cam_K",
                       {"3 values, [1,2,3]", "9 numbers"});
  expect_entry_refused(with(R"("cam_K": "K")", kScale, kPose), "cam_K",
                       {"found \"K\"", "9 numbers"});
  expect_entry_refused(with(R"("cam_K": [50, 0, 4, 0, "60", 3, 0, 0, 1])", kScale, kPose), "cam_K",
                       {"\"60\"", "9 numbers"});
  expect_entry_refused(with(R"("cam_K": [50, 0, 4, 0, null, 3, 0, 0, 1])", kScale, kPose), "cam_K",
                       {"null", "9 numbers"});
  expect_entry_refused(with(kCamK, R"("depth_scale": "1")", kPose), "depth_scale",
                       {"found \"1\"", "number > 0"});
  expect_entry_refused(with(kCamK, R"("depth_scale": 0)", kPose), "depth_scale", {"found 0"});
  expect_entry_refused(with(kCamK, R"("depth_scale": -1)", kPose), "depth_scale", {"found -1"});
  expect_entry_refused(with(kCamK, kScale, R"("cam_R_w2c": [1, 0, 0], "cam_t_w2c": [0, 0, 0])"),
                       "cam_R_w2c", {"3 values", "9 numbers"});
  expect_entry_refused(
      with(kCamK, kScale, R"("cam_R_w2c": [1, 0, 0, 0, 1, 0, 0, 0, 1], "cam_t_w2c": [0, 0])"),
      "cam_t_w2c", {"2 values", "3 numbers"});
}

TEST_CASE("invalid intrinsics are refused") {
  const auto with_k = [](const std::string& k) {
    return "\"cam_K\": [" + k + "], " + kScale + ", " + kPose;
  };
  expect_entry_refused(with_k("0, 0, 4, 0, 60, 3, 0, 0, 1"), "cam_K", {"fx", "0"});
  expect_entry_refused(with_k("50, 0, 4, 0, -60, 3, 0, 0, 1"), "cam_K", {"fy", "-60"});
  expect_entry_refused(with_k("50, 0.5, 4, 0, 60, 3, 0, 0, 1"), "cam_K", {"0.5", "without skew"});
  // Column by column instead of row by row.
  expect_entry_refused(with_k("50, 0, 0, 0, 60, 0, 4, 3, 1"), "cam_K", {"row by row"});
}

TEST_CASE("a matrix that is not a rotation is refused") {
  const auto with_r = [](const std::string& r) {
    return kCamK + ", " + kScale + ", \"cam_R_w2c\": [" + r + "], \"cam_t_w2c\": [0, 0, 0]";
  };
  expect_entry_refused(with_r("1, 0, 0, 0, 2, 0, 0, 0, 1"), "cam_R_w2c", {"not a rotation"});
  expect_entry_refused(with_r("1, 0, 0, 0, 1, 0, 0, 0, -1"), "cam_R_w2c", {"reflection"});
}

TEST_CASE("the principal point of a cropped image may lie beside it") {
  SceneFolder folder;
  folder.entry(R"("cam_K": [525, 0, -19.5, 0, 525, 239.5, 0, 0, 1], )" + kScale + ", " + kPose);
  folder.depth();
  const BopScene scene = load_bop_scene(folder.path());
  CHECK(scene.images.at(0).intrinsics == Intrinsics{8, 6, 525, 525, -19.5, 239.5});
}

TEST_CASE("a scene of several sensors has a camera for each image of each") {
  SceneFolder folder;
  const auto sensor = [&](const std::string& name, int count) {
    folder.write("scene_camera_" + name + ".json", R"({"0": {)" + kGoodEntry + "}}");
    std::filesystem::create_directories(folder.path() / ("depth_" + name));
    write_png(folder.path() / ("depth_" + name) / "000000.png",
              RawDepthImage(8, 6, std::uint16_t(count)));
  };
  sensor("cam1", 2000), sensor("photoneo", 1000);
  std::filesystem::create_directories(folder.path() / "gray_photoneo");
  write_png(folder.path() / "gray_photoneo/000000.png", ColorImage(8, 6, 90));
  CHECK(is_bop_scene(folder.path()));
  const BopScene scene = load_bop_scene(folder.path());
  REQUIRE(scene.images.size() == 2);
  CHECK(scene.images[0].id == 0);
  CHECK(scene.images[1].id == 1'000'000);
  CHECK(scene.images[0].depth->at(1, 1) == 1.0f);
  CHECK(scene.images[1].depth->at(1, 1) == 0.5f);
  CHECK(scene.images[0].color.empty());
  CHECK(scene.images[1].color == folder.path() / "gray_photoneo/000000.png");
  CHECK(load_bop_scene(folder.path(), {}, std::array{1'000'000}).images.size() == 1);
}

TEST_CASE("images are found whatever their ending, and what is there instead is named") {
  SceneFolder folder;
  folder.good_entry().depth("7.PNG");
  std::filesystem::create_directories(folder.path() / "gray");
  write_png(folder.path() / "gray/000007.PNG", ColorImage(8, 6, 90));
  const BopScene scene = load_bop_scene(folder.path());
  CHECK(scene.images.at(0).color == folder.path() / "gray/000007.PNG");
  CHECK(scene.images.at(0).depth->at(1, 1) == 1.0f);
  std::filesystem::rename(folder.path() / "depth/7.PNG", folder.path() / "depth/000007.raw");
  expect_refused([&] { load_bop_scene(folder.path()); }, "depth/000007.png",
                 {"missing", "the folder has 000007.raw", ".png, .tif, .exr or .npy"});
}

TEST_CASE("depth, colour and entry have to be of one size") {
  SceneFolder folder;
  folder.good_entry().depth().color(8, 5);
  expect_refused([&] { load_bop_scene(folder.path()); }, "rgb/000007.png",
                 {"8 x 5", "8 x 6", "depth/000007.png"});

  expect_entry_refused(kGoodEntry + R"(, "width": 9, "height": 6)", "width, height",
                       {"9 x 6", "8 x 6"});
  expect_entry_refused(kGoodEntry + R"(, "width": 8)", "height", {"missing"});
  expect_entry_refused(kGoodEntry + R"(, "width": 8.5, "height": 6)", "width",
                       {"8.5", "whole number"});
  expect_entry_refused(kGoodEntry + R"(, "width": 8, "height": 1e9)", "height", {"16384"});

  SceneFolder nothing;
  nothing.good_entry();
  expect_refused([&] { load_bop_scene(nothing.path()); }, "scene_camera.json: \"7\"",
                 {"size is not known", "000007.png", "width and height", "rgb: no such folder"});
}

TEST_CASE("a depth image that is damaged or of 8 bits is refused") {
  SceneFolder folder;
  folder.good_entry().depth();
  const std::string whole = read_text(folder.path() / "depth/000007.png");
  folder.write("depth/000007.png", whole.substr(0, whole.size() / 2));
  expect_refused([&] { load_bop_scene(folder.path()); }, "depth/000007.png", {"truncated"});
  write_png(folder.path() / "depth/000007.png", ColorImage(8, 6, 1));
  expect_refused([&] { load_bop_scene(folder.path()); }, "depth/000007.png", {"8 bits", "16"});
}

TEST_CASE("an invalid depth range is refused") {
  SceneFolder folder;
  folder.good_entry().depth();
  expect_refused([&] { load_bop_scene(folder.path(), {3, 0.1}); }, "depth range", {"3", "0.1"});
}

TEST_CASE("the recordings look down at the workspace") {
  for (const char* name : {"osd_learn0", "osd_learn12", "osd_learn33", "kitchen"}) {
    CAPTURE(std::string(name));
    const auto folder = recording(name);
    if (!folder) continue;
    const BopScene scene = load_bop_scene(*folder);
    CHECK(scene.images.size() == (std::string_view(name) == "kitchen" ? 50 : 1));
    CHECK(scene.files.size() == 1 + 2 * scene.images.size());
    int known = 0, on_table = 0;
    for (const BopImage& image : scene.images) {
      CAPTURE(image.id);
      CHECK(image.camera().centre().z() > 0);
      CHECK(image.camera().T_world_cam().rotation()(2, 2) < 0);  // the optical axis points down
      REQUIRE(image.depth);
      CHECK(image.depth->width() == 640);
      CHECK(image.depth->height() == 480);
      for (int v = 0; v < 480; v += 8) {
        for (int u = 0; u < 640; u += 8) {
          const float depth = image.depth->at(u, v);
          if (!std::isfinite(depth)) continue;
          ++known;
          if (std::abs(image.camera().unproject(u, v, depth).z()) < 0.03) ++on_table;
        }
      }
    }
    // The table is the plane z = 0: a wrong pose or scale would not put measured points there.
    CHECK(known > 1000 * int(scene.images.size()));
    CHECK(on_table > known / 10);
    const ColorImage color = read_color(scene.images[0].color);
    CHECK(color.width == 640);
    CHECK(color.height == 480);
  }
}

TEST_CASE("photographs without a scene_camera.json are not a BOP scene") {
  const auto folder = recording("charuco");
  if (!folder) return;
  expect_refused([&] { load_bop_scene(*folder); }, "charuco/scene_camera.json", {"missing"});
}

}  // namespace vantage::test
