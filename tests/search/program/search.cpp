// Searches for scenes that fail: makes small ones by chance, renders each by several methods in processes of their own, and tells
// where one crashes, hangs, gives what is no number, or differs from the others by more than its error and its stated bias.
//
//     search --first 1 --count 1000 --folder found --shrink
//     search scene.xml --method walk --method matrix
//
// The number of a scene makes it and all its samples: the same scenes and the same verdicts everywhere. What differs is looked at
// three times, with other seeds and 4096, 131,072 and 524,288 samples of all pixels. Where both methods are right, and their means
// normal, one value in ten thousand goes on to the second look, one in a million passes that, and four in a hundred million the
// last: no false alarm is to be expected in ten thousand scenes. Means of rare paths are not normal: of what a method has not met
// it does not know, and such an alarm is to be looked at by somebody. The exit code is 1 if a scene fails that --known does not
// list, or one that it lists does not.
#include "tests/search/random_scene.h"
#include "tests/search/shrink.h"
#include "tests/search/trial.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/CLI.hpp>

#include <chrono>
#include <cstdio>
#include <fstream>
#include <limits>
#include <numeric>
#include <sstream>

namespace {

using namespace neumann::search;
namespace fs = std::filesystem;

struct Request {
    std::vector<std::string> scenes;
    std::uint64_t first = 1, count = 1;
    double seconds = std::numeric_limits<double>::infinity();
    std::vector<std::string> methods;
    bool shrink = false;
    std::string folder = "found", known;
};

double now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

constexpr double seconds_of_shrinking = 240.0;
// What takes most of the time is looked at in some of the scenes.
bool is_thorough(std::uint64_t number) { return number % 4 == 0; }
const char* const kinds[] = {"not read", "died", "not finite", "error", "differs"};

class Search {
public:
    explicit Search(Request request) : request_(std::move(request)) {
        fs::create_directories(request_.folder);
        if (request_.known.empty()) return;
        std::ifstream file(request_.known);
        for (std::string line; std::getline(file, line);) {
            std::istringstream words(line);
            std::string number, method;
            if (words >> number >> method && number[0] != '#') known_.emplace(number, method);
        }
    }

    int run() {
        const double end = now() + request_.seconds;
        for (const std::string& scene : request_.scenes) examine(scene, fs::absolute(scene), request_.methods, 0, true);
        for (std::uint64_t i = request_.first; request_.scenes.empty() && i < request_.first + request_.count && now() < end; ++i) {
            const RandomScene scene = random_scene(i);
            const fs::path folder = fs::path(request_.folder) / fmt::format("{}", i), path = folder / "scene.xml";
            fs::create_directories(folder);
            write_files(scene, folder);
            write(scene.xml, path);
            if (!examine(fmt::format("{}", i), path, request_.methods.empty() ? scene.methods : request_.methods, i, false))
                fs::remove_all(folder);
        }
        return summary();
    }

private:
    // Whether something was found.
    bool examine(const std::string& name, const fs::path& path, const std::vector<std::string>& methods, std::uint64_t seed,
                 bool reading) {
        std::vector<std::string> all = methods;
        if (all.empty())
            all = {"walk",       "bidirectional", "corrected", "guided", "light",
                   "matrix",     "gather",        "patches",   "photon", "cache:accuracy=0.4:directions=64",
                   "metropolis", "pointwise"};
        const Verdict verdict = try_scene({.scene = path, .methods = all, .seed = seed, .thorough = is_thorough(seed)});
        ++scenes_;
        seconds_ += verdict.seconds;
        again_ += verdict.looked_again ? 1 : 0;
        for (const auto& [method, seconds] : verdict.rendered) rendered_[method] += {1, seconds};
        for (const auto& [method, why] : verdict.refused) ++refused_[method];
        for (const Finding& finding : verdict.findings) {
            const bool is_known = known_.contains({name, finding.method});
            if (is_known) still_.emplace(name, finding.method);
            fmt::print("{} {} {}{} {}: {}{}\n", name, finding.method, kinds[static_cast<int>(finding.kind)],
                       finding.other.empty() ? "" : " from", finding.other, finding.what, is_known ? " (known)" : "");
            std::fflush(stdout);
            ++found_;
            unknown_ += is_known ? 0 : 1;
            if (request_.shrink && !is_known) shrink_it(path, finding, seed);
        }
        for (const auto& [number, method] : known_)
            if (number == name && !still_.contains({number, method})) {
                fmt::print("{} {} does not fail any more: strike it from the list\n", number, method);
                ++unknown_;
            }
        return !verdict.findings.empty() || reading;
    }

