// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <memory>
#include <numbers>

#include "analysis/sphere_run.hpp"
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
struct SphereWords {
  std::string from, spheres, fraction, sizes = "1", start = "lattice", seed = "1", growth = "0.1", jam;
  std::string restitution = "1", time, collisions, every, frames, restart, report;
  bool quiet = false;
};

constexpr std::int64_t kMaxSpheres = 100000000;
constexpr double kMax = 1e12;
/// No packing of equal spheres is denser (T. C. Hales, Ann. Math. 162:1065, 2005).
const double kDensest = std::numbers::pi / std::sqrt(18.0);

void declare_start(Command& command, SphereWords& words) {
  add_file_option(command, "--from", words.from, "Go on from this restart file")->type_name("STATE.json");
  command.add_option("--spheres", words.spheres, "Begin with so many spheres")->type_name("N");
  command.add_option("--fraction", words.fraction, "Share of the box that they fill")->type_name("PHI");
  command
      .add_option("--sizes", words.sizes,
                  "Diameters, each with its share of the spheres if they are not the same, as in "
                  "1:0.99,10:0.01. Masses are their cubes. Default 1")
      ->type_name("D[:SHARE],...");
  command
      .add_option("--start", words.start,
                  "lattice: places of a face-centered cubic one; random: any places. Where the spheres would "
                  "overlap they begin smaller and grow. Default lattice")
      ->type_name("START");
  command.add_option("--seed", words.seed, "Seed of places and velocities. Default 1")->type_name("S");
  command
      .add_option("--growth", words.growth,
                  "Where spheres grow: by this share of their radii in a unit of time. Default 0.1")
      ->type_name("RATE");
  command
      .add_option(
          "--jam", words.jam,
          "Let the spheres grow until they are jammed: until the pressure is so many times that of an "
          "ideal gas")
      ->type_name("P");
}

void declare_options(Command& command, SphereWords& words) {
  declare_start(command, words);
  command
      .add_option("--restitution", words.restitution,
                  "Share of the relative velocity that a collision leaves. Default 1: elastic")
      ->type_name("E");
  command
      .add_option(
          "--time", words.time,
          "Run for this time; with temperature 1 a sphere of diameter 1 flies about its diameter in a "
          "unit of time")
      ->type_name("T");
  command.add_option("--collisions", words.collisions, "Run for so many collisions")->type_name("N");
  command.add_option("--every", words.every, "Time between two frames of --out")->type_name("T");
  add_file_option(command, "--out", words.frames,
                  "Write frames to this file: H5MD (.h5, .h5md) or LAMMPS dump (.lammpstrj, .dump)")
      ->type_name("RUN.h5");
  add_file_option(command, "--restart", words.restart, "Write where the spheres are at the end to this file")
      ->type_name("STATE.json");
  add_file_option(command, "--report", words.report, "Write what was measured to this JSON file")
      ->type_name("REPORT.json");
  command.add_flag("--quiet", words.quiet, "No progress bar and no table");
}

std::vector<SphereSize> parse_sizes(const std::string& text) {
  std::vector<SphereSize> sizes;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const std::string item = text.substr(begin, end - begin);
    const std::size_t colon = item.find(':');
    SphereSize size;
    size.diameter = parse_number("--sizes", item.substr(0, colon),
                                 {0, kMax, true, "the diameters of spheres, as in 1,10 or 1:0.9,10:0.1"});
    if (colon != std::string::npos)
      size.share = parse_number("--sizes", item.substr(colon + 1),
                                {0, kMax, true, "the share of spheres of a size, as in 1:0.9,10:0.1"});
    sizes.push_back(size);
    begin = end + 1;
  }
  return sizes;
}

double parse_fraction(const std::string& text, const std::vector<SphereSize>& sizes) {
  const double fraction =
      parse_number("--fraction", text, {0, 1, true, "the share of the box that the spheres fill"});
  if (sizes.size() == 1 && fraction > kDensest)
    throw UsageError(fmt::format(
        "--fraction {}: equal spheres fill {:.4f} of space at most; choose a lower one", fraction, kDensest));
  return fraction;
}

