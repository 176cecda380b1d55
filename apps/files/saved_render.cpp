#include "apps/files/saved_render.h"

#include "apps/files/method_json.h"
#include "core/base/error.h"
#include "core/geometry/ray_caster.h"

#define XXH_INLINE_ALL
#include <xxhash.h>

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <memory>
#include <span>

namespace neumann {

namespace {

using Json = nlohmann::ordered_json;

static_assert(std::endian::native == std::endian::little, "numbers are written as they are in memory");
constexpr std::string_view magic = "neumann render 1\n";
constexpr double none = std::numeric_limits<double>::quiet_NaN();

template <class T>
std::string_view bytes_of(const T* first, std::size_t count) {
    static_assert(std::is_trivially_copyable_v<T>);
    return {reinterpret_cast<const char*>(first), count * sizeof(T)};
}

Json as_json(const SampleName& name) { return {name.pixel, name.sample}; }
SampleName name_from(const Json& json) { return {json.at(0), json.at(1)}; }

Json as_json(const SamplePlace& place) { return {place.pixel, as_json(place.name)}; }
SamplePlace place_from(const Json& json) { return {json.at(0), name_from(json.at(1))}; }

Json as_json(const Tally& tally) {
    Json json = {{"rays", tally.rays}, {"given_up", tally.given_up}, {"non_finite_count", tally.non_finite_count}};
    json["non_finite"] = Json::array();
    for (const NonFiniteSample& s : tally.non_finite) json["non_finite"].push_back({s.bounce, as_json(s.place)});
    json["largest"] = Json::array();
    for (const LargestSamples& largest : tally.largest) {
        Json samples = Json::array();
        for (const LargestSamples::Sample& s : largest.kept()) samples.push_back({s.value, as_json(s.place)});
        json["largest"].push_back({{"count", largest.count()}, {"samples", std::move(samples)}});
    }
    return json;
}

Tally tally_from(const Json& json) {
    Tally tally(json.at("rays").size());
    json.at("rays").get_to(tally.rays);
    json.at("given_up").get_to(tally.given_up);
    json.at("non_finite_count").get_to(tally.non_finite_count);
    for (const Json& s : json.at("non_finite")) tally.non_finite.push_back({s.at(0), place_from(s.at(1))});
    tally.largest.clear();
    for (const Json& largest : json.at("largest")) {
        std::vector<LargestSamples::Sample> samples;
        for (const Json& s : largest.at("samples")) samples.push_back({s.at(0), place_from(s.at(1))});
        tally.largest.emplace_back(largest.at("count").get<std::uint64_t>(), std::move(samples));
    }
    return tally;
}

Json as_json(const std::vector<SeedRange>& merged) {
    Json json = Json::array();
    for (const SeedRange& range : merged) json.push_back({range.seed, range.first, range.count});
    return json;
}

std::vector<SeedRange> merged_from(const Json& json) {
    std::vector<SeedRange> merged;
    for (const Json& range : json) merged.push_back({range.at(0), range.at(1), range.at(2)});
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

// A row: samples, rays, seconds, the errors of the sum, of each term, and the same against a reference, with NaN where there is
// none.
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
        const auto of = numbers.subspan(row * (5 + 2 * terms), 5 + 2 * terms);
        Checkpoint c{std::bit_cast<std::uint64_t>(of[0]), std::bit_cast<std::uint64_t>(of[1]), of[2], {}, of[3], {}, {}};
        const auto errors = of.subspan(4, terms), true_errors = of.subspan(5 + terms, terms);
        c.term_error.assign(errors.begin(), errors.end());
        if (!std::isnan(of[4 + terms])) {
            c.true_sum_error = of[4 + terms];
            c.true_term_error.assign(true_errors.begin(), true_errors.end());
        }
        checkpoints.push_back(std::move(c));
    }
    return checkpoints;
}

Json as_json(const FieldSettings& s) {
    return {{"reading", s.reading},
            {"bounces", s.bounces},
            {"patches", s.patching.patches},
            {"grading", s.patching.grading},
            {"rays", s.rays},
            {"light_samples", s.light_samples},
            {"samples", s.samples},
            {"gather_rays", s.gather_rays},
            {"replicates", s.replicates},
            {"seed", s.seed},
            {"rest", s.rest}};
}

FieldSettings settings_from(const Json& json) {
    return {.reading = json.at("reading").get<FieldReading>(),
            .bounces = json.at("bounces"),
            .patching = {json.at("patches"), json.at("grading")},
            .rays = json.at("rays"),
            .light_samples = json.at("light_samples"),
            .samples = json.at("samples"),
            .gather_rays = json.at("gather_rays"),
            .replicates = json.at("replicates"),
            .seed = json.at("seed"),
            .rest = json.at("rest")};
}

std::string program() { return fmt::format("{}, {}", NEUMANN_VERSION, embree_version()); }

[[noreturn]] void damaged(const std::filesystem::path& file, const std::string& why) {
    throw InputError(fmt::format("{}: damaged: {}", file.string(), why));
}

// Reads a file from its beginning and hashes what it has read.
class HashedFile {
public:
    explicit HashedFile(const std::filesystem::path& path) : path_(path), file_(path, std::ios::binary) {
        if (!file_) throw InputError(path.string() + ": cannot be read");
        std::error_code error;
        left_ = std::filesystem::file_size(path, error);
        XXH3_64bits_reset(state_.get());
    }
    void read(void* to, std::size_t bytes) {
        if (bytes > left_) damaged(path_, "it ends too early");
        left_ -= bytes;
        if (!file_.read(static_cast<char*>(to), static_cast<std::streamsize>(bytes))) damaged(path_, "it ends too early");
        XXH3_64bits_update(state_.get(), to, bytes);
    }
    template <class T>
    std::vector<T> numbers(std::uint64_t count) {
        if (count > left_ / sizeof(T)) damaged(path_, "it ends too early");
        std::vector<T> all(count);
        read(all.data(), count * sizeof(T));
        return all;
    }
    void expect_hash() {
        const std::uint64_t expected = XXH3_64bits_digest(state_.get());
        std::uint64_t found = 0;
        read(&found, sizeof found);
        if (found != expected) damaged(path_, "its checksum is another");
        if (left_ != 0) damaged(path_, "something follows its end");
    }

private:
    std::filesystem::path path_;
    std::ifstream file_;
    std::uint64_t left_ = 0;
    std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> state_{XXH3_createState(), XXH3_freeState};
};

Json read_header(HashedFile& file, const std::filesystem::path& path) {
    std::string start(magic.size(), '\0');
    file.read(start.data(), start.size());
    if (start != magic) damaged(path, "it does not begin like a saved render");
    const std::uint64_t size = file.numbers<std::uint64_t>(1).front();
    const std::vector<char> text = file.numbers<char>(size);
    try {
        Json header = Json::parse(text.begin(), text.end());
        const auto version = header.at("program").get<std::string>();
        if (version != program())
            throw InputError(fmt::format("{}: was written by version {}, and this is {}, whose samples may be others",
                                         path.string(), version, program()));
        return header;
    } catch (const Json::exception& e) {
        damaged(path, e.what());
    }
}

// What the header of every state tells.
Json header_of(const RequestOnDisk& request, const RecordedRender& render, const std::optional<MethodChoice>& choice) {
    Json header = {{"program", program()},
                   {"request", request.options},
                   {"scene_hash", request.scene_hash},
                   {"options", neumann::as_json(render.method)},
                   {"seed", render.seed},
                   {"bounces", render.bounces},
                   {"rest_probability", render.rest_probability},
                   {"replicate_size", render.replicate_size}};
    if (choice) header["choice"] = as_json(*choice);
    return header;
}

void save_pieces(OutputFolder& folder, const Json& header, std::vector<std::string_view> pieces) {
    const std::string text = header.dump();
    const std::uint64_t size = text.size();
    pieces.insert(pieces.begin(), {magic, bytes_of(&size, 1), text});
    const std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> state(XXH3_createState(), XXH3_freeState);
    XXH3_64bits_reset(state.get());
    for (const std::string_view piece : pieces) XXH3_64bits_update(state.get(), piece.data(), piece.size());
    const std::uint64_t hash = XXH3_64bits_digest(state.get());
    pieces.push_back(bytes_of(&hash, 1));
    folder.save(pieces);
}

FieldProgress read_fields(HashedFile& file, const Json& fields) {
    FieldProgress progress;
    progress.settings = settings_from(fields.at("settings"));
    const Json& seconds = fields.at("seconds");
    seconds.at(0).get_to(progress.seconds);
    seconds.at(1).get_to(progress.field_seconds);
    seconds.at(2).get_to(progress.picture_seconds);
    for (const Json& of : fields.at("series")) {
        SavedSeries series;
        of.at("has_links").get_to(series.has_links);
        of.at("rest_converges").get_to(series.rest_converges);
        of.at("rays").get_to(series.rays);
        of.at("light_rays").get_to(series.light_rays);
        for (const Json& p : of.at("power")) series.power.push_back({p.at(0), p.at(1), p.at(2), p.at(3)});
        series.numbers = file.numbers<float>(of.at("floats").get<std::uint64_t>());
        series.fields = {series.numbers};
        progress.series.push_back(std::move(series));
    }
    std::uint64_t size = 0;
    for (const Json& read : fields.at("read")) size += read.at(3).get<std::uint64_t>();
    progress.values = file.numbers<float>(size);
    const float* next = progress.values.data();
    for (const Json& read : fields.at("read")) {
        const auto count = read.at(3).get<std::size_t>();
        progress.read.push_back({read.at(0), read.at(1), read.at(2), {next, count}});
        next += count;
    }
    return progress;
}

}  // namespace

