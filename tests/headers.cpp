// SPDX-License-Identifier: MIT
// Whose headers are compiled once for all tests.
int main() {}
