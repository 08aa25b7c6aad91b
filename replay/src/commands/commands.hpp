// SPDX-License-Identifier: MIT
#pragma once

namespace dch::cli {

class Command;

/// Each adds its subcommand to `app`; when the command line names it, parsing runs it and leaves its ExitCode
/// in `exit_code`.
void add_replay_command(Command& app, int& exit_code);
void add_contacts_command(Command& app, int& exit_code);
void add_crossings_command(Command& app, int& exit_code);
void add_query_command(Command& app, int& exit_code);
void add_hardspheres_command(Command& app, int& exit_code);
void add_info_command(Command& app, int& exit_code);
void add_convert_command(Command& app, int& exit_code);
void add_generate_command(Command& app, int& exit_code);
void add_help_command(Command& app);

}  // namespace dch::cli
