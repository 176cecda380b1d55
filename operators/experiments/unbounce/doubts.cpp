#include "operators/experiments/unbounce/doubts.h"

#include "operators/statistics/student_t.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace neumann {

namespace {

using Kind = Doubt::Kind;
constexpr const char* channel_names[] = {"red", "green", "blue"};

// The probability that any of a family of comparisons fails by chance.
constexpr double false_alarms = 0.001;
// Light below the first part of the largest is not mentioned; for links between regions, which become slightly negative
// for large regions, the second part counts.
constexpr double least_light = 0.01, least_link = 0.05;
constexpr double lost_in_noise = 0.5;
constexpr double least_direct = 0.02, unlit_pixels = 0.01;

struct Writer {
    const Unbounced& found;
    const std::vector<std::string>& names;
    std::vector<Doubt>& doubts;

    void add(Kind kind, std::string words) const { doubts.push_back({kind, std::move(words)}); }
    double limit_of(double comparisons) const {
        return student_t_quantile(1.0 - false_alarms / comparisons, found.degrees_of_freedom);
    }

    template <class Each>
    void each_channel(const Each& each) const {
        for (std::size_t c = 0; c < 3; ++c)
            if (!found.channels[c].lights.empty()) each(found.channels[c], channel_names[c]);
    }

    void singular() const {
        each_channel([&](const UnbouncedChannel& channel, const char* name) {
            const Conditioning& conditioning = channel.conditioning;
            if (conditioning.is_singular())
                add(Kind::singular,
                    fmt::format("{}: the smallest singular value {:.2g} is not above {} {:.2g}: pictures of several "
                                "lights cannot be told apart; regularised with {:.2g}",
                                name, conditioning.smallest, conditioning.noise > 0.0 ? "the noise" : "rounding",
                                conditioning.noise > 0.0 ? conditioning.noise : 1e-12 * conditioning.largest,
                                channel.regularisation));
        });
    }

    void noise() const {
        each_channel([&](const UnbouncedChannel& channel, const char* name) {
            for (Eigen::Index n = 0; n < channel.terms.value.cols(); ++n) {
                const double part = channel.terms.error.col(n).norm() / channel.terms.value.col(n).norm();
                if (!(part > lost_in_noise)) continue;
                add(Kind::noise,
                    fmt::format("{}: from bounce {} on, errors are {:.0f}% of the light and more", name, n + 1, 100.0 * part));
                return;
            }
        });
    }

    // The values that should not be negative but are, beyond errors and beyond the least that is worth mentioning.
    struct Worst {
        double value = 0.0, error = 0.0;
        Eigen::Index row = 0, column = 0;
        int count = 0;
    };
    static Worst negative_in(const Eigen::MatrixXd& values, const Eigen::MatrixXd& errors, double limit,
                             const Eigen::RowVectorXd& least) {
        Worst worst;
        for (Eigen::Index j = 0; j < values.cols(); ++j) {
            for (Eigen::Index i = 0; i < values.rows(); ++i) {
                if (!(values(i, j) < -std::max(least[j], limit * errors(i, j)))) continue;
                ++worst.count;
                if (values(i, j) < worst.value) worst = {values(i, j), errors(i, j), i, j, worst.count};
            }
        }
        return worst;
    }

    void negative() const {
        each_channel([&](const UnbouncedChannel& channel, const char* name) {
            const Worst term = negative_in(channel.terms.value, channel.terms.error,
                                           limit_of(3.0 * static_cast<double>(channel.terms.value.size())),
                                           least_light * channel.terms.value.cwiseAbs().colwise().maxCoeff());
            if (term.count > 0)
                add(Kind::negative,
                    fmt::format("{}: {} value{} of terms {} negative, as light cannot be; in bounce {} the region of {} has "
                                "{:.3g} ± {:.1g}: light that is not reflected diffusely, or lights that shine where "
                                "they are not expected",
                                name, term.count, term.count == 1 ? "" : "s", term.count == 1 ? "is" : "are", term.column + 1,
                                names[at(channel, term.row)], term.value, term.error));
            const Eigen::MatrixXd& A = channel.once_more.value;
            const Worst link = negative_in(A, channel.once_more.error, limit_of(3.0 * static_cast<double>(A.size())),
                                           Eigen::RowVectorXd::Constant(A.cols(), least_link * A.cwiseAbs().maxCoeff()));
            if (link.count > 0)
                add(Kind::negative,
                    fmt::format("{}: {} of {} links between regions are negative, the one from {} to {} by {:.3g} ± {:.1g}", name,
                                link.count, A.size(), names[at(channel, link.column)], names[at(channel, link.row)], link.value,
                                link.error));
        });
    }

