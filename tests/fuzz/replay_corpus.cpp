// SPDX-License-Identifier: MIT
//
// Runs a fuzz target without libFuzzer: every file of a corpus, then mutations of these files. Mutations
// depend on their number alone, so that any run can be repeated.
//
//   PROGRAM [--mutations COUNT] FOLDER
//
// Status 0 if no input failed, 2 for wrong arguments or an empty corpus. An input that fails ends the process
// by a signal and is left in the file fuzz-failure in the working folder, for PROGRAM's libFuzzer twin or a
// debugger.
#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>
#include <unistd.h>
#include <vector>

#include "fuzz_input.hpp"
#include "random.hpp"

namespace {

using Bytes = std::vector<std::uint8_t>;

Bytes current;  // what runs now, for the handler below

void leave_failure(int signal) {
  const int file = ::open("fuzz-failure", O_WRONLY | O_CREAT | O_TRUNC, 0666);
  if (file >= 0) {
    const ssize_t written = ::write(file, current.data(), current.size());
    static_cast<void>(written);
    ::close(file);
  }
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

void run(Bytes input) {
  current = std::move(input);
  try {
    LLVMFuzzerTestOneInput(current.data(), current.size());
  } catch (const std::exception& error) {
    dch::fuzz::fail(std::string("an exception that the target does not expect: ") + error.what());
  }
}

std::vector<Bytes> read_corpus(const char* folder) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.is_regular_file()) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  std::vector<Bytes> corpus;
  for (const auto& file : files) {
    std::ifstream stream(file, std::ios::binary);
    corpus.emplace_back(std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>());
  }
  return corpus;
}

/// One to eight changes: a flipped bit, another byte, bytes left out or said twice, a part of another input.
Bytes mutated(const std::vector<Bytes>& corpus, std::uint64_t number) {
  dch::scenes::Random random(number);
  Bytes bytes = corpus[random.below(corpus.size())];
  for (std::size_t changes = 1 + random.below(8); changes > 0; --changes) {
    const std::size_t at = random.below(bytes.size() + 1), length = 1 + random.below(16);
    const auto from = bytes.begin() + static_cast<std::ptrdiff_t>(at);
    const auto to = bytes.begin() + static_cast<std::ptrdiff_t>(std::min(at + length, bytes.size()));
    const std::size_t kind = random.below(5);
    if (kind == 0 && at < bytes.size()) {
      bytes[at] = static_cast<std::uint8_t>(bytes[at] ^ 1u << random.below(8));
    } else if (kind == 1 && at < bytes.size()) {
      bytes[at] = static_cast<std::uint8_t>(random.below(256));
    } else if (kind == 2) {
      bytes.erase(from, to);
    } else {
      const Bytes& other = kind == 3 ? bytes : corpus[random.below(corpus.size())];
      const std::size_t begin = random.below(other.size() + 1), end = std::min(begin + length, other.size());
      const Bytes part(other.begin() + static_cast<std::ptrdiff_t>(begin),
                       other.begin() + static_cast<std::ptrdiff_t>(end));
      bytes.insert(bytes.begin() + static_cast<std::ptrdiff_t>(at), part.begin(), part.end());
    }
  }
  return bytes;
}

}  // namespace

int main(int argc, char** argv) {
  const bool mutates = argc == 4 && std::string_view(argv[1]) == "--mutations";
  if (argc != 2 && !mutates) {
    std::fprintf(stderr, "usage: %s [--mutations COUNT] FOLDER\n", argv[0]);
    return 2;
  }
  for (const int signal : {SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL}) std::signal(signal, leave_failure);
  const std::vector<Bytes> corpus = read_corpus(argv[argc - 1]);
  if (corpus.empty()) {
    std::fprintf(stderr, "%s: no input in %s\n", argv[0], argv[argc - 1]);
    return 2;
  }
  for (const Bytes& input : corpus) run(input);
  const std::uint64_t mutations = mutates ? std::strtoull(argv[2], nullptr, 10) : 0;
  for (std::uint64_t k = 0; k < mutations; ++k) run(mutated(corpus, k));
  std::printf("%zu inputs of the corpus and %llu mutations of them, none failed\n", corpus.size(),
              static_cast<unsigned long long>(mutations));
}
