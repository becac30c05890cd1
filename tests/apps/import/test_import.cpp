#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>

#include "import/dataset_writer.hpp"
#include "support/expect_error.hpp"
#include "support/test_data.hpp"
#include "vantage/raycore/image_io.hpp"
#include "vantage/reconstruction/bop_scene.hpp"
#include "vantage/reconstruction/calibration.hpp"

namespace vantage::test {
namespace {

namespace fs = std::filesystem;

const Intrinsics kImportIntrinsics{8, 6, 50, 60, 4, 3};

/// Two cameras that stand anywhere; what they measure, in counts, is 1000 and 2000.
std::vector<Pose> two_poses() {
  return {Pose::looking_at({0.5, -0.6, 0.7}, {0, 0, 0}),
          Pose::looking_at({-0.4, 0.3, 0.9}, {0.1, 0, 0})};
}

/// The source's pictures and depth images, called as the format wants it.
void write_images(const fs::path& folder, const std::vector<std::string>& colors,
                  const std::vector<std::string>& depths) {
  for (std::size_t i = 0; i < 2; ++i) {
    if (!colors.empty()) {
      fs::create_directories((folder / colors[i]).parent_path());
      write_png(folder / colors[i], ColorImage(8, 6, std::uint8_t(50 * i)));
    }
    fs::create_directories((folder / depths[i]).parent_path());
    write_png(folder / depths[i], RawDepthImage(8, 6, std::uint16_t(1000 * (i + 1))));
  }
}

BopScene imported(ImportedDataset dataset, const TemporaryFolder& folder,
                  const ImportChoice& choice = {}) {
  write_imported(dataset, choice, folder / "dataset", {});
  return load_bop_scene(folder / "dataset");
}

/// Whether both cameras and their depth have arrived.
void check_cameras_of(const BopScene& scene, double metres_per_count) {
  const std::vector<Pose> poses = two_poses();
  REQUIRE(scene.images.size() == 2);
  for (std::size_t i = 0; i < 2; ++i) {
    const BopImage& image = scene.images[i];
    REQUIRE(image.T_world_cam);
    CHECK((image.T_world_cam->translation() - poses[i].translation()).norm() < 1e-6);
    CHECK((image.T_world_cam->rotation() - poses[i].rotation()).norm() < 1e-6);
    CHECK(std::abs(image.intrinsics.cx - kImportIntrinsics.cx) < 1e-9);
    CHECK(std::abs(image.intrinsics.fy - kImportIntrinsics.fy) < 1e-9);
    REQUIRE(image.depth);
    CHECK(image.depth->at(2, 2) == doctest::Approx(metres_per_count * 1000 * double(i + 1)));
    CHECK_FALSE(image.color.empty());
  }
}

std::string row_text(const Eigen::Matrix4d& m, const char* column, const char* row) {
  std::string text;
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) text += fmt::format("{}{}", m(i, j), j < 3 ? column : "");
    text += i < 3 ? row : "";
  }
  return text;
}

Eigen::Matrix4d matrix_of(const Pose& pose) {
  Eigen::Matrix4d m = Eigen::Matrix4d::Identity();
  m.topLeftCorner<3, 3>() = pose.rotation(), m.topRightCorner<3, 1>() = pose.translation();
  return m;
}

fs::path tum_folder(const TemporaryFolder& folder) {
  const fs::path source = folder / "tum";
  write_images(source, {"rgb/1.000.png", "rgb/2.000.png"}, {"depth/1.013.png", "depth/1.990.png"});
  const std::vector<Pose> poses = two_poses();
  std::string text = "# timestamp tx ty tz qx qy qz qw\n";
  for (std::size_t i = 0; i < 2; ++i) {
    const Eigen::Vector3d& t = poses[i].translation();
    const Eigen::Quaterniond q = poses[i].quaternion();
    text += fmt::format("{} {} {} {} {} {} {} {}\n", 1.005 + double(i), t.x(), t.y(), t.z(), q.x(),
                        q.y(), q.z(), q.w());
  }
  folder.write("tum/groundtruth.txt", text);
  // The third picture has depth, but no pose; the fourth has neither.
  folder.write("tum/rgb.txt",
               "# colour\n1.000 rgb/1.000.png\n2.000 rgb/2.000.png\n"
               "3.000 rgb/1.000.png\n9 rgb/9.png\n");
  folder.write("tum/depth.txt",
               "1.013 depth/1.013.png\n1.990 depth/1.990.png\n"
               "3.001 depth/1.013.png\n");
  return source;
}

