// Which bounce of another renderer is wrong, and what is wrong with it: its pictures against our own terms.
#pragma once

#include "core/scene/scene.h"
#include "operators/experiments/blame/difference_test.h"
#include "operators/experiments/blame/expected_pictures.h"
#include "operators/experiments/blame/other_pictures.h"
#include "operators/experiments/blame/suspects.h"
#include "operators/experiments/blame/worst_places.h"
#include "operators/watch.h"

#include <optional>
#include <string>
#include <vector>

namespace neumann {

struct BlameSettings {
    std::optional<Counting> counting = {};  // as the other renderer counts; chosen by the data if it is not given
    double seconds = 20.0;                  // for our own terms; what the mistakes make of the scene takes as long again, at most
    std::optional<std::uint64_t> samples = {};  // a pixel, in place of the seconds
    std::uint64_t seed = 0;
};

struct TermVerdict {
    // Why it cannot be told. Right renderers, too, make pictures that look as if something were wrong.
    enum class Doubt {
        few_samples,     // of ours: what is seen may be our noise, or no mistake is clearly likelier than none
        shared_numbers,  // theirs differ over wide areas by more than their own noise, and no mistake explains it
        seeds_differ     // and so do their pictures of two seeds
    };

    BounceRange bounces;
    DifferenceTest test;
    double threshold = 0.0;  // the pictures are further apart than chance explains where test.p is below
    bool differs = false;
    std::optional<Doubt> doubt;  // if the pictures are further apart than chance explains and it does not differ all the same
    PictureNoise theirs, ours;
    Estimate difference;            // theirs less ours
    Image z;                        // the same in standard errors of the pixel
    std::vector<WorstPlace> worst;  // if it differs
};

struct ShapeShare {
    std::uint32_t shape = 0;  // or SurfacePoint::infinity
    double share = 0.0;       // of the squared difference in the first wrong term
    double ratio = 1.0;       // theirs to ours on it
};

struct Blame {
    enum class Verdict { right, wrong, unclear };

    Counting counting = Counting::mitsuba;
    std::optional<Counting> told;    // where the data say something else
    bool knows_their_noise = false;  // from a second picture or a variance; otherwise it is ours times a number
    std::vector<TermVerdict> terms;
    std::optional<std::size_t> first_wrong;  // among the terms
    std::vector<Suspect> suspects;
    std::vector<ShapeShare> shapes;  // of the first wrong term, largest share first
    std::uint64_t samples = 0;       // of ours, a pixel
    std::vector<std::string> sentences;

    const TermVerdict* first_doubtful() const;
    Verdict verdict() const { return first_wrong ? Verdict::wrong : first_doubtful() ? Verdict::unclear : Verdict::right; }
};

const char* name_of(Blame::Verdict verdict);

// The chance that the pictures of a right renderer are further apart from ours than they should be, over all terms together.
constexpr double false_alarms = 0.005;

// `pictures`: of one size, which becomes that of the scene's film. Throws InputError as terms_of() does, if a value is
// not finite, and if the film has another shape; Stopped.
Blame blame(const Scene& scene, std::vector<DepthPicture> pictures, const BlameSettings& settings, const Watch& watch = {});
// The same for pictures of the size of the scene's film.
Blame blame(ExpectedPictures& expected, const std::vector<DepthPicture>& pictures, std::optional<Counting> counting = {});

}  // namespace neumann
