#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "vantage/planner/plan.hpp"
#include "vantage/raycore/camera.hpp"
#include "vantage/raycore/image.hpp"
#include "vantage/raycore/stop_token.hpp"
#include "vantage/raycore/world_model.hpp"

namespace vantage {

/// The viewpoint for the overview of a plan that has a grid: from above, beside the suggested
/// camera, far enough away for a calm perspective. The focal length and the principal point are
/// such that the work area and all cameras fill the picture of `width` × 5/8 `width` pixels.
PinholeCamera overview_camera(const Plan& plan, const WorldModel& world, int width);

/// Pictures of a plan that has a grid. Occupied voxels are green, shadow red, what the suggested
/// views reveal cyan and half transparent, the given cameras grey, the suggested ones red. What
/// stands outside the work area is faint.

enum class PictureQuality {
  draft,  ///< half of the pixels along each side, enlarged, and few samples of them
  final,
};

/// The work area from outside, with all cameras and their frusta, but without words;
/// `width` × 5/8 `width` pixels. Nothing if it was stopped.
std::optional<ColorImage> overview(const Plan& plan, const WorldModel& world, int width,
                                   const StopToken& stop = {});

/// All pictures of a plan: overview.png, with a legend and, if there are several, the numbers of
/// the suggested cameras; view.png, what the first of them would see; view_2.png and so on of the
/// others. Refers to the plan and the world. To be used in the caller's task arena.
class PlanPictures {
 public:
  /// @param width of the overview, pixels; views have the camera's size.
  PlanPictures(const Plan& plan, const WorldModel& world, int width, PictureQuality quality);
  ~PlanPictures();

  std::size_t count() const;
  const std::string& name(std::size_t picture) const;

  /// By how much `draw` advances its token; to expect it is up to the caller.
  std::uint64_t steps(std::size_t picture) const;

  /// Nothing if it was stopped.
  std::optional<ColorImage> draw(std::size_t picture, const StopToken& stop) const;

 private:
  struct Picture;
  const Plan& plan_;
  const WorldModel& world_;
  std::vector<Picture> pictures_;
};

/// What the overview shows as a glTF model, to turn around in a viewer.
void write_scene_model(const std::filesystem::path& path, const Plan& plan,
                       const WorldModel& world);

}  // namespace vantage
