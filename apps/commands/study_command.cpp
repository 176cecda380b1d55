#include "apps/commands/study_command.h"

#include "apps/commands/interrupt.h"
#include "apps/commands/limits.h"
#include "apps/commands/parse_definitions.h"
#include "apps/commands/study_runs.h"
#include "apps/files/output_folder.h"
#include "apps/processes/launch.h"
#include "core/base/error.h"
#include "core/base/stopwatch.h"
#include "core/reader/read_scene.h"
#include "operators/methods/bounces.h"
#include "operators/study/reference_choice.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>

namespace neumann {

namespace {

// Throws InputError where one is unknown, given twice, or there is none.
std::vector<StudyMethod> study_methods(const StudyRequest& request) {
    std::vector<StudyMethod> methods;
    for (const std::string& name : request.methods) {
        if (std::any_of(methods.begin(), methods.end(), [&](const StudyMethod& m) { return m.name == name; }))
            throw InputError(fmt::format("--methods: '{}' is given twice", name));
        if (const auto own = request.own.find(name); own != request.own.end()) {
            methods.push_back({name, method::Walk{}, own->second});
            continue;
        }
        try {
            methods.push_back({name, studied_method(name)});
        } catch (const InputError& e) {
            throw InputError(fmt::format("--methods {}", e.what()));
        }
    }
    return methods;
}

using Json = nlohmann::ordered_json;

void expect_growing(const char* option, const auto& values) {
    for (std::size_t i = 1; i < values.size(); ++i)
        if (!(values[i] > values[i - 1]))
            throw InputError(fmt::format("{}: {:g} after {:g}; budgets have to grow", option, static_cast<double>(values[i]),
                                         static_cast<double>(values[i - 1])));
}

// Everything that must be unchanged to resume an interrupted study.
Json identity(const StudyRequest& request, const Scene& scene) {
    Json json;
    json["scene"] = scene.hash;
    json["definitions"] = request.definitions;
    json["methods"] = request.methods;
    json["budgets"] = request.budgets;
    json["samples"] = request.samples;
    json["repeats"] = request.repeats;
    json["bounces"] = request.bounces ? Json(*request.bounces) : Json(nullptr);
    json["seed"] = request.seed;
    json["reference"] = request.reference;
    json["version"] = NEUMANN_VERSION;
    return json;
}

Json as_json(const StudyPlan& plan, int bounces) {
    Json json = {{"bounces", bounces}, {"budgets", plan.budgets}, {"reference_samples", plan.reference_samples}};
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

void expect_sense(const StudyRequest& request) {
    if (request.repeats < 2) throw InputError("--repeats 1: a variance takes at least 2 repeats");
    if (!request.budgets.empty() && !request.samples.empty())
        throw InputError("--budgets and --samples exclude each other: seconds of a run, or samples a pixel");
    expect_growing("--budgets", request.budgets);
    expect_growing("--samples", request.samples);
}

// Shows on a terminal what is being done.
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

StudyEnd run_study(StudyRequest request, const Scene& scene, double scene_seconds, const StudyStatus& status,
                   const std::function<void(const StudyData&, const std::vector<StudiedPicture>&, const Json&)>& found) {
    expect_sense(request);
    const std::vector<StudyMethod> methods = study_methods(request);
    OutputFolder folder(request.output, "study");
    StudyJournal journal(folder.path(), request.resume);
    const Json study = identity(request, scene);
    if (request.resume)
        journal.expect_same(study);
    else
        folder.forget();  // of another study, whose journal was removed

    const Stopwatch pilot_watch;
    const Pilot pilot(scene, {}, request.seed);
    StudyData data{request, methods, scene, pilot, 0, {}, {}, scene_seconds, 0.0, true, {}, false};
    data.pilot_seconds = pilot_watch.seconds();
    data.bounces = request.resume    ? journal.plan.at("bounces").get<int>()
                   : request.bounces ? *request.bounces
                                     : scene.bounces.value_or(default_bounces(pilot));
    auto reference = given_reference(request, scene.film, data.bounces);

    const auto nothing_done = [&] {
        throw RunError("interrupted before the first run: nothing was written");
        return StudyEnd{};
    };
    if (request.resume) {
        data.plan = study_plan(journal.plan, !request.samples.empty());
    } else {
        status("short runs that measure how fast the methods are", 0.0);
        auto plan = plan_study({request.budgets, request.samples, request.reference_samples}, methods, data.bounces, request.seed,
                               scene, pilot, {.stop = interrupted, .crew = request.crew});
        if (!plan) return nothing_done();
        data.plan = std::move(*plan);
    }
    std::string choice;
    if (request.resume) {
        choice = journal.plan.at("choice");
        if (request.reference.empty()) request.reference = journal.plan.at("reference").at("method");
    } else if (request.reference.empty()) {
        auto chosen = choose_reference(scene, pilot, data.bounces, {.stop = interrupted, .crew = request.crew});
        if (!chosen) return nothing_done();
        request.reference = chosen->method;
        choice = chosen->why;
    }
    const auto begin = [&](const Json& of_reference) {
        if (!journal.study.is_null()) return;
        data.plan.reference_samples = of_reference.value("samples", data.plan.reference_samples);
        expect_disk_space(data, folder.path());
        Json plan = as_json(data.plan, data.bounces);
        plan["reference"] = of_reference;
        plan["choice"] = choice;
        journal.begin(study, plan);
    };
    if (!reference) reference = make_reference(request, data.plan.reference_samples, scene, pilot, data.bounces, folder, begin);
    if (!reference) return {false, 0, data.runs()};
    data.reference = std::move(*reference);
    data.reference.choice = choice;
    for (const Estimate& picture : data.reference.pictures) PictureErrors check(picture);
    begin(data.reference.identity);
    if (journal.plan.at("reference") != data.reference.identity)
        throw InputError("--resume: the reference is another one than that of the study that was cut off");

    run_all(data, journal, folder, status);
    const Film& film = scene.film;
    data.points = study_points(journal.runs, data.plan, data.reference.pictures, [&](std::size_t n, std::size_t q) {
        return journal.picture(n, q, film.crop_width, film.crop_height, data.pictures());
    });
    const auto pictures = summarise(data.points, data.plan, data.reference.pictures, request.error);
    if (!pictures.empty()) {
        const Json json = study_json(data, pictures);
        folder.write("study.csv", study_csv(data));
        folder.write("study.json", json.dump(2) + "\n");
        folder.write("index.html", study_page(json));
        folder.commit();
        found(data, pictures, json);
    }
    if (data.complete) journal.remove();
    return {data.complete, journal.runs.size(), data.runs()};
}

int study_command(const StudyRequest& given) {
    StudyRequest request = given;
    request.definitions = parse_definitions(request.definition_texts);
    if (request.output.empty())
        request.output =
            (std::filesystem::path("out") / (std::filesystem::path(request.scene).stem().string() + "-study")).string();
    expect_sense(request);
    study_methods(request);  // before the scene is read
    catch_interrupts();
    const ThreadLimit threads(threads_of_process(request.threads));

    const Stopwatch scene_watch;
    const Scene scene = read_scene(request.scene, request.definitions, {.lenient = request.lenient});
    const auto crew = launched_crew(
        {std::filesystem::absolute(request.scene).string(), request.definitions, request.lenient, scene.hash}, request.threads);
    request.crew = crew.get();
    std::optional<Status> status(std::in_place, request.quiet);
    const auto show = [&](const std::string& what, double) { status->show(what); };
    const auto print = [&](const StudyData& data, const std::vector<StudiedPicture>& pictures, const Json& json) {
        status.reset();
        if (request.json)
            fmt::print("{}\n", json.dump(2));
        else if (!request.quiet)
            print_study(data, pictures);
    };
    const StudyEnd end = run_study(request, scene, scene_watch.seconds(), show, print);
    status.reset();
    if (!end.complete && !request.quiet)
        fmt::print(stderr, "Interrupted: {} of {} runs are done; the same command with --resume goes on.\n", end.done, end.runs);
    return 0;
}

}  // namespace neumann
