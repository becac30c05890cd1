#include "reasoning/marker_scale.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>

namespace vantage::reconstruction::detail {
namespace {

/// Where a single camera has an object, as seen from it.
struct Sighting {
  Eigen::Vector3d eye, offset;
  std::size_t view;

  Eigen::Vector3d at(double factor) const { return eye + factor * offset; }
};

std::optional<std::size_t> only_view(const ReconstructedObject& object) {
  for (const Support& support : object.support) {
    if (support.id.view != object.support.front().id.view) return std::nullopt;
  }
  return object.support.front().id.view;
}

std::optional<Sighting> sighting_of(std::span<const CameraView> views,
                                    const ReconstructedObject& object) {
  const auto view = only_view(object);
  if (!view) return std::nullopt;
  const Eigen::Vector3d& eye = views[*view].T_world_cam->translation();
  return Sighting{eye, object.T_world_object.translation() - eye, *view};
}

/// The factor by which two sightings come closest: least squares of a line.
std::optional<double> common_factor(const Sighting& a, const Sighting& b) {
  constexpr double kClose = 0.1;  // of how far apart they are as they stand
  const Eigen::Vector3d across = a.offset - b.offset, between = b.eye - a.eye;
  if (!(across.squaredNorm() > 0)) return std::nullopt;
  const double factor = across.dot(between) / across.squaredNorm();
  const double left = (factor * across - between).norm();
  const double apart = (across - between).norm();
  if (!(factor > 0.2 && factor < 5) || std::abs(factor - 1) < 0.02 || left > kClose * apart) {
    return std::nullopt;
  }
  return factor;
}

}  // namespace

std::optional<FittingSize> fitting_size(std::span<const CameraView> views,
                                        std::span<const ReconstructedObject* const> objects,
                                        const TypePtr& type) {
  std::vector<Sighting> sightings;
  for (const ReconstructedObject* object : objects) {
    const auto sighting = object->type == type ? sighting_of(views, *object) : std::nullopt;
    if (sighting) sightings.push_back(*sighting);
  }
  for (std::size_t a = 0; a < sightings.size(); ++a) {
    for (std::size_t b = a + 1; b < sightings.size(); ++b) {
      if (sightings[a].view == sightings[b].view) continue;
      const auto factor = common_factor(sightings[a], sightings[b]);
      if (!factor) continue;
      return FittingSize{
          *factor, sightings[a].at(*factor),
          fmt::format("; images {} and {} would have it at one place if its sizes (size_m) were "
                      "{:.3f} times those of the knowledge base",
                      views[sightings[a].view].name, views[sightings[b].view].name, *factor)};
    }
  }
  return std::nullopt;
}

bool comes_there(std::span<const CameraView> views, const ReconstructedObject& object,
                 const FittingSize& size) {
  constexpr double kClose = 0.2;  // of the way that the other size moves it
  const auto sighting = sighting_of(views, object);
  if (!sighting) return false;
  const double moved = std::abs(size.factor - 1) * sighting->offset.norm();
  return (sighting->at(size.factor) - size.place_m).norm() < kClose * moved;
}

}  // namespace vantage::reconstruction::detail
