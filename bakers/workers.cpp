#include "bakers/workers.hpp"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#ifdef PBRBAKE_TSAN
#include <sanitizer/tsan_interface.h>
extern "C" const char* __tsan_default_suppressions() {
    return "called_from_lib:libtbb.so\n";
}  // its end of threads
#endif

namespace pbrbake {
namespace {

// oneTBB orders the caller's writes before the bodies and the bodies before the caller's return, but
// ThreadSanitizer can't see into the library. Under it, and only there, the same order is spelt out; bodies
// get none among themselves.
#ifdef PBRBAKE_TSAN
void happens_before(const char& point) { __tsan_release(const_cast<char*>(&point)); }
void happens_after(const char& point) { __tsan_acquire(const_cast<char*>(&point)); }
#else
void happens_before(const char&) {}
void happens_after(const char&) {}
#endif

struct BeforeAtEnd {  // also when a body throws
    const char& point;
    ~BeforeAtEnd() { happens_before(point); }
};
struct AfterAtEnd {
    const char& point;
    ~AfterAtEnd() { happens_after(point); }
};

}  // namespace

struct Workers::Arena {
    explicit Arena(int threads)
        : limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads)),
          arena(threads) {}
    tbb::global_control limit;  // else oneTBB caps an arena at the machine's threads, and says so on stderr
    tbb::task_arena arena;
};

Workers::Workers(int threads) : arena_(std::make_unique<Arena>(threads)) {}
Workers::~Workers() = default;

void Workers::for_each(std::int64_t count, const std::function<void(std::int64_t)>& body) {
    const char start = 0, end = 0;
    happens_before(start);
    const AfterAtEnd all{end};
    arena_->arena.execute([&] {
        tbb::parallel_for(std::int64_t{0}, count, [&](std::int64_t i) {
            happens_after(start);
            const BeforeAtEnd one{end};
            body(i);
        });
    });
}

}  // namespace pbrbake
