#include "tests/search/trial.h"

#include "core/base/stopwatch.h"
#include "core/reader/read_scene.h"
#include "tests/search/apart.h"
#include "tests/search/look.h"

#include <nlohmann/json.hpp>

#include <fmt/format.h>
#include <oneapi/tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <optional>

namespace neumann::search {

namespace {

// As unlikely as this a difference has to be, look by look, to be looked at again and in the end to be told; the last is that
// of 5.5 standard errors.
constexpr std::array<double, looks> unlikely{1e-4, 1e-6, 4e-8};
// What is missing of rare paths comes with more samples; what is wrong stays.
constexpr double part_that_stays = 0.5;
constexpr std::array<unsigned, looks> seconds_of_method{120, 240, 360};

class Examination {
public:
    Examination(const Trial& trial, Words& words) : trial_(trial), words_(words) {}

    void run() {
        limit_time(seconds_of_method.front());
        words_.say(R"({"begin": ""})");
        const Scene scene = read_scene(trial_.scene);
        film_ = scene.film;
        pilot_.emplace(scene, DirectLightSettings{}, trial_.seed);
        for (const std::string& method : trial_.methods) see(scene, method, trial_.first_look);
        std::vector<Pair> pairs = differing();
        while (!pairs.empty()) {
            const Pair pair = most_doubtful(pairs);
            const bool is_wrong = is_unmet(pair) ? stays_unmet(scene, pair) : stays(scene, pair);
            if (is_wrong) tell(scene, pair);
            // A method that is wrong accuses all others.
            std::erase_if(pairs, [&](const Pair& p) { return p.has(pair.method) && (is_wrong || p.has(pair.other)); });
        }
    }

private:
    struct Pair {
        std::string method, other;
        bool has(const std::string& m) const { return method == m || other == m; }
    };

    Look look_of(const std::string& method, std::size_t look) const {
        const auto index = static_cast<std::uint64_t>(std::ranges::find(trial_.methods, method) - trial_.methods.begin());
        return {look, trial_.seed * 1000 + look * 100 + index, trial_.thorough || look > trial_.first_look};
    }

