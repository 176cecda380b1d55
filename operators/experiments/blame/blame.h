// Finds the bounce of another renderer that is wrong, and the mistake, by comparing its pictures with our own terms.
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
    std::optional<Counting> counting = {};      // how the other renderer counts; chosen by the data if it is not given
    double seconds = 20.0;                      // for our own terms; those of mistakes take at most as long again
    std::optional<std::uint64_t> samples = {};  // a pixel, in place of the seconds
    std::uint64_t seed = 0;
};

struct TermVerdict {
    // Why a term cannot be judged. Right renderers, too, make pictures that look as if something were wrong.
    enum class Doubt {
        few_samples,  // our samples: the difference may be our noise, or no mistake is clearly likelier than none
        // Their pictures differ over wide areas by more than their own noise, and no mistake explains it.
        shared_numbers,
        seeds_differ,  // likewise, and so do their pictures of two seeds
        seeds_agree    // likewise, and their pictures of two seeds do not, but have little noise that tells pixels apart
    };

    BounceRange bounces;
    DifferenceTest test;
    double threshold = 0.0;  // if test.p is below, the pictures are further apart than chance explains
    bool differs = false;
    std::optional<Doubt> doubt;  // set if the pictures are further apart than chance explains but `differs` is false
    PictureNoise theirs, ours;
    Estimate difference;            // theirs less ours
    Image z;                        // the difference in standard errors of the pixel
    std::vector<WorstPlace> worst;  // empty unless it differs
};

struct ShapeShare {
    std::uint32_t shape = 0;  // or SurfacePoint::infinity
    double share = 0.0;       // of the squared difference in the first wrong term
    double ratio = 1.0;       // their light to ours on this shape
};

struct Blame {
    enum class Verdict { right, wrong, unclear };

    Counting counting = Counting::mitsuba;
    std::optional<Counting> counting_by_the_data;  // set if the data say something else
    // Whether it is from a second picture or a variance; otherwise it is taken as ours times a number.
    bool knows_their_noise = false;
    std::vector<TermVerdict> terms;
    std::optional<std::size_t> first_wrong;  // index into `terms`
    std::vector<Suspect> suspects;
    std::vector<ShapeShare> shapes;  // for the first wrong term, largest share first
    std::uint64_t samples = 0;       // our samples of a pixel
    std::vector<std::string> sentences;

    const TermVerdict* first_doubtful() const;
    Verdict verdict() const { return first_wrong ? Verdict::wrong : first_doubtful() ? Verdict::unclear : Verdict::right; }
};

const char* name_of(Blame::Verdict verdict);

// The probability that a right renderer's pictures seem further apart from ours than chance explains, over all terms.
constexpr double false_alarms = 0.005;

// Judges `pictures`, which have one size; the scene's film gets that size. Throws InputError as terms_of() does, if a
// value is not finite, and if the film has another shape; Stopped.
Blame blame(const Scene& scene, std::vector<DepthPicture> pictures, const BlameSettings& settings, const Watch& watch = {});
// The same for pictures of the size of the scene's film.
Blame blame(ExpectedPictures& expected, const std::vector<DepthPicture>& pictures, std::optional<Counting> counting = {});

}  // namespace neumann
