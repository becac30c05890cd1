#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "vantage/raycore/export.hpp"
#include "vantage/raycore/image.hpp"
#include "vantage/raycore/lens.hpp"
#include "vantage/reconstruction/observation.hpp"

namespace vantage {

/// Finds features in an image (thesis, section 5.1.1). Derive from it to put in another one.
class VANTAGE_API Detector {
 public:
  virtual ~Detector() = default;

  /// In an order that depends on the image alone. May be called from many threads at once.
  virtual std::vector<Observation> detect(const ColorImage& image) const = 0;
};

/// How to look for markers.
struct ArucoOptions {
  /// Names as `marker_dictionaries` has them; of each `marker_family` one.
  std::vector<std::string> dictionaries;
  /// Of the camera whose images these are. Through a lens the sides of a marker are no straight
  /// lines: one of 100 pixels in the corner of an image with k1 = -0.3 is up to 0.7 px off without
  /// it. The corners are those on the image either way.
  std::optional<Lens> lens = {};
};

/// OpenCV's ArUco detector, with corners from a fit of the marker's whole pattern to the image.
/// What turns out not to lie where its corners say is left out. `sigma_px` is what the fit tells:
/// the root mean square over the four corners. Images are sRGB; another gamma, glow and ink that
/// has run are compensated. White markers on black are found, too, where an image has two or more.
/// Sorted by key, then from left to right, then from top to bottom.
class VANTAGE_API ArucoDetector final : public Detector {
 public:
  /// @throws Error bad_input, "dictionaries" as the place, for a name that OpenCV does not have,
  /// for two of a family, and for none at all.
  explicit ArucoDetector(const ArucoOptions& options);
  ~ArucoDetector() override;

  /// @throws Error bad_input, "image" as the place, for an image of another size than the lens'.
  std::vector<Observation> detect(const ColorImage& image) const override;

 private:
  struct Impl;
  std::unique_ptr<const Impl> impl_;
};

}  // namespace vantage
