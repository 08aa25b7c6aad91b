// SPDX-License-Identifier: MIT
//
// Readers of HDF5 files fork, some thousand times in these tests, and a fork copies the page tables of
// all that the address sanitizer holds back of freed memory: 256 MB unless it is told otherwise, with which
// the tests take twice as long.
#if defined(__SANITIZE_ADDRESS__)
extern "C" const char* __asan_default_options() { return "quarantine_size_mb=8"; }
#endif
