#include <Eigen/Cholesky>
#include <algorithm>
#include <numeric>

#include "pose/pose_manifold.hpp"
#include "support/resting_face.hpp"
#include "support/support_steps.hpp"
#include "vantage/reconstruction/support.hpp"

namespace vantage {
namespace {

using reconstruction::detail::contact_scene;
using reconstruction::detail::ContactPatch;
using reconstruction::detail::ContactScene;
using reconstruction::detail::exp_of;
using reconstruction::detail::motion_row;
using reconstruction::detail::resting_distances;
using reconstruction::detail::RestingDistance;
using reconstruction::detail::SupportBody;

using Vector6d = Eigen::Matrix<double, 6, 1>;

/// Of normalised distances squared, beyond which the contact is not what the poses say: three
/// degrees of freedom, one in a thousand.
constexpr double kContradicts = 16.3;

/// All distances of an object to what it stands on, linear in its step (t, r).
struct ContactMeasurement {
  Eigen::VectorXd gaps;
  Eigen::MatrixXd rows;   ///< by the object's step
  Eigen::MatrixXd noise;  ///< covariance of all but the object's own pose

  void add(std::span<const RestingDistance> distances, const SupportBody& upper,
           const SupportOptions& options) {
    const Eigen::Index had = gaps.size(), more = Eigen::Index(distances.size());
    gaps.conservativeResize(had + more);
    rows.conservativeResize(had + more, 6);
    Eigen::MatrixXd all = Eigen::MatrixXd::Zero(had + more, had + more);
    all.topLeftCorner(had, had) = noise;
    const double common = options.surface_sigma_m * options.surface_sigma_m;
    const double own = options.flatness_sigma_m * options.flatness_sigma_m;
    all.bottomRightCorner(more, more).setConstant(common);
    all.bottomRightCorner(more, more).diagonal().array() += own;
    noise = all;
    for (Eigen::Index i = 0; i < more; ++i) {
      const RestingDistance& distance = distances[std::size_t(i)];
      gaps[had + i] = distance.gap_m;
      rows.row(had + i) = motion_row(upper, distance.point, distance.normal);
    }
  }

  /// The lower body has moved by `step`, and is uncertain, too.
  void consider(std::span<const RestingDistance> distances, const SupportBody& lower,
                const Vector6d& step, const Matrix6d& covariance) {
    const Eigen::Index more = Eigen::Index(distances.size()), first = gaps.size() - more;
    Eigen::MatrixXd by_lower(more, 6);
    for (Eigen::Index i = 0; i < more; ++i) {
      const RestingDistance& distance = distances[std::size_t(i)];
      by_lower.row(i) = motion_row(lower, distance.point, distance.normal);
    }
    gaps.tail(more) -= by_lower * step;
    noise.block(first, first, more, more) += by_lower * covariance * by_lower.transpose();
  }
};

class ContactPuller {
 public:
  ContactPuller(const ContactScene& scene, const SupportOptions& options,
                std::vector<ObjectSupport>& support, std::span<ReconstructedObject> objects)
      : options_(options),
        support_(support),
        objects_(objects),
        bodies_(scene.bodies),
        patches_(scene.patches),
        steps_(objects.size(), Vector6d::Zero()),
        is_done_(objects.size(), false) {}

  void run() {
    std::vector<std::size_t> order(objects_.size());
    std::iota(order.begin(), order.end(), std::size_t(0));
    std::ranges::stable_sort(order, {}, [&](std::size_t i) { return bodies_[i].bounds.min().z(); });
    for (const std::size_t i : order) {
      const bool stands = support_[i].verdict == SupportVerdict::stands;
      if (stands && objects_[i].covariance) pull(i);
      is_done_[i] = stands;
    }
  }

 private:
  void pull(std::size_t object) {
    ContactMeasurement contact;
    for (const ContactPatch& patch : patches_) {
      if (patch.upper != object) continue;
      const bool by_object = patch.lower < objects_.size();
      if (by_object && !is_done_[patch.lower]) continue;
      const auto distances = resting_distances(bodies_, patch);
      contact.add(distances, bodies_[object], options_);
      if (!by_object) continue;
      const std::optional<Matrix6d>& covariance = objects_[patch.lower].covariance;
      contact.consider(distances, bodies_[patch.lower], steps_[patch.lower],
                       covariance ? *covariance : Matrix6d::Zero());
    }
    if (contact.gaps.size() > 0) update(object, contact);
  }

  /// Kalman's, in Joseph's form.
  void update(std::size_t index, const ContactMeasurement& contact) {
    ReconstructedObject& object = objects_[index];
    const Matrix6d prior = *object.covariance;
    const Eigen::MatrixXd& rows = contact.rows;
    const Eigen::MatrixXd innovation = rows * prior * rows.transpose() + contact.noise;
    const Eigen::LDLT<Eigen::MatrixXd> solver(innovation);
    if (solver.info() != Eigen::Success) return;
    if (!(contact.gaps.dot(solver.solve(contact.gaps)) < kContradicts)) return;
    const Eigen::MatrixXd gain = solver.solve(rows * prior).transpose();
    const Vector6d step = -gain * contact.gaps;
    const Matrix6d kept = Matrix6d::Identity() - gain * rows;
    object.covariance =
        Matrix6d(kept * prior * kept.transpose() + gain * contact.noise * gain.transpose());
    if (object.noise_covariance) {
      object.noise_covariance = Matrix6d(kept * *object.noise_covariance * kept.transpose());
    }
    const Pose& pose = object.T_world_object;
    object.T_world_object =
        Pose::from_quaternion((exp_of(step.tail<3>()) * pose.quaternion()).normalized(),
                              pose.translation() + step.head<3>());
    steps_[index] = step;
    support_[index].pulled = true;
  }

  const SupportOptions& options_;
  std::vector<ObjectSupport>& support_;
  std::span<ReconstructedObject> objects_;
  std::span<const SupportBody> bodies_;
  std::span<const ContactPatch> patches_;
  std::vector<Vector6d> steps_;
  std::vector<bool> is_done_;
};

}  // namespace

void reconstruction::detail::pull(const ContactScene& scene, const SupportOptions& options,
                                  std::vector<ObjectSupport>& support,
                                  std::span<ReconstructedObject> objects) {
  ContactPuller(scene, options, support, objects).run();
}

void pull_to_contact(std::span<const KnownObject> structures, const SupportOptions& options,
                     std::vector<ObjectSupport>& support, std::span<ReconstructedObject> objects) {
  ContactPuller(contact_scene(objects, structures, options), options, support, objects).run();
}

}  // namespace vantage
