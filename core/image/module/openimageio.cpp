// Reads pictures for core/image/image_io.h. This module is the only code that knows OpenImageIO, and is loaded when a
// picture is first read.
#include "core/image/picture_codec.h"

#include "core/base/error.h"
#include "core/base/memory.h"
#include "core/image/picture_format.h"

// {fmt} comes before OpenImageIO, which makes {fmt} part of whatever includes it after: calls of {fmt} by others would
// then end here, and bring OpenImageIO into programs that have no use for it.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <OpenImageIO/strutil.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <numeric>
#include <sstream>

namespace neumann {
namespace {

constexpr std::array<const char*, 3> mean_channels = {"R", "G", "B"};
constexpr std::array<const char*, 3> error_channels = {"stderr.R", "stderr.G", "stderr.B"};
constexpr std::array<const char*, 3> spread_channels = {"spread.R", "spread.G", "spread.B"};
constexpr std::array<const char*, 3> discretisation_channels = {"discretisation.R", "discretisation.G", "discretisation.B"};

void get_attributes(const OIIO::ImageSpec& spec, Attributes& attributes) {
    for (const auto& entry : spec.extra_attribs) {
        const std::string name = entry.name().string();
        const OIIO::TypeDesc type = entry.type();
        if (type == OIIO::TypeDesc::STRING) {
            attributes[name] = entry.get_string();
        } else if (type == OIIO::TypeDesc::DOUBLE) {
            attributes[name] = *static_cast<const double*>(entry.data());
        } else if (type == OIIO::TypeDesc::FLOAT) {
            attributes[name] = static_cast<double>(entry.get_float());
        } else if (type == OIIO::TypeDesc::INT) {
            attributes[name] = static_cast<std::int64_t>(entry.get_int());
        }
    }
}

// The places of the three channels in the file, or nothing unless all are there.
std::optional<std::array<std::size_t, 3>> find_channels(const OIIO::ImageSpec& spec, const std::array<const char*, 3>& names) {
    std::array<std::size_t, 3> places{};
    for (std::size_t c = 0; c < 3; ++c) {
        const int place = spec.channelindex(names[c]);
        if (place < 0) return std::nullopt;
        places[c] = static_cast<std::size_t>(place);
    }
    return places;
}

Image pick_channels(const OIIO::ImageSpec& spec, const std::vector<float>& values, const std::array<std::size_t, 3>& places) {
    Image picture(spec.width, spec.height);
    const auto channels = static_cast<std::size_t>(spec.nchannels);
    for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
        const float* pixel = &values[i * channels];
        picture.pixels[i] = Rgb(pixel[places[0]], pixel[places[1]], pixel[places[2]]);
    }
    return picture;
}

// Reads all channels. Some of OpenImageIO's readers throw exceptions for damaged files.
void read_pixels(OIIO::ImageInput& input, const std::string& path, OIIO::TypeDesc type, void* values) {
    std::string error;
    try {
        if (input.read_image(input.current_subimage(), 0, 0, input.spec().nchannels, type, values)) return;
        error = input.geterror();
    } catch (const std::exception& e) {
        error = e.what();
    }
    throw InputError(fmt::format("{}: the picture is damaged: {}", path, error));
}

// Reads some channels of each pixel.
template <class T>
std::vector<T> read_channels(OIIO::ImageInput& input, const std::string& path, OIIO::TypeDesc type,
                             const std::vector<std::size_t>& places) {
    const OIIO::ImageSpec& spec = input.spec();
    const auto width = static_cast<std::size_t>(spec.width), channels = static_cast<std::size_t>(spec.nchannels);
    std::vector<T> all(spec.image_pixels() * channels);
    read_pixels(input, path, type, all.data());
    std::size_t next = 0;
    for (std::size_t i = 0; i < all.size() / channels; ++i)
        for (const std::size_t place : places) {
            const T value = all[i * channels + place];
            if constexpr (std::is_floating_point_v<T>)
                if (!std::isfinite(value))
                    throw InputError(
                        fmt::format("{}: the pixel in column {} and row {} is not finite", path, i % width, i / width));
            all[next++] = value;
        }
    all.resize(next);
    all.shrink_to_fit();
    return all;
}

Texels read_channels(OIIO::ImageInput& input, const std::string& path, const std::vector<std::size_t>& places) {
    const OIIO::ImageSpec& spec = input.spec();
    Texels texels;
    texels.width = spec.width;
    texels.height = spec.height;
    texels.channels = static_cast<int>(places.size());
    texels.is_encoded = !spec.format.is_floating_point();
    if (spec.format == OIIO::TypeDesc::UINT8)
        texels.bytes = read_channels<std::uint8_t>(input, path, OIIO::TypeDesc::UINT8, places);
    else
        texels.values = read_channels<float>(input, path, OIIO::TypeDesc::FLOAT, places);
    return texels;
}

// Damaged headers give sizes that no memory holds. The formats that pack plain surfaces best (OpenEXR's DWAB: 256 rows
// in some hundred bytes) stay below 1 : 65,536.
void expect_possible_size(const OIIO::ImageSpec& spec, std::uint64_t file_bytes, const std::string& name) {
    const double bytes = static_cast<double>(spec.image_pixels()) * spec.nchannels * sizeof(float);
    if (spec.depth != 1 || bytes > 65536.0 * static_cast<double>(file_bytes) || bytes > 0.5 * physical_memory())
        throw InputError(fmt::format("{}: the picture is damaged or too large: its header says {}×{} pixels of {} channels", name,
                                     spec.width, spec.height, spec.nchannels));
}

// Opens a picture without multiplying alpha into the colours. `memory` stands in place of the file of this name; it
// must outlive the result.
std::unique_ptr<OIIO::ImageInput> open_picture(const std::string& name, std::istream& file, std::uint64_t file_bytes,
                                               OIIO::Filesystem::IOProxy* memory) {
    OIIO::ImageSpec as_they_are, found;
    as_they_are.attribute("oiio:UnassociatedAlpha", 1);
    constexpr int largest_picture_mb = 2048;
    [[maybe_unused]] static const bool limited = OIIO::attribute("limits:imagesize_MB", largest_picture_mb);
    const std::string format = find_picture_format(file, name);
    expect_parts_within_file(file, name, format);
    std::unique_ptr<OIIO::ImageInput> input;
    bool opened = false;
    try {
        if (!format.empty()) input = OIIO::ImageInput::create(format);
        if (input && memory && !input->set_ioproxy(memory)) input.reset();
        opened = input && input->open(name, found, as_they_are);
    } catch (const std::exception&) {  // some readers throw these for damaged files
    }
    if (!opened) {
        OIIO::geterror();
        throw InputError(name +
                         ": not a picture that can be read, expected OpenEXR, PNG, JPEG, TIFF, Radiance HDR, PNM, PFM, BMP or TGA");
    }
    expect_possible_size(input->spec(), file_bytes, name);
    return input;
}

std::unique_ptr<OIIO::ImageInput> open_picture(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    std::error_code ignored;
    return open_picture(path, file, std::filesystem::file_size(path, ignored), nullptr);
}

// Three channels of a part of the file, or its only one.
struct Layer {
    std::string name;
    int part;
    std::vector<std::size_t> places;
};

// Red, green or blue by the end of a channel's name, 0 to 2: "R" of "diffuse.R", "red".
std::optional<std::size_t> component_of(std::string_view end) {
    static constexpr std::array<std::array<std::string_view, 2>, 3> names = {{{"r", "red"}, {"g", "green"}, {"b", "blue"}}};
    const std::string lower = OIIO::Strutil::lower(OIIO::string_view(end.data(), end.size()));
    for (std::size_t c = 0; c < names.size(); ++c)
        if (lower == names[c][0] || lower == names[c][1]) return c;
    return std::nullopt;
}

// The layers of a part, in the order of the file. `part_name` is the name of one part among several.
std::vector<Layer> layers_of_part(const OIIO::ImageSpec& spec, int part, const std::string& part_name) {
    constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
    std::vector<Layer> layers;
    for (std::size_t i = 0; i < spec.channelnames.size(); ++i) {
        const std::string& channel = spec.channelnames[i];
        const std::size_t dot = channel.rfind('.'), begin = dot == std::string::npos ? 0 : dot + 1;
        const auto component = component_of(std::string_view(channel).substr(begin));
        if (!component) continue;
        std::string name = channel.substr(0, begin == 0 ? 0 : dot);
        if (!name.starts_with(part_name)) name = name.empty() ? part_name : part_name + "." + name;
        auto layer = std::ranges::find(layers, name, &Layer::name);
        if (layer == layers.end()) layer = layers.insert(layers.end(), {name, part, std::vector(3, none)});
        layer->places[*component] = i;
    }
    std::erase_if(layers, [&](const Layer& l) { return std::ranges::count(l.places, none) > 0; });
    if (layers.empty() && spec.nchannels == 1) layers.push_back({part_name, part, {0}});
    return layers;
}

// Goes to the part of this number; returns false if there is none.
bool go_to(OIIO::ImageInput& input, int part, const std::string& path) {
    try {
        return input.seek_subimage(part, 0);
    } catch (const std::exception& e) {
        throw InputError(fmt::format("{}: the picture is damaged: {}", path, e.what()));
    }
}

// The layers of all parts. The part of a file with a single one has no name of its own.
std::vector<Layer> find_layers(OIIO::ImageInput& input, const std::string& path) {
    const bool has_parts = go_to(input, 1, path);
    std::vector<Layer> layers;
    std::string channels;
    for (int part = 0; go_to(input, part, path); ++part) {
        const OIIO::ImageSpec& spec = input.spec();
        const std::string name = has_parts ? std::string(spec.get_string_attribute("oiio:subimagename")) : "";
        for (Layer& layer : layers_of_part(spec, part, name)) layers.push_back(std::move(layer));
        for (const std::string& channel : spec.channelnames) channels += (channels.empty() ? "" : ", ") + channel;
    }
    if (layers.empty()) throw InputError(fmt::format("{}: no channels R, G, B; it has {}", path, channels));
    return layers;
}

std::vector<float> read_values(OIIO::ImageInput& input, const std::string& path) {
    const OIIO::ImageSpec& spec = input.spec();
    std::vector<float> values(spec.image_pixels() * static_cast<std::size_t>(spec.nchannels));
    read_pixels(input, path, OIIO::TypeDesc::FLOAT, values.data());
    return values;
}

}  // namespace

