#include "apps/output/sheets/contact_sheet.h"

#include "core/image/image_io.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace neumann {
namespace {

constexpr int sheet_side = 2400, largest_thumbnail = 480;
constexpr int heading_height = 44;
constexpr int sheet_label_size = 16, heading_size = 22;

int rows_of(int pictures, int columns) { return (pictures + columns - 1) / columns; }

SheetLayout with_columns(int columns, int terms, int sums, int width, int height) {
    SheetLayout layout{columns, rows_of(terms, columns), rows_of(sums, columns), 0, 0};
    const int rows = layout.term_rows + layout.sum_rows;
    const double wide = static_cast<double>(sheet_side - 2 * sheet_margin - (columns - 1) * sheet_gap) / columns;
    const double high =
        static_cast<double>(sheet_side - 2 * sheet_margin - 2 * heading_height) / rows - label_height(sheet_label_size) - sheet_gap;
    const double longer = std::max(width, height);
    const double scale = scale_shown(width, height, std::min({wide / width, high / height, largest_thumbnail / longer}));
    layout.thumbnail_width = std::max(1, static_cast<int>(width * scale));
    layout.thumbnail_height = std::max(1, static_cast<int>(height * scale));
    return layout;
}

int sheet_width(const SheetLayout& layout) {
    return 2 * sheet_margin + layout.columns * (layout.thumbnail_width + sheet_gap) - sheet_gap;
}

int block_height(const SheetLayout& layout, int rows) {
    return rows == 0 ? 0 : heading_height + rows * (layout.thumbnail_height + label_height(sheet_label_size) + sheet_gap);
}

void paste_block(DisplayImage& sheet, int top, const SheetLayout& layout, const std::string& heading,
                 std::span<const LabelledPicture> pictures, double exposure, const SheetStyle& style) {
    if (pictures.empty()) return;
    sheet.paste(caption(heading, sheet.width - 2 * sheet_margin, heading_height, heading_size, style, false), sheet_margin, top);
    for (std::size_t i = 0; i < pictures.size(); ++i) {
        const int column = static_cast<int>(i) % layout.columns, row = static_cast<int>(i) / layout.columns;
        const int x = sheet_margin + column * (layout.thumbnail_width + sheet_gap);
        const int y = top + heading_height + row * (layout.thumbnail_height + label_height(sheet_label_size) + sheet_gap);
        sheet.paste(with_label(pictures[i], layout.thumbnail_width, layout.thumbnail_height, exposure, sheet_label_size, style), x,
                    y);
    }
}

}  // namespace

SheetLayout layout_sheet(int terms, int sums, int width, int height) {
    if (terms < 1 || width < 1 || height < 1) throw std::invalid_argument("layout_sheet: no pictures");
    SheetLayout best;
    const auto empty_cells = [&](const SheetLayout& l) { return l.columns * (l.term_rows + l.sum_rows) - terms - sums; };
    for (int columns = 1; columns <= std::max(terms, sums); ++columns) {
        const SheetLayout layout = with_columns(columns, terms, sums, width, height);
        const bool larger = layout.thumbnail_width > best.thumbnail_width;
        const bool same = layout.thumbnail_width == best.thumbnail_width;
        if (larger || (same && empty_cells(layout) <= empty_cells(best))) best = layout;
    }
    return best;
}

std::string contact_sheet(std::span<const LabelledPicture> terms, std::span<const LabelledPicture> sums, double exposure,
                          const SheetStyle& style, const SheetHeadings& headings) {
    if (terms.empty()) throw std::invalid_argument("contact_sheet: no pictures");
    const Image& first = *terms.front().picture;
    const bool any = std::ranges::any_of(terms, [](const LabelledPicture& p) { return p.factor != 1.0; });
    const char* brightened = any ? "; ×8: eight times as bright" : "";
    const SheetLayout layout =
        layout_sheet(static_cast<int>(terms.size()), static_cast<int>(sums.size()), first.width, first.height);
    const int terms_height = block_height(layout, layout.term_rows);
    DisplayImage sheet(sheet_width(layout), 2 * sheet_margin + terms_height + block_height(layout, layout.sum_rows),
                       style.theme.background);
    paste_block(sheet, sheet_margin, layout, fmt::format("{}, exposure ×{:.3g}, sRGB{}", headings.terms, exposure, brightened),
                terms, exposure, style);
    paste_block(sheet, sheet_margin + terms_height, layout, fmt::format("{}, exposure ×{:.3g}, sRGB", headings.sums, exposure),
                sums, exposure, style);
    return encode_png(sheet, headings.comment);
}

}  // namespace neumann
