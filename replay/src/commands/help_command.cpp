// SPDX-License-Identifier: MIT
#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <vector>

#include "base/exit_code.hpp"
#include "base/standard_streams.hpp"
#include "commands/commands.hpp"
#include "commands/usage_message.hpp"

namespace dch::cli {
namespace {

void print_help(const CLI::App& app, const std::vector<std::string>& words) {
  const CLI::App* command = &app;
  std::string name = app.get_name();
  for (const std::string& word : words) {
    const auto found = command->get_subcommands([&](const CLI::App* sub) { return sub->get_name() == word; });
    if (found.empty()) throw UsageError(unknown_subcommand(*command, word));
    command = found.front();
    name += " " + word;
  }
  // App::help() would show the help of the subcommand at work, which is this one.
  write_output(command->get_formatter()->make_help(command, name, CLI::AppFormatMode::Normal));
}

}  // namespace

void add_help_command(CLI::App& app) {
  auto* command = app.add_subcommand("help", "Print the options of a subcommand, as SUBCOMMAND --help does");
  const auto words = std::make_shared<std::vector<std::string>>();
  command->add_option("SUBCOMMAND", *words, "Its name, for example contacts; generate melt has two words")
      ->type_name("");
  command->callback([words, &app] { print_help(app, *words); });
}

}  // namespace dch::cli
