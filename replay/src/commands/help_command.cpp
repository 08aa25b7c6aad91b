// SPDX-License-Identifier: MIT
#include <memory>
#include <string>
#include <vector>

#include "base/exit_code.hpp"
#include "base/standard_streams.hpp"
#include "commands/commands.hpp"
#include "options/command_line.hpp"
#include "options/usage_message.hpp"

namespace dch::cli {
namespace {

void print_help(const Command& app, const std::vector<std::string>& words) {
  const Command* command = &app;
  std::string name = app.name();
  for (const std::string& word : words) {
    const Command* const found = command->subcommand(word);
    if (!found) throw UsageError(unknown_subcommand(name, command->subcommand_names(), word));
    command = found;
    name += " " + word;
  }
  write_output(command->help(name));
}

}  // namespace

void add_help_command(Command& app) {
  auto* command = app.add_subcommand("help", "Print the options of a subcommand, as SUBCOMMAND --help does");
  const auto words = std::make_shared<std::vector<std::string>>();
  command->add_option("SUBCOMMAND", *words, "Its name, for example contacts; generate melt has two words")
      ->type_name("");
  command->callback([words, &app] { print_help(app, *words); });
}

}  // namespace dch::cli
