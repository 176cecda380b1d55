// The ways (s, t) that the paths of Bidirectional make.
#pragma once

#include "core/material/bsdf_sample.h"

#include <cstdint>
#include <limits>
#include <span>

namespace neumann {

struct AllWays {
    static constexpr bool all = true;
    static constexpr bool makes(std::uint32_t /*path*/, int /*s*/, int /*t*/) { return true; }
    static constexpr int light_vertices(std::uint32_t /*path*/) { return std::numeric_limits<int>::max(); }
    static constexpr int camera_vertices(std::uint32_t /*path*/) { return std::numeric_limits<int>::max(); }
    static constexpr bool goes_on(double /*pdf*/) { return true; }
};

// Source shooting: the camera's subpath goes on in mirrors and glass alone, and the light's is joined to where it ends.
struct WaysToTheReceiver {
    static constexpr bool all = false;
    static constexpr bool makes(std::uint32_t /*path*/, int /*s*/, int t) { return t > 1; }
    static constexpr int light_vertices(std::uint32_t /*path*/) { return std::numeric_limits<int>::max(); }
    static constexpr int camera_vertices(std::uint32_t /*path*/) { return std::numeric_limits<int>::max(); }
    static constexpr bool goes_on(double pdf) { return pdf == delta_pdf; }
};

// One way to make this bounce: path i has s[i] vertices from the light. Subpaths are traced as far as the way needs.
struct OneWay {
    static constexpr bool all = false;
    int bounce = 1;
    std::span<const int> s;

    bool makes(std::uint32_t path, int s_, int t) const { return s[path] == s_ && camera_vertices(path) == t; }
    int light_vertices(std::uint32_t path) const { return s[path]; }
    int camera_vertices(std::uint32_t path) const { return bounce + 2 - s[path]; }
    static constexpr bool goes_on(double /*pdf*/) { return true; }
};

}  // namespace neumann
