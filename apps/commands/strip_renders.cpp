#include "apps/commands/strip_renders.h"

#include "core/base/error.h"
#include "operators/render/methods/method_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace neumann {

namespace {

constexpr double seconds_of_methods = 5.0;
constexpr std::uint64_t samples_with_rays = 4;  // the fewest that have an error

using Texts = std::vector<std::string>;
using Numbers = std::vector<std::uint64_t>;

// All methods that a study would compare.
Texts studied_methods() {
    Texts names;
    for (const Method& method : all_methods()) {
        const auto is_studied = []<class M>(const M&) {
            if constexpr (MakesPaths<M>) return M::is_studied;
            return true;
        };
        if (std::visit(is_studied, method)) names.push_back(name_of(method));
    }
    return names;
}

// The method that has an option of its own.
std::string method_with(const std::string& option) {
    const auto own = std::ranges::find(method_options(), option, &MethodOption::name);
    return name_of(*std::ranges::find_if(all_methods(), own->belongs_to));
}

// What a thing is without --values, and between which bounds its values are if they are numbers.
struct Varied {
    Texts values;
    std::uint64_t low = 0, high = 0;
};
const Varied& varied(const std::string& vary) {
    static const std::map<std::string, Varied> all{{"samples", {{"1", "32", "1024"}, 1, std::uint64_t{1} << 40}},
                                                   {"shadow-rays", {{"1", "9", "36"}, 1, 4096}},
                                                   {"hemisphere", {{"1", "16", "256"}, 1, 4096}},
                                                   {"depth", {{"1", "2", "4", "8", "16"}, 0, 1000}},
                                                   {"ways", {{"1", "2", "3", "4"}, 1, 1000}},
                                                   {"methods", {studied_methods()}},
                                                   {"ladder", {}}};
    return all.at(vary);
}

Texts values_of(const StripRequest& request) {
    const Texts& usual = varied(request.vary).values;
    if (usual.empty() && !request.values.empty())
        throw OptionError("values", fmt::format(": {} has three steps of its own", request.vary));
    return request.values.empty() ? usual : request.values;
}

Numbers numbers_of(const StripRequest& request) {
    const auto& [usual, low, high] = varied(request.vary);
    const Form<std::uint64_t> form = whole_from(low, high);
    Numbers numbers;
    for (const std::string& text : values_of(request)) {
        const auto number = form.read(text);
        if (!number) throw OptionError("values", ": " + form.wrong(text));
        if (!numbers.empty() && *number <= numbers.back())
            throw OptionError("values", fmt::format(": {} after {}; values have to grow", *number, numbers.back()));
        numbers.push_back(*number);
    }
    return numbers;
}

// "1 sample a pixel", "32 samples a pixel"
std::string counted(std::uint64_t n, const std::string& one, const std::string& of = "") {
    return fmt::format("{} {}{}{}", n, one, n == 1 ? "" : "s", of);
}

bool is_given(const RenderRequest& request, const std::string& option) {
    return std::ranges::any_of(request.method.options, [&](const auto& given) { return given.first == option; });
}

void expect_not_given(const StripRequest& request, const Texts& options) {
    const Goal& goal = request.render.goal;
    for (const std::string& option : options) {
        const bool given = option == "bounces"  ? goal.bounces.has_value()
                           : option == "spp"    ? goal.samples.has_value()
                           : option == "time"   ? goal.seconds.has_value()
                           : option == "method" ? !request.render.method.name.empty()
                                                : is_given(request.render, option);
        if (given)
            throw InputError(fmt::format("{}: is what --vary {} chooses", render_options().find(option)->spelled(), request.vary));
    }
}

void set(RenderRequest& request, const std::string& option, const std::string& text) {
    request.method.options.emplace_back(option, text);
}

std::vector<StripRender> by_samples(const StripRequest& request) {
    expect_not_given(request, {"spp", "time"});
    std::vector<StripRender> renders;
    for (const std::uint64_t n : numbers_of(request)) {
        renders.push_back({request.render, counted(n, "sample", " a pixel")});
        renders.back().request.goal.samples = n;
        if (request.render.method.name.empty()) renders.back().request.method.name = "walk";
    }
    return renders;
}

// Samples of the light at the first surface that each camera ray meets.
std::vector<StripRender> by_light_samples(const StripRequest& request) {
    const bool hemisphere = request.vary == "hemisphere";
    expect_not_given(request, {"split"});
    if (hemisphere) expect_not_given(request, {"direct"});
    std::vector<StripRender> renders;
    for (const std::uint64_t n : numbers_of(request)) {
        renders.push_back({request.render, counted(n, hemisphere ? "direction" : "shadow ray")});
        RenderRequest& of = renders.back().request;
        if (!is_given(of, "direct")) set(of, "direct", hemisphere ? "hemisphere" : "light");
        set(of, "split", fmt::format("{},1", n));
        if (!of.goal.bounces) of.goal.bounces = 1;
        if (!of.goal.samples && !of.goal.seconds) of.goal.samples = samples_with_rays;
    }
    return renders;
}

std::vector<StripRender> by_depth(const StripRequest& request) {
    expect_not_given(request, {"bounces"});
    StripRender render{request.render, ""};
    for (const std::uint64_t n : numbers_of(request)) render.sums.push_back(static_cast<int>(n));
    render.request.goal.bounces = render.sums.back();
    return {render};
}

std::vector<StripRender> by_ways(const StripRequest& request) {
    expect_not_given(request, {"bounces", "method"});
    std::vector<StripRender> renders;
    const Numbers bounces = numbers_of(request);
    for (const std::uint64_t n : bounces) {
        renders.push_back({request.render, "", {}, static_cast<int>(n)});
        RenderRequest& of = renders.back().request;
        of.method.name = method_with("ways");
        set(of, "ways", fmt::format("{}", n));
        of.goal.bounces = static_cast<int>(bounces.back());
    }
    return renders;
}

std::vector<StripRender> by_methods(const StripRequest& request) {
    Texts own;
    for (const auto& [name, text] : request.render.method.options) own.push_back(name);
    own.emplace_back("method");
    expect_not_given(request, own);
    std::vector<StripRender> renders;
    for (const std::string& word : values_of(request)) {
        renders.push_back({request.render, word});
        RenderRequest& of = renders.back().request;
        try {
            of.method = text_of(read_method(word));
        } catch (const InputError& error) {
            throw OptionError("values", std::string(": ") + error.what());
        }
        if (!of.goal.samples && !of.goal.seconds) of.goal.seconds = seconds_of_methods;
    }
    return renders;
}

std::vector<StripRender> ladder(const StripRequest& request) {
    values_of(request);
    std::vector<StripRender> renders{
        {request.render, "direct light"}, {request.render, "+ mirrors and glass"}, {request.render, "+ all bounces"}};
    renders[0].request.goal.bounces = 1;
    renders[1].request.method = {"classic", {}};
    return renders;
}

}  // namespace

