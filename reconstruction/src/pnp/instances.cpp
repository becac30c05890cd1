#include "pnp/instances.hpp"

#include <algorithm>
#include <iterator>
#include <map>

#include "pose/symmetry.hpp"

namespace vantage::reconstruction::detail {
namespace {

/// Sets of types that are one, by union and find.
class TypeSets {
 public:
  const ObjectType* root_of(const ObjectType* type) {
    const auto found = parent_.try_emplace(type, type).first->second;
    return found == type ? type : parent_[type] = root_of(found);
  }
  void join(const ObjectType* a, const ObjectType* b) { parent_[root_of(a)] = root_of(b); }

 private:
  std::map<const ObjectType*, const ObjectType*> parent_;
};

void add_readings(const Measurement& measurement, Component& component) {
  const std::size_t number = component.measurements.size();
  component.measurements.push_back(&measurement);
  for (const TypeFeature* feature : measurement.features) {
    const ObjectFeature& geometry = feature->type->features[feature->index];
    if (measurement.points()) {
      component.correspondences.push_back({&measurement, number, feature, geometry.points(), {}});
      continue;
    }
    const Pose& frame = *frame_of(geometry);
    component.correspondences.push_back({&measurement, number, feature, {}, frame});
    for (const Pose& symmetry : feature->type->symmetries.discrete) {
      component.correspondences.push_back({&measurement, number, feature, {}, symmetry * frame});
    }
  }
}

/// Searches a component's hypotheses.
class Search {
 public:
  Search(const Component& component, const InlierThresholds& thresholds)
      : component_(component),
        thresholds_(thresholds),
        groups_(find_minimal_samples(component.correspondences)) {}

  /// Takes out what explains most, until nothing explains anything.
  std::vector<PoseHypothesis> split() {
    std::vector<PoseHypothesis> objects;
    std::vector<bool> free(component_.measurements.size(), true);
    while (true) {
      std::vector<PoseHypothesis> found = hypotheses(free);
      std::stable_sort(found.begin(), found.end(), [&](const auto& a, const auto& b) {
        return a.score(thresholds_) > b.score(thresholds_);
      });
      const std::size_t before = objects.size();
      for (PoseHypothesis& candidate : found) {
        if (!all(candidate, free)) continue;
        for (const Correspondence* correspondence : candidate.correspondences)
          free[correspondence->number] = false;
        objects.push_back(std::move(candidate));
      }
      if (objects.size() == before) return objects;
    }
  }

  /// Every way to explain what this object explains.
  Instance alternatives(const PoseHypothesis& object) {
    Instance voted_hypotheses = {object};
    if (unambiguous(object)) return voted_hypotheses;
    std::vector<bool> mine(component_.measurements.size(), false);
    for (const Correspondence* correspondence : object.correspondences)
      mine[correspondence->number] = true;
    for (SampleGroup& group : groups_) {
      if (!within(group, mine)) continue;
      for (PoseHypothesis& voted : grown_from(group, mine)) {
        if (voted.correspondences.size() == object.correspondences.size())
          add_way(std::move(voted), voted_hypotheses);
      }
      if (voted_hypotheses.size() > 1) break;  // the largest group has said what there is
    }
    std::stable_sort(
        voted_hypotheses.begin(), voted_hypotheses.end(),
        [](const auto& a, const auto& b) { return a.sum.chi_square < b.sum.chi_square; });
    return voted_hypotheses;
  }

 private:
  static bool within(const SampleGroup& group, const std::vector<bool>& set) {
    return std::all_of(group.numbers.begin(), group.numbers.end(),
                       [&](std::size_t number) { return set[number]; });
  }

  static bool all(const PoseHypothesis& hypothesis, const std::vector<bool>& set) {
    return std::all_of(
        hypothesis.correspondences.begin(), hypothesis.correspondences.end(),
        [&](const Correspondence* correspondence) { return set[correspondence->number]; });
  }

