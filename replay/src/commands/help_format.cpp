// SPDX-License-Identifier: MIT
#include "commands/help_format.hpp"

#include <CLI/CLI.hpp>
#include <sstream>

namespace dch::cli {
namespace {

constexpr std::size_t kNames = 26;         ///< columns for the names of options
constexpr std::size_t kDescriptions = 72;  ///< columns for what they mean

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

}  // namespace

std::string wrap_text(const std::string& text, std::size_t width) {
  std::istringstream words(text);
  std::string wrapped, word;
  std::size_t column = 0;
  while (words >> word) {
    if (column > 0 && column + 1 + word.size() > width) {
      wrapped += '\n';
      column = 0;
    } else if (column > 0) {
      wrapped += ' ';
      ++column;
    }
    wrapped += word;
    column += word.size();
  }
  return wrapped;
}

std::shared_ptr<CLI::Formatter> help_format() { return std::make_shared<HelpFormat>(); }

}  // namespace dch::cli
