// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <memory>

#include <dch/trajectory/writer.hpp>

#include "base/exit_code.hpp"
#include "base/number_text.hpp"
#include "base/standard_streams.hpp"
#include "commands/commands.hpp"
#include "input/frame_stream.hpp"
#include "options/command_line.hpp"
#include "options/option_values.hpp"

namespace dch::cli {
namespace {

struct ConvertWords {
  InputWords input;
  std::string output, frames;
  bool quiet = false;
};

int run(const ConvertWords& words) {
  const FrameRange range = words.frames.empty() ? FrameRange() : parse_frame_range(words.frames);
  require_distinct_files({words.input.named("IN")}, {{"OUT", words.output}});
  const TrajectoryInput input(words.input);
  ProgressBar progress(words.quiet);
  const Scan scan = scan_trajectory(input, range, progress);
  FrameStream stream(input, range);
  const auto writer = trajectory::create_trajectory(words.output, scan.unit);
  progress.start("converting", scan.frames);
  trajectory::Frame frame;
  std::int64_t done = 0;
  while (stream.next(frame)) {
    writer->write(frame);
    progress.advance(++done);
  }
  writer->close();
  progress.clear();
  if (!words.quiet) {
    print_output("{}: {} of {} atoms, lengths in {}\n", words.output, counted(done, "frame"),
                 count_text(scan.fewest_atoms, scan.most_atoms), scan.unit);
  }
  return kOk;
}

}  // namespace

void add_convert_command(Command& app, int& exit_code) {
  auto* command =
      app.add_subcommand("convert", "Write a trajectory in another format; lengths stay in their unit");
  const auto words = std::make_shared<ConvertWords>();
  add_input_options(*command, words->input, "IN", "Trajectory, see dchmd replay --help");
  add_file_option(*command, "OUT", words->output,
                  "File to write: H5MD (.h5, .h5md) or LAMMPS dump (.lammpstrj, .dump)")
      ->required()
      ->type_name("");
  command->add_option("--frames", words->frames, "Frames to convert, first:end:step. Default: all")
      ->type_name("A:B:S");
  command->add_flag("--quiet", words->quiet, "No progress bar and no message");
  command->callback([words, &exit_code] { exit_code = run(*words); });
}

}  // namespace dch::cli
