#include <doctest/doctest.h>

#include "documents/schemas.hpp"
#include "options/candidate_fields.hpp"
#include "options/field_json.hpp"
#include "options/sensor_fields.hpp"
#include "options/sequence_fields.hpp"
#include "options/view_options.hpp"
#include "options/volume_fields.hpp"

namespace vantage::test {
namespace {

using Json = nlohmann::ordered_json;

/// The published schema has to say what the fields say; the message is what to put there.
void check_same(const std::string& pointer, const Json& expected) {
  const nlohmann::json& schema = workcell_schema();
  const nlohmann::json::json_pointer at(pointer);
  INFO("assets/schema/workcell.schema.json, ", pointer, ": expected ", expected.dump());
  CHECK((schema.contains(at) && schema.at(at) == nlohmann::json(expected)));
}

Json properties_of(const FieldGroup& group) {
  return schema_of(group)["properties"];
}

void check_each(const std::string& folder, const FieldGroup& group) {
  const Json properties = properties_of(group);
  for (const auto& [key, schema] : properties.items()) check_same(folder + key, schema);
}

}  // namespace

TEST_CASE("the workcell's schema has the fields of the options, word for word") {
  VolumeOptions volume;
  check_same("/properties/volume/properties", properties_of(fields_of(volume)));
  CHECK(properties_of(fields_of(volume)).size() == 6);
  ViewOptions views;
  check_same("/properties/plan/properties", properties_of(fields_of(views)));
  StereoSensor sensor;
  check_same("/properties/movable_camera/properties/depth/properties",
             properties_of(fields_of(sensor)));
  double voxel_size_m = 0.009375;
  ViewConstraints constraints;
  const Json root =
      properties_of({"", "", {voxel_size_field(voxel_size_m)}, {body_fields(constraints)}});
  check_same("/properties/voxel_size_m", root["voxel_size_m"]);
  check_same("/properties/clearance_m", root["clearance_m"]);
  check_same("/properties/floor_z_m", root["floor_z_m"]);
  const Json& body = root["camera_body"];  // a name, or a shape
  check_same("/properties/camera_body/description", body["description"]);
  check_same("/properties/camera_body/default", body["default"]);
  check_same("/properties/camera_body/oneOf/0/enum", body["enum"]);

  RandomSequence sequence;
  check_each("/properties/sequence/properties/", fields_of(sequence));

  const std::string candidates = "/properties/candidates/properties/";
  HalfSpheres spheres = production_views();
  check_each(candidates, fields_of(spheres));
  BoxGrid grid{Box({0, 0, 0}, {1, 1, 1})};
  check_each(candidates + "box_grid/properties/", fields_of(grid));
  AroundPath around;
  check_each(candidates + "around_path/properties/", fields_of(around));
}

}  // namespace vantage::test
