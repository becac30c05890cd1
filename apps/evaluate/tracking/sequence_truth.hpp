#pragma once

#include <map>
#include <vector>

#include "metrics/tracking/event_scores.hpp"
#include "metrics/tracking/track_frame.hpp"
#include "simulator/sequence/sequence_simulator.hpp"

namespace vantage {

/// The types of a knowledge base by number, with what pose errors look at.
struct TypeModels {
  std::vector<ErrorModel> models;
  std::map<const ObjectType*, std::size_t> index;

  explicit TypeModels(const KnowledgeBase& knowledge);
};

/// What is true of a sequence, and what of it can be known.
struct SequenceTruth {
  std::vector<std::vector<TruthAt>> frames;  ///< one for each instant
  std::vector<TrueEvent> events;
};

/// An object is judged from the first instant in which a camera sees it where it stands, until it
/// leaves that place. It moved, or appeared, in that instant (what is seen in the first instant was
/// there); it disappeared in the first one in
/// which a camera would see it at its last place, if it were still there.
/// @param seen of the plan's objects, at each instant.
SequenceTruth sequence_truth(const SequenceSimulator& simulator,
                             std::span<const std::vector<bool>> seen, const TypeModels& types);

}  // namespace vantage