void save_render(OutputFolder& folder, const RequestOnDisk& request, const RecordedRender& render,
                 const std::optional<MethodChoice>& choice, const RenderedSeries& series) {
    const SeriesMoments& moments = series.moments;
    const std::size_t terms = series.convergence.empty() ? 0 : series.convergence.front().term_error.size();
    const std::vector<double> convergence = convergence_of(series.convergence, terms);
    Json header = header_of(request, render, choice);
    header.update({{"picture", {moments.width(), moments.height(), moments.quantities()}},
                   {"samples", series.samples},
                   {"seconds", series.seconds},
                   {"tally", as_json(series.tally)},
                   {"merged", as_json(series.merged)},
                   {"checkpoints", {series.convergence.size(), terms}},
                   {"ranges", moments.ranges().of.size()},
                   {"nodes", Json::array()}});
    for (const SeriesMoments::Node& node : moments.nodes()) header["nodes"].push_back({node.first, node.count, node.data->size()});

    std::vector<std::string_view> pieces;
    for (const SeriesMoments::Node& node : moments.nodes()) pieces.push_back(bytes_of(node.data->data(), node.data->size()));
    pieces.push_back(bytes_of(moments.ranges().of.data(), moments.ranges().of.size()));
    pieces.push_back(bytes_of(convergence.data(), convergence.size()));
    save_pieces(folder, header, pieces);
}

