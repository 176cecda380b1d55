#include "apps/commands/preview.h"

#include "apps/output/sheets/strips.h"
#include "core/base/error.h"
#include "core/image/image_io.h"

#include <algorithm>
#include <vector>

namespace neumann {

void Preview::show(std::size_t bounces, const std::function<Image(std::size_t)>& term) {
    if (share_.is_due()) share_.spend([&] { write(bounces, term); });
}

void Preview::write(std::size_t bounces, const std::function<Image(std::size_t)>& term) {
    constexpr std::size_t most_terms = 7;  // in a strip
    std::vector<Image> terms, sums;
    for (std::size_t i = 0; i < std::min(bounces + 1, most_terms); ++i) {
        terms.push_back(term(i));
        Image sum = terms.back();
        if (i > 0)
            for (std::size_t p = 0; p < sum.pixels.size(); ++p) sum.pixels[p] += sums.back().pixels[p];
        sums.push_back(std::move(sum));
    }
    const double exposure = exposure_for(sums.back(), terms.front());
    const Strip strip = strip_of_terms({.terms = terms, .sums = sums, .kind = kind_ + ", smoothed"}, terms.front(), exposure);
    try {
        std::string png = strip_png(strip, exposure, find_label_font());
        folder_.show("preview.png", png);
        is_there_ = true;
        seen_(std::move(png));
    } catch (const RunError&) {
        // A full disk is reported when the pictures are written.
    }
}

}  // namespace neumann
