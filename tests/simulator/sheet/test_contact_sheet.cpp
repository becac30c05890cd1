#include <doctest/doctest.h>
#include <fmt/format.h>

#include <set>
#include <string>
#include <utility>
#include <vector>

#include "simulator/sheet/contact_sheet.hpp"
#include "simulator/sheet/sheet_layout.hpp"
#include "support/expect_error.hpp"

namespace vantage::test {
namespace {

std::vector<LabelledPicture> pictures_of(const std::vector<std::pair<std::string, int>>& scenes,
                                         const ColorImage& image = ColorImage(64, 48, 100)) {
  std::vector<LabelledPicture> pictures;
  for (const auto& [scene, count] : scenes) {
    for (int i = 0; i < count; ++i) pictures.push_back({scene, fmt::format("c{}", i), image});
  }
  return pictures;
}

/// Pixels that are darker than paper and place, but not the pictures' own.
int ink(const ColorImage& sheet, int left, int top, int width, int height) {
  int count = 0;
  for (int v = top; v < top + height; ++v) {
    for (int u = left; u < left + width; ++u) count += sheet.pixel(u, v)[0] < 200;
  }
  return count;
}

const ContactSheetOptions kThree{3, 200, 10, 30};

// Of such a sheet with one row: headings begin at the margin, thumbnails 2.5 capitals of 12 px
// below.
constexpr int kTop = 30 + 30;

}  // namespace

TEST_CASE("scenes stand in the first row with room for them, large ones alone") {
  const auto pictures = pictures_of({{"a", 2}, {"b", 2}, {"c", 5}, {"d", 1}, {"e", 3}, {"f", 1}});
  const SheetLayout layout = layout_sheet(pictures, 3);
  const std::vector<std::pair<int, int>> expected = {{0, 0}, {1, 0}, {2, 0},
                                                     {0, 2}, {4, 0}, {1, 2}};
  REQUIRE(layout.blocks.size() == expected.size());
  std::set<std::size_t> seen;
  std::set<std::pair<int, int>> cells;
  for (std::size_t b = 0; b < expected.size(); ++b) {
    const SheetBlock& block = layout.blocks[b];
    CHECK(std::pair(block.row, block.column) == expected[b]);
    for (std::size_t i = 0; i < block.pictures.size(); ++i) {
      CHECK(pictures[block.pictures[i]].scene == block.scene);
      CHECK(seen.insert(block.pictures[i]).second);
      CHECK(cells.emplace(block.row + int(i) / 3, block.column + int(i) % 3).second);
    }
  }
  CHECK(seen.size() == pictures.size());
  CHECK(layout.rows == 5);
  CHECK(layout.columns == 3);
  CHECK(layout_sheet(pictures_of({{"a", 2}}), 7).columns == 2);  // no empty columns
}

TEST_CASE("pictures of one scene that come apart are put together") {
  auto pictures = pictures_of({{"a", 1}, {"b", 1}});
  pictures.push_back(pictures[0]);
  const SheetLayout layout = layout_sheet(pictures, 4);
  REQUIRE(layout.blocks.size() == 2);
  CHECK(layout.blocks[0].pictures == std::vector<std::size_t>{0, 2});
}

TEST_CASE("thumbnails are averaged in linear light") {
  ColorImage fine(800, 600);  // black and white in turns, in four colours
  for (int v = 0; v < 600; ++v) {
    for (int u = 0; u < 800; ++u) {
      if ((u + v) % 2 == 0) fine.pixel(u, v)[0] = fine.pixel(u, v)[1] = 255;
    }
  }
  const ColorImage sheet = contact_sheet(pictures_of({{"s", 1}}, fine), kThree);
  CHECK(sheet.width == 2 * 30 + 200);
  for (const auto& [u, v] : {std::pair{30, kTop}, {229, kTop + 149}, {130, kTop + 75}}) {
    CHECK(int(sheet.pixel(u, v)[0]) == 188);  // half the light, not half the code
    CHECK(int(sheet.pixel(u, v)[1]) == 188);
    CHECK(int(sheet.pixel(u, v)[2]) == 0);
  }
  CHECK(int(sheet.pixel(29, kTop)[0]) > 240);
  CHECK(int(sheet.pixel(230, kTop)[0]) > 240);
  CHECK(int(sheet.pixel(130, kTop - 1)[0]) > 240);
  CHECK(int(sheet.pixel(130, kTop + 150)[0]) > 240);
}

TEST_CASE("a picture of another shape is fitted, not stretched") {
  const ColorImage wide(400, 100, 50);
  const ColorImage sheet = contact_sheet(pictures_of({{"s", 1}}, wide), kThree);
  CHECK(int(sheet.pixel(130, kTop + 75)[0]) == 50);
  CHECK(int(sheet.pixel(30, kTop + 51)[0]) == 50);  // 50 px high in the middle of 150
  CHECK(int(sheet.pixel(30, kTop + 98)[0]) == 50);
  CHECK(int(sheet.pixel(30, kTop + 48)[0]) > 220);
  CHECK(int(sheet.pixel(30, kTop + 101)[0]) > 220);
}

TEST_CASE("scenes and cameras are named, and no name leaves its place") {
  const ColorImage bright(64, 48, 255);
  auto pictures = pictures_of({{"scene", 1}, {"other", 1}}, bright);
  const ColorImage sheet = contact_sheet(pictures, kThree);
  CHECK(ink(sheet, 30, 30, 200, 20) > 20);         // headings
  CHECK(ink(sheet, 240, 30, 200, 20) > 20);        //
  CHECK(ink(sheet, 30, kTop + 150, 200, 25) > 5);  // captions
  pictures[0].scene = pictures[0].camera = std::string(90, 'W');
  const ColorImage longer = contact_sheet(pictures, kThree);
  CHECK(ink(longer, 30, 30, 200, 20) > ink(sheet, 30, 30, 200, 20));
  CHECK(ink(longer, 230, 0, 10, longer.height) == 0);  // the gap stays empty
  pictures[0].camera = "Kamera für Größe";             // beyond OpenCV's fonts
  CHECK_NOTHROW(contact_sheet(pictures, kThree));
}

TEST_CASE("the same pictures give the same sheet") {
  const auto pictures = pictures_of({{"a", 2}, {"b", 4}});
  CHECK(contact_sheet(pictures) == contact_sheet(pictures));
}

TEST_CASE("sheets that cannot be made are refused") {
  const auto pictures = pictures_of({{"a", 1}});
  const auto refused = [&](const ContactSheetOptions& options, const char* message) {
    expect_bad_input("contact sheet", message, [&] { contact_sheet(pictures, options); });
  };
  refused({0, 240, 10, 10}, "columns is 0; expected 1 to 64");
  refused({5, 39, 10, 10}, "cell_width is 39; expected 40 to 4096");
  refused({5, 240, -1, 10}, "gap is -1; expected 0 to 1000");
  refused({5, 240, 10, 1001}, "margin is 1001");
  expect_bad_input("contact sheet", "no pictures", [] { contact_sheet({}); });
  const std::vector<LabelledPicture> empty = {{"wall", "top", {}}};
  expect_bad_input("contact sheet", "scene wall, camera top has no pixels",
                   [&] { contact_sheet(empty); });
}

}  // namespace vantage::test
