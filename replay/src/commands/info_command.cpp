// SPDX-License-Identifier: MIT
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>

#include "base/exit_code.hpp"
#include "base/number_text.hpp"
#include "base/standard_streams.hpp"
#include "commands/commands.hpp"
#include "input/frame_stream.hpp"
#include "options/command_line.hpp"
#include "options/option_values.hpp"
#include "report/report_rows.hpp"
#include "report/summary_json.hpp"

namespace dch::cli {
namespace {

struct InfoWords {
  InputWords input;
  std::string frames;
  bool json = false, quiet = false;
};

constexpr std::size_t kMaxTypesShown = 8;

std::map<std::int32_t, std::int64_t> type_counts(const trajectory::Frame& frame) {
  std::map<std::int32_t, std::int64_t> counts;
  for (const std::int32_t type : frame.types) ++counts[type];
  return counts;
}

/// Number of molecules; 0 is LAMMPS's "none".
std::size_t molecule_count(const trajectory::Frame& frame) {
  std::set<std::int32_t> molecules(frame.molecules.begin(), frame.molecules.end());
  molecules.erase(0);
  return molecules.size();
}

std::string types_text(const trajectory::Frame& frame) {
  const auto counts = type_counts(frame);
  if (counts.empty()) return "none given";
  std::vector<std::string> parts;
  for (const auto& [type, count] : counts) {
    if (parts.size() == kMaxTypesShown) {
      parts.emplace_back("...");
      break;
    }
    parts.push_back(fmt::format("{}: {}", type, counted(count, "atom")));
  }
  return fmt::format("{} ({})", counts.size(), fmt::join(parts, ", "));
}

void print_text(const Scan& scan) {
  const auto row = [](const char* name, const std::string& value) {
    print_output("  {:<22}{}\n", name, value);
  };
  const std::string unit = unit_suffix(scan.unit);
  row("file", scan.file);
  row("format", scan.format);
  row("unit of length", scan.unit);
  row("frames", grouped(scan.frames));
  row("steps", fmt::format("{} to {}", scan.first_frame.step, scan.last_step));
  if (scan.first_frame.time && scan.last_time)
    row("times", fmt::format("{} to {}", *scan.first_frame.time, *scan.last_time));
  row("atoms", count_text(scan.fewest_atoms, scan.most_atoms));
  row("types", types_text(scan.first_frame));
  row("molecules", scan.first_frame.molecules.empty()
                       ? "none given"
                       : grouped(static_cast<std::int64_t>(molecule_count(scan.first_frame))));
  row("box", fmt::format("{}", fmt::join(scan.box_kinds, "; ")));
  if (!std::isfinite(scan.smallest_height)) {
    row("smallest box height", "no periodic box: any cutoff will do");
    return;
  }
  row("smallest box height",
      fmt::format("{} {} (frame {})", scan.smallest_height, unit, scan.smallest_height_frame));
  row("largest cutoff + skin", fmt::format("{} {}", 0.5 * scan.smallest_height, unit));
}

void print_json(const Scan& scan) {
  nlohmann::ordered_json json;
  json["file"] = scan.file;
  json["format"] = scan.format;
  json["unit"] = scan.unit;
  json["frames"] = scan.frames;
  json["atoms"] = scan.most_atoms;
  json["fewest_atoms"] = scan.fewest_atoms;
  json["box_kinds"] = scan.box_kinds;
  json["smallest_box_height"] = number_or_null(scan.smallest_height);
  json["smallest_box_height_frame"] =
      std::isfinite(scan.smallest_height) ? nlohmann::ordered_json(scan.smallest_height_frame) : nullptr;
  json["first_step"] = scan.first_frame.step;
  json["last_step"] = scan.last_step;
  json["types"] = nlohmann::ordered_json::object();
  for (const auto& [type, count] : type_counts(scan.first_frame))
    json["types"][fmt::format("{}", type)] = count;
  json["molecules"] = molecule_count(scan.first_frame);
  print_output("{}\n", json.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
}

int run(const InfoWords& words) {
  const FrameRange range = words.frames.empty() ? FrameRange() : parse_frame_range(words.frames);
  ProgressBar progress(words.quiet);
  const Scan scan = scan_trajectory(TrajectoryInput(words.input), range, progress);
  if (words.json) {
    print_json(scan);
  } else {
    print_text(scan);
  }
  return kOk;
}

}  // namespace

void add_info_command(Command& app, int& exit_code) {
  auto* command = app.add_subcommand(
      "info", "Say what a trajectory holds: format, unit, frames, atoms, boxes, cutoff limit");
  const auto words = std::make_shared<InfoWords>();
  add_input_options(*command, words->input, "FILE", "Trajectory, see dchmd replay --help");
  command->add_option("--frames", words->frames, "Frames to look at, first:end:step. Default: all")
      ->type_name("A:B:S");
  command->add_flag("--json", words->json, "Print JSON, for scripts");
  command->add_flag("--quiet", words->quiet, "No progress line");
  command->callback([words, &exit_code] { exit_code = run(*words); });
}

}  // namespace dch::cli
