#include "pose/solve_pnp.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>

#include "pose/extrapolated_lens.hpp"
#include "pose/pose_fit.hpp"
#include "pose/principal_axes.hpp"
#include "vantage/raycore/error.hpp"

namespace vantage::reconstruction::detail {
namespace {

constexpr double kFlat = 1e-6;  // of the extent

bool collinear(const PrincipalAxes& p) {
  return !(p.extents[1] > kFlat * p.extents[0]);
}
bool planar(const PrincipalAxes& p) {
  return !(p.extents[2] > kFlat * p.extents[0]);
}

/// Whether the pixels lie on one line, or at one place, to a thousandth of a pixel.
bool on_a_line(std::span<const Eigen::Vector2d> pixels) {
  std::vector<Eigen::Vector3d> points;
  for (const Eigen::Vector2d& p : pixels) points.emplace_back(p.x(), p.y(), 0);
  return !(principal_axes(points).extents[1] > 1e-3);
}

/// Points and their images as OpenCV wants them: on the plane z = 1, so that its camera matrix is
/// the identity.
struct Correspondences {
  std::vector<cv::Point3d> points;
  std::vector<cv::Point2d> images;
};

std::vector<cv::Mat> solutions(const Correspondences& c, bool planar,
                               std::vector<cv::Mat>& translations) {
  std::vector<cv::Mat> turns;
  const cv::Matx33d k = cv::Matx33d::eye();
  try {
    if (c.points.size() == 3) {
      cv::solveP3P(c.points, c.images, k, {}, turns, translations, cv::SOLVEPNP_AP3P);
    } else {
      cv::solvePnPGeneric(c.points, c.images, k, {}, turns, translations, false,
                          planar ? cv::SOLVEPNP_IPPE : cv::SOLVEPNP_SQPNP);
    }
  } catch (const cv::Exception&) {  // it finds no pose; which points are to blame it does not say
    turns.clear();
  }
  return turns;
}

Eigen::Vector3d vector_of(const cv::Mat& m) {
  return {m.at<double>(0), m.at<double>(1), m.at<double>(2)};
}

std::optional<Pose> pose_from_opencv(const cv::Mat& turn, const cv::Mat& translation) {
  const Eigen::Vector3d r = vector_of(turn), t = vector_of(translation);
  if (!r.allFinite() || !t.allFinite()) return {};
  const double angle = r.norm();
  const Eigen::Vector3d axis = angle > 0 ? Eigen::Vector3d(r / angle) : Eigen::Vector3d::UnitX();
  return Pose::from_rotation(Eigen::AngleAxisd(angle, axis).toRotationMatrix(), t);
}

double rms_of(const PointTerm& term, const Pose& T_cam_body) {
  double sum = 0;
  for (const double r : residuals_px(term, T_cam_body)) sum += r * r;
  return std::sqrt(sum / double(term.points_m.size()));
}

std::optional<Correspondences> correspondences(const PointTerm& term, const Pose& T_frame_body,
                                               bool planar) {
  Correspondences result;
  try {
    for (std::size_t i = 0; i < term.points_m.size(); ++i) {
      const Eigen::Vector3d p = T_frame_body * term.points_m[i];
      result.points.emplace_back(p.x(), p.y(), planar ? 0 : p.z());
      const Eigen::Vector2d xy = sight_of(*term.lens, term.pixels[i]);
      result.images.emplace_back(xy.x(), xy.y());
    }
  } catch (const Error&) {
    return {};  // a pixel far beyond the image
  }
  return result;
}

bool are_sound(const PointTerm& term) {
  const auto finite = [](const auto& p) { return p.allFinite(); };
  return term.points_m.size() == term.pixels.size() && term.points_m.size() >= 3 &&
         std::ranges::all_of(term.points_m, finite) && std::ranges::all_of(term.pixels, finite) &&
         !on_a_line(term.pixels);
}

}  // namespace

std::vector<PoseGuess> solve_pnp(const Lens& lens, std::span<const Eigen::Vector3d> points_m,
                                 std::span<const Eigen::Vector2d> pixels) {
  const PointTerm term{
      &lens, {}, {points_m.begin(), points_m.end()}, {pixels.begin(), pixels.end()}, 1};
  if (!are_sound(term)) return {};
  const PrincipalAxes principal = principal_axes(points_m);
  if (collinear(principal)) return {};
  const bool flat = planar(principal);
  const Pose T_frame_body = Pose::from_rotation(principal.axes, principal.centre).inverse();
  const auto pairs = correspondences(term, T_frame_body, flat);
  if (!pairs) return {};
  std::vector<cv::Mat> translations;
  const std::vector<cv::Mat> turns = solutions(*pairs, flat, translations);
  std::vector<PoseGuess> guesses;
  for (std::size_t i = 0; i < turns.size(); ++i) {
    const auto T_cam_frame = pose_from_opencv(turns[i], translations[i]);
    if (!T_cam_frame) continue;
    const Pose T_cam_body = *T_cam_frame * T_frame_body;
    const double rms = rms_of(term, T_cam_body);
    if (std::isfinite(rms)) guesses.push_back({T_cam_body, rms});
  }
  std::ranges::stable_sort(guesses, {}, &PoseGuess::rms_px);
  return guesses;
}

}  // namespace vantage::reconstruction::detail
