#include "apps/output/study/study_reference.h"

#include "apps/output/files/json_text.h"
#include "apps/output/files/reference.h"
#include "apps/output/files/series_files.h"
#include "apps/output/study/study_saving.h"
#include "core/base/error.h"
#include "core/base/input_file.h"
#include "core/base/interrupt.h"
#include "core/base/stopwatch.h"
#include "core/image/image_io.h"
#include "operators/render/methods/method_options.h"

#include <fmt/format.h>
#define XXH_INLINE_ALL
#include <xxhash.h>

#include <charconv>
#include <cstdlib>
#include <filesystem>
#include <fstream>

namespace neumann {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* values_prefix = "values:";
std::optional<fs::path> cache_folder() {
    const char* cache = std::getenv("XDG_CACHE_HOME");
    if (cache && *cache == '/') return fs::path(cache) / "neumann";
    const char* home = std::getenv("HOME");
    if (home && *home == '/') return fs::path(home) / ".cache" / "neumann";
    return std::nullopt;
}

// One grey value for each bounce, the same in all pixels.
StudyReference from_values(const std::string& text, const Film& film, int bounces) {
    std::vector<double> values;
    const std::string list = text.substr(std::string(values_prefix).size());
    for (const char *at = list.data(), *end = at + list.size(); at <= end; ++at) {
        double value = 0.0;
        const auto [next, error] = std::from_chars(at, end, value);
        if (error != std::errc() || (next != end && *next != ',') || !std::isfinite(value))
            throw OptionError("reference", fmt::format("{}: expected a number for each bounce, as in values:1,0.5,0.25", text));
        values.push_back(value);
        at = next;
    }
    if (values.size() < static_cast<std::size_t>(bounces) + 1)
        throw OptionError("reference", fmt::format("{}: has {} values, expected {}, of bounces 0 to {}", text, values.size(),
                                                   bounces + 1, bounces));
    StudyReference result;
    Image picture(film.crop_width, film.crop_height), sum = picture;
    for (int i = 0; i <= bounces; ++i) {
        for (std::size_t p = 0; p < picture.pixels.size(); ++p)
            sum.pixels[p] += picture.pixels[p] = Rgb(values[static_cast<std::size_t>(i)]);
        result.pictures.push_back({picture, {}});
    }
    result.pictures.push_back({sum, {}});
    result.exact = true;
    result.description = "exact: each bounce is one colour, as given";
    result.identity = {{"kind", "exact"}, {"values", values}};
    return result;
}

StudyReference from_folder(const std::string& folder, const Film& film, int bounces) {
    StudyReference result;
    const auto add = [&](const std::string& file) {
        RenderedPicture rendered = read_reference(folder, file, film);
        if (rendered.infinite_variance)
            result.warnings.push_back(
                fmt::format("{}/{}: its variance is infinite; what its noise adds is not known", folder, file));
        result.exact = (result.pictures.empty() || result.exact) && !rendered.has_error();
        result.pictures.push_back(std::move(rendered.picture));
    };
    for (int i = 0; i <= bounces; ++i) add(bounce_file(static_cast<std::size_t>(i)));
    add(sum_file(static_cast<std::size_t>(bounces)));
    // A hash of the contents identifies it.
    XXH64_hash_t hash = 0;
    for (const Estimate& e : result.pictures)
        for (const Image* image : {&e.mean, &e.standard_error})
            hash = XXH64(image->pixels.data(), image->pixels.size() * sizeof(Rgb), hash);
    result.description = result.exact ? fmt::format("the pictures in {}, without standard errors and so taken as exact", folder)
                                      : fmt::format("the pictures in {}; the noise of their standard errors is subtracted", folder);
    result.identity = {{"kind", "folder"}, {"folder", folder}, {"hash", fmt::format("{:016x}", hash)}};
    return result;
}

Json made_identity(const StudyRequest& request, std::uint64_t samples, const Scene& scene, int bounces) {
    return {{"kind", "made"},
            {"method", request.reference},
            {"samples", samples},
            {"seed", study_seed(0, reference_method, 0, 0)},
            {"bounces", bounces},
            {"width", scene.film.crop_width},
            {"height", scene.film.crop_height},
            {"scene_hash", scene.hash},
            {"definitions", request.scene.definitions},
            {"version", NEUMANN_VERSION}};
}

fs::path cache_path(const fs::path& cache, const Json& identity) {
    const std::string text = json_text(identity);
    return cache / fmt::format("reference-{:016x}", XXH64(text.data(), text.size(), 0));
}

bool is_cached(const fs::path& folder, const Json& identity) {
    std::ifstream file = open_if_there(folder / "run.json");
    return file && Json::parse(file, nullptr, false) == identity;
}

// Stores the pictures as in a render's folder, and the identity as its run.json.
void keep(const fs::path& path, const Json& identity, const StudyReference& reference, double degrees_of_freedom) {
    OutputFolder folder(path, "render");
    const std::size_t N = reference.pictures.size() - 2;
    const Attributes attributes{{"neumann:degrees_of_freedom", degrees_of_freedom}};
    for (std::size_t i = 0; i <= N; ++i) folder.write(bounce_file(i), encode_exr(reference.pictures[i], attributes));
    folder.write(sum_file(N), encode_exr(reference.pictures.back(), attributes));
    folder.write("run.json", json_text(identity, 2) + "\n");
    folder.commit();
}

StudyMethod making_method(const StudyRequest& request) {
    StudyMethod method{request.reference, {}};
    try {
        method.method = studied_method(request.reference);
    } catch (const InputError&) {
        throw OptionError("reference",
                          fmt::format("{}: expected the folder of an earlier render, values:A,B,…, or a method without bias that "
                                      "makes one, as in walk or walk:direct=light",
                                      request.reference));
    }
    if (is_biased(method.method))
        throw OptionError("reference", fmt::format("{}: {} have an error of their own; take walk", request.reference,
                                                   has_fields(method.method)                              ? "fields on patches"
                                                   : std::holds_alternative<method::Cache>(method.method) ? "irradiance caches"
                                                                                                          : "photon maps"));
    return method;
}

}  // namespace

