#include "bakers/io/file_bytes.hpp"

#include <algorithm>
#include <cerrno>
#include <system_error>

namespace pbrbake::io {

File::File(const std::filesystem::path& path, std::uint64_t max_bytes)
    : where_(path.string()), file_(nullptr, &std::fclose) {
    std::error_code error;
    const auto status = std::filesystem::status(path, error);
    if (status.type() == std::filesystem::file_type::not_found)
        throw unreadable(where_, "there is no such file");
    if (error) throw unreadable(where_, error.message());
    if (!std::filesystem::is_regular_file(status)) throw unreadable(where_, "is not a regular file");
    size_ = std::filesystem::file_size(path, error);
    if (error) throw unreadable(where_, error.message());
    if (size_ > max_bytes)
        throw unreadable(
            where_, "has " + std::to_string(size_) + " bytes; the limit is " + std::to_string(max_bytes));
    file_.reset(std::fopen(where_.c_str(), "rb"));
    if (!file_) throw unreadable(where_, std::generic_category().message(errno));
}

void File::read(std::uint64_t offset, std::span<std::byte> bytes) const {
    if (bytes.empty()) return;
    if (::fseeko(file_.get(), static_cast<off_t>(offset), SEEK_SET) != 0 ||
        std::fread(bytes.data(), 1, bytes.size(), file_.get()) != bytes.size())
        throw unreadable(where_, "could not be read to its end");
}

std::vector<std::byte> File::head(std::uint64_t count) const {
    std::vector<std::byte> bytes(static_cast<std::size_t>(std::min(count, size_)));
    read(0, bytes);
    return bytes;
}

std::vector<std::byte> read_file(const std::filesystem::path& path, std::uint64_t max_bytes) {
    const File file(path, max_bytes);
    return file.head(file.size());
}

}  // namespace pbrbake::io
