#include "apps/live/tev_packets.h"

#include <bit>
#include <cstdint>
#include <cstring>
#include <utility>

namespace neumann {

namespace {

static_assert(std::endian::native == std::endian::little);

enum class TevOperation : std::uint8_t { create_image = 4, update_image_with_strides = 6 };

class TevPacket {
public:
    explicit TevPacket(TevOperation operation) {
        add(std::uint32_t{0});
        add(operation);
    }
    template <typename Number>
    void add(Number value) {
        const std::size_t at = bytes_.size();
        bytes_.resize(at + sizeof value);
        std::memcpy(bytes_.data() + at, &value, sizeof value);
    }
    void add(const std::string& text) { bytes_.append(text.c_str(), text.size() + 1); }
    void reserve(std::size_t more) { bytes_.reserve(bytes_.size() + more); }
    std::string finished() && {
        const auto length = static_cast<std::uint32_t>(bytes_.size());
        std::memcpy(bytes_.data(), &length, sizeof length);
        return std::move(bytes_);
    }

private:
    std::string bytes_;
};

constexpr bool takes_the_eye = false;  // whether tev turns to the image
constexpr std::int32_t rgb = 3;

}  // namespace

std::vector<std::string> tev_channels(const std::string& layer) {
    const std::string before = layer.empty() ? "" : layer + ".";
    return {before + "R", before + "G", before + "B"};
}

std::string tev_create_image(const std::string& name, int width, int height, const std::vector<std::string>& channels) {
    TevPacket packet(TevOperation::create_image);
    packet.add(takes_the_eye);
    packet.add(name);
    packet.add(std::int32_t{width});
    packet.add(std::int32_t{height});
    packet.add(static_cast<std::int32_t>(channels.size()));
    for (const std::string& channel : channels) packet.add(channel);
    return std::move(packet).finished();
}

std::string tev_update_image(const std::string& name, const std::string& layer, const Image& picture) {
    TevPacket packet(TevOperation::update_image_with_strides);
    packet.add(takes_the_eye);
    packet.add(name);
    packet.add(rgb);
    for (const std::string& channel : tev_channels(layer)) packet.add(channel);
    for (const int corner : {0, 0, picture.width, picture.height}) packet.add(std::int32_t{corner});
    for (std::int64_t offset = 0; offset < rgb; ++offset) packet.add(offset);
    for (int channel = 0; channel < rgb; ++channel) packet.add(std::int64_t{rgb});  // distance of a pixel from the next
    packet.reserve(picture.pixels.size() * rgb * sizeof(float));
    for (const Rgb& pixel : picture.pixels)
        for (int c = 0; c < rgb; ++c) packet.add(static_cast<float>(pixel[c]));
    return std::move(packet).finished();
}

}  // namespace neumann
