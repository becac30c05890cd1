#include "reconstruct/world_json.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cli/inputs_json.hpp"
#include "cli/pose_json.hpp"
#include "cli/run_time.hpp"
#include "reconstruct/support/support_json.hpp"
#include "version.hpp"

namespace vantage {
namespace {

using Json = nlohmann::ordered_json;

/// As many digits as a measurement has, and no more.
double rounded(double value, double step) {
  return std::round(value / step) * step;
}

Json located_json(const LocatedPose& pose) {
  return {{"T_world_cam", to_json(pose.T_world_cam)},
          {"covariance", to_json(pose.covariance)},
          {"rms_px", pose.rms_px}};
}

/// One camera: its pose, or why it is unknown.
Json camera_json(const BopImage& image, const CameraView& view, const CameraLocation& location) {
  const bool by_board = location.pose || !location.reason.empty();
  const Intrinsics& k = view.lens.intrinsics();
  const Distortion& d = view.lens.distortion();
  Json json{{"image", image.id},
            {"located_by", by_board ? "board" : "dataset"},
            {"T_world_cam", view.T_world_cam ? to_json(*view.T_world_cam) : Json()},
            {"reason", location.reason.empty() ? Json() : Json(location.reason)},
            {"covariance", by_board && location.pose ? to_json(view.covariance) : Json()},
            {"rms_px", location.pose ? Json(location.pose->rms_px) : Json()},
            {"warning", location.warning.empty() ? Json() : Json(location.warning)},
            {"board_markers", location.inliers.size()},
            {"board_markers_seen", location.markers_seen},
            {"wrong_board_markers", location.outliers.size()},
            {"alternatives", Json::array()},
            {"intrinsics",
             {{"width", k.width},
              {"height", k.height},
              {"fx", k.fx},
              {"fy", k.fy},
              {"cx", k.cx},
              {"cy", k.cy}}},
            {"lens_model", d.model == LensModel::fisheye ? "fisheye" : "brown_conrady"},
            {"distortion", {d.k1, d.k2, d.p1, d.p2, d.k3, d.k4, d.k5, d.k6}}};
  for (const LocatedPose& other : location.alternatives) {
    json["alternatives"].push_back(located_json(other));
  }
  return json;
}

Json observation_json(const BopScene& scene, const std::vector<CameraView>& views,
                      const ObservationId& id) {
  const FeatureKey& key = views[id.view].observations[id.observation].key;
  return {{"image", scene.images[id.view].id}, {"type", key.type}, {"value", key.value}};
}

/// In log-odds; rounded to what they are good for.
Json evidence_json(const std::optional<Evidence>& evidence) {
  if (!evidence) return nullptr;
  const Evidence& e = *evidence;
  const auto value = [](double log_ratio) { return rounded(log_ratio, 1e-3) + 0.0; };
  return {{"log_odds", value(e.log_odds())},
          {"seen_features", value(e.seen_features)},
          {"missing_features", value(e.missing_features)},
          {"depth", value(e.depth)},
          {"hidden_by_structure", value(e.hidden_by_structure)},
          {"inside_structure", value(e.inside_structure)},
          {"hides_board", value(e.hides_board)},
          {"other_objects", value(e.other_objects)},
          {"wrong_size", value(e.wrong_size)},
          {"counts",
           {{"features_missing", e.features_missing},
            {"depth_on_surface", e.depth_on_surface},
            {"depth_behind", e.depth_behind},
            {"depth_in_front", e.depth_in_front}}}};
}

Json rejected_json(const BopScene& scene, const std::vector<CameraView>& views,
                   const RejectedObject& rejected) {
  const ReconstructedObject& object = rejected.object;
  Json json{{"type", object.type->name},
            {"reason", rejected.reason},
            {"T_world_object", to_json(object.T_world_object)},
            {"probability", object.probability},
            {"evidence", evidence_json(object.evidence)},
            {"support", Json::array()}};
  for (const Support& support : object.support) {
    json["support"].push_back(observation_json(scene, views, support.id));
  }
  return json;
}

Json object_json(const BopScene& scene, const SceneReconstruction& reconstruction,
                 const ReconstructedObject& object, const KnownObject& known) {
  Json json{{"name", known.name},
            {"type", object.type->name},
            {"T_world_object", to_json(object.T_world_object)},
            {"covariance", object.covariance ? to_json(*object.covariance) : Json()},
            {"probability", object.probability},
            {"rms_px", object.rms_px},
            {"warning", object.warning.empty() ? Json() : Json(object.warning)},
            {"evidence", evidence_json(object.evidence)},
            {"support", Json::array()},
            {"alternatives", Json::array()}};
  for (const Support& support : object.support) {
    Json seen = observation_json(scene, reconstruction.observed.views, support.id);
    seen["residual_px"] = support.residual_px;
    json["support"].push_back(seen);
  }
  for (const Alternative& other : object.alternatives) {
    json["alternatives"].push_back({{"type", other.type->name},
                                    {"T_world_object", to_json(other.T_world_object)},
                                    {"probability", other.probability}});
  }
  return json;
}

int bop_id_of(const TypePtr& type, const KnowledgeBase& knowledge) {
  if (type->bop_id) return *type->bop_id;
  const auto& types = knowledge.types();
  return int(std::find(types.begin(), types.end(), type) - types.begin()) + 1;
}

/// As scene_gt.json has it.
Json bop_json(const BopScene& scene, const Workcell& workcell,
              const SceneReconstruction& reconstruction) {
  Json json = Json::object();
  for (std::size_t i = 0; i < scene.images.size(); ++i) {
    const auto& T_world_cam = reconstruction.observed.views[i].T_world_cam;
    if (!T_world_cam) continue;
    Json& list = json[std::to_string(scene.images[i].id)] = Json::array();
    for (const ReconstructedObject& object : reconstruction.result.objects) {
      const Pose T_cam_model = T_world_cam->inverse() * object.T_world_object;
      list.push_back({{"cam_R_m2c", bop_rotation(T_cam_model)},
                      {"cam_t_m2c", bop_translation(T_cam_model)},
                      {"obj_id", bop_id_of(object.type, *workcell.knowledge)}});
    }
  }
  return json;
}

/// Without the minus of a zero.
std::string point_text(const Json& t) {
  const auto at = [&](std::size_t i) { return rounded(t[i].get<double>(), 1e-4) + 0.0; };
  return fmt::format("({:.4f}, {:.4f}, {:.4f}) m", at(0), at(1), at(2));
}

std::string camera_line(const Json& camera) {
  if (!camera["reason"].is_null()) {
    return fmt::format("  image {:<4} not located: {}\n", camera["image"].get<int>(),
                       camera["reason"].get<std::string>());
  }
  std::string line = fmt::format("  image {:<4} at {}", camera["image"].get<int>(),
                                 point_text(camera["T_world_cam"]["translation_m"]));
  if (camera["located_by"] == "dataset") return line + ", as in the dataset\n";
  const int agreeing = camera["board_markers"].get<int>();
  const int seen = camera["board_markers_seen"].get<int>();
  const std::string markers =
      agreeing == seen ? std::to_string(seen) : fmt::format("{} of {}", agreeing, seen);
  return line +
         fmt::format(", by {} markers, {:.3f} px rms\n", markers, camera["rms_px"].get<double>());
}

std::string object_line(const Json& object) {
  const Json& t = object["T_world_object"]["translation_m"];
  std::string line =
      fmt::format("  {:<18} at ({:.4f}, {:.4f}, {:.4f}) m", object["name"].get<std::string>(),
                  t[0].get<double>(), t[1].get<double>(), t[2].get<double>());
  if (!object["covariance"].is_null()) {
    const Json& c = object["covariance"];
    const auto variance = [&](int i) { return c[i][i].get<double>(); };
    line += fmt::format(" ± {:.2f} mm, {:.2f}°",
                        1e3 * std::sqrt(variance(0) + variance(1) + variance(2)),
                        std::sqrt(variance(3) + variance(4) + variance(5)) * 180 / M_PI);
  }
  line += fmt::format("; {} features, {:.3f} px rms, probability {:.3f}", object["support"].size(),
                      object["rms_px"].get<double>(), object["probability"].get<double>());
  const std::string verdict =
      object.contains("stability") ? object["stability"]["verdict"].get<std::string>() : "stands";
  if (verdict == "unseen") line += ", held by something unseen";
  if (verdict == "floats" || verdict == "tips" || verdict == "sinks") line += ", " + verdict;
  for (const Json& other : object["alternatives"]) {
    line += fmt::format("\n    or {} of probability {:.3f}", other["type"].get<std::string>(),
                        other["probability"].get<double>());
  }
  return line + "\n";
}

}  // namespace

Json world_to_json(const BopScene& scene, const Workcell& workcell,
                   const SceneReconstruction& reconstruction,
                   const std::vector<KnownObject>& objects, const WorldRecord& record) {
  const ObservedScene& observed = reconstruction.observed;
  Json cameras = Json::array(), found = Json::array(), unexplained = Json::array();
  Json rejected = Json::array();
  for (std::size_t i = 0; i < scene.images.size(); ++i) {
    cameras.push_back(camera_json(scene.images[i], observed.views[i], observed.locations[i]));
  }
  for (const RejectedObject& object : reconstruction.result.rejected) {
    rejected.push_back(rejected_json(scene, observed.views, object));
  }
  for (std::size_t i = 0; i < objects.size(); ++i) {
    found.push_back(
        object_json(scene, reconstruction, reconstruction.result.objects[i], objects[i]));
    const SceneSupport& support = reconstruction.support;
    if (support.objects.empty()) continue;
    found.back()["stability"] = to_json(support.objects[i], objects, support.structures);
  }
  for (const Unexplained& left : reconstruction.result.unexplained) {
    Json seen = observation_json(scene, observed.views, left.id);
    seen["reason"] = left.reason;
    unexplained.push_back(seen);
  }
  return {{"vantage", kVersion},
          {"method", record.config["method"]},
          {"partial", reconstruction.result.stopped != StopReason::none},
          {"cameras", cameras},
          {"objects", found},
          {"rejected", rejected},
          {"unexplained", unexplained},
          {"warnings", record.warnings},
          {"bop", bop_json(scene, workcell, reconstruction)},
          {"timing_ms",
           {{"load", milliseconds(record.load_s)},
            {"detect", milliseconds(observed.detect_s)},
            {"locate", milliseconds(observed.locate_s)},
            {"reconstruct", milliseconds(reconstruction.reconstruct_s)},
            {"total", milliseconds(record.total_s)}}},
          {"config", record.config},
          {"inputs", inputs_json(record.inputs)}};
}

std::string summary_of_world(const Json& world) {
  std::string text = fmt::format("cameras     {}\n", world["cameras"].size());
  for (const Json& camera : world["cameras"]) text += camera_line(camera);
  text += fmt::format("objects     {}\n", world["objects"].size());
  for (const Json& object : world["objects"]) text += object_line(object);
  const Json& left = world["unexplained"];
  if (!left.empty()) text += fmt::format("left over   {} features\n", left.size());
  for (const Json& seen : left) {
    text += fmt::format("  image {:<4} {} {}: {}\n", seen["image"].get<int>(),
                        seen["type"].get<std::string>(), seen["value"].get<std::string>(),
                        seen["reason"].get<std::string>());
  }
  return text;
}

}  // namespace vantage
