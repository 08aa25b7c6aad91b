// SPDX-License-Identifier: MIT
// The dch command: sorts out which subcommand is meant and turns exceptions into exit statuses.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <fmt/format.h>
#include <hdf5.h>
#include <new>

#include <dch/trajectory/file_error.hpp>

#include "commands.hpp"
#include "exit_code.hpp"
#include "help_format.hpp"
#include "interrupt.hpp"
#include "version.hpp"

namespace dch::cli {
namespace {

int fail(int exit_code, const char* message) {
  fmt::print(stderr, "dch: {}\n", message);
  return exit_code;
}

int parse_and_run(int argc, char** argv) {
  CLI::App app(
      "Neighbor lists for molecular dynamics from discrete center hierarchies.\n"
      "\n"
      "First steps:\n"
      "  dch info FILE                                      what a trajectory holds, and its cutoff limit\n"
      "  dch replay FILE --cutoff R --verify all            lists of every frame, checked pair by pair\n"
      "  dch replay FILE --cutoff R --plot report.html      the same as a page with plots\n"
      "  dch contacts FILE --gap D --plot contacts.html     contacts of polymer chains, as a page\n"
      "\n"
      "Exit status: 0 ok, 1 --verify found a mismatch, 2 wrong usage, 3 a file that is broken or\n"
      "cannot be read or written.",
      "dch");
  app.set_version_flag("--version", fmt::format("dch {}", kVersion), "Print the version and exit");
  app.formatter(help_format());  // subcommands inherit it
  app.require_subcommand(1);
  int exit_code = kOk;
  add_replay_command(app, exit_code);
  add_contacts_command(app, exit_code);
  add_info_command(app, exit_code);
  add_convert_command(app, exit_code);
  add_generate_command(app, exit_code);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);  // help and version
    return fail(kUsage, fmt::format("{}; see dch --help or dch SUBCOMMAND --help", error.what()).c_str());
  }
  return exit_code;
}

}  // namespace
}  // namespace dch::cli

int main(int argc, char** argv) {
  using namespace dch;
  H5dont_atexit();  // a file on a full disk cannot be closed, and HDF5's exit handler would crash on it
  try {
    cli::catch_interrupts();
    return cli::parse_and_run(argc, argv);
  } catch (const cli::UsageError& error) {
    return cli::fail(cli::kUsage, error.what());
  } catch (const cli::Interrupted& error) {
    return cli::fail(cli::kInterrupted, error.what());
  } catch (const trajectory::FileError& error) {
    return cli::fail(cli::kBadFile, error.what());
  } catch (const Error& error) {  // the library refuses a parameter
    return cli::fail(cli::kUsage, error.what());
  } catch (const std::bad_alloc&) {
    return cli::fail(cli::kUsage, "not enough memory; choose a smaller cutoff or a smaller input");
  } catch (const std::exception& error) {
    return cli::fail(cli::kBadFile, error.what());
  }
}
