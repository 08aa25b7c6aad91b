// SPDX-License-Identifier: MIT
#pragma once

namespace CLI {
class App;
}

namespace dch::cli {

/// Each adds its subcommand to `app`; when the command line names it, parsing runs it and leaves its ExitCode
/// in `exit_code`.
void add_replay_command(CLI::App& app, int& exit_code);
void add_contacts_command(CLI::App& app, int& exit_code);
void add_info_command(CLI::App& app, int& exit_code);
void add_convert_command(CLI::App& app, int& exit_code);
void add_generate_command(CLI::App& app, int& exit_code);
void add_help_command(CLI::App& app);

}  // namespace dch::cli
