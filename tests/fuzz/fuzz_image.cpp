// A picture in any format that OpenImageIO knows. What cannot be read is a RunError or an InputError.
#include "core/image/image_io.h"
#include "tests/fuzz/fuzz_mesh.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    neumann::fuzz::write_input(data, size);
    try {
        neumann::read_exr(neumann::fuzz::path());
    } catch (const neumann::InputError&) {
    } catch (const neumann::RunError&) {
    }
    return 0;
}
