// SPDX-License-Identifier: MIT
#pragma once

namespace dch::cli {

/// From here on SIGHUP, SIGINT and SIGTERM only set a flag, so that a run can end by an exception and
/// temporary files go away. A second one removes these and ends the process at once. Signals that were
/// ignored (nohup) stay ignored. A file that grows beyond its limit is an error of the write and no signal.
void catch_interrupts();

/// @throws Interrupted if one of these signals has come.
void throw_if_interrupted();

}  // namespace dch::cli
