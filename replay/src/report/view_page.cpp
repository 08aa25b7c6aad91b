// SPDX-License-Identifier: MIT
#include "report/view_page.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <tuple>

#include "base/exit_code.hpp"
#include "base/number_text.hpp"
#include "base/version.hpp"
#include "plot/svg_chart.hpp"
#include "report/page_style.hpp"
#include "report/view_stream.hpp"
#include "report/view_texts.hpp"

namespace dch::cli {
namespace {

using nlohmann::json;

/// As a script may hold it: nothing in it ends the script.
std::string script_text(const json& value) {
  std::string text;
  for (const char c : value.dump(-1, ' ', false, json::error_handler_t::replace)) {
    if (c == '<') {
      text += "\\u003c";
    } else {
      text.push_back(c);
    }
  }
  return text;
}

json numbers(Vec3 vector) { return {vector.x, vector.y, vector.z}; }

json vectors(const std::array<Vec3, 3>& all, int count) {
  json found = json::array();
  for (int k = 0; k < count; ++k) found.push_back(numbers(all[static_cast<std::size_t>(k)]));
  return found;
}

json level_facts(const ViewedFrame& frame) {
  json levels = json::array();
  for (const ViewedLevel& level : frame.levels) {
    levels.push_back({{"nodes", level.nodes.size()},
                      {"edges", level.edges.pairs()},
                      {"radius", level.covering_radius},
                      {"threshold", level.edge_threshold}});
  }
  return levels;
}

json frame_facts(const ViewedFrame& frame) {
  const ViewedExtent extent = extent_of(frame);
  return {{"frame", frame.frame},
          {"step", frame.step},
          {"time", frame.time ? json(*frame.time) : json()},
          {"atoms", frame.positions.size()},
          {"contacts", frame.contacts.pairs()},
          {"low", numbers(extent.low)},
          {"high", numbers(extent.high)},
          {"origin", numbers(frame.box.origin())},
          {"periods", vectors(frame.box.reduced(), frame.box.rank())},
          {"duals", vectors(frame.box.reduced_dual(), frame.box.rank())},
          {"levels", level_facts(frame)},
          {"data", view_stream(frame, extent)}};
}

}  // namespace

ViewPage::ViewPage(const std::string& path, const ViewHeader& header)
    : file_(path), frames_expected_(header.frames) {
  const std::string name = std::filesystem::path(header.source).filename().string();
  write(
      fmt::format("<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n"
                  "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n"
                  "<title>dchmd {}: {}</title>\n<style>{}{}</style>\n</head>\n<body>\n{}",
                  kVersion, escape_html(name), kPageStyle, kViewStyle, kViewBody));
  write(fmt::format(
      "<script>\n/* three.js, with OrbitControls:\n{}*/\n{}\n</script>\n<script>\n{}\n</script>\n",
      kThreeLicense, kThree, kOrbitControls));
  const json facts = {
      {"source", name}, {"unit", header.unit}, {"cutoff", header.cutoff}, {"skin", header.skin}};
  write(fmt::format("<script>\nconst run = {};\nconst frames = [\n", script_text(facts)));
}

void ViewPage::append(const ViewedFrame& frame) {
  require_drawable(frame);
  write(script_text(frame_facts(frame)) + ",\n");
  ++frames_;
  if (bytes_ > kMaxBytes) fail_too_large();
}

void ViewPage::commit() {
  write(fmt::format("];\n{}</script>\n</body>\n</html>\n", kViewScript));
  file_.commit();
}

void ViewPage::write(const std::string& text) {
  file_.write(text);
  bytes_ += text.size();
}

void ViewPage::require_drawable(const ViewedFrame& frame) const {
  std::int64_t edges = 0;
  for (const ViewedLevel& level : frame.levels) edges = std::max(edges, level.edges.pairs());
  const auto atoms = static_cast<std::int64_t>(frame.positions.size());
  for (const auto& [count, what, remedy] :
       {std::tuple(atoms, "atom", "convert a part of the atoms with another program first"),
        std::tuple(frame.contacts.pairs(), "contact", "give a smaller cutoff"),
        std::tuple(edges, "edge", "give a smaller cutoff or skin")}) {
    if (count <= kMaxDrawn) continue;
    throw UsageError(fmt::format("{}: frame {} has {} to draw, more than {}, which browsers draw at once; {}",
                                 file_.path(), frame.frame, counted(count, what), grouped(kMaxDrawn),
                                 remedy));
  }
}

/// How many fit is told by those so far.
void ViewPage::fail_too_large() const {
  const double fit =
      static_cast<double>(frames_) * static_cast<double>(kMaxBytes) / static_cast<double>(bytes_);
  const double step = std::max(2.0, std::ceil(static_cast<double>(frames_expected_) / fit));
  throw UsageError(
      fmt::format("{}: with {} of {} the page has more than {} MB, which is what browsers open; select about "
                  "one in {} of these "
                  "frames with --frames, or give a smaller cutoff",
                  file_.path(), grouped(frames_), counted(frames_expected_, "frame"), kMaxBytes >> 20, step));
}

}  // namespace dch::cli