void save_fields(OutputFolder& folder, const RequestOnDisk& request, const RecordedRender& render,
                 const std::optional<MethodChoice>& choice, const FieldProgress& progress) {
    Json header = header_of(request, render, choice);
    Json& fields = header["fields"];
    fields = {{"settings", as_json(progress.settings)},
              {"seconds", {progress.seconds, progress.field_seconds, progress.picture_seconds}},
              {"series", Json::array()},
              {"read", Json::array()}};
    std::vector<std::string_view> pieces;
    for (const SavedSeries& series : progress.series) {
        Json power = Json::array();
        for (const PowerOfTerm& p : series.power) power.push_back({p.emitted, p.left, p.caught, p.absorbed});
        fields["series"].push_back({{"floats", series.size()},
                                    {"has_links", series.has_links},
                                    {"rest_converges", series.rest_converges},
                                    {"rays", series.rays},
                                    {"light_rays", series.light_rays},
                                    {"power", std::move(power)}});
        for (const std::span<const float> of : series.fields) pieces.push_back(bytes_of(of.data(), of.size()));
    }
    for (const FieldProgress::Read& read : progress.read) {
        fields["read"].push_back({read.begin, read.end, read.rays, read.values.size()});
        pieces.push_back(bytes_of(read.values.data(), read.values.size()));
    }
    save_pieces(folder, header, pieces);
}

