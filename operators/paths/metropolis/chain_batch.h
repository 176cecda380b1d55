// Chains of one bounce that advance together: Metropolis and Hastings' walk among the states (s, u) of bidirectional
// paths, in proportion to f (independent_paths.h). A step moves all numbers a little and keeps the way, or draws way
// and numbers anew; both are symmetric, so it is accepted with probability a = min(1, f'/f). Both states contribute
// their expectation: the proposed one has the weight a, and the old one 1 − a (Veach 1997, 11.4).
#pragma once

#include "operators/paths/metropolis/chain_starts.h"
#include "operators/paths/metropolis/chain_statistics.h"
#include "operators/paths/metropolis/independent_paths.h"
#include "operators/paths/metropolis/primary_numbers.h"

#include <span>
#include <vector>

namespace neumann {

// The contribution of a state from which a chain goes on, or which it rejected.
struct LeftState {
    std::uint32_t chain = 0;  // number of the chain in the batch
    std::uint32_t step = 0;   // step in which the state was proposed; 0 is the start
    Rgb value{0.0};           // w C / f times the share of all steps: the mean of values · b over the chain's steps is the term
    Vec2 position;            // on the film
};

class ChainBatch {
public:
    static constexpr double large_steps = 0.3;  // part of the steps that are large

    ChainBatch(const Scene& scene, const Bidirectional& bidirectional, const FilmArea& area, int bounce)
        : scene_(&scene), bidirectional_(&bidirectional), area_(&area), bounce_(bounce) {}

    // Starts chains at states of these independent paths, which are traced again. `random` has random numbers for each chain.
    template <class Observer = NoObserver>
    void start(const IndependentPaths& paths, std::uint64_t replicate, std::span<const ChainStart> starts,
               std::vector<Sampler> random, std::span<std::uint64_t> counts, const Observer& observer = {});
    // Makes step t, counted from 1, of all chains; calls left(LeftState) for states that are left or rejected.
    template <class OnLeft, class Observer = NoObserver>
    void step(std::uint32_t t, const OnLeft& left, std::span<std::uint64_t> counts, const Observer& observer = {});
    // Calls left(LeftState) for the last states, and adds the statistics of all chains.
    template <class OnLeft>
    void end(const OnLeft& left, ChainStatistics& statistics);

    // The state of a chain: f, the position on the film, and the way; whether the last step was accepted, and whether
    // it was a large one.
    double size(std::uint32_t chain) const { return states_[chain].size; }
    const Vec2& position(std::uint32_t chain) const { return states_[chain].position; }
    int way(std::uint32_t chain) const { return states_[chain].s; }
    bool is_new(std::uint32_t chain) const { return stay_[chain] == 1; }
    bool by_large(std::uint32_t chain) const { return is_large_[chain] != 0; }
    // The chains whose last proposal has a contribution that is not a finite number; the proposal counts as one without light.
    std::span<const std::uint32_t> non_finite() const { return non_finite_; }

private:
    struct State {
        int s = -1;
        Rgb value{0.0};
        Vec2 position;
        double size = 0.0, weight = 0.0;
        std::uint32_t step = 0;
    };
    // Traces the paths of proposed_, whose ways are set.
    template <class Observer>
    void trace(std::span<std::uint64_t> counts, const Observer& observer);
    void trace(std::span<std::uint64_t> counts, const NoObserver&);
    template <class OnLeft>
    void leave(std::uint32_t chain, const State& state, const OnLeft& left) const {
        if (state.weight > 0.0 && state.size > 0.0)
            left(LeftState{chain, state.step, state.value * (state.weight / state.size), state.position});
    }

    const Scene* scene_;
    const Bidirectional* bidirectional_;
    const FilmArea* area_;
    int bounce_;
    std::uint64_t replicate_ = 0;
    std::vector<Sampler> random_, start_camera_, start_light_;
    std::vector<PrimaryNumbers> camera_, light_;
    std::vector<State> states_, proposed_;
    std::vector<double> choice_;
    std::vector<char> is_large_;
    std::vector<std::uint32_t> stay_, non_finite_;
    std::vector<ChainDiary> diaries_;
    ChainStatistics counted_;

