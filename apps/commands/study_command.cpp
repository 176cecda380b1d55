#include "apps/commands/study_command.h"

#include "apps/output/files/json_text.h"
#include "apps/output/files/output_folder.h"
#include "apps/output/study/study_runs.h"
#include "apps/processes/launch.h"
#include "core/base/error.h"
#include "core/base/interrupt.h"
#include "core/base/limits.h"
#include "core/base/stopwatch.h"
#include "operators/experiments/study/methods_for_scene.h"
#include "operators/experiments/study/reference_choice.h"
#include "operators/experiments/study/repeats.h"
#include "operators/render/methods/bounces.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdio>
#include <filesystem>
#include <set>

namespace neumann {

namespace {

// Reads the methods. Throws InputError if one is unknown, given twice, or there is none.
std::vector<StudyMethod> study_methods(const StudyRequest& request, const std::map<std::string, OwnEstimator>& own) {
    std::vector<StudyMethod> methods;
    for (const std::string& name : request.methods) {
        if (std::any_of(methods.begin(), methods.end(), [&](const StudyMethod& m) { return m.name == name; }))
            throw OptionError("methods", fmt::format(": '{}' is given twice", name));
        if (const auto found = own.find(name); found != own.end()) {
            methods.push_back({name, method::Walk{}, found->second});
            continue;
        }
        try {
            methods.push_back({name, studied_method(name)});
        } catch (const InputError& e) {
            throw OptionError("methods", fmt::format("{}", e.what()));
        }
    }
    return methods;
}

// Reads a crop. Throws InputError unless it is within the picture.
Crop read_crop(const std::string& text, const Film& film) {
    std::array<int, 4> values{};
    const char *at = text.data(), *const end = at + text.size();
    std::size_t read = 0;
    for (int& value : values) {
        const auto [next, error] = std::from_chars(at, end, value);
        if (error != std::errc() || (read < 3 ? next == end || *next != ',' : next != end)) break;
        at = next + 1;
        ++read;
    }
    const auto [x, y, width, height] = values;
    const bool fits = x >= 0 && y >= 0 && width > 0 && height > 0 && width <= film.crop_width - x && height <= film.crop_height - y;
    if (read < 4 || !fits)
        throw OptionError("crop", fmt::format("{}: expected X,Y,WIDTH,HEIGHT within the picture's {}×{} pixels, as in 0,0,{},{}",
                                              text, film.crop_width, film.crop_height, film.crop_width, film.crop_height));
    return {x, y, width, height};
}

// "1 min 20 s"
std::string duration(double seconds) {
    if (seconds < 9.95) return fmt::format("{:.1f} s", seconds);
    const auto whole = static_cast<long>(std::lround(seconds));
    if (whole < 60) return fmt::format("{} s", whole);
    return whole < 3600 ? fmt::format("{} min {} s", whole / 60, whole % 60)
                        : fmt::format("{} h {} min", whole / 3600, whole % 3600 / 60);
}

using Json = nlohmann::ordered_json;

void expect_growing(const char* option, const auto& values) {
    for (std::size_t i = 1; i < values.size(); ++i)
        if (!(values[i] > values[i - 1]))
            throw OptionError(option, fmt::format(": {:g} after {:g}; budgets have to grow", static_cast<double>(values[i]),
                                                  static_cast<double>(values[i - 1])));
}

// Everything that must be unchanged to resume an interrupted study.
Json identity(const StudyRequest& request, const Scene& scene) {
    Json json = {{"scene", scene.hash}, {"version", NEUMANN_VERSION}};
    const std::set<std::string> free{"scene", "lenient", "error", "crop", "checkpoint", "reference-spp"};
    for (const Option<StudyRequest>& o : study_options().all)
        if (o.lasts && !free.contains(o.name)) json[o.name] = fmt::format("{}", fmt::join(o.texts(request), ","));
    return json;
}

Json as_json(const StudyPlan& plan, int bounces, std::size_t repeats, const std::vector<std::string>& methods,
             const std::vector<std::string>& left_out) {
    Json json = {{"bounces", bounces}, {"budgets", plan.budgets}, {"reference_samples", plan.reference_samples}};
    json["repeats"] = repeats;
    json["methods"] = methods;
    json["left_out"] = left_out;
    json["efforts"] = Json::array();
    for (const auto& efforts : plan.efforts) {
        Json& method = json["efforts"].emplace_back(Json::array());
        for (const Effort& e : efforts) method.push_back({e.samples, e.patches.value_or(0), e.directions.value_or(0)});
    }
    return json;
}

StudyPlan study_plan(const Json& json, bool budgets_are_samples) {
    StudyPlan plan;
    plan.budgets_are_samples = budgets_are_samples;
    json.at("budgets").get_to(plan.budgets);
    json.at("reference_samples").get_to(plan.reference_samples);
    for (const Json& method : json.at("efforts")) {
        std::vector<Effort>& efforts = plan.efforts.emplace_back();
        for (const Json& e : method) {
            Effort& effort = efforts.emplace_back(Effort{e.at(0)});
            if (e.at(1) != 0) effort.patches = e.at(1).get<std::size_t>();
            if (e.at(2) != 0) effort.directions = e.at(2).get<std::uint32_t>();
        }
    }
    return plan;
}

// The number of crops that the page shows where methods differ most.
constexpr std::size_t found_crops = 3;

void expect_sense(const StudyRequest& request) {
    if (request.repeats < 2) throw OptionError("repeats", " 1: a variance takes at least 2 repeats");
    if (!request.budgets.empty() && !request.samples.empty())
        throw OptionError("budgets", " and --samples exclude each other: seconds of a run, or samples a pixel");
    expect_growing("budgets", request.budgets);
    expect_growing("samples", request.samples);
}

// "3 methods, 4 budgets and 16 repeats take about 1 min 20 s, the reference at most 20 s more".
std::string what_it_takes(const StudyData& data, bool makes_reference) {
    const auto counted = [](std::size_t n, const char* what) { return fmt::format("{} {}{}", n, what, n == 1 ? "" : "s"); };
    std::string text = fmt::format("{}, {} and {}", counted(data.methods.size(), "method"),
                                   counted(data.plan.budgets.size(), "budget"), counted(data.request.repeats, "repeat"));
    if (data.request.interval) text += fmt::format(" (for ± {:g}% of the sum's RMSE)", 100.0 * *data.request.interval);
    text += " take about " + duration(static_cast<double>(data.request.repeats) * data.plan.repeat_seconds);
    if (makes_reference) text += fmt::format(", the reference at most {} more", duration(data.plan.reference_seconds));
    return text;
}

class Status {
public:
    explicit Status(bool quiet) : active_(!quiet && isatty(STDERR_FILENO)) {}
    ~Status() { show(""); }
    void show(const std::string& text) const {
        if (!active_) return;
        fmt::print(stderr, "\r\033[K{}", text);
        std::fflush(stderr);
    }

private:
    bool active_;
};

}  // namespace

StudyEnd run_study(StudyRequest request, const std::map<std::string, OwnEstimator>& own, Crew* crew, const Scene& scene,
                   double scene_seconds, const StudyStatus& status,
                   const std::function<void(const StudyData&, const std::vector<StudiedPicture>&, const Json&)>& found) {
    expect_sense(request);
    std::vector<StudyMethod> methods = study_methods(request, own);
    std::vector<Crop> crops;
    for (const std::string& text : request.crops) crops.push_back(read_crop(text, scene.film));
    OutputFolder folder(request.output, "study");
    StudyJournal journal(folder.path(), request.resume);
    const Json study = identity(request, scene);
    if (request.resume) {
        journal.expect_same(study);
        journal.plan.at("methods").get_to(request.methods);
        journal.plan.at("repeats").get_to(request.repeats);
        methods = study_methods(request, own);
    } else {
        folder.forget();  // removes the state of another study, whose journal was removed
    }

    const Stopwatch pilot_watch;
    const std::optional<int> given = request.resume    ? journal.plan.at("bounces").get<int>()
                                     : request.bounces ? std::optional(request.bounces->last)
                                                       : scene.bounces;
    const Pilot pilot(scene, {}, request.seed, given.value_or(0));
    StudyData data{request, methods, scene, pilot, crew, 0, {}, {}, scene_seconds, 0.0, true, {}, {}, {}, false};
    data.pilot_seconds = pilot_watch.seconds();
    data.bounces = given ? *given : default_bounces(pilot);
    if (request.bounces) data.first_bounce = request.bounces->first;
    auto reference = given_reference(request, scene.film, data.bounces);

    const auto nothing_done = [&] {
        throw RunError("interrupted before the first run: nothing was written");
        return StudyEnd{};
    };
    if (request.resume) {
        data.plan = study_plan(journal.plan, !request.samples.empty());
        journal.plan.at("left_out").get_to(data.left_out);
    } else {
        const Watch watch{.stop = interrupted, .crew = crew};
        if (methods.empty()) {
            status("short runs that find which methods can do the scene", 0.0);
            auto found = methods_for_scene(data.bounces, request.seed, scene, pilot, watch);
            if (!found) return nothing_done();
            methods = std::move(found->methods);
            data.left_out = std::move(found->left_out);
            for (const StudyMethod& method : methods) request.methods.push_back(method.name);
        }
        status("short runs that measure how fast the methods are", 0.0);
        auto plan = plan_study({request.budgets, request.samples, request.reference_samples}, methods, data.bounces, request.seed,
                               scene, pilot, watch);
        if (!plan) return nothing_done();
        data.plan = std::move(*plan);
        if (request.interval) {
            status("short runs that measure how many repeats the interval takes", 0.0);
            const auto deviation = deviation_of_repeats(methods, data.bounces, request.seed, scene, pilot, watch);
            if (!deviation) return nothing_done();
            request.repeats = repeats_for(*deviation, *request.interval);
        }
    }
    std::string choice;
    if (request.resume) {
        choice = journal.plan.at("choice");
        if (request.reference.empty()) request.reference = journal.plan.at("reference").at("method");
    } else if (request.reference.empty()) {
        auto chosen = choose_reference(scene, pilot, data.bounces, {.stop = interrupted, .crew = crew});
        if (!chosen) return nothing_done();
        request.reference = chosen->method;
        choice = chosen->why;
    }
    const auto begin = [&](const Json& of_reference) {
        if (!journal.study.is_null()) return;
        data.plan.reference_samples = of_reference.value("samples", data.plan.reference_samples);
        expect_disk_space(data, folder.path());
        Json plan = as_json(data.plan, data.bounces, request.repeats, request.methods, data.left_out);
        plan["reference"] = of_reference;
        plan["choice"] = choice;
        journal.begin(study, plan);
    };
    const bool makes_reference = !reference;
    const auto tell = [&] {
        if (!request.resume && !request.quiet) fmt::print(stderr, "{}\n", what_it_takes(data, makes_reference));
    };
    if (makes_reference) {
        tell();
        reference = make_reference(request, data.plan.reference_samples, scene, pilot, data.bounces, folder, crew, begin);
    }
    if (!reference) return {false, 0, data.runs()};
    data.reference = std::move(*reference);
    data.reference.choice = choice;
    for (const Estimate& picture : data.reference.pictures) PictureErrors check(picture);
    begin(data.reference.identity);
    if (journal.plan.at("reference") != data.reference.identity)
        throw OptionError("resume", ": the reference is another one than that of the study that was cut off");

    if (!makes_reference) tell();
    run_all(data, journal, folder, status);
    const Film& film = scene.film;
    const auto picture = [&](std::size_t n, std::size_t q) {
        return journal.picture(n, q, film.crop_width, film.crop_height, data.pictures_of_run());
    };
    if (data.first_bounce) data.reference.pictures.push_back(together(data.reference.pictures, data.of_verdict()));
    data.points = study_points(
        journal.runs, data.plan, data.reference.pictures,
        [&](std::size_t n, std::size_t q) {
            if (q < data.pictures_of_run()) return picture(n, q);
            std::vector<Image> parts;
            for (std::size_t i = data.of_verdict().first; i <= data.of_verdict().last; ++i) parts.push_back(picture(n, i));
            return stacked(parts);
        },
        data.of_verdict());
    const auto pictures = summarise(data.points, data.plan, data.reference.pictures, request.error);
    if (!pictures.empty()) {
        data.crops = compare_crops(journal.runs, data.points, data.plan, data.reference.pictures[data.sum()], crops, found_crops,
                                   [&](std::size_t n) { return picture(n, data.sum()); });
        const Json json = study_json(data, pictures);
        folder.write("study.csv", study_csv(data));
        folder.write("study.json", json_text(json, 2) + "\n");
        folder.write("index.html", study_page(data, json));
        write_figures(folder, data, pictures);
        folder.commit();
        found(data, pictures, json);
    }
    if (data.complete) journal.remove();
    return {data.complete, journal.runs.size(), data.runs()};
}

int study_command(const StudyRequest& given) {
    StudyRequest request = given;
    if (request.output.empty())
        request.output =
            (std::filesystem::path("out") / (std::filesystem::path(request.scene.path).stem().string() + "-study")).string();
    expect_sense(request);
    study_methods(request, {});  // throws before the scene is read
    const ThreadLimit threads(threads_of_process(request.threads));

    const Stopwatch scene_watch;
    const Scene scene = read_scene(request.scene);
    catch_interrupts();
    const auto crew = launched_crew(request.scene, scene, request.threads);
    std::optional<Status> status(std::in_place, request.quiet);
    const auto show = [&](const std::string& what, double) { status->show(what); };
    const auto print = [&](const StudyData& data, const std::vector<StudiedPicture>& pictures, const Json& json) {
        status.reset();
        if (request.json)
            fmt::print("{}\n", json_text(json, 2));
        else if (!request.quiet)
            print_study(data, pictures);
    };
    const StudyEnd end = run_study(request, {}, crew.get(), scene, scene_watch.seconds(), show, print);
    status.reset();
    if (!end.complete && !request.quiet)
        fmt::print(stderr, "Interrupted: {} of {} runs are done; the same command with --resume goes on.\n", end.done, end.runs);
    return 0;
}

}  // namespace neumann