namespace openimageio {

PixelEstimate read_exr(const std::string& path, Attributes* attributes) {
    const auto input = open_picture(path);
    const OIIO::ImageSpec spec = input->spec();
    const auto mean_places = find_channels(spec, mean_channels);
    if (!mean_places) {
        throw InputError(fmt::format("{}: no channels R, G, B; it has {}", path, fmt::join(spec.channelnames, ", ")));
    }
    const std::vector<float> values = read_values(*input, path);
    if (attributes != nullptr) get_attributes(spec, *attributes);
    PixelEstimate picture;
    picture.mean = pick_channels(spec, values, *mean_places);
    if (const auto places = find_channels(spec, error_channels)) picture.standard_error = pick_channels(spec, values, *places);
    if (const auto places = find_channels(spec, spread_channels)) {
        picture.least_error = std::move(picture.standard_error);
        picture.standard_error = pick_channels(spec, values, *places);
    }
    if (const auto places = find_channels(spec, discretisation_channels))
        picture.discretisation = pick_channels(spec, values, *places);
    return picture;
}

Texels read_texels(const std::string& path) {
    const auto input = open_picture(path);
    const OIIO::ImageSpec& spec = input->spec();
    std::vector<std::size_t> places{0};
    if (const auto named = find_channels(spec, mean_channels))
        places.assign(named->begin(), named->end());
    else if (spec.nchannels >= 3)
        places = {0, 1, 2};
    return read_channels(*input, path, places);
}

std::vector<std::string> layers_in(const std::string& path) {
    const auto input = open_picture(path);
    std::vector<std::string> names;
    for (const Layer& layer : find_layers(*input, path)) names.push_back(layer.name);
    return names;
}

Texels read_layer(const std::string& path, const std::string& name) {
    const auto input = open_picture(path);
    const std::vector<Layer> layers = find_layers(*input, path);
    const auto layer = std::ranges::find(layers, name, &Layer::name);
    if (layer == layers.end()) throw InputError(fmt::format("{}: no layer {}", path, name));
    go_to(*input, layer->part, path);
    std::error_code ignored;
    expect_possible_size(input->spec(), std::filesystem::file_size(path, ignored), path);
    return read_channels(*input, path, layer->places);
}

Texels decode_texels(std::string_view bytes, const std::string& name) {
    OIIO::Filesystem::IOMemReader memory(const_cast<char*>(bytes.data()), bytes.size());  // IOMemReader only reads
    std::istringstream file{std::string(bytes)};
    const auto input = open_picture(name, file, bytes.size(), &memory);
    std::vector<std::size_t> places(static_cast<std::size_t>(std::min(input->spec().nchannels, 4)));
    std::iota(places.begin(), places.end(), std::size_t{0});
    return read_channels(*input, name, places);
}

}  // namespace openimageio
}  // namespace neumann

extern "C" const neumann::PictureReader* neumann_picture_reader() {
    using namespace neumann::openimageio;
    static const neumann::PictureReader reader{read_exr, read_texels, decode_texels, layers_in, read_layer};
    return &reader;
}
