// SPDX-License-Identifier: GPL-2.0-or-later
// A program with one memory error, to see that check_valgrind.py finds it:
//     memory_errors none|read|write|uninitialised|leak|freed
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace {

// Volatile, so that the compiler neither sees the errors nor takes them out.
int* volatile block = nullptr;
volatile int sink = 0;

void make_error(const char* kind) {
  block = static_cast<int*>(std::malloc(10 * sizeof(int)));
  if (std::strcmp(kind, "uninitialised") == 0 && block[3] == 17) sink = 1;
  std::memset(block, 0, 10 * sizeof(int));
  if (std::strcmp(kind, "read") == 0) sink = block[10];
  if (std::strcmp(kind, "write") == 0) block[10] = 1;
  if (std::strcmp(kind, "leak") == 0) {
    block = nullptr;
    return;
  }
  std::free(block);
  if (std::strcmp(kind, "freed") == 0) sink = block[0];
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: memory_errors none|read|write|uninitialised|leak|freed\n");
    return 2;
  }
  make_error(argv[1]);
  return 0;
}
