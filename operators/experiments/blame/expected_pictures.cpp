#include "operators/experiments/blame/expected_pictures.h"

#include "operators/experiments/blame/joined_pixels.h"
#include "operators/render/methods/render.h"

#include <algorithm>
#include <utility>

namespace neumann {

namespace {

// The most paths for the pictures of mistakes; each takes some ten microseconds.
constexpr double most_paths = 4e6;

}  // namespace

ExpectedPictures::ExpectedPictures(Scene scene, std::optional<std::uint64_t> samples, double seconds, std::uint64_t seed,
                                   Watch watch)
    : scene_(std::move(scene)), samples_(samples), seconds_(seconds), seed_(seed), watch_(std::move(watch)) {}

std::shared_ptr<const BounceSeries> ExpectedPictures::ours(int bounces) {
    if (ours_ && ours_->bounces() >= bounces) return ours_;
    Goal goal;
    goal.bounces = bounces;
    goal.seed = seed_;
    goal.only_pictures = true;
    if (samples_)
        goal.samples = *samples_;
    else
        goal.seconds = seconds_;
    method::Walk walk;
    walk.sampler = SamplerKind::independent;
    ours_ = std::make_shared<const BounceSeries>(render(scene_, walk, goal, watch_));
    if (ours_->outcome == Outcome::interrupted) throw Stopped();
    return ours_;
}

int ExpectedPictures::paths_a_pixel(int factor) const {
    const double pixels = static_cast<double>(scene_.film.crop_width) * scene_.film.crop_height;
    const double fewest = std::max(16.0 / (factor * factor), 1.0);
    return static_cast<int>(
        std::clamp(most_paths / pixels, fewest, static_cast<double>(std::max<std::uint64_t>(ours_ ? ours_->samples : 0, 16))));
}

template <class T, class Make>
std::shared_ptr<const T> ExpectedPictures::find_or_make(std::vector<Made<T>>& all, const WrongPaths& wanted, const Make& make) {
    const auto known = std::ranges::find(all, wanted, &Made<T>::of);
    if (known != all.end()) return known->pictures;
    if (!keeps_all_) all.clear();
    all.push_back({wanted, std::make_shared<const T>(make())});
    return all.back().pictures;
}

std::shared_ptr<const std::vector<WrongTerms>> ExpectedPictures::wrong(const WrongPaths& wanted) {
    return find_or_make(wrong_, wanted,
                        [&] { return wrong_terms(scene_, wanted, paths_a_pixel(wanted.factor), seed_ + 1, watch_); });
}

std::shared_ptr<const std::vector<WrongPictures>> ExpectedPictures::without_techniques(const Ranges& ranges, int factor) {
    // A bidirectional path takes several times as long.
    const auto samples = static_cast<std::uint64_t>(std::max(paths_a_pixel(factor) / 4, 1));
    return find_or_make(without_techniques_, {.ranges = ranges, .factor = factor}, [&] {
        std::vector<WrongPictures> all = neumann::without_techniques(scene_, ranges, samples, seed_ + 2, watch_);
        for (WrongPictures& wrong : all)
            for (PictureNoise& picture : wrong.terms) picture = joined(picture, factor);
        return all;
    });
}

}  // namespace neumann
