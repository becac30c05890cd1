#include <algorithm>
#include <iterator>

#include "pnp/instances.hpp"

namespace vantage::detail {
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
