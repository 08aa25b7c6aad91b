// SPDX-License-Identifier: MIT
#include <algorithm>
#include <fmt/format.h>
#include <memory>

#include <dch/geometry/box.hpp>

#include "analysis/query_analysis.hpp"
#include "base/exit_code.hpp"
#include "base/progress_bar.hpp"
#include "base/standard_streams.hpp"
#include "commands/commands.hpp"
#include "commands/report_outputs.hpp"
#include "options/command_line.hpp"
#include "options/option_values.hpp"

namespace dch::cli {
namespace {

/// The command line's words, not yet looked into.
struct QueryWords {
  InputWords input;
  std::string nearest = "1", clusters, frames, threads = "1";
  std::string data, report, plot;
  bool quiet = false;
};

constexpr std::int64_t kMaxRank = 1024;
constexpr std::size_t kMaxCutoffs = 64;

void declare_options(Command& command, QueryWords& words) {
  add_input_options(command, words.input, "FILE", "Trajectory, see dchmd replay --help");
  command
      .add_option("--nearest", words.nearest,
                  fmt::format("How many nearest atoms of each atom to find, up to {}. Default 1", kMaxRank))
      ->type_name("K");
  command
      .add_option("--clusters", words.clusters,
                  "Find the clusters at these cutoffs, in the file's own unit of length: atoms joined by "
                  "steps no longer than the cutoff. How many there are is told for every other cutoff too")
      ->type_name("R,...");
  command
      .add_option("--frames", words.frames,
                  "Frames to look at, first:end:step as in Python, counted from 0, the end not included. "
                  "Default: all")
      ->type_name("A:B:S");
  command.add_option("--threads", words.threads, "Threads to search with. Default 1")->type_name("N");
  add_file_option(command, "--out", words.data,
                  "Write nearest atoms, closest pairs, spanning trees and clusters to this HDF5 file")
      ->type_name("QUERY.h5");
  add_file_option(command, "--report", words.report, "Write what was found to this JSON file")
      ->type_name("REPORT.json");
  add_file_option(command, "--plot,--html", words.plot,
                  "Write distances, clusters and their sizes to this page")
      ->type_name("PAGE.html");
  command.add_flag("--quiet", words.quiet, "No progress bar and no table");
}

std::vector<double> parse_cutoffs(const std::string& text) {
  std::vector<double> cutoffs;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    cutoffs.push_back(parse_number(
        "--clusters", text.substr(begin, end - begin),
        {0, kMaxCoordinate, false, "the cutoffs of clusters, lengths in the file's unit, as in 1.2,1.5"}));
    begin = end + 1;
  }
  std::sort(cutoffs.begin(), cutoffs.end());
  cutoffs.erase(std::unique(cutoffs.begin(), cutoffs.end()), cutoffs.end());
  if (cutoffs.size() > kMaxCutoffs) {
    throw UsageError(
        fmt::format("--clusters gives {} cutoffs, and {} are the most; give fewer (the report "
                    "tells the number of clusters at every cutoff)",
                    cutoffs.size(), kMaxCutoffs));
  }
  return cutoffs;
}

QueryOptions query_options(const QueryWords& words) {
  QueryOptions options;
  options.k = static_cast<std::int32_t>(
      parse_whole_number("--nearest", words.nearest, 1, kMaxRank, "the number of nearest atoms of each"));
  if (!words.clusters.empty()) options.cutoffs = parse_cutoffs(words.clusters);
  if (!words.frames.empty()) options.frames = parse_frame_range(words.frames);
  options.threads = parse_threads(words.threads);
  options.data = words.data;
  require_distinct_files({words.input.named("FILE")},
                         {{"--out", words.data}, {"--report", words.report}, {"--plot", words.plot}});
  options.input = TrajectoryInput(words.input);
  return options;
}

int run(const QueryWords& words) {
  const QueryOptions options = query_options(words);
  ReportOutputs outputs(words.report, words.plot);
  ProgressBar progress(words.quiet);
  const QueryReport report = analyze_proximity(options, progress);
  outputs.write(report);
  if (!words.quiet) outputs.print(report, "data", words.data);
  return kOk;
}

}  // namespace

void add_query_command(Command& app, int& exit_code) {
  auto* command = app.add_subcommand(
      "query",
      "Ask every frame for the nearest atoms of each, the closest pair, and clusters at every cutoff");
  const auto words = std::make_shared<QueryWords>();
  declare_options(*command, *words);
  command->callback([words, &exit_code] { exit_code = run(*words); });
}

}  // namespace dch::cli
