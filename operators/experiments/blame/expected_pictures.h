// The pictures with which others are compared: our own terms, and those that mistakes make of the scene. Each is
// rendered when it is first needed, so that the pictures of several renderers share them.
#pragma once

#include "core/scene/scene.h"
#include "operators/experiments/blame/path_mistakes.h"
#include "operators/experiments/blame/technique_mistakes.h"
#include "operators/render/methods/bounce_series.h"
#include "operators/watch.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace neumann {

class ExpectedPictures {
public:
    using Ranges = std::vector<BounceRange>;

    // Our own terms have `samples` a pixel, or as many as take `seconds`. Our samples are independent of each other, as
    // those of most renderers are: their variance is then ours, times a number.
    ExpectedPictures(Scene scene, std::optional<std::uint64_t> samples, double seconds, std::uint64_t seed, Watch watch = {});

    const Scene& scene() const { return scene_; }
    // Bounces 0 … `bounces` at least. All functions throw Stopped.
    std::shared_ptr<const BounceSeries> ours(int bounces);
    std::shared_ptr<const std::vector<WrongTerms>> wrong(const WrongPaths& wanted);
    int paths_a_pixel(int factor) const;  // samples of a pixel of the film in wrong()
    // Their pixels are joined by `factor`.
    std::shared_ptr<const std::vector<WrongPictures>> without_techniques(const Ranges& ranges, int factor);

    // Keeps all pictures of mistakes for other renderers. By default only those needed last are kept, as they are large.
    void keep_all() { keeps_all_ = true; }

private:
    template <class T>
    struct Made {
        WrongPaths of;
        std::shared_ptr<const T> pictures;
    };
    template <class T, class Make>
    std::shared_ptr<const T> find_or_make(std::vector<Made<T>>& all, const WrongPaths& wanted, const Make& make);

    Scene scene_;
    std::optional<std::uint64_t> samples_;
    double seconds_;
    std::uint64_t seed_;
    Watch watch_;
    bool keeps_all_ = false;
    std::shared_ptr<const BounceSeries> ours_;
    std::vector<Made<std::vector<WrongTerms>>> wrong_;
    std::vector<Made<std::vector<WrongPictures>>> without_techniques_;
};

}  // namespace neumann
