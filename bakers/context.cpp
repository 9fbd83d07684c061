#include "bakers/context.hpp"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <utility>

namespace pbrbake {

struct Context::Arena {
    explicit Arena(int threads)
        : limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads)), arena(threads) {}
    tbb::global_control limit;  // else oneTBB caps an arena at the machine's threads, and says so on stderr
    tbb::task_arena arena;
};

Context::Context(int threads, Accuracy accuracy, ProgressSink progress, const std::atomic<bool>* cancel)
    : threads_(std::max(1, threads)), accuracy_(std::move(accuracy)), sink_(std::move(progress)), cancel_(cancel) {}

Context::~Context() = default;

void Context::check_cancelled() const {
    if (cancel_ && cancel_->load(std::memory_order_relaxed)) throw Cancelled{};
}

void Context::parallel_for(std::int64_t count, std::int64_t grain,
                           const std::function<void(std::int64_t, std::int64_t)>& body) {
    grain = std::max<std::int64_t>(1, grain);
    const std::int64_t chunks = (count + grain - 1) / grain;
    const auto run_chunk = [&](std::int64_t chunk) {
        check_cancelled();
        body(chunk * grain, std::min(count, (chunk + 1) * grain));
    };
    if (threads_ == 1 || chunks <= 1) {  // no scheduler is started for a small bake
        for (std::int64_t chunk = 0; chunk < chunks; ++chunk) run_chunk(chunk);
        return;
    }
    if (!arena_) arena_ = std::make_unique<Arena>(threads_);
    arena_->arena.execute([&] { tbb::parallel_for(std::int64_t{0}, chunks, run_chunk); });
}

void Context::count(std::string_view effect, std::uint64_t evaluations) {
    const std::lock_guard lock(mutex_);
    counts_[std::string(effect)] += evaluations;
}

std::map<std::string, std::uint64_t> Context::counts() const {
    const std::lock_guard lock(mutex_);
    return counts_;
}

void Context::expect(double work) {
    const std::lock_guard lock(mutex_);
    expected_ += work;
}

void Context::advance(double work) {
    const std::lock_guard lock(mutex_);
    done_ += work;
    if (sink_ && expected_ > 0) sink_(std::min(1.0, done_ / expected_));
}

}  // namespace pbrbake
