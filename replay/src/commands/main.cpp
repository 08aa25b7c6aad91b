// SPDX-License-Identifier: MIT
// The command dchmd: sorts out which subcommand is meant and turns exceptions into exit statuses.
#include <cstdlib>
#include <exception>
#include <fmt/format.h>
#include <new>
#include <string_view>
#include <unistd.h>

#include <dch/trajectory/file_error.hpp>
#include <dch/trajectory/output_file.hpp>

#include "base/exit_code.hpp"
#include "base/interrupt.hpp"
#include "base/standard_streams.hpp"
#include "base/version.hpp"
#include "commands/commands.hpp"
#include "options/command_line.hpp"

namespace dch::cli {
namespace {

constexpr std::string_view kNoMemory = "not enough memory; choose a smaller cutoff or a smaller input";

int fail(int exit_code, std::string_view message) {
  write_message({"dchmd: ", message, "\n"});
  return exit_code;
}

/// A destructor that needs memory (nlohmann's JSON has one) cannot throw what it does not get: the process
/// ends here instead.
[[noreturn]] void end_after_lost_exception() {
  trajectory::remove_unfinished_files();
  try {
    if (const std::exception_ptr lost = std::current_exception()) std::rethrow_exception(lost);
  } catch (const std::bad_alloc&) {
    ::_exit(fail(kUsage, kNoMemory));
  } catch (...) {
    fail(kBadFile, "an exception came where none is expected; unfinished output files are removed");
  }
  std::abort();
}

constexpr const char* kDescription =
    "Neighbor lists for molecular dynamics from discrete center hierarchies.\n"
    "\n"
    "First steps:\n"
    "  dchmd info FILE                                      what a trajectory holds, and its cutoff limit\n"
    "  dchmd replay FILE --cutoff R --verify all            lists of every frame, checked pair by pair\n"
    "  dchmd replay FILE --cutoff R --plot report.html      the same as a page with plots\n"
    "  dchmd contacts FILE --gap D --plot contacts.html     contacts of polymer chains, as a page\n"
    "  dchmd crossings FILE --chain-length 100 --fail       bonds that passed through each other\n"
    "  dchmd query FILE --nearest 12 --clusters R           nearest atoms, closest pair, clusters\n"
    "  dchmd hardspheres --spheres 4000 --fraction 0.45 --time 10   collisions of hard spheres, pressure\n"
    "  dchmd help replay                                    all options of a subcommand\n"
    "\n"
    "Exit status: 0 ok, 1 --verify found a mismatch, 2 wrong usage, 3 a file that is broken or\n"
    "cannot be read or written, 128 and its number for a signal (130: Ctrl-C).";

void declare(Command& app, int& exit_code) {
  app.require_subcommand();
  add_info_command(app, exit_code);
  add_replay_command(app, exit_code);
  add_contacts_command(app, exit_code);
  add_crossings_command(app, exit_code);
  add_query_command(app, exit_code);
  add_hardspheres_command(app, exit_code);
  add_convert_command(app, exit_code);
  add_generate_command(app, exit_code);
  add_help_command(app);
}

int parse_and_run(int argc, char** argv) {
  CommandLine line("dchmd", kDescription, fmt::format("dchmd {}", kVersion));
  int exit_code = kOk;
  declare(line.root(), exit_code);
  if (argc < 2) {
    print_message("dchmd: no subcommand given\n\n{}", line.root().help("dchmd"));
    return kUsage;
  }
  write_output(line.parse(argc, argv));
  return exit_code;
}

int run(int argc, char** argv) {
  try {
    catch_interrupts();
    std::set_terminate(end_after_lost_exception);
    return parse_and_run(argc, argv);
  } catch (const UsageError& error) {
    return fail(kUsage, error.what());
  } catch (const trajectory::FileError& error) {
    return fail(kBadFile, error.what());
  } catch (const Error& error) {  // the library refuses a parameter
    return fail(kUsage, error.what());
  } catch (const std::bad_alloc&) {
    return fail(kUsage, kNoMemory);
  } catch (const std::exception& error) {
    return fail(kBadFile, error.what());
  }
}

}  // namespace
}  // namespace dch::cli

int main(int argc, char** argv) {
  using namespace dch;
  cli::prepare_standard_streams();
  return cli::finish_output(cli::run(argc, argv));
}
