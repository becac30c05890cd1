#include "evaluate/replay/replay_json.hpp"

#include "version.hpp"

namespace vantage {
namespace {

using Json = nlohmann::ordered_json;

Json pick_json(const ReplayEvaluation& evaluation, const ReplayPair& pair, std::size_t method) {
  const ReplayView& pick = pair.views[pair.picks[method]];
  const auto worth = worth_of(pair, method);
  return {{"method", evaluation.methods[method]},
          {"frame", pick.frame},
          {"predicted_gain_m3", pick.predicted_gain_m3},
          {"expected_gain_m3", pick.expected_gain_m3},
          {"real_gain_m3", pick.real_gain_m3},
          {"share_of_best", worth ? Json(worth->share_of_best) : Json()},
          {"times_mean", worth ? Json(worth->times_mean) : Json()},
          {"rank", worth ? Json(worth->rank) : Json()}};
}

Json view_json(const ReplayEvaluation& evaluation, const ReplayView& view) {
  Json scores = Json::object();
  for (std::size_t i = 0; i < evaluation.methods.size(); ++i) {
    scores[evaluation.methods[i]] = view.scores[i];
  }
  return {{"frame", view.frame},
          {"predicted_gain_m3", view.predicted_gain_m3},
          {"expected_gain_m3", view.expected_gain_m3},
          {"real_gain_m3", view.real_gain_m3},
          {"scores", scores}};
}

Json pair_json(const ReplayEvaluation& evaluation, const ReplayPair& pair) {
  Json picks = Json::array(), views = Json::array();
  for (std::size_t i = 0; i < evaluation.methods.size(); ++i) {
    picks.push_back(pick_json(evaluation, pair, i));
  }
  for (const ReplayView& view : pair.views) views.push_back(view_json(evaluation, view));
  const ReplayView& best = best_view(pair);
  return {{"frames", pair.frames},
          {"shadow_m3", pair.shadow_m3},
          {"best_frame", best.frame},
          {"best_gain_m3", best.real_gain_m3},
          {"mean_gain_m3", mean_gain_m3(pair)},
          {"picks", picks},
          {"views", views}};
}

Json means_json(const ReplayEvaluation& evaluation) {
  Json list = Json::array();
  for (std::size_t i = 0; i < evaluation.methods.size(); ++i) {
    const ReplayMeans means = replay_means(evaluation, i).value_or(ReplayMeans{});
    const auto value = [&](double mean) { return means.pairs > 0 ? Json(mean) : Json(); };
    list.push_back({{"method", evaluation.methods[i]},
                    {"pairs", means.pairs},
                    {"predicted_gain_m3", value(means.predicted_gain_m3)},
                    {"expected_gain_m3", value(means.expected_gain_m3)},
                    {"real_gain_m3", value(means.real_gain_m3)},
                    {"share_of_best", value(means.share_of_best)},
                    {"least_share_of_best", value(means.min_share_of_best)},
                    {"times_mean", value(means.times_mean)},
                    {"rank", value(means.rank)}});
  }
  return list;
}

}  // namespace

Json replay_to_json(const ReplayEvaluation& evaluation) {
  Json pairs = Json::array();
  for (const ReplayPair& pair : evaluation.pairs) pairs.push_back(pair_json(evaluation, pair));
  const auto blind = blind_share_of_best(evaluation);
  const auto correlation = expected_rank_correlation(evaluation);
  return {{"vantage", kVersion},
          {"methods", means_json(evaluation)},
          {"expected_rank_correlation", correlation ? Json(*correlation) : Json()},
          {"any_frame_share_of_best", blind ? Json(*blind) : Json()},
          {"pairs", pairs}};
}

}  // namespace vantage
