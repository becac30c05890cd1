#pragma once

#include <optional>

#include "vantage/raycore/export.hpp"

namespace vantage {

/// Occluder geometry: what hides a voxel from a camera.
enum class OccluderMode {
  mesh,    ///< the exact triangles of the known objects
  voxels,  ///< the voxels that known objects occupy, as in thesis 7.2.3
};

/// How the noise of a stereo depth sensor grows with distance:
/// σ(z) = z² · subpixel / (focal length · baseline).
///
/// Formula: Grunnet-Jepsen, Sweetser and Woodfill, "Tuning depth cameras for best performance",
/// Intel RealSense (depth RMS error). The default is their D435 at its best resolution: 848 pixels
/// across 90°, so f = 424 pixels; a baseline of 50 mm; and 0.08 pixels, which Grunnet-Jepsen
/// advises in librealsense's issue 3904. That gives 0.9 mm at 0.5 m, 3.8 mm at 1 m and 15 mm at 2
/// m.
struct StereoNoise {
  double focal_px = 424;
  double baseline_m = 0.05;
  double subpixel_px = 0.08;  ///< 0 for a sensor without noise

  double sigma_m(double depth_m) const {
    return depth_m * depth_m * subpixel_px / (focal_px * baseline_m);
  }

  /// @throws Error bad_input unless every number is finite, focal length and baseline positive, the
  /// noise not negative.
  VANTAGE_API void check() const;
  bool operator==(const StereoNoise&) const = default;
};

/// Whether thin shadow counts as free before views are planned (`without_false_shadow`).
enum class FalseShadowFilter {
  automatic,  ///< if a camera has a depth image, its depths are noisy, and thicker shadow is
              ///< left
  off,
  on,
};

/// Options of `ShadowVolume`, `classify` and planning.
struct VolumeOptions {
  OccluderMode occluders = OccluderMode::mesh;

  /// Thesis 7.2.4: shadow voxels with fewer than 5 of 6 neighbours in shadow become free.
  /// Unset: on where the occluders are voxels, whose steps cast the thin shadows that it is for.
  std::optional<bool> anti_alias = {};

  /// The band around a measured surface is max(voxel size, band_sigmas · σ(z)) thick: with 4, two
  /// sigmas to either side.
  double band_sigmas = 4;

  /// Of every camera's depths, and the only place where a request says it: classification, the mesh
  /// method and everything else that depends on noise take it from here. The default is a D435's;
  /// set your sensor's.
  StereoNoise noise = {};

  /// Noise leaves thin shadow along surfaces that cameras see. Shadow that a cube of edge
  /// `filter_m` (at least 3 voxels) does not fit into counts as such. Planning filters what was
  /// classified; `classify` and `ShadowVolume` themselves do not.
  FalseShadowFilter filter = FalseShadowFilter::automatic;
  double filter_m = 0.02;

  bool anti_aliased() const { return anti_alias.value_or(occluders == OccluderMode::voxels); }

  /// @throws Error bad_input unless the sigmas and the filter's edge are finite and not negative,
  /// and as `StereoNoise::check` does.
  VANTAGE_API void check() const;
  bool operator==(const VolumeOptions&) const = default;
};

}  // namespace vantage
