// The random numbers of a subpath as the state of a Markov chain (primary sample space: Kelemen, Szirmay-Kalos, Antal and Csonka, A
// Simple and Robust Mutation Strategy for the Metropolis Light Transport Algorithm, 2002). A path that is traced draws them one by
// one, as from a sampler, and so proposes the next state.
#pragma once

#include "core/sampling/sampler.h"

#include <cmath>
#include <vector>

namespace neumann {

class PrimaryNumbers {
public:
    enum class Step {
        start,  // the sampler's numbers as they are
        small,  // each number of the state moved a little
        large   // new numbers
    };

    // Lets the next path draw its numbers by this step; `source` must live until the path is traced.
    void propose(Step step, Sampler& source) {
        step_ = step;
        source_ = &source;
        proposed_.clear();
    }
    double next() { return keep(source_->next()); }
    Vec2 next2() {
        const Vec2 u = step_ == Step::start ? source_->next2() : Vec2(source_->next(), source_->next());
        const double x = keep(u.x);
        return {x, keep(u.y)};
    }
    void accept() { state_.swap(proposed_); }

    // Kelemen's symmetric step: its length is between 1/1024 and 1/64, with a density like 1/length, and it goes across
    // the ends of [0, 1) as on a torus.
    static double moved(double x, double u) {
        constexpr double smallest = 1.0 / 1024.0, largest = 1.0 / 64.0;
        const double v = std::abs(2.0 * u - 1.0), step = largest * std::exp(std::log(smallest / largest) * v);
        const double y = u < 0.5 ? x + step : x - step;
        return y - std::floor(y);
    }

private:
    double keep(double u) {
        const std::size_t i = proposed_.size();
        const double x = step_ == Step::small && i < state_.size() ? moved(state_[i], u) : u;
        proposed_.push_back(x);
        return x;
    }

    Step step_ = Step::start;
    Sampler* source_ = nullptr;
    std::vector<double> state_, proposed_;
};

}  // namespace neumann
