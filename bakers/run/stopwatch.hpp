#pragma once
// Times and memory, for the run report alone: nothing in a product depends on them.

#include <chrono>
#include <cstdint>

namespace pbrbake::run {

/// Seconds on the wall and on all processors of this process.
struct Seconds {
    double wall = 0;
    double cpu = 0;
};

/// Runs from its construction.
class Stopwatch {
  public:
    Stopwatch();
    Seconds elapsed() const;

  private:
    std::chrono::steady_clock::time_point wall_start_;
    double cpu_start_;
};

/// The most memory this process has had in use so far, bytes.
std::uint64_t peak_memory_bytes();

}  // namespace pbrbake::run
