// SPDX-License-Identifier: MIT
// dch_bench_necklace: what benchmarks/README.md says about necklaces.
#include "affinity.hpp"
#include "parts.hpp"
#include "program.hpp"

namespace dch::bench {

namespace {

struct Words {
  std::int64_t most = 32768;
  int beads = 100000, chain_beads = 100, rounds = 11, frames = 1000000, threads = 1, processor = 0;
  std::string path, folder, json;
};

CLI::Option* add_most(CLI::App* command, Words& words) {
  return command->add_option("--most", words.most, "Most beads of a chain")->check(CLI::Range(64, 1 << 24));
}

CLI::Option* add_beads(CLI::App* command, Words& words) {
  return command->add_option("--beads", words.beads, "Beads of the chain")
      ->check(CLI::Range(2, 10'000'000))
      ->capture_default_str();
}

int parse_and_run(int argc, char** argv) {
  CLI::App app("Measures necklaces: see benchmarks/README.md", "dch_bench_necklace");
  app.require_subcommand(1);
  Words words;
  app.add_option("--processor", words.processor, "Processor to stay on")->capture_default_str();
  const auto part = [&](const char* name, const char* text, const auto& measure) {
    CLI::App* command = app.add_subcommand(name, text);
    command->add_option("--json", words.json, "Write the table to this file too");
    command->callback([&words, measure] {
      if (words.threads == 1) pin_to(words.processor);
      const Table table = measure();
      if (!words.json.empty()) write_json(words.json, table);
    });
    return command;
  };
  add_most(part("growth", "Visited pairs against beads", [&] { return measure_growth(words.most); }), words);
  CLI::App* radii = part("radii", "Layered against wrapped cages",
                         [&] { return measure_radii(words.most, words.path, words.chain_beads); });
  add_most(radii, words);
  radii->add_option("--trajectory", words.path, "Chains one after the other; its first frame is measured");
  radii->add_option("--chain-beads", words.chain_beads, "Beads of each chain of the trajectory")
      ->check(CLI::Range(1, 10'000'000))
      ->capture_default_str();
  CLI::App* motion = part("motion", "Verification and repair against building, over a trajectory",
                          [&] { return measure_motion(words.path, words.frames); });
  motion->add_option("TRAJECTORY", words.path, "One open chain, whole")->required();
  motion->add_option("--frames", words.frames, "Frames to read at most")->check(CLI::Range(2, 1'000'000));
  CLI::App* query = part("query", "Contact queries by all structures of the library", [&] {
    return measure_queries(words.beads, words.rounds, words.threads, words.folder);
  });
  add_beads(query, words);
  query->add_option("--rounds", words.rounds, "Times that each contender has its turn")
      ->check(CLI::Range(1, 10000))
      ->capture_default_str();
  query
      ->add_option("--threads", words.threads, "Threads to search on; if more than 1, no processor is pinned")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  query->add_option("--positions", words.folder, "Folder to write the positions to, for other programs");
#ifdef DCH_BENCH_HAS_POWER_DIAGRAM
  CLI::App* diagram = part("diagram", "Repair of the power diagram against building it",
                           [&] { return measure_diagram(words.beads, words.rounds); });
  add_beads(diagram, words);
  diagram->add_option("--rounds", words.rounds, "Updates of each size of steps")->check(CLI::Range(1, 10000));
#endif
  CLI::App* chain = app.add_subcommand("chain", "Write a LAMMPS data file of a swollen chain");
  chain->add_option("OUT", words.path, "Data file")->required();
  add_beads(chain, words);
  chain->callback([&] { write_chain(words.path, words.beads); });
  return run_program(app, argc, argv, [] { return kOk; });  // the parts' callbacks do the work
}

}  // namespace
}  // namespace dch::bench

int main(int argc, char** argv) { return dch::bench::parse_and_run(argc, argv); }
