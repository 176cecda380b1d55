// Writes drawings, by libharu.
#include "core/image/module/write/encoders.h"

#include "core/base/error.h"

#include <fmt/format.h>
#include <hpdf.h>

#include <memory>

namespace neumann::encoders {

namespace {

// The first error; libharu does nothing after it.
void note_error(HPDF_STATUS error, HPDF_STATUS detail, void* noted) {
    auto& text = *static_cast<std::string*>(noted);
    if (text.empty()) text = fmt::format("libharu cannot write a PDF file: error {:#x}, {}", error, detail);
}

// Lengths of strokes are whole numbers before version 2.4.
template <class Length, class Phase>
void set_dashes(HPDF_STATUS (*set)(HPDF_Page, const Length*, HPDF_UINT, Phase), HPDF_Page page, const std::vector<int>& dashes) {
    const std::vector<Length> lengths(dashes.begin(), dashes.end());
    set(page, lengths.data(), static_cast<HPDF_UINT>(lengths.size()), Phase{});
}

HPDF_REAL real(double x) { return static_cast<HPDF_REAL>(x); }

class PdfPage {
public:
    PdfPage(HPDF_Doc pdf, const Drawing& drawing) : height_(drawing.height), page_(HPDF_AddPage(pdf)) {
        HPDF_Page_SetWidth(page_, real(drawing.width));
        HPDF_Page_SetHeight(page_, real(drawing.height));
        const auto file = find_label_font();
        if (file) HPDF_UseUTFEncodings(pdf);
        font_ = file ? HPDF_GetFont(pdf, HPDF_LoadTTFontFromFile(pdf, file->c_str(), HPDF_TRUE), "UTF-8")
                     : HPDF_GetFont(pdf, "Helvetica", "WinAnsiEncoding");
    }

    void draw(const DrawnPath& path) {
        const HPDF_REAL r = real(path.ink[0] / 255.0), g = real(path.ink[1] / 255.0), b = real(path.ink[2] / 255.0);
        const bool is_line = path.width > 0.0;
        if (is_line) {
            HPDF_Page_SetRGBStroke(page_, r, g, b);
            HPDF_Page_SetLineWidth(page_, real(path.width));
            set_dashes(HPDF_Page_SetDash, page_, path.dashes);
        } else {
            HPDF_Page_SetRGBFill(page_, r, g, b);
        }
        for (bool first = true; const auto& [x, y] : path.points) {
            (first ? HPDF_Page_MoveTo : HPDF_Page_LineTo)(page_, real(x), real(height_ - y));
            first = false;
        }
        is_line ? HPDF_Page_Stroke(page_) : HPDF_Page_Fill(page_);
    }

    void draw(const DrawnText& text) {
        HPDF_Page_SetRGBFill(page_, 0, 0, 0);
        HPDF_Page_SetFontAndSize(page_, font_, real(text.size));
        HPDF_Page_BeginText(page_);
        const double before = text.anchor * static_cast<double>(HPDF_Page_TextWidth(page_, text.text.c_str()));
        const double x = text.at.x, y = height_ - text.at.y;
        if (text.upwards)
            HPDF_Page_SetTextMatrix(page_, 0, 1, -1, 0, real(x), real(y - before));
        else
            HPDF_Page_SetTextMatrix(page_, 1, 0, 0, 1, real(x - before), real(y));
        HPDF_Page_ShowText(page_, text.text.c_str());
        HPDF_Page_EndText(page_);
    }

private:
    double height_;
    HPDF_Page page_;
    HPDF_Font font_;
};

}  // namespace

std::string encode_pdf(const Drawing& drawing) {
    std::string error;
    const std::unique_ptr<_HPDF_Doc_Rec, decltype(&HPDF_Free)> pdf(HPDF_New(note_error, &error), HPDF_Free);
    HPDF_SetCompressionMode(pdf.get(), HPDF_COMP_ALL);
    PdfPage page(pdf.get(), drawing);
    for (const DrawnGroup& group : drawing.groups) {
        for (const DrawnPath& path : group.paths) page.draw(path);
        for (const DrawnText& text : group.texts) page.draw(text);
    }
    HPDF_SaveToStream(pdf.get());
    std::string bytes(HPDF_GetStreamSize(pdf.get()), '\0');
    auto size = static_cast<HPDF_UINT32>(bytes.size());
    HPDF_ReadFromStream(pdf.get(), reinterpret_cast<HPDF_BYTE*>(bytes.data()), &size);
    if (!error.empty()) throw RunError(error);
    return bytes;
}

}  // namespace neumann::encoders
