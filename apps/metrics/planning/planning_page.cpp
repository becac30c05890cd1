#include "metrics/planning/planning_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>

#include "metrics/planning/planning_numbers.hpp"
#include "metrics/planning/planning_tables.hpp"
#include "metrics/planning/thesis_planning.hpp"
#include "metrics/plot/run_time_plot.hpp"
#include "metrics/plot/svg.hpp"

namespace vantage {
namespace {

constexpr const char* kStyle = R"(
:root{color-scheme:light}
*{box-sizing:border-box}
body{margin:0;background:#f4f4f2;color:#1d1d1f;
  font:15px/1.5 -apple-system,"Segoe UI","DejaVu Sans",Helvetica,Arial,sans-serif}
main{max-width:1080px;margin:0 auto;padding:32px 40px 56px;background:#fff}
h1{font-size:27px;line-height:1.25;margin:0 0 8px}
h2{font-size:20px;margin:44px 0 6px;padding-top:14px;border-top:1px solid #ddd}
p{margin:8px 0;max-width:76ch}
.lead{color:#444}
.remark{border-left:4px solid #d55e00;background:#fdf3ec;padding:8px 14px}
figure{margin:20px 0 28px}
figcaption{font-weight:600;margin-bottom:6px}
.note{color:#555;font-size:13px}
.scroll{overflow-x:auto}
table{border-collapse:collapse;font-size:13.5px;font-variant-numeric:tabular-nums;white-space:nowrap}
th,td{padding:3px 11px;text-align:right}
th{font-weight:600;color:#333}
th.text,td.text{text-align:left}
th.group{text-align:center;border-bottom:1px solid #999}
thead tr:last-child th{border-bottom:2px solid #333}
tbody td{border-bottom:1px solid #eee}
tr.section th{text-align:left;background:#f0f1f3;padding-top:6px}
tr.emphasis td{font-weight:700;background:#eef6fb}
.plot{max-width:100%;height:auto;display:block}
.pictures{display:grid;grid-template-columns:repeat(auto-fit,minmax(320px,1fr));gap:18px}
.pictures figure{margin:8px 0}
.pictures figcaption{font-weight:400;font-size:13.5px;margin:6px 0 0}
.pictures img{width:100%;height:auto;display:block;border:1px solid #ddd}
.key span{display:inline-block;width:11px;height:11px;margin:0 5px 0 14px}
@media print{
  @page{size:A4 landscape;margin:14mm}
  body{background:#fff;font-size:11pt}
  main{max-width:none;padding:0}
  h2{break-after:avoid}
  figure,tr,.remark{break-inside:avoid}
  figure.table{break-inside:auto}
  thead{display:table-header-group}
  tr.section{break-after:avoid}
  .scroll{overflow:visible}
  table{font-size:9.5pt}
  tr.section th,tr.emphasis td,.remark,.key span{print-color-adjust:exact;-webkit-print-color-adjust:exact}
}
)";

const SceneEvaluation* scene_named(const PlanningEvaluation& evaluation, std::size_t index) {
  return index < evaluation.scenes.size() ? &evaluation.scenes[index] : nullptr;
}

void add_points(TimePlotSeries& series, const PlanningEvaluation& evaluation, std::size_t index,
                const std::string& set) {
  const SceneEvaluation& scene = *scene_named(evaluation, index);
  const MethodRun* const run = run_of(scene, set, series.name);
  if (run == nullptr || !run->pick) return;
  const auto ratio = vox_ratio(scene, run->pick->worth());
  const auto time = median_run_time_s(*run);
  if (!ratio || !time || *time <= 0) return;
  series.points.push_back({index, *time, *ratio});
  const ThesisPick* const thesis = thesis_pick(scene.name, series.name);
  if (thesis == nullptr) return;
  if (set == "full") {
    series.thesis.push_back({index, thesis->run_time_s, thesis->vox_ratio});
  } else {
    series.thesis.push_back(
        {index, thesis->production_run_time_s, thesis->vox_ratio / thesis->vox_quality});
  }
}

std::string paragraph(const char* look, const std::string& text) {
  return fmt::format("<p class=\"{}\">{}</p>\n", look, xml_escaped(text));
}

/// The best and the mean, in one sentence.
std::string headline(const PlanningEvaluation& evaluation) {
  std::string text;
  const std::vector<std::string> sets = sets_of(evaluation);
  if (sets.empty()) return text;
  for (const std::string& method : evaluation.methods) {
    const MethodMeans means = means_of(evaluation, sets.front(), method);
    if (method == "voxel" || !means.vox_ratio) continue;
    text +=
        fmt::format("{}{} {}", text.empty() ? "Mean vox ratio, " + sets.front() + " set: " : ", ",
                    method, percent_text(means.vox_ratio));
    if (const ThesisMean* const thesis = thesis_mean(method)) {
      text += fmt::format(" (thesis {})", percent_text(thesis->vox_ratio));
    }
  }
  return text.empty() ? text : text + ".";
}

std::string pictures_of(std::size_t scene, const std::vector<PagePicture>& pictures) {
  std::string html;
  for (const PagePicture& picture : pictures) {
    if (picture.scene != scene) continue;
    html += fmt::format(
        "<figure><img alt=\"{0}\" src=\"data:image/jpeg;base64,{1}\">"
        "<figcaption>{0}</figcaption></figure>\n",
        xml_escaped(picture.caption), base64(picture.jpeg));
  }
  if (html.empty()) return html;
  return "<div class=\"pictures\">\n" + html +
         "</div>\n<p class=\"note key\">Voxels:<span style=\"background:#6bb35c\"></span>occupied"
         "<span style=\"background:#db3d33\"></span>shadow that stays"
         "<span style=\"background:#29c2d1\"></span>shadow that the view reveals. Cameras: grey "
         "those of the scene, red the suggested one.</p>\n";
}

std::string scene_section(const PlanningEvaluation& evaluation, std::size_t index,
                          const std::vector<PagePicture>& pictures) {
  const SceneEvaluation& scene = evaluation.scenes[index];
  std::string html = "<section>\n<h2>" + xml_escaped(scene.name) + "</h2>\n";
  for (const std::string& remark : remarks_on(scene)) html += paragraph("remark", remark);
  html += pictures_of(index, pictures);
  const ReportTable servo = servo_table(scene);
  if (!servo.rows.empty()) html += table_html(servo);
  return html + "</section>\n";
}

}  // namespace

std::string base64(const std::string& bytes) {
  constexpr const char* kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t left = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t bits = 0;
    for (std::size_t b = 0; b < 3; ++b) {
      bits = bits << 8 | (b < left ? std::uint32_t(std::uint8_t(bytes[i + b])) : 0);
    }
    for (std::size_t digit = 0; digit < 4; ++digit) {
      text += digit <= left ? kDigits[bits >> (18 - 6 * digit) & 63] : '=';
    }
  }
  return text;
}

std::string run_time_chart(const PlanningEvaluation& evaluation, const std::string& set) {
  std::vector<TimePlotSeries> series;
  for (const std::string& method : evaluation.methods) series.push_back({method, {}});
  std::vector<std::string> scenes;
  for (std::size_t i = 0; i < evaluation.scenes.size(); ++i) {
    scenes.push_back(evaluation.scenes[i].name);
    for (TimePlotSeries& one : series) add_points(one, evaluation, i, set);
  }
  return run_time_plot_svg(fmt::format("Run time and vox ratio, {} set (thesis: figure {})", set,
                                       set == "full" ? "9.16" : "9.18"),
                           scenes, series);
}

std::string planning_page(const PlanningEvaluation& evaluation,
                          const std::vector<PagePicture>& pictures,
                          const std::vector<std::string>& options) {
  std::string body = "<h1>View planning: the thesis’ chapter 9 on simulated scenes</h1>\n";
  body += paragraph("lead", headline(evaluation));
  for (const std::string& line : options) body += paragraph("note", line);
  for (const SceneEvaluation& scene : evaluation.scenes) {
    for (const std::string& remark : remarks_on(scene)) body += paragraph("remark", remark);
  }
  body += table_html(scenes_table(evaluation));
  for (const std::string& set : sets_of(evaluation)) {
    body += "<section>\n<h2>" + xml_escaped(set == "full" ? "Full set" : "Production set") +
            "</h2>\n<figure>\n" + run_time_chart(evaluation, set) + "</figure>\n" +
            table_html(comparison_table(evaluation, set)) + "</section>\n";
  }
  const ReportTable quality = quality_table(evaluation);
  if (!quality.rows.empty()) {
    body += "<section>\n<h2>Production set against full set</h2>\n" + table_html(quality) +
            "</section>\n";
  }
  for (std::size_t i = 0; i < evaluation.scenes.size(); ++i) {
    body += scene_section(evaluation, i, pictures);
  }
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<title>View planning evaluated</title>\n<style>{}</style>\n</head>\n<body>\n<main>\n"
      "{}</main>\n</body>\n</html>\n",
      kStyle, body);
}

}  // namespace vantage
