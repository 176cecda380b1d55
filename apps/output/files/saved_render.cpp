#include "apps/output/files/saved_render.h"

#include "apps/output/files/method_json.h"
#include "apps/output/files/saved_fields.h"
#include "apps/output/files/state_file.h"
#include "core/base/error.h"
#include "core/base/input_file.h"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <fstream>
#include <limits>
#include <memory>
#include <span>

namespace neumann {

namespace {

using Json = nlohmann::ordered_json;

constexpr double none = std::numeric_limits<double>::quiet_NaN();

Json as_json(const SampleName& name) { return {name.pixel, name.sample}; }
SampleName name_from(const Json& json) { return {json.at(0), json.at(1)}; }

Json as_json(const SamplePlace& place) { return {place.pixel, as_json(place.name)}; }
SamplePlace place_from(const Json& json) { return {json.at(0), name_from(json.at(1))}; }

Json as_json(const Tally& tally) {
    Json json = {{"rays", tally.rays},
                 {"shared_rays", tally.shared_rays},
                 {"given_up", tally.given_up},
                 {"non_finite_count", tally.non_finite_count}};
    json["non_finite"] = Json::array();
    for (const NonFiniteSample& s : tally.non_finite) json["non_finite"].push_back({s.bounce, as_json(s.place)});
    json["largest"] = Json::array();
    for (const LargestSamples& largest : tally.largest) {
        Json samples = Json::array();
        for (const LargestSamples::Sample& s : largest.kept()) samples.push_back({s.value, as_json(s.place)});
        json["largest"].push_back({{"count", largest.count()}, {"samples", std::move(samples)}});
    }
    for (const ChainStatistics& c : tally.chains)
        json["chains"].push_back({c.small, c.small_accepted, c.large, c.large_accepted, c.largest_stay, c.chains, c.states, c.sum,
                                  c.squares, c.squares_of_chains});
    return json;
}

Tally tally_from(const Json& json) {
    Tally tally(json.at("rays").size());
    json.at("rays").get_to(tally.rays);
    tally.shared_rays = json.value("shared_rays", std::uint64_t{0});
    json.at("given_up").get_to(tally.given_up);
    json.at("non_finite_count").get_to(tally.non_finite_count);
    for (const Json& s : json.at("non_finite")) tally.non_finite.push_back({s.at(0), place_from(s.at(1))});
    tally.largest.clear();
    for (const Json& largest : json.at("largest")) {
        std::vector<LargestSamples::Sample> samples;
        for (const Json& s : largest.at("samples")) samples.push_back({s.at(0), place_from(s.at(1))});
        tally.largest.emplace_back(largest.at("count").get<std::uint64_t>(), std::move(samples));
    }
    if (json.contains("chains"))
        for (const Json& c : json["chains"])
            tally.chains.push_back({c.at(0), c.at(1), c.at(2), c.at(3), c.at(4), c.at(5), c.at(6), c.at(7), c.at(8), c.at(9)});
    return tally;
}

Json as_json(const std::vector<SeedRange>& merged) {
    Json json = Json::array();
    for (const SeedRange& range : merged) json.push_back({range.seed, range.first, range.count, range.sizes});
    return json;
}

std::vector<SeedRange> merged_from(const Json& json) {
    std::vector<SeedRange> merged;
    for (const Json& range : json) merged.push_back({range.at(0), range.at(1), range.at(2), range.at(3)});
    return merged;
}

Json as_json(const MethodChoice& choice) {
    Json json = {
        {"options", neumann::as_json(choice.method)}, {"why", choice.why}, {"seconds", choice.seconds}, {"trials", Json::array()}};
    for (const MethodTrial& t : choice.trials) json["trials"].push_back({t.method, t.rays, t.error});
    return json;
}

MethodChoice choice_from(const Json& json) {
    MethodChoice choice{method_from_json(json.at("options")), json.at("why"), {}, json.at("seconds")};
    for (const Json& t : json.at("trials")) choice.trials.push_back({t.at(0), t.at(1), t.at(2)});
    return choice;
}

// A row for each checkpoint: samples, rays, seconds, the errors of the sum, of each term, and the same against a
// reference, with NaN if there is none.
std::vector<double> convergence_of(const std::vector<Checkpoint>& checkpoints, std::size_t terms) {
    std::vector<double> numbers;
    for (const Checkpoint& c : checkpoints) {
        for (const std::uint64_t count : {c.samples, c.rays}) numbers.push_back(std::bit_cast<double>(count));
        numbers.insert(numbers.end(), {c.seconds, c.sum_error});
        numbers.insert(numbers.end(), c.term_error.begin(), c.term_error.end());
        numbers.push_back(c.true_sum_error.value_or(none));
        for (std::size_t i = 0; i < terms; ++i) numbers.push_back(c.true_term_error.empty() ? none : c.true_term_error[i]);
    }
    return numbers;
}

std::vector<Checkpoint> checkpoints_from(std::span<const double> numbers, std::size_t rows, std::size_t terms) {
    std::vector<Checkpoint> checkpoints;
    for (std::size_t row = 0; row < rows; ++row) {
        const auto values = numbers.subspan(row * (5 + 2 * terms), 5 + 2 * terms);
        Checkpoint c{
            std::bit_cast<std::uint64_t>(values[0]), std::bit_cast<std::uint64_t>(values[1]), values[2], {}, values[3], {}, {}};
        const auto errors = values.subspan(4, terms), true_errors = values.subspan(5 + terms, terms);
        c.term_error.assign(errors.begin(), errors.end());
        if (!std::isnan(values[4 + terms])) {
            c.true_sum_error = values[4 + terms];
            c.true_term_error.assign(true_errors.begin(), true_errors.end());
        }
        checkpoints.push_back(std::move(c));
    }
    return checkpoints;
}

// The part of the header that every state has.
Json header_of(const RequestOnDisk& request, const RecordedRender& render, const std::optional<MethodChoice>& choice) {
    Json header = {{"request", request.request}, {"scene_hash", request.scene_hash}};
    header.update(neumann::as_json(render));
    if (choice) header["choice"] = as_json(*choice);
    return header;
}

}  // namespace

void save_render(OutputFolder& folder, const RequestOnDisk& request, const RecordedRender& render,
                 const std::optional<MethodChoice>& choice, const RenderedSeries& series) {
    const SeriesMoments& moments = series.moments;
    const std::size_t terms = series.convergence.empty() ? 0 : series.convergence.front().term_error.size();
    const std::vector<double> convergence = convergence_of(series.convergence, terms);
    Json header = header_of(request, render, choice);
    header.update({{"picture", {moments.width(), moments.height(), moments.quantities(), moments.pictures()}},
                   {"samples", series.samples},
                   {"seconds", series.seconds},
                   {"tally", as_json(series.tally)},
                   {"merged", as_json(series.merged)},
                   {"checkpoints", {series.convergence.size(), terms}},
                   {"sizes", series.sizes.size()},
                   {"ranges", moments.ranges().of.size()},
                   {"nodes", Json::array()}});
    for (const SeriesMoments::Node& node : moments.nodes()) header["nodes"].push_back({node.first, node.count, node.data->size()});

    std::vector<std::string_view> pieces;
    for (const SeriesMoments::Node& node : moments.nodes()) pieces.push_back(bytes_of(node.data->data(), node.data->size()));
    pieces.push_back(bytes_of(moments.ranges().of.data(), moments.ranges().of.size()));
    pieces.push_back(bytes_of(convergence.data(), convergence.size()));
    pieces.push_back(bytes_of(series.sizes.data(), series.sizes.size()));
    write_state(folder, std::move(header), std::move(pieces));
}

void save_fields(OutputFolder& folder, const RequestOnDisk& request, const RecordedRender& render,
                 const std::optional<MethodChoice>& choice, const FieldProgress& progress) {
    Json header = header_of(request, render, choice);
    std::vector<std::string_view> pieces;
    header["fields"] = as_json(progress, pieces);
    write_state(folder, std::move(header), std::move(pieces));
}

std::optional<std::filesystem::path> saved_render_in(const std::filesystem::path& folder) {
    for (const std::string& name : {unfinished_render_file, samples_file})
        if (std::error_code error; std::filesystem::exists(folder / name, error)) return folder / name;
    return std::nullopt;
}

RequestOnDisk request_in_file(const std::filesystem::path& path) {
    const StateFile file(path);
    return {file.header().at("request"), file.header().at("scene_hash")};
}

RequestOnDisk request_in(const std::filesystem::path& folder) {
    if (const auto saved = saved_render_in(folder)) return request_in_file(*saved);
    const std::filesystem::path path = folder / "run.json";
    std::ifstream file = open_if_there(path);
    if (!file) throw InputError(folder.string() + ": holds no render that could be resumed");
    try {
        const Json json = Json::parse(file);
        if (!json.contains("request")) throw InputError(path.string() + ": tells no request, and cannot be resumed");
        if (json.at("samples").contains("merged"))
            throw InputError(path.string() + ": was merged of several seeds; render another seed and merge that, too");
        return {json.at("request"), json.at("scene").at("hash")};
    } catch (const Json::exception& e) {
        throw InputError(fmt::format("{}: is not a run.json of this program's renders: {}", path.string(), e.what()));
    }
}

RenderState read_saved_render(const std::filesystem::path& path) {
    StateFile file(path);
    const Json& header = file.header();
    try {
        const RecordedRender render = recorded_render_from_json(header);
        std::optional<MethodChoice> choice;
        if (header.contains("choice")) choice = choice_from(header.at("choice"));
        if (header.contains("fields")) {
            FieldProgress fields = fields_from(header.at("fields"), file);
            file.expect_end();
            return {render, choice, {SeriesMoments(0, 0, 0), Tally(0), {}}, std::move(fields)};
        }
        const Json& picture = header.at("picture");
        RenderedSeries series{{picture.at(0), picture.at(1), picture.at(2), picture.at(3)}, tally_from(header.at("tally")), {}};
        std::vector<SeriesMoments::Node> nodes;
        for (const Json& node : header.at("nodes"))
            nodes.push_back({node.at(0), node.at(1),
                             std::make_shared<std::vector<double>>(file.numbers<double>(node.at(2).get<std::uint64_t>()))});
        series.moments.set(std::move(nodes), {file.numbers<SampleRange>(header.at("ranges").get<std::uint64_t>())});
        const std::size_t rows = header.at("checkpoints").at(0), terms = header.at("checkpoints").at(1);
        series.convergence = checkpoints_from(file.numbers<double>(rows * (5 + 2 * terms)), rows, terms);
        series.sizes = file.numbers<std::uint32_t>(header.at("sizes").get<std::uint64_t>());
        header.at("samples").get_to(series.samples);
        header.at("seconds").get_to(series.seconds);
        series.merged = merged_from(header.at("merged"));
        header.at("replicate_size").get_to(series.replicate_size);
        file.expect_end();
        return {render, choice, std::move(series)};
    } catch (const Json::exception& e) {
        file.damaged(e.what());
    }
}

}  // namespace neumann
