// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

// Debian's liblammps-dev installs headers that include fmt/format.h, but not that header: LAMMPS carries its
// own copy of {fmt}, in the inline namespace fmt::v7_lmp, and the system's libfmt has another ABI. What the
// installed headers say with these names needs declarations only. Our code calls no function that takes them,
// so no symbol is ever wanted.
namespace fmt {
inline namespace v7_lmp {

template <class Char>
class basic_string_view {
  const Char* data_;
  decltype(sizeof 0) size_;
};
using string_view = basic_string_view<char>;

class format_args;

template <class... Args, class Format>
const format_args& make_args_checked(const Format& format, const Args&... args);

}  // namespace v7_lmp
}  // namespace fmt
