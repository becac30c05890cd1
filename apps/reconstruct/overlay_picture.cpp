#include "reconstruct/overlay_picture.hpp"

#include <fmt/format.h>

#include <array>
#include <optional>
#include <set>

#include "reconstruct/overlay_canvas.hpp"
#include "vantage/raycore/advanced/scene_builder.hpp"
#include "vantage/reconstruction/color_image.hpp"

namespace vantage {
namespace {

// Colours that can be told from one another, also by the colour-blind (Okabe and Ito, 2008).
constexpr std::array kObjectInks{Ink{0, 114, 178},  Ink{213, 94, 0},   Ink{0, 158, 115},
                                 Ink{204, 60, 147}, Ink{86, 160, 213}, Ink{190, 140, 0}};
constexpr Ink kExplained{20, 140, 60}, kLeftOver{200, 30, 30}, kBoard{70, 70, 75};
constexpr double kMagnified = 20;  // residuals
constexpr double kAxis_m = 0.05;

/// One photograph with what is known of it.
struct OverlaySheet {
  const CameraView& view;
  OverlayCanvas canvas;

  Eigen::Vector3d in_camera(const Eigen::Vector3d& p_world) const {
    return view.T_world_cam->inverse() * p_world;
  }

  void mark_points(const Observation& seen, const Ink& ink, bool crossed) {
    const auto* points = std::get_if<SeenPoints>(&seen.data);
    if (points == nullptr) return;
    for (const Eigen::Vector2d& pixel : points->pixels) {
      if (!pixel.allFinite()) continue;
      if (crossed) {
        canvas.cross(pixel, 5, ink, 2);
      } else {
        canvas.ring(pixel, 4, ink, 1);
      }
    }
  }

  void draw_residuals(const Observation& seen, const std::vector<Eigen::Vector3d>& points_world) {
    const auto* points = std::get_if<SeenPoints>(&seen.data);
    if (points == nullptr || points->pixels.size() != points_world.size()) return;
    for (std::size_t i = 0; i < points_world.size(); ++i) {
      const Eigen::Vector3d p_cam = in_camera(points_world[i]);
      if (p_cam.z() < 1e-3) continue;
      const Eigen::Vector2d& pixel = points->pixels[i];
      const Eigen::Vector2d off = pixel - view.lens.project(p_cam);
      canvas.line(pixel, pixel + kMagnified * off, kLeftOver, 1);
    }
  }

  void draw_axes() {
    const std::array<Ink, 3> inks{Ink{210, 30, 30}, Ink{30, 150, 40}, Ink{40, 70, 220}};
    const Eigen::Vector3d origin = in_camera(Eigen::Vector3d::Zero());
    for (int axis = 0; axis < 3; ++axis) {
      const Eigen::Vector3d tip = in_camera(kAxis_m * Eigen::Vector3d::Unit(axis));
      if (origin.z() < 1e-3 || tip.z() < 1e-3) continue;
      canvas.line(view.lens.project(origin), view.lens.project(tip), inks[std::size_t(axis)], 2);
    }
  }
};

/// Draws what is seen of an object. @returns its highest point on the image, where its name goes:
/// nothing if it is not seen.
std::optional<Eigen::Vector2d> draw_object(OverlaySheet& sheet, const KnownObject& object,
                                           const Ink& ink, const std::vector<MeshEdge>& edges,
                                           const Scene& rays) {
  const Intrinsics& k = sheet.view.lens.intrinsics();
  std::optional<Eigen::Vector2d> top;
  for (const OutlinePiece& piece :
       outline(edges, object.T_world_object, sheet.view.lens, *sheet.view.T_world_cam, rays)) {
    if (!piece.visible) continue;
    sheet.canvas.line(piece.from, piece.to, ink, 2);
    const Eigen::Vector2d& p = piece.from;
    const bool inside = p.x() > 0 && p.y() > 0 && p.x() < k.width && p.y() < k.height;
    if (inside && (!top || p.y() < top->y())) top = p;
  }
  return top;
}

void tag_object(OverlaySheet& sheet, const KnownObject& object, const Eigen::Vector2d& top,
                const Ink& ink) {
  const bool sure = object.probability > 0.985;
  sheet.canvas.tag(
      top, sure ? object.name : fmt::format("{} {:.2f}?", object.name, object.probability), ink);
}

std::string place_text(const BopImage& image, const CameraView& view,
                       const CameraLocation& location) {
  if (!view.T_world_cam) return fmt::format("image {}: not located: {}", image.id, location.reason);
  if (!location.pose) return fmt::format("image {}: pose from the dataset", image.id);
  return fmt::format("image {}: located by {} board markers, {:.2f} px rms", image.id,
                     location.inliers.size(), location.pose->rms_px);
}

}  // namespace

OverlayPainter::OverlayPainter(const BopScene& scene, const SceneReconstruction& reconstruction,
                               const std::vector<KnownObject>& objects)
    : scene_(scene), reconstruction_(reconstruction), objects_(objects) {
  SceneBuilder builder;
  for (const KnownObject& object : objects) {
    builder.add_instance(object.mesh, object.T_world_object);
    if (!edges_.contains(object.mesh.get())) edges_[object.mesh.get()] = edges_of(*object.mesh);
  }
  rays_ = builder.build();
}

ColorImage OverlayPainter::paint(std::size_t image) const {
  const ObservedScene& observed = reconstruction_.observed;
  const CameraView& view = observed.views[image];
  const CameraLocation& location = observed.locations[image];
  OverlaySheet sheet{view, OverlayCanvas(read_color(scene_.images[image].color))};

  for (std::size_t i = 0; i < observed.board[image].size(); ++i) {
    const auto& wrong = location.outliers;
    const bool is_wrong = std::find(wrong.begin(), wrong.end(), i) != wrong.end();
    sheet.mark_points(observed.board[image][i], is_wrong ? kLeftOver : kBoard, is_wrong);
  }
  std::set<std::size_t> explained;
  const auto& found = reconstruction_.result.objects;
  for (const ReconstructedObject& object : found) {
    for (const Support& support : object.support) {
      if (support.id.view != image) continue;
      explained.insert(support.id.observation);
      const Observation& seen = view.observations[support.id.observation];
      sheet.mark_points(seen, kExplained, false);
      std::vector<Eigen::Vector3d> points = object.type->features[support.feature].points();
      for (Eigen::Vector3d& p : points) p = object.T_world_object * p;
      sheet.draw_residuals(seen, points);
    }
  }
  for (std::size_t i = 0; i < view.observations.size(); ++i) {
    if (!explained.contains(i)) sheet.mark_points(view.observations[i], kLeftOver, true);
  }
  if (view.T_world_cam) {
    sheet.draw_axes();
    const auto ink = [](std::size_t i) { return kObjectInks[i % kObjectInks.size()]; };
    std::vector<std::optional<Eigen::Vector2d>> tops;
    for (std::size_t i = 0; i < objects_.size(); ++i) {
      tops.push_back(
          draw_object(sheet, objects_[i], ink(i), edges_.at(objects_[i].mesh.get()), *rays_));
    }
    for (std::size_t i = 0; i < objects_.size(); ++i) {
      if (tops[i]) tag_object(sheet, objects_[i], *tops[i], ink(i));
    }
  }
  return sheet.canvas.finished(
      {place_text(scene_.images[image], view, location),
       fmt::format(
           "green rings: features of objects, red lines: their errors x {:.0f}; grey rings: "
           "the board's; red crosses: left over",
           kMagnified)});
}

}  // namespace vantage
