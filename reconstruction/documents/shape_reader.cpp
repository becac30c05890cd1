#include "documents/shape_reader.hpp"

#include <algorithm>
#include <array>
#include <string>

#include "documents/value_readers.hpp"
#include "vantage/raycore/mesh_io.hpp"
#include "vantage/raycore/solids.hpp"

namespace vantage {
namespace {

double metres(const Value& solid, const char* key) {
  return solid[key].as<double>();
}

struct Solid {
  const char* name;
  TriangleMesh (*make)(const Value&);
};

constexpr std::array kSolids{
    Solid{"box", [](const Value& s) { return box_solid(s["size_m"].vector()); }},
    Solid{"cylinder",
          [](const Value& s) {
            return cylinder_solid(metres(s, "radius_m"), metres(s, "height_m"));
          }},
    Solid{"sphere", [](const Value& s) { return sphere_solid(metres(s, "radius_m")); }},
    Solid{"wedge", [](const Value& s) { return wedge_solid(s["size_m"].vector()); }},
    Solid{"cup",
          [](const Value& s) {
            return cup_solid(metres(s, "radius_m"), metres(s, "height_m"), metres(s, "wall_m"));
          }},
    Solid{"bracket",
          [](const Value& s) {
            return bracket_solid(s["size_m"].vector(), metres(s, "thickness_m"));
          }},
    Solid{"bin",
          [](const Value& s) { return bin_solid(s["size_m"].vector(), metres(s, "wall_m")); }},
    Solid{"duck", [](const Value& s) { return duck_solid(metres(s, "length_m")); }},
};

/// The solid's error names the size; the user wants to know where it stands.
TriangleMesh make(const Solid& solid, const Value& value) {
  try {
    return solid.make(value);
  } catch (const Error& error) {
    const std::string& size = error.where();
    throw value.has(size.c_str()) ? value[size.c_str()].error(error.message())
                                  : value.error(error.what());
  }
}

/// A name that the schema lets through.
UpAxis up_axis(const std::string& name) {
  constexpr std::array<const char*, 6> kNames = {"x", "y", "z", "-x", "-y", "-z"};
  return UpAxis(std::find(kNames.begin(), kNames.end(), name) - kNames.begin());
}

}  // namespace

TriangleMesh read_shape(const Value& shape, const std::filesystem::path& folder,
                        std::vector<std::filesystem::path>& files) {
  for (const Solid& solid : kSolids) {
    if (shape.has(solid.name)) return make(solid, shape[solid.name]);
  }
  return read_mesh_value(shape["mesh"], folder, files);
}

TriangleMesh read_mesh_value(const Value& mesh, const std::filesystem::path& folder,
                             std::vector<std::filesystem::path>& files,
                             const std::optional<double>& unit_m) {
  MeshFileFrame frame{.unit_m = unit_m.value_or(1.0)};
  if (mesh.is_string()) return read_mesh(named_file(mesh, folder, files), frame);
  frame.unit_m = mesh.get("unit_m", frame.unit_m);
  if (mesh.has("up")) frame.up = up_axis(mesh["up"].as<std::string>());
  return read_mesh(named_file(mesh["file"], folder, files), frame);
}

}  // namespace vantage
