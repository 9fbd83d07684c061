#pragma once
// OpenEXR's streams over files and memory.

#include <ImfIO.h>

#include <vector>

#include "bakers/io/file_bytes.hpp"

namespace pbrbake::io {

/// Reads a file in memory; throws Iex::InputExc past its end. `file` must outlive the stream.
class ExrInput : public Imf::IStream {
  public:
    ExrInput(Bytes file, const std::string& name) : Imf::IStream(name.c_str()), file_(file) {}
    bool read(char out[], int count) override;
    uint64_t tellg() override { return position_; }
    void seekg(uint64_t position) override { position_ = position; }

  private:
    Bytes file_;
    uint64_t position_ = 0;
};

/// Reads an open file, as far as OpenEXR asks; throws Iex::InputExc past its end. `file` must outlive the
/// stream.
class ExrFileInput : public Imf::IStream {
  public:
    explicit ExrFileInput(const File& file) : Imf::IStream(file.where().c_str()), file_(file) {}
    bool read(char out[], int count) override;
    uint64_t tellg() override { return position_; }
    void seekg(uint64_t position) override { position_ = position; }

  private:
    const File& file_;
    uint64_t position_ = 0;
};

/// Writes a file into memory.
class ExrOutput : public Imf::OStream {
  public:
    ExrOutput() : Imf::OStream("memory") {}
    void write(const char in[], int count) override;
    uint64_t tellp() override { return position_; }
    void seekp(uint64_t position) override { position_ = position; }
    std::vector<std::byte> take() { return std::move(file_); }

  private:
    std::vector<std::byte> file_;
    uint64_t position_ = 0;
};

}  // namespace pbrbake::io