  /// From several sides, and by features that can only be what they are.
  bool unambiguous(const PoseHypothesis& object) const {
    const auto view = [](const Correspondence* correspondence) {
      return correspondence->measurement->id.view;
    };
    const bool one_view =
        view(object.correspondences.front()) == view(object.correspondences.back());
    return !one_view && object.correspondences.size() >= kReliableMeasurements &&
           std::all_of(object.correspondences.begin(), object.correspondences.end(),
                       [](const Correspondence* correspondence) {
                         return correspondence->measurement->features.size() == 1;
                       });
  }

  void add_way(PoseHypothesis voted, Instance& voted_hypotheses) const {
    const bool known = std::any_of(
        voted_hypotheses.begin(), voted_hypotheses.end(), [&](const PoseHypothesis& other) {
          return voted.type() == other.type() &&
                 equivalent(*voted.type(), voted.T_world_object, other.T_world_object);
        });
    if (!known) voted_hypotheses.push_back(std::move(voted));
  }

  std::vector<const Correspondence*> pool(const ObjectType& type,
                                          const std::vector<bool>& free) const {
    std::vector<const Correspondence*> pool;
    for (const Correspondence& correspondence : component_.correspondences) {
      if (free[correspondence.number] && &correspondence.type() == &type)
        pool.push_back(&correspondence);
    }
    return pool;
  }

  std::vector<PoseHypothesis> grown_from(SampleGroup& group, const std::vector<bool>& free) {
    std::vector<PoseHypothesis> expanded;
    for (MinimalSample& seed : group.samples) {
      const auto correspondences = pool(seed.correspondences().front()->type(), free);
      for (const Pose& pose : seed.poses()) {
        auto hypothesis =
            expand_consensus(seed.correspondences(), pose, correspondences, thresholds_);
        if (hypothesis && hypothesis->sum.points >= kMinPoints) {
          expanded.push_back(std::move(*hypothesis));
        }
      }
    }
    return expanded;
  }

  /// Grown from all samples but those that a firm hypothesis has taken in already.
  std::vector<PoseHypothesis> hypotheses(const std::vector<bool>& free) {
    std::vector<PoseHypothesis> found;
    std::vector<bool> open = free;
    for (SampleGroup& group : groups_) {
      if (!within(group, open)) continue;
      for (PoseHypothesis& hypothesis : grown_from(group, free)) {
        if (hypothesis.correspondences.size() >= kReliableMeasurements) {
          for (const Correspondence* correspondence : hypothesis.correspondences)
            open[correspondence->number] = false;
        }
        found.push_back(std::move(hypothesis));
      }
    }
    return found;
  }

