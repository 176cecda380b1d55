// One primitive of a scene: a triangle of a mesh, or a whole sphere, disc or cylinder.
#pragma once

#include <compare>
#include <cstdint>

namespace neumann {

struct Face {
    std::uint32_t shape, primitive;
    friend auto operator<=>(const Face&, const Face&) = default;
};

}  // namespace neumann
