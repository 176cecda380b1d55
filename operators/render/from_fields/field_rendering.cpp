#include "operators/render/from_fields/field_rendering.h"

#include "core/base/stopwatch.h"
#include "operators/fields/matrix/link_light.h"
#include "operators/fields/matrix/ray_table.h"
#include "operators/fields/matrix/scene_patches.h"
#include "operators/fields/matrix/scene_reflection.h"
#include "operators/fields/matrix/traced_series.h"
#include "operators/render/from_fields/field_memory.h"
#include "operators/render/from_fields/field_pixels.h"
#include "operators/render/from_fields/link_pictures.h"
#include "operators/render/from_paths/shared_pixels.h"
#include "operators/render/plan/half_spaces.h"

#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/parallel_for.h>
#include <algorithm>
#include <atomic>
#include <mutex>
#include <numeric>

namespace neumann {

namespace {

EnergyBalance power_balance(const std::vector<TracedSeries>& replicates) {
    std::vector<std::vector<EnergyShares>> all;
    for (const TracedSeries& series : replicates) {
        const std::vector<PowerOfTerm>& power = series.power;
        auto& shares = all.emplace_back(1, EnergyShares{power[0].emitted, 0.0, power[0].left, power[0].caught});
        for (std::size_t i = 1; i < power.size(); ++i)
            shares.push_back({power[i - 1].caught, power[i - 1].absorbed, power[i].left, power[i].caught});
    }
    return balance(all);
}

Glossy glossy_of(const FieldSettings& settings, const Scene& scene) {
    return shows_patches(settings.reading) ? Glossy::in_cells : glossy_of_pictures(scene);
}

// `processes`: the number of processes that share the rays.
PatchSpace patches_of(const FieldSettings& settings, const Scene& scene, int processes) {
    const auto requested = static_cast<double>(settings.patching.patches);
    check_field_memory(settings, scene.film, {requested, requested, requested * settings.rays / processes});
    const Glossy glossy = glossy_of(settings, scene);
    PatchSpace space = scene_patches(scene, settings.patching, glossy);
    check_camera(scene);
    check_field_memory(settings, scene.film,
                       {static_cast<double>(space.patches().size()), static_cast<double>(space.size()),
                        static_cast<double>(RayTable::size(space, settings.rays)) / processes, glossy == Glossy::by_rays});
    return space;
}

class FieldRendering {
public:
    FieldRendering(const Scene& scene, const FieldSettings& settings, const Watch& watch, Processes* processes, FieldSaving* saving)
        : scene_(scene),
          settings_(settings),
          watch_(watch),
          processes_(processes),
          saving_(saving),
          space_(patches_of(settings, scene, processes ? processes->size() : 1)),
          coarser_(space_.coarser()),
          reflection_(scene, space_),
          rows_(space_, settings.rays, processes),
          pictures_(scene.film, settings),
          pixels_(scene, settings),
          groups_(pixels_.groups()),
          read_(groups_),
          rays_of_group_(groups_) {
        pictures_.has_links = glossy_of(settings, scene) == Glossy::by_rays;
        pictures_.patches = space_.patches().size();
        pictures_.unknowns = space_.size();
        for (const Facet& facet : space_.facets()) ++pictures_.sides[facet.cells.size()];
        pictures_.samples = std::uint64_t{settings.samples} * settings.replicates;
        pictures_.rays.resize(static_cast<std::size_t>(settings.bounces) + 2);
        later_ = std::min<std::size_t>(2, pictures_.rays.size() - 1);
        if (saving && saving->from && same_pictures(saving->from->settings, settings)) {
            begun_ = &*saving->from;
            expect_whole(*begun_);
            pictures_.field_seconds = begun_->field_seconds;
            pictures_.picture_seconds = begun_->picture_seconds;
        }
    }

    std::optional<FieldPictures> render() {
        try {
            spends_ = &pictures_.field_seconds;
            trace();
            find_resolution();
            spend(&pictures_.picture_seconds);
            show_links();
            read_pixels();
            spend(nullptr);
        } catch (const Stopped&) {
            keep(true);
            return std::nullopt;
        }
        return std::move(pictures_);
    }

private:
    // Throws RunError if the saved progress cannot be of this scene.
    void expect_whole(const FieldProgress& begun) const {
        bool whole = begun.series.size() <= settings_.replicates;
        for (const SavedSeries& series : begun.series)
            whole = whole && series.numbers.size() == saved_size(space_, coarser_, settings_.bounces, series.has_links) &&
                    series.power.size() == (pictures_.importance ? 0 : static_cast<std::size_t>(settings_.bounces) + 1);
        for (const FieldProgress::Read& read : begun.read)
            whole = whole && read.begin <= read.end && read.end <= groups_ &&
                    read.values.size() == pixels_.first_value(read.end) - pixels_.first_value(read.begin);
        if (!whole) throw RunError("what is kept of this render has other sizes than its scene: it cannot be gone on with");
    }

    // Ends one part of the timed work and begins another, whose seconds are added to *next.
    void spend(double* next) {
        *spends_ += clock_.seconds();
        clock_ = Stopwatch();
        spends_ = next;
    }

