// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <limits>
#include <memory>

#include <dch/geometry/box.hpp>

#include "analysis/contact_analysis.hpp"
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
struct ContactWords {
  InputWords input;
  std::string topology, molecules, length, gap, skip = "1", radius = "0", pairs = "all", bins = "512", frames,
                                                threads = "1";
  std::string data, report, plot;
  bool quiet = false;
};

constexpr std::int64_t kMaxBins = 4096;

void declare_contact_options(Command& command, ContactWords& words) {
  command
      .add_option("--gap", words.gap,
                  "Two beads are in contact if their surfaces are at most this far apart, in the file's own "
                  "unit of length")
      ->required()
      ->type_name("D");
  command
      .add_option(
          "--radius", words.radius,
          "Radius of the beads, or one for each type of atom as in 1=0.5,2=0.7. Default 0: the gap is "
          "the distance of the centers")
      ->type_name("R");
  add_file_option(command, "--topology", words.topology,
                  "Where the chains are: a LAMMPS data file (.data), a list of bonds (.bonds) or of chains "
                  "(.chains). Default: the dump's mol column, each molecule a chain in order of atom id")
      ->type_name("FILE");
  command
      .add_option(
          "--molecules", words.molecules,
          "Those molecules of the mol column that are chains, as in 1,4-7; the others, solvent, say, are "
          "left out. Default: all")
      ->type_name("LIST");
  command
      .add_option(
          "--chain-length", words.length,
          "All atoms, in order of id, make chains of N beads one after the other: for files without a "
          "mol column")
      ->type_name("N");
  command
      .add_option("--skip-bonds", words.skip,
                  "Leave out pairs with this many bonds between them and fewer. Default 1: bonded beads")
      ->type_name("K");
  command
      .add_option("--pairs", words.pairs,
                  "Which pairs: all (default), within chains alone, or between chains alone")
      ->type_name("WHICH");
}

void declare_options(Command& command, ContactWords& words) {
  add_input_options(command, words.input, "FILE", "Trajectory, see dchmd replay --help");
  declare_contact_options(command, words);
  command
      .add_option("--bins", words.bins,
                  fmt::format("Bins of the contact map at most, up to {}. Default 512; shorter chains have a "
                              "bin for each bead",
                              kMaxBins))
      ->type_name("N");
  command
      .add_option("--frames", words.frames,
                  "Frames to look at, first:end:step as in Python, counted from 0, the end not included. "
                  "Default: all")
      ->type_name("A:B:S");
  command.add_option("--threads", words.threads, "Threads to find contacts with. Default 1")->type_name("N");
  add_file_option(command, "--out", words.data, "Write events, contact map and P(s) to this HDF5 file")
      ->type_name("CONTACTS.h5");
  add_file_option(command, "--report", words.report, "Write what was found to this JSON file")
      ->type_name("REPORT.json");
  add_file_option(command, "--plot,--html", words.plot, "Write contact map, P(s) and more to this page")
      ->type_name("PAGE.html");
  command.add_flag("--quiet", words.quiet, "No progress bar and no table");
}

ContactOptions contact_options(const ContactWords& words) {
  ContactOptions options;
  options.chains = ChainSource(words.topology, words.molecules, words.length);
  options.query.gap = parse_number(
      "--gap", words.gap,
      {0, kMaxCoordinate, false, "the largest distance of two surfaces, a length in the file's unit"});
  options.query.skip_bonds =
      static_cast<int>(parse_whole_number("--skip-bonds", words.skip, 0, std::numeric_limits<int>::max(),
                                          "the number of bonds up to which pairs are left out"));
  const auto pairs = choose<std::string>("--pairs", words.pairs,
                                         {{"all", "all"}, {"within", "within"}, {"between", "between"}});
  options.query.within_chains = pairs != "between";
  options.query.between_chains = pairs != "within";
  options.radii = BeadRadii(words.radius);
  options.bins = static_cast<std::int32_t>(
      parse_whole_number("--bins", words.bins, 1, kMaxBins, "the largest number of bins of the map"));
  if (!words.frames.empty()) options.frames = parse_frame_range(words.frames);
  options.threads = parse_threads(words.threads);
  options.data = words.data;
  require_distinct_files({words.input.named("FILE"), {"--topology", words.topology}},
                         {{"--out", words.data}, {"--report", words.report}, {"--plot", words.plot}});
  options.input = TrajectoryInput(words.input);
  return options;
}

int run(const ContactWords& words) {
  const ContactOptions options = contact_options(words);
  ReportOutputs outputs(words.report, words.plot);
  ProgressBar progress(words.quiet);
  const ContactReport report = analyze_contacts(options, progress);
  outputs.write(report);
  if (!words.quiet) outputs.print(report, "data", words.data);
  return kOk;
}

}  // namespace

void add_contacts_command(Command& app, int& exit_code) {
  auto* command = app.add_subcommand("contacts",
                                     "Follow the contacts of polymer chains with themselves and each other: "
                                     "events, contact map, P(s)");
  const auto words = std::make_shared<ContactWords>();
  declare_options(*command, *words);
  command->callback([words, &exit_code] { exit_code = run(*words); });
}

}  // namespace dch::cli