  const Component& component_;
  const InlierThresholds thresholds_;
  std::vector<SampleGroup> groups_;
};

}  // namespace

std::vector<Component> split_into_components(std::span<const Measurement> measurements) {
  TypeSets sets;
  for (const Measurement& measurement : measurements) {
    for (const TypeFeature* feature : measurement.features) {
      sets.join(feature->type.get(), measurement.features.front()->type.get());
    }
  }
  std::map<const ObjectType*, std::size_t> index;  // never walked: addresses have no order
  std::vector<Component> components;
  for (const Measurement& measurement : measurements) {
    const ObjectType* root = sets.root_of(measurement.features.front()->type.get());
    const auto [place, is_new] = index.try_emplace(root, components.size());
    if (is_new) components.emplace_back();
    add_readings(measurement, components[place->second]);
  }
  return components;
}

std::vector<Instance> find_instances(const Component& component,
                                     const InlierThresholds& thresholds) {
  Search search(component, thresholds);
  std::vector<PoseHypothesis> objects = search.split();
  merge_and_reassign(objects, component, thresholds);
  std::vector<Instance> instances;
  for (const PoseHypothesis& object : objects) {
    instances.push_back(search.alternatives(object));
  }
  return instances;
}

namespace {

constexpr int kMovesPerSighting = 10;

std::vector<const Correspondence*> joined(const PoseHypothesis& a, const PoseHypothesis& b) {
  std::vector<const Correspondence*> correspondences = a.correspondences;
  correspondences.insert(correspondences.end(), b.correspondences.begin(), b.correspondences.end());
  return correspondences;
}

/// Both as one object, if one can explain them all.
std::optional<PoseHypothesis> merged(const PoseHypothesis& a, const PoseHypothesis& b,
                                     const InlierThresholds& thresholds) {
  if (a.type() != b.type()) return std::nullopt;
  const bool room = std::all_of(
      b.correspondences.begin(), b.correspondences.end(),
      [&](const Correspondence* correspondence) { return a.has_room_for(*correspondence); });
  if (!room) return std::nullopt;
  const bool a_first = a.correspondences.size() >= b.correspondences.size();
  auto one = explain(joined(a, b), (a_first ? a : b).T_world_object, thresholds);
  if (!one) one = explain(joined(a, b), (a_first ? b : a).T_world_object, thresholds);
  return one;
}

bool merge_any(std::vector<PoseHypothesis>& objects, const InlierThresholds& thresholds) {
  for (std::size_t i = 0; i < objects.size(); ++i) {
    for (std::size_t j = i + 1; j < objects.size(); ++j) {
      auto one = merged(objects[i], objects[j], thresholds);
      if (!one) continue;
      objects[i] = std::move(*one);
      objects.erase(objects.begin() + std::ptrdiff_t(j));
      return true;
    }
  }
  return false;
}

/// The correspondence of the same measurement by which another object explains it best.
const Correspondence* reading_by(const PoseHypothesis& object, const Correspondence& own,
                                 double own_chi_square, const Component& component,
                                 const InlierThresholds& thresholds) {
  const Correspondence* best = nullptr;
  double least = own_chi_square;
  for (const Correspondence& correspondence : component.correspondences) {
    if (correspondence.number != own.number || &correspondence.type() != object.type().get())
      continue;
    if (!object.has_room_for(correspondence)) continue;
    const LinearSystem e =
        linear_system_of(correspondence, object.T_world_object, thresholds.min_sigma_px());
    if (!e.in_front || !(e.chi_square < least)) continue;
    best = &correspondence;
    least = e.chi_square;
  }
  return best;
}

/// Moves correspondence `r` of `from` to the object `to`, if it fits better there, although `to`
/// was fitted without it, and `from` with it. `from` may be left without any.
bool move_reading(PoseHypothesis& from, std::size_t r, PoseHypothesis& to,
                  const Component& component, const InlierThresholds& thresholds) {
  const Correspondence* correspondence =
      reading_by(to, *from.correspondences[r], from.each[r].chi_square, component, thresholds);
  if (!correspondence) return false;
  auto more = to.correspondences;
  more.push_back(correspondence);
  auto expanded = explain(std::move(more), to.T_world_object, thresholds);
  if (!expanded) return false;
  auto rest = from.correspondences;
  rest.erase(rest.begin() + std::ptrdiff_t(r));
  if (!rest.empty()) {
    auto left = explain(std::move(rest), from.T_world_object, thresholds);
    if (!left) return false;
    from = std::move(*left);
  } else {
    from.correspondences.clear();
  }
  to = std::move(*expanded);
  return true;
}

bool move_any(std::vector<PoseHypothesis>& objects, const Component& component,
              const InlierThresholds& thresholds) {
  for (std::size_t i = 0; i < objects.size(); ++i) {
    for (std::size_t j = 0; j < objects.size(); ++j) {
      if (i == j) continue;
      for (std::size_t r = 0; r < objects[i].correspondences.size(); ++r) {
        if (!move_reading(objects[i], r, objects[j], component, thresholds)) continue;
        if (objects[i].correspondences.empty()) objects.erase(objects.begin() + std::ptrdiff_t(i));
        return true;
      }
    }
  }
  return false;
}

}  // namespace

void merge_and_reassign(std::vector<PoseHypothesis>& objects, const Component& component,
                        const InlierThresholds& thresholds) {
  const std::size_t most = kMovesPerSighting * (1 + component.measurements.size());
  for (std::size_t step = 0; step < most; ++step) {
    if (!merge_any(objects, thresholds) && !move_any(objects, component, thresholds)) return;
  }
}

}  // namespace vantage::reconstruction::detail
