#pragma once

#include <string>
#include <vector>

namespace vantage {

struct TableColumn {
  std::string name;
  std::string group = {};  ///< neighbours of one group have a common heading, e.g. "thesis"
  bool text = false;       ///< aligned to the left; else numbers, to the right
};

enum class RowKind {
  plain,
  section,   ///< one cell over the whole width, before the rows that belong to it
  emphasis,  ///< the one that matters
};

struct TableRow {
  std::vector<std::string> cells;  ///< as many as columns, but for a section
  RowKind kind = RowKind::plain;
};

/// A table of a report, for a terminal and for a page alike.
struct ReportTable {
  std::string title;
  std::vector<TableColumn> columns{};
  std::vector<TableRow> rows{};
  std::string note{};  ///< a sentence or two on how to read it

  void section(std::string title_of_rows) {
    rows.push_back({{std::move(title_of_rows)}, RowKind::section});
  }
};

/// With columns as wide as their longest cell; lines that matter are marked with an asterisk.
std::string table_text(const ReportTable& table);

/// An HTML `table` in a `figure` of class `table`, with title and note.
std::string table_html(const ReportTable& table);

}  // namespace vantage
