#include "apps/commands/strip_command.h"

#include "apps/commands/print_warnings.h"
#include "apps/commands/progress_line.h"
#include "apps/commands/render_command.h"
#include "apps/commands/strip_renders.h"
#include "apps/output/files/json_text.h"
#include "apps/output/files/recorded_run.h"
#include "apps/output/files/request_json.h"
#include "apps/output/files/scene_json.h"
#include "apps/output/files/strip_files.h"
#include "apps/output/sheets/strips.h"
#include "apps/processes/launch.h"
#include "core/base/error.h"
#include "core/base/interrupt.h"
#include "core/base/limits.h"
#include "core/image/in_file.h"
#include "operators/statistics/picture_statistics.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <span>
#include <stdexcept>

namespace neumann {

namespace {

using Json = nlohmann::ordered_json;
using Tiles = std::vector<StripTile>;

constexpr std::size_t most_in_row = 7;

std::string sum_name(int bounce) { return bounce == 0 ? "bounce 0" : fmt::format("bounces 0 to {}", bounce); }

// The relative standard error of a picture; infinite if it is unknown.
double error_of(const Estimate& picture, bool infinite_variance) {
    return infinite_variance || picture.standard_error.pixels.empty() ? std::numeric_limits<double>::infinity()
                                                                      : relative_standard_error(picture);
}

StripTile tile_of(const std::string& label, const PixelEstimate& picture, const BounceSeries& series, int bounces,
                  bool infinite_variance, const StripRequest& request) {
    const PixelEstimate shown = as_in_file(picture);
    StripTile tile;
    tile.label = label;
    tile.picture = shown.mean;
    tile.error = error_of(picture, infinite_variance);
    tile.is_biased = is_biased(series.method);
    tile.method = name_of(series.method);
    tile.bounces = bounces;
    tile.samples = series.samples;
    tile.seconds = series.seconds;
    if (!request.mark) return tile;
    const auto [x, y] = *request.mark;
    tile.marked = {shown.mean.at(x, y),
                   std::isfinite(tile.error) ? shown.pixel_errors().at(x, y) : Rgb(std::numeric_limits<double>::infinity())};
    return tile;
}

StripTile tile_of_sum(const std::string& label, const BounceSeries& series, int bounce, const StripRequest& request) {
    const auto i = static_cast<std::size_t>(bounce);
    const bool infinite = std::ranges::any_of(std::span(series.report.bounces).first(i + 1), &BounceReport::infinite_variance);
    StripTile tile = tile_of(label, series.sum(i), series, bounce, infinite, request);
    if (judges_direct_light(request) && i > 0) tile.error = error_of(series.term(1), series.report.bounces[1].infinite_variance);
    return tile;
}

// A bounce and each way to make it.
Tiles row_of_ways(const BounceSeries& series, const StripRequest& request) {
    const Ways& ways = *series.ways;
    const auto i = static_cast<std::size_t>(ways.bounce);
    Tiles row{
        tile_of(power_of("K", i) + "Le", series.term(i), series, ways.bounce, series.report.bounces[i].infinite_variance, request)};
    for (const Way& way : ways.ways)
        row.push_back(tile_of(fmt::format("s = {}, t = {}", way.s, way.t), way.weighted.picture, series, ways.bounce,
                              way.weighted.infinite_variance, request));
    return row;
}

Tiles tiles_of(const StripRender& render, const BounceSeries& series, const StripRequest& request) {
    if (render.ways) return row_of_ways(series, request);
    if (render.sums.empty()) return {tile_of_sum(render.label, series, series.bounces(), request)};
    Tiles tiles;
    for (const int bounce : render.sums) tiles.push_back(tile_of_sum(sum_name(bounce), series, bounce, request));
    return tiles;
}

// Rows of about the same length.
std::vector<Tiles> in_rows(Tiles tiles) {
    const std::size_t rows = (tiles.size() + most_in_row - 1) / most_in_row, columns = (tiles.size() + rows - 1) / rows;
    std::vector<Tiles> all;
    for (std::size_t i = 0; i < tiles.size(); ++i) {
        if (i % columns == 0) all.emplace_back();
        all.back().push_back(std::move(tiles[i]));
    }
    return all;
}

// Every row of ways is brightened by the power of two that its bounce needs.
void brighten_rows(std::vector<Tiles>& rows, const Image& emission, double exposure) {
    for (Tiles& row : rows) {
        const double factor = brightening(row.front().picture, emission, exposure);
        if (factor == 1.0) continue;
        for (StripTile& tile : row) {
            tile.label = &tile == &row.front() ? fmt::format("{:.6g} {}", factor, tile.label)
                                               : fmt::format("{:.6g} × ({})", factor, tile.label);
            tile.factor = factor;
        }
    }
}

std::string percent(double error) {
    if (!std::isfinite(error)) return "unknown";
    return error < 0.995 ? fmt::format("{:.2g}%", 100.0 * error) : fmt::format("{:.0f}%", 100.0 * error);
}

// The lines below the name of a tile: its samples, unless all have the same, its error, and the value of the marked pixel.
void add_figures(StripTile& tile, const StripRequest& request, bool same_samples) {
    if (shows_errors(request))
        tile.label += "\n" + (same_samples || request.vary == "samples" ? "" : fmt::format("{} samples, ", tile.samples)) +
                      "error " + percent(tile.error) + (tile.is_biased ? ", and a bias" : "");
    if (request.vary == "ladder") tile.label += "\n" + sum_name(tile.bounces);
    if (tile.marked) {
        const Rgb& value = (*tile.marked)[0];
        tile.label += fmt::format("\np: {:.3g} {:.3g} {:.3g}", value.x, value.y, value.z);
    }
}

// The value that all tiles with a picture have.
template <class Value>
std::optional<Value> common(const std::vector<Tiles>& rows, Value StripTile::*member) {
    std::optional<Value> found;
    for (const Tiles& row : rows)
        for (const StripTile& tile : row) {
            if (!tile.why.empty()) continue;
            if (found && *found != tile.*member) return std::nullopt;
            found = tile.*member;
        }
    return found;
}

// What the strip shows, and what is the same in all tiles.
std::string words_below(const VariedStrip& strip, const StripRequest& request, const Scene& scene) {
    std::vector<std::string> parts{std::filesystem::path(request.render.scene.path).stem().string() + lenient_label(scene)};
    if (const auto method = common(strip.rows, &StripTile::method)) parts.push_back("by " + *method);
    if (const auto bounces = common(strip.rows, &StripTile::bounces)) parts.push_back(sum_name(*bounces));
    if (const auto samples = common(strip.rows, &StripTile::samples))
        parts.push_back(fmt::format("{} sample{} a pixel", *samples, *samples == 1 ? "" : "s"));
    if (const std::string about = about_strip(request); !about.empty()) parts.push_back(about);
    std::string words = fmt::format("{}\none exposure, ×{:.3g}, sRGB", fmt::join(parts, "; "), strip.exposure);
    if (shows_errors(request))
        words += fmt::format("; error: relative standard error of {}", judges_direct_light(request) ? "bounce 1" : "the picture");
    if (strip.mark)
        words += fmt::format("; p: radiance of pixel {},{} (red, green, blue; W/m²/sr)", (*strip.mark)[0], (*strip.mark)[1]);
    return words;
}

void print(const VariedStrip& strip, const std::string& output) {
    fmt::print("{:<28}{:<16}{:>8}{:>12}{:>10}{:>12}{}\n", "tile", "method", "bounces", "samples", "seconds", "error",
               strip.mark ? "  p, with standard error" : "");
    for (const Tiles& row : strip.rows)
        for (const StripTile& tile : row) {
            const std::string name = tile.label.substr(0, tile.label.find('\n'));
            if (!tile.why.empty()) {
                fmt::print("{:<28}{}\n", name, tile.why);
                continue;
            }
            fmt::print("{:<28}{:<16}{:>8}{:>12}{:>10.3g}{:>12}", name, tile.method, tile.bounces, tile.samples, tile.seconds,
                       percent(tile.error));
            for (int c = 0; tile.marked && c < 3; ++c) fmt::print("  {:.4g} ± {:.2g}", (*tile.marked)[0][c], (*tile.marked)[1][c]);
            fmt::print("\n");
        }
    fmt::print("{}\nThe strip is in {}: strip.png, strip.svg, strip.json\n", strip.heading, output);
}

Watch watch_of(ProgressLine& line, std::size_t render, std::size_t renders, Crew* crew, bool quiet) {
    Watch watch;
    watch.stop = interrupted;
    watch.crew = crew;
    watch.tell = [quiet](const std::string& text) {
        if (!quiet) fmt::print(stderr, "{}\n", text);
    };
    watch.progress = [&line, render, renders](const RenderProgress& so_far) {
        line.show([&] { return fmt::format("render {} of {}: {}", render + 1, renders, progress_text(so_far)); });
    };
    return watch;
}

}  // namespace

int strip_command(const StripRequest& given) {
    StripRequest request = given;
    std::vector<StripRender> renders = strip_renders(request);
    RenderRequest& base = request.render;
    if (base.output.empty())
        base.output =
            (std::filesystem::path("out") / (std::filesystem::path(base.scene.path).stem().string() + "-" + request.vary)).string();
    const ThreadLimit threads(threads_of_process(base.threads));
    const auto scene = std::make_shared<const Scene>(read_scene(base.scene));
    if (request.mark) pixel_number(scene->film, (*request.mark)[0], (*request.mark)[1], "--mark");
    catch_interrupts();
    OutputFolder folder(base.output, "strip");
    expect_pictures();
    const auto crew = launched_crew(base.scene, *scene, base.threads);

    VariedStrip strip;
    strip.mark = request.mark;
    strip.note = lenient_note(*scene);
    Tiles single;
    Image sum, emission;  // of the last render, for the exposure
    std::optional<int> bounces;
    Warnings warnings;
    ProgressLine line(base.quiet);
    for (std::size_t i = 0; i < renders.size(); ++i) {
        StripRender& of = renders[i];
        const bool chosen = !of.request.goal.bounces;
        if (chosen) of.request.goal.bounces = bounces;
        Tiles tiles;
        try {
            const auto rendering = render(of.request, scene, watch_of(line, i, renders.size(), crew.get(), base.quiet));
            const BounceSeries& series = rendering->series;
            if (chosen) bounces = series.bounces();
            tiles = tiles_of(of, series, request);
            sum = as_in_file(series.sum(static_cast<std::size_t>(series.bounces()))).mean;
            emission = as_in_file(series.term(0)).mean;
            const Warnings of_render = rendering->warnings();
            for (const auto& [text, count] : of_render.counts()) warnings.add(text, count);
        } catch (const Stopped&) {
            throw;
        } catch (const std::runtime_error& error) {  // the scene or the time is not for this render
            StripTile& refused = tiles.emplace_back();
            refused.label = of.label;
            refused.why = error.what();
        }
        if (interrupted()) throw Stopped("interrupted: no strip was written");
        if (of.ways)
            strip.rows.push_back(std::move(tiles));
        else
            std::ranges::move(tiles, std::back_inserter(single));
    }
    line.clear();
    if (!single.empty()) strip.rows = in_rows(std::move(single));
    if (sum.pixels.empty()) throw InputError(strip.rows.front().front().why);
    strip.exposure = exposure_for(sum, emission);
    if (request.vary == "ways") brighten_rows(strip.rows, emission, strip.exposure);
    const bool same_samples = common(strip.rows, &StripTile::samples).has_value();
    for (Tiles& row : strip.rows)
        for (StripTile& tile : row)
            if (tile.why.empty()) add_figures(tile, request, same_samples);
    strip.heading = words_below(strip, request, *scene);

    Json json{{"version", NEUMANN_VERSION},
              {"command", base.command_line},
              {"scene", scene_json(*scene, base.scene)},
              {"request", as_json(strip_options(), request)}};
    json.update(as_json(strip));
    json["warnings"] = texts(warnings);
    if (!write_strip_pictures(folder, strip, base.theme == "white" ? white_theme : dark_theme) && !base.quiet)
        fmt::print(stderr,
                   "note: no font for labels was found (DejaVu Sans, Debian's fonts-dejavu-core): strip.png is unlabelled\n");
    folder.write("strip.json", json_text(json, 2) + "\n");
    folder.commit();
    print_warnings(texts(warnings), base.quiet);
    if (base.json)
        fmt::print("{}\n", json_text(json, 2));
    else if (!base.quiet)
        print(strip, base.output);
    return 0;
}

}  // namespace neumann
