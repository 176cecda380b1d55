// What a render wrote, read again; and a small scene to render.
#pragma once

#include "core/base/vec.h"
#include "core/image/image_io.h"
#include "tests/commands/run_command.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace neumann {

// A CSV file with a header.
class Table {
public:
    explicit Table(const std::filesystem::path& path) {
        std::istringstream lines(text_of(path));
        std::string line;
        std::getline(lines, line);
        columns_ = split(line);
        while (std::getline(lines, line)) rows_.push_back(split(line));
    }
    const std::vector<std::string>& columns() const { return columns_; }
    std::size_t size() const { return rows_.size(); }
    std::string text(std::size_t row, const std::string& column) const {
        const auto found = std::find(columns_.begin(), columns_.end(), column);
        if (found == columns_.end()) throw std::out_of_range("no column " + column);
        return rows_.at(row).at(static_cast<std::size_t>(found - columns_.begin()));
    }
    double number(std::size_t row, const std::string& column) const { return std::stod(text(row, column)); }
    double last(const std::string& column) const { return number(size() - 1, column); }

private:
    static std::vector<std::string> split(const std::string& line) {
        std::vector<std::string> cells(1);
        for (const char c : line) {
            if (c == ',')
                cells.emplace_back();
            else
                cells.back() += c;
        }
        return cells;
    }
    std::vector<std::string> columns_;
    std::vector<std::vector<std::string>> rows_;
};

// Mean over the pixels of one channel, with its standard error: pixels are independent.
struct ChannelMean {
    double mean = 0.0, standard_error = 0.0;
};

inline ChannelMean channel_mean(const Estimate& picture, int channel) {
    double sum = 0.0, variance = 0.0;
    for (const Rgb& p : picture.mean.pixels) sum += p[channel];
    for (const Rgb& e : picture.standard_error.pixels) variance += e[channel] * e[channel];
    const auto n = static_cast<double>(picture.mean.pixels.size());
    return {sum / n, std::sqrt(variance) / n};
}

