// All that shines, in parts that can be drawn: the primitives of shapes, then the lights that no surface gives off.
#pragma once

#include "core/emitter/emitters.h"
#include "core/geometry/rectangle.h"

#include <algorithm>
#include <span>
#include <vector>

namespace neumann {

class LightTable {
public:
    // A primitive, or two triangles that are a rectangle, from `primitive` on.
    struct Part {
        static constexpr std::uint32_t no_rectangle = 0xffffffffu;
        std::uint32_t shape, primitive, rectangle = no_rectangle;
        bool is_rectangle() const { return rectangle != no_rectangle; }
    };
    // A light's parts.
    struct Range {
        std::size_t first, end;
    };
    // What is drawn. `left`: uniform in [0, 1), for the place on it.
    struct Choice {
        std::size_t index;
        double probability, left;
    };

    enum class Rectangles { as_triangles, whole };

    // `share`: the probability of each of Emitters::powers(). None can be drawn where all are 0. Refers to the geometry.
    LightTable(const Geometry& geometry, const Emitters& emitters, const std::vector<double>& share, Rectangles rectangles);

    bool empty() const { return cumulative_.empty(); }
    std::size_t size() const { return cumulative_.size(); }
    // The part of a surface, or which of the distant lights it is.
    std::span<const Part> parts() const { return parts_; }
    bool is_distant(std::size_t index) const { return index >= parts_.size(); }
    std::size_t distant(std::size_t index) const { return index - parts_.size(); }
    // Lights of a share above 0.
    std::span<const Range> lights() const { return lights_; }
    double probability(std::size_t index) const { return cumulative_[index] - (index == 0 ? 0.0 : cumulative_[index - 1]); }

    // Of a surface that shines.
    Part part_at(const SurfacePoint& y) const;
    double area(const Part& part) const;
    const Rectangle& rectangle(const Part& part) const { return rectangles_[part.rectangle]; }

    Choice choose(double u) const { return choose(u, 0, cumulative_.size()); }
    // One part of a light, in proportion; the probability is that of all.
    Choice choose_of(const Range& light, double u) const {
        const double low = light.first == 0 ? 0.0 : cumulative_[light.first - 1], high = cumulative_[light.end - 1];
        return choose(low + u * (high - low), light.first, light.end);
    }

private:
    Choice choose(double u, std::size_t first, std::size_t end) const {
        const auto begin = cumulative_.begin();
        const auto found =
            std::upper_bound(begin + static_cast<std::ptrdiff_t>(first), begin + static_cast<std::ptrdiff_t>(end) - 1, u);
        const double below = found == begin ? 0.0 : found[-1], share = *found - below;
        return {static_cast<std::size_t>(found - begin), share, std::clamp((u - below) / share, 0.0, 0x1.fffffffffffffp-1)};
    }

    const Geometry* geometry_;
    std::vector<Part> parts_;
    std::vector<Range> lights_;
    std::vector<double> cumulative_;  // of the probabilities of parts_, then of the distant lights of Emitters
    std::vector<Rectangle> rectangles_;
    std::vector<std::vector<Part>> rectangular_;  // by shape and primitive, of shapes with rectangles
};

}  // namespace neumann
