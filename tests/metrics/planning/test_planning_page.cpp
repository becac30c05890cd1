#include "metrics/planning/planning_page.hpp"

#include <doctest/doctest.h>

#include "metrics/count_parts.hpp"
#include "metrics/planning/planning_numbers.hpp"
#include "metrics/planning/planning_tables.hpp"
#include "metrics/planning_examples.hpp"

namespace vantage {
namespace {

using test::count;
using test::two_scenes;

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

using Cells = std::vector<std::string>;

}  // namespace

TEST_CASE("numbers as people read them") {
  CHECK(cm3_text(9.43e-4) == "943.0");
  CHECK(cm3_text({}) == "–");
  CHECK(thesis_cm3_text(22.71e-4) == "2271");
  CHECK(percent_text(0.9849) == "98.5 %");
  CHECK(time_text(0.01234) == "12.3 ms");
  CHECK(time_text(0.9999) == "1 s");
  CHECK(time_text(234.8) == "234.8 s");
  CHECK(count_text(7) == "7");
  CHECK(count_text(34225) == "34,225");
  CHECK(count_text(1234567) == "1,234,567");
  CHECK(count_text(100) == "100");
  CHECK(times_text(478.2) == "×478");
}

TEST_CASE("table 9.5: ours, and the thesis' beside it") {
  const ReportTable table = comparison_table(two_scenes(), "full");
  CHECK(has(table.title, "full set, 34,225 views, servo 5"));
  CHECK(table.rows[0].cells == Cells{"wall:front (thesis: Wall, side)"});
  CHECK(table.rows[1].cells == Cells{"voxel", "2", "800.0", "100.0 %", "2 s", "700.0", "200.0",
                                     "943", "100.0 %", "234.8 s"});
  CHECK(table.rows[2].cells == Cells{"shadowD6", "2", "760.0", "95.0 %", "10 s", "800.0", "100.0",
                                     "943", "100.0 %", "107.6 s"});
  CHECK(table.rows[4].cells == Cells{"voxel", "–", "–", "–", "1 ms", "–", "–", "–", "–", "–"});
  CHECK(table.rows.back().cells ==
        Cells{"shadowD6", "", "", "95.0 %", "10 s", "800.0", "100.0", "", "98.5 %", "127.9 s"});
}

TEST_CASE("table 9.6: both directions, and the thesis' own") {
  const ReportTable table = quality_table(two_scenes());
  CHECK(table.rows[2].cells == Cells{"shadowD6", "1.0526", "0.9500", "10 s → 50 ms", "×200", "1.00",
                                     "107.6 s → 600 ms", "×179"});
  CHECK(table.rows.size() == 6);  // the scene without shadow has none
  PlanningEvaluation full_only = two_scenes();
  for (SceneEvaluation& scene : full_only.scenes) scene.sets.pop_back();
  CHECK(quality_table(full_only).rows.empty());
}

TEST_CASE("tables 9.1 to 9.4: every iteration, the pick marked") {
  const ReportTable table = servo_table(two_scenes().scenes[0]);
  CHECK(table.rows[3].cells == Cells{"shadowD6 (score in m³; thesis: table 9.1)"});
  CHECK(table.rows[4].cells ==
        Cells{"0", "start", "1", "380.0", "47.5 %", "400.0", "1.1e+04", "567", "60.1 %"});
  CHECK(table.rows[4].kind == RowKind::plain);
  CHECK(table.rows[5].kind == RowKind::emphasis);
  CHECK(servo_table(two_scenes().scenes[1]).rows.empty());
}

TEST_CASE("tables 9.1 to 9.4: the polished pose is not an iteration of the thesis' servo") {
  PlanningEvaluation evaluation = two_scenes();
  evaluation.polished_views = 2;
  Pick& pick = *evaluation.scenes[0].sets[0].runs[1].pick;
  pick.steps.push_back({"polish", {3, 8e-4, 8e-4}});
  pick.best_step = 2;
  const ReportTable table = servo_table(evaluation.scenes[0]);
  CHECK(table.rows[6].cells == Cells{"–", "polish", "3", "800.0", "100.0 %", "800.0", "", "", ""});
  CHECK(table.rows[6].kind == RowKind::emphasis);
  CHECK(table.rows[5].kind == RowKind::plain);
  CHECK(has(comparison_table(evaluation, "full").title, "servo 5, 2 polished"));
}

TEST_CASE("a scene without shadow gets a remark") {
  const PlanningEvaluation evaluation = two_scenes();
  CHECK(remarks_on(evaluation.scenes[0]).empty());
  const auto remarks = remarks_on(evaluation.scenes[1]);
  REQUIRE(remarks.size() == 1);
  CHECK(has(remarks[0], "foreign_objects:front: no shadow at all"));
  SceneEvaluation blocked = evaluation.scenes[0];
  blocked.truly_hidden_m3 = 3e-3;
  blocked.sets[1].feasible = 0;
  CHECK(remarks_on(blocked).size() == 2);
  CHECK(has(remarks_on(blocked)[1], "none of the 40 views of the production set is feasible"));
}

TEST_CASE("all tables, and each has cells for its columns") {
  const auto tables = planning_tables(two_scenes());
  CHECK(tables.size() == 1 + 2 + 1 + 1);
  for (const ReportTable& table : tables) {
    CAPTURE(table.title);
    CHECK_NOTHROW(table_text(table));
    for (const TableRow& row : table.rows) {
      CHECK(row.cells.size() == (row.kind == RowKind::section ? 1 : table.columns.size()));
    }
  }
}

TEST_CASE("base64 is RFC 4648's") {
  const std::pair<const char*, const char*> vectors[] = {{"", ""},
                                                         {"f", "Zg=="},
                                                         {"fo", "Zm8="},
                                                         {"foo", "Zm9v"},
                                                         {"foob", "Zm9vYg=="},
                                                         {"fooba", "Zm9vYmE="},
                                                         {"foobar", "Zm9vYmFy"}};
  for (const auto& [bytes, text] : vectors) CHECK(base64(bytes) == text);
  CHECK(base64("\xff\xfe\xfd") == "//79");
}

TEST_CASE("the page needs nothing else: no scripts, no links, pictures inside") {
  const std::string page = planning_page(
      two_scenes(), {{0, "voxel’s <pick>", "\xff\xd8\xff"}, {1, "none", "x"}}, {"set & done"});
  CHECK(page.starts_with("<!DOCTYPE html>\n"));
  CHECK(page.ends_with("</html>\n"));
  CHECK(count(page, "<svg ") == 2);
  CHECK(count(page, "<table>") == 5);
  CHECK(has(page, "src=\"data:image/jpeg;base64,/9j/\""));
  CHECK(has(page, "voxel’s &lt;pick&gt;"));
  CHECK(has(page, "set &amp; done"));
  CHECK(has(page, "Mean vox ratio, full set: shadowD6 95.0 % (thesis 98.5 %)."));
  CHECK(count(page, "no shadow at all") == 2);  // at the top, and where the scene is
  for (const char* never : {"<script", "href=", "url(", "@import", "nan", "http://fonts"}) {
    CAPTURE(never);
    CHECK(count(page, never) == 0);
  }
  for (const char* tag : {"section", "figure", "div", "p", "main", "body", "html"}) {
    CAPTURE(tag);
    const std::string open = std::string("<") + tag;
    CHECK(count(page, open + ">") + count(page, open + " ") ==
          count(page, std::string("</") + tag + ">"));
  }
}

}  // namespace vantage