std::vector<StripRender> strip_renders(const StripRequest& request) {
    static const std::map<std::string, std::vector<StripRender> (*)(const StripRequest&)> all{{"samples", by_samples},
                                                                                              {"shadow-rays", by_light_samples},
                                                                                              {"hemisphere", by_light_samples},
                                                                                              {"depth", by_depth},
                                                                                              {"ways", by_ways},
                                                                                              {"methods", by_methods},
                                                                                              {"ladder", ladder}};
    std::vector<StripRender> renders = all.at(request.vary)(request);
    for (const StripRender& render : renders) make_method(render.request.method);  // throws for options that it does not have
    return renders;
}

bool shows_errors(const StripRequest& request) {
    return request.vary != "depth" && request.vary != "ways" && request.vary != "ladder";
}

bool judges_direct_light(const StripRequest& request) { return request.vary == "shadow-rays" || request.vary == "hemisphere"; }

std::string about_strip(const StripRequest& request) {
    static const std::map<std::string, std::string> all{
        {"shadow-rays", "each sample with so many shadow rays from its first surface"},
        {"hemisphere", "each sample with so many directions, uniform over the hemisphere, from its first surface"},
        {"ways",
         "s vertices from the light and t from the camera, each way with its weight; the ways of a row add up to its bounce"}};
    const auto found = all.find(request.vary);
    if (found != all.end()) return found->second;
    const Goal& goal = request.render.goal;
    return request.vary == "methods" && !goal.samples ? fmt::format("{:.6g} s each", goal.seconds.value_or(seconds_of_methods))
                                                      : "";
}

}  // namespace neumann
