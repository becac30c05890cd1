#include "pnp/instances.hpp"

#include <algorithm>
#include <iterator>
#include <map>

#include "pose/symmetry.hpp"

namespace vantage::detail {
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

void add_readings(const Sighting& sighting, Component& component) {
  const std::size_t number = component.sightings.size();
  component.sightings.push_back(&sighting);
  for (const TypeFeature* feature : sighting.features) {
    const ObjectFeature& geometry = feature->type->features[feature->index];
    if (sighting.points()) {
      component.readings.push_back({&sighting, number, feature, geometry.points(), {}});
      continue;
    }
    const Pose& frame = *frame_of(geometry);
    component.readings.push_back({&sighting, number, feature, {}, frame});
    for (const Pose& symmetry : feature->type->symmetries.discrete) {
      component.readings.push_back({&sighting, number, feature, {}, symmetry * frame});
    }
  }
}

/// Searches a component's explanations.
class Search {
 public:
  Search(const Component& component, const Bounds& bounds)
      : component_(component), bounds_(bounds), groups_(find_seeds(component.readings)) {}

  /// Takes out what explains most, until nothing explains anything.
  std::vector<Explanation> split() {
    std::vector<Explanation> objects;
    std::vector<bool> free(component_.sightings.size(), true);
    while (true) {
      std::vector<Explanation> found = hypotheses(free);
      std::stable_sort(found.begin(), found.end(), [&](const auto& a, const auto& b) {
        return a.score(bounds_) > b.score(bounds_);
      });
      const std::size_t before = objects.size();
      for (Explanation& candidate : found) {
        if (!all(candidate, free)) continue;
        for (const Reading* reading : candidate.readings) free[reading->number] = false;
        objects.push_back(std::move(candidate));
      }
      if (objects.size() == before) return objects;
    }
  }

  /// Every way to explain what this object explains.
  Instance alternatives(const Explanation& object) {
    Instance ways = {object};
    if (unambiguous(object)) return ways;
    std::vector<bool> mine(component_.sightings.size(), false);
    for (const Reading* reading : object.readings) mine[reading->number] = true;
    for (SeedGroup& group : groups_) {
      if (!within(group, mine)) continue;
      for (Explanation& way : grown_from(group, mine)) {
        if (way.readings.size() == object.readings.size()) add_way(std::move(way), ways);
      }
      if (ways.size() > 1) break;  // the largest group has said what there is
    }
    std::stable_sort(ways.begin(), ways.end(), [](const auto& a, const auto& b) {
      return a.sum.chi_square < b.sum.chi_square;
    });
    return ways;
  }

 private:
  static bool within(const SeedGroup& group, const std::vector<bool>& set) {
    return std::all_of(group.numbers.begin(), group.numbers.end(),
                       [&](std::size_t number) { return set[number]; });
  }

  static bool all(const Explanation& explanation, const std::vector<bool>& set) {
    return std::all_of(explanation.readings.begin(), explanation.readings.end(),
                       [&](const Reading* reading) { return set[reading->number]; });
  }

  /// From several sides, and by features that can only be what they are.
  bool unambiguous(const Explanation& object) const {
    const auto view = [](const Reading* reading) { return reading->sighting->id.view; };
    const bool one_view = view(object.readings.front()) == view(object.readings.back());
    return !one_view && object.readings.size() >= kFirm &&
           std::all_of(object.readings.begin(), object.readings.end(), [](const Reading* reading) {
             return reading->sighting->features.size() == 1;
           });
  }

  void add_way(Explanation way, Instance& ways) const {
    const bool known = std::any_of(ways.begin(), ways.end(), [&](const Explanation& other) {
      return way.type() == other.type() &&
             equivalent(*way.type(), way.T_world_object, other.T_world_object);
    });
    if (!known) ways.push_back(std::move(way));
  }

  std::vector<const Reading*> pool(const ObjectType& type, const std::vector<bool>& free) const {
    std::vector<const Reading*> pool;
    for (const Reading& reading : component_.readings) {
      if (free[reading.number] && &reading.type() == &type) pool.push_back(&reading);
    }
    return pool;
  }

  std::vector<Explanation> grown_from(SeedGroup& group, const std::vector<bool>& free) {
    std::vector<Explanation> grown;
    for (Seed& seed : group.seeds) {
      const auto readings = pool(seed.readings().front()->type(), free);
      for (const Pose& pose : seed.poses()) {
        auto explanation = grow(seed.readings(), pose, readings, bounds_);
        if (explanation && explanation->sum.points >= kFewestPoints) {
          grown.push_back(std::move(*explanation));
        }
      }
    }
    return grown;
  }

  /// Grown from all seeds but those that a firm hypothesis has taken in already.
  std::vector<Explanation> hypotheses(const std::vector<bool>& free) {
    std::vector<Explanation> found;
    std::vector<bool> open = free;
    for (SeedGroup& group : groups_) {
      if (!within(group, open)) continue;
      for (Explanation& explanation : grown_from(group, free)) {
        if (explanation.readings.size() >= kFirm) {
          for (const Reading* reading : explanation.readings) open[reading->number] = false;
        }
        found.push_back(std::move(explanation));
      }
    }
    return found;
  }

