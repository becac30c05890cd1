#include "simulator/sheet_layout.hpp"

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
  int row = 0, column = 0;  // where the next block may stand
  for (SheetBlock& block : layout.blocks) {
    const int width = block.width(columns), height = block.height(columns);
    if (column + width > columns) row = layout.rows, column = 0;
    block.row = row, block.column = column;
    column = height > 1 ? columns : column + width;  // nothing stands beside one of several rows
    layout.rows = std::max(layout.rows, row + height);
    layout.columns = std::max(layout.columns, block.column + width);
  }
  return layout;
}

}  // namespace vantage
