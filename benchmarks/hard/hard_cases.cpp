// SPDX-License-Identifier: MIT
//
// dch_hard_cases: the table of hard cases (tests/support/hard_cases), what is expected of each beside what
// came out. Exit status: 0; 1 if a case came out otherwise, or otherwise than a document says; 2 for a wrong
// call; 3 for a file that cannot be read or written.
#include <fmt/format.h>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>

#include "hard_case.hpp"
#include "program.hpp"

namespace dch::hard {
namespace {

using bench::kOk;
using bench::kWrong;

struct Options {
  Effort effort;
  std::string json, document;
  bool markdown = false;
};

struct Row {
  Case about;
  Finding finding;
};

std::vector<Row> run_all(const Effort& effort) {
  std::vector<Case> cases = all_cases(effort);
#ifdef DCH_HAS_POWER_DIAGRAM
  for (const Case& one : diagram_cases()) cases.push_back(one);
#endif
  std::vector<Row> rows;
  for (const Case& one : cases) rows.push_back({one, outcome(one)});
  return rows;
}

std::string markdown_of(const Row& row) {
  return fmt::format("| {} | {} | {} | {} | {} |", row.about.area, row.about.name, row.about.expected,
                     row.finding.found, row.finding.passed ? "yes" : "NO");
}

void print(const std::vector<Row>& rows, bool markdown) {
  if (markdown) fmt::print("| | Case | Expected | Came out | Passed |\n|---|---|---|---|---|\n");
  for (const Row& row : rows) {
    if (markdown)
      fmt::print("{}\n", markdown_of(row));
    else
      fmt::print("{:<4} {}: {}\n       expected: {}\n       came out: {}\n",
                 row.finding.passed ? "ok" : "FAIL", row.about.area, row.about.name, row.about.expected,
                 row.finding.found);
  }
}

void write_json(const std::string& path, const std::vector<Row>& rows) {
  nlohmann::json json = nlohmann::json::array();
  for (const Row& row : rows)
    json.push_back({{"area", row.about.area},
                    {"case", row.about.name},
                    {"expected", row.about.expected},
                    {"found", row.finding.found},
                    {"passed", row.finding.passed}});
  std::ofstream file(path);
  file << json.dump(1) << '\n';
  if (!file.flush()) throw std::runtime_error(path + ": cannot be written");
}

/// Whether each row stands in the document as a line; says on stderr which do not.
bool is_documented(const std::string& path, const std::vector<Row>& rows) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error(path + ": cannot be read");
  std::set<std::string> lines;
  for (std::string line; std::getline(file, line);) lines.insert(line);
  bool all = true;
  for (const Row& row : rows) {
    if (lines.count(markdown_of(row)) > 0) continue;
    all = false;
    fmt::print(stderr, "dch_hard_cases: {} lacks the line\n{}\n", path, markdown_of(row));
  }
  return all;
}

int run(const Options& options) {
  const std::vector<Row> rows = run_all(options.effort);
  print(rows, options.markdown);
  if (!options.json.empty()) write_json(options.json, rows);
  bool passed = options.document.empty() || is_documented(options.document, rows);
  for (const Row& row : rows) passed = passed && row.finding.passed;
  return passed ? kOk : kWrong;
}

int parse_and_run(int argc, char** argv) {
  CLI::App app("Hard cases: what is expected of each, and what came out", "dch_hard_cases");
  Options options;
  app.add_option("--repairs", options.effort.repairs, "Repairs in a row")->check(CLI::Range(100, 10000000));
  app.add_option("--most-beads", options.effort.most_beads, "Beads of the longest necklaces")
      ->check(CLI::Range(64, 1 << 20));
  app.add_option("--json", options.json, "File for all rows");
  app.add_flag("--markdown", options.markdown, "Print the table in Markdown");
  app.add_option("--document", options.document, "File in which all rows have to stand, in Markdown");
  return bench::run_program(app, argc, argv, [&] { return run(options); });
}

}  // namespace
}  // namespace dch::hard

int main(int argc, char** argv) { return dch::hard::parse_and_run(argc, argv); }
