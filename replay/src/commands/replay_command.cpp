// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <memory>

#include <dch/geometry/box.hpp>

#include "analysis/replay.hpp"
#include "base/exit_code.hpp"
#include "base/progress_bar.hpp"
#include "base/standard_streams.hpp"
#include "commands/commands.hpp"
#include "commands/report_outputs.hpp"
#include "options/command_line.hpp"
#include "options/option_values.hpp"
#include "report/replay_report.hpp"

namespace dch::cli {
namespace {

/// The command line's words, not yet looked into.
struct ReplayWords {
  InputWords input;
  std::string topology, cutoff, skin = "0", engine = "dch", c, policy, threads, frames, verify = "none",
                                exclude;
  std::string lists, report, plot, view;
  bool half = false, full = false, continuous = false, quiet = false;
};

void declare_list_options(Command& command, ReplayWords& words) {
  command
      .add_option(
          "--cutoff", words.cutoff,
          "Cutoff of the neighbor list, in the file's own unit of length: nm for GROMACS files, Angstrom "
          "for DCD, the dump's unit for LAMMPS")
      ->required()
      ->type_name("R");
  command
      .add_option(
          "--skin", words.skin,
          "Added to the cutoff; the list is then kept until atoms have moved so far that a pair within "
          "the cutoff might be missing. Default 0: a new list whenever an atom moved")
      ->type_name("S");
  auto* half = command.add_flag("--half", words.half, "Each pair once (default)");
  command.add_flag("--full", words.full, "Each pair in the rows of both its atoms")->excludes(half);
  command
      .add_option(
          "--exclude", words.exclude,
          "Leave out pairs joined by bonds: bonded or 1-2 (one bond), 1-3 (up to two), 1-4 (up to three)")
      ->type_name("WHAT");
  add_file_option(command, "--topology", words.topology,
                  "Where the bonds are: a LAMMPS data file (.data), a list of bonds (.bonds) or of chains "
                  "(.chains). Default: the dump's mol column, each molecule a chain in order of atom id")
      ->type_name("FILE");
}

void declare_continuous(Command& command, ReplayWords& words) {
  command.add_flag(
      "--continuous", words.continuous,
      "Between each two frames, have every atom move in a straight line to its nearest image in the next "
      "one, and find the contacts within the cutoff that come, go, or are in between alone, where no frame "
      "shows them");
}

void declare_engine_options(Command& command, ReplayWords& words) {
  command
      .add_option(
          "--engine", words.engine,
          "Who finds the pairs: dch (default), grid, auto (whichever of these two takes less work, as "
          "counted), cell or allpairs")
      ->type_name("NAME");
  command.add_option("--c", words.c, "Has no effect any more")->hide();
  command
      .add_option("--policy", words.policy,
                  "Whether to repair the hierarchy or to build it anew: auto (default: whichever is less "
                  "work, as counted), "
                  "repair or rebuild; engines dch and auto")
      ->type_name("NAME");
  command
      .add_option(
          "--threads", words.threads,
          "Threads to keep the hierarchy and make the lists with. Default 1; engines dch, grid and auto")
      ->type_name("N");
}

void declare_options(Command& command, ReplayWords& words) {
  add_input_options(
      command, words.input, "FILE",
      "Trajectory: LAMMPS dump (.lammpstrj, .dump, also .gz), GROMACS (.xtc, .trr, .gro), DCD (.dcd), "
      "H5MD (.h5, .h5md)");
  declare_list_options(command, words);
  declare_continuous(command, words);
  declare_engine_options(command, words);
  command
      .add_option(
          "--frames", words.frames,
          "Frames to replay, first:end:step as in Python, counted from 0, the end not included; or one "
          "frame. Default: all")
      ->type_name("A:B:S");
  command
      .add_option(
          "--verify", words.verify,
          "Compare the lists with all pairs: none (default), sample (10 frames, 1,000 atoms each) or all")
      ->type_name("HOW");
  add_file_option(command, "--out", words.lists, "Write the neighbor lists to this HDF5 file")
      ->type_name("LISTS.h5");
  add_file_option(command, "--report", words.report, "Write what was found to this JSON file")
      ->type_name("REPORT.json");
  add_file_option(command, "--plot", words.plot, "Write what was found to this page, with plots")
      ->type_name("REPORT.html");
  add_file_option(
      command, "--view", words.view,
      "Write a page that shows the frames in space: atoms, contacts, and the levels of the hierarchy")
      ->type_name("VIEW.html");
  command.add_flag("--quiet", words.quiet, "No progress bar and no table");
}

EngineOptions engine_options(const ReplayWords& words) {
  EngineOptions engine;
  engine.kind = choose<EngineKind>("--engine", words.engine,
                                   {{"dch", EngineKind::dch},
                                    {"grid", EngineKind::grid},
                                    {"auto", EngineKind::automatic},
                                    {"cell", EngineKind::cell},
                                    {"allpairs", EngineKind::allpairs}});
  if (!words.policy.empty() && !may_keep_hierarchy(engine.kind))
    throw UsageError(
        fmt::format("--policy has no meaning for engine {}, which keeps no hierarchy; leave it out or use "
                    "--engine dch",
                    words.engine));
  if (!words.threads.empty() && !takes_threads(engine.kind))
    throw UsageError(
        fmt::format("--threads has no meaning for engine {}, which works on one; leave it out or use "
                    "--engine dch",
                    words.engine));
  if (!words.c.empty())
    print_message(
        "dchmd: --c has no effect any more and will be an error in the next version; leave it out\n");
  if (!words.policy.empty()) {
    engine.policy = choose<MaintenancePolicy>("--policy", words.policy,
                                              {{"auto", MaintenancePolicy::automatic},
                                               {"repair", MaintenancePolicy::always_repair},
                                               {"rebuild", MaintenancePolicy::always_rebuild}});
  }
  return engine;
}

ReplayOptions replay_options(const ReplayWords& words) {
  ReplayOptions options;
  options.topology = words.topology;
  options.cutoff = parse_number("--cutoff", words.cutoff,
                                {0, kMaxCoordinate, true, "the cutoff, a length in the file's unit"});
  options.skin =
      parse_number("--skin", words.skin, {0, kMaxCoordinate, false, "the skin, a length in the file's unit"});
  options.engine = engine_options(words);
  if (!words.threads.empty()) options.threads = parse_threads(words.threads);
  if (!words.frames.empty()) options.frames = parse_frame_range(words.frames);
  options.verify = choose<VerifyMode>(
      "--verify", words.verify,
      {{"none", VerifyMode::none}, {"sample", VerifyMode::sample}, {"all", VerifyMode::all}});
  options.kind = words.full ? ListKind::full : ListKind::half;
  if (!words.exclude.empty()) {
    options.exclude_depth =
        choose<int>("--exclude", words.exclude, {{"bonded", 1}, {"1-2", 1}, {"1-3", 2}, {"1-4", 3}});
  }
  options.continuous = words.continuous;
  options.lists = words.lists;
  options.view = words.view;
  require_distinct_files(
      {words.input.named("FILE"), {"--topology", words.topology}},
      {{"--out", words.lists}, {"--report", words.report}, {"--plot", words.plot}, {"--view", words.view}});
  options.input = TrajectoryInput(words.input);
  return options;
}

void print_mismatches(const ReplayReport& report) {
  const VerifyResult& verify = report.verify;
  for (const Mismatch& mismatch : verify.first) {
    print_message("dchmd: mismatch: {}: {}\n", report.file, mismatch.message(report.unit));
  }
  const auto shown = static_cast<std::int64_t>(verify.first.size());
  if (verify.mismatches > shown) print_message("dchmd: and {} more mismatches\n", verify.mismatches - shown);
}

int run(const ReplayWords& words) {
  const ReplayOptions options = replay_options(words);
  ReportOutputs outputs(words.report, words.plot);
  ProgressBar progress(words.quiet);
  const ReplayReport report = run_replay(options, progress);
  outputs.write(report);
  if (!words.quiet) {
    outputs.print(report, "lists", words.lists);
    if (!words.view.empty()) print_output("  {:<16}{}\n", "view", words.view);
  }
  print_mismatches(report);
  return report.verify.mismatches > 0 ? kMismatch : kOk;
}

}  // namespace

void add_replay_command(Command& app, int& exit_code) {
  auto* command = app.add_subcommand("replay",
                                     "Read a trajectory, keep one search structure up through its frames, "
                                     "and make each frame's neighbor list");
  const auto words = std::make_shared<ReplayWords>();
  declare_options(*command, *words);
  command->callback([words, &exit_code] { exit_code = run(*words); });
}

}  // namespace dch::cli
