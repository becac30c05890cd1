#include "reconstruct/world_file.hpp"

#include <fmt/format.h>

#include <set>

#include "cli/signal_handler.hpp"
#include "documents/document_value.hpp"
#include "documents/json_document.hpp"
#include "documents/schema_check.hpp"
#include "documents/schemas.hpp"
#include "documents/value_readers.hpp"

namespace vantage {
namespace {

std::optional<Matrix6d> read_covariance(const Value& object) {
  if (!object.has("covariance") || object["covariance"].is_null()) return std::nullopt;
  Matrix6d covariance;
  const std::vector<Value> rows = object["covariance"].elements();
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j) covariance(i, j) = rows[std::size_t(i)].number(std::size_t(j));
  }
  const double scale = covariance.diagonal().cwiseAbs().maxCoeff();
  if ((covariance - covariance.transpose()).cwiseAbs().maxCoeff() > 1e-6 * scale) {
    throw object["covariance"].error("not symmetric, so no covariance");
  }
  if (covariance.diagonal().minCoeff() < 0) {
    throw object["covariance"].error(fmt::format("a variance in it is {}; expected 0 or more",
                                                 covariance.diagonal().minCoeff()));
  }
  return covariance;
}

TypePtr read_type(const Value& value, const KnowledgeBase& knowledge) {
  return knowledge.get(value["type"].as<std::string>(), value["type"].place());
}

KnownObject read_object(const Value& value, const KnowledgeBase& knowledge) {
  const TypePtr type = read_type(value, knowledge);
  KnownObject object{value["name"].as<std::string>(), type->mesh,
                     read_pose(value["T_world_object"]), type->name};
  object.covariance = read_covariance(value);
  object.probability = value.get("probability", 1.0);
  if (!value.has("alternatives")) return object;
  for (const Value& other : value["alternatives"].elements()) {
    const TypePtr other_type = read_type(other, knowledge);
    object.alternatives.push_back({other_type->name, other_type->mesh,
                                   read_pose(other["T_world_object"]),
                                   other["probability"].as<double>()});
  }
  return object;
}

}  // namespace

WorldFile read_world(const std::filesystem::path& file, const KnowledgeBase& knowledge) {
  const ReadingPhase reading;
  const Document document = read_document(file);
  check_schema(document, world_schema());
  const Value root(document);
  WorldFile world;
  for (const Value& camera : root["cameras"].elements()) {
    std::optional<Pose> pose;
    if (!camera["T_world_cam"].is_null()) pose = read_pose(camera["T_world_cam"]);
    const int image = camera["image"].as<int>();
    if (world.T_world_cam.try_emplace(image, pose).second) continue;
    throw camera["image"].error(fmt::format("image {} is there twice", image));
  }
  std::set<std::string> names;
  for (const Value& object : root["objects"].elements()) {
    world.objects.push_back(read_object(object, knowledge));
    if (names.insert(world.objects.back().name).second) continue;
    throw object["name"].error(
        fmt::format("the name \"{}\" is there twice", world.objects.back().name));
  }
  return world;
}

}  // namespace vantage
