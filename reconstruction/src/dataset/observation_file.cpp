#include "vantage/reconstruction/observation_file.hpp"

#include <fmt/format.h>

#include <initializer_list>
#include <limits>
#include <string>
#include <string_view>

#include "documents/document_value.hpp"
#include "documents/json_document.hpp"
#include "documents/marker_reader.hpp"
#include "documents/schema_check.hpp"
#include "documents/schemas.hpp"
#include "documents/value_readers.hpp"
#include "vantage/raycore/detail/file.hpp"

namespace vantage {
namespace {

constexpr std::size_t kMaxObservationBytes = std::size_t(64) << 20;

/// NaN for what the schema lets stand for no number.
double number_or_nan(const Value& value) {
  if (value.is_null() || value.is_string()) return std::numeric_limits<double>::quiet_NaN();
  return value.as<double>();
}

double sigma(const Value& line, const char* key, double otherwise) {
  return line.has(key) ? number_or_nan(line[key]) : otherwise;
}

/// Refuses keys that say something of another kind of observation.
void refuse(const Value& line, std::initializer_list<const char*> keys, const char* with) {
  for (const char* key : keys) {
    if (line.has(key)) {
      throw line[key].error(fmt::format("this key does not belong to {}; remove it", with));
    }
  }
}

FeatureKey read_key(const Value& line) {
  const Value type = line["type"], value = line["value"];
  if (type.as<std::string>() != "aruco") {
    refuse(line, {"dictionary", "corners_px"}, "a feature other than \"aruco\"");
    if (value.is_string()) return {type.as<std::string>(), value.as<std::string>()};
    throw value.error(
        fmt::format("found {}; expected the feature's name as a string", value.as<int>()));
  }
  if (!line.has("corners_px")) throw line.error("a marker has \"corners_px\"; expected this key");
  if (!line.has("dictionary")) {
    throw line.error("a marker belongs to a dictionary; expected the key \"dictionary\"");
  }
  if (value.is_string()) {
    throw value.error(fmt::format("found \"{}\"; expected a marker's id, a whole number",
                                  value.as<std::string>()));
  }
  check_marker(line["dictionary"], value);
  return marker_key(line["dictionary"].as<std::string>(), value.as<int>());
}

SeenPoints read_points(const Value& line, const char* key) {
  refuse(line, {"sigma_m", "sigma_rad"}, "pixels");
  SeenPoints seen;
  for (const Value& pixel : line[key].elements()) {
    const auto uv = pixel.elements();
    seen.pixels.emplace_back(number_or_nan(uv[0]), number_or_nan(uv[1]));
  }
  seen.sigma_px = sigma(line, "sigma_px", seen.sigma_px);
  return seen;
}

SeenPose read_seen_pose(const Value& line) {
  refuse(line, {"sigma_px"}, "a pose");
  SeenPose seen;
  seen.T_cam_feature = read_pose(line["T_cam_feature"]);
  seen.sigma_m = sigma(line, "sigma_m", seen.sigma_m);
  seen.sigma_rad = sigma(line, "sigma_rad", seen.sigma_rad);
  return seen;
}

SeenLabel read_label(const Value& line) {
  refuse(line, {"sigma_px", "sigma_rad"}, "a label at a point");
  SeenLabel seen;
  const auto xyz = line["point_m"].elements();
  seen.p_cam_m = {number_or_nan(xyz[0]), number_or_nan(xyz[1]), number_or_nan(xyz[2])};
  seen.sigma_m = sigma(line, "sigma_m", seen.sigma_m);
  return seen;
}

Observation read_observation(const Value& line) {
  Observation observation{read_key(line), {}};
  if (line.has("T_cam_feature")) {
    observation.data = read_seen_pose(line);
  } else if (line.has("point_m")) {
    observation.data = read_label(line);
  } else {
    observation.data = read_points(line, line.has("corners_px") ? "corners_px" : "points_px");
  }
  return observation;
}

}  // namespace

std::map<int, std::vector<Observation>> read_observations(const std::filesystem::path& file) {
  const std::vector<std::uint8_t> bytes = read_file(file, kMaxObservationBytes);
  std::string_view rest(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  std::map<int, std::vector<Observation>> observations;
  for (int number = 1; !rest.empty(); ++number) {
    const std::size_t end = rest.find('\n');
    const std::string_view text = rest.substr(0, end);
    rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
    if (text.find_first_not_of(" \t\r") == std::string_view::npos) continue;
    const Document document = parse_json(text, file.string(), kJsonLimits, {}, number);
    check_schema(document, observation_schema());
    const Value line(document);
    observations[line["image"].as<int>()].push_back(read_observation(line));
  }
  return observations;
}

}  // namespace vantage
