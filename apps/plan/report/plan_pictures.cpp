#include "plan/report/plan_pictures.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "plan/report/plan_shapes.hpp"
#include "vantage/raycore/advanced/picture.hpp"
#include "vantage/raycore/advanced/scene_builder.hpp"
#include "vantage/raycore/image_io.hpp"
#include "vantage/raycore/mesh_io.hpp"

namespace vantage {
namespace {

double azimuth_of(const Eigen::Vector3d& v) {
  return std::atan2(v.y(), v.x());
}

/// From which azimuth to look: beside the suggested camera, on the side where the mean of the given
/// ones is, so that both of them are seen and neither stands in the way.
double overview_azimuth(const Plan& plan, const WorldModel& world) {
  const Eigen::Vector3d centre = plan.request.work_area.centre();
  Eigen::Vector3d given = Eigen::Vector3d::Zero();
  for (const DepthCamera& observer : world.cameras) given += observer.camera.centre() - centre;
  const double given_azimuth = azimuth_of(given);
  const std::vector<PinholeCamera> cameras = suggested_cameras(plan);
  if (cameras.empty()) return given_azimuth + std::numbers::pi / 3;
  const Eigen::Vector3d suggested = cameras.front().centre() - centre;
  const bool from_above = suggested.head<2>().norm() < 0.3 * suggested.norm();
  if (from_above) return given_azimuth + std::numbers::pi / 3;
  const double turn = std::remainder(given_azimuth - azimuth_of(suggested), 2 * std::numbers::pi);
  return azimuth_of(suggested) + (turn < 0 ? -1 : 1) * std::numbers::pi / 3.6;
}

}  // namespace

PinholeCamera overview_camera(const Plan& plan, const WorldModel& world, int width) {
  const int height = std::max(1, width * 5 / 8);
  std::vector<Eigen::Vector3d> points;
  for (const ColoredMesh& part : camera_meshes(plan, world)) {
    for (const Eigen::Vector3f& p : part.mesh.vertices()) points.push_back(p.cast<double>());
  }
  Eigen::Vector3d low = points.front(), high = points.front();
  for (const Eigen::Vector3d& p : points) low = low.cwiseMin(p), high = high.cwiseMax(p);
  const Eigen::Vector3d centre = 0.5 * (low + high);
  const double azimuth = overview_azimuth(plan, world), elevation = 0.48;
  const Eigen::Vector3d direction(std::cos(elevation) * std::cos(azimuth),
                                  std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
  const Pose pose = Pose::looking_at(centre + 1.5 * (high - low).norm() * direction, centre);

  const PinholeCamera unit({width, height, 1, 1, 0, 0}, pose);
  Eigen::Array2d least(1e9, 1e9), most(-1e9, -1e9);
  for (const Eigen::Vector3d& p : points) {
    const std::optional<ImagePoint> q = unit.project(p);
    least = least.min(Eigen::Array2d(q->u, q->v)), most = most.max(Eigen::Array2d(q->u, q->v));
  }
  const Eigen::Array2d size(width, height);
  const double focal = (0.93 * size / (most - least)).minCoeff();
  const Eigen::Array2d principal = 0.5 * size - focal * 0.5 * (least + most);
  return PinholeCamera({width, height, focal, focal, principal.x(), principal.y()}, pose);
}

namespace {

const Eigen::Vector3f kFloor(0.90f, 0.90f, 0.91f);
constexpr int kSamplesPerPixel = 64;

/// The mean of two pictures of one size, `share` of it from the first.
ColorImage blended(const ColorImage& a, const ColorImage& b, double share) {
  ColorImage result = a;
  for (std::size_t i = 0; i < result.samples.size(); ++i) {
    result.samples[i] =
        std::uint8_t(std::lround(share * a.samples[i] + (1 - share) * b.samples[i]));
  }
  return result;
}

/// A scene to draw, with its objects' looks.
class Stage {
 public:
  explicit Stage(const Plan& plan) : plan_(plan) {}

  void add_voxels() {
    const GridGeometry& geometry = plan_.grid->geometry();
    for (const ColoredMesh& part : voxel_meshes(*plan_.grid)) {
      Material material{part.color};
      material.line_spacing_m = float(geometry.voxel_size_m());
      material.line_width_m = 0.1f * material.line_spacing_m;
      material.line_shade = 0.55f;
      material.line_origin = geometry.origin().cast<float>();
      if (part.opacity < 1) opacity_ = double(part.opacity);
      (part.opacity < 1 ? veil_ : props_).push_back({part.mesh, material});
    }
  }

  void add_cameras(const WorldModel& world) {
    for (const ColoredMesh& part : camera_meshes(plan_, world)) {
      props_.push_back({part.mesh, {part.color}});
    }
  }

  void add_floor() {
    const double scale = scale_of(plan_), side = 40 * scale;
    const Eigen::Vector3d centre = plan_.request.work_area.centre();
    const double top = std::min(0.0, plan_.request.work_area.min().z()) - 1e-3 * scale;
    Material material{kFloor};
    material.line_spacing_m = 0.1f;
    material.line_width_m = 0.002f;
    material.line_shade = 0.85f;
    material.fade_centre = Eigen::Vector3d(centre.x(), centre.y(), top).cast<float>();
    material.fade_from_m = float(2 * scale);
    material.fade_to_m = float(7 * scale);
    const Box slab(Eigen::Vector3d(centre.x() - side, centre.y() - side, top - 0.1),
                   Eigen::Vector3d(centre.x() + side, centre.y() + side, top));
    props_.push_back({TriangleMesh::from_box(slab), material});
  }

  /// Draws everything, and once more without what is half transparent, and lays one over the other.
  /// @returns nothing if it was stopped.
  std::optional<ColorImage> draw(const PinholeCamera& camera, const StopToken& stop) const {
    std::vector<Prop> all = props_;
    all.insert(all.end(), veil_.begin(), veil_.end());
    const auto with_veil = picture(all, camera, opacity_, stop);
    const auto without = picture(props_, camera, 1 - opacity_, stop);
    if (!with_veil || !without) return std::nullopt;
    return blended(*with_veil, *without, opacity_);
  }

 private:
  struct Prop {
    TriangleMesh mesh;
    Material material;
  };

  /// `share` of the samples is enough for a picture that is `share` of the result.
  std::optional<ColorImage> picture(const std::vector<Prop>& props, const PinholeCamera& camera,
                                    double share, const StopToken& stop) const {
    PictureOptions options;
    options.samples_per_pixel = int(std::lround(kSamplesPerPixel * share));
    options.sky_reach_m = float(1.2 * scale_of(plan_));
    // From above, over the viewer's left shoulder: what is seen is lit, and shadows fall aside.
    const Eigen::Matrix3d& R = camera.T_world_cam().rotation();
    const Eigen::Vector3d back =
        (-R.col(2) - 0.9 * R.col(0)).cwiseProduct(Eigen::Vector3d(1, 1, 0));
    options.to_sun = (back.normalized() + Eigen::Vector3d(0, 0, 1.25)).cast<float>();
    SceneBuilder builder;
    std::vector<Material> materials;
    for (const Prop& prop : props) {
      builder.add_mesh(prop.mesh);
      materials.push_back(prop.material);
    }
    return render_picture(*builder.build(), materials, camera, options, stop);
  }

  const Plan& plan_;
  std::vector<Prop> props_;
  std::vector<Prop> veil_;  ///< what is drawn half transparent: one sees what stands inside
  double opacity_ = 1;      ///< of the veil
};

}  // namespace

std::optional<ColorImage> overview(const Plan& plan, const WorldModel& world, int width,
                                   const StopToken& stop) {
  Stage stage(plan);
  stage.add_voxels();
  stage.add_cameras(world);
  stage.add_floor();
  return stage.draw(overview_camera(plan, world, width), stop);
}

void write_overview(const std::filesystem::path& path, const Plan& plan, const WorldModel& world,
                    int width, const StopToken& stop) {
  if (const auto image = overview(plan, world, width, stop)) write_png(path, *image);
}

void write_suggested_view(const std::filesystem::path& path, const Plan& plan,
                          const StopToken& stop) {
  Stage stage(plan);
  stage.add_voxels();
  stage.add_floor();
  const auto image = stage.draw(suggested_cameras(plan).at(0), stop);
  if (image) write_png(path, *image);
}

void write_scene_model(const std::filesystem::path& path, const Plan& plan,
                       const WorldModel& world) {
  std::vector<ColoredMesh> meshes = voxel_meshes(*plan.grid);
  for (ColoredMesh& mesh : camera_meshes(plan, world)) meshes.push_back(std::move(mesh));
  write_glb(path, meshes);
}

}  // namespace vantage
