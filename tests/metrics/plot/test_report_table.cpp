#include "metrics/plot/report_table.hpp"

#include <doctest/doctest.h>

#include "metrics/count_parts.hpp"

namespace vantage {
namespace {

using test::count;

ReportTable small_table() {
  ReportTable table{"Title", {{"name", "", true}, {"m³", "ours"}, {"s", "ours"}, {"s", "thesis"}}};
  table.section("first <scene>");
  table.rows.push_back({{"voxel", "1.5", "2", "234.8"}});
  table.rows.push_back({{"größer", "–", "10", ""}, RowKind::emphasis});
  table.note = "Read it so.";
  return table;
}

}  // namespace

TEST_CASE("a table as text: columns line up whatever bytes a character has") {
  CHECK(table_text(small_table()) ==
        "Title\n"
        "          ours ──  thesis\n"
        "  name     m³   s       s\n"
        "first <scene>\n"
        "  voxel   1.5   2   234.8\n"
        "* größer    –  10\n"
        "Read it so.\n");
}

TEST_CASE("a table without groups has one line of headings, and long notes are wrapped") {
  ReportTable table{"T", {{"a"}, {"b"}}};
  table.rows.push_back({{"1", "2"}});
  for (int i = 0; i < 60; ++i) table.note += "word ";
  const std::string text = table_text(table);
  CHECK(text.starts_with("T\n  a  b\n  1  2\nword word"));
  std::size_t line = 0;
  for (const char c : text) {
    line = c == '\n' ? 0 : line + 1;
    CHECK(line <= 100);
  }
  CHECK(count(text, "word") == 60);
}

TEST_CASE("a table as HTML: groups, sections, what matters, and texts with any characters") {
  const std::string html = table_html(small_table());
  CHECK(count(html, "<th class=\"group\" colspan=\"2\">ours</th>") == 1);
  CHECK(count(html, "<th class=\"group\" colspan=\"1\">thesis</th>") == 1);
  CHECK(count(html, "<tr class=\"section\"><th colspan=\"4\">first &lt;scene&gt;</th></tr>") == 1);
  CHECK(count(html, "<tr class=\"emphasis\"><td class=\"text\">größer</td>") == 1);
  CHECK(count(html, "<td") == 8);
  for (const char* tag : {"table", "tr", "th", "td", "thead", "tbody", "figure", "p"}) {
    CAPTURE(tag);
    const std::string open = std::string("<") + tag;
    CHECK(count(html, open + ">") + count(html, open + " ") ==
          count(html, std::string("</") + tag + ">"));
  }
}

TEST_CASE("every row of a table has to have its cells") {
  ReportTable table = small_table();
  table.rows.push_back({{"too", "few"}});
  CHECK_THROWS(table_text(table));
  CHECK_THROWS(table_html(table));
}

}  // namespace vantage
