// SPDX-License-Identifier: MIT
#include "mutants.hpp"

namespace mutants {
namespace {

int number() {
  const char* const text = std::getenv("DCH_MUTANT");
  return text ? std::atoi(text) : 0;
}

}  // namespace

int active = number();

}  // namespace mutants
