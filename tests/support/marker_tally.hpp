#pragma once

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "support/detect_markers.hpp"
#include "support/visible_marker.hpp"

namespace vantage::test {

/// How well OpenCV finds the markers that it has to find.
struct MarkerTally {
  int expected = 0;
  int missed = 0;
  std::vector<double> errors;  ///< of corners, pixels

  /// Looks for one marker among those found in an image.
  void look_for(const Marker& marker, const Pose& T_world_object, const Scene& scene,
                const PinholeCamera& camera, const std::vector<DetectedMarker>& found) {
    const auto corners = visible_corners(marker, T_world_object, scene, camera);
    if (!corners) return;
    ++expected;
    CAPTURE(marker.id);
    // Several instances of a type carry the same ids: the nearest one is meant.
    const auto distance = [&](const DetectedMarker& f) {
      return f.id == marker.id ? (f.corners[0] - (*corners)[0]).norm() : 1e9;
    };
    const auto hit =
        std::min_element(found.begin(), found.end(),
                         [&](const auto& a, const auto& b) { return distance(a) < distance(b); });
    const bool is_found = hit != found.end() && distance(*hit) < 10;
    CHECK(is_found);
    if (!is_found) {
      ++missed;
      return;
    }
    for (std::size_t c = 0; c < 4; ++c) {
      errors.push_back((hit->corners[c] - (*corners)[c]).norm());
      CAPTURE(c);
      CHECK(errors.back() < 0.5);
    }
  }

  std::string summary() {
    std::sort(errors.begin(), errors.end());
    return fmt::format(
        "{} markers, {} missed; error of corners: median {:.3f} px, 95 % {:.3f} px, max {:.3f}",
        expected, missed, errors[errors.size() / 2], errors[errors.size() * 95 / 100],
        errors.back());
  }
};

}  // namespace vantage::test
