#include "documents/shape_reader.hpp"

#include <array>

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

}  // namespace

TriangleMesh read_shape(const Value& shape, const std::filesystem::path& folder,
                        std::vector<std::filesystem::path>& files) {
  for (const Solid& solid : kSolids) {
    if (shape.has(solid.name)) return make(solid, shape[solid.name]);
  }
  const Value mesh = shape["mesh"];
  return read_mesh_file(mesh["file"], mesh.get("unit_m", 1.0), folder, files);
}

TriangleMesh read_mesh_file(const Value& name, double unit_m, const std::filesystem::path& folder,
                            std::vector<std::filesystem::path>& files) {
  return read_mesh(named_file(name, folder, files), unit_m);
}

}  // namespace vantage
