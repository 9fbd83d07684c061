#include "bakers/io/exr_memory.hpp"

#include <IexBaseExc.h>

#include <algorithm>

namespace pbrbake::io {

namespace {

/// How many bytes to read, if a file of `size` has them.
std::size_t checked_count(int count, uint64_t position, uint64_t size) {
    if (count < 0 || position > size || static_cast<uint64_t>(count) > size - position)
        throw Iex::InputExc("Unexpected end of file.");
    return static_cast<std::size_t>(count);
}

}  // namespace

bool ExrInput::read(char out[], int count) {
    const std::size_t wanted = checked_count(count, position_, file_.size());
    std::memcpy(out, file_.data() + position_, wanted);
    position_ += wanted;
    return position_ < file_.size();
}

bool ExrFileInput::read(char out[], int count) {
    const std::size_t wanted = checked_count(count, position_, file_.size());
    file_.read(position_, std::as_writable_bytes(std::span(out, wanted)));
    position_ += wanted;
    return position_ < file_.size();
}

void ExrOutput::write(const char in[], int count) {
    const auto size = static_cast<std::size_t>(count);
    if (position_ + size > file_.size()) {
        if (position_ + size > file_.capacity())
            file_.reserve(std::max(file_.capacity() * 2, position_ + size));
        file_.resize(position_ + size);
    }
    std::memcpy(file_.data() + position_, in, size);
    position_ += size;
}

}  // namespace pbrbake::io
