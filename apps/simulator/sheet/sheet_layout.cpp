#include "simulator/sheet/sheet_layout.hpp"

namespace vantage {
namespace {

std::vector<SheetBlock> group_by_scene(std::span<const LabelledPicture> pictures) {
  std::vector<SheetBlock> blocks;
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    const auto block = std::find_if(blocks.begin(), blocks.end(), [&](const SheetBlock& b) {
      return b.scene == pictures[i].scene;
    });
    if (block == blocks.end()) {
      blocks.push_back({pictures[i].scene, 0, 0, {i}});
    } else {
      block->pictures.push_back(i);
    }
  }
  return blocks;
}

}  // namespace

SheetLayout layout_sheet(std::span<const LabelledPicture> pictures, int columns) {
  SheetLayout layout{0, 0, group_by_scene(pictures)};
  std::vector<int> used;  // columns of each row
  for (SheetBlock& block : layout.blocks) {
    const int width = block.width(columns), height = block.height(columns);
    auto row = used.end();  // nothing stands beside a block of several rows
    if (height == 1) {
      row = std::find_if(used.begin(), used.end(), [&](int u) { return u + width <= columns; });
    }
    block.row = int(row - used.begin());
    block.column = row == used.end() ? 0 : *row;
    if (row == used.end()) used.insert(used.end(), std::size_t(height), height > 1 ? columns : 0);
    if (height == 1) used[std::size_t(block.row)] += width;
    layout.columns = std::max(layout.columns, block.column + width);
  }
  layout.rows = int(used.size());
  return layout;
}

}  // namespace vantage