    // Traces or restores the series of all replicates.
    void trace() {
        const auto there = static_cast<std::uint32_t>(rows_.sum(begun_ ? static_cast<double>(begun_->series.size()) : 0.0));
        pictures_.rest_converges = settings_.rest;
        for (std::uint32_t r = 0; r < settings_.replicates; ++r) {
            series_.push_back(r < there ? take_series(r) : trace_series(r));
            pictures_.rays[later_] += series_.back().rays;
            pictures_.rest_converges = pictures_.rest_converges && series_.back().rest_converges;
            keep(false);
        }
        if (!pictures_.importance) pictures_.power = power_balance(series_);
    }

    TracedSeries trace_series(std::uint32_t replicate) const {
        const TracedSeriesSettings traced{.bounces = settings_.bounces,
                                          .rays = settings_.rays,
                                          .light_samples = settings_.light_samples,
                                          .seed = seed(replicate),
                                          .rest = settings_.rest,
                                          .glossy = glossy_of(settings_, scene_),
                                          .camera_samples = settings_.samples};
        return pictures_.importance ? trace_importance(scene_, space_, coarser_, reflection_, traced, watch_)
                                    : neumann::trace_series(scene_, rows_, coarser_, reflection_, traced, watch_);
    }

    // Restores a series that was traced before; process 0 has it and shares it with the others.
    TracedSeries take_series(std::uint32_t replicate) const {
        SavedSeries saved = begun_ ? std::move(begun_->series[replicate]) : SavedSeries();
        if (processes_) {
            double numbers[] = {saved.has_links ? 1.0 : 0.0, saved.rest_converges ? 1.0 : 0.0, static_cast<double>(saved.rays),
                                static_cast<double>(saved.light_rays)};
            rows_.sum(numbers);
            saved.has_links = numbers[0] > 0.0;
            saved.rest_converges = numbers[1] > 0.0;
            saved.rays = static_cast<std::uint64_t>(numbers[2]);
            saved.light_rays = static_cast<std::uint64_t>(numbers[3]);
            saved.power.resize(static_cast<std::size_t>(settings_.bounces) + 1);  // only process 0 uses the power
            saved.numbers.resize(saved_size(space_, coarser_, settings_.bounces, saved.has_links));
            processes_->share(saved.numbers);
        }
        return restored(saved, space_, coarser_, settings_.bounces);
    }

    void find_resolution() {
        const double replicates = settings_.replicates;
        RayCounts counts;
        counts.of_facet = settings_.rays * replicates;
        counts.all = static_cast<double>(RayTable::size(space_, settings_.rays)) * replicates;
        for (const TracedSeries& s : series_) counts.lights += static_cast<double>(s.light_rays);
        counts.lights_of_facet = counts.lights / static_cast<double>(space_.facets().size());
        if (settings_.reading == FieldReading::gather) counts.gathered = replicates * settings_.samples * settings_.gather_rays;
        counts.pixels = pixels_.pixels();
        if (!shows_patches(settings_.reading)) counts.sampled_at_pixel = settings_.bounces > 0 ? 2 : 1;
        const ConvexBody body = HalfSpaces(scene_.geometry).convex_body();
        counts.is_closed = body.found && body.is_closed;
        pictures_.set_resolution(RayResolution(series_, counts));
    }

    // Adds light that comes by links, as points.
    void show_links() {
        if (!series_.front().fine_by_links || !shows_links(scene_)) return;
        const double rays =
            std::max(rays_of_links(space_, settings_.rays), static_cast<double>(pixels_.pixels()) * settings_.samples);
        std::vector<LinkRaster> rasters;
        for (std::uint32_t r = 0; r < settings_.replicates; ++r) {
            LinkPictures links = picture_links(scene_, rows_, rays, seed(r), settings_.bounces, watch_);
            pictures_.rays[later_] += links.rays;
            pictures_.set_replicate(r, links.picture);
            rasters.push_back(std::move(links.raster));
        }
        by_links_ = divide_by_links(series_, std::move(rasters), [&](std::size_t k) { return pictures_.relative_noise(k); });
        for (std::size_t k = 2; k < pictures_.quantities(); ++k)
            if (!by_links_.front().shown_as_points[k]) pictures_.set_to_zero(k);
    }

    void read_pixels() {
        oneapi::tbb::enumerable_thread_specific<FieldPixels::Workspace> workspaces;
        pictures_.add_by_groups(pixels_.group());
        take_groups(0, groups_);
        has_taken_all_ = true;
        share_which_are_read();
        const SharedPixels shared(groups_, processes_);
        for (std::uint32_t round = 0; round < shared.rounds(); ++round) {
            const auto [own_begin, own_end] = shared.own(round);
            std::atomic<bool> stopped = false;
            oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<std::uint32_t>(own_begin, own_end, 4), [&](const auto& range) {
                if (stopped || watch_.stop()) {
                    stopped = true;
                    return;
                }
                FieldPixels::Workspace& work = workspaces.local();
                for (std::uint32_t group = range.begin(); group < range.end(); ++group) {
                    if (read_[group]) continue;
                    rays_of_group_[group] = pixels_.read(group, series_, by_links_, pictures_, work);
                    pictures_.group_is_complete(group);
                    read_[group] = true;
                }
                keep(false);
            });
            if (rows_.any(stopped)) throw Stopped();
            if (processes_) give_to_first(shared, round);
        }
        begun_ = nullptr;
        pictures_.add_groups();
        for (const RaysByBounce& rays : rays_of_group_)
            for (std::size_t k = 0; k < 3; ++k) pictures_.rays[std::min(k, later_)] += rays[k];
    }