StartOptions start_options(const SphereWords& words) {
  StartOptions start;
  start.growth = parse_number("--growth", words.growth, {0, kMax, true, "the rate at which radii grow"});
  if (!words.from.empty()) {
    if (!words.spheres.empty() || !words.fraction.empty())
      throw UsageError("--from tells spheres and their box; leave --spheres and --fraction out");
    return start;
  }
  if (words.spheres.empty() || words.fraction.empty())
    throw UsageError(
        "--spheres and --fraction are required where no restart file is given by --from, as in --spheres "
        "10976 --fraction 0.45");
  start.spheres = parse_whole_number("--spheres", words.spheres, 1, kMaxSpheres, "the number of spheres");
  start.sizes = parse_sizes(words.sizes);
  start.fraction = parse_fraction(words.fraction, start.sizes);
  start.start = choose<SphereStart>("--start", words.start,
                                    {{"lattice", SphereStart::lattice}, {"random", SphereStart::random}});
  start.seed = static_cast<std::uint64_t>(parse_whole_number(
      "--seed", words.seed, 0, std::numeric_limits<std::int64_t>::max(), "the seed of the random numbers"));
  return start;
}

void read_length_of_run(const SphereWords& words, SphereOptions& options) {
  if (!words.time.empty() && !words.collisions.empty())
    throw UsageError("--time and --collisions both say when the run ends; give one of them");
  if (words.time.empty() && words.collisions.empty() && words.jam.empty())
    throw UsageError("--time, --collisions or --jam is required: it says when the run ends");
  if (!words.time.empty())
    options.time = parse_number("--time", words.time, {0, kMax, true, "how long to run"});
  if (!words.collisions.empty())
    options.collisions =
        parse_whole_number("--collisions", words.collisions, 1, std::numeric_limits<std::int64_t>::max() / 64,
                           "the number of collisions to run for");
  if (!words.jam.empty())
    options.jam = parse_number("--jam", words.jam, {1, kMax, true, "a pressure over that of an ideal gas"});
  if (words.every.empty() != words.frames.empty())
    throw UsageError("--out and --every go together: the file for frames, and the time between two of them");
  if (!words.every.empty())
    options.every = parse_number("--every", words.every, {0, kMax, true, "the time between two frames"});
}

SphereOptions sphere_options(const SphereWords& words) {
  SphereOptions options;
  options.from = words.from;
  options.start = start_options(words);
  options.restitution = parse_number("--restitution", words.restitution,
                                     {0, 1, true, "what a collision leaves of the relative velocity"});
  read_length_of_run(words, options);
  options.frames = words.frames;
  options.restart = words.restart;
  require_distinct_files({{"--from", words.from}},
                         {{"--out", words.frames}, {"--restart", words.restart}, {"--report", words.report}});
  return options;
}

int run(const SphereWords& words) {
  const SphereOptions options = sphere_options(words);
  const auto json = open_output(words.report);
  ProgressBar progress(words.quiet);
  const SphereReport report = run_hard_spheres(options, progress);
  if (json) json->write(render_json(report));
  if (json) json->commit();
  if (words.quiet) return kOk;
  write_output(render_table(report));
  const std::pair<const char*, const std::string&> outputs[] = {
      {"frames", words.frames}, {"restart", words.restart}, {"report", words.report}};
  for (const auto& [name, path] : outputs) {
    if (!path.empty()) print_output("  {:<16}{}\n", name, path);
  }
  return kOk;
}

}  // namespace

void add_hardspheres_command(Command& app, int& exit_code) {
  auto* command = app.add_subcommand(
      "hardspheres", "Event-driven hard spheres of any sizes: their pressure, growth to jamming, frames");
  const auto words = std::make_shared<SphereWords>();
  declare_options(*command, *words);
  command->callback([words, &exit_code] { exit_code = run(*words); });
}

}  // namespace dch::cli
