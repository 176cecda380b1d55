#include "operators/blame/blame.h"

#include "operators/blame/path_mistakes.h"
#include "operators/blame/picture_mistakes.h"
#include "operators/blame/sentences.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace neumann {

namespace {

// A picture mistake is an alarm of its own, beside the tests of blocks, if it is so much likelier than none: moved edges fill few
// pixels. In 100 seeds of a right renderer none was.
constexpr double strong_evidence = 40.0;
constexpr std::size_t places_a_term = 3;
constexpr std::uint64_t most_replayed = 64;  // samples of a pixel, from which a path is chosen

void expect_finite(const DepthPicture& picture) {
    const Image& mean = picture.mean;
    for (int y = 0; y < mean.height; ++y)
        for (int x = 0; x < mean.width; ++x)
            if (!is_finite(mean.at(x, y)))
                throw InputError(fmt::format("picture {}: the pixel in column {} and row {} is not finite", picture.depth, x, y));
}

void check(const std::vector<DepthPicture>& pictures, std::optional<Counting> counting) {
    if (pictures.empty()) throw InputError("there are no pictures to compare with");
    for (const DepthPicture& picture : pictures) expect_finite(picture);
    terms_of(pictures, counting.value_or(Counting::pbrt));  // sizes and numbers
}

Scene on_their_film(const Scene& scene, const Image& picture) {
    Film film = scene.film;
    if (film.crop_width == picture.width && film.crop_height == picture.height) return scene;
    const bool is_cropped = film.crop_width != film.width || film.crop_height != film.height;
    if (is_cropped || std::int64_t{film.width} * picture.height != std::int64_t{film.height} * picture.width)
        throw InputError(fmt::format("the pictures have {}×{} pixels, and the scene's film has {}×{}, which is another shape",
                                     picture.width, picture.height, film.crop_width, film.crop_height));
    film.width = film.crop_width = picture.width;
    film.height = film.crop_height = picture.height;
    return scene.with(film);
}

PictureNoise noise_of(const PixelEstimate& picture) {
    Image variance = picture.standard_error;
    for (Rgb& c : variance.pixels) c *= c;
    return {picture.mean, std::move(variance)};
}

PictureNoise sum_of(const BounceSeries& ours, const BounceRange& bounces) {
    PictureNoise sum = noise_of(ours.term(static_cast<std::size_t>(bounces.first)));
    for (int i = bounces.first + 1; i <= bounces.last; ++i) {
        const PictureNoise next = noise_of(ours.term(static_cast<std::size_t>(i)));
        for (std::size_t p = 0; p < sum.mean.pixels.size(); ++p) {
            sum.mean.pixels[p] += next.mean.pixels[p];
            sum.variance.pixels[p] += next.variance.pixels[p];
        }
    }
    return sum;
}

// What samples that agree leave open all the same (PixelEstimate::least_error), squared.
Image left_open(const BounceSeries& ours, const BounceRange& bounces) {
    Image sum;
    for (int i = bounces.first; i <= bounces.last; ++i) {
        const PixelEstimate term = ours.term(static_cast<std::size_t>(i));
        if (sum.pixels.empty()) sum = Image(term.mean.width, term.mean.height);
        for (std::size_t p = 0; p < term.least_error.pixels.size(); ++p)
            sum.pixels[p] += term.least_error.pixels[p] * term.least_error.pixels[p];
    }
    return sum;
}

// Not below what few samples leave open in each pixel; `times`: as many times ours.
Image believed_one_by_one(Image variance, const ComparedTerm& term, double times) {
    for (std::size_t p = 0; p < variance.pixels.size(); ++p)
        variance.pixels[p] = glm::max(variance.pixels[p], term.left_open.pixels[p] * times);
    return variance;
}

Image in_errors(const Estimate& difference) {
    Image z(difference.mean.width, difference.mean.height);
    for (std::size_t p = 0; p < z.pixels.size(); ++p)
        for (int c = 0; c < 3; ++c)
            if (const double d = difference.mean.pixels[p][c]; d != 0.0)
                z.pixels[p][c] = d / difference.standard_error.pixels[p][c];
    return z;
}

std::vector<std::uint32_t> shapes_seen(const Scene& scene) {
    std::vector<std::uint32_t> shapes;
    for (int y = 0; y < scene.film.crop_height; ++y)
        for (int x = 0; x < scene.film.crop_width; ++x) {
            const CameraRay ray = scene.camera.ray({scene.film.crop_x + x + 0.5, scene.film.crop_y + y + 0.5});
            SurfacePoint hit;
            const bool met = scene.geometry.first_hit(ray.origin, ray.direction, ray.length, hit);
            shapes.push_back(met ? hit.shape : SurfacePoint::infinity);
        }
    return shapes;
}

class Judge {
public:
    Judge(ExpectedPictures& expected, std::optional<Counting> counting)
        : expected_(expected), scene_(expected.scene()), counting_(counting) {}