    // A row of A sums to the region's reflectance times the share of its surroundings that is among the regions.
    void gain() const {
        each_channel([&](const UnbouncedChannel& channel, const char* name) {
            const Eigen::VectorXd sums = channel.given_on.value, errors = channel.given_on.error;
            const double limit = limit_of(3.0 * static_cast<double>(sums.size()));
            const auto gains = (sums.array() > 1.0 + least_light + limit * errors.array()).count();
            if (gains == 0) return;
            Eigen::Index most = 0;
            (sums - limit * errors).maxCoeff(&most);
            add(Kind::gain,
                fmt::format("{}: {} region{} back more light than all regions can bring; that of {} {:.3g} ± {:.1g} times as much",
                            name, gains, gains == 1 ? " gives" : "s give", names[at(channel, most)], sums[most], errors[most]));
        });
    }

    std::size_t at(const UnbouncedChannel& channel, Eigen::Index i) const {
        return static_cast<std::size_t>(channel.lights[static_cast<std::size_t>(i)]);
    }

    // Sums over channels of T, and their variances, which are 0 if they are not known.
    struct Grey {
        Eigen::MatrixXd value, variance;
        explicit Grey(const RegionMeans& means)
            : value(Eigen::MatrixXd::Zero(means.mean[0].rows(), means.mean[0].cols())), variance(value) {
            for (int c = 0; c < 3; ++c) {
                value += means.mean[c];
                if (means.variance[c].size() > 0) variance += 3.0 * means.variance[c];  // channels may be correlated
            }
        }
    };

    void lights() const {
        const Grey T(found.pictures);
        const Eigen::VectorXd sizes = found.regions.sizes(names.size());
        std::vector<std::string> idle;
        std::string foreign;
        int foreigners = 0;
        for (Eigen::Index j = 0; j < T.value.cols(); ++j) {
            if (sizes[j] == 0.0 || T.value(j, j) <= 0.0) {
                // A black light shines on nothing.
                if (T.value.col(j).sum() > 0.0) idle.push_back(names[static_cast<std::size_t>(j)]);
                continue;
            }
            Eigen::Index other = 0;
            const double most = T.value.row(j).maxCoeff(&other);
            const double error = std::sqrt(T.variance(j, j) + T.variance(j, other));
            if (other == j || !(most - T.value(j, j) > limit_of(static_cast<double>(names.size())) * error)) continue;
            if (foreigners++ == 0)
                foreign = fmt::format("the region of {} is {:.2g} times as bright under {}", names[static_cast<std::size_t>(j)],
                                      most / T.value(j, j), names[static_cast<std::size_t>(other)]);
        }
        if (!idle.empty())
            add(Kind::idle_light,
                fmt::format("{} of {} lights light nothing that is seen most of all, and are left out; the first is {}",
                            idle.size(), names.size(), idle.front()));
        if (foreigners > 0)
            add(Kind::foreign_light,
                fmt::format("{} region{} brighter under another light than under {} own: {}: mirrors, or regions that are "
                            "not the lights'",
                            foreigners, foreigners == 1 ? " is" : "s are", foreigners == 1 ? "its" : "their", foreign));
    }

