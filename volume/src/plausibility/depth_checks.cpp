#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "plausibility/checks.hpp"

namespace vantage::volume::detail {
namespace {

constexpr std::size_t kEnough = 50;  ///< samples, below which nothing is said

/// What a depth would have to be multiplied by for most readings to lie where the work area is.
std::optional<double> missing_factor(const std::vector<DepthSample>& samples) {
  constexpr std::array kFactors = {1000.0, 0.001, 10.0, 0.1, 100.0, 0.01, 1e4, 1e-4, 1e6, 1e-6};
  constexpr double kMost = 0.4, kBehind = 1.5;
  std::optional<double> best;
  double best_share = kMost;
  for (const double factor : kFactors) {
    std::size_t crossing = 0, fitting = 0;
    for (const DepthSample& sample : samples) {
      if (!sample.area) continue;
      ++crossing;
      const double depth = factor * sample.depth_m;
      fitting += depth >= sample.area->enter_m && depth <= kBehind * sample.area->exit_m;
    }
    if (crossing < kEnough || double(fitting) <= best_share * double(crossing)) continue;
    best = factor;
    best_share = double(fitting) / double(crossing);
  }
  return best;
}

/// The step of which all readings are multiples, if they are few and far apart.
std::optional<double> coarse_step(const std::vector<DepthSample>& samples, double coarse_m) {
  constexpr double kAlike = 1e-3;
  std::vector<double> values;
  for (const DepthSample& sample : samples) values.push_back(sample.depth_m);
  std::ranges::sort(values);
  const auto close = [](double a, double b) { return b - a <= kAlike * b; };
  values.erase(std::unique(values.begin(), values.end(), close), values.end());
  if (values.empty() || values.front() < coarse_m) return std::nullopt;
  double step = values.front();
  for (std::size_t i = 1; i < values.size(); ++i) step = std::min(step, values[i] - values[i - 1]);
  if (step < coarse_m) return std::nullopt;
  const bool multiples = std::ranges::all_of(values, [&](double value) {
    return std::abs(value / step - std::round(value / step)) < 0.01;
  });
  // Planes that face the camera give few values, too, but these are rarely multiples of one step.
  const bool whole = std::abs(step - std::round(step)) < kAlike && step > 0.5;
  return multiples && (whole || values.size() >= 4) ? std::optional(step) : std::nullopt;
}

std::string factor_text(double factor) {
  return factor > 1 ? fmt::format("{:g} times larger", factor)
                    : fmt::format("{:g} times smaller", 1 / factor);
}

/// What else may be wrong: the scale, or depths cut to whole steps.
std::string cause_of(const std::vector<DepthSample>& samples) {
  const std::optional<double> factor = missing_factor(samples);
  if (!factor) return "check depth_scale, the depth range, and the cameras' poses";
  std::vector<DepthSample> scaled = samples;
  for (DepthSample& sample : scaled) sample.depth_m *= *factor;
  const std::optional<double> step = coarse_step(scaled, 0.1);
  return fmt::format(
      "they would fit {}: check depth_scale (millimetres for one count of the "
      "image){}",
      factor_text(*factor),
      step ? fmt::format(", and the depths, which then are all multiples of {:g} m: "
                         "were they rounded to whole metres?",
                         *step)
           : "");
}

struct Share {
  std::size_t crossing = 0, before = 0, far_before = 0, far_behind = 0;
};

Share share_of(const std::vector<DepthSample>& samples) {
  constexpr double kTooFar = 5;
  Share share;
  for (const DepthSample& sample : samples) {
    if (!sample.area) continue;
    ++share.crossing;
    share.before += sample.depth_m < sample.area->enter_m;
    share.far_before += kTooFar * sample.depth_m < sample.area->enter_m;
    share.far_behind += sample.depth_m > kTooFar * sample.area->exit_m;
  }
  return share;
}

/// What is wrong with one image; empty if nothing is.
std::string oddity(const SampledCamera& camera, double voxel_size_m) {
  const std::vector<DepthSample>& samples = camera.depths;
  if (samples.empty()) return "the depth image has no valid reading";
  const auto [least, most] = std::ranges::minmax(samples, {}, &DepthSample::depth_m);
  const DepthRange range = camera.camera->camera.range();
  const auto usable = std::ranges::count_if(samples, [&](const DepthSample& sample) {
    return sample.depth_m >= range.near_m && sample.depth_m <= range.far_m;
  });
  const std::string span = fmt::format("{:.4g} m to {:.4g} m", least.depth_m, most.depth_m);
  // Depth beyond the far limit is a wall behind the cell, and frees what is before it.
  const bool too_near = most.depth_m < range.near_m;
  const Share share = share_of(samples);
  const double all = double(share.crossing);
  if (too_near) {
    return fmt::format(
        "no reading is within the depth range of {:g} m to {:g} m: they go from {}; "
        "{}",
        range.near_m, range.far_m, span, cause_of(samples));
  }
  if (share.crossing >= kEnough && double(share.far_before) > 0.9 * all) {
    return fmt::format("the readings, from {}, end far before the work area; {}", span,
                       cause_of(samples));
  }
  if (share.crossing >= kEnough && double(share.far_behind) > 0.9 * all &&
      (usable == 0 || missing_factor(samples))) {
    return fmt::format("the readings, from {}, lie far behind the work area; {}", span,
                       cause_of(samples));
  }
  const std::optional<double> step = coarse_step(samples, std::max(0.05, 5 * voxel_size_m));
  if (samples.size() >= kEnough && step) {
    return fmt::format(
        "all readings are multiples of {:.4g} m: were they rounded to whole metres, "
        "or stored with too few bits?",
        *step);
  }
  return {};
}

}  // namespace

void check_depths(const std::vector<SampledCamera>& cameras, double voxel_size_m,
                  Findings& findings) {
  for (const SampledCamera& camera : cameras) {
    if (camera.camera->depth == nullptr) continue;
    const std::string odd = oddity(camera, voxel_size_m);
    if (!odd.empty()) findings.push_back(fmt::format("image {}: {}", camera.camera->name, odd));
  }
}

}  // namespace vantage::volume::detail
