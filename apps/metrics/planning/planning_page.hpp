#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "metrics/planning/planning_evaluation.hpp"

namespace vantage {

/// A picture of a scene.
struct PagePicture {
  std::size_t scene = 0;  ///< index
  std::string caption;
  std::string jpeg;  ///< the file's bytes
};

/// What the thesis' figures 9.16 and 9.18 show, of one set; an SVG.
std::string run_time_chart(const PlanningEvaluation& evaluation, const std::string& set);

/// The whole evaluation as one HTML page that needs nothing else: tables, charts, pictures.
/// @param options for people: how it was run.
std::string planning_page(const PlanningEvaluation& evaluation,
                          const std::vector<PagePicture>& pictures,
                          const std::vector<std::string>& options);

/// RFC 4648, with padding.
std::string base64(const std::string& bytes);

}  // namespace vantage
