#pragma once
// What a running bake knows besides its parameters and inputs. There is no other state.

#include <atomic>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bakers/image.hpp"
#include "bakers/workers.hpp"

namespace pbrbake {

/// What was asked for: a name that each baker explains in its README, or a largest error.
struct Accuracy {
    std::string name = "production";  ///< draft | production | reference | "" when max_error is stated
    double max_error = 0;             ///< > 0 only where the job states it
    bool as_sampled = false;          ///< max_error holds between texels too, where a baker offers that
    bool stated() const { return max_error > 0; }
};

/// Thrown by Context::parallel_for and check_cancelled once the run was interrupted.
struct Cancelled {};

/// Worker threads, accuracy target, evaluation counters, progress and cancellation of one bake.
class Context {
  public:
    using ProgressSink = std::function<void(double fraction)>;

    /// `threads` >= 1. `cancel` may be null; it is polled between chunks of work.
    Context(int threads, Accuracy accuracy, ProgressSink progress = {},
            const std::atomic<bool>* cancel = nullptr);
    ~Context();
    Context(const Context&) = delete;
    Context& operator=(const Context&) = delete;

    const Accuracy& accuracy() const { return accuracy_; }
    int threads() const { return threads_; }

    /// Whether certify() is to check every texel (a measurement) or a sample of them (an estimate).
    bool certify_fully() const { return certify_fully_; }
    void set_certify_fully(bool fully) { certify_fully_ = fully; }

    /// Whether the product may be stored as `pixel`, should the baker choose: the job states no other, and
    /// its format holds it. Anything may where nothing was set.
    bool may_store(PixelType pixel) const;
    void set_pixels(std::vector<PixelType> pixels) { pixels_ = std::move(pixels); }

    /// The name of the product's first file, "X.png", for documents that name it; "" where none is written.
    const std::string& product_file() const { return product_file_; }
    void set_product_file(std::string file) { product_file_ = std::move(file); }

    /// Calls body(begin, end) over disjoint ranges that cover [0, count), none longer than `grain`, on the
    /// worker threads. Results must not depend on the split. Throws Cancelled when interrupted, else what a
    /// body threw first.
    void parallel_for(std::int64_t count, std::int64_t grain,
                      const std::function<void(std::int64_t begin, std::int64_t end)>& body);

    /// Adds evaluations of an effect ("ggx", "disney_diffuse", "texel_fetches"); thread-safe.
    void count(std::string_view effect, std::uint64_t evaluations);
    std::map<std::string, std::uint64_t> counts() const;

    /// Announces `work` more units to come; every unit finished moves the progress sink. Thread-safe.
    void expect(double work);
    void advance(double work);

    void check_cancelled() const;

  private:
    int threads_;
    Accuracy accuracy_;
    bool certify_fully_ = false;
    std::vector<PixelType> pixels_;
    std::string product_file_;
    ProgressSink sink_;
    const std::atomic<bool>* cancel_;
    std::unique_ptr<Workers> workers_;  ///< made when first needed
    mutable std::mutex mutex_;
    std::map<std::string, std::uint64_t> counts_;
    double expected_ = 0, done_ = 0;
};

}  // namespace pbrbake