    void shrink_it(const fs::path& path, const Finding& finding, std::uint64_t seed) {
        pugi::xml_document scene;
        scene.load_file(path.c_str());
        const fs::path trying = path.parent_path() / "trying.xml",
                       smallest = path.parent_path() / fmt::format("smallest-{}.xml", finding.method);
        const bool differs = finding.kind == Finding::Kind::differs;
        std::vector<std::string> methods{finding.method};
        if (differs) methods = {finding.other, finding.method};
        const std::size_t look = differs ? 1 : 0;
        std::string what = finding.what;
        const auto fails = [&](const pugi::xml_document& smaller) {
            write(smaller, trying);
            for (const Finding& f : try_scene({trying, methods, seed, look, look, is_thorough(seed)}).findings)
                if (f.kind == finding.kind && (f.same_as(finding) || (differs && f.other == finding.method))) {
                    what = f.what;
                    return true;
                }
            return false;
        };
        const double end = now() + seconds_of_shrinking;
        shrink(scene, fails, [&] { return now() > end; });
        fs::remove(trying);
        write(scene, smallest);
        std::ostringstream text;
        scene.save(text, " ", pugi::format_raw);
        fmt::print("    {}\n    {}: {}\n", text.str(), smallest.string(), what);
        std::fflush(stdout);
    }

    int summary() const {
        fmt::print("{} scenes in {:.1f} s, {} looked at again, {} findings", scenes_, seconds_, again_, found_);
        if (!known_.empty()) fmt::print(", {} of them known", still_.size());
        fmt::print("\n");
        for (const auto& [method, work] : rendered_) {
            const auto refused = refused_.find(method);
            fmt::print("    {} rendered {} in {:.1f} s, refused {}\n", method, work.scenes, work.seconds,
                       refused == refused_.end() ? 0 : refused->second);
        }
        return unknown_ == 0 ? 0 : 1;
    }

    Request request_;
    std::set<std::pair<std::string, std::string>> known_, still_;  // number of the scene, method
    std::size_t scenes_ = 0, again_ = 0, found_ = 0, unknown_ = 0;
    double seconds_ = 0.0;
    struct Work {
        std::size_t scenes = 0;
        double seconds = 0.0;
        void operator+=(const Work& w) { scenes += w.scenes, seconds += w.seconds; }
    };
    std::map<std::string, Work> rendered_;
    std::map<std::string, std::size_t> refused_;
};

}  // namespace

int main(int argc, char** argv) {
    CLI::App app("Searches for scenes that fail.");
    Request request;
    app.add_option("SCENE", request.scenes, "Scenes to look at in place of random ones");
    app.add_option("--first", request.first, "The number of the first random scene")->capture_default_str();
    app.add_option("--count", request.count, "How many random scenes")->capture_default_str();
    app.add_option("--seconds", request.seconds, "Begin no scene after this time");
    app.add_option("--method", request.methods,
                   "Methods to compare, such as walk:direct=bsdf, the surest ones first; default: as the scene's number says")
        ->allow_extra_args(false);
    app.add_flag("--shrink", request.shrink, "Make each scene that fails as small as it can be");
    app.add_option("--folder", request.folder, "Where the scenes that fail are kept")->capture_default_str();
    app.add_option("--known", request.known,
                   "A file of failures that are known: the number of the scene, the method and why, a line each");
    CLI11_PARSE(app, argc, argv);
    return Search(std::move(request)).run();
}
