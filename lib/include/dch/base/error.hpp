// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>
#include <string>

#pragma GCC visibility push(default)
namespace dch {

/// Base of everything the library throws. The message names the value, the limit and the remedy.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A parameter outside its range (a negative skin, c below 1.05, an index out of bounds, ...).
class InvalidParameter : public Error {
 public:
  using Error::Error;
};

/// A cell with a zero or negative extent, a non-finite vector or linearly dependent vectors.
class InvalidBox : public Error {
 public:
  using Error::Error;
};

/// A coordinate that is NaN, infinite or larger in magnitude than kMaxCoordinate.
class InvalidPosition : public Error {
 public:
  using Error::Error;
};

/// cutoff + skin exceeds half the smallest height of the periodic cell.
class CutoffTooLarge : public Error {
 public:
  using Error::Error;
};

}  // namespace dch
#pragma GCC visibility pop