class RenderTest : public CommandTest {
protected:
    // An emitting plate above a floor and beside a wall, in the open; the light touches nothing. The camera lies on its side, so
    // that a film that is long and low shows floor, wall and light; such pictures are not enlarged for the GIF, which takes most of
    // the time otherwise.
    static std::string plates(const std::string& film = "width=\"164\" height=\"5\"") {
        const auto attribute = [&](const std::string& name) {
            const std::size_t at = film.find(name + "=\"") + name.size() + 2;
            return film.substr(at, film.find('"', at) - at);
        };
        return R"(<scene version="3.0.0">
<default name="width" value=")" +
               attribute("width") + R"("/><default name="height" value=")" + attribute("height") + R"("/>
<sensor type="perspective">
  <float name="fov" value="50"/>
  <transform name="to_world"><lookat origin="3, -0.2, 0.35" target="0, 0, 0.5" up="0, 1, 0"/></transform>
  <film type="hdrfilm"><integer name="width" value="$width"/><integer name="height" value="$height"/><rfilter type="box"/></film>
</sensor>
<bsdf type="twosided" id="grey"><bsdf type="diffuse"><rgb name="reflectance" value=".8, .6, .4"/></bsdf></bsdf>
<shape type="rectangle"><transform name="to_world"><scale value="2"/></transform><ref id="grey"/></shape>
<shape type="rectangle">
  <transform name="to_world"><scale value="2"/><rotate y="1" angle="90"/><translate x="-2"/></transform><ref id="grey"/>
</shape>
<shape type="rectangle">
  <transform name="to_world"><scale value=".5"/><rotate x="1" angle="180"/><translate z="1"/></transform>
  <ref id="grey"/><emitter type="area"><rgb name="radiance" value="5, 4, 3"/></emitter>
</shape>
</scene>
)";
    }

    // The inside of a cube that emits 1 and reflects `albedo`.
    static std::string closed_room(const std::string& albedo) {
        return R"(<scene version="3.0.0">
<sensor type="perspective"><float name="fov" value="60"/>
  <film type="hdrfilm"><integer name="width" value="164"/><integer name="height" value="2"/><rfilter type="box"/></film>
</sensor>
<shape type="cube">
  <boolean name="flip_normals" value="true"/>
  <bsdf type="diffuse"><rgb name="reflectance" value=")" +
               albedo + R"("/></bsdf>
  <emitter type="area"><rgb name="radiance" value="1"/></emitter>
</shape>
</scene>
)";
    }

    static std::string scene_file(const std::string& name) { return std::string(SCENES) + "/" + name + "/" + name + ".xml"; }

    // Renders into the folder `output`, quietly, and expects that all goes well.
    Finished render(const std::string& scene, const std::string& output, std::vector<std::string> options) const {
        options.insert(options.begin(), {"render", scene, "-o", output});
        const Finished done = run(options);
        EXPECT_EQ(done.exit_code, 0) << done.err;
        return done;
    }

    // `render` of the plates with these options is answered with this message alone.
    void expect_refused(const std::vector<std::string>& options, const std::string& message) const {
        write("scene.xml", plates());
        std::vector<std::string> arguments{"render", "scene.xml", "-o", "refused", "--quiet"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        const Finished done = run(arguments);
        EXPECT_EQ(done.exit_code, 2);
        EXPECT_EQ(done.err, message + "\n");
        EXPECT_FALSE(std::filesystem::exists(path("refused")));
    }

    nlohmann::json run_json(const std::string& output) const { return nlohmann::json::parse(text_of(path(output) / "run.json")); }
    Estimate picture(const std::string& output, const std::string& name) const { return read_exr((path(output) / name).string()); }
    static std::string numbered(const std::string& name, int i) { return fmt::format("{}_{:03}.exr", name, i); }

    static Names output_names(int bounces, bool rest = true) {
        Names names{"bounces.gif",    "contact-sheet.png", "convergence.csv", "index.html",
                    "run.json",       "series.csv",        "strip-terms.png", "strip-terms.gif",
                    "strip-sums.png", "strip-sums.gif",    "strip-terms.svg", "strip-sums.svg"};
        if (rest) names.insert("rest.exr");
        if (rest || bounces > 0) names.insert({"strip-doubling.png", "strip-doubling.gif", "strip-doubling.svg"});
        for (int i = 0; i <= bounces; ++i) names.insert({numbered("bounce", i), numbered("sum", i)});
        return names;
    }
    // All files are there, and run.json knows of as many bounces.
    void expect_complete(const std::string& output) const {
        const nlohmann::json run = run_json(output);
        EXPECT_EQ(names(output), output_names(run.at("options").at("bounces"), run.at("rest").at("verdict") == "measured"));
    }
    void expect_finite(const std::string& output) const {
        for (const std::string& name : names(output)) {
            if (!name.ends_with(".exr")) continue;
            const Estimate e = picture(output, name);
            for (const Image* image : {&e.mean, &e.standard_error})
                for (const Rgb& p : image->pixels) ASSERT_TRUE(is_finite(p)) << name;
        }
    }
    // The texts and counts of the warnings in run.json.
    std::map<std::string, int> warnings(const std::string& output) const {
        std::map<std::string, int> found;
        const nlohmann::json run = run_json(output);
        for (const nlohmann::json& w : run.at("warnings")) found[w.at("text")] = w.at("count");
        return found;
    }

    // The command that repeats a run, put together from its run.json alone.
    std::vector<std::string> repeating(const std::string& output) const {
        const nlohmann::json run = run_json(output);
        std::vector<std::string> options{"-n",     run.at("options").at("bounces").dump(),
                                         "--spp",  run.at("samples").at("per_pixel").dump(),
                                         "--seed", run.at("options").at("seed").dump()};
        for (const char* name : {"method", "direct", "lights", "roulette", "split", "adaptive", "patches", "directions"})
            if (run.at("options").contains(name)) {
                const nlohmann::json& value = run.at("options").at(name);
                options.insert(options.end(),
                               {std::string("--") + name, value.is_string() ? value.get<std::string>() : value.dump()});
            }
        for (const auto& [name, value] : run.at("scene").at("definitions").items())
            options.insert(options.end(), {"-D", name + "=" + value.get<std::string>()});
        return options;
    }
    // The largest samples, which the health names, have these values again when they are replayed. Returns their number, without
    // those from lights, which bring it to other pixels than their own.
    int expect_replayed(const std::string& output) const {
        const nlohmann::json health = run_json(output).at("health");
        int compared = 0;
        for (const nlohmann::json& largest : health.at("largest_samples")) {
            for (const nlohmann::json& sample : health.at("samples")) {
                if (sample.at("number") != largest.at("number") || sample.contains("pixel_of_path")) continue;
                const Finished found = run({"replay", output, sample.at("number").dump(), "--json"});
                EXPECT_EQ(found.exit_code, 0) << found.err;
                if (found.exit_code != 0) return compared;
                const nlohmann::json replayed = nlohmann::json::parse(found.out);
                const nlohmann::json& term = replayed.at("terms").at(largest.at("bounce").get<std::size_t>());
                const double value = std::max({term.at(0).get<double>(), term.at(1).get<double>(), term.at(2).get<double>()});
                EXPECT_NEAR(value, largest.at("value").get<double>(), 1e-12 * value) << output << ", " << largest.dump();
                ++compared;
            }
        }
        return compared;
    }
    // Every picture of both folders has the same bytes.
    void expect_same_pictures(const std::string& a, const std::string& b) const {
        EXPECT_EQ(names(a), names(b));
        for (const std::string& name : names(a)) {
            if (name.ends_with(".csv") || name.ends_with(".json") || name.ends_with(".html")) continue;
            EXPECT_TRUE(text_of(path(a) / name) == text_of(path(b) / name)) << name << " differs between " << a << " and " << b;
        }
    }
    void expect_repeatable(const std::string& output) const {
        const std::string scene = run_json(output).at("scene").at("file");
        render(scene, output + "_again", repeating(output));
        expect_same_pictures(output, output + "_again");
    }
};

}  // namespace neumann
