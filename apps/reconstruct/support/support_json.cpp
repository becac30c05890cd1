#include "reconstruct/support/support_json.hpp"

namespace vantage {
namespace {

std::string supporter_name(const Supporter& supporter, std::span<const KnownObject> objects,
                           std::span<const KnownObject> structures) {
  switch (supporter.kind) {
    case SupporterKind::structure:
      return structures[supporter.index].name;
    case SupporterKind::object:
      return objects[supporter.index].name;
    case SupporterKind::floor:
      return "floor";
    case SupporterKind::measured:
      return "measured surface";
    case SupporterKind::unseen:
      break;
  }
  return "unseen volume";
}

std::string kind_name(SupporterKind kind) {
  switch (kind) {
    case SupporterKind::structure:
      return "structure";
    case SupporterKind::object:
      return "object";
    case SupporterKind::floor:
      return "floor";
    case SupporterKind::measured:
      return "measured";
    case SupporterKind::unseen:
      break;
  }
  return "unseen";
}

nlohmann::ordered_json point_json(const Eigen::Vector3d& p) {
  return {p.x(), p.y(), p.z()};
}

}  // namespace

std::string verdict_name(SupportVerdict verdict) {
  switch (verdict) {
    case SupportVerdict::stands:
      return "stands";
    case SupportVerdict::unseen:
      return "unseen";
    case SupportVerdict::floats:
      return "floats";
    case SupportVerdict::tips:
      return "tips";
    case SupportVerdict::sinks:
      return "sinks";
    case SupportVerdict::unjudged:
      break;
  }
  return "unjudged";
}

nlohmann::ordered_json to_json(const ObjectSupport& support, std::span<const KnownObject> objects,
                               std::span<const KnownObject> structures) {
  using OrderedJson = nlohmann::ordered_json;
  OrderedJson by = OrderedJson::array();
  for (const Supporter& supporter : support.supported_by) {
    by.push_back({{"kind", kind_name(supporter.kind)},
                  {"name", supporter_name(supporter, objects, structures)}});
  }
  OrderedJson json{{"verdict", verdict_name(support.verdict)},
                   {"supported_by", by},
                   {"unseen_region", nullptr},
                   {"reason", support.reason.empty() ? OrderedJson() : OrderedJson(support.reason)},
                   {"pulled_to_contact", support.pulled}};
  if (support.unseen_region) {
    json["unseen_region"] = {{"min_m", point_json(support.unseen_region->min())},
                             {"max_m", point_json(support.unseen_region->max())}};
  }
  return json;
}

}  // namespace vantage
