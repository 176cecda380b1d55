#include "core/image/colour/srgb_bytes.h"

#include "core/image/colour/spectrum_to_rgb.h"

namespace neumann {

const std::array<double, 256>& decoded_srgb_bytes() {
    static const std::array<double, 256> all = [] {
        std::array<double, 256> table{};
        for (std::size_t i = 0; i < table.size(); ++i) table[i] = srgb_decode(static_cast<double>(i) / 255.0);
        return table;
    }();
    return all;
}

}  // namespace neumann
