#include <algorithm>
#include <cmath>

#include "election.hpp"
#include "pose_fit.hpp"

namespace vantage {
namespace {

using namespace detail;

constexpr double kLossSigmas = 3;

VoteGrid grid_for(const ReconstructOptions& options) {
  VoteGrid grid;
  grid.cell_m = 2 * options.merge_m;
  return grid;
}

PoseFit fitted(const Explanation& explanation) {
  std::vector<PointTerm> points;
  std::vector<PoseTerm> poses;
  for (const Reading* reading : explanation.readings) {
    const Sighting& sighting = *reading->sighting;
    if (const SeenPoints* seen = sighting.points()) {
      points.push_back({&sighting.view->lens, sighting.T_cam_world, reading->points_m, seen->pixels,
                        seen->sigma_px});
    } else {
      const SeenPose& measured = *sighting.pose();
      poses.push_back({*sighting.view->T_world_cam * measured.T_cam_feature,
                       reading->T_object_feature, measured.sigma_m, measured.sigma_rad});
    }
  }
  auto fit = fit_pose(points, poses, explanation.T_world_object, kLossSigmas);
  return fit ? *fit : PoseFit{explanation.T_world_object, explanation.sum.information};
}

ReconstructedObject object_of(const Elected& elected) {
  const Way& best = elected.front();
  const Explanation& explanation = best.explanation;
  const PoseFit fit = fitted(explanation);
  ReconstructedObject object{explanation.type(), fit.T_ref_body, covariance_of(fit.information),
                             best.probability, fit.rms_px};
  for (std::size_t i = 0; i < explanation.readings.size(); ++i) {
    const Reading& reading = *explanation.readings[i];
    object.support.push_back({reading.sighting->id, reading.feature->index,
                              reading.sighting->points() ? explanation.each[i].rms_px() : 0.0});
  }
  return object;
}

}  // namespace

Reconstruction reconstruct_voting(std::span<const CameraView> views, const KnowledgeBase& knowledge,
                                  const ReconstructOptions& options, const StopToken& stop) {
  Gathered gathered = gather(views, knowledge, options);
  Reconstruction result;
  result.unexplained = std::move(gathered.unexplained);
  const Ballot ballot = ballot_of(gathered.sightings);
  Election election(ballot, options, grid_for(options));
  std::vector<bool> explained(gathered.sightings.size(), false);
  while ((result.stopped = stop.reason()) == StopReason::none) {
    const auto elected = election.next();
    if (!elected) break;
    const Way& best = elected->front();
    for (const Reading* reading : best.explanation.readings) explained[reading->number] = true;
    ReconstructedObject object = object_of(*elected);
    for (const auto& [sighting, feature] : best.verdict.labels) {
      explained[sighting] = true;
      object.support.push_back({gathered.sightings[sighting].id, feature, 0});
    }
    for (std::size_t i = 1; i < elected->size(); ++i) {
      const Way& other = (*elected)[i];
      object.alternatives.push_back(
          {other.explanation.type(), fitted(other.explanation).T_ref_body, other.probability});
    }
    result.objects.push_back(std::move(object));
  }
  for (std::size_t i = 0; i < explained.size(); ++i) {
    if (explained[i]) continue;
    result.unexplained.push_back({gathered.sightings[i].id, election.reason_against(i)});
  }
  sort_result(knowledge, result);
  return result;
}

}  // namespace vantage
