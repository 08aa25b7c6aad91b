// SPDX-License-Identifier: MIT
#include "options/command_line.hpp"

#include <CLI/CLI.hpp>
#include <sstream>
#include <utility>

#include "base/exit_code.hpp"
#include "options/help_text.hpp"
#include "options/usage_message.hpp"

namespace dch::cli {
namespace {

constexpr std::size_t kNames = 26;         ///< columns for the names of options
constexpr std::size_t kDescriptions = 72;  ///< columns for what they mean

/// Help texts that fit a terminal of 100 columns.
class HelpFormat : public CLI::Formatter {
 public:
  HelpFormat() { column_width(kNames); }
  std::string make_option_desc(const CLI::Option* option) const override {
    return wrap_text(CLI::Formatter::make_option_desc(option), kDescriptions);
  }
  std::string make_subcommand(const CLI::App* command) const override {
    std::ostringstream text;
    CLI::detail::format_help(text, command->get_name(), wrap_text(command->get_description(), kDescriptions),
                             kNames);
    return text.str();
  }
};

/// The last subcommand that the command line names.
const CLI::App& named_command(const CLI::App& app) {
  const CLI::App* command = &app;
  while (!command->get_subcommands().empty()) command = command->get_subcommands().front();
  return *command;
}

std::string full_name(const CLI::App& command) {
  const CLI::App* const parent = command.get_parent();
  return parent ? full_name(*parent) + " " + command.get_name() : command.get_name();
}

std::vector<std::string> subcommands_of(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::App* sub : command.get_subcommands([](const CLI::App*) { return true; })) {
    names.push_back(sub->get_name());
  }
  return names;
}

std::vector<std::string> options_of(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    for (const std::string& name : option->get_snames()) names.push_back("-" + name);
  }
  return names;
}

Misuse misuse(const CLI::App& app, const CLI::ParseError& error) {
  const CLI::App& command = named_command(app);
  return {full_name(command),  subcommands_of(command), options_of(command),
          app.remaining(true), error.get_name(),        error.what()};
}

}  // namespace

Option* Option::required() {
  option_.required();
  return this;
}

Option* Option::type_name(const std::string& name) {
  option_.type_name(name);
  return this;
}

Option* Option::hide() {
  option_.group("");
  return this;
}

Option* Option::excludes(Option* other) {
  option_.excludes(&other->option_);
  return this;
}

Option* Option::refuse_empty(const std::string& message) {
  option_.check([message](const std::string& word) { return word.empty() ? message : std::string(); }, "");
  return this;
}

Option* Command::keep(CLI::Option& option) { return &options_.emplace_back(option); }

Option* Command::add_option(const std::string& name, std::string& word, const std::string& help) {
  return keep(*app_.add_option(name, word, help));
}

Option* Command::add_option(const std::string& name, std::vector<std::string>& words,
                            const std::string& help) {
  return keep(*app_.add_option(name, words, help));
}

Option* Command::add_flag(const std::string& name, bool& given, const std::string& help) {
  return keep(*app_.add_flag(name, given, help));
}

Command* Command::add_subcommand(const std::string& name, const std::string& help) {
  return subcommands_.emplace_back(std::make_unique<Command>(*app_.add_subcommand(name, help))).get();
}

void Command::require_subcommand() { app_.require_subcommand(1); }

void Command::callback(std::function<void()> work) { app_.callback(std::move(work)); }

std::string Command::name() const { return app_.get_name(); }

std::vector<std::string> Command::subcommand_names() const { return subcommands_of(app_); }

const Command* Command::subcommand(const std::string& name) const {
  for (const auto& sub : subcommands_) {
    if (sub->name() == name) return sub.get();
  }
  return nullptr;
}

std::string Command::help(const std::string& called) const {
  // CLI::App::help() would show the help of the subcommand at work, which may be another one.
  return app_.get_formatter()->make_help(&app_, called, CLI::AppFormatMode::Normal);
}

CommandLine::CommandLine(const std::string& name, const std::string& description, const std::string& version)
    : app_(std::make_unique<CLI::App>(description, name)), root_(*app_) {
  app_->set_version_flag("--version", version, "Print the version and exit");
  app_->formatter(std::make_shared<HelpFormat>());  // subcommands inherit it
}

CommandLine::~CommandLine() = default;

std::string CommandLine::parse(int argc, const char* const* argv) {
  try {
    app_->parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() != 0) throw UsageError(usage_message(misuse(*app_, error)));
    std::ostringstream text;  // help or version
    app_->exit(error, text, text);
    return text.str();
  }
  return "";
}

}  // namespace dch::cli
