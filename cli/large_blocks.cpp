// Large blocks of memory lie on huge pages, where Linux has some to give. Pictures are written once, and the
// kernel takes longer to hand out 512 small pages than a baker to fill them: a small bake spent a fifth of
// its time on that.

#ifdef __linux__

#include <malloc.h>
#include <sys/mman.h>

#include <cstddef>
#include <cstdlib>
#include <new>

namespace {

constexpr std::size_t kHugePage = std::size_t{2} << 20;
/// Above this a huge page, though mostly unused, costs less than the small ones.
constexpr std::size_t kLarge = std::size_t{512} << 10;

/// From this size on a block is given back when it is freed. The C library else raises its limit to 32 MiB
/// with the blocks that it sees, and keeps holes between aligned ones: a texture set took half as much again.
constexpr int kGivenBack = 4 << 20;
[[maybe_unused]] const int set_once = ::mallopt(M_MMAP_THRESHOLD, kGivenBack);

void* large_block(std::size_t size) {
    const std::size_t whole = (size + kHugePage - 1) / kHugePage * kHugePage;
    void* block = whole < size ? nullptr : std::aligned_alloc(kHugePage, whole);
    if (block) ::madvise(block, whole, MADV_HUGEPAGE);  // a wish: without it the block is as good
    return block;
}

}  // namespace

void* operator new(std::size_t size) {
    if (void* block = size < kLarge ? std::malloc(size > 0 ? size : 1) : large_block(size)) return block;
    throw std::bad_alloc();
}
void operator delete(void* block) noexcept { std::free(block); }
void operator delete(void* block, std::size_t) noexcept { std::free(block); }

#endif
