// SPDX-License-Identifier: MIT
#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace dch::cli {

/// An option or argument of a command. Each function returns the option, for the next one.
class Option {
 public:
  explicit Option(CLI::Option& option) : option_(option) {}
  Option* required();
  /// What stands for the value in the help text; empty: nothing does.
  Option* type_name(const std::string& name);
  /// Leaves it out of the help text.
  Option* hide();
  /// Both together are refused.
  Option* excludes(Option* other);
  /// Refuses an empty value with the message.
  Option* refuse_empty(const std::string& message);

 private:
  CLI::Option& option_;
};

/// A command or subcommand: its options, and what it does. CLI11, which reads the words, is known to
/// command_line.cpp alone: its header takes four seconds to compile.
class Command {
 public:
  explicit Command(CLI::App& app) : app_(app) {}

  /// Declares an option ("--name") or an argument ("NAME"); parsing leaves its words where they are to go.
  Option* add_option(const std::string& name, std::string& word, const std::string& help);
  Option* add_option(const std::string& name, std::vector<std::string>& words, const std::string& help);
  Option* add_flag(const std::string& name, bool& given, const std::string& help);
  Command* add_subcommand(const std::string& name, const std::string& help);
  /// A command line without one of the subcommands is refused.
  void require_subcommand();
  /// What to do once all words are read, if the command line names this command.
  void callback(std::function<void()> work);

  std::string name() const;
  std::vector<std::string> subcommand_names() const;
  /// nullptr if there is none of that name.
  const Command* subcommand(const std::string& name) const;
  /// The help text, for a command that was called by this name.
  std::string help(const std::string& called) const;

 private:
  Option* keep(CLI::Option& option);

  CLI::App& app_;
  std::deque<Option> options_;
  std::vector<std::unique_ptr<Command>> subcommands_;
};

/// The words of a program's start.
class CommandLine {
 public:
  CommandLine(const std::string& name, const std::string& description, const std::string& version);
  ~CommandLine();
  CommandLine(const CommandLine&) = delete;
  CommandLine& operator=(const CommandLine&) = delete;

  Command& root() { return root_; }
  /// Reads the words and runs the callbacks of the commands that they name; returns the text to print if help
  /// or the version was asked for, else nothing.
  /// @throws UsageError for words that no option takes; and what callbacks throw.
  std::string parse(int argc, const char* const* argv);

 private:
  std::unique_ptr<CLI::App> app_;
  Command root_;
};

}  // namespace dch::cli
