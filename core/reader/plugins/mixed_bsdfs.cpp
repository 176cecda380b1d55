// <bsdf> that wrap others: `mask` and `blendbsdf`. Each side is made of the same side of the nested ones.
#include "core/reader/plugins/bsdfs.h"
#include "core/reader/plugins/textures.h"

#include <fmt/format.h>

namespace neumann::reader {

namespace {

// A weight or opacity, which must be in [0, 1] everywhere.
SurfaceFunction read_share(Properties& p, const std::string& name, const Context& context) {
    const SurfaceFunction share = read_number_texture(p, name, 0.5, context);
    const double largest = share.upper_bound().r;
    if (!(largest >= 0.0 && largest <= 1.0))
        p.complain(name, fmt::format("{} of {} is {}, expected from 0 to 1", name, p.title(), largest));
    return share;
}

}  // namespace

std::shared_ptr<const Bsdf> Bsdfs::shared(int index) const {
    return index == Materials::absorbing ? nullptr : std::make_shared<const Bsdf>(bsdfs_[static_cast<std::size_t>(index)]);
}

Materials::Sides Bsdfs::read_mask(const Element& e) {
    Properties p(e, context_.objects);
    const SurfaceFunction opacity = read_share(p, "opacity", context_);
    const std::vector<const Element*> nested = p.nested("bsdf");
    p.finish();
    if (nested.empty()) p.fail_empty("bsdf 'mask' has no <bsdf> inside, expected one");
    const Materials::Sides inner = sides(*nested.front());
    const auto masked = [&](int index) { return store(Mask(shared(index), opacity)); };
    const int front = masked(inner.front);
    return {front, masked(inner.back)};
}

Materials::Sides Bsdfs::read_blend(const Element& e) {
    Properties p(e, context_.objects);
    const SurfaceFunction weight = read_share(p, "weight", context_);
    const std::vector<const Element*> nested = p.nested("bsdf", 2);
    p.finish();
    if (nested.size() != 2)
        p.fail_empty(fmt::format("bsdf 'blendbsdf' has {} <bsdf> inside, expected two", nested.empty() ? "no" : "one"));
    const Materials::Sides first = sides(*nested[0]), second = sides(*nested[1]);
    const auto blended = [&](int a, int b) {
        if (a == Materials::absorbing && b == Materials::absorbing) return Materials::absorbing;
        return store(Blend(shared(a), shared(b), weight));
    };
    const int front = blended(first.front, second.front);
    return {front, blended(first.back, second.back)};
}

}  // namespace neumann::reader
