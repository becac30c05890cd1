#include "evaluate/planning/planning_json.hpp"
#include "metrics/planning/thesis_planning.hpp"

namespace vantage {
namespace {

using Json = nlohmann::ordered_json;

Json picks_json() {
  Json list = Json::array();
  for (const ThesisPick& pick : thesis_picks()) {
    list.push_back({{"scene", pick.scene},
                    {"title", pick.title},
                    {"method", pick.method},
                    {"method_score", pick.method_score},
                    {"vox_score_m3", pick.vox_score_m3},
                    {"vox_ratio", pick.vox_ratio},
                    {"run_time_s", pick.run_time_s},
                    {"vox_quality", pick.vox_quality},
                    {"production_run_time_s", pick.production_run_time_s}});
  }
  return list;
}

Json means_json() {
  Json list = Json::array();
  for (const ThesisMean& mean : thesis_means()) {
    list.push_back({{"method", mean.method},
                    {"vox_ratio", mean.vox_ratio},
                    {"run_time_s", mean.run_time_s},
                    {"vox_quality", mean.vox_quality},
                    {"production_run_time_s", mean.production_run_time_s}});
  }
  return list;
}

Json servos_json() {
  Json list = Json::array();
  for (const ThesisServo& servo : thesis_servos()) {
    Json steps = Json::array();
    for (const ThesisStep& step : servo.steps) {
      steps.push_back({{"method_score", step.method_score},
                       {"vox_score_m3", step.vox_score_m3},
                       {"vox_ratio", step.vox_ratio}});
    }
    list.push_back({{"table", servo.table},
                    {"scene", servo.scene},
                    {"method", servo.method},
                    {"steps", steps}});
  }
  return list;
}

}  // namespace

Json thesis_planning_json() {
  return {{"picks", picks_json()}, {"means", means_json()}, {"servo", servos_json()}};
}

}  // namespace vantage
