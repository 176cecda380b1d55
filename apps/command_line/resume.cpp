#include "apps/command_line/resume.h"

#include "apps/output/files/json_text.h"
#include "apps/output/files/request_json.h"
#include "apps/output/files/saved_render.h"
#include "core/base/error.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace neumann {

namespace {

constexpr std::array<std::string_view, 3> limits = {"spp", "time", "error"};
// Further options that have no effect on the samples. The scene may have moved; its hash shows whether it is the same.
constexpr std::array<std::string_view, 6> changeable = {"scene", "memory", "files", "paths", "checkpoint", "reference"};

bool is_one_of(const auto& names, const std::string& name) { return std::ranges::find(names, name) != names.end(); }

}  // namespace

RenderRequest resumed(const RenderRequest& now, const Given& given) {
    const Options<RenderRequest>& options = render_options();
    RenderRequest begun = request_from_json(options, request_in(now.resume).request, now.resume);
    begun.scene.path = file_named_in_json(begun.scene.path);
    if (std::ranges::any_of(given, [](const auto& g) { return is_one_of(limits, g.first); })) {
        if (const auto& part = begun.goal.part)
            throw InputError(
                fmt::format("--resume: --part {}/{} is of the samples that it began with; for more, render them as parts of "
                            "another seed and merge these, too",
                            part->k, part->n));
        begun.goal.samples.reset();
        begun.goal.seconds.reset();
        begun.goal.relative_error.reset();
    }
    for (const auto& [name, texts] : given) {
        const Option<RenderRequest>& o = *options.find(name);
        if (name == "output") throw InputError("-o: --resume writes into the folder of the render that it goes on with");
        if (o.lasts && !is_one_of(limits, name) && !is_one_of(changeable, name)) {
            const std::vector<std::string> is = o.texts(now), was = o.texts(begun);
            if (is != was)
                throw InputError(was.empty() ? fmt::format("--resume: {} {} is given, and was not", o.spelled(), fmt::join(is, " "))
                                             : fmt::format("--resume: {} is {}, and was {}", o.spelled(), fmt::join(is, " "),
                                                           fmt::join(was, " ")));
        }
        o.read(begun, texts);
    }
    begun.command_line = now.command_line;
    begun.output = now.resume;
    return begun;
}

}  // namespace neumann
