// Writes OpenEXR files, by OpenEXR.
#include "core/image/module/write/encoders.h"

#include "core/base/error.h"

#include <ImfChannelList.h>
#include <ImfDoubleAttribute.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfIntAttribute.h>
#include <ImfMultiPartOutputFile.h>
#include <ImfOutputFile.h>
#include <ImfOutputPart.h>
#include <ImfPartType.h>
#include <ImfStringAttribute.h>

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <memory>
#include <stdexcept>
#include <system_error>

namespace neumann::encoders {

namespace {

class Memory : public Imf::OStream {
public:
    Memory() : OStream("memory") {}

    void write(const char* bytes, int count) override {
        const auto size = static_cast<std::size_t>(count), over = std::min(size, bytes_.size() - place_);
        bytes_.replace(place_, over, bytes, over);
        bytes_.append(bytes + over, size - over);
        place_ += size;
    }
    std::uint64_t tellp() override { return place_; }
    void seekp(std::uint64_t place) override { place_ = place; }
    void reserve(std::size_t bytes) { bytes_.reserve(bytes); }
    std::string take() { return std::move(bytes_); }

private:
    std::string bytes_;
    std::size_t place_ = 0;
};

// OpenEXR hides what fails when it completes a file in its destructor, so the first error is kept for finish().
class OnDisk : public Imf::OStream {
public:
    explicit OnDisk(const std::filesystem::path& path)
        : OStream(path.c_str()), file_(std::fopen(path.c_str(), "wbe"), &std::fclose) {
        expect(file_ != nullptr);
    }

    void write(const char* bytes, int count) override {
        const auto size = static_cast<std::size_t>(count);
        expect(std::fwrite(bytes, 1, size, file_.get()) == size);
    }
    std::uint64_t tellp() override { return static_cast<std::uint64_t>(::ftello(file_.get())); }
    void seekp(std::uint64_t place) override { expect(::fseeko(file_.get(), static_cast<off_t>(place), SEEK_SET) == 0); }
    void finish() {
        if (error_ == 0) expect(std::fclose(file_.release()) == 0);
        if (error_ != 0) throw std::system_error(error_, std::generic_category());
    }

private:
    void expect(bool good) {
        if (good) return;
        if (error_ == 0) error_ = errno;
        throw std::system_error(error_, std::generic_category());
    }

    int error_ = 0;
    std::unique_ptr<std::FILE, decltype(&std::fclose)> file_;
};

struct Layer {
    std::string prefix;
    const Image* image;
};

std::string channel(const Layer& layer, int component) { return layer.prefix + std::string(1, "RGB"[component]); }

// A buffer for rows of all layers as floats, one channel after another.
Imf::FrameBuffer floats(const std::vector<Layer>& layers, int y, int rows, float* to) {
    Imf::FrameBuffer buffer;
    for (const Layer& layer : layers) {
        const int width = layer.image->width;
        const auto first = static_cast<std::ptrdiff_t>(y) * width, count = static_cast<std::ptrdiff_t>(rows) * width;
        for (int c = 0; c < 3; ++c, to += count) {
            for (std::ptrdiff_t i = 0; i < count; ++i)
                to[i] = static_cast<float>(layer.image->pixels[static_cast<std::size_t>(first + i)][c]);
            buffer.insert(channel(layer, c), Imf::Slice::Make(Imf::FLOAT, to, Imath::V2i(0, y), width, rows));
        }
    }
    return buffer;
}

void set_attribute(Imf::Header& header, const std::string& name, const Attribute& value) {
    if (const auto* text = std::get_if<std::string>(&value)) {
        header.insert(name, Imf::StringAttribute(*text));
    } else if (const auto* real = std::get_if<double>(&value)) {
        header.insert(name, Imf::DoubleAttribute(*real));
    } else {
        const std::int64_t whole = std::get<std::int64_t>(value);
        constexpr std::int64_t exact_in_double = std::int64_t{1} << 53;
        if (whole >= std::numeric_limits<int>::min() && whole <= std::numeric_limits<int>::max())
            header.insert(name, Imf::IntAttribute(static_cast<int>(whole)));
        else if (std::abs(whole) <= exact_in_double)
            header.insert(name, Imf::DoubleAttribute(static_cast<double>(whole)));
        else
            header.insert(name, Imf::StringAttribute(std::to_string(whole)));
    }
}

// The channels of a picture, to which it keeps a reference, and its header.
class Encoded {
public:
    // `part` is the name of the picture's part, if the file has several. Programs that show layers (Blender 3.4) go by
    // the channels' names and not by the parts'; Combined is what Blender calls the picture itself.
    Encoded(const PixelEstimate& picture, const Attributes& attributes, const std::string& part = "")
        : width(picture.mean.width), height(picture.mean.height), header(std::max(1, width), std::max(1, height)) {
        if (!picture.least_error.pixels.empty()) raised_ = picture.pixel_errors();
        const bool is_raised = !raised_.pixels.empty() && raised_.pixels != picture.standard_error.pixels;
        const std::string first = part.empty() ? "" : part + ".";
        layers_.push_back({part.empty() ? "" : first + "Combined.", &picture.mean});
        if (!picture.standard_error.pixels.empty())
            layers_.push_back({first + "stderr.", is_raised ? &raised_ : &picture.standard_error});
        if (is_raised) layers_.push_back({first + "spread.", &picture.standard_error});
        if (!picture.discretisation.pixels.empty()) layers_.push_back({first + "discretisation.", &picture.discretisation});
        // Most bits of a picture with errors are noise: zip would save little more than run lengths, in ten times the time.
        header.compression() = Imf::RLE_COMPRESSION;
        for (const auto& [name, value] : attributes) set_attribute(header, name, value);
        for (const Layer& layer : layers_) {
            if (layer.image->pixels.empty() || layer.image->width != width || layer.image->height != height)
                throw std::invalid_argument("encode_exr: an empty picture, or errors of another size");
            for (int c = 0; c < 3; ++c) header.channels().insert(channel(layer, c), Imf::Channel(Imf::FLOAT));
        }
    }
    Encoded(const Encoded&) = delete;
    Encoded& operator=(const Encoded&) = delete;

