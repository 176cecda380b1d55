#include "operators/render/report/pixel_history.h"

#include "core/image/display.h"
#include "operators/render/from_paths/pixel_average.h"
#include "operators/statistics/student_t.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <numeric>
#include <optional>

namespace neumann {

namespace {

struct NoOne : PathObserver {
    bool watches(std::uint32_t) const override { return false; }
    void step(std::uint32_t, const PathStep&) override {}
};

struct OfReplicate {
    std::vector<Rgb> samples, mean;
};
OfReplicate retrace(const PictureSampler& sampler, std::uint32_t pixel, std::uint64_t replicate) {
    const std::size_t Q = sampler.quantities(), size = sampler.layout().size(pixel);
    const PlaceInGroup place = sampler.layout().place({pixel, replicate * size});
    NoOne no_one;
    const std::vector<Rgb> group = sampler.path_sampler().retrace(place.replicate, place.first, no_one);
    const auto begin = group.begin() + static_cast<std::ptrdiff_t>(place.path * Q);
    std::vector<Rgb> samples(begin, begin + static_cast<std::ptrdiff_t>(size * Q)), averaged = samples;
    PixelAverage work(Q);
    std::vector<SampleRange> ranges(Q);
    Tally tally(Q);
    average(averaged, size, pixel, replicate, sampler.settings().colors, work, ranges, tally);
    return {std::move(samples), std::move(work.mean)};
}

PixelHistory::Point point(const SeriesMoments& moments, std::uint64_t samples) {
    const SeriesMoments::Result result = moments.result();
    PixelHistory::Point point{samples, student_t_quantile(0.95, result.degrees_of_freedom()), {}, {}};
    const auto mean = [](const Estimate& e) { return PixelHistory::Mean{e.mean.pixels[0], e.standard_error.pixels[0]}; };
    for (std::size_t q = 0; q < result.quantities(); ++q) {
        point.terms.push_back(mean(result.term(q)));
        point.sums.push_back(mean(result.sum(q)));
    }
    return point;
}

}  // namespace

double PixelHistory::part(std::size_t sample) const {
    const auto brings = [&](std::size_t i) {
        double total = 0.0;
        for (std::size_t q = 0; q < terms; ++q) total += luminance(samples[i * terms + q]);
        return total;
    };
    double all = 0.0;
    for (std::size_t i = 0; i < count(); ++i) all += brings(i);
    return all > 0.0 ? brings(sample) / all : 0.0;
}

std::vector<std::size_t> PixelHistory::largest(std::size_t most) const {
    std::vector<double> brings(count(), 0.0);
    for (std::size_t i = 0; i < samples.size(); ++i) brings[i / terms] += luminance(samples[i]);
    std::vector<std::size_t> order(count());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) { return brings[a] > brings[b]; });
    order.resize(std::min(most, order.size()));
    return order;
}

PixelHistory history_of_pixel(std::span<const ReplicatesOf> replicates, std::uint32_t pixel) {
    PixelHistory history;
    std::optional<SeriesMoments> earlier;  // the moments of the earlier seeds
    std::uint64_t n = 0, samples = 0, all = 0;
    for (const ReplicatesOf& of : replicates) all += of.count;
    for (const auto& [sampler, first, count] : replicates) {
        const std::size_t Q = sampler.quantities();
        history.terms = sampler.settings().pictures();
        std::vector<OfReplicate> found(count);
        oneapi::tbb::parallel_for(std::uint64_t{0}, count, [&](std::uint64_t r) { found[r] = retrace(sampler, pixel, first + r); });
        SeriesMoments moments(1, 1, Q, history.terms);
        for (std::uint64_t r = 0; r < count; ++r) {
            MomentsNode node{first + r, 1, std::vector<double>(Q * PixelMoments::doubles_per_quantity)};
            PixelMoments::set(node.data, found[r].mean);
            moments.add(std::move(node));
            for (std::size_t i = 0; i < found[r].samples.size(); ++i)
                if (i % Q < history.terms) history.samples.push_back(found[r].samples[i]);
            samples += found[r].samples.size() / Q;
            if (++n; !std::has_single_bit(n) && n != all) continue;
            SeriesMoments together = earlier ? *earlier : moments;
            if (earlier) together.unite(moments);
            history.points.push_back(point(together, samples));
        }
        if (earlier)
            earlier->unite(moments);
        else
            earlier = std::move(moments);
    }
    return history;
}

}  // namespace neumann
