#pragma once

#include <memory>
#include <string>
#include <vector>

#include "vantage/raycore/api.hpp"
#include "vantage/raycore/image.hpp"
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
  std::vector<std::string>
      dictionaries;  ///< names as `marker_dictionaries` has them; one of a family
};

/// OpenCV's ArUco detector, with corners refined by lines through the markers' sides. Sorted by
/// key, then from left to right.
class VANTAGE_API ArucoDetector final : public Detector {
 public:
  /// @throws Error bad_input, "dictionaries" as the place, for a name that OpenCV does not have and
  /// for none at all.
  explicit ArucoDetector(const ArucoOptions& options);
  ~ArucoDetector() override;

  std::vector<Observation> detect(const ColorImage& image) const override;

 private:
  struct Impl;
  std::unique_ptr<const Impl> impl_;
};

}  // namespace vantage
