// All that shines, in parts that can be drawn: the primitives of shapes, then the lights that no surface gives off.
#pragma once

#include "core/emitter/emitters.h"

#include <algorithm>
#include <span>
#include <vector>

namespace neumann {

class LightTable {
public:
    struct Part {
        std::uint32_t shape, primitive;
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

    // `share`: the probability of each of Emitters::powers(). None can be drawn where all are 0.
    LightTable(const Geometry& geometry, const Emitters& emitters, const std::vector<double>& share);

    bool empty() const { return cumulative_.empty(); }
    std::size_t size() const { return cumulative_.size(); }
    // The part of a surface, or which of the distant lights it is.
    std::span<const Part> parts() const { return parts_; }
    bool is_distant(std::size_t index) const { return index >= parts_.size(); }
    std::size_t distant(std::size_t index) const { return index - parts_.size(); }
    // Lights of a share above 0.
    std::span<const Range> lights() const { return lights_; }
    double probability(std::size_t index) const { return cumulative_[index] - (index == 0 ? 0.0 : cumulative_[index - 1]); }

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

    std::vector<Part> parts_;
    std::vector<Range> lights_;
    std::vector<double> cumulative_;  // of the probabilities of parts_, then of the distant lights of Emitters
};

}  // namespace neumann
