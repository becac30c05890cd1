#include "grid/mask_blocks.hpp"

namespace vantage::volume::detail {
namespace {

void add_tile(const openvdb::Coord& origin, int side, std::vector<MaskBlock>& blocks) {
  for (int x = 0; x < side; x += 8)
    for (int y = 0; y < side; y += 8)
      for (int z = 0; z < side; z += 8) blocks.push_back({origin.offsetBy(x, y, z), nullptr});
}

template <class Node>
void add_node(const Node& node, std::vector<MaskBlock>& blocks) {
  if constexpr (Node::LEVEL == 0) {
    if (!node.getValueMask().isOff()) blocks.push_back({node.origin(), &node.getValueMask()});
  } else {
    const auto slots = node.getChildMask() | node.getValueMask();
    for (auto slot = slots.beginOn(); slot; ++slot) {
      if (node.getChildMask().isOn(slot.pos())) {
        add_node(*node.getTable()[slot.pos()].getChild(), blocks);
      } else {
        add_tile(node.offsetToGlobalCoord(slot.pos()), int(Node::ChildNodeType::DIM), blocks);
      }
    }
  }
}

}  // namespace

std::vector<MaskBlock> mask_blocks(const openvdb::MaskTree& voxels) {
  std::vector<MaskBlock> blocks;
  using Root = openvdb::MaskTree::RootNodeType;
  for (auto entry = voxels.root().cbeginChildAll(); entry; ++entry) {
    bool value = false;
    const Root::ChildNodeType* const child = entry.probeChild(value);
    if (child != nullptr) {
      add_node(*child, blocks);
    } else if (entry.isValueOn()) {
      add_tile(entry.getCoord(), int(Root::ChildNodeType::DIM), blocks);
    }
  }
  return blocks;
}

}  // namespace vantage::volume::detail
