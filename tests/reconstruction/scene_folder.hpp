#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "support/test_data.hpp"
#include "vantage/raycore/image_io.hpp"

namespace vantage::test {

inline const std::string kCamK = R"("cam_K": [50, 0, 4, 0, 60, 3, 0, 0, 1])";
inline const std::string kScale = R"("depth_scale": 0.5)";
/// The camera looks down from 2 m above the world's point (0.1, 0.2, 0); image x is world x.
inline const std::string kPose =
    R"("cam_R_w2c": [1, 0, 0, 0, -1, 0, 0, 0, -1], "cam_t_w2c": [-100, 200, 2000])";
inline const std::string kGoodEntry = kCamK + ", " + kScale + ", " + kPose;

/// A BOP scene folder that a test fills, or breaks.
class SceneFolder {
 public:
  const std::filesystem::path& path() const { return folder_.path(); }

  /// The text of scene_camera.json.
  SceneFolder& json(std::string_view text) {
    folder_.write("scene_camera.json", text);
    return *this;
  }

  /// scene_camera.json with one image, 7.
  SceneFolder& entry(const std::string& members) { return json("{\"7\": {" + members + "}}"); }

  SceneFolder& good_entry() { return entry(kGoodEntry); }

  SceneFolder& depth(std::string_view name = "000007.png", int width = 8, int height = 6,
                     std::uint16_t count = 2000) {
    std::filesystem::create_directories(path() / "depth");
    write_png(path() / "depth" / name, RawDepthImage(width, height, count));
    return *this;
  }

  SceneFolder& color(int width = 8, int height = 6) {
    std::filesystem::create_directories(path() / "rgb");
    write_png(path() / "rgb/000007.png", ColorImage(width, height, 90));
    return *this;
  }

  std::filesystem::path write(std::string_view name, std::string_view bytes) const {
    return folder_.write(name, bytes);
  }

 private:
  TemporaryFolder folder_;
};

}  // namespace vantage::test
