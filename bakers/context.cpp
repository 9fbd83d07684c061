#include "bakers/context.hpp"

#include <algorithm>
#include <utility>

namespace pbrbake {

Context::Context(int threads, Accuracy accuracy, ProgressSink progress, const std::atomic<bool>* cancel)
    : threads_(std::max(1, threads)),
      accuracy_(std::move(accuracy)),
      sink_(std::move(progress)),
      cancel_(cancel) {}

Context::~Context() = default;

bool Context::may_store(PixelType pixel) const {
    return pixels_.empty() || std::ranges::find(pixels_, pixel) != pixels_.end();
}

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
    if (!workers_) workers_ = std::make_unique<Workers>(threads_);
    workers_->for_each(chunks, run_chunk);
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
