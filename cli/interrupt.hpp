#pragma once
// Ctrl-C and SIGTERM as a flag that a run polls.

#include <atomic>

namespace pbrbake::cli {

/// From now on, SIGINT and SIGTERM set the flag; a second one ends the process at once.
const std::atomic<bool>& catch_interrupts();

}  // namespace pbrbake::cli
