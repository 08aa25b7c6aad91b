// SPDX-License-Identifier: MIT
#pragma once

namespace dch::cli {

/// What a page that shows frames is made of: the library with its license, the page's style, its body and its
/// script. From replay/view and replay/vendored/three, by CMake.
extern const char* const kThreeLicense;
extern const char* const kThree;
extern const char* const kOrbitControls;
extern const char* const kViewStyle;
extern const char* const kViewBody;
extern const char* const kViewScript;

}  // namespace dch::cli
