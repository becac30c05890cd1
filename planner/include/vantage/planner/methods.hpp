#pragma once

#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "vantage/raycore/export.hpp"
#include "vantage/volume/visibility_options.hpp"

namespace vantage {

/// Scores views by the volume of the shadow voxels that they would see (thesis 7.2.5).
struct VoxelMethod {
  static constexpr std::string_view kName = "voxel";

  void check() const {}
  bool operator==(const VoxelMethod&) const = default;
};

/// Scores views by the shadow on their images, far pixels more (thesis 7.3).
struct ShadowMethod {
  static constexpr std::string_view kName = "shadow";

  double depth_power = 6;  ///< pixels count depth^power; 0, 3 and 6 are the thesis' D0, D3 and D6

  /// @throws Error bad_input unless 0 <= depth_power <= 16.
  VANTAGE_API void check() const;
  bool operator==(const ShadowMethod&) const = default;
};

/// What a pixel counts that meets what no camera saw through at depth D.
enum class MeshWeight {
  depth,   ///< D^power (thesis 7.4.5, D6): surfaces, the far ones more
  volume,  ///< the volume behind, to where the shadow ends or a known object is; the power is not
           ///< used
};

/// Scores views by what no depth image shows, whatever stands there (thesis 7.4). How noisy depths
/// are is not said here, but once for all of a request: `VolumeOptions::noise`.
struct MeshMethod {
  static constexpr std::string_view kName = "mesh";

  VisibilityOptions visibility = {};
  /// What is unseen, but a cube of this edge does not fit in, is false shadow that noise made, and
  /// counts as seen; metres. 0: all that is unseen counts. In work areas of more than 17 million
  /// voxels of a third of it, the cube is larger.
  double opening_m = 0.025;
  /// Known objects, about their middle, for what is imprecise (thesis 7.4.4).
  double enlarge = 1.2;
  MeshWeight weight = MeshWeight::volume;
  double depth_power = 6;  ///< as the shadow method's
  int image_width = 160;   ///< of the images that views are scored by; their height follows

  /// Up to this many views, servo iterations included, all are scored by rays. If there are more,
  /// the voxel method in a carved grid (by depth: the shadow method) picks a shortlist, and only
  /// that is scored: the best view may then be missed.
  int exact_views = 40000;
  int shortlist = 100;
  double shortlist_voxel_m = 0.0047;

  /// @throws Error bad_input unless opening_m is finite and not negative, 1 <= enlarge <= 10, 0 <=
  /// depth_power <= 16, 16 <= image_width <= 16384, 0 <= exact_views, 1 <= shortlist and 0 <
  /// shortlist_voxel_m, and as `VisibilityOptions::check` does.
  VANTAGE_API void check() const;
  bool operator==(const MeshMethod&) const = default;
};

/// Scores views by the unlit surface that they would light (thesis 7.1), to compare with.
struct LightMethod {
  static constexpr std::string_view kName = "light";

  void check() const {}
  bool operator==(const LightMethod&) const = default;
};

/// Which method scores the views, and how.
using Method = std::variant<VoxelMethod, ShadowMethod, MeshMethod, LightMethod>;

/// @throws Error bad_input as the method's own `check` does.
VANTAGE_API void check(const Method& method);

/// Its name on the command line and in plan.json.
VANTAGE_API std::string_view name_of(const Method& method);

/// The names of all methods.
VANTAGE_API const std::vector<std::string>& method_names();

/// A method with its usual options, by its name.
/// @throws Error bad_input for a name that is none of `method_names()`.
VANTAGE_API Method method_named(std::string_view name);

}  // namespace vantage
