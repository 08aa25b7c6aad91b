// SPDX-License-Identifier: GPL-2.0-or-later
// lmp-dch: LAMMPS with the command `dch`, and LAMMPS's own command line. What --dch (or -dch) names comes
// before the script: --dch mixed,threads=2 is "dch on", "dch precision mixed" and "dch threads 2".
#include <algorithm>
#include <cstring>
#include <error.h>
#include <exception>
#include <input.h>
#include <lammps_host.h>
#include <library.h>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "dch_register.h"

namespace {

// Takes --dch and its settings out of the command line, which LAMMPS reads otherwise; false if the settings
// are missing.
bool take_settings(int& argc, char** argv, std::string& settings) {
  char** const end = argv + argc;
  char** const option = std::find_if(argv, end, [](const char* word) {
    return std::strcmp(word, "-dch") == 0 || std::strcmp(word, "--dch") == 0;
  });
  if (option == end) return true;
  const bool complete = option + 1 < end && option[1][0] != '-';
  const int taken = complete ? 2 : 1;
  if (complete) settings = option[1];
  std::copy(option + taken, end + 1, option);  // with the null pointer behind the last one
  argc -= taken;
  return complete;
}

std::vector<std::string> split(const std::string& settings) {
  std::vector<std::string> words;
  std::istringstream text(settings);
  for (std::string word; std::getline(text, word, ',');) words.push_back(word);
  return words;
}

// Lists are on unless a setting says on or off itself.
void run_settings(const std::vector<std::string>& settings, LAMMPS_NS::Input& input) {
  const bool is_silent = std::none_of(settings.begin(), settings.end(), [](const std::string& setting) {
    return setting == "off" || setting == "on" || setting.compare(0, 3, "on ") == 0;
  });
  if (!settings.empty() && is_silent) input.one("dch on");
  for (std::string setting : settings) {
    std::replace(setting.begin(), setting.end(), '=', ' ');
    if (setting == "mixed" || setting == "double") setting = "precision " + setting;
    input.one("dch " + setting);
  }
}

int run(int argc, char** argv) {
  std::string settings;
  const bool complete = take_settings(argc, argv, settings);
  const auto lammps = std::make_unique<LAMMPS_NS::LAMMPS>(argc, argv, MPI_COMM_WORLD);
  if (!complete)
    lammps->error->all(FLERR,
                       std::string("--dch lacks its settings: give --dch on, or --dch mixed,threads=2"));
  const int status = dch_register(lammps.get());
  if (status != 0) return status;
  run_settings(split(settings), *lammps->input);
  lammps->input->file();
  return status;
}

}  // namespace

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  int status = 0;
  try {
    status = run(argc, argv);
  } catch (const std::exception&) {
    MPI_Abort(MPI_COMM_WORLD, 1);  // builds of LAMMPS with exceptions throw once their message is out
  }
  lammps_python_finalize();
  MPI_Barrier(MPI_COMM_WORLD);
  MPI_Finalize();
  return status;
}
