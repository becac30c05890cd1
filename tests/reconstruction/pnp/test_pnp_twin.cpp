#include <doctest/doctest.h>

#include "reconstruction/synthetic_views.hpp"
#include "reference/plain_instances.hpp"
#include "support/scene_count.hpp"
#include "vantage/reconstruction/reconstruct.hpp"

using namespace vantage;
using namespace vantage::test;

namespace {

/// The observations that the twin gets: a few, or it takes too long.
std::vector<PlainSighting> plain_sightings(const std::vector<CameraView>& views,
                                           const ObjectType& type) {
  std::vector<PlainSighting> measurements;
  for (std::size_t v = 0; v < views.size(); ++v) {
    for (const Observation& observation : views[v].observations) {
      for (std::size_t f = 0; f < type.features.size(); ++f) {
        if (type.features[f].key != observation.key) continue;
        measurements.push_back({&views[v].lens, *views[v].T_world_cam, int(v), int(f),
                                type.features[f].points(),
                                std::get<SeenPoints>(observation.data).pixels});
      }
    }
  }
  return measurements;
}

std::vector<std::size_t> numbers_of(const ReconstructedObject& object,
                                    const std::vector<CameraView>& views) {
  std::vector<std::size_t> numbers;
  for (const Support& support : object.support) {
    std::size_t number = support.id.observation;
    for (std::size_t v = 0; v < support.id.view; ++v) number += views[v].observations.size();
    numbers.push_back(number);
  }
  return numbers;
}

}  // namespace

TEST_CASE("PnP: the same objects as when every way to divide the sightings is tried") {
  const MemoryKnowledgeBase knowledge({marked_box("cube", {0.06, 0.06, 0.06}, 0, 4)});
  const ObjectType& type = *knowledge.types()[0];
  std::size_t compared = 0, several = 0;
  for (std::uint32_t seed = 1; seed <= scene_count(18); ++seed) {
    CAPTURE(seed);
    Random random(seed);
    auto views = cameras_around(random, 3, 0.5);
    const auto objects = scattered(random, knowledge.types(), 2, 0.09);
    look_at(views, objects, {.sigma_px = 0.2}, random);
    const auto measurements = plain_sightings(views, type);
    if (measurements.empty() || measurements.size() > 6) continue;
    const Reconstruction result = reconstruct_pnp(views, knowledge);
    const auto twins = plain_instances(measurements, 3.0);
    REQUIRE(result.objects.size() == twins.size());
    ++compared;
    several += twins.size() > 1;
    for (std::size_t i = 0; i < twins.size(); ++i) {
      const ReconstructedObject& found = result.objects[i];
      CHECK(numbers_of(found, views) == twins[i].measurements);
      if (found.support.size() < 2) continue;  // a single marker may be flipped
      const PoseError error = pose_error(type, found.T_world_object, twins[i].T_world_object);
      CHECK(error.m < 5e-5);  // the library's loss is robust, the twin's is not
      CHECK(error.rad < 1e-3);
    }
  }
  MESSAGE(compared << " scenes, " << several << " with several objects");
  CHECK(compared >= enough(8));
  CHECK(several >= enough(5));
}