std::string nerf_json(const std::string& more, const std::string& frame_more = "") {
  std::string frames;
  for (std::size_t i = 0; i < 2; ++i) {
    Eigen::Matrix4d m = matrix_of(two_poses()[i]);
    m.col(1) *= -1, m.col(2) *= -1;  // OpenGL's axes
    frames += fmt::format(
        "{}{{\"file_path\": \"images/{}.png\", \"depth_file_path\": \"depth/{}.png\", "
        "\"transform_matrix\": [[{}]]{}}}",
        i ? ", " : "", i, i, row_text(m, ", ", "], ["), frame_more);
  }
  return "{" + more + ", \"frames\": [" + frames + "]}";
}

}  // namespace

TEST_CASE("a TUM RGB-D folder is imported: moments, metres and poses belong together") {
  const TemporaryFolder folder;
  const fs::path source = tum_folder(folder);
  REQUIRE(detect_tum(source));
  const ImportedDataset dataset = read_tum(source, Lens(kImportIntrinsics, {}));
  CHECK(dataset.images.size() == 2);
  REQUIRE(dataset.warnings.size() == 1);
  check_parts(dataset.warnings[0], {"left out 2 of 4", "1 without depth", "1 without a pose"});
  check_cameras_of(imported(dataset, folder), 0.0002);
  // Without intrinsics it is no camera, unless TUM published them.
  expect_refused([&] { read_tum(source, {}); }, "tum", {"--calibration"});
  fs::rename(source, folder / "rgbd_dataset_freiburg3_long");
  CHECK(read_tum(folder / "rgbd_dataset_freiburg3_long", {}).images[0].intrinsics.fx == 535.4);
  folder.write("rgbd_dataset_freiburg3_long/depth.txt", "1.0 depth/a.png\nsoon depth/b.png\n");
  expect_refused([&] { read_tum(folder / "rgbd_dataset_freiburg3_long", {}); }, "depth.txt:2",
                 {"\"soon\"", "a time in seconds"});
}

TEST_CASE("nerfstudio's transforms.json is imported: axes are OpenGL's, pixels begin at corners") {
  const TemporaryFolder folder;
  write_images(folder / "nerf", {"images/0.png", "images/1.png"}, {"depth/0.png", "depth/1.png"});
  const std::string k =
      R"("w": 8, "h": 6, "fl_x": 50, "fl_y": 60, "cx": 4.5, "cy": 3.5, "camera_model": "OPENCV")";
  folder.write("nerf/transforms.json", nerf_json(k));
  REQUIRE(detect_nerfstudio(folder / "nerf"));
  check_cameras_of(imported(read_nerfstudio(folder / "nerf"), folder), 0.001);
  CHECK_FALSE(fs::exists(folder / "dataset/calibration.yml"));

  folder.write("nerf/transforms.json", nerf_json(k + R"(, "k1": -0.1, "p2": 0.001)"));
  check_cameras_of(imported(read_nerfstudio(folder / "nerf"), folder), 0.001);
  const Lens lens = read_calibration(folder / "dataset/calibration.yml", 8, 6);
  CHECK(lens.distortion() == Distortion{-0.1, 0, 0, 0.001});

  folder.write("nerf/transforms.json", nerf_json(k, R"(, "camera_model": "EQUIRECTANGULAR")"));
  expect_refused([&] { read_nerfstudio(folder / "nerf"); }, "camera_model",
                 {"\"EQUIRECTANGULAR\""});
  folder.write("nerf/transforms.json", R"({"frames": [{"file_path": "a.png", "fl_x": 5}]})");
  expect_refused([&] { read_nerfstudio(folder / "nerf"); }, "transform_matrix", {"missing"});
}