    void give_to_first(const SharedPixels& shared, std::uint32_t round) {
        const auto [own_begin, own_end] = shared.own(round);
        const auto [begin, end] = shared.taken(round);
        shared.give_to_first(round, pictures_.values(0), [&](std::uint32_t group) { return pixels_.first_value(group); });
        std::array<double, 3> of_others{};
        for (std::uint32_t group = own_begin; !rows_.is_first() && group < own_end; ++group)
            for (std::size_t k = 0; k < 3; ++k) of_others[k] += static_cast<double>(rays_of_group_[group][k]);
        rows_.sum(of_others);
        if (begin == end) return;
        take_groups(begin, end);
        for (std::size_t k = 0; k < 3; ++k) rays_of_group_[begin][k] += static_cast<std::uint64_t>(of_others[k]);
        oneapi::tbb::parallel_for(begin, end, [&](std::uint32_t group) {
            pictures_.group_is_complete(group);
            read_[group] = true;
        });
        keep(false);
    }

    // Takes the saved values of those groups in [begin, end) that were read before.
    void take_groups(std::uint32_t begin, std::uint32_t end) {
        if (!begun_) return;
        for (const FieldProgress::Read& read : begun_->read) {
            const std::uint32_t from = std::max(begin, read.begin), to = std::min(end, read.end);
            if (from >= to) continue;
            std::copy_n(read.values.data() + (pixels_.first_value(from) - pixels_.first_value(read.begin)),
                        pixels_.first_value(to) - pixels_.first_value(from), pictures_.values(0) + pixels_.first_value(from));
            rays_of_group_[from] = from == read.begin ? read.rays : RaysByBounce{};
            for (std::uint32_t group = from; group < to; ++group) {
                pictures_.group_is_complete(group);
                read_[group] = true;
            }
        }
    }

    void share_which_are_read() {
        if (!processes_) return;
        std::vector<double> read(read_.begin(), read_.end());
        rows_.sum(read);
        for (std::uint32_t group = 0; group < groups_; ++group) read_[group] = read[group] > 0.0;
    }

    // Keeps the progress, with the groups read so far. May be called from any thread.
    void keep(bool is_stopped) {
        if (!saving_ || (begun_ && !has_taken_all_)) return;  // the saved progress contains more
        const std::unique_lock lock(keeps_, std::try_to_lock);
        if (!lock || !saving_->is_due(is_stopped)) return;
        FieldProgress progress;
        progress.settings = settings_;
        progress.field_seconds = pictures_.field_seconds;
        progress.picture_seconds = pictures_.picture_seconds;
        (spends_ == &pictures_.field_seconds ? progress.field_seconds : progress.picture_seconds) += clock_.seconds();
        for (const TracedSeries& series : series_) progress.series.push_back(saved(series));
        for (std::uint32_t group = 0; group < groups_; ++group) {
            if (!read_[group]) continue;
            FieldProgress::Read read{group, group, {}, {}};
            for (; group < groups_ && read_[group]; ++group, ++read.end)
                for (std::size_t k = 0; k < 3; ++k) read.rays[k] += rays_of_group_[group][k];
            read.values = {pictures_.values(0) + pixels_.first_value(read.begin),
                           pictures_.values(0) + pixels_.first_value(read.end)};
            progress.read.push_back(read);
        }
        saving_->keep(progress);
    }

    std::uint64_t seed(std::uint32_t replicate) const { return settings_.seed * 0x10001 + replicate; }

    const Scene& scene_;
    const FieldSettings& settings_;
    const Watch& watch_;
    Processes* processes_;
    FieldSaving* saving_;
    FieldProgress* begun_ = nullptr;  // the saved progress, or null
    bool has_taken_all_ = false;      // of `begun_`
    double* spends_ = nullptr;        // where the clock's seconds are added
    Stopwatch clock_;
    const PatchSpace space_, coarser_;
    const SceneReflection reflection_;
    const RowShare rows_;
    FieldPictures pictures_;
    const FieldPixels pixels_;
    std::vector<TracedSeries> series_;
    std::vector<LinkFields> by_links_;
    std::uint32_t groups_;                 // of pixels
    std::vector<std::atomic<bool>> read_;  // for each group, whether it has been read
    std::vector<RaysByBounce> rays_of_group_;
    std::size_t later_;  // index under which the rays of later bounces are counted
    std::mutex keeps_;
};

}  // namespace

std::optional<FieldPictures> render_fields(const Scene& scene, const FieldSettings& settings, const Watch& watch,
                                           Processes* processes, FieldSaving* saving) {
    return FieldRendering(scene, settings, watch, processes, saving).render();
}

}  // namespace neumann