    Blame judge(const std::vector<DepthPicture>& pictures) {
        int most = 0;
        for (const DepthPicture& p : pictures) most = std::max(most, p.depth + 1);
        const std::shared_ptr<const BounceSeries> rendered = expected_.ours(most);
        const BounceSeries& ours = *rendered;
        result_.samples = ours.samples;
        choose_counting(pictures, ours);
        judge_noise(pictures, ours);
        compare(terms_of(pictures, result_.counting), ours);
        find_first_wrong();
        if (result_.first_wrong) {
            find_suspects();
            find_shapes();
            find_places(ours);
        }
        result_.sentences = sentences_about(result_, scene_);
        return std::move(result_);
    }

private:
    void choose_counting(const std::vector<DepthPicture>& pictures, const BounceSeries& ours) {
        if (counting_ == Counting::bounces) {
            result_.counting = Counting::bounces;
            return;
        }
        std::vector<double> sums;
        for (int i = 0; i <= ours.bounces(); ++i) sums.push_back(mean_of(ours.sum(static_cast<std::size_t>(i)).mean));
        const Counting likely = likely_counting(pictures, sums);
        result_.counting = counting_.value_or(likely);
        constexpr double close = 0.02, clearly = 4.0;
        const double misfit = misfit_of_means(pictures, likely, sums);
        if (misfit < close && misfit_of_means(pictures, result_.counting, sums) > clearly * misfit + close) result_.told = likely;
    }

    // The number by which ours is multiplied, from the picture that has least; what is wrong only adds to it.
    void judge_noise(const std::vector<DepthPicture>& pictures, const BounceSeries& ours) {
        for (const DepthPicture& p : pictures) {
            if (p.variance) continue;
            const int last = last_bounce(result_.counting, p.depth);
            if (last < 0) continue;
            const auto i = static_cast<std::size_t>(last);
            const PictureNoise known = noise_of(are_sums() ? ours.sum(i) : ours.term(i));
            times_ = std::min(times_, times_the_variance(p.mean, known));
        }
        if (!std::isfinite(times_)) times_ = 1.0;
    }

    Image likely_variance(const BounceRange& bounces, const BounceSeries& ours) const {
        const auto last = static_cast<std::size_t>(bounces.last);
        Image variance = noise_of(are_sums() ? ours.sum(last) : ours.term(last)).variance;
        if (are_sums() && bounces.first > 0) {
            const Image before = noise_of(ours.sum(static_cast<std::size_t>(bounces.first - 1))).variance;
            for (std::size_t p = 0; p < variance.pixels.size(); ++p) variance.pixels[p] += before.pixels[p];
        }
        for (Rgb& c : variance.pixels) c *= times_;
        return variance;
    }

    void compare(std::vector<OtherTerm> theirs, const BounceSeries& ours) {
        result_.knows_their_noise =
            std::all_of(theirs.begin(), theirs.end(), [](const OtherTerm& t) { return t.variance.has_value(); });
        for (OtherTerm& t : theirs) {
            ComparedTerm c{t.bounces, {std::move(t.mean), {}}, sum_of(ours, t.bounces), left_open(ours, t.bounces), {}, {}};
            c.theirs.variance = t.variance ? std::move(*t.variance) : likely_variance(t.bounces, ours);
            c.our_sum = ours.sum(static_cast<std::size_t>(t.bounces.last)).mean;
            c.our_sum_before = Image(c.our_sum.width, c.our_sum.height);
            if (t.bounces.first > 0) c.our_sum_before = ours.sum(static_cast<std::size_t>(t.bounces.first - 1)).mean;
            compared_.push_back(std::move(c));
        }
    }

