#pragma once

#include <algorithm>
#include <span>
#include <string>
#include <vector>

#include "simulator/sheet/contact_sheet.hpp"

namespace vantage {

/// Where the parts of a contact sheet lie, in cells: columns from the left, rows from the top.
struct SheetBlock {
  std::string scene;
  int row = 0, column = 0;            ///< of its first thumbnail
  std::vector<std::size_t> pictures;  ///< from left to right, then on in the next row

  /// How many columns and rows it takes of a sheet with so many columns.
  int width(int columns) const { return std::min(int(pictures.size()), columns); }
  int height(int columns) const { return (int(pictures.size()) + columns - 1) / columns; }
};

struct SheetLayout {
  int columns = 0, rows = 0;  ///< that are in use
  std::vector<SheetBlock> blocks;
};

/// Blocks of scenes in the order in which the scenes first come. Each stands in the first row that
/// has room for it beside those before; one of several rows stands alone.
SheetLayout layout_sheet(std::span<const LabelledPicture> pictures, int columns);

}  // namespace vantage
