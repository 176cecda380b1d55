#include "apps/output/files/strip_files.h"

#include "apps/output/files/json_number.h"
#include "apps/output/sheets/strip_svg.h"
#include "apps/output/sheets/strips.h"
#include "core/image/image_io.h"

namespace neumann {

namespace {

using Json = nlohmann::ordered_json;

Strip as_drawn(const VariedStrip& strip) {
    Strip drawn;
    for (const auto& row : strip.rows) {
        Pictures& pictures = drawn.emplace_back();
        for (const StripTile& tile : row)
            pictures.push_back({tile.label, tile.why.empty() ? &tile.picture : nullptr, tile.factor, strip.mark, tile.why});
    }
    return drawn;
}

Json tile_json(const StripTile& tile, std::size_t row) {
    Json json{{"row", row}, {"label", tile.label}};
    if (!tile.why.empty()) {
        json["why"] = tile.why;
        return json;
    }
    json.update({{"method", tile.method},
                 {"bounces", tile.bounces},
                 {"samples", tile.samples},
                 {"seconds", tile.seconds},
                 {"factor", tile.factor},
                 {"relative_stderr", json_number(tile.error)},
                 {"biased", tile.is_biased}});
    if (!tile.marked) return json;
    for (const auto& [name, value] : {std::pair("value", (*tile.marked)[0]), std::pair("stderr", (*tile.marked)[1])})
        json["p"][name] = {json_number(value.x), json_number(value.y), json_number(value.z)};
    return json;
}

}  // namespace

bool write_strip_pictures(OutputFolder& folder, const VariedStrip& strip, SheetTheme theme) {
    const Strip drawn = as_drawn(strip);
    const SheetStyle style(find_label_font(), theme);
    folder.write("strip.png", strip_png(drawn, strip.exposure, style, strip.note, strip.heading));
    folder.write("strip.svg", strip_svg(drawn, strip.exposure, theme, strip.note, strip.heading));
    return style.font.has_value();
}

Json as_json(const VariedStrip& strip) {
    Json json{{"exposure", strip.exposure}, {"below", strip.heading}};
    if (strip.mark) json["mark"] = *strip.mark;
    json["tiles"] = Json::array();
    for (std::size_t row = 0; row < strip.rows.size(); ++row)
        for (const StripTile& tile : strip.rows[row]) json["tiles"].push_back(tile_json(tile, row));
    return json;
}

}  // namespace neumann
