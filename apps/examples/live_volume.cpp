// A depth camera delivers frame after frame while a hand moves through the cell: the volume is
// updated with each of them, and no ray is traced again.
#include <cstdio>
#include <vantage/volume/shadow_volume.hpp>

namespace {

constexpr vantage::Intrinsics kIntrinsics{320, 240, 300, 300, 159.5, 119.5};

/// Stands in for a sensor above the table: the table is 1 m away, and a hand of 80 × 80 pixels at
/// 0.8 m moves to the right from frame to frame.
std::shared_ptr<const vantage::DepthImage> next_depth_image(int frame) {
  auto depth = std::make_shared<vantage::DepthImage>(kIntrinsics.width, kIntrinsics.height);
  const int left = 20 + 40 * frame;
  for (int v = 0; v < kIntrinsics.height; ++v) {
    for (int u = 0; u < kIntrinsics.width; ++u) {
      const bool hand = u >= left && u < left + 80 && v >= 80 && v < 160;
      depth->set(u, v, hand ? 0.8f : 1.0f);
    }
  }
  return depth;
}

}  // namespace

int main() {
  const auto T_world_cam = vantage::Pose::looking_at({0, 0, 1}, {0, 0, 0});
  const vantage::Box work_area({-0.3, -0.3, 0}, {0.3, 0.3, 0.4});

  vantage::WorldModel world;
  world.cameras.push_back({"above", vantage::PinholeCamera(kIntrinsics, T_world_cam), nullptr});

  vantage::ShadowVolume volume(world, vantage::GridGeometry::covering(work_area, 0.01));
  for (int frame = 0; frame < 5; ++frame) {
    volume.set_depth(0, next_depth_image(frame));
    const auto grid = volume.grid();  // immutable: planners may go on reading an older one
    std::printf("frame %d: %.2f litres in the shadow, %.2f litres of surface\n", frame,
                1e3 * grid->volume_m3(vantage::VoxelState::shadow),
                1e3 * grid->volume_m3(vantage::VoxelState::occupied));
  }
}
