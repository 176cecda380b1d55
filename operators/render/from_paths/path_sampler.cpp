#include "operators/render/from_paths/path_sampler.h"

#include <stdexcept>

namespace neumann {

namespace {

class GroupsOfPixels : public PathsToInspect {
public:
    GroupsOfPixels(const PathSampler& sampler, const SampleLayout& layout) : sampler_(sampler), layout_(layout) {}
    std::uint32_t groups() const override { return layout_.groups(); }
    Group group(std::uint32_t number) const override {
        const PixelGroup pixels = layout_.group(number);
        return {layout_.first_path(pixels.begin), pixels.paths()};
    }
    void retrace(std::uint64_t replicate, const Group& group, PathObserver& observer) const override {
        (void)sampler_.retrace(replicate, group.first, observer);
    }

private:
    const PathSampler& sampler_;
    const SampleLayout& layout_;
};

}  // namespace

std::optional<std::uint64_t> PathSampler::own_samples(std::uint64_t, const OwnSamples&, const Watch&) const {
    throw std::logic_error("PathSampler: no pixel has samples of its own");
}
std::uint32_t PathSampler::of_read(std::uint32_t) const { throw std::logic_error("PathSampler: its paths read nothing"); }
void PathSampler::retrace_read(std::uint64_t, std::uint32_t, PathObserver&) const {
    throw std::logic_error("PathSampler: its paths read nothing");
}
std::unique_ptr<const PathsToInspect> PathSampler::to_inspect() const {
    return std::make_unique<const GroupsOfPixels>(*this, layout_);
}
PathSampler::OfPart PathSampler::part_of(const SampleName&) const { throw std::logic_error("PathSampler: it has no parts"); }
double PathSampler::scale(std::size_t, std::size_t, std::uint32_t) const { throw std::logic_error("PathSampler: it has no parts"); }
double PathSampler::scale(std::size_t, std::size_t, const Vec2&) const { throw std::logic_error("PathSampler: it has no parts"); }

}  // namespace neumann
