#include "vantage/reconstruction/check_support.hpp"

#include "support/support_steps.hpp"

namespace vantage {

std::vector<ObjectSupport> check_support(std::span<const KnownObject> structures,
                                         const SpaceProbe& space, const SupportOptions& options,
                                         std::span<ReconstructedObject> objects) {
  const auto scene = reconstruction::detail::contact_scene(objects, structures, options);
  auto support = reconstruction::detail::judge(objects.size(), scene, space, options);
  reconstruction::detail::pull(scene, options, support, objects);
  lower_unsupported(support, objects);
  return support;
}

}  // namespace vantage