TEST_CASE("a COLMAP text model with depth is imported: world to camera, empty lines of points") {
  const TemporaryFolder folder;
  write_images(folder / "colmap", {"images/a 1.png", "images/b.png"},
               {"depth/a 1.png", "depth/b.png"});
  std::string images = "# IMAGE_ID, QW, …\n";
  for (std::size_t i = 0; i < 2; ++i) {
    const Pose T_cam_world = two_poses()[i].inverse();
    const Eigen::Vector3d& t = T_cam_world.translation();
    const Eigen::Quaterniond q = T_cam_world.quaternion();
    images += fmt::format("{} {} {} {} {} {} {} {} 3 {}\n{}\n", i + 1, q.w(), q.x(), q.y(), q.z(),
                          t.x(), t.y(), t.z(), i ? "b.png" : "a 1.png", i ? "" : "1 2 -1");
  }
  folder.write("colmap/sparse/0/images.txt", images);
  const auto with_camera = [&](const std::string& camera) {
    folder.write("colmap/sparse/0/cameras.txt", "# cameras\n3 " + camera + "\n");
    REQUIRE(detect_colmap(folder / "colmap"));
    return read_colmap(folder / "colmap");
  };
  check_cameras_of(imported(with_camera("PINHOLE 8 6 50 60 4.5 3.5"), folder), 0.001);
  check_cameras_of(imported(with_camera("OPENCV_FISHEYE 8 6 50 60 4.5 3.5 0.1 0 0 0"), folder),
                   0.001);
  CHECK(read_calibration(folder / "dataset/calibration.yml").distortion() ==
        Distortion::fisheye(0.1, 0, 0, 0));
  CHECK(with_camera("SIMPLE_RADIAL 8 6 50 4.5 3.5 -0.2").images[0].distortion == Distortion{-0.2});
  CHECK(with_camera("FULL_OPENCV 8 6 50 60 4.5 3.5 1 2 3 4 5 6 7 8").images[0].distortion ==
        Distortion{1, 2, 3, 4, 5, 6, 7, 8});
  CHECK(imported(with_camera("PINHOLE 8 6 50 60 4.5 3.5"), folder,
                 {.images = {}, .depth_scale_mm = 0.5})
            .images[0]
            .depth->at(0, 0) == 0.5f);
  expect_refused([&] { with_camera("FOV 8 6 50 60 4.5 3.5 0.1"); }, "cameras.txt:2",
                 {"FOV is not supported"});
  expect_refused([&] { with_camera("PINHOLE 8 6 50 sixty 4.5 3.5"); }, "cameras.txt:2",
                 {"\"sixty\""});
  fs::remove(folder / "colmap/images/b.png");
  const auto warnings = with_camera("PINHOLE 8 6 50 60 4.5 3.5").warnings;
  CHECK(warnings.at(0).find("1 of 2 pictures are not there") != std::string::npos);
  fs::remove(folder / "colmap/depth/b.png");
  expect_refused([&] { with_camera("PINHOLE 8 6 50 60 4.5 3.5"); }, "images/b.png",
                 {"missing", "images.txt:4"});
}

TEST_CASE("ScanNet's export is imported, and images without a pose are left out with a word") {
  const TemporaryFolder folder;
  write_images(folder / "scan", {"color/0.png", "color/2.png"}, {"depth/0.png", "depth/2.png"});
  folder.write("scan/intrinsic/intrinsic_depth.txt", "50 0 4 0\n0 60 3 0\n0 0 1 0\n0 0 0 1\n");
  folder.write("scan/pose/0.txt", row_text(matrix_of(two_poses()[0]), " ", "\n"));
  folder.write("scan/pose/2.txt", row_text(matrix_of(two_poses()[1]), " ", "\n"));
  folder.write("scan/pose/1.txt",
               "-inf -inf -inf -inf\n-inf -inf -inf -inf\n"
               "-inf -inf -inf -inf\n-inf -inf -inf -inf\n");
  REQUIRE(detect_scannet(folder / "scan"));
  const ImportedDataset dataset = read_scannet(folder / "scan");
  REQUIRE(dataset.warnings.size() == 1);
  check_parts(dataset.warnings[0], {"left out 1 images", "the first being 1", "tracking was lost"});
  check_cameras_of(imported(dataset, folder), 0.001);

  // Colour of another size shares no intrinsics with depth.
  write_png(folder / "scan/color/0.png", ColorImage(16, 12, 9));
  write_png(folder / "scan/color/2.png", ColorImage(16, 12, 9));
  const BopScene without = imported(read_scannet(folder / "scan"), folder);
  CHECK(without.images.at(0).color.empty());
  CHECK(without.images.at(0).intrinsics.width == 8);
}

