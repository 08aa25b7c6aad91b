// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <limits>
#include <memory>

#include <dch/necklace/melt.hpp>

#include "base/exit_code.hpp"
#include "base/number_text.hpp"
#include "base/standard_streams.hpp"
#include "commands/commands.hpp"
#include "options/command_line.hpp"
#include "options/option_values.hpp"
#include "report/output_file.hpp"

namespace dch::cli {
namespace {

struct MeltWords {
  std::string chains, beads, density = "0.8442", seed = "1", output;
  bool quiet = false;
};

int run(const MeltWords& words) {
  constexpr std::int64_t kMaxBeads = std::numeric_limits<std::int32_t>::max();
  necklace::MeltParams params;
  params.chains = static_cast<std::int32_t>(
      parse_whole_number("--chains", words.chains, 1, kMaxBeads, "the number of chains"));
  params.beads_per_chain = static_cast<std::int32_t>(
      parse_whole_number("--beads", words.beads, 1, kMaxBeads, "the number of beads of each chain"));
  params.density = parse_number("--density", words.density,
                                {0, 10, true, "the number of beads per volume of one bead diameter cubed"});
  params.seed = static_cast<std::uint64_t>(parse_whole_number(
      "--seed", words.seed, 0, std::numeric_limits<std::int64_t>::max(), "the seed of the random numbers"));
  require_distinct_files({}, {{"OUT", words.output}});
  OutputFile file(words.output);
  const necklace::Melt melt = necklace::make_melt(params);
  OutputStream stream(file);
  necklace::write_lammps_data(stream, melt);
  stream.flush();
  file.commit();
  if (!words.quiet) {
    print_output("{}: {} of {}, density {}, seed {}, cubic box of {} bead diameters\n", words.output,
                 counted(params.chains, "chain"), counted(params.beads_per_chain, "bead"), params.density,
                 params.seed, readable(melt.box.vector(0).x));
    print_output("Beads overlap: push them apart with a soft potential before dynamics.\n");
  }
  return kOk;
}

void add_melt_command(Command& generate, int& exit_code) {
  auto* command = generate.add_subcommand("melt",
                                          "A Kremer-Grest bead-spring melt as a LAMMPS data file (units lj); "
                                          "beads overlap, push them apart first");
  const auto words = std::make_shared<MeltWords>();
  command->add_option("--chains", words->chains, "Number of chains")->required()->type_name("N");
  command->add_option("--beads", words->beads, "Beads of each chain")->required()->type_name("N");
  command->add_option("--density", words->density, "Beads per volume. Default 0.8442")->type_name("R");
  command->add_option("--seed", words->seed, "Seed of the random numbers. Default 1")->type_name("S");
  add_file_option(*command, "OUT", words->output, "File to write, for example melt.data")
      ->required()
      ->type_name("");
  command->add_flag("--quiet", words->quiet, "No message");
  command->callback([words, &exit_code] { exit_code = run(*words); });
}

}  // namespace

void add_generate_command(Command& app, int& exit_code) {
  auto* command = app.add_subcommand("generate", "Make input for simulations");
  command->require_subcommand();
  add_melt_command(*command, exit_code);
}

}  // namespace dch::cli
