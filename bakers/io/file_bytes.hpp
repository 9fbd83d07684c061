#pragma once
// Files in memory, whole or a part at a time, and little-endian numbers in them.

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bakers/error.hpp"

namespace pbrbake::io {

using Bytes = std::span<const std::byte>;

/// A failure to read `where`.
inline Error unreadable(const std::string& where, std::string message) {
    return Error(ExitCode::unreadable_input, where, std::move(message));
}

/// A regular file, open to be read at any place.
class File {
  public:
    /// Throws Error(unreadable_input) for what is absent, not a regular file, or longer than `max_bytes`.
    File(const std::filesystem::path& path, std::uint64_t max_bytes);

    /// Bytes when it was opened.
    std::uint64_t size() const { return size_; }
    /// As opened, for messages.
    const std::string& where() const { return where_; }
    /// Fills `bytes` from `offset` on; throws Error(unreadable_input) where the file has fewer.
    void read(std::uint64_t offset, std::span<std::byte> bytes) const;
    /// The first bytes, at most `count`.
    std::vector<std::byte> head(std::uint64_t count) const;

  private:
    std::string where_;
    std::uint64_t size_ = 0;
    std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_;
};

/// The file's bytes. Throws Error(unreadable_input) for what is absent, not a regular file, or longer than
/// `max_bytes`.
std::vector<std::byte> read_file(const std::filesystem::path& path, std::uint64_t max_bytes);

/// The little-endian T at `offset`, which must be inside.
template <class T>
T load(Bytes bytes, std::size_t offset) {
    static_assert(std::endian::native == std::endian::little, "containers are read and written as stored");
    T value;
    std::memcpy(&value, bytes.data() + offset, sizeof value);
    return value;
}

/// The bytes as text, from `offset`, of `size` characters.
inline std::string text_at(Bytes bytes, std::size_t offset, std::size_t size) {
    return {reinterpret_cast<const char*>(bytes.data()) + offset, size};
}

/// Whether the file begins with `magic` (which may hold NUL).
inline bool begins_with(Bytes bytes, std::string_view magic) {
    return bytes.size() >= magic.size() && std::memcmp(bytes.data(), magic.data(), magic.size()) == 0;
}

}  // namespace pbrbake::io
