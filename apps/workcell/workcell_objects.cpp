#include "workcell/workcell_objects.hpp"

#include <fmt/format.h>

#include "documents/shape_reader.hpp"
#include "documents/value_readers.hpp"

namespace vantage {
namespace {

TriangleMesh read_mesh_of(const Value& value, const std::filesystem::path& folder,
                          std::vector<std::filesystem::path>& files) {
  if (value.has("box")) return TriangleMesh::from_box(read_box(value["box"]));
  if (value.has("shape")) return read_shape(value["shape"], folder, files);
  std::optional<double> unit_m;
  if (value.has("unit_m")) unit_m = value["unit_m"].as<double>();
  return read_mesh_value(value["mesh"], folder, files, unit_m);
}

/// Keys that the schema cannot tie to others.
void check_keys(const Value& value) {
  if (value.has("unit_m") && !value.has("mesh")) {
    throw value["unit_m"].error("only a mesh has a unit; everything else is in metres");
  }
  if (value.has("unit_m") && !value["mesh"].is_string() && value["mesh"].has("unit_m")) {
    throw value["unit_m"].error("the mesh already states its unit; remove one of the two");
  }
  if (value.has("color") && value.has("type")) {
    throw value["color"].error("a type has its colour in the knowledge base; remove this one");
  }
}

}  // namespace

std::vector<KnownObject> known(const std::vector<PlacedObject>& objects) {
  std::vector<KnownObject> all;
  for (const PlacedObject& object : objects) all.push_back(object.known());
  return all;
}

PlacedObject ObjectReader::read(const Value& value) {
  check_keys(value);
  PlacedObject object{.name = value["name"].as<std::string>()};
  const auto [first, is_new] = places_.try_emplace(object.name, value["name"].place());
  if (!is_new) {
    throw value["name"].error(fmt::format(
        "the name \"{}\" is already used by {}; names must be unique", object.name, first->second));
  }
  if (value.has("pose")) object.T_world_object = read_pose(value["pose"]);
  if (value.has("type")) {
    object.type = knowledge_.get(value["type"].as<std::string>(), value["type"].place());
    object.mesh = object.type->mesh;
    object.color = object.type->color;
    return object;
  }
  object.mesh = std::make_shared<const TriangleMesh>(read_mesh_of(value, folder_, files_));
  if (value.has("color")) object.color = read_color(value["color"]);
  return object;
}

}  // namespace vantage