    std::size_t bytes() const {
        return 3 * layers_.size() * layers_.front().image->pixels.size() * sizeof(float) + 16 * static_cast<std::size_t>(height) +
               0x4000;
    }
    // Writes into an Imf::OutputFile, or into a part of a file.
    template <class File>
    void write(File& file) const {
        constexpr int rows_at_once = 16;  // floats of so few rows stay in the cache
        std::vector<float> values(3 * layers_.size() * rows_at_once * static_cast<std::size_t>(width));
        for (int y = 0; y < height; y += rows_at_once) {
            const int rows = std::min(rows_at_once, height - y);
            file.setFrameBuffer(floats(layers_, y, rows, values.data()));
            file.writePixels(rows);
        }
    }

    const int width, height;
    Imf::Header header;

private:
    Image raised_;
    std::vector<Layer> layers_;
};

// Calls write(), and turns OpenEXR's exceptions into RunError.
template <class Write>
void expect_written(int width, int height, const Write& write) {
    try {
        write();
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::system_error&) {
        throw;
    } catch (const std::exception& error) {
        throw RunError(fmt::format("OpenEXR cannot write a picture of {}×{}: {}", width, height, error.what()));
    }
}

}  // namespace

std::string encode_exr(const PixelEstimate& picture, const Attributes& attributes) {
    const Encoded encoded(picture, attributes);
    Memory memory;
    expect_written(encoded.width, encoded.height, [&] {
        memory.reserve(encoded.bytes());
        Imf::OutputFile file(memory, encoded.header, 0);
        encoded.write(file);
    });
    return memory.take();
}

void write_exr_parts(const std::filesystem::path& path, std::size_t count, const std::function<ExrPart(std::size_t)>& part) {
    std::vector<Imf::Header> headers;
    for (std::size_t i = 0; i < count; ++i) {
        const ExrPart of = part(i);
        headers.push_back(Encoded(of.picture, of.attributes, of.name).header);
        headers.back().setName(of.name);
        headers.back().setType(Imf::SCANLINEIMAGE);
    }
    if (headers.empty()) throw std::invalid_argument("write_exr_parts: no pictures");
    const Imath::Box2i window = headers.front().dataWindow();
    OnDisk disk(path);
    expect_written(window.max.x + 1, window.max.y + 1, [&] {
        Imf::MultiPartOutputFile file(disk, headers.data(), static_cast<int>(count), false, 0);
        for (std::size_t i = 0; i < count; ++i) {
            const ExrPart of = part(i);
            Imf::OutputPart out(file, static_cast<int>(i));
            Encoded(of.picture, of.attributes, of.name).write(out);
        }
    });
    disk.finish();
}

}  // namespace neumann::encoders
