// A picture in any format that OpenImageIO knows. What cannot be read is a RunError or an InputError.
#include "core/image/image_io.h"
#include "tests/fuzz/fuzz_mesh.h"

template <class Read>
void try_picture(const Read& read) {
    try {
        read(neumann::fuzz::path());
    } catch (const neumann::InputError&) {
    } catch (const neumann::RunError&) {
    }
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    neumann::fuzz::write_input(data, size);
    try_picture([](const std::string& path) { neumann::read_exr(path); });
    try_picture([](const std::string& path) {
        const neumann::Texels texels = neumann::read_texels(path);
        if (texels.bytes.size() + texels.values.size() != texels.index(0, texels.height)) std::abort();
    });
    try_picture([](const std::string& path) {
        for (const std::string& layer : neumann::layers_in(path)) neumann::read_layer(path, layer);
    });
    return 0;
}
