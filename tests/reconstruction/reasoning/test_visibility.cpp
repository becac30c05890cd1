// What cameras should see of markers, against the plain twin.

#include <doctest/doctest.h>

#include "hypothesis/expected_markers.hpp"
#include "reconstruction/synthetic_views.hpp"
#include "reference/plain_visibility.hpp"
#include "support/scene_count.hpp"
#include "vantage/raycore/advanced/scene_builder.hpp"
#include "vantage/reconstruction/detector_recall.hpp"

namespace vantage::test {

TEST_CASE("which markers cameras should see: packets of rays agree with plain ones") {
  constexpr double kBorder_px = 10;
  Random random(21);
  std::size_t seen = 0, hidden = 0, compared = 0;
  for (std::uint32_t s = 0; s < scene_count(20); ++s) {
    const auto views = cameras_around(random, 3);
    const std::vector<TypePtr> types = {
        std::make_shared<ObjectType>(marked_box("cube", {0.05, 0.05, 0.05}, 0)),
        std::make_shared<ObjectType>(marked_box("bar", {0.12, 0.04, 0.03}, 6))};
    const auto objects = scattered(random, types, 8, 0.16);
    SceneBuilder builder;
    ReferenceScene plain;
    for (std::size_t i = 0; i < objects.size(); ++i) {
      builder.add_instance(objects[i].type->mesh, objects[i].T_world_object);
      plain.add(*objects[i].type->mesh, objects[i].T_world_object, ObjectId(i));
    }
    const auto scene = builder.build();
    for (const CameraView& view : views) {
      const reconstruction::detail::ExpectedMarkers expected(view, *scene);
      for (const PlacedObject& object : objects) {
        for (const Marker& marker : object.type->markers()) {
          const double found = expected.found_probability(marker, object.T_world_object);
          const PlainSight sight = plain_sight(view.lens, *view.T_world_cam,
                                               object.T_world_object * marker.T_object_marker,
                                               marker.size_m, kBorder_px, plain);
          if (sight.close_call) continue;
          ++compared;
          const double recall = detector_recall(sight.side_px, sight.angle_rad);
          const double should =
              sight.visible ? recall * (1 - reconstruction::detail::kMarkerMissed) : 0;
          CHECK(found == doctest::Approx(should).epsilon(1e-9));
          seen += should > 0;
          hidden += !sight.visible && sight.angle_rad < 1;
        }
      }
    }
  }
  MESSAGE(compared, " compared, ", seen, " seen, ", hidden, " hidden or beyond the image");
  CHECK(seen > compared / 10);
  CHECK(hidden > enough(20));
}

}  // namespace vantage::test
