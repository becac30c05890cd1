#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "vantage/planner/plan.hpp"

namespace vantage {

/// How views are scored, refined and chosen: what the command line says of it.
struct ViewOptions {
  std::string method{VoxelMethod::kName};
  MeshMethod mesh;                        ///< if that is the method; its weighting is below
  std::optional<double> depth_power;      ///< not given: the default
  std::optional<MeshWeight> mesh_weight;  ///< not given: by depth if its power is
  int servo_iterations = ServoOptions().iterations;
  int servo_width = ServoOptions().image_width;
  int polished_views = PolishOptions().views;
  int ranked = SearchOptions().ranked;
  double travel_weight_per_m = 0;
  std::vector<double> from_m;  ///< x y z; empty: not given
  ViewSequenceOptions views;

  void add_to(CLI::App& verb);

  /// Puts all of it into a request.
  void apply(PlanRequest& request) const;

 private:
  Method chosen() const;
};

/// The options of --method mesh, but for its weight.
void add_mesh_options(CLI::App& verb, MeshMethod& mesh);

}  // namespace vantage
