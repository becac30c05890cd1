#pragma once

#include <array>
#include <span>
#include <string_view>

namespace vantage {

// What the thesis prints in chapter 9: measured on recorded scenes, on an i7-6700HQ with a GPU.
// Ours are simulated after its descriptions, so that ratios can be compared, and volumes roughly.

/// A row of tables 9.5 (34,225 views) and 9.6 (the same with 40), in its order.
struct ThesisPick {
  std::string_view scene;   ///< our scene's name
  std::string_view title;   ///< the thesis'
  std::string_view method;  ///< our method's name; its mesh method weighs by D6, as our meshD6
  double method_score;
  double vox_score_m3;
  double vox_ratio;  ///< 0 to 1
  double run_time_s;
  double vox_quality;  ///< vox score with 34,225 views / with 40
  double production_run_time_s;
};
std::span<const ThesisPick> thesis_picks();

/// Null if the thesis has no such figures.
const ThesisPick* thesis_pick(std::string_view scene, std::string_view method);

/// "Averaged results" of tables 9.5 and 9.6.
struct ThesisMean {
  std::string_view method;
  double vox_ratio;
  double run_time_s;
  double vox_quality;
  double production_run_time_s;
};
std::span<const ThesisMean> thesis_means();
const ThesisMean* thesis_mean(std::string_view method);

/// A row of tables 9.1 to 9.4.
struct ThesisStep {
  double method_score;
  double vox_score_m3;
  double vox_ratio;
};

/// One of these tables: the servo's iterations, 0 first.
struct ThesisServo {
  std::string_view table;
  std::string_view scene;
  std::string_view method;
  std::array<ThesisStep, 6> steps;
};
std::span<const ThesisServo> thesis_servos();
const ThesisServo* thesis_servo(std::string_view scene, std::string_view method);

}  // namespace vantage
