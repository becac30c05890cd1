#include "plan/method_options.hpp"

#include <fmt/format.h>

#include <map>

#include "cli/number_checks.hpp"

namespace vantage {
namespace {

void add_travel_options(CLI::App& verb, ViewOptions& options) {
  CLI::Option* from = verb.add_option("--from", options.from_m,
                                      "X Y Z: where the camera is now, metres, world frame")
                          ->expected(3);
  verb.add_option("--travel-weight", options.travel_weight_per_m,
                  "Cost of the journey: a score counts exp(-W d) times at a distance of d metres")
      ->check(number_from_zero())
      ->needs(from);
}

void add_view_count_options(CLI::App& verb, ViewSequenceOptions& views) {
  verb.add_option("--views", views.most, "Plan so many views, each for what those before it left")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  verb.add_option("--least-gain", views.min_gain_m3,
                  "Stop before a further view that reveals less than this, m³")
      ->check(number_from_zero());
  verb.add_option("--least-gain-share", views.min_gain_share, "The same as a share of all shadow")
      ->check(number_between(0.0, 1.0));
}

}  // namespace

void add_mesh_options(CLI::App& verb, MeshMethod& mesh) {
  static const std::map<std::string, DepthHoles> holes{{"fill", DepthHoles::fill},
                                                       {"unknown", DepthHoles::unknown}};
  verb.add_option("--mesh-step", mesh.visibility.step_px,
                  "Of --method mesh: a vertex every so many pixels of the depth images")
      ->check(CLI::Range(1, 64))
      ->capture_default_str();
  verb.add_option("--mesh-holes", mesh.visibility.holes,
                  "Of --method mesh: pixels without a depth; fill: from the depths around them; "
                  "unknown: they stay shadow")
      ->transform(CLI::CheckedTransformer(holes))
      ->default_str("fill");
  verb.add_option("--mesh-offset", mesh.visibility.offset_sigmas,
                  "Of --method mesh: measured surfaces move back by so many standard deviations of "
                  "the depth, which takes away the false shadow that noise makes")
      ->check(number_between(0.0, 100.0))
      ->capture_default_str();
  verb.add_option("--mesh-opening", mesh.opening_m,
                  "Of --method mesh: what is unseen, but a cube of this edge does not fit in, "
                  "counts as seen, metres: noise leaves such shadow, too; 0: all counts")
      ->check(number_from_zero())
      ->capture_default_str();
  verb.add_option("--mesh-exact", mesh.exact_views,
                  "Of --method mesh: with more views than this, servo iterations included, a "
                  "shortlist of them is scored exactly")
      ->check(number_from_zero())
      ->capture_default_str();
  verb.add_option("--mesh-shortlist", mesh.shortlist, "Of --method mesh: length of that shortlist")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
}

namespace {

void add_weight_options(CLI::App& verb, ViewOptions& options) {
  static const std::map<std::string, MeshWeight> weights{{"depth", MeshWeight::depth},
                                                         {"volume", MeshWeight::volume}};
  verb.add_option("--depth-power", options.depth_power,
                  "Of --method shadow and mesh: pixels count depth^P; 0, 3 and 6 are the thesis' "
                  "D0, D3, D6")
      ->check(number_between(0.0, 16.0))
      ->default_str(fmt::format("{:g}", ShadowMethod().depth_power));
  verb.add_option("--mesh-weight", options.mesh_weight,
                  "Of --method mesh: what unseen pixels count; volume: the volume behind them, by "
                  "which views from different distances compare; depth: depth^P, as in the thesis")
      ->transform(CLI::CheckedTransformer(weights))
      ->default_str("volume, or depth if there is a --depth-power");
}

}  // namespace

void ViewOptions::add_to(CLI::App& verb) {
  verb.add_option(
          "--method", method,
          "What a view is worth; voxel: the volume that it would reveal; shadow: the shadow "
          "on its image, weighted by distance; mesh: the volume that no depth image shows, "
          "whatever stands there; light: unlit surface that it would light, to "
          "compare with")
      ->check(CLI::IsMember(method_names()))
      ->capture_default_str();
  add_weight_options(verb, *this);
  verb.add_option("--servo", servo_iterations,
                  "Iterations of simulated visual servoing for each candidate; 0: none")
      ->check(CLI::Range(0, 100))
      ->capture_default_str();
  verb.add_option("--servo-width", servo_width, "Width of the images for servoing, pixels")
      ->check(CLI::Range(16, 16384))
      ->capture_default_str();
  verb.add_option("--polish", polished_views,
                  "So many of the best views are moved around the shadow and turned, as long as "
                  "that makes them better; 0: none")
      ->check(CLI::Range(0, 1000))
      ->capture_default_str();
  verb.add_option("--ranked", ranked, "So many of the best are found for certain, in their order")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
  add_mesh_options(verb, mesh);
  add_travel_options(verb, *this);
  add_view_count_options(verb, views);
}

Method ViewOptions::chosen() const {
  Method result = method_named(method);
  if (auto* const shadow = std::get_if<ShadowMethod>(&result)) {
    shadow->depth_power = depth_power.value_or(shadow->depth_power);
  } else if (auto* const by_mesh = std::get_if<MeshMethod>(&result)) {
    *by_mesh = mesh;
    by_mesh->depth_power = depth_power.value_or(mesh.depth_power);
    by_mesh->weight = mesh_weight.value_or(depth_power ? MeshWeight::depth : mesh.weight);
  }
  return result;
}

void ViewOptions::apply(PlanRequest& request) const {
  request.method = chosen();
  request.servo = {servo_iterations, servo_width};
  request.polish.views = polished_views;
  request.search.ranked = ranked;
  if (!from_m.empty()) {
    request.search.travel = TravelCost{travel_weight_per_m, {from_m[0], from_m[1], from_m[2]}};
  }
  request.views = views;
}

}  // namespace vantage
