#pragma once

#include <Eigen/Core>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "documents/document_value.hpp"
#include "vantage/reconstruction/marker.hpp"

namespace vantage {

/// Reads one of a type's `features`.
/// @param box_size_m  of the object, if it is a box around its origin: only then it has faces.
/// @throws Error bad_input for a dictionary or an id that OpenCV does not have, and a `face` of
/// something that is no box.
Marker read_marker(const Value& feature, const std::optional<Eigen::Vector3d>& box_size_m);

/// @throws Error bad_input with the place of the key for a dictionary that OpenCV does not have or
/// an id outside of it.
void check_marker(const Value& dictionary, const Value& id);

/// How finely to print markers: at 160 texels along the smallest one's edge, a camera that sees it
/// well enough sees no texels.
double texel_for(std::span<const Marker> markers);

/// The markers that are taken, and by whom. Dictionaries of one family share their first markers:
/// 4X4_50's are the first 50 of 4X4_1000, so that a camera cannot tell one from the other.
class MarkerOwners {
 public:
  /// @throws Error bad_input at `place` if somebody else has the marker; the message says who.
  void take(const Marker& marker, const std::string& owner, const std::string& place);

 private:
  std::map<std::pair<std::string, int>, std::string> owners_;  // family, id → owner
};

}  // namespace vantage
