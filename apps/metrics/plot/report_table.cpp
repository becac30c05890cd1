#include "metrics/plot/report_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "metrics/plot/svg.hpp"

namespace vantage {
namespace {

constexpr std::size_t kGap = 2, kLineWidth = 100;

/// Characters of UTF-8; ours are all of the width of one.
std::size_t width_of(const std::string& text) {
  return std::size_t(std::ranges::count_if(text, [](char c) { return (c & 0xC0) != 0x80; }));
}

std::string padded(const std::string& text, std::size_t width, bool left) {
  const std::string space(width - std::min(width, width_of(text)), ' ');
  return left ? text + space : space + text;
}

/// Neighbouring columns with one heading.
struct Group {
  std::string name;
  std::size_t first = 0, size = 0;
};

std::vector<Group> groups_of(const std::vector<TableColumn>& columns) {
  std::vector<Group> groups;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (groups.empty() || groups.back().name != columns[i].group) {
      groups.push_back({columns[i].group, i, 0});
    }
    ++groups.back().size;
  }
  return groups;
}

bool has_groups(const ReportTable& table) {
  return std::ranges::any_of(table.columns, [](const auto& c) { return !c.group.empty(); });
}

std::vector<std::size_t> widths_of(const ReportTable& table) {
  std::vector<std::size_t> widths;
  for (const TableColumn& column : table.columns) widths.push_back(width_of(column.name));
  for (const TableRow& row : table.rows) {
    if (row.kind == RowKind::section) continue;
    for (std::size_t i = 0; i < widths.size(); ++i) {
      widths[i] = std::max(widths[i], width_of(row.cells.at(i)));
    }
  }
  for (const Group& group : groups_of(table.columns)) {
    const auto first = widths.begin() + std::ptrdiff_t(group.first);
    const std::size_t all =
        std::accumulate(first, first + std::ptrdiff_t(group.size), std::size_t(0)) +
        kGap * (group.size - 1);
    if (all < width_of(group.name)) *first += width_of(group.name) - all;
  }
  return widths;
}

std::string without_trailing_space(std::string line) {
  line.erase(line.find_last_not_of(' ') + 1);
  return line + "\n";
}

std::string line_of(const std::vector<std::string>& cells, const ReportTable& table,
                    const std::vector<std::size_t>& widths, const std::string& mark) {
  std::string line = padded(mark, kGap, true);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    line += padded(cells[i], widths[i], table.columns[i].text) + std::string(kGap, ' ');
  }
  return without_trailing_space(line);
}

std::string group_line(const ReportTable& table, const std::vector<std::size_t>& widths) {
  std::string line(kGap, ' ');
  for (const Group& group : groups_of(table.columns)) {
    std::size_t width = kGap * (group.size - 1);
    for (std::size_t i = 0; i < group.size; ++i) width += widths[group.first + i];
    std::string heading = group.name;
    if (!heading.empty() && width > width_of(heading) + 1) {
      const std::size_t rule = width - width_of(heading) - 1;
      std::string dashes;
      for (std::size_t i = 0; i < rule; ++i) dashes += "─";
      heading += " " + dashes;
    }
    line += padded(heading, width, true) + std::string(kGap, ' ');
  }
  return without_trailing_space(line);
}

/// Words in lines that a terminal holds.
std::string wrapped(const std::string& text) {
  std::string result;
  std::size_t line = 0, at = 0;
  while (at < text.size()) {
    const std::size_t space = std::min(text.find(' ', at), text.size());
    const std::string word = text.substr(at, space - at);
    if (line > 0 && line + 1 + width_of(word) > kLineWidth) {
      result += "\n";
      line = 0;
    }
    if (line > 0) result += " ";
    result += word;
    line += width_of(word) + (line > 0 ? 1 : 0);
    at = space + 1;
  }
  return result + "\n";
}

std::string cell_html(const char* tag, const TableColumn& column, const std::string& text) {
  return fmt::format("<{0}{2}>{1}</{0}>", tag, xml_escaped(text),
                     column.text ? " class=\"text\"" : "");
}

std::string head_html(const ReportTable& table) {
  std::string html = "<thead>\n";
  if (has_groups(table)) {
    html += "<tr>";
    for (const Group& group : groups_of(table.columns)) {
      html +=
          fmt::format("<th class=\"{}\" colspan=\"{}\">{}</th>",
                      group.name.empty() ? "none" : "group", group.size, xml_escaped(group.name));
    }
    html += "</tr>\n";
  }
  html += "<tr>";
  for (const TableColumn& column : table.columns) html += cell_html("th", column, column.name);
  return html + "</tr>\n</thead>\n";
}

std::string row_html(const ReportTable& table, const TableRow& row) {
  if (row.kind == RowKind::section) {
    return fmt::format("<tr class=\"section\"><th colspan=\"{}\">{}</th></tr>\n",
                       table.columns.size(), xml_escaped(row.cells.at(0)));
  }
  std::string html = row.kind == RowKind::emphasis ? "<tr class=\"emphasis\">" : "<tr>";
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    html += cell_html("td", table.columns[i], row.cells.at(i));
  }
  return html + "</tr>\n";
}

}  // namespace

std::string table_text(const ReportTable& table) {
  const std::vector<std::size_t> widths = widths_of(table);
  std::vector<std::string> names;
  for (const TableColumn& column : table.columns) names.push_back(column.name);
  std::string text = table.title + "\n";
  if (has_groups(table)) text += group_line(table, widths);
  text += line_of(names, table, widths, "");
  for (const TableRow& row : table.rows) {
    if (row.kind == RowKind::section) {
      text += row.cells.at(0) + "\n";
    } else {
      text += line_of(row.cells, table, widths, row.kind == RowKind::emphasis ? "*" : "");
    }
  }
  return table.note.empty() ? text : text + wrapped(table.note);
}

std::string table_html(const ReportTable& table) {
  std::string html = fmt::format("<figure class=\"table\">\n<figcaption>{}</figcaption>\n",
                                 xml_escaped(table.title));
  html += "<div class=\"scroll\"><table>\n" + head_html(table) + "<tbody>\n";
  for (const TableRow& row : table.rows) html += row_html(table, row);
  html += "</tbody>\n</table></div>\n";
  if (!table.note.empty()) html += "<p class=\"note\">" + xml_escaped(table.note) + "</p>\n";
  return html + "</figure>\n";
}

}  // namespace vantage
