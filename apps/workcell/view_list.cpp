#include "workcell/view_list.hpp"

#include "documents/json_document.hpp"
#include "documents/schema_check.hpp"
#include "documents/schemas.hpp"
#include "documents/value_readers.hpp"

namespace vantage {
namespace {

std::vector<Pose> read_list(const Value& list) {
  std::vector<Pose> poses;
  for (const Value& view : list.elements()) {
    poses.push_back(view.has("T_world_cam") ? read_pose(view["T_world_cam"])
                                            : read_looking_at(view));
  }
  return poses;
}

}  // namespace

Pose read_looking_at(const Value& value) {
  try {
    return Pose::looking_at(value["eye_m"].vector(), value["target_m"].vector());
  } catch (const Error& error) {
    throw value["target_m"].error(error.message());
  }
}

std::vector<Pose> read_view_file(const std::filesystem::path& file) {
  const Document document = read_document(file);
  check_schema(document, views_schema());
  return read_list(Value(document)["views"]);
}

std::vector<Pose> read_views(const Value& value, const std::filesystem::path& folder,
                             std::vector<std::filesystem::path>& files) {
  if (value.is_string()) return read_view_file(named_file(value, folder, files));
  return read_list(value);
}

}  // namespace vantage
