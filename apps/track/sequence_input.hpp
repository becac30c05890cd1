#pragma once

#include <filesystem>
#include <vector>

namespace vantage {

/// A recording of one time.
struct SequenceInstant {
  std::filesystem::path folder;  ///< a BOP scene folder
  double time_s = 0;
  std::vector<int> images = {};  ///< of the folder; empty: all
};

/// The instants of a recording over time, in ascending order: those of its `sequence.json`; without
/// such a file the BOP scene folders whose names are numbers (000000, 000001, …), number n at
/// n × `period_s`.
/// @throws Error bad_input for a folder without instants, one that is missing, times that do not
/// grow, and a sequence.json that is not as assets/schema/sequence.schema.json has it.
std::vector<SequenceInstant> read_sequence(const std::filesystem::path& folder, double period_s);

}  // namespace vantage