  const Component& component_;
  const Bounds bounds_;
  std::vector<SeedGroup> groups_;
};

}  // namespace

std::vector<Component> split_into_components(std::span<const Sighting> sightings) {
  TypeSets sets;
  for (const Sighting& sighting : sightings) {
    for (const TypeFeature* feature : sighting.features) {
      sets.join(feature->type.get(), sighting.features.front()->type.get());
    }
  }
  std::map<const ObjectType*, std::size_t> index;  // never walked: addresses have no order
  std::vector<Component> components;
  for (const Sighting& sighting : sightings) {
    const ObjectType* root = sets.root_of(sighting.features.front()->type.get());
    const auto [place, is_new] = index.try_emplace(root, components.size());
    if (is_new) components.emplace_back();
    add_readings(sighting, components[place->second]);
  }
  return components;
}

std::vector<Instance> find_instances(const Component& component, const Bounds& bounds) {
  Search search(component, bounds);
  std::vector<Explanation> objects = search.split();
  settle(objects, component, bounds);
  std::vector<Instance> instances;
  for (const Explanation& object : objects) {
    instances.push_back(search.alternatives(object));
  }
  return instances;
}

namespace {

constexpr int kMovesPerSighting = 10;

std::vector<const Reading*> joined(const Explanation& a, const Explanation& b) {
  std::vector<const Reading*> readings = a.readings;
  readings.insert(readings.end(), b.readings.begin(), b.readings.end());
  return readings;
}

/// Both as one object, if one can explain them all.
std::optional<Explanation> merged(const Explanation& a, const Explanation& b,
                                  const Bounds& bounds) {
  if (a.type() != b.type()) return std::nullopt;
  const bool room = std::all_of(b.readings.begin(), b.readings.end(),
                                [&](const Reading* reading) { return a.has_room_for(*reading); });
  if (!room) return std::nullopt;
  const bool a_first = a.readings.size() >= b.readings.size();
  auto one = explain(joined(a, b), (a_first ? a : b).T_world_object, bounds);
  if (!one) one = explain(joined(a, b), (a_first ? b : a).T_world_object, bounds);
  return one;
}

bool merge_any(std::vector<Explanation>& objects, const Bounds& bounds) {
  for (std::size_t i = 0; i < objects.size(); ++i) {
    for (std::size_t j = i + 1; j < objects.size(); ++j) {
      auto one = merged(objects[i], objects[j], bounds);
      if (!one) continue;
      objects[i] = std::move(*one);
      objects.erase(objects.begin() + std::ptrdiff_t(j));
      return true;
    }
  }
  return false;
}

/// The reading of the same sighting by which another object explains it best.
const Reading* reading_by(const Explanation& object, const Reading& own, double own_chi_square,
                          const Component& component, const Bounds& bounds) {
  const Reading* best = nullptr;
  double least = own_chi_square;
  for (const Reading& reading : component.readings) {
    if (reading.number != own.number || &reading.type() != object.type().get()) continue;
    if (!object.has_room_for(reading)) continue;
    const Evidence e = evidence_of(reading, object.T_world_object, bounds.least_sigma_px());
    if (!e.in_front || !(e.chi_square < least)) continue;
    best = &reading;
    least = e.chi_square;
  }
  return best;
}

/// Moves reading `r` of `from` to the object `to`, if it fits better there, although `to` was
/// fitted without it, and `from` with it. `from` may be left without any.
bool move_reading(Explanation& from, std::size_t r, Explanation& to, const Component& component,
                  const Bounds& bounds) {
  const Reading* reading =
      reading_by(to, *from.readings[r], from.each[r].chi_square, component, bounds);
  if (!reading) return false;
  auto more = to.readings;
  more.push_back(reading);
  auto grown = explain(std::move(more), to.T_world_object, bounds);
  if (!grown) return false;
  auto rest = from.readings;
  rest.erase(rest.begin() + std::ptrdiff_t(r));
  if (!rest.empty()) {
    auto left = explain(std::move(rest), from.T_world_object, bounds);
    if (!left) return false;
    from = std::move(*left);
  } else {
    from.readings.clear();
  }
  to = std::move(*grown);
  return true;
}

bool move_any(std::vector<Explanation>& objects, const Component& component, const Bounds& bounds) {
  for (std::size_t i = 0; i < objects.size(); ++i) {
    for (std::size_t j = 0; j < objects.size(); ++j) {
      if (i == j) continue;
      for (std::size_t r = 0; r < objects[i].readings.size(); ++r) {
        if (!move_reading(objects[i], r, objects[j], component, bounds)) continue;
        if (objects[i].readings.empty()) objects.erase(objects.begin() + std::ptrdiff_t(i));
        return true;
      }
    }
  }
  return false;
}

}  // namespace

void settle(std::vector<Explanation>& objects, const Component& component, const Bounds& bounds) {
  const std::size_t most = kMovesPerSighting * (1 + component.sightings.size());
  for (std::size_t step = 0; step < most; ++step) {
    if (!merge_any(objects, bounds) && !move_any(objects, component, bounds)) return;
  }
}

}  // namespace vantage::detail
