// The ways (s, t) that the paths of Bidirectional make.
#pragma once

#include <cstdint>
#include <limits>
#include <span>

namespace neumann {

struct AllWays {
    static constexpr bool all = true;
    static constexpr bool makes(std::uint32_t /*path*/, int /*s*/, int /*t*/) { return true; }
    static constexpr int light_vertices(std::uint32_t /*path*/) { return std::numeric_limits<int>::max(); }
    static constexpr int camera_vertices(std::uint32_t /*path*/) { return std::numeric_limits<int>::max(); }
};

// One way to make this bounce: path i has s[i] vertices from the light. Subpaths are traced as far as the way needs.
struct OneWay {
    static constexpr bool all = false;
    int bounce = 1;
    std::span<const int> s;

    bool makes(std::uint32_t path, int s_, int t) const { return s[path] == s_ && camera_vertices(path) == t; }
    int light_vertices(std::uint32_t path) const { return s[path]; }
    int camera_vertices(std::uint32_t path) const { return bounce + 2 - s[path]; }
};

}  // namespace neumann
