#include "bakers/io/file_bytes.hpp"

#include <cerrno>
#include <cstdio>
#include <memory>
#include <system_error>

namespace pbrbake::io {

std::vector<std::byte> read_file(const std::filesystem::path& path, std::uint64_t max_bytes) {
    const std::string where = path.string();
    std::error_code error;
    const auto status = std::filesystem::status(path, error);
    if (status.type() == std::filesystem::file_type::not_found)
        throw unreadable(where, "there is no such file");
    if (error) throw unreadable(where, error.message());
    if (!std::filesystem::is_regular_file(status)) throw unreadable(where, "is not a regular file");
    const std::uintmax_t size = std::filesystem::file_size(path, error);
    if (error) throw unreadable(where, error.message());
    if (size > max_bytes)
        throw unreadable(where,
                         "has " + std::to_string(size) + " bytes; the limit is " + std::to_string(max_bytes));

    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(where.c_str(), "rb"), &std::fclose);
    if (!file) throw unreadable(where, std::generic_category().message(errno));
    std::vector<std::byte> bytes(static_cast<std::size_t>(size));
    if (size > 0 && std::fread(bytes.data(), 1, bytes.size(), file.get()) != bytes.size())
        throw unreadable(where, "could not be read to its end");
    return bytes;
}

}  // namespace pbrbake::io
