#include "bakers/io/exr_memory.hpp"

#include <IexBaseExc.h>

#include <algorithm>

namespace pbrbake::io {

bool ExrInput::read(char out[], int count) {
    const auto wanted = static_cast<uint64_t>(std::max(count, 0));
    if (count < 0 || position_ > file_.size() || wanted > file_.size() - position_)
        throw Iex::InputExc("Unexpected end of file.");
    std::memcpy(out, file_.data() + position_, wanted);
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
