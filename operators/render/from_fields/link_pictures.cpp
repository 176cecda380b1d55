#include "operators/render/from_fields/link_pictures.h"

#include "operators/fields/matrix/link_light.h"
#include "operators/paths/light/film_splats.h"

#include <algorithm>
#include <vector>

namespace neumann {

namespace {

constexpr std::uint64_t link_stream = 0x73706c617473ull, lens_stream = 0x6c656e73ull;
// The approximate number of paths that the raster takes.
constexpr double most_ends = 2e6;

struct PartOfLinks {
    struct Contribution {
        std::size_t place;
        Rgb value;
    };
    std::vector<Contribution> shares;
    std::vector<LinkRaster::End> ends;
    std::uint64_t rays = 0;

    void pack(PackedNumbers& to) const {
        to.numbers(shares);
        to.numbers(ends);
        to.number(rays);
    }
    static PartOfLinks unpacked(UnpackedNumbers& from) {
        return {from.numbers<Contribution>(), from.numbers<LinkRaster::End>(), from.number<std::uint64_t>()};
    }
};

// Whether light that ends on this side is read from fields.
bool is_diffuse(const SurfaceSide& side) { return side.bsdf && !is_glossy(side.bsdf); }

class LinkPainter {
public:
    LinkPainter(const Scene& scene, const RowShare& rows, double rays, std::uint64_t seed, int bounces)
        : scene_(scene),
          rows_(rows),
          patches_(rows.space().patches()),
          light_(scene, rows.space(), rays, seed ^ link_stream, bounces),
          seed_(seed ^ lens_stream),
          last_(static_cast<std::size_t>(bounces) + 1),
          kept_(std::min(1.0, most_ends / static_cast<double>(light_.paths()))) {}

    LinkPictures paint(const Watch& watch) const {
        LinkPictures result{std::vector<Rgb>(static_cast<std::size_t>(scene_.film.crop_width) *
                                                 static_cast<std::size_t>(scene_.film.crop_height) * (last_ + 1),
                                             Rgb(0.0)),
                            LinkRaster(patches_, {}, 0)};
        std::vector<LinkRaster::End> ends;
        light_.for_parts([&](std::size_t part) { return trace(part); },
                         [&](const PartOfLinks& found) {
                             result.rays += found.rays;
                             for (const PartOfLinks::Contribution& share : found.shares) result.picture[share.place] += share.value;
                             ends.insert(ends.end(), found.ends.begin(), found.ends.end());
                         },
                         watch, &rows_);
        result.raster = LinkRaster(patches_, std::move(ends), static_cast<int>(last_) - 1);
        return result;
    }

private:
    PartOfLinks trace(std::size_t part) const {
        PartOfLinks found;
        Sampler sampler(seed_, static_cast<std::uint32_t>(part));
        std::uint64_t paths = 0, to_lens = 0;
        found.rays = light_.trace(part, {}, [&](const LinkArrival& a) {
            const std::size_t bounce = std::min(a.bounce, last_);
            if (!is_diffuse(scene_.materials.side(a.x, a.wi))) return;
            sampler.start(paths++);
            if (sampler.next() < kept_) {
                const Patches::ChartPosition place = patches_.place(a.x);
                found.ends.emplace_back(place.chart, glm::dot(a.x.normal, a.wi) > 0.0,
                                        LinkRaster::spread(patches_.charts()[place.chart], place.st),
                                        static_cast<std::uint32_t>(bounce), a.power / (kept_ * a.index * a.index));
            }
            const auto edge = edge_to_lens(scene_, 0, a.x, place_on_lens(scene_, sampler));
            if (!edge) return;
            const SurfaceSide side = scene_.materials.side(a.x, edge->w);
            if (!is_diffuse(side)) return;
            const Rgb value = a.power * geometric_bsdf(side, edge->w, a.wi) *
                              (std::abs(glm::dot(a.x.normal, edge->w)) * edge->pixels_per_area * edge->weight);
            if (is_black(value)) return;
            ++to_lens;
            if (!scene_.geometry.visible(a.x, edge->lens)) return;
            for_pixels_reached(scene_.film, edge->position, [&](std::uint32_t pixel, double weight) {
                found.shares.push_back({pixel * (last_ + 1) + bounce, value * weight});
            });
        });
        found.rays += to_lens;
        return found;
    }

    const Scene& scene_;
    const RowShare& rows_;
    const Patches& patches_;
    LinkLight light_;
    std::uint64_t seed_;
    std::size_t last_;  // the quantity of all bounces beyond N
    double kept_;       // part of the paths that the raster takes
};

}  // namespace

bool shows_links(const Scene& scene) { return !scene.hide_emitters && scene.camera.can_be_joined(); }

LinkPictures picture_links(const Scene& scene, const RowShare& rows, double rays, std::uint64_t seed, int bounces,
                           const Watch& watch) {
    return LinkPainter(scene, rows, rays, seed, bounces).paint(watch);
}

}  // namespace neumann