std::optional<std::filesystem::path> saved_render_in(const std::filesystem::path& folder) {
    for (const std::string& name : {unfinished_render_file, samples_file})
        if (std::error_code error; std::filesystem::exists(folder / name, error)) return folder / name;
    return std::nullopt;
}

RequestOnDisk request_in_file(const std::filesystem::path& path) {
    HashedFile file(path);
    const Json header = read_header(file, path);
    return {header.at("request"), header.at("scene_hash")};
}

RequestOnDisk request_in(const std::filesystem::path& folder) {
    if (const auto saved = saved_render_in(folder)) return request_in_file(*saved);
    const std::filesystem::path path = folder / "run.json";
    std::ifstream file(path);
    if (!file) throw InputError(folder.string() + ": holds no render that could be resumed");
    try {
        const Json json = Json::parse(file);
        if (!json.contains("request")) throw InputError(path.string() + ": tells no options, and cannot be resumed");
        return {json.at("request"), json.at("scene").at("hash")};
    } catch (const Json::exception& e) {
        throw InputError(fmt::format("{}: is not a run.json of this program's renders: {}", path.string(), e.what()));
    }
}

RenderState read_saved_render(const std::filesystem::path& path) {
    HashedFile file(path);
    const Json header = read_header(file, path);
    try {
        const RecordedRender render{method_from_json(header.at("options")), header.at("seed"), header.at("bounces"),
                                    header.at("rest_probability"), header.at("replicate_size")};
        std::optional<MethodChoice> choice;
        if (header.contains("choice")) choice = choice_from(header.at("choice"));
        if (header.contains("fields")) {
            FieldProgress fields = read_fields(file, header.at("fields"));
            file.expect_hash();
            return {render, choice, {SeriesMoments(0, 0, 0), Tally(0), {}}, std::move(fields)};
        }
        const Json& picture = header.at("picture");
        RenderedSeries series{{picture.at(0), picture.at(1), picture.at(2)}, tally_from(header.at("tally")), {}};
        std::vector<SeriesMoments::Node> nodes;
        for (const Json& node : header.at("nodes"))
            nodes.push_back({node.at(0), node.at(1),
                             std::make_shared<std::vector<double>>(file.numbers<double>(node.at(2).get<std::uint64_t>()))});
        series.moments.set(std::move(nodes), {file.numbers<SampleRange>(header.at("ranges").get<std::uint64_t>())});
        const std::size_t rows = header.at("checkpoints").at(0), terms = header.at("checkpoints").at(1);
        series.convergence = checkpoints_from(file.numbers<double>(rows * (5 + 2 * terms)), rows, terms);
        header.at("samples").get_to(series.samples);
        header.at("seconds").get_to(series.seconds);
        series.merged = merged_from(header.at("merged"));
        header.at("replicate_size").get_to(series.replicate_size);
        file.expect_hash();
        return {render, choice, std::move(series)};
    } catch (const Json::exception& e) {
        damaged(path, e.what());
    }
}

}  // namespace neumann