    void say(const nlohmann::ordered_json& line) {
        words_.say(line.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
    }
    void say_finding(Finding::Kind kind, const std::string& method, const std::string& other, const std::string& what) {
        say({{"kind", static_cast<int>(kind)}, {"method", method}, {"other", other}, {"what", what}});
    }
    std::string command_of(const std::string& method, std::size_t look) const {
        return command(trial_.scene.filename(), film_, method, look_of(method, look));
    }

    // Null if the method does not take the scene.
    const Measured* see(const Scene& scene, const std::string& method, std::size_t look) {
        if (const auto known = seen_.find({method, look}); known != seen_.end()) return &known->second;
        say({{"begin", method}, {"command", command_of(method, look)}});
        limit_time(seconds_of_method[look]);
        const std::clock_t start = std::clock();
        try {
            Measured measured = look_at(scene, *pilot_, method, look_of(method, look));
            if (!measured.not_finite.empty())
                say_finding(Finding::Kind::not_finite, method, "",
                            fmt::format("{} is not finite: {}", measured.not_finite, command_of(method, look)));
            else if (look == trial_.first_look)
                say({{"rendered", method}, {"seconds", static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC}});
            const bool is_finite = measured.not_finite.empty();
            return is_finite ? &seen_.emplace(std::pair(method, look), std::move(measured)).first->second : nullptr;
        } catch (const InputError& e) {
            say({{"refused", method}, {"why", e.what()}});
        } catch (const std::exception& e) {
            say_finding(Finding::Kind::error, method, "", fmt::format("{}: {}", e.what(), command_of(method, look)));
        }
        return nullptr;
    }

    std::vector<Pair> differing() const {
        std::vector<Pair> pairs;
        for (const std::string& method : trial_.methods)
            for (const std::string& other : trial_.methods) {
                if (method == other) break;
                const auto a = seen_.find({method, trial_.first_look}), b = seen_.find({other, trial_.first_look});
                if (a == seen_.end() || b == seen_.end()) continue;
                if (compare(a->second, b->second).probability < unlikely[trial_.first_look]) pairs.push_back({method, other});
            }
        return pairs;
    }

    // The method that differs from most others, and the first of these.
    Pair most_doubtful(const std::vector<Pair>& pairs) const {
        Pair found;
        std::ptrdiff_t most = 0;
        for (const std::string& method : trial_.methods) {
            const std::ptrdiff_t count = std::ranges::count_if(pairs, [&](const Pair& p) { return p.has(method); });
            if (count < most || count == 0) continue;
            most = count;
            for (const std::string& other : trial_.methods)
                if (other != method && std::ranges::any_of(pairs, [&](const Pair& p) { return p.has(method) && p.has(other); })) {
                    found = {method, other};
                    break;
                }
        }
        return found;
    }

    bool stays(const Scene& scene, const Pair& pair) {
        std::optional<double> before;
        for (std::size_t look = trial_.first_look; look <= trial_.last_look; ++look) {
            if (look > trial_.first_look) say({{"again", look}});
            const Measured *a = see(scene, pair.method, look), *b = see(scene, pair.other, look);
            if (!a || !b) return false;
            const Difference d = compare(*a, *b);
            if (d.probability >= unlikely[look]) return false;
            if (look == 0) continue;
            const auto value = [&](const Measured* m) { return m->bounces[d.bounce][d.part].mean.mean; };
            const double now = value(a) - value(b);
            if (before && std::abs(now) < part_that_stays * std::abs(*before)) return false;
            before = now;
        }
        return true;
    }

    // Whether the first of the two has met nothing where they differ.
    bool is_unmet(const Pair& pair) const {
        const Measured &a = seen_.at({pair.method, trial_.first_look}), &b = seen_.at({pair.other, trial_.first_look});
        const Difference d = compare(a, b);
        return a.bounces[d.bounce][d.part].unmet > 0.0;
    }

    // With more samples it would be met, and the bound is one for few: other seeds tell.
    bool stays_unmet(const Scene& scene, const Pair& pair) {
        constexpr std::uint64_t first_seed = 50, seeds = 3;
        say({{"again", 1}});
        const Measured* b = see(scene, pair.other, trial_.last_look);
        for (std::uint64_t i = 0; b && i < seeds; ++i) {
            Look look = look_of(pair.method, trial_.first_look);
            look.seed += first_seed + i;
            const Measured a = look_at(scene, *pilot_, pair.method, look);
            const Difference d = compare(a, *b);
            if (!(a.bounces[d.bounce][d.part].unmet > 0.0) || d.probability >= unlikely.back()) return false;
        }
        return b != nullptr;
    }

    void tell(const Scene& scene, const Pair& pair) {
        const std::size_t look = is_unmet(pair) ? trial_.first_look : trial_.last_look;
        const Measured& a = *see(scene, pair.method, look);
        const Difference d = compare(a, *see(scene, pair.other, look));
        std::string text = fmt::format("bounce {}, {}:", d.bounce, name_of_part(d.part));
        std::vector<std::string> asked{pair.method, pair.other};
        for (const std::string& judge : trial_.methods)
            if (asked.size() < 4 && std::ranges::find(asked, judge) == asked.end() && see(scene, judge, look))
                asked.push_back(judge);
        for (const std::string& method : asked) {
            const Measured& m = *see(scene, method, look);
            const Claim& claim = m.bounces[d.bounce][d.part];
            text += fmt::format(" {} {:.6g} ± {:.2g}", method, claim.mean.mean, claim.mean.standard_error);
            if (claim.bias > 0.0) text += fmt::format(" (bias {:.2g})", claim.bias);
            if (claim.unmet > 0.0) text += fmt::format(" (unmet, < {:.2g})", claim.unmet);
            if (m.misses_paths) text += " (some paths)";
            text += ";";
        }
        say_finding(Finding::Kind::differs, pair.method, pair.other, fmt::format("{} {}", text, command_of(pair.method, look)));
    }

    const Trial& trial_;
    Words& words_;
    Film film_;
    std::optional<Pilot> pilot_;
    std::map<std::pair<std::string, std::size_t>, Measured> seen_;
};

void hear(const std::vector<std::string>& lines, Verdict& verdict, std::string& begun, std::string& as) {
    for (const std::string& line : lines) {
        if (!line.starts_with('{')) continue;
        const auto message = nlohmann::json::parse(line);
        if (message.contains("begin")) begun = message["begin"], as = message.value("command", "");
        if (message.contains("rendered")) verdict.rendered[message["rendered"]] = message["seconds"];
        if (message.contains("refused")) verdict.refused[message["refused"]] = message["why"];
        if (message.contains("again")) verdict.looked_again = true;
        if (message.contains("kind"))
            verdict.findings.push_back(
                {static_cast<Finding::Kind>(message["kind"].get<int>()), message["method"], message["other"], message["what"]});
    }
}

}  // namespace

Verdict try_scene(const Trial& trial) {
    const Stopwatch clock;
    Verdict verdict;
    std::vector<Finding> deaths;
    for (Trial rest = trial;;) {
        verdict = {};
        std::string begun, as;
        const Ended ended = run_apart([&](Words& words) {
            // Threads would only wait for each other, and other work is done beside this.
            const oneapi::tbb::global_control one(oneapi::tbb::global_control::max_allowed_parallelism, 1);
            Examination(rest, words).run();
        });
        hear(ended.lines, verdict, begun, as);
        if (ended.how.empty()) break;
        if (begun.empty()) {
            verdict.findings.push_back({Finding::Kind::scene, "", "", ended.how});
            break;
        }
        deaths.push_back({Finding::Kind::died, begun, "", fmt::format("{}: {}", ended.how, as)});
        std::erase(rest.methods, begun);
    }
    verdict.findings.insert(verdict.findings.end(), deaths.begin(), deaths.end());
    verdict.seconds = clock.seconds();
    return verdict;
}

}  // namespace neumann::search
