// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <memory>

#include <dch/geometry/box.hpp>

#include "analysis/crossing_analysis.hpp"
#include "base/exit_code.hpp"
#include "base/progress_bar.hpp"
#include "base/standard_streams.hpp"
#include "commands/commands.hpp"
#include "options/command_line.hpp"
#include "options/option_values.hpp"
#include "report/output_file.hpp"

namespace dch::cli {
namespace {

/// The command line's words, not yet looked into.
struct CrossingWords {
  InputWords input;
  std::string topology, molecules, length, thickness = "0", frames, threads = "1";
  std::string data, report, plot;
  bool fail = false, quiet = false;
};

void declare_options(Command& command, CrossingWords& words) {
  add_input_options(command, words.input, "FILE", "Trajectory, see dchmd replay --help");
  add_file_option(command, "--topology", words.topology,
                  "Where the chains are: a LAMMPS data file (.data), a list of bonds (.bonds) or of chains "
                  "(.chains). Default: the dump's mol column, each molecule a chain in order of atom id")
      ->type_name("FILE");
  command
      .add_option("--molecules", words.molecules,
                  "Those molecules of the mol column that are chains, as in 1,4-7. Default: all")
      ->type_name("LIST");
  command
      .add_option("--chain-length", words.length,
                  "All atoms, in order of id, make chains of N beads one after the other")
      ->type_name("N");
  command
      .add_option(
          "--thickness", words.thickness,
          "Count as contacts bonds whose axes come within this, in the file's own unit of length. Default "
          "0: those that touch")
      ->type_name("D");
  command
      .add_option("--frames", words.frames,
                  "Frames to look at, first:end:step as in Python, counted from 0, the end not included. "
                  "Default: all")
      ->type_name("A:B:S");
  command.add_option("--threads", words.threads, "Threads to find crossings with. Default 1")->type_name("N");
  add_file_option(command, "--out", words.data, "Write all crossings to this HDF5 file")
      ->type_name("CROSSINGS.h5");
  add_file_option(command, "--report", words.report, "Write what was found to this JSON file")
      ->type_name("REPORT.json");
  add_file_option(command, "--plot,--html", words.plot, "Write crossings over the frames to this page")
      ->type_name("PAGE.html");
  command.add_flag("--fail", words.fail, "End with exit status 1 if bonds cross or are undetermined");
  command.add_flag("--quiet", words.quiet, "No progress bar and no table");
}

CrossingOptions crossing_options(const CrossingWords& words) {
  CrossingOptions options;
  options.chains = ChainSource(words.topology, words.molecules, words.length);
  options.thickness =
      parse_number("--thickness", words.thickness,
                   {0, kMaxCoordinate, false, "a distance of two bonds, a length in the file's unit"});
  if (!words.frames.empty()) options.frames = parse_frame_range(words.frames);
  options.threads = parse_threads(words.threads);
  options.data = words.data;
  require_distinct_files({words.input.named("FILE"), {"--topology", words.topology}},
                         {{"--out", words.data}, {"--report", words.report}, {"--plot", words.plot}});
  options.input = TrajectoryInput(words.input);
  return options;
}

void print_summary(const CrossingReport& report, const CrossingWords& words) {
  write_output(render_table(report));
  const std::pair<const char*, const std::string&> outputs[] = {
      {"data", words.data}, {"report", words.report}, {"page", words.plot}};
  for (const auto& [name, path] : outputs) {
    if (!path.empty()) print_output("  {:<16}{}\n", name, path);
  }
}

int run(const CrossingWords& words) {
  const CrossingOptions options = crossing_options(words);
  const auto json = open_output(words.report);
  const auto page = open_output(words.plot);
  ProgressBar progress(words.quiet);
  const CrossingReport report = analyze_crossings(options, progress);
  if (json) json->write(render_json(report));
  if (page) page->write(render_html(report));
  if (json) json->commit();
  if (page) page->commit();
  if (!words.quiet) print_summary(report, words);
  return words.fail && (report.crossings > 0 || report.undetermined > 0) ? kMismatch : kOk;
}

}  // namespace

void add_crossings_command(Command& app, int& exit_code) {
  auto* command = app.add_subcommand(
      "crossings", "Find the bonds of polymer chains that pass through each other between frames");
  const auto words = std::make_shared<CrossingWords>();
  declare_options(*command, *words);
  command->callback([words, &exit_code] { exit_code = run(*words); });
}

}  // namespace dch::cli