std::optional<StudyReference> given_reference(const StudyRequest& request, const Film& film, int bounces) {
    if (request.reference.empty()) return std::nullopt;
    if (request.reference.starts_with(values_prefix)) return from_values(request.reference, film, bounces);
    if (fs::is_directory(request.reference)) return from_folder(request.reference, film, bounces);
    making_method(request);
    return std::nullopt;
}

std::optional<StudyReference> make_reference(const StudyRequest& request, std::uint64_t wanted, const Scene& scene,
                                             const Pilot& pilot, int bounces, OutputFolder& folder, Crew* crew,
                                             const std::function<void(const Json&)>& begins) {
    const StudyMethod method = making_method(request);
    const auto described = [&](StudyReference reference, std::uint64_t samples) {
        reference.description =
            fmt::format("{} with {} samples a pixel and a seed of its own; its noise is subtracted", request.reference, samples);
        reference.identity = made_identity(request, samples, scene, bounces);
        return reference;
    };
    const std::optional<fs::path> cache = cache_folder();
    // The measured speed varies, so a cached reference with half as many samples is accepted, and so is one with more.
    std::vector<std::uint64_t> enough{wanted};
    if (!request.reference_samples && !request.resume)
        enough = {16 * wanted, 8 * wanted, 4 * wanted, 2 * wanted, wanted, wanted / 2};
    for (const std::uint64_t samples : enough) {
        const Json identity = made_identity(request, samples, scene, bounces);
        if (!cache || !is_cached(cache_path(*cache, identity), identity)) continue;
        StudyReference found = described(from_folder(cache_path(*cache, identity).string(), scene.film, bounces), samples);
        found.from_cache = true;
        return found;
    }

    begins(made_identity(request, wanted, scene, bounces));
    const Stopwatch watch;
    StudySaving saving(folder, "reference", scene, request);
    // A reference that could not be cached is made again when a study resumes, while the folder may have a run's state.
    const bool keeps = saving.has_room();
    if (!request.quiet) fmt::print(stderr, "Making a reference by {}, {} samples a pixel\n", request.reference, wanted);
    const auto run = run_method(method, {wanted}, bounces, study_seed(0, reference_method, 0, 0), scene, pilot,
                                {.stop = interrupted, .crew = crew}, keeps ? saving.saving() : Saving());
    if (!run) return std::nullopt;
    StudyReference made;
    for (std::size_t i = 0; i <= static_cast<std::size_t>(bounces); ++i) made.pictures.push_back(run->term(i));
    made.pictures.push_back(run->sum(static_cast<std::size_t>(bounces)));
    for (int i = 0; i <= bounces; ++i)
        if (run->report.bounces[static_cast<std::size_t>(i)].infinite_variance)
            made.warnings.push_back(
                fmt::format("the reference has an infinite variance at bounce {}: what its noise adds is not known", i));
    if (cache && made.warnings.empty()) {
        const Json identity = made_identity(request, wanted, scene, bounces);
        try {
            keep(cache_path(*cache, identity), identity, made, run->degrees_of_freedom);
            // The pictures are read back, so that they are rounded as in later studies that read them from the cache.
            made = from_folder(cache_path(*cache, identity).string(), scene.film, bounces);
        } catch (const std::runtime_error& e) {
            made.warnings.push_back(fmt::format("the reference is not kept: {}", e.what()));
        }
    }
    if (keeps) folder.forget();
    made.seconds = watch.seconds();
    return described(std::move(made), wanted);
}

}  // namespace neumann
