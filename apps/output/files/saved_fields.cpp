#include "apps/output/files/saved_fields.h"

namespace neumann {

namespace {

using Json = nlohmann::ordered_json;

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

}  // namespace

Json as_json(const FieldProgress& progress, std::vector<std::string_view>& numbers) {
    Json json = {{"settings", as_json(progress.settings)},
                 {"seconds", {progress.seconds, progress.field_seconds, progress.picture_seconds}},
                 {"series", Json::array()},
                 {"read", Json::array()}};
    for (const SavedSeries& series : progress.series) {
        Json power = Json::array();
        for (const PowerOfTerm& p : series.power) power.push_back({p.emitted, p.left, p.caught, p.absorbed});
        json["series"].push_back({{"floats", series.size()},
                                  {"has_links", series.has_links},
                                  {"rest_converges", series.rest_converges},
                                  {"rays", series.rays},
                                  {"light_rays", series.light_rays},
                                  {"power", std::move(power)}});
        for (const std::span<const float> of : series.fields) numbers.push_back(bytes_of(of.data(), of.size()));
    }
    for (const FieldProgress::Read& read : progress.read) {
        json["read"].push_back({read.begin, read.end, read.rays, read.values.size()});
        numbers.push_back(bytes_of(read.values.data(), read.values.size()));
    }
    return json;
}

FieldProgress fields_from(const Json& json, StateFile& file) {
    FieldProgress progress;
    progress.settings = settings_from(json.at("settings"));
    const Json& seconds = json.at("seconds");
    seconds.at(0).get_to(progress.seconds);
    seconds.at(1).get_to(progress.field_seconds);
    seconds.at(2).get_to(progress.picture_seconds);
    for (const Json& series_json : json.at("series")) {
        SavedSeries series;
        series_json.at("has_links").get_to(series.has_links);
        series_json.at("rest_converges").get_to(series.rest_converges);
        series_json.at("rays").get_to(series.rays);
        series_json.at("light_rays").get_to(series.light_rays);
        for (const Json& p : series_json.at("power")) series.power.push_back({p.at(0), p.at(1), p.at(2), p.at(3)});
        series.numbers = file.numbers<float>(series_json.at("floats").get<std::uint64_t>());
        series.fields = {series.numbers};
        progress.series.push_back(std::move(series));
    }
    std::uint64_t size = 0;
    for (const Json& read : json.at("read")) size += read.at(3).get<std::uint64_t>();
    progress.values = file.numbers<float>(size);
    const float* next = progress.values.data();
    for (const Json& read : json.at("read")) {
        const auto count = read.at(3).get<std::size_t>();
        progress.read.push_back({read.at(0), read.at(1), read.at(2), {next, count}});
        next += count;
    }
    return progress;
}

}  // namespace neumann