    void find_first_wrong() {
        std::vector<BounceRange> direct;
        for (const ComparedTerm& c : compared_)
            if (c.bounces.last <= 1) direct.push_back(c.bounces);
        const auto made = direct.empty() ? nullptr : expected_.wrong(direct);
        const std::vector<WrongTerms> none;
        const std::vector<WrongTerms>& wrong = made ? *made : none;
        for (std::size_t i = 0; i < compared_.size(); ++i) {
            const ComparedTerm& c = compared_[i];
            TermVerdict v;
            v.bounces = c.bounces;
            v.test = test_difference(c.theirs, c.ours);
            v.threshold = false_alarms / static_cast<double>(compared_.size());
            v.differs = v.test.p < v.threshold || (!result_.first_wrong && is_clearly_something_else(i, wrong));
            v.theirs = c.theirs;
            v.ours = c.ours;
            v.difference = difference_of({c.theirs.mean, believed_one_by_one(c.theirs.variance, c, times_)},
                                         {c.ours.mean, believed_one_by_one(c.ours.variance, c, 1.0)});
            v.z = in_errors(v.difference);
            if (v.differs && !result_.first_wrong) result_.first_wrong = i;
            result_.terms.push_back(std::move(v));
        }
    }

    // Whether a mistake is clearly likelier than none: differences of few pixels do not show in blocks. Beyond bounce 1 fireflies
    // that are missing by chance look like mistakes of paths, and beyond bounce 0 blurring takes noise away, which looks like one,
    // too.
    bool is_clearly_something_else(std::size_t i, const std::vector<WrongTerms>& wrong) const {
        const ComparedTerm& c = compared_[i];
        if (c.bounces.last > 1) return false;
        const PictureNoise theirs{c.theirs.mean, believed_one_by_one(c.theirs.variance, c, times_)};
        // Lamps fill parts of blocks, whose spread then hides a factor.
        if (c.bounces.first == 0 && evidence_for(theirs, scaled(c.ours, fitted_factor(theirs, c.ours)), c.ours) > strong_evidence)
            return true;
        if (c.bounces.first == 0)
            for (const WrongPictures& moved : moved_pictures({c}, are_sums()))
                if (evidence_for(theirs, moved.terms[0], c.ours) > strong_evidence) return true;
        const auto none = std::ranges::find(wrong, Mistake::none, &WrongTerms::mistake);  // of the same paths
        return std::any_of(wrong.begin(), wrong.end(), [&](const WrongTerms& w) {
            return w.mistake != Mistake::clamped && evidence_for(theirs, w.terms[i], none->terms[i]) > strong_evidence &&
                   evidence_for(theirs, w.terms[i], c.ours) > strong_evidence;
        });
    }

    // The first wrong term and the one after it are explained together.
    void find_suspects() {
        const std::size_t first = *result_.first_wrong, count = std::min<std::size_t>(2, compared_.size() - first);
        const std::vector<ComparedTerm> terms(compared_.begin() + static_cast<std::ptrdiff_t>(first),
                                              compared_.begin() + static_cast<std::ptrdiff_t>(first + count));
        const auto n = static_cast<double>(terms.front().ours.mean.pixels.size() * 3 * count);
        const auto add = [&](const std::string& name, const std::string& words, const std::vector<PictureNoise>& wrong,
                             int parameters, bool is_fitted, bool is_smoothed = false) {
            double sum = parameters * std::log(n);
            for (std::size_t i = 0; i < count; ++i)
                sum += misfit(terms[i].theirs, wrong[i], is_smoothed ? terms[i].ours.variance : wrong[i].variance);
            result_.suspects.push_back({name, words, sum, is_fitted, test_difference(terms[0].theirs, wrong[0])});
        };
        for (const WrongPictures& w : wrong_pictures(terms, are_sums(), shapes_seen(scene_)))
            add(w.name, w.words, w.terms, w.parameters, w.parameters > 0, w.is_smoothed);
        std::vector<BounceRange> ranges;
        for (const ComparedTerm& t : terms) ranges.push_back(t.bounces);
        for (const WrongTerms& w : *expected_.wrong(ranges)) {
            if (w.mistake == Mistake::none) continue;
            add(name_of(w.mistake), describe(w.mistake), w.terms, 0, false);
            if (w.mistake != Mistake::no_inverse_square) continue;
            // Without 1/d² light has no unit, and may have any scale.
            const double factor = fitted_factor(terms[0].theirs, w.terms[0]);
            std::vector<PictureNoise> rescaled;
            for (const PictureNoise& p : w.terms) rescaled.push_back(scaled(p, factor));
            add(name_of(w.mistake), describe(w.mistake), rescaled, 1, false);
        }
        for (const WrongPictures& w : *expected_.without_techniques(ranges)) add(w.name, w.words, w.terms, 0, false);
        std::stable_sort(result_.suspects.begin(), result_.suspects.end(),
                         [](const Suspect& a, const Suspect& b) { return a.misfit < b.misfit; });
        put_causes_first();
        // Of each kind the likeliest.
        std::set<std::string> seen;
        std::erase_if(result_.suspects, [&](const Suspect& s) { return !seen.insert(s.name).second; });
    }

