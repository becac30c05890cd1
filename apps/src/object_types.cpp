#include "object_types.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <optional>

#include "documents/marker_reader.hpp"
#include "documents/schema_check.hpp"
#include "documents/schema_words.hpp"
#include "documents/schemas.hpp"
#include "documents/shape_reader.hpp"
#include "documents/value_readers.hpp"
#include "documents/yaml_document.hpp"

namespace vantage {
namespace {

namespace fs = std::filesystem;

Symmetries read_symmetries(const Value& value) {
  Symmetries symmetries;
  if (value.has("discrete")) {
    for (const Value& turn : value["discrete"].elements()) {
      symmetries.discrete.push_back(read_quaternion(turn));
    }
  }
  if (value.has("continuous")) {
    for (const Value& line : value["continuous"].elements()) {
      const Eigen::Vector3d axis = line["axis"].vector();
      if (axis.norm() < 1e-6) throw line["axis"].error("found no direction; expected an axis");
      ContinuousSymmetry symmetry{axis.normalized()};
      if (line.has("offset_m")) symmetry.offset_m = line["offset_m"].vector();
      symmetries.continuous.push_back(symmetry);
    }
  }
  return symmetries;
}

/// Reads types; remembers the names and the markers of all of them.
class TypeReader {
 public:
  explicit TypeReader(std::vector<fs::path>& files) : files_(files) {}

  ObjectType read(const Value& value, const fs::path& folder) {
    ObjectType type{.name = value["name"].as<std::string>()};
    take_name(type.name, value["name"]);
    type.is_a = value.get("is_a", std::vector<std::string>());
    if (value.has("symmetries")) type.symmetries = read_symmetries(value["symmetries"]);
    TexturedMesh plain{read_shape(value["shape"], folder, files_)};
    if (value.has("color")) plain.color = read_color(value["color"]);
    if (!value.has("features")) {
      type.shape = std::make_shared<const TexturedMesh>(std::move(plain));
      return type;
    }
    type.markers = read_markers(value);
    type.shape = std::make_shared<const TexturedMesh>(with_markers(
        plain.mesh, plain.color, type.markers, value["features"].place(), texel_for(type.markers)));
    return type;
  }

 private:
  void take_name(const std::string& name, const Value& value) {
    const auto [first, is_new] = names_.try_emplace(name, value.place());
    if (is_new) return;
    throw value.error(fmt::format("the name \"{}\" is taken by {}; types' names have to differ",
                                  name, first->second));
  }

  std::vector<Marker> read_markers(const Value& type) {
    std::optional<Eigen::Vector3d> box_size_m;
    if (type["shape"].has("box")) box_size_m = type["shape"]["box"]["size_m"].vector();
    std::vector<Marker> markers;
    for (const Value& feature : type["features"].elements()) {
      markers.push_back(read_marker(feature, box_size_m));
      owners_.take(markers.back(), feature.place(), feature["value"].place());
    }
    return markers;
  }

  std::vector<fs::path>& files_;
  std::map<std::string, std::string> names_;  // name → where it stands
  MarkerOwners owners_;
};

}  // namespace

KnowledgeBase::KnowledgeBase(const std::vector<fs::path>& files) {
  TypeReader reader(files_);
  for (const fs::path& file : files) {
    const Document document = read_yaml(file);
    check_schema(document, knowledge_schema());
    files_.push_back(file);
    for (const Value& value : Value(document)["object_types"].elements()) {
      types_.push_back(std::make_shared<const ObjectType>(reader.read(value, file.parent_path())));
    }
  }
}

std::shared_ptr<const ObjectType> KnowledgeBase::type(const std::string& name,
                                                      const std::string& where) const {
  nlohmann::json names = nlohmann::json::object();
  for (const auto& type : types_) {
    if (type->name == name) return type;
    names[type->name] = true;
  }
  if (names.empty()) {
    throw bad_input(where, fmt::format("found the type \"{}\", but there is no knowledge base; the "
                                       "workcell's key knowledge_base names its file",
                                       name));
  }
  const std::string nearest = nearest_key(name, names);
  if (!nearest.empty()) {
    throw bad_input(where, fmt::format("the knowledge base has no type \"{}\"; did you mean "
                                       "\"{}\"?",
                                       name, nearest));
  }
  std::vector<std::string> known;
  for (const auto& type : types_) known.push_back(type->name);
  throw bad_input(where, fmt::format("the knowledge base has no type \"{}\"; its types are {}",
                                     name, fmt::join(known, ", ")));
}

}  // namespace vantage
