#pragma once
// A pool of worker threads. Its source is the only one that includes oneTBB.

#include <cstdint>
#include <functional>
#include <memory>

namespace pbrbake {

class Workers {
  public:
    /// `threads` >= 1, the calling one included.
    explicit Workers(int threads);
    ~Workers();

    /// Calls body(i) once for every i in [0, count), in any order and on any of the threads; returns when all
    /// have ended. Rethrows what a body threw first, after which further calls may be left out.
    void for_each(std::int64_t count, const std::function<void(std::int64_t)>& body);

  private:
    struct Arena;
    std::unique_ptr<Arena> arena_;
};

}  // namespace pbrbake
