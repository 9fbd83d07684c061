// OpenImageIO's share of io, as a module that is loaded when a file first needs it.

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <exception>
#include <string>

#include "bakers/io/module_api.hpp"

namespace pbrbake::io {
namespace {

PictureSpec describe(const OIIO::ImageSpec& spec) {
    PictureSpec picture;
    picture.width = spec.width;
    picture.height = spec.height;
    picture.channels = spec.nchannels;
    picture.bytes_per_channel = static_cast<int>(spec.format.size());
    picture.is_float = spec.format.is_floating_point();
    picture.orientation = spec.get_int_attribute("Orientation", 1);
    picture.gamma = spec.get_float_attribute("oiio:Gamma", 0.f);
    picture.exif_srgb = spec.get_int_attribute("Exif:ColorSpace", 0) == 1;
    if (const OIIO::ParamValue* profile = spec.find_attribute("ICCProfile")) {
        picture.icc_profile = spec.get_string_attribute("ICCProfile:profile_description", "unnamed");
        const auto* bytes = static_cast<const std::byte*>(profile->data());
        picture.icc_bytes.assign(bytes, bytes + profile->datasize());
    }
    picture.compression = spec.get_string_attribute("compression");
    return picture;
}

/// OpenImageIO gathers a line an error.
std::string one_line(std::string errors) {
    for (std::size_t at; (at = errors.find('\n')) != std::string::npos;) errors.replace(at, 1, "; ");
    return errors;
}

class OiioReader : public PictureReader {
  public:
    OiioReader(std::span<const std::byte> file, bool with_alpha)
        : proxy_(const_cast<std::byte*>(file.data()), file.size()), with_alpha_(with_alpha) {}

    bool open(const char* format, std::string& error) {
        input_ = OIIO::ImageInput::create(format);
        if (!input_) {
            error =
                "OpenImageIO has no reader for " + std::string(format) + ": " + one_line(OIIO::geterror());
            return false;
        }
        OIIO::ImageSpec config;
        config.attribute("oiio:UnassociatedAlpha",
                         1);  // alpha is dropped or data, so colour must not be multiplied by it
        input_->set_ioproxy(&proxy_);
        OIIO::ImageSpec spec;
        if (!input_->open("memory." + std::string(format), spec, config)) {
            error = one_line(input_->geterror());
            return false;
        }
        if (spec.depth > 1 || spec.deep) {
            error = "is volumetric or deep";
            return false;
        }
        picture_ = describe(spec);
        tile_height_ = spec.tile_height;
        x_ = spec.x;
        y_ = spec.y;
        return true;
    }

    const PictureSpec& spec() const noexcept override { return picture_; }
    int row_quantum() const noexcept override { return std::max(1, tile_height_); }
    int decoded_channels() const noexcept override {
        const int colours = picture_.channels >= 3 ? 3 : 1;
        return colours + (with_alpha_ && picture_.channels > colours ? 1 : 0);
    }

    bool read_rows(int begin, int end, float* texels, std::string& error) noexcept override {
        try {
            const bool read =
                tile_height_ > 0 ? input_->read_tiles(0, 0, x_, x_ + picture_.width, y_ + begin, y_ + end, 0,
                                                      1, 0, decoded_channels(), OIIO::TypeDesc::FLOAT, texels)
                                 : input_->read_scanlines(0, 0, y_ + begin, y_ + end, 0, 0,
                                                          decoded_channels(), OIIO::TypeDesc::FLOAT, texels);
            // A truncated TIFF "succeeds" and only leaves an error behind.
            if (read && !input_->has_error()) return true;
            error = input_->has_error() ? one_line(input_->geterror()) : "could not be decoded";
        } catch (const std::exception& failure) {
            error = failure.what();
        }
        return false;
    }

  private:
    OIIO::Filesystem::IOMemReader proxy_;
    std::unique_ptr<OIIO::ImageInput> input_;
    PictureSpec picture_;
    bool with_alpha_;
    int tile_height_ = 0, x_ = 0, y_ = 0;
};

void configure_once() {
    static const bool done = [] {
        OIIO::attribute("threads", 1);  // the caller spreads files, not rows, over its threads
        return OIIO::attribute("exr_threads", -1);
    }();
    static_cast<void>(done);
}

std::unique_ptr<PictureReader> open(const char* format, std::span<const std::byte> file, bool with_alpha,
                                    std::string& error) {
    try {
        configure_once();
        auto reader = std::make_unique<OiioReader>(file, with_alpha);
        if (reader->open(format, error)) return reader;
    } catch (const std::exception& failure) {
        error = failure.what();
    }
    return nullptr;
}

bool write_png(const OIIO::ImageSpec& spec, const void* texels, std::vector<std::byte>& file,
               std::string& error) {
    try {
        configure_once();
        const auto output = OIIO::ImageOutput::create("png");
        if (!output) {
            error = one_line(OIIO::geterror());
            return false;
        }
        std::vector<unsigned char> buffer;
        OIIO::Filesystem::IOVecOutput proxy(buffer);
        output->set_ioproxy(&proxy);
        if (!output->open("memory.png", spec) || !output->write_image(spec.format, texels) ||
            !output->close()) {
            error = one_line(output->geterror());
            return false;
        }
        const auto* bytes = reinterpret_cast<const std::byte*>(buffer.data());
        file.assign(bytes, bytes + buffer.size());
        return true;
    } catch (const std::exception& failure) {
        error = failure.what();
    }
    return false;
}

bool write_png8(int width, int height, int channels, bool is_srgb, const std::uint8_t* texels,
                std::vector<std::byte>& file, std::string& error) {
    OIIO::ImageSpec spec(width, height, channels, OIIO::TypeDesc::UINT8);
    spec.attribute("oiio:ColorSpace", is_srgb ? "sRGB" : "Linear");
    spec.attribute("oiio:UnassociatedAlpha", 1);
    return write_png(spec, texels, file, error);
}

bool write_png16(int width, int height, int channels, const std::uint16_t* texels,
                 std::vector<std::byte>& file, std::string& error) {
    OIIO::ImageSpec spec(width, height, channels, OIIO::TypeDesc::UINT16);
    spec.attribute("oiio:ColorSpace", "Linear");
    spec.attribute("oiio:UnassociatedAlpha", 1);  // a fourth channel is a number like the others
    return write_png(spec, texels, file, error);
}

}  // namespace
}  // namespace pbrbake::io

extern "C" __attribute__((visibility("default"))) const pbrbake::io::OiioModule* pbrbake_oiio_module() {
    static const pbrbake::io::OiioModule table{pbrbake::io::kModuleAbi, &pbrbake::io::open,
                                               &pbrbake::io::write_png16, &pbrbake::io::write_png8};
    return &table;
}
