#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <vector>

#include "import/imported_dataset.hpp"
#include "vantage/raycore/stop_token.hpp"

namespace vantage {

/// Which images of a recording to take.
struct ImportChoice {
  int every = 1;                 ///< each such image, from the first one on
  std::vector<int> images = {};  ///< numbers, in the source's order from 0; empty: all
  std::optional<double> depth_scale_mm = {};
};

/// Writes a BOP scene folder: scene_camera.json, rgb/ and depth/ with the files as they are, a
/// calibration where lenses distort, and the record import.json, which is returned. An image keeps
/// its number in the source's order as its id. Warnings are added to the dataset's.
/// @throws Error bad_input for images that are not there or do not fit together, for a choice that
/// leaves none, and for a folder that has something else in it; cancelled if `stop` was.
nlohmann::ordered_json write_imported(ImportedDataset& dataset, const ImportChoice& choice,
                                      const std::filesystem::path& folder, const StopToken& stop);

}  // namespace vantage
