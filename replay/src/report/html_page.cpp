// SPDX-License-Identifier: MIT
#include "report/html_page.hpp"

#include <filesystem>
#include <fmt/format.h>

#include "base/version.hpp"
#include "plot/svg_chart.hpp"
#include "report/page_style.hpp"

namespace dch::cli {
namespace {

std::string table_of(const std::vector<Row>& table) {
  std::string rows;
  for (const Row& row : table) {
    rows += fmt::format("<tr><th>{}</th><td>{}</td></tr>\n", escape_html(row.name), escape_html(row.value));
  }
  return fmt::format("<table>\n{}</table>\n", rows);
}

}  // namespace

std::string html_card(const std::string& title, const std::string& explanation, const std::string& drawing) {
  return fmt::format("<section class=\"card\">\n<h2>{}</h2>\n<p>{}</p>\n{}</section>\n", escape_html(title),
                     escape_html(explanation), drawing);
}

std::string render_page(const HtmlPage& page) {
  const std::string name = escape_html(std::filesystem::path(page.file).filename().string());
  std::string text = "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n";
  text += "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n";
  text += fmt::format("<title>dchmd {}: {}</title>\n<style>{}</style>\n</head>\n<body>\n<main>\n",
                      page.command, name, kPageStyle);
  text += fmt::format("<header>\n<h1>{} {}</h1>\n{}</header>\n", page.heading, name, page.verdict);
  text += fmt::format("<section class=\"card wide\">\n{}</section>\n", table_of(page.table));
  text += page.notes;
  text += fmt::format("<div class=\"charts\">\n{}</div>\n", page.charts);
  text +=
      fmt::format("<footer>dchmd {} {}. Hover over a drawing for values.</footer>\n", kVersion, page.command);
  text += "</main>\n</body>\n</html>\n";
  return text;
}

}  // namespace dch::cli