    std::vector<int> s_;
    std::vector<CameraRay> rays_;
    std::vector<Vec2> positions_;
    BidirectionalWork work_;
};

template <class Observer>
void ChainBatch::trace(std::span<std::uint64_t> counts, const Observer& observer) {
    rays_.clear();
    positions_.clear();
    s_.clear();
    non_finite_.clear();
    for (std::size_t i = 0; i < proposed_.size(); ++i) {
        positions_.push_back(area_->at(camera_[i].next2()));
        rays_.push_back(scene_->camera.sample_ray(positions_[i], camera_[i]));
        s_.push_back(proposed_[i].s);
    }
    const auto set = [&](std::uint32_t i, const Vec2& position, const WayContribution& f, double measure) {
        const Rgb value = f.value * (f.weight * measure);
        const double size = size_of(value);
        if (!std::isfinite(size)) non_finite_.push_back(i);
        if (!(size > 0.0) || !std::isfinite(size)) return;
        proposed_[i].value = value;
        proposed_[i].size = size;
        proposed_[i].position = position;
    };
    bidirectional_->trace(
        std::span<const CameraRay>(rays_), std::span(camera_), std::span(light_), work_,
        [&](std::uint32_t i, const WayContribution& f) {
            set(i, positions_[i], f, area_->pixels() * scene_->camera.response(positions_[i]));
        },
        [&](std::uint32_t i, const Vec2& position, const WayContribution& f) {
            if (area_->holds(position)) set(i, position, f, 1.0);
        },
        counts, observer, OneWay{bounce_, s_});
}

template <class Observer>
void ChainBatch::start(const IndependentPaths& paths, std::uint64_t replicate, std::span<const ChainStart> starts,
                       std::vector<Sampler> random, std::span<std::uint64_t> counts, const Observer& observer) {
    const std::size_t n = starts.size();
    replicate_ = replicate;
    random_ = std::move(random);
    start_camera_.assign(n, paths.camera_numbers());
    start_light_.assign(n, paths.light_numbers());
    camera_.resize(n);
    light_.resize(n);
    proposed_.assign(n, {});
    stay_.assign(n, 1);
    choice_.resize(n);
    is_large_.resize(n);
    diaries_.assign(n, {});
    counted_ = {};
    for (std::size_t i = 0; i < n; ++i) {
        start_camera_[i].start(paths.number(replicate, starts[i].path));
        start_light_[i].start(paths.number(replicate, starts[i].path));
        camera_[i].propose(PrimaryNumbers::Step::start, start_camera_[i]);
        light_[i].propose(PrimaryNumbers::Step::start, start_light_[i]);
        proposed_[i].s = starts[i].s;
    }
    trace(counts, observer);
    states_ = proposed_;
    for (std::size_t i = 0; i < n; ++i) {
        states_[i].weight = 1.0;
        camera_[i].accept();
        light_[i].accept();
        diaries_[i].add_state(area_->place_of(states_[i].position));
    }
}

template <class OnLeft, class Observer>
void ChainBatch::step(std::uint32_t t, const OnLeft& left, std::span<std::uint64_t> counts, const Observer& observer) {
    const std::size_t n = states_.size();
    for (std::size_t i = 0; i < n; ++i) {
        Sampler& random = random_[i];
        random.start(replicate_ << 32 | t);
        is_large_[i] = random.next() < large_steps;
        choice_[i] = random.next();
        const double way = random.next();
        proposed_[i] = {};
        proposed_[i].s = is_large_[i] ? static_cast<int>(way * (bounce_ + 2)) : states_[i].s;
        proposed_[i].step = t;
        const auto kind = is_large_[i] ? PrimaryNumbers::Step::large : PrimaryNumbers::Step::small;
        camera_[i].propose(kind, random);
        light_[i].propose(kind, random);
    }
    trace(counts, observer);
    for (std::uint32_t i = 0; i < n; ++i) {
        State &old = states_[i], &next = proposed_[i];
        const double a = old.size > 0.0 ? std::min(1.0, next.size / old.size) : 1.0;
        next.weight = a;
        old.weight += 1.0 - a;
        const bool accepted = choice_[i] < a;
        ++(is_large_[i] ? counted_.large : counted_.small);
        if (accepted) {
            ++(is_large_[i] ? counted_.large_accepted : counted_.small_accepted);
            std::swap(old, next);
            camera_[i].accept();
            light_[i].accept();
            counted_.largest_stay = std::max<std::uint64_t>(counted_.largest_stay, stay_[i]);
            stay_[i] = 0;
        }
        ++stay_[i];
        leave(i, next, left);
        diaries_[i].add_state(area_->place_of(old.position));
    }
}

template <class OnLeft>
void ChainBatch::end(const OnLeft& left, ChainStatistics& statistics) {
    for (std::uint32_t i = 0; i < states_.size(); ++i) {
        leave(i, states_[i], left);
        counted_.largest_stay = std::max<std::uint64_t>(counted_.largest_stay, stay_[i]);
        diaries_[i].add_to(counted_);
    }
    statistics.merge(counted_);
}

}  // namespace neumann
