// XXH3-128 of files and buffers.

#include <xxhash.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <memory>
#include <system_error>

#include "bakers/io/file_bytes.hpp"
#include "bakers/io/io.hpp"

namespace pbrbake::io {
namespace {

std::string hex(XXH128_hash_t hash) {
    XXH128_canonical_t canonical;
    XXH128_canonicalFromHash(&canonical, hash);
    constexpr std::string_view digits = "0123456789abcdef";
    std::string text;
    for (const unsigned char byte : canonical.digest) {
        text += digits[byte >> 4];
        text += digits[byte & 15];
    }
    return text;
}

}  // namespace

std::string hash_bytes(const std::byte* data, std::size_t size) { return hex(XXH3_128bits(data, size)); }

std::string hash_file(const std::filesystem::path& path) {
    const std::string where = path.string();
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(where.c_str(), "rb"), &std::fclose);
    if (!file) throw unreadable(where, std::generic_category().message(errno));
    const std::unique_ptr<XXH3_state_t, XXH_errorcode (*)(XXH3_state_t*)> state(XXH3_createState(),
                                                                                &XXH3_freeState);
    XXH3_128bits_reset(state.get());
    std::vector<std::byte> chunk(std::size_t{1} << 20);
    while (const std::size_t count = std::fread(chunk.data(), 1, chunk.size(), file.get()))
        XXH3_128bits_update(state.get(), chunk.data(), count);
    if (std::ferror(file.get())) throw unreadable(where, "could not be read to its end");
    return hex(XXH3_128bits_digest(state.get()));
}

}  // namespace pbrbake::io