    // A cause that leaves nothing unexplained comes before factors and offsets that were fitted and say no why.
    void put_causes_first() {
        constexpr double unexplained = 1e-3, most_of_it = 0.9;
        const ComparedTerm& c = compared_[*result_.first_wrong];
        const double best = result_.suspects.front().misfit;
        double right = misfit(c.theirs, c.ours);
        if (*result_.first_wrong + 1 < compared_.size()) {
            const ComparedTerm& next = compared_[*result_.first_wrong + 1];
            right += misfit(next.theirs, next.ours);
        }
        std::stable_partition(result_.suspects.begin(), result_.suspects.end(), [&](const Suspect& s) {
            return !s.is_fitted && s.left.p > unexplained && right - s.misfit > most_of_it * (right - best);
        });
    }

    bool are_sums() const { return result_.counting != Counting::bounces; }

    void find_shapes() {
        const TermVerdict& v = result_.terms[*result_.first_wrong];
        const std::vector<std::uint32_t> shapes = shapes_seen(scene_);
        struct Sums {
            double squares = 0.0, theirs = 0.0, ours = 0.0;
        };
        std::map<std::uint32_t, Sums> by_shape;
        double all = 0.0;
        for (std::size_t p = 0; p < shapes.size(); ++p) {
            Sums& sums = by_shape[shapes[p]];
            const double square = glm::dot(v.difference.mean.pixels[p], v.difference.mean.pixels[p]);
            sums.squares += square;
            sums.theirs += mean_component(v.theirs.mean.pixels[p]);
            sums.ours += mean_component(v.ours.mean.pixels[p]);
            all += square;
        }
        for (const auto& [shape, sums] : by_shape)
            result_.shapes.push_back(
                {shape, all > 0.0 ? sums.squares / all : 0.0, sums.ours > 0.0 ? sums.theirs / sums.ours : 1.0});
        std::sort(result_.shapes.begin(), result_.shapes.end(), [](const auto& a, const auto& b) { return a.share > b.share; });
    }

    void find_places(const BounceSeries& ours) {
        const auto& record = std::get<PathRecord>(ours.record);
        const RecordedSamples samples(
            scene_, {ours.method, ours.seed, ours.bounces(), record.rest_probability.value_or(0.0), record.replicate_size});
        for (TermVerdict& v : result_.terms) {
            if (!v.differs) continue;
            v.worst = worst_places(v.theirs, v.ours, places_a_term);
            for (WorstPlace& place : v.worst) {
                const auto pixel = static_cast<std::uint32_t>(place.pixel_y * v.z.width + place.pixel_x);
                place.path = brightest_path(scene_, samples, pixel, std::min(ours.samples, most_replayed), v.bounces);
            }
        }
    }

    ExpectedPictures& expected_;
    const Scene& scene_;
    const std::optional<Counting> counting_;
    double times_ = std::numeric_limits<double>::infinity();  // their variance, in units of ours
    std::vector<ComparedTerm> compared_;
    Blame result_;
};

}  // namespace

Blame blame(const Scene& scene, std::vector<DepthPicture> pictures, const BlameSettings& settings, const Watch& watch) {
    check(pictures, settings.counting);
    ExpectedPictures expected(on_their_film(scene, pictures.front().mean), settings.samples, settings.seconds, settings.seed,
                              watch);
    return Judge(expected, settings.counting).judge(pictures);
}

Blame blame(ExpectedPictures& expected, const std::vector<DepthPicture>& pictures, std::optional<Counting> counting) {
    check(pictures, counting);
    const Film& film = expected.scene().film;
    if (const Image& mean = pictures.front().mean; mean.width != film.crop_width || mean.height != film.crop_height)
        throw InputError(fmt::format("the pictures have {}×{} pixels, expected the film's {}×{}", mean.width, mean.height,
                                     film.crop_width, film.crop_height));
    return Judge(expected, counting).judge(pictures);
}

}  // namespace neumann