    void shared_light() const {
        if (!found.direct) return;
        const Grey D(*found.direct);
        double most = 0.0;
        Eigen::Index light = 0, region = 0;
        for (Eigen::Index j = 0; j < D.value.cols(); ++j)
            for (Eigen::Index r = 0; r < D.value.rows(); ++r) {
                if (r == j || D.value(r, r) <= 0.0) continue;
                const double part = (D.value(r, j) - 4.5 * std::sqrt(D.variance(r, j))) / D.value(r, r);
                if (part > most) {
                    most = part;
                    light = j;
                    region = r;
                }
            }
        if (most > least_light)
            add(Kind::shared_light,
                fmt::format("{} shines directly on the region of {}, at least {:.2g} times as bright as {} itself",
                            names[static_cast<std::size_t>(light)], names[static_cast<std::size_t>(region)], most,
                            names[static_cast<std::size_t>(region)]));
    }

    // Finds pixels whose light is hardly direct: significantly less than 2% of it in bounce 1. Or less than half, if
    // that is less than 2% of the brightest pixel of the region: a pixel that no light shines on is assigned to the
    // light whose region illuminates it most.
    void unlit() const {
        const PixelEstimate& first = found.terms.front();
        double seen = 0.0, dark = 0.0;
        for (std::size_t p = 0; p < first.mean.pixels.size(); ++p) {
            const double light = mean_component(found.picture.pixels[p]);
            if (light <= 0.0) continue;
            seen += 1.0;
            const double error = found.knows_errors ? mean_component(first.standard_error.pixels[p]) : 0.0;
            const double direct = mean_component(first.mean.pixels[p]) + 3.0 * error;
            dark += direct < least_direct * light;
        }
        if (dark > unlit_pixels * seen)
            add(Kind::unlit, fmt::format("{:.1f}% of what is seen gets no direct light of its own: lights that do not cover what "
                                         "is seen, or mirrors and glass",
                                         100.0 * dark / seen));
    }

    // Names the bounce that changes most relative to its size.
    void unseen(const std::vector<TermAgreement>& forward) const {
        double most = least_light;
        std::optional<std::size_t> worst;
        for (std::size_t n = 0; n < forward.size(); ++n) {
            const auto& change = forward[n].by_way_of_unseen;
            if (!change || !(forward[n].forward.mean > 0.0)) continue;
            const double error =
                student_t_quantile(1.0 - false_alarms / static_cast<double>(forward.size()), change->degrees_of_freedom) *
                change->standard_error;
            const double part = (std::abs(change->mean) - error) / forward[n].forward.mean;
            if (!(part > most)) continue;
            most = part;
            worst = n;
        }
        if (!worst) return;
        const TermAgreement& term = forward[*worst];
        add(Kind::unseen,
            fmt::format(
                "light comes by way of surfaces that are not seen, and counts as fewer bounces: by that alone, known from the "
                "scene, bounce {} is {:+.2g}% off the forward term",
                *worst + 1, 100.0 * term.by_way_of_unseen->mean / term.forward.mean));
    }

    void differs(const std::vector<TermAgreement>& forward) const {
        for (std::size_t n = 0; n < forward.size(); ++n) {
            const double z = forward[n].deviations();
            if (!(std::abs(z) > student_t_quantile(1.0 - false_alarms / static_cast<double>(forward.size()),
                                                   std::max(1.0, forward[n].difference.degrees_of_freedom))))
                continue;
            add(Kind::differs,
                fmt::format(
                    "bounce {} is {:+.2g}% off the forward term, {:.1f} times its errors: light by way of what is not seen, or "
                    "not reflected diffusely, or lights that do not cover what is seen",
                    n + 1, 100.0 * forward[n].difference.mean / forward[n].forward.mean, std::abs(z)));
            return;
        }
    }
};

}  // namespace

const char* name_of(Kind kind) {
    constexpr const char* names[] = {"singular",      "noise",        "negative", "gain",   "idle light",
                                     "foreign light", "shared light", "unlit",    "unseen", "differs"};
    return names[static_cast<std::size_t>(kind)];
}

std::vector<Doubt> doubts_about(const Unbounced& found, const std::vector<std::string>& names,
                                const std::vector<TermAgreement>& forward) {
    std::vector<Doubt> doubts;
    const Writer writer{found, names, doubts};
    writer.lights();
    writer.singular();
    writer.noise();
    writer.negative();
    writer.gain();
    writer.shared_light();
    writer.unlit();
    writer.unseen(forward);
    writer.differs(forward);
    return doubts;
}

}  // namespace neumann
