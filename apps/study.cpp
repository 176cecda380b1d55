#include "apps/study.h"

#include "apps/interrupt.h"
#include "apps/options.h"
#include "apps/output_folder.h"
#include "apps/study_journal.h"
#include "core/base/error.h"
#include "core/base/peak_memory.h"
#include "core/base/stopwatch.h"
#include "core/reader/read_scene.h"

#include <fmt/format.h>
#include <oneapi/tbb/global_control.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>

namespace neumann {

namespace {

using Json = nlohmann::ordered_json;

void expect_growing(const char* option, const auto& values) {
    for (std::size_t i = 1; i < values.size(); ++i)
        if (!(values[i] > values[i - 1]))
            throw InputError(fmt::format("{}: {:g} after {:g}; budgets have to grow", option, static_cast<double>(values[i]),
                                         static_cast<double>(values[i - 1])));
}

// What must be the same to go on with a study that was cut off.
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

StudyRun make_run(const RenderResult& result, const RenderRequest& request) {
    const SeriesReport& report = result.series.report;
    StudyRun run;
    run.seed = request.seed;
    run.samples = result.series.samples;
    run.patches = request.patches.value_or(0);
    run.directions = request.directions.value_or(0);
    run.setup_seconds = result.series.setup_seconds;
    run.seconds = result.series.seconds;
    for (const BounceReport& b : report.bounces) {
        run.rays.push_back(b.rays);
        run.mean.push_back(b.mean.mean);
        if (b.discretisation) run.discretisation.push_back(b.discretisation->relative);
        run.variance += b.infinite_variance ? 'i' : b.tail ? 'f' : '?';
    }
    run.mean.push_back(report.sum.mean);
    if (report.sum_discretisation) run.discretisation.push_back(report.sum_discretisation->relative);
    for (const auto& [text, count] : result.warnings.counts()) run.warnings.push_back(text);
    return run;
}

// On a terminal, what is being done.
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

// Goes on until everything is done or it is interrupted. Repeat after repeat, so that what else the machine does meets all methods
// and budgets alike, and so that a study that is cut off has something of everything.
void run_all(StudyData& data, StudyJournal& journal) {
    const Status status(data.request.quiet);
    const std::size_t N = data.pictures() - 2, methods = data.methods.size(), budgets = data.plan.budgets.size();
    while (journal.runs.size() < data.runs()) {
        const std::size_t at = journal.runs.size(), method = at % methods, budget = at / methods % budgets,
                          repeat = at / methods / budgets;
        status.show(fmt::format("run {} of {}   repeat {}   budget {:g}   {}", at + 1, data.runs(), repeat + 1,
                                data.plan.budgets[budget], data.methods[method].name));
        const Effort& effort = data.plan.efforts[method][budget];
        const std::uint64_t seed = study_seed(data.request.seed, method, budget, repeat);
        data.peak_is_of_run = restart_peak_memory();
        const auto result = run_method(data.methods[method], effort, data.bounces, seed, data.scene, data.pilot);
        if (!result) return;
        StudyRun run = make_run(*result, run_request(data.methods[method], effort, data.bounces, seed));
        run.peak_memory = peak_memory();
        run.method = method;
        run.budget = budget;
        run.repeat = repeat;
        std::vector<Image> pictures;
        for (std::size_t i = 0; i <= N; ++i) pictures.push_back(result->series.term(i).mean);
        pictures.push_back(result->series.sum(N).mean);
        journal.add(run, pictures);
        if (interrupted()) return;
    }
    data.complete = true;
}

std::vector<StudyPoint> judge(const StudyData& data, const StudyJournal& journal) {
    const Film& film = data.scene.film;
    std::vector<StudyPoint> points;
    for (std::size_t budget = 0; budget < data.plan.budgets.size(); ++budget)
        for (std::size_t method = 0; method < data.methods.size(); ++method) {
            StudyPoint point;
            std::vector<std::size_t> places;
            for (std::size_t i = 0; i < journal.runs.size(); ++i) {
                if (journal.runs[i].method != method || journal.runs[i].budget != budget) continue;
                point.runs.push_back(journal.runs[i]);
                places.push_back(i);
            }
            if (places.size() < 2) continue;
            for (std::size_t q = 0; q < data.pictures(); ++q) {
                PictureErrors picture(data.reference.pictures[q]);
                for (const std::size_t i : places)
                    picture.add(journal.picture(i, q, film.crop_width, film.crop_height, data.pictures()));
                point.errors.push_back(picture.statistics());
            }
            points.push_back(std::move(point));
        }
    return points;
}

// The pictures of all runs are kept until the end.
void expect_disk_space(const StudyData& data, const std::filesystem::path& folder) {
    const double bytes = static_cast<double>(data.runs()) * static_cast<double>(data.pictures()) * data.scene.film.crop_width *
                         data.scene.film.crop_height * 3.0 * sizeof(float);
    std::error_code error;
    const auto space = std::filesystem::space(folder, error);
    if (!error && bytes > 0.9 * static_cast<double>(space.available))
        throw InputError(fmt::format(
            "{}: {} runs need {:.1f} GiB there until the study ends, and {:.1f} are free; take fewer repeats or a smaller film",
            folder.string(), data.runs(), bytes / 0x1p30, static_cast<double>(space.available) / 0x1p30));
}

void expect_sense(const StudyRequest& request) {
    if (request.repeats < 2) throw InputError("--repeats 1: a variance takes at least 2 repeats");
    if (!request.budgets.empty() && !request.samples.empty())
        throw InputError("--budgets and --samples exclude each other: seconds of a run, or samples a pixel");
    expect_growing("--budgets", request.budgets);
    expect_growing("--samples", request.samples);
}

}  // namespace

CLI::App* add_study(CLI::App& app, StudyRequest& request) {
    auto* study = app.add_subcommand("study", "Compare methods: error against time, bounce by bounce");
    study->add_option("SCENE", request.scene, "Mitsuba 3 scene file")->required();
    study
        ->add_option("--methods", request.methods,
                     "Methods with options of render after colons: walk,walk:direct=light:sampler=independent,matrix")
        ->type_name("A,B,...")
        ->delimiter(',')
        ->required();
    study->add_option("-o", request.output, "Folder for tables and page; out/NAME-study without it")->type_name("DIR");
    study
        ->add_option("--reference", request.reference,
                     "What is true: the folder of an earlier render, values:A,B,... for bounces of one colour each, or an unbiased "
                     "method that makes a reference with a seed of its own, which is kept in the cache")
        ->type_name("R")
        ->capture_default_str();
    study
        ->add_option("--reference-spp", request.reference_samples,
                     "Samples a pixel of a reference that is made; 16 times those of walk at the largest budget without it")
        ->type_name("N")
        ->check(whole_from(4, std::uint64_t{1} << 40));
    study->add_option("--budgets", request.budgets, "Seconds of a run, growing; chosen without it")
        ->type_name("S,S,...")
        ->delimiter(',')
        ->check(above_zero());
    study->add_option("--samples", request.samples, "Instead of --budgets: samples a pixel of a run, growing")
        ->type_name("N,N,...")
        ->delimiter(',')
        ->check(whole_from(1, std::uint64_t{1} << 40));
    study->add_option("--repeats", request.repeats, "Runs of each method at each budget, with other seeds")
        ->type_name("N")
        ->check(whole_from(1, 100000))
        ->capture_default_str();
    study->add_option("-n", request.bounces, "The last bounce that is looked at")
        ->type_name("BOUNCES")
        ->check(whole_from(0, 100000));
    study
        ->add_option("--error", request.error,
                     "Relative RMSE for the time to a given error; without it the smallest that all methods reach")
        ->type_name("REL")
        ->check(above_zero());
    study->add_flag("--resume", request.resume, "Go on with a study that was cut off");
    study->add_option("--seed", request.seed, "Seed that the seeds of all runs come from")
        ->type_name("N")
        ->check(whole_from(0, ~std::uint64_t{0}))
        ->capture_default_str();
    study->add_option("-t", request.threads, "Threads; all without it")->type_name("THREADS")->check(whole_from(1, 4096));
    add_definitions(*study, request.definition_texts);
    study->add_flag("--quiet", request.quiet, "Print nothing but errors");
    study->add_flag("--json", request.json, "Print study.json");
    return study;
}

int study_command(const StudyRequest& given) {
    StudyRequest request = given;
    request.definitions = parse_definitions(request.definition_texts);
    if (request.output.empty())
        request.output =
            (std::filesystem::path("out") / (std::filesystem::path(request.scene).stem().string() + "-study")).string();
    expect_sense(request);
    const std::vector<StudyMethod> methods = study_methods(request);
    catch_interrupts();
    std::optional<oneapi::tbb::global_control> threads;
    if (request.threads > 0)
        threads.emplace(oneapi::tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(request.threads));

    const Stopwatch scene_watch;
    const Scene scene = read_scene(request.scene, request.definitions);
    const double scene_seconds = scene_watch.seconds();
    OutputFolder folder(request.output);
    StudyJournal journal(folder.path(), request.resume);
    const Json study = identity(request, scene);
    if (request.resume) journal.expect_same(study);

    const Stopwatch pilot_watch;
    const Pilot pilot(scene, {}, request.seed);
    StudyData data{request, methods, scene, pilot, 0, {}, {}, scene_seconds, 0.0, true, {}, false};
    data.pilot_seconds = pilot_watch.seconds();
    RenderRequest any;
    any.bounces = request.bounces;
    data.bounces = request.resume ? journal.plan.at("bounces").get<int>() : choose_bounces({any, scene, pilot});
    auto reference = given_reference(request, scene.film, data.bounces);

    const auto nothing_done = [&] {
        throw RunError("interrupted before the first run: nothing was written");
        return 1;
    };
    if (request.resume) {
        data.plan = study_plan(journal.plan, !request.samples.empty());
    } else {
        auto plan = plan_study(request, methods, scene, pilot, data.bounces);
        if (!plan) return nothing_done();
        data.plan = std::move(*plan);
    }
    if (!reference) reference = make_reference(request, data.plan.reference_samples, scene, pilot, data.bounces);
    if (!reference) return nothing_done();
    data.reference = std::move(*reference);
    if (request.resume) {
        if (journal.plan.at("reference") != data.reference.identity)
            throw InputError("--resume: the reference is another one than that of the study that was cut off");
    } else {
        data.plan.reference_samples = data.reference.identity.value("samples", data.plan.reference_samples);
        expect_disk_space(data, folder.path());
        Json plan = as_json(data.plan, data.bounces);
        plan["reference"] = data.reference.identity;
        journal.begin(study, plan);
    }
    for (const Estimate& picture : data.reference.pictures) PictureErrors check(picture);

    run_all(data, journal);
    data.points = judge(data, journal);
    const auto pictures = summarise(data);
    if (!pictures.empty()) {
        const Json json = study_json(data, pictures);
        folder.write("study.csv", study_csv(data));
        folder.write("study.json", json.dump(2) + "\n");
        folder.write("index.html", study_page(json));
        folder.commit();
        if (request.json)
            fmt::print("{}\n", json.dump(2));
        else if (!request.quiet)
            print_study(data, pictures);
    }
    if (data.complete)
        journal.remove();
    else if (!request.quiet)
        fmt::print(stderr, "Interrupted: {} of {} runs are done; the same command with --resume goes on.\n", journal.runs.size(),
                   data.runs());
    return 0;
}

}  // namespace neumann
