#include "locate/match_board.hpp"

#include <fmt/format.h>

#include <utility>

namespace vantage::reconstruction::detail {
namespace {

std::string key_text(const FeatureKey& key) {
  return key.type + " " + key.value;
}

}  // namespace

SeenBoard match_board(const Lens& lens, std::span<const Observation> observations,
                      std::span<const ObjectFeature> board) {
  SeenBoard seen;
  for (std::size_t o = 0; o < observations.size(); ++o) {
    const auto* data = std::get_if<SeenPoints>(&observations[o].data);
    if (!data) continue;
    std::string fault = fault_of(observations[o]);
    bool of_board = false, sound = false;
    for (std::size_t f = 0; f < board.size(); ++f) {
      if (board[f].key != observations[o].key) continue;
      std::vector<Eigen::Vector3d> points = board[f].points();
      if (points.empty()) continue;
      of_board = true;
      if (fault.empty() && points.size() != data->pixels.size()) {
        fault = fmt::format("{} points; the board's has {}", data->pixels.size(), points.size());
      }
      if (!fault.empty()) continue;
      sound = true;
      seen.pairs.push_back({o, f, {&lens, {}, std::move(points), data->pixels, data->sigma_px}});
    }
    if (of_board) seen.observations.push_back(o);
    seen.sound += sound ? 1 : 0;
    if (of_board && !sound && seen.fault.empty()) {
      seen.fault = key_text(observations[o].key) + ": " + fault;
    }
  }
  return seen;
}

std::string lack_of(const SeenBoard& seen, std::span<const Observation> observations,
                    std::span<const ObjectFeature> board) {
  if (seen.observations.empty()) {
    std::string example;
    if (!observations.empty()) example = fmt::format(" (e.g. {})", key_text(observations[0].key));
    std::string wanted;
    if (!board.empty()) wanted = fmt::format(" (e.g. {})", key_text(board.front().key));
    return fmt::format(
        "no marker of the board is seen: {} observations{}, none of them one of the board's {} "
        "features{}; turn the camera towards the board, or list the board's markers in the "
        "workcell",
        observations.size(), example, board.size(), wanted);
  }
  if (seen.pairs.empty()) {
    return fmt::format("all {} markers of the board that are seen are faulty, the first: {}",
                       seen.observations.size(), seen.fault);
  }
  return {};
}

}  // namespace vantage::reconstruction::detail
