// SPDX-License-Identifier: MIT
#pragma once

namespace dch::cli {

/// From here on SIGINT and SIGTERM only set a flag, so that a run can end by an exception and temporary files
/// go away.
void catch_interrupts();

/// @throws Interrupted if one of these signals has come.
void throw_if_interrupted();

}  // namespace dch::cli
