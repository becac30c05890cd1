#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>

#include "hypothesis/hypothesis_verification.hpp"

namespace vantage::detail {
namespace {

constexpr double kMarkerChiSquare = 26.1;  // 99.9 %, eight coordinates

/// The evidence of an object's fit with what its sightings may be off by, beside their noise.
Matrix6d cautious_information(const Explanation& object, const Bounds& bounds) {
  Evidence sum;
  for (const Reading* reading : object.readings) {
    sum.add(evidence_of(*reading, object.T_world_object, bounds.least_sigma_px()));
  }
  return sum.information;
}

bool view_has(const Explanation& object, std::size_t view, std::size_t feature) {
  return std::any_of(object.readings.begin(), object.readings.end(), [&](const Reading* reading) {
    return reading->sighting->id.view == view && reading->feature->index == feature;
  });
}

/// Whether the sighting lies where the object has these corners, from whichever it is counted. Less
/// is forgiven than for readings: a marker that stands before another one is not that one.
bool lies_at(const Sighting& sighting, std::vector<Eigen::Vector3d> corners,
             const Explanation& object, const Matrix6d& information, const Bounds& bounds) {
  Reading reading{&sighting, 0, object.readings.front()->feature, {}, {}};
  for (std::size_t shift = 0; shift < corners.size(); ++shift) {
    reading.points_m = corners;
    const Evidence e = evidence_of(reading, object.T_world_object, bounds.least_sigma_px());
    if (e.in_front) {
      const Eigen::LLT<Matrix6d> both(Matrix6d(information + e.information));
      const double distance = e.chi_square - e.slope.dot(both.solve(e.slope));
      if (distance <= kMarkerChiSquare) return true;
    }
    std::rotate(corners.begin(), corners.begin() + 1, corners.end());
  }
  return false;
}

/// The marker of the object for which the sighting was taken; null: none.
const ObjectFeature* really_is(const Sighting& sighting, const Explanation& object,
                               const Matrix6d& information, const Bounds& bounds) {
  const SeenPoints* seen = sighting.points();
  if (!seen || seen->pixels.size() != 4) return nullptr;
  const std::vector<ObjectFeature>& features = object.type()->features;
  for (std::size_t f = 0; f < features.size(); ++f) {
    if (!std::holds_alternative<Marker>(features[f].geometry)) continue;
    if (view_has(object, sighting.id.view, f)) continue;
    if (lies_at(sighting, features[f].points(), object, information, bounds)) return &features[f];
  }
  return nullptr;
}

}  // namespace

void reject_misread(std::vector<Candidate>& candidates, const Bounds& bounds) {
  std::vector<Matrix6d> information;
  for (const Candidate& candidate : candidates) {
    information.push_back(cautious_information(candidate.best(), bounds));
  }
  for (Candidate& doubtful : candidates) {
    const auto& readings = doubtful.best().readings;
    for (std::size_t i = 0; i < candidates.size() && doubtful.rejected.empty(); ++i) {
      const Explanation& object = candidates[i].best();
      if (object.readings.size() < 2 || object.readings.size() <= readings.size()) continue;
      const ObjectFeature* marker = nullptr;
      const bool all = std::all_of(readings.begin(), readings.end(), [&](const Reading* reading) {
        marker = really_is(*reading->sighting, object, information[i], bounds);
        return marker != nullptr;
      });
      if (!all) continue;
      doubtful.rejected = fmt::format("lies where a {} has {}: read wrongly", object.type()->name,
                                      name_of(marker->key));
    }
  }
}

}  // namespace vantage::detail