TEST_CASE("images are chosen by number, and nothing of somebody else's is overwritten") {
  const TemporaryFolder folder;
  ImportedDataset dataset = read_tum(tum_folder(folder), Lens(kImportIntrinsics, {}));
  const BopScene second = imported(dataset, folder, {.images = {1}});
  REQUIRE(second.images.size() == 1);
  CHECK(second.images[0].id == 1);
  CHECK(imported(dataset, folder, {.every = 2}).images.size() == 1);
  expect_bad_input("--images", "there is no image 2; there are 2",
                   [&] { imported(dataset, folder, {.images = {2}}); });
  folder.write("mine/notes.txt", "mine");
  expect_bad_input("mine", "not empty", [&] { write_imported(dataset, {}, folder / "mine", {}); });
  CHECK(read_text(folder / "mine/notes.txt") == "mine");
  fs::remove(folder / "tum/depth/1.013.png");
  expect_bad_input("1.013.png", "missing", [&] { imported(dataset, folder); });
  // The earlier import is there as it was.
  CHECK(load_bop_scene(folder / "dataset").images.size() == 1);
  CHECK(fs::is_regular_file(folder / "dataset/import.json"));
}

TEST_CASE("an import takes the place of an earlier one, and of one that was killed") {
  const TemporaryFolder folder;
  ImportedDataset dataset = read_tum(tum_folder(folder), Lens(kImportIntrinsics, {}));
  folder.write("dataset/.unfinished_import/depth/000000.png", "half a pic");
  CHECK(imported(dataset, folder).images.size() == 2);
  CHECK(imported(dataset, folder, {.every = 2}).images.size() == 1);
  CHECK_FALSE(fs::exists(folder / "dataset/.unfinished_import"));
  CHECK_FALSE(fs::exists(folder / "dataset/depth/000001.png"));
}

TEST_CASE("an import that fails or is interrupted leaves nothing, and can be done again") {
  const TemporaryFolder folder;
  ImportedDataset dataset = read_tum(tum_folder(folder), Lens(kImportIntrinsics, {}));
  const fs::path image = dataset.images[1].depth, away = folder / "away.png";
  fs::rename(image, away);
  expect_bad_input(image.filename().string(), "missing",
                   [&] { write_imported(dataset, {}, folder / "dataset", {}); });
  CHECK_FALSE(fs::exists(folder / "dataset"));
  fs::rename(away, image);
  const StopToken stop;
  stop.cancel();
  expect_error(ErrorCode::cancelled, "import", "interrupted",
               [&] { write_imported(dataset, {}, folder / "dataset", stop); });
  CHECK_FALSE(fs::exists(folder / "dataset"));
  CHECK(imported(dataset, folder).images.size() == 2);
}

TEST_CASE("an import copies images only, of cameras that are somewhere") {
  const TemporaryFolder folder;
  const ImportedDataset dataset = read_tum(tum_folder(folder), Lens(kImportIntrinsics, {}));
  ImportedDataset secret = dataset, far = dataset;
  secret.images[1].color = folder.write("passwords", "root");
  expect_bad_input("passwords", "by its ending it is none",
                   [&] { write_imported(secret, {}, folder / "dataset", {}); });
  far.images[1].T_world_cam = Pose::from_translation({1e300, 0, 0});
  expect_bad_input(far.images[1].name, "its camera is at (1e+300, 0, 0) m",
                   [&] { write_imported(far, {}, folder / "dataset", {}); });
  CHECK_FALSE(fs::exists(folder / "dataset"));
}

}  // namespace vantage::test
